//! The right-hand side: how fast everything changes, given what drives it.

use crate::flow::Flow;
use crate::free_flight::FreeFlight;
use crate::setup::BaseAttitude;
use crate::world::{SystemState, World};
use wrasse_dynamics::{
    BodyId, Configuration, Dynamics, ForwardDynamics, Kinematics, Outside, PerBody, State,
    accelerate, configure, kinematics,
};
use wrasse_hardware::{CMGS, WHEELS};
use wrasse_spatial::{SpatialForce, Vec3};

impl<const J: usize> World<J> {
    /// The vehicle without what is bolted to it.
    #[inline(always)]
    pub(crate) fn vehicle(&self) -> FreeFlight<'_, f64, J> {
        FreeFlight {
            robot: &self.robot,
            drives: &self.drives,
            base: self.base,
            mass: self.mass,
            actuator_torque_B: self.actuator_torque_B,
        }
    }

    /// Pose and twist of the base and the joints' state that a system state means, at `t` (s) into
    /// the current set-points.
    pub(crate) fn expand(&self, system: &SystemState<J>, t: f64) -> State<f64, J> {
        let vehicle = self.vehicle();
        let (bent, mut places) = (vehicle.bent(system, t), self.places.take().unwrap_or_default());
        configure(&self.robot, &bent.q, &mut places.configuration);
        let rows = &places.configuration.base;
        let state = vehicle.moving(&bent, rows, system, self.inside_B(system));
        self.places.set(Some(places));
        state
    }

    /// Accelerations and forces at a state, with the drives as they are at `t` (s).
    pub(crate) fn dynamics_at(
        &self,
        k: &Kinematics<'_, f64, J>,
        t: f64,
        acting: &Acting<J>,
    ) -> Dynamics<f64, J> {
        let (drives, nu) = (self.vehicle().joint_drives(t), k.state.velocity());
        let pushed = acting.on_bodies(self.actuator_torque_B);
        let mut places = self.places.take().unwrap_or_default();
        let Places { configuration, forward } = &mut *places;
        configure(k.robot, &k.state.q, configuration);
        accelerate(k.robot, configuration, &nu, &drives, self.base.mode(), pushed, forward);
        let found = forward.found;
        self.places.set(Some(places));
        found
    }

    /// What wheels and CMGs hold beside the bodies, base axes (N·m·s).
    pub(crate) fn inside_B(&self, system: &SystemState<J>) -> Vec3<f64> {
        self.wheels.together_B(&system.wheel_momentum)
            + self.cmgs.together_B(system.gimbal_angle, system.gimbal_rate)
    }

    /// What acts at a state, `t` (s) into the current set-points.
    pub(crate) fn acting_at(
        &self,
        system: &SystemState<J>,
        k: &Kinematics<'_, f64, J>,
        t: f64,
    ) -> Acting<J> {
        self.acting(system, k.state, self.outside_wrench(t, k), (t, t))
    }

    /// What acts at a state beside a wrench from outside, `t` (s) into the current set-points; forces
    /// of thrusters as in the stretch that holds `within` (s).
    fn acting(
        &self,
        system: &SystemState<J>,
        state: &State<f64, J>,
        outside: Option<PerBody<SpatialForce<f64>, J>>,
        (t, within): (f64, f64),
    ) -> Acting<J> {
        let (w, angle, rate) = (state.V_NB_B.angular, system.gimbal_angle, system.gimbal_rate);
        // On a base that is held nothing turns against it; what they hold stays, for w is zero.
        let (wheel_torque, gimbal_acceleration) = match self.base {
            BaseAttitude::Held => ([0.0; WHEELS], [0.0; CMGS]),
            BaseAttitude::Controlled | BaseAttitude::Free => (
                self.wheels.torques(&system.wheel_momentum, w),
                self.cmgs.accelerations(&angle, &rate, w),
            ),
        };
        // What they hold, h, turns with the base: the bodies feel -ḣ - w × h.
        let hdot_B = self.wheels.together_B(&wheel_torque)
            + self.cmgs.change_B(angle, rate, &gimbal_acceleration);
        Acting {
            outside,
            thrust_B: self.thrusters.wrench(t, within),
            turning_B: -hdot_B - w.cross(self.inside_B(system)),
            wheel_torque,
            gimbal_acceleration,
        }
    }

    /// Rates of the flow at displacement `d`, `t` (s) into the step that began `t0` (s) into the
    /// current set-points.
    pub(crate) fn rates(&self, places: &mut Places<J>, t0: f64, t: f64, d: &Flow<J>) -> Flow<J> {
        let Places { configuration, forward } = places;
        let (system, vehicle, robot) = (self.system.displaced(d), self.vehicle(), &self.robot);
        let t = t0 + t;
        let bent = vehicle.bent(&system, t);
        configure(robot, &bent.q, configuration);
        let state = vehicle.moving(&bent, &configuration.base, &system, self.inside_B(&system));
        let pushed = self.pushed_from_outside(&state, t, system.p_NScm_N);
        let outside = pushed.as_ref().map(|pushed| pushed.wrench);
        let acting = self.acting(&system, &state, outside, (t, self.stretch_middle));
        let (nu, drives) = (state.velocity(), vehicle.joint_drives(t));
        let on_bodies = acting.on_bodies(self.actuator_torque_B);
        accelerate(robot, configuration, &nu, &drives, self.base.mode(), on_bodies, forward);
        let mut flow = vehicle.flow(&system, d, &state, &forward.found, acting.turning_B);
        self.book(&mut flow, &state, &acting, pushed.as_ref(), (system.p_NScm_N, t));
        flow.wheel_momentum = acting.wheel_torque;
        flow.gimbal_angle = system.gimbal_rate;
        flow.gimbal_rate = acting.gimbal_acceleration;
        flow
    }

    /// The wrench from outside at a state, if there is one, and what it does.
    fn pushed_from_outside(
        &self,
        state: &State<f64, J>,
        t: f64,
        p_NScm_N: Vec3<f64>,
    ) -> Option<Pushed<J>> {
        if !self.is_pushed() {
            return None;
        }
        let k = kinematics(&self.robot, state);
        let wrench = self.outside_wrench(t, &k)?;
        let (force, torque) = about_centre_of_mass(&k, &wrench, p_NScm_N);
        Some(Pushed { wrench, force, torque, power: power(&k, &wrench) })
    }

    /// Impulses and work of thrusters and of what pushes from outside.
    fn book(
        &self,
        flow: &mut Flow<J>,
        state: &State<f64, J>,
        acting: &Acting<J>,
        pushed: Option<&Pushed<J>>,
        (p_NScm_N, t): (Vec3<f64>, f64),
    ) {
        let none = Vec3::zero();
        let (force, torque, power) =
            pushed.map_or((none, none, 0.0), |on| (on.force, on.torque, on.power));
        let (push, turn) = of_thrusters(state, &acting.thrust_B, p_NScm_N);
        let beside = self.beside_the_centre_of_all(p_NScm_N, t);
        flow.linear = force + push;
        flow.angular = flow.angular + torque + turn;
        flow.from_outside = torque + beside.cross(force);
        flow.outside_impulse = force;
        flow.from_thrusters = turn + beside.cross(push);
        flow.thruster_impulse = push;
        flow.work.y += state.V_NB_B.power(&acting.thrust_B);
        flow.work.z = power;
    }
}

