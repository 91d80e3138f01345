//! What moves in one step: the displacement of the whole state.

use crate::stepper::Displacement;
use wrasse_spatial::Vec3;

/// Displacement of the system's state over part of a step, or its rate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Flow<const J: usize> {
    /// Rotation vector of the base since the start of the step, body axes (rad).
    pub turn: Vec3<f64>,
    /// Joint positions (rad or m).
    pub q: [f64; J],
    /// Joint rates (rad/s or m/s).
    pub v: [f64; J],
    /// Centre of mass, inertial axes (m).
    pub p_NScm_N: Vec3<f64>,
    /// Linear momentum, inertial axes (N·s).
    pub linear: Vec3<f64>,
    /// Angular momentum of the bodies about their centre of mass, inertial axes (N·m·s).
    pub angular: Vec3<f64>,
    /// Angular impulse of the attitude actuator on the bodies, inertial axes (N·m·s).
    pub from_actuator: Vec3<f64>,
    /// Angular impulse from outside about the common centre of mass of the vehicle and the free
    /// bodies, inertial axes (N·m·s).
    pub from_outside: Vec3<f64>,
    /// Work of the joint drives, of the attitude actuator, and from outside (J).
    pub work: Vec3<f64>,
}

impl<const J: usize> Flow<J> {
    /// Each component of two flows by a function.
    #[inline(always)]
    #[must_use]
    pub fn zip(&self, other: &Self, f: impl Fn(f64, f64) -> f64) -> Self {
        let v =
            |a: Vec3<f64>, b: Vec3<f64>| Vec3 { x: f(a.x, b.x), y: f(a.y, b.y), z: f(a.z, b.z) };
        Self {
            turn: v(self.turn, other.turn),
            q: core::array::from_fn(|j| f(self.q[j], other.q[j])),
            v: core::array::from_fn(|j| f(self.v[j], other.v[j])),
            p_NScm_N: v(self.p_NScm_N, other.p_NScm_N),
            linear: v(self.linear, other.linear),
            angular: v(self.angular, other.angular),
            from_actuator: v(self.from_actuator, other.from_actuator),
            from_outside: v(self.from_outside, other.from_outside),
            work: v(self.work, other.work),
        }
    }
}

impl<const J: usize> Displacement for Flow<J> {
    #[inline(always)]
    fn zero() -> Self {
        let o = Vec3::zero();
        Self {
            turn: o,
            q: [0.0; J],
            v: [0.0; J],
            p_NScm_N: o,
            linear: o,
            angular: o,
            from_actuator: o,
            from_outside: o,
            work: o,
        }
    }
    #[inline(always)]
    fn plus(&self, h: f64, rate: &Self) -> Self {
        self.zip(rate, |a, b| a + h * b)
    }
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
            self.work,
        ];
        let vectors = vectors.into_iter().flat_map(Vec3::to_array);
        let all = vectors.chain(self.q).chain(self.v);
        all.fold(0.0, |m: f64, x| m.max(x.abs())) / tolerance
    }
}
