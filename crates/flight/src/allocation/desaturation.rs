//! Desaturation: thrusters take from wheels and CMGs the momentum that they hold.

use wrasse_spatial::{Scalar, Vec3};

/// When desaturation starts and stops, and how fast it goes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Desaturation<T> {
    /// What wheels and CMGs should hold, base axes (N·m·s).
    pub target_B: Vec3<T>,
    /// Rate at which what is beyond the target fades (1/s).
    pub gain: T,
    /// It starts when more than this is beyond the target (N·m·s).
    pub start: T,
    /// It stops when less than this is (N·m·s).
    pub stop: T,
    /// Whether it is going on.
    pub active: bool,
}

impl<T: Scalar> Desaturation<T> {
    /// Torque that the thrusters should exert on the vehicle, base axes (N·m).
    ///
    /// Wheels and CMGs must give the opposite, and so lose what they hold. `stored_B` is the
    /// momentum of wheels and CMGs against the base (N·m·s).
    pub fn torque(&mut self, stored_B: Vec3<T>) -> Vec3<T> {
        let beyond = stored_B - self.target_B;
        let size = beyond.norm();
        // NaN compares as neither: nothing starts, and what goes on ends.
        self.active = if self.active { size >= self.stop } else { size > self.start };
        if self.active { -(beyond * self.gain) } else { Vec3::zero() }
    }
}