/// A wrench from outside on the bodies, and what it does: force (N) and torque about the centre of mass
/// (N·m), inertial axes; power (W).
struct Pushed<const J: usize> {
    wrench: PerBody<SpatialForce<f64>, J>,
    force: Vec3<f64>,
    torque: Vec3<f64>,
    power: f64,
}

/// Places for what the right-hand side works out, used again and again.
#[derive(Debug, Default)]
pub(crate) struct Places<const J: usize> {
    configuration: Configuration<f64, J>,
    forward: ForwardDynamics<f64, J>,
}

/// What acts on the vehicle at an instant, beside joint drives and the ideal attitude actuator.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Acting<const J: usize> {
    /// From outside on each body, at its origin, in its axes.
    outside: Option<PerBody<SpatialForce<f64>, J>>,
    /// The thrusters on the base, at its origin, in base axes.
    thrust_B: SpatialForce<f64>,
    /// Torque of wheels and CMGs on the base, base axes (N·m).
    pub(crate) turning_B: Vec3<f64>,
    /// On each wheel about its axis (N·m).
    wheel_torque: [f64; WHEELS],
    /// Of each gimbal (rad/s²).
    pub(crate) gimbal_acceleration: [f64; CMGS],
}

impl<const J: usize> Acting<J> {
    /// All that acts on the bodies, with the torque of the ideal attitude actuator (N·m, base axes).
    fn on_bodies(&self, actuator_torque_B: Vec3<f64>) -> Outside<'_, f64, J> {
        let mut all = self.outside.as_ref().map_or_else(Outside::nothing, Outside::from);
        all.base.torque += actuator_torque_B + self.turning_B;
        all.base += self.thrust_B;
        all
    }
}

