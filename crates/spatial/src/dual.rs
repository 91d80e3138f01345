//! Dual numbers: a value and its exact derivative, carried through any kernel of this workspace.

use crate::{Real, Work};
use core::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

/// `value + derivative·ε` with ε² = 0.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Dual<T> {
    /// The value.
    pub value: T,
    /// Its derivative with respect to the one parameter that is varied.
    pub derivative: T,
}

impl<T: Real> Dual<T> {
    /// A value that changes at the given rate.
    #[inline(always)]
    pub fn new(value: T, derivative: T) -> Self {
        Self { value, derivative }
    }
}

impl<T: Real> Add for Dual<T> {
    type Output = Self;
    #[inline(always)]
    fn add(self, b: Self) -> Self {
        Self::new(self.value + b.value, self.derivative + b.derivative)
    }
}
impl<T: Real> Sub for Dual<T> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, b: Self) -> Self {
        Self::new(self.value - b.value, self.derivative - b.derivative)
    }
}
impl<T: Real> Mul for Dual<T> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, b: Self) -> Self {
        Self::new(self.value * b.value, self.derivative * b.value + self.value * b.derivative)
    }
}
impl<T: Real> Div for Dual<T> {
    type Output = Self;
    #[inline(always)]
    fn div(self, b: Self) -> Self {
        let value = self.value / b.value;
        Self::new(value, (self.derivative - value * b.derivative) / b.value)
    }
}
impl<T: Real> Neg for Dual<T> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self::new(-self.value, -self.derivative)
    }
}
impl<T: Real> AddAssign for Dual<T> {
    #[inline(always)]
    fn add_assign(&mut self, b: Self) {
        *self = *self + b;
    }
}
impl<T: Real> SubAssign for Dual<T> {
    #[inline(always)]
    fn sub_assign(&mut self, b: Self) {
        *self = *self - b;
    }
}
impl<T: Real> MulAssign for Dual<T> {
    #[inline(always)]
    fn mul_assign(&mut self, b: Self) {
        *self = *self * b;
    }
}

impl<T: Real> Real for Dual<T> {
    type Mask = T::Mask;
    #[inline(always)]
    fn from_f64(x: f64) -> Self {
        Self::new(T::from_f64(x), T::zero())
    }
    #[inline(always)]
    fn epsilon() -> Self {
        Self::new(T::epsilon(), T::zero())
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        Self::new(root, self.derivative / (root + root))
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let (s, c) = self.value.sin_cos();
        (Self::new(s, c * self.derivative), Self::new(c, -s * self.derivative))
    }
    #[inline(always)]
    fn atan2(self, x: Self) -> Self {
        let square = self.value * self.value + x.value * x.value;
        let turn = x.value * self.derivative - self.value * x.derivative;
        Self::new(self.value.atan2(x.value), turn / square)
    }
    #[inline(always)]
    fn lt(self, other: Self) -> Self::Mask {
        self.value.lt(other.value)
    }
    #[inline(always)]
    fn select(mask: Self::Mask, a: Self, b: Self) -> Self {
        Self::new(T::select(mask, a.value, b.value), T::select(mask, a.derivative, b.derivative))
    }
    #[inline(always)]
    fn apart<W: Work>(work: W) -> W::Out {
        T::apart(work)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A variable at 0.7.
    fn x() -> Dual<f64> {
        Dual::new(0.7, 1.0)
    }

    fn c(value: f64) -> Dual<f64> {
        Dual::from_f64(value)
    }

    #[track_caller]
    fn check(found: Dual<f64>, value: f64, derivative: f64) {
        assert!((found.value - value).abs() < 1e-15, "{found:?}, not {value}");
        assert!((found.derivative - derivative).abs() < 1e-15, "{found:?}, not {derivative}");
    }

    /// Each rule by hand. Round-off: measured 1e-16.
    #[test]
    fn each_operation_carries_its_derivative() {
        check(x() + x(), 1.4, 2.0);
        check(x() - c(0.2), 0.5, 1.0);
        check(c(0.2) - x(), -0.5, -1.0);
        check(x() * x(), 0.49, 1.4);
        check(c(1.0) / x(), 1.0 / 0.7, -1.0 / 0.49);
        check(x() / (x() + c(1.0)), 0.7 / 1.7, 1.0 / (1.7 * 1.7));
        check(-x(), -0.7, -1.0);
        check(x().sqrt(), 0.7_f64.sqrt(), 0.5 / 0.7_f64.sqrt());
        let (s, c) = x().sin_cos();
        check(s, 0.7_f64.sin(), 0.7_f64.cos());
        check((x() * x()).atan2(x()), 0.7_f64.atan(), 1.0 / 1.49);
        check(x().atan2(x() * x()), (1.0 / 0.7_f64).atan(), -1.0 / 1.49);
        check(c, 0.7_f64.cos(), -0.7_f64.sin());
    }

    #[test]
    fn assignments_carry_their_derivative() {
        let mut y = x();
        y += x();
        check(y, 1.4, 2.0);
        y -= c(0.4);
        check(y, 1.0, 2.0);
        y *= x();
        check(y, 0.7, 2.4);
    }

    #[test]
    fn a_choice_keeps_the_derivative_of_what_is_chosen() {
        check((-x()).abs(), 0.7, 1.0);
        check(x().max(c(0.9)), 0.9, 0.0);
        check(x().min(c(0.9)), 0.7, 1.0);
    }
}
