//! Reaction wheels.

use wrasse_spatial::{Real, Vec3};

/// Most reaction wheels of one vehicle.
pub const WHEELS: usize = 8;

/// A reaction wheel. Its matter is part of the base's; its motor turns it against the base.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct ReactionWheel<T> {
    /// Unit spin axis, base axes (–).
    pub axis_B: Vec3<T>,
    /// Inertia about the spin axis (kg·m²).
    pub inertia: T,
    /// Largest torque of the motor (N·m).
    pub torque_limit: T,
    /// Largest speed against the base (rad/s).
    pub speed_limit: T,
    /// Coulomb friction of the bearing (N·m).
    pub coulomb: T,
    /// Viscous friction of the bearing (N·m·s/rad).
    pub viscous: T,
    /// Torque commands are rounded to multiples of this (N·m); zero: not rounded.
    pub torque_step: T,
}

impl<T: Real> ReactionWheel<T> {
    /// Momentum at the largest speed (N·m·s).
    pub fn momentum_limit(&self) -> T {
        self.inertia * self.speed_limit
    }
}

impl ReactionWheel<f64> {
    /// The same wheel over another scalar.
    pub fn cast<T: Real>(&self) -> ReactionWheel<T> {
        let c = T::from_f64;
        ReactionWheel {
            axis_B: self.axis_B.map(c),
            inertia: c(self.inertia),
            torque_limit: c(self.torque_limit),
            speed_limit: c(self.speed_limit),
            coulomb: c(self.coulomb),
            viscous: c(self.viscous),
            torque_step: c(self.torque_step),
        }
    }
}
