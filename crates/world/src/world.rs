//! The world: a vehicle in free space, what drives it, and its motion through time.

use crate::command::Failure;
use crate::flow::Flow;
use crate::free_body::FreeBody;
use crate::setup::{BaseAttitude, Drive, Equipment, OutsideWrench, WorldSetup};
use crate::stepper::{Displacement, Stepper, dormand_prince, equal_steps, runge_kutta_4};
use std::fmt;
use wrasse_dynamics::{
    Dynamics, Frame, Kinematics, Payload, PerBody, Robot, State, kinematics, momentum,
};
use wrasse_hardware::{ActuatorCommand, ActuatorReadings, AttitudeActuator, JointLimits};
use wrasse_spatial::{Pose, Quat, SpatialForce, Vec3, turned_by};

/// The integrated state: all of it in inertial axes but the joints.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SystemState<const J: usize> {
    /// Attitude of the base, `quat_NB`.
    pub quat_NB: Quat<f64>,
    /// Joint positions (rad or m).
    pub q: [f64; J],
    /// Joint rates (rad/s or m/s).
    pub v: [f64; J],
    /// Centre of mass (m).
    pub p_NScm_N: Vec3<f64>,
    /// Linear momentum (N·s).
    pub linear: Vec3<f64>,
    /// Angular momentum of the bodies about the centre of mass (N·m·s); follows from the rest where
    /// the attitude is held.
    pub angular: Vec3<f64>,
}

impl<const J: usize> SystemState<J> {
    /// The state after a displacement.
    #[inline(always)]
    pub(crate) fn displaced(&self, d: &Flow<J>) -> Self {
        Self {
            quat_NB: self.quat_NB * Quat::exp(d.turn),
            q: core::array::from_fn(|j| self.q[j] + d.q[j]),
            v: core::array::from_fn(|j| self.v[j] + d.v[j]),
            p_NScm_N: self.p_NScm_N + d.p_NScm_N,
            linear: self.linear + d.linear,
            angular: self.angular + d.angular,
        }
    }
}

/// A number that is no longer finite.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{quantity} is no longer finite at t = {time} s")]
pub struct NonFinite {
    /// What.
    pub quantity: String,
    /// The joint that it belongs to, if it belongs to one.
    pub joint: Option<usize>,
    /// When (s).
    pub time: f64,
}

/// The simulated truth.
pub struct World<const J: usize> {
    pub(crate) robot: Robot<f64, J>,
    /// The vehicle without payloads, and what is in its grips.
    pub(crate) empty: Robot<f64, J>,
    pub(crate) held: Vec<(Frame<f64>, Payload<f64>)>,
    /// Bodies that float by themselves.
    pub(crate) free: Vec<FreeBody>,
    pub(crate) limits: [JointLimits<f64>; J],
    pub(crate) actuator: Option<AttitudeActuator<f64>>,
    pub(crate) base: BaseAttitude,
    stepper: Stepper,
    pub(crate) mass: f64,
    pub(crate) system: SystemState<J>,
    /// What rounding took from the last sums, to be given back in the next.
    carry: Flow<J>,
    /// Impulses and work since the start.
    pub(crate) booked: Flow<J>,
    pub(crate) energy_at_grasps: f64,
    pub(crate) drives: [Drive; J],
    pub(crate) actuator_torque_B: Vec3<f64>,
    outside: Option<OutsideWrench<J>>,
    equipment: Equipment,
    pub(crate) told: ActuatorCommand<f64>,
    failures: Vec<Failure>,
    /// Time (s), and what rounding took from it.
    pub(crate) time: f64,
    time_carry: f64,
    /// Start of the current period (s), and how much of it has gone (s).
    pub(crate) period_start: f64,
    pub(crate) into_period: f64,
    /// Last accepted step of the adaptive stepper (s).
    last_step: f64,
}

impl<const J: usize> fmt::Debug for World<J> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("World")
            .field("time", &self.time)
            .field("base", &self.base)
            .field("system", &self.system)
            .finish_non_exhaustive()
    }
}

