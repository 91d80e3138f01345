//! Turns about an axis of the frame: rotations that take four products for a vector, not nine.

use crate::{Real, Vec3, vec3};

/// Sine and cosine of an angle that something turns through.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Turn<T> {
    /// Sine (–).
    pub sin: T,
    /// Cosine (–).
    pub cos: T,
}

impl<T: Real> Turn<T> {
    /// No turn.
    #[inline(always)]
    pub fn none() -> Self {
        Self { sin: T::zero(), cos: T::one() }
    }
    /// By an angle (rad).
    #[inline(always)]
    pub fn by(angle: T) -> Self {
        let (sin, cos) = angle.sin_cos();
        Self { sin, cos }
    }
    /// The opposite turn.
    #[inline(always)]
    #[must_use]
    pub fn back(&self) -> Self {
        Self { sin: -self.sin, cos: self.cos }
    }
    /// Each element converted from `f64`.
    #[inline(always)]
    pub fn from_f64(turn: &Turn<f64>) -> Self {
        Self { sin: T::from_f64(turn.sin), cos: T::from_f64(turn.cos) }
    }
    /// The point (a, b) of a plane, turned.
    #[inline(always)]
    fn plane(&self, a: T, b: T) -> (T, T) {
        (self.cos * a - self.sin * b, self.sin * a + self.cos * b)
    }
}

impl<T: Real> Vec3<T> {
    /// Turned about x.
    #[inline(always)]
    #[must_use]
    pub fn about_x(&self, turn: &Turn<T>) -> Self {
        let (y, z) = turn.plane(self.y, self.z);
        vec3(self.x, y, z)
    }
    /// Turned about z.
    #[inline(always)]
    #[must_use]
    pub fn about_z(&self, turn: &Turn<T>) -> Self {
        let (x, y) = turn.plane(self.x, self.y);
        vec3(x, y, self.z)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ANGLE: f64 = 0.7;

    #[test]
    fn a_quarter_turn_follows_the_right_hand() {
        let quarter = Turn { sin: 1.0, cos: 0.0 };
        assert_eq!(vec3(1.0, 2.0, 3.0).about_z(&quarter), vec3(-2.0, 1.0, 3.0));
        assert_eq!(vec3(1.0, 2.0, 3.0).about_x(&quarter), vec3(1.0, -3.0, 2.0));
    }

    /// Two roundings in each component. Measured 2.2e-16.
    #[test]
    fn a_turn_back_undoes_a_turn() {
        let (turn, v) = (Turn::by(ANGLE), vec3(0.3, -0.4, 0.5));
        let again = v.about_x(&turn).about_z(&turn).about_z(&turn.back()).about_x(&turn.back());
        assert!((again - v).norm() < 1e-15, "{again:?}");
    }
}
