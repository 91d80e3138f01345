//! A vehicle in free space with nothing bolted to it: how it moves and what moves it. The world adds
//! wheels, CMGs, thrusters and what pushes from outside.

use crate::flow::Flow;
use crate::setup::{BaseAttitude, Drive};
use crate::stepper::Displacement;
use crate::world::SystemState;
use wrasse_dynamics::{BaseMode, BaseRows, Dynamics, JointDrive, Robot, State};
use wrasse_spatial::{
    Pose, Real, SpatialForce, SpatialVelocity, Vec3, rotation_vector_rate, turned_by,
};

/// A vehicle and what drives it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FreeFlight<'a, T, const J: usize> {
    pub(crate) robot: &'a Robot<T, J>,
    pub(crate) drives: &'a [Drive<T>; J],
    pub(crate) base: BaseAttitude,
    /// (kg)
    pub(crate) mass: T,
    /// Torque of the ideal attitude actuator (N·m, base axes).
    pub(crate) actuator_torque_B: Vec3<T>,
}

impl BaseAttitude {
    /// What holds the base.
    #[inline(always)]
    pub(crate) fn mode(self) -> BaseMode {
        match self {
            Self::Held => BaseMode::AttitudeHeld,
            Self::Free | Self::Controlled => BaseMode::Free,
        }
    }
}

impl<T: Real, const J: usize> FreeFlight<'_, T, J> {
    /// The joints' state that a system state means, `t` (s) into the current set-points.
    #[inline(always)]
    pub(crate) fn bent(&self, system: &SystemState<J, T>, t: f64) -> State<T, J> {
        let mut bent = State { q: system.q, v: system.v, ..State::default() };
        for j in self.robot.joints() {
            if let Drive::Follow(motion) = &self.drives[j] {
                let set_point = motion.at(T::from_f64(t));
                (bent.q[j], bent.v[j]) = (set_point.position, set_point.rate);
            }
        }
        bent
    }

    /// Pose and twist of the base that a system state means, beside the joints' state and what it gives
    /// of the mass matrix.
    #[inline(always)]
    pub(crate) fn moving(
        &self,
        bent: &State<T, J>,
        rows: &BaseRows<T, J>,
        system: &SystemState<J, T>,
        inside_B: Vec3<T>,
    ) -> State<T, J> {
        let mut state = *bent;
        // Inertia with joints locked and momentum of the joint rates alone: about Bo, in base axes.
        let (M, h_of_rates) = (rows.M_bb, rows.momentum_of_rates(&state.v));
        let R_NB = system.quat_NB.to_matrix();
        let p_BScm_B = M.centre_of_mass();
        let linear_B = R_NB.transpose_mul(system.linear);
        state.V_NB_B = match self.base {
            BaseAttitude::Held => SpatialVelocity::new(
                Vec3::zero(),
                (linear_B - h_of_rates.force) * (T::one() / M.mass),
            ),
            BaseAttitude::Free | BaseAttitude::Controlled => {
                let about_cm = SpatialForce::new(R_NB.transpose_mul(system.angular), linear_B);
                let inside = SpatialForce::new(inside_B, Vec3::zero());
                M.velocity_of(&(about_cm.about(-p_BScm_B) - h_of_rates - inside))
            }
        };
        state.X_NB = Pose::new(R_NB, system.p_NScm_N - R_NB * p_BScm_B);
        state
    }

    /// What is given of the joints, `t` (s) into the current set-points.
    #[inline(always)]
    pub(crate) fn joint_drives(&self, t: f64) -> [JointDrive<T>; J] {
        let mut drives = [JointDrive::Effort(T::zero()); J];
        for j in self.robot.joints() {
            drives[j] = match &self.drives[j] {
                Drive::Follow(motion) => {
                    JointDrive::Acceleration(motion.at(T::from_f64(t)).acceleration)
                }
                Drive::Effort(tau) => JointDrive::Effort(*tau),
            };
        }
        drives
    }

    /// Rates of the flow at displacement `d`, where drives, actuator and what turns the base are all
    /// that acts.
    #[inline(always)]
    pub(crate) fn flow(
        &self,
        system: &SystemState<J, T>,
        d: &Flow<J, T>,
        state: &State<T, J>,
        found: &Dynamics<T, J>,
        turning_B: Vec3<T>,
    ) -> Flow<J, T> {
        let w = state.V_NB_B.angular;
        let torque_B = found.force.base.torque + self.actuator_torque_B;
        let torque_N = state.X_NB.rotation * torque_B;
        let mut work = Vec3::zero();
        work.y = (torque_B + turning_B).dot(w);
        for j in self.robot.joints() {
            work.x += found.force.joints[j] * state.v[j];
        }
        Flow {
            turn: rotation_vector_rate(d.turn, w),
            q: state.v,
            v: found.nudot.joints,
            p_NScm_N: system.linear * (T::one() / self.mass),
            angular: torque_N,
            from_actuator: torque_N,
            work,
            ..Flow::zero()
        }
    }

    /// The state after a displacement, what earlier sums lost given back; `t` (s) is where the
    /// set-points are then. What the drives and the actuator did is booked.
    #[inline(always)]
    pub(crate) fn move_on(
        &self,
        (s, carry, booked): (&mut SystemState<J, T>, &mut Flow<J, T>, &mut Flow<J, T>),
        d: &Flow<J, T>,
        t: f64,
    ) {
        s.quat_NB = turned_by(s.quat_NB, d.turn);
        for j in self.robot.joints() {
            if let Drive::Follow(motion) = &self.drives[j] {
                let set_point = motion.at(T::from_f64(t));
                (s.q[j], s.v[j]) = (set_point.position, set_point.rate);
            } else {
                add_with_care(&mut s.q[j], d.q[j], &mut carry.q[j]);
                add_with_care(&mut s.v[j], d.v[j], &mut carry.v[j]);
            }
        }
        add_vector(&mut s.p_NScm_N, d.p_NScm_N, &mut carry.p_NScm_N);
        add_vector(&mut s.linear, d.linear, &mut carry.linear);
        add_vector(&mut s.angular, d.angular, &mut carry.angular);
        add_vector(&mut booked.from_actuator, d.from_actuator, &mut carry.from_actuator);
        add_vector(&mut booked.work, d.work, &mut carry.work);
    }
}

/// `x += dx`, giving back what the last sum lost (Kahan).
#[inline(always)]
pub(crate) fn add_with_care<T: Real>(x: &mut T, dx: T, carry: &mut T) {
    let y = dx - *carry;
    let sum = *x + y;
    *carry = (sum - *x) - y;
    *x = sum;
}

/// The same for each component.
#[inline(always)]
pub(crate) fn add_vector<T: Real>(x: &mut Vec3<T>, dx: Vec3<T>, carry: &mut Vec3<T>) {
    add_with_care(&mut x.x, dx.x, &mut carry.x);
    add_with_care(&mut x.y, dx.y, &mut carry.y);
    add_with_care(&mut x.z, dx.z, &mut carry.z);
}

#[cfg(test)]
mod tests {
    use super::add_with_care;

    /// A hundredth a million times. A plain sum is off by 1.7e-7.
    #[test]
    fn a_sum_with_care_is_right_to_the_last_bit() {
        let (mut sum, mut carry) = (0.0, 0.0);
        for _ in 0..1_000_000 {
            add_with_care(&mut sum, 0.01, &mut carry);
        }
        assert_eq!(sum, 1e4);
    }
}