impl<const J: usize> World<J> {
    /// From the centre of mass of vehicle and free bodies to that of the vehicle at `p_NScm_N`, `t`
    /// (s) into the current set-points (m). The ledger counts about the first.
    fn beside_the_centre_of_all(&self, p_NScm_N: Vec3<f64>, t: f64) -> Vec3<f64> {
        let (mut mass, mut moment) = (self.mass, Vec3::zero());
        for body in &self.free {
            // They are moved after the vehicle: seen from there they are still at the start.
            let p_NTcm_N =
                body.p_NTcm_N + body.linear * ((t - self.into_period) / body.matter.M_F_F.mass);
            mass += body.matter.M_F_F.mass;
            moment += (p_NScm_N - p_NTcm_N) * body.matter.M_F_F.mass;
        }
        moment * (1.0 / mass)
    }
}

/// Outside force (N) and its torque about the centre of mass (N·m), inertial axes.
fn about_centre_of_mass<const J: usize>(
    k: &Kinematics<'_, f64, J>,
    outside: &PerBody<SpatialForce<f64>, J>,
    p_NScm_N: Vec3<f64>,
) -> (Vec3<f64>, Vec3<f64>) {
    let (mut force, mut torque) = (Vec3::zero(), Vec3::zero());
    let poses = k.poses();
    let mut add = |body: BodyId| {
        let X_NB = &poses[body];
        let f = X_NB.rotation * outside[body].force;
        force += f;
        torque += X_NB.rotation * outside[body].torque + (X_NB.translation - p_NScm_N).cross(f);
    };
    k.robot.bodies().for_each(&mut add);
    (force, torque)
}

/// Power (W) of what pushes from outside.
fn power<const J: usize>(
    k: &Kinematics<'_, f64, J>,
    outside: &PerBody<SpatialForce<f64>, J>,
) -> f64 {
    let V_NB_B = k.twists();
    k.robot.bodies().fold(0.0, |sum, body| sum + V_NB_B[body].power(&outside[body]))
}

/// Force (N) of the thrusters and its torque about the centre of mass (N·m), inertial axes.
fn of_thrusters<const J: usize>(
    state: &State<f64, J>,
    thrust_B: &SpatialForce<f64>,
    p_NScm_N: Vec3<f64>,
) -> (Vec3<f64>, Vec3<f64>) {
    let X_NB = &state.X_NB;
    let force = X_NB.rotation * thrust_B.force;
    (force, X_NB.rotation * thrust_B.torque + (X_NB.translation - p_NScm_N).cross(force))
}