impl<const J: usize> World<J> {
    /// A world at time zero.
    pub fn new(setup: &WorldSetup<'_, J>) -> Self {
        let robot =
            setup.held.iter().fold(*setup.robot, |robot, (frame, p)| robot.with_payload(frame, p));
        let start = &setup.start;
        let h = momentum(&kinematics(&robot, start));
        let mut limits = [JointLimits::default(); J];
        limits.iter_mut().zip(setup.limits).for_each(|(to, from)| *to = *from);
        Self {
            robot,
            empty: *setup.robot,
            held: setup.held.to_vec(),
            free: Vec::new(),
            limits,
            actuator: setup.actuator,
            base: setup.base,
            stepper: setup.stepper,
            mass: h.mass,
            system: SystemState {
                quat_NB: Quat::from_matrix(&start.X_NB.rotation),
                q: start.q,
                v: start.v,
                p_NScm_N: h.p_NScm_N,
                linear: h.linear,
                angular: h.angular,
            },
            carry: Flow::zero(),
            booked: Flow::zero(),
            energy_at_grasps: 0.0,
            drives: [Drive::Effort(0.0); J],
            actuator_torque_B: Vec3::zero(),
            outside: None,
            equipment: setup.equipment,
            told: ActuatorCommand::default(),
            failures: Vec::new(),
            time: 0.0,
            time_carry: 0.0,
            period_start: 0.0,
            into_period: 0.0,
            last_step: 0.01,
        }
    }
    /// A wrench from outside that acts from now on.
    pub fn set_outside_wrench(&mut self, outside: OutsideWrench<J>) {
        self.outside = Some(outside);
    }
    /// Let a body float beside the vehicle; its number.
    pub fn add_free_body(&mut self, body: FreeBody) -> usize {
        self.free.push(body);
        self.free.len() - 1
    }
    /// The robot with what it holds.
    pub fn robot(&self) -> &Robot<f64, J> {
        &self.robot
    }
    /// Bodies that float by themselves.
    pub fn free_bodies(&self) -> &[FreeBody] {
        &self.free
    }
    /// The integrated state.
    pub fn system(&self) -> &SystemState<J> {
        &self.system
    }
    /// Time (s).
    pub fn time(&self) -> f64 {
        self.time
    }
    /// Where everything is and how it moves.
    pub fn state(&self) -> State<f64, J> {
        self.expand(&self.system, self.into_period)
    }
    /// Accelerations and forces now, with the drives as they are.
    pub fn dynamics(&self) -> Dynamics<f64, J> {
        let t = self.into_period;
        let state = self.state();
        let k = kinematics(&self.robot, &state);
        self.dynamics_at(&k, t, &self.outside_wrench(t, &k))
    }
    /// Torque of the attitude actuator on the base now (N·m, base axes), within its limits. What
    /// holds an attitude exactly is the base's entry of [`dynamics`](Self::dynamics).
    pub fn actuator_torque_B(&self) -> Vec3<f64> {
        self.actuator_torque_B
    }
    /// What wheels, gyros and tank say of themselves.
    pub fn actuator_readings(&self) -> ActuatorReadings<f64> {
        ActuatorReadings {
            wheel_speed: self.equipment.wheel_speed,
            gimbal_angle: self.equipment.gimbal_angle,
            gimbal_rate: self.told.gimbal_rate,
            propellant: self.equipment.actuators.tank.map_or(0.0, |tank| tank.propellant),
        }
    }
    /// Let something break.
    pub fn fail(&mut self, failure: Failure) {
        self.failures.push(failure);
    }
    /// What is in the grips: the frame that holds it, and its matter seen from there.
    pub fn held(&self) -> &[(Frame<f64>, Payload<f64>)] {
        &self.held
    }
    /// Momentum that the attitude actuator stores (N·m·s, base axes), zero at the start.
    pub fn stored_momentum_B(&self) -> Vec3<f64> {
        -self.system.quat_NB.to_matrix().transpose_mul(self.booked.from_actuator)
    }
    pub(crate) fn outside_wrench(
        &self,
        t: f64,
        k: &Kinematics<'_, f64, J>,
    ) -> PerBody<SpatialForce<f64>, J> {
        match &self.outside {
            Some(wrench) => wrench(self.period_start + t, k),
            None => PerBody::filled(SpatialForce::zero()),
        }
    }

    /// Advance by `period` (s): the period that the commands were set for, at once or in parts.
    ///
    /// # Errors
    /// If a number is no longer finite.
    pub fn advance(&mut self, period: f64) -> Result<(), NonFinite> {
        match self.stepper {
            Stepper::Fixed { step } => {
                let (count, h) = equal_steps(period, step);
                let mut done = 0.0;
                while done < count {
                    let t0 = self.into_period + done * h;
                    let d = runge_kutta_4(h, |t, d| self.rates(t0, t, d));
                    done += 1.0;
                    // The last step ends where the period does, to the bit.
                    let gone = if done < count { done * h } else { period };
                    self.accept(&d, self.into_period + gone)?;
                }
            }
            Stepper::Adaptive { tolerance } => self.advance_adaptively(period, tolerance)?,
        }
        self.into_period += period;
        add_with_care(&mut self.time, period, &mut self.time_carry);
        for body in &mut self.free {
            body.advance(period, self.stepper);
        }
        self.check_free_bodies()
    }

