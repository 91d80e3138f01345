//! The right-hand side: how fast everything changes, given what drives it.

use crate::flow::Flow;
use crate::free_flight::FreeFlight;
use crate::setup::BaseAttitude;
use crate::world::{SystemState, World};
use wrasse_dynamics::{BodyId, Dynamics, Kinematics, Outside, PerBody, State, kinematics};
use wrasse_hardware::{GYROS, WHEELS};
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
        self.vehicle().expand(system, self.inside_B(system), t)
    }

    /// Accelerations and forces at a state, with the drives as they are at `t` (s).
    pub(crate) fn dynamics_at(
        &self,
        k: &Kinematics<'_, f64, J>,
        t: f64,
        acting: &Acting<J>,
    ) -> Dynamics<f64, J> {
        self.vehicle().dynamics(k, t, (acting.turning_B, acting.thrust_B), acting.outside())
    }

    /// What wheels and gyros hold beside the bodies, base axes (N·m·s).
    pub(crate) fn inside_B(&self, system: &SystemState<J>) -> Vec3<f64> {
        self.wheels.together_B(&system.wheel_momentum)
            + self.gyros.together_B(system.gimbal_angle, system.gimbal_rate)
    }

    /// What acts at a state, `t` (s) into the current set-points; forces of thrusters as in the
    /// stretch that holds `within` (s).
    pub(crate) fn acting(
        &self,
        system: &SystemState<J>,
        k: &Kinematics<'_, f64, J>,
        t: f64,
        within: f64,
    ) -> Acting<J> {
        let (w, angle, rate) =
            (k.V_NB_B(BodyId::Base).angular, system.gimbal_angle, system.gimbal_rate);
        // On a base that is held nothing turns against it; what they hold stays, for w is zero.
        let (wheel_torque, gimbal_acceleration) = match self.base {
            BaseAttitude::Held => ([0.0; WHEELS], [0.0; GYROS]),
            BaseAttitude::Controlled | BaseAttitude::Free => (
                self.wheels.torques(&system.wheel_momentum, w),
                self.gyros.accelerations(&angle, &rate, w),
            ),
        };
        // What they hold, h, turns with the base: the bodies feel -ḣ - w × h.
        let hdot_B = self.wheels.together_B(&wheel_torque)
            + self.gyros.change_B(angle, rate, &gimbal_acceleration);
        Acting {
            outside: self.outside_wrench(t, k),
            thrust_B: self.thrusters.wrench(t, within),
            turning_B: -hdot_B - w.cross(self.inside_B(system)),
            wheel_torque,
            gimbal_acceleration,
        }
    }

    /// Rates of the flow at displacement `d`, `t` (s) into the step that began `t0` (s) into the
    /// current set-points.
    pub(crate) fn rates(&self, t0: f64, t: f64, d: &Flow<J>) -> Flow<J> {
        let system = self.system.displaced(d);
        let vehicle = self.vehicle();
        let posture = vehicle.posture(&system, t0 + t);
        let bent = kinematics(&self.robot, &posture);
        let state = vehicle.moving(&bent, &system, self.inside_B(&system));
        let k = bent.moving_as(&state);
        let acting = self.acting(&system, &k, t0 + t, self.stretch_middle);
        let found = self.dynamics_at(&k, t0 + t, &acting);
        let mut flow = vehicle.flow(&system, d, &state, &found, acting.turning_B);
        let p_NScm_N = system.p_NScm_N;
        let mut pushed = (Vec3::zero(), Vec3::zero());
        if let Some(outside) = &acting.outside {
            pushed = about_centre_of_mass(&k, outside, p_NScm_N);
            flow.work.z = power(&k, outside);
        }
        let (force, torque) = pushed;
        let (push, turn) = of_thrusters(&k, &acting.thrust_B, p_NScm_N);
        let beside = self.beside_the_centre_of_all(p_NScm_N, t0 + t);
        flow.linear = force + push;
        flow.angular = flow.angular + torque + turn;
        flow.wheel_momentum = acting.wheel_torque;
        flow.gimbal_angle = system.gimbal_rate;
        flow.gimbal_rate = acting.gimbal_acceleration;
        flow.from_outside = torque + beside.cross(force);
        flow.outside_impulse = force;
        flow.from_thrusters = turn + beside.cross(push);
        flow.thruster_impulse = push;
        flow.work.y += state.V_NB_B.power(&acting.thrust_B);
        flow
    }
}

/// What acts on the vehicle at an instant, beside joint drives and the ideal attitude actuator.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Acting<const J: usize> {
    /// From outside on each body, at its origin, in its axes.
    outside: Option<PerBody<SpatialForce<f64>, J>>,
    /// The thrusters on the base, at its origin, in base axes.
    thrust_B: SpatialForce<f64>,
    /// Torque of wheels and gyros on the base, base axes (N·m).
    pub(crate) turning_B: Vec3<f64>,
    /// On each wheel about its axis (N·m).
    wheel_torque: [f64; WHEELS],
    /// Of each gimbal (rad/s²).
    pub(crate) gimbal_acceleration: [f64; GYROS],
}

impl<const J: usize> Acting<J> {
    fn outside(&self) -> Outside<'_, f64, J> {
        self.outside.as_ref().map_or_else(Outside::nothing, Outside::from)
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
    k: &Kinematics<'_, f64, J>,
    thrust_B: &SpatialForce<f64>,
    p_NScm_N: Vec3<f64>,
) -> (Vec3<f64>, Vec3<f64>) {
    let X_NB = &k.X_NB(BodyId::Base);
    let force = X_NB.rotation * thrust_B.force;
    (force, X_NB.rotation * thrust_B.torque + (X_NB.translation - p_NScm_N).cross(force))
}
