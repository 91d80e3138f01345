//! What moves in one step: the displacement of the whole state.

use crate::stepper::{Displacement, Judged};
use wrasse_hardware::{CMGS, WHEELS};
use wrasse_spatial::{Real, Vec3};

/// Displacement of the system's state over part of a step, or its rate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Flow<const J: usize, T = f64> {
    /// Rotation vector of the base since the start of the step, body axes (rad).
    pub turn: Vec3<T>,
    /// Joint positions (rad or m).
    pub q: [T; J],
    /// Joint rates (rad/s or m/s).
    pub v: [T; J],
    /// Centre of mass, inertial axes (m).
    pub p_NScm_N: Vec3<T>,
    /// Linear momentum, inertial axes (N·s).
    pub linear: Vec3<T>,
    /// Angular momentum of bodies, wheels and CMGs about their centre of mass, inertial axes
    /// (N·m·s).
    pub angular: Vec3<T>,
    /// Momentum of each wheel about its own axis, as seen from inertial space (N·m·s).
    pub wheel_momentum: [T; WHEELS],
    /// Angle of each gimbal (rad).
    pub gimbal_angle: [T; CMGS],
    /// Rate of each gimbal (rad/s).
    pub gimbal_rate: [T; CMGS],
    /// Angular impulse of the attitude actuator on the bodies, inertial axes (N·m·s).
    pub from_actuator: Vec3<T>,
    /// Angular impulse from outside about the common centre of mass of the vehicle and the free
    /// bodies, inertial axes (N·m·s).
    pub from_outside: Vec3<T>,
    /// Impulse from outside, inertial axes (N·s).
    pub outside_impulse: Vec3<T>,
    /// Angular impulse of the thrusters, about the same point as that from outside (N·m·s).
    pub from_thrusters: Vec3<T>,
    /// Impulse of the thrusters, inertial axes (N·s).
    pub thruster_impulse: Vec3<T>,
    /// Work on the bodies: of the joint drives, of whatever turns and pushes the base, and from
    /// outside (J).
    pub work: Vec3<T>,
}

impl<const J: usize, T: Real> Flow<J, T> {
    /// Each component of two flows by a function.
    #[inline(always)]
    #[must_use]
    pub fn zip(&self, other: &Self, f: impl Fn(T, T) -> T) -> Self {
        let v = |a: Vec3<T>, b: Vec3<T>| Vec3 { x: f(a.x, b.x), y: f(a.y, b.y), z: f(a.z, b.z) };
        Self {
            turn: v(self.turn, other.turn),
            q: core::array::from_fn(|j| f(self.q[j], other.q[j])),
            v: core::array::from_fn(|j| f(self.v[j], other.v[j])),
            p_NScm_N: v(self.p_NScm_N, other.p_NScm_N),
            linear: v(self.linear, other.linear),
            angular: v(self.angular, other.angular),
            wheel_momentum: core::array::from_fn(|i| {
                f(self.wheel_momentum[i], other.wheel_momentum[i])
            }),
            gimbal_angle: core::array::from_fn(|i| f(self.gimbal_angle[i], other.gimbal_angle[i])),
            gimbal_rate: core::array::from_fn(|i| f(self.gimbal_rate[i], other.gimbal_rate[i])),
            from_actuator: v(self.from_actuator, other.from_actuator),
            from_outside: v(self.from_outside, other.from_outside),
            outside_impulse: v(self.outside_impulse, other.outside_impulse),
            from_thrusters: v(self.from_thrusters, other.from_thrusters),
            thruster_impulse: v(self.thruster_impulse, other.thruster_impulse),
            work: v(self.work, other.work),
        }
    }
}

impl<const J: usize, T: Real> Displacement for Flow<J, T> {
    #[inline(always)]
    fn zero() -> Self {
        let o = Vec3::zero();
        Self {
            turn: o,
            q: [T::zero(); J],
            v: [T::zero(); J],
            p_NScm_N: o,
            linear: o,
            angular: o,
            wheel_momentum: [T::zero(); WHEELS],
            gimbal_angle: [T::zero(); CMGS],
            gimbal_rate: [T::zero(); CMGS],
            from_actuator: o,
            from_outside: o,
            outside_impulse: o,
            from_thrusters: o,
            thruster_impulse: o,
            work: o,
        }
    }
    #[inline(always)]
    fn plus(&self, h: f64, rate: &Self) -> Self {
        let h = T::from_f64(h);
        self.zip(rate, |a, b| a + h * b)
    }
}

impl<const J: usize> Judged for Flow<J> {
    fn error_norm(&self, tolerance: f64) -> f64 {
        // The state, and what is booked: where joints are prescribed only the books see a step that
        // is too long.
        let vectors = [
            self.turn,
            self.p_NScm_N,
            self.linear,
            self.angular,
            self.from_actuator,
            self.from_outside,
            self.outside_impulse,
            self.from_thrusters,
            self.thruster_impulse,
            self.work,
        ];
        let vectors = vectors.into_iter().flat_map(Vec3::to_array);
        let gimbals = self.gimbal_angle.into_iter().chain(self.gimbal_rate);
        let all = vectors.chain(self.q).chain(self.v).chain(self.wheel_momentum).chain(gimbals);
        all.fold(0.0, |m: f64, x| m.max(x.abs())) / tolerance
    }
}
