//! The right-hand side: how fast everything changes, given what drives it.

use crate::flow::Flow;
use crate::setup::{BaseAttitude, Drive};
use crate::world::{SystemState, World};
use wrasse_dynamics::{
    BaseMode, BodyId, Dynamics, JointDrive, Kinematics, PerBody, State, driven_dynamics, kinematics,
};
use wrasse_hardware::{GYROS, WHEELS};
use wrasse_spatial::{
    Pose, SpatialForce, SpatialInertia, SpatialMomentum, SpatialVelocity, Vec3,
    rotation_vector_rate,
};

/// Inertia of the whole system with joints locked, about Bo in base axes, and the momentum of the
/// joint rates alone: from kinematics with the base at rest in the origin.
fn locked<const J: usize>(
    k: &Kinematics<'_, f64, J>,
) -> (SpatialInertia<f64>, SpatialMomentum<f64>) {
    let (mut M, mut h) = (SpatialInertia::zero(), SpatialForce::zero());
    for body in k.robot.bodies() {
        let (X_NB, M_B) = (&k.X_NB(body), k.robot.inertia(body));
        M += X_NB.inertia_to_parent(M_B);
        h += X_NB.force_to_parent(&(*M_B * k.V_NB_B(body)));
    }
    (M, h)
}

impl<const J: usize> World<J> {
    /// Pose and twist of the base and the joints' state that a system state means, at `t` (s) into
    /// the current set-points.
    pub(crate) fn expand(&self, system: &SystemState<J>, t: f64) -> State<f64, J> {
        let mut state = State { q: system.q, v: system.v, ..State::default() };
        for j in self.robot.joints() {
            if let Drive::Follow(motion) = &self.drives[j] {
                let set_point = motion.at(t);
                (state.q[j], state.v[j]) = (set_point.position, set_point.rate);
            }
        }
        let (M, h_of_rates) = locked(&kinematics(&self.robot, &state));
        let R_NB = system.quat_NB.to_matrix();
        let p_BScm_B = M.centre_of_mass();
        let linear_B = R_NB.transpose_mul(system.linear);
        state.V_NB_B = match self.base {
            BaseAttitude::Held => {
                SpatialVelocity::new(Vec3::zero(), (linear_B - h_of_rates.force) * (1.0 / M.mass))
            }
            BaseAttitude::Free | BaseAttitude::Controlled => {
                let about_cm = SpatialForce::new(R_NB.transpose_mul(system.angular), linear_B);
                let inside = SpatialForce::new(self.inside_B(system), Vec3::zero());
                M.velocity_of(&(about_cm.about(-p_BScm_B) - h_of_rates - inside))
            }
        };
        state.X_NB = Pose::new(R_NB, system.p_NScm_N - R_NB * p_BScm_B);
        state
    }

    /// Accelerations and forces at a state, with the drives as they are at `t` (s).
    pub(crate) fn dynamics_at(
        &self,
        k: &Kinematics<'_, f64, J>,
        t: f64,
        acting: &Acting<J>,
    ) -> Dynamics<f64, J> {
        let drives = core::array::from_fn(|j| match &self.drives[j] {
            Drive::Follow(motion) => JointDrive::Acceleration(motion.at(t).acceleration),
            Drive::Effort(tau) => JointDrive::Effort(*tau),
        });
        let mut on_bodies = acting.outside;
        on_bodies.base.torque += self.actuator_torque_B + acting.turning_B;
        on_bodies.base += acting.thrust_B;
        driven_dynamics(k, &drives, self.base_mode(), &on_bodies)
    }

    /// What holds the base.
    pub(crate) fn base_mode(&self) -> BaseMode {
        match self.base {
            BaseAttitude::Held => BaseMode::AttitudeHeld,
            BaseAttitude::Free | BaseAttitude::Controlled => BaseMode::Free,
        }
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
        let wheel_torque = self.wheels.torques(&system.wheel_momentum, w);
        let gimbal_acceleration = self.gyros.accelerations(&angle, &rate, w);
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
        let state = self.expand(&system, t0 + t);
        let k = kinematics(&self.robot, &state);
        let acting = self.acting(&system, &k, t0 + t, self.stretch_middle);
        let found = self.dynamics_at(&k, t0 + t, &acting);
        let (R_NB, w) = (state.X_NB.rotation, state.V_NB_B.angular);
        let torque_B = found.force.base.torque + self.actuator_torque_B;
        let p_NScm_N = system.p_NScm_N;
        let (force, torque) = about_centre_of_mass(&k, &acting.outside, p_NScm_N);
        let (push, turn) = of_thrusters(&k, &acting.thrust_B, p_NScm_N);
        let beside = self.beside_the_centre_of_all(p_NScm_N, t0 + t);
        let torque_N = R_NB * torque_B;
        let on_base = (torque_B + acting.turning_B).dot(w);
        let mut work = Vec3 { x: 0.0, y: on_base + state.V_NB_B.power(&acting.thrust_B), z: 0.0 };
        for j in self.robot.joints() {
            work.x += found.force.joints[j] * state.v[j];
        }
        for body in self.robot.bodies() {
            work.z += k.V_NB_B(body).power(&acting.outside[body]);
        }
        Flow {
            turn: rotation_vector_rate(d.turn, w),
            q: state.v,
            v: found.nudot.joints,
            p_NScm_N: system.linear * (1.0 / self.mass),
            linear: force + push,
            angular: torque_N + torque + turn,
            wheel_momentum: acting.wheel_torque,
            gimbal_angle: system.gimbal_rate,
            gimbal_rate: acting.gimbal_acceleration,
            from_actuator: torque_N,
            from_outside: torque + beside.cross(force),
            outside_impulse: force,
            from_thrusters: turn + beside.cross(push),
            thruster_impulse: push,
            work,
        }
    }
}

/// What acts on the vehicle at an instant, beside joint drives and the ideal attitude actuator.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Acting<const J: usize> {
    /// From outside on each body, at its origin, in its axes.
    outside: PerBody<SpatialForce<f64>, J>,
    /// The thrusters on the base, at its origin, in base axes.
    thrust_B: SpatialForce<f64>,
    /// Torque of wheels and gyros on the base, base axes (N·m).
    pub(crate) turning_B: Vec3<f64>,
    /// On each wheel about its axis (N·m).
    wheel_torque: [f64; WHEELS],
    /// Of each gimbal (rad/s²).
    pub(crate) gimbal_acceleration: [f64; GYROS],
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
    let mut add = |body: BodyId| {
        let X_NB = &k.X_NB(body);
        let f = X_NB.rotation * outside[body].force;
        force += f;
        torque += X_NB.rotation * outside[body].torque + (X_NB.translation - p_NScm_N).cross(f);
    };
    k.robot.bodies().for_each(&mut add);
    (force, torque)
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