    fn advance_adaptively(&mut self, period: f64, tolerance: f64) -> Result<(), NonFinite> {
        let mut t0 = self.into_period;
        let end = self.into_period + period;
        let mut h = self.last_step.min(period);
        while t0 < end {
            let rest = end - t0;
            let last = h >= rest * (1.0 - 1e-12);
            let trial = if last { rest } else { h };
            let (d, error) = dormand_prince(trial, |t, d| self.rates(t0, t, d));
            let size = error.error_norm(tolerance).max(1e-10);
            // Order 5 in the step asks for the fifth root. The fourth finds the step as well, and
            // square roots are the same bits on every machine.
            let factor = (0.9 / size.sqrt().sqrt()).clamp(0.2, 5.0);
            if size <= 1.0 || !size.is_finite() {
                t0 = if last { end } else { t0 + trial };
                self.accept(&d, t0)?;
                if !last || factor < 1.0 {
                    self.last_step = trial * factor;
                }
                h = if last { h } else { trial * factor };
            } else {
                h = trial * factor;
            }
        }
        Ok(())
    }

    /// Add a displacement to the state, giving back what earlier sums lost; `t` (s) is where the
    /// set-points are then.
    fn accept(&mut self, d: &Flow<J>, t: f64) -> Result<(), NonFinite> {
        let (s, mut carry) = (&mut self.system, self.carry);
        s.quat_NB = turned_by(s.quat_NB, d.turn);
        let add = add_with_care;
        let add3 = |x: &mut Vec3<f64>, dx: Vec3<f64>, carry: &mut Vec3<f64>| {
            add(&mut x.x, dx.x, &mut carry.x);
            add(&mut x.y, dx.y, &mut carry.y);
            add(&mut x.z, dx.z, &mut carry.z);
        };
        for j in self.robot.joints() {
            if let Drive::Follow(motion) = &self.drives[j] {
                let set_point = motion.at(t);
                (s.q[j], s.v[j]) = (set_point.position, set_point.rate);
            } else {
                add(&mut s.q[j], d.q[j], &mut carry.q[j]);
                add(&mut s.v[j], d.v[j], &mut carry.v[j]);
            }
        }
        add3(&mut s.p_NScm_N, d.p_NScm_N, &mut carry.p_NScm_N);
        add3(&mut s.linear, d.linear, &mut carry.linear);
        add3(&mut s.angular, d.angular, &mut carry.angular);
        let b = &mut self.booked;
        add3(&mut b.linear, d.linear, &mut Vec3::zero());
        add3(&mut b.from_actuator, d.from_actuator, &mut carry.from_actuator);
        add3(&mut b.from_outside, d.from_outside, &mut carry.from_outside);
        add3(&mut b.work, d.work, &mut carry.work);
        self.carry = carry;
        self.check_finite(t)
    }

    fn check_finite(&self, t: f64) -> Result<(), NonFinite> {
        let time = self.period_start + t;
        let fail = |quantity: String, joint| Err(NonFinite { quantity, joint, time });
        let s = &self.system;
        for j in self.robot.joints() {
            if !(s.q[j].is_finite() && s.v[j].is_finite()) {
                return fail(format!("position or rate of joint {j}"), Some(j));
            }
        }
        for (name, v) in [
            ("attitude of the base", s.quat_NB.vector()),
            ("centre of mass", s.p_NScm_N),
            ("linear momentum", s.linear),
            ("angular momentum", s.angular),
        ] {
            if !is_finite(v) {
                return fail(name.into(), None);
            }
        }
        Ok(())
    }

    fn check_free_bodies(&self) -> Result<(), NonFinite> {
        for (i, body) in self.free.iter().enumerate() {
            for (name, v) in
                [("attitude", body.quat_NT.vector()), ("centre of mass", body.p_NTcm_N)]
            {
                if !is_finite(v) {
                    let quantity = format!("{name} of free body {i}");
                    return Err(NonFinite { quantity, joint: None, time: self.time });
                }
            }
        }
        Ok(())
    }

    /// Pose `X_NF` of a frame now.
    pub fn pose(&self, frame: &Frame<f64>) -> Pose<f64> {
        kinematics(&self.robot, &self.state()).pose(frame)
    }
}

/// `x += dx`, giving back what the last sum lost (Kahan).
fn add_with_care(x: &mut f64, dx: f64, carry: &mut f64) {
    let y = dx - *carry;
    let sum = *x + y;
    *carry = (sum - *x) - y;
    *x = sum;
}

fn is_finite(v: Vec3<f64>) -> bool {
    v.to_array().iter().all(|x| x.is_finite())
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
