//! The scalar that the core is written over: `f64`, `f32`, duals, and lanes.

use crate::trigonometry::{sin_cos_f32, sin_cos_f64};
use crate::{Kernel, Lanes, OneByOne, Work};
use core::fmt::Debug;
use core::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

mod sealed {
    pub trait Sealed {}
    impl Sealed for f64 {}
    impl Sealed for f32 {}
    impl<T: Sealed> Sealed for crate::Dual<T> {}
    impl<const N: usize, I: crate::Instructions> Sealed for crate::Lanes<N, I> {}
    #[cfg(feature = "counted")]
    impl Sealed for crate::Counted {}
    #[cfg(target_arch = "x86_64")]
    impl Sealed for crate::wide::Two {}
    #[cfg(target_arch = "x86_64")]
    impl Sealed for crate::wide::Four {}
}

/// A real number, or several of them side by side. Kernels never branch on its value: they
/// [`select`](Real::select), so that many numbers at a time take the same way.
pub trait Real:
    sealed::Sealed
    + Copy
    + Default
    + Debug
    + PartialEq
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
    + MulAssign
    + 'static
{
    /// The answer to a comparison (`bool` for one number).
    type Mask: Copy;
    /// The nearest representable number.
    fn from_f64(x: f64) -> Self;
    /// Distance from one to the next larger number (–): what round-off is measured in.
    #[must_use]
    fn epsilon() -> Self;
    /// Square root.
    #[must_use]
    fn sqrt(self) -> Self;
    /// Sine and cosine of an angle (rad), from one portable source: within one unit in the last place
    /// of the result (`f64`), within one unit in the last place of 1 (`f32`).
    fn sin_cos(self) -> (Self, Self);
    /// Angle of the point (x, y) = (`x`, `self`), rad in (-π, π].
    #[must_use]
    fn atan2(self, x: Self) -> Self;
    /// `self < other`.
    fn lt(self, other: Self) -> Self::Mask;
    /// `a` where the mask holds, else `b`.
    #[must_use]
    fn select(mask: Self::Mask, a: Self, b: Self) -> Self;

    /// Do a long piece of work as a function of its own, built for the instructions that these numbers
    /// are worked with; for a single number it is done on the spot.
    ///
    /// Short functions over `Self` are `#[inline(always)]`, long ones go apart. What is neither is
    /// built for any processor: right, but slow in lanes.
    #[inline(always)]
    fn apart<W: Work>(work: W) -> W::Out {
        work.run()
    }
    /// Run an algorithm over links, in the layout that these numbers are quickest in on this processor.
    #[inline(always)]
    fn dispatch<K: Kernel<Self>>(kernel: K) -> K::Out {
        kernel.run::<OneByOne<Self>>()
    }
    /// Sines and cosines of the first `count` angles (rad), zeros behind them.
    #[inline(always)]
    fn sin_cos_each<const J: usize>(angles: &[Self; J], count: usize) -> ([Self; J], [Self; J]) {
        let (mut sin, mut cos) = ([Self::zero(); J], [Self::zero(); J]);
        for j in 0..count.min(J) {
            (sin[j], cos[j]) = angles[j].sin_cos();
        }
        (sin, cos)
    }
    /// Zero.
    #[inline(always)]
    #[must_use]
    fn zero() -> Self {
        Self::from_f64(0.0)
    }
    /// One.
    #[inline(always)]
    #[must_use]
    fn one() -> Self {
        Self::from_f64(1.0)
    }
    /// Magnitude.
    #[inline(always)]
    #[must_use]
    fn abs(self) -> Self {
        Self::select(self.lt(Self::zero()), -self, self)
    }
    /// The larger of two.
    #[inline(always)]
    #[must_use]
    fn max(self, other: Self) -> Self {
        Self::select(self.lt(other), other, self)
    }
    /// The smaller of two.
    #[inline(always)]
    #[must_use]
    fn min(self, other: Self) -> Self {
        Self::select(other.lt(self), other, self)
    }
    /// Held between `-limit` and `limit`.
    #[inline(always)]
    #[must_use]
    fn clamp_to(self, limit: Self) -> Self {
        self.min(limit).max(-limit)
    }
}

/// A single real number: code that may decide on a value (planning, inverse kinematics).
pub trait Scalar: Real<Mask = bool> + PartialOrd {
    /// As `f64`.
    fn to_f64(self) -> f64;
    /// Inverse cosine (rad); the argument must lie in [-1, 1].
    #[must_use]
    fn acos(self) -> Self;
    /// `e` to this power.
    #[must_use]
    fn exp(self) -> Self;
    /// Natural logarithm; the argument must be positive.
    #[must_use]
    fn ln(self) -> Self;
    /// Neither infinite nor NaN.
    fn is_finite(self) -> bool;
}

macro_rules! float {
    ($float:ty, $sqrt:path, $sin_cos:path, $atan2:path, $acos:path, $exp:path, $ln:path, {$($more:tt)*}) => {
        impl Real for $float {
            type Mask = bool;
            #[inline(always)]
            #[allow(clippy::cast_possible_truncation, reason = "f32 is asked for")]
            fn from_f64(x: f64) -> Self {
                x as $float
            }
            #[inline(always)]
            fn epsilon() -> Self {
                <$float>::EPSILON
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                $sqrt(self)
            }
            #[inline(always)]
            fn sin_cos(self) -> (Self, Self) {
                $sin_cos(self)
            }
            #[inline(always)]
            fn atan2(self, x: Self) -> Self {
                $atan2(self, x)
            }
            #[inline(always)]
            fn lt(self, other: Self) -> bool {
                self < other
            }
            #[inline(always)]
            fn select(mask: bool, a: Self, b: Self) -> Self {
                if mask { a } else { b }
            }
            $($more)*
        }
        impl Scalar for $float {
            fn to_f64(self) -> f64 {
                f64::from(self)
            }
            fn acos(self) -> Self {
                $acos(self)
            }
            fn exp(self) -> Self {
                $exp(self)
            }
            fn ln(self) -> Self {
                $ln(self)
            }
            fn is_finite(self) -> bool {
                <$float>::is_finite(self)
            }
        }
    };
}
float!(f64, libm::sqrt, sin_cos_f64, libm::atan2, libm::acos, libm::exp, libm::log, {
    #[cfg(target_arch = "x86_64")]
    #[inline(always)]
    fn dispatch<K: Kernel<f64>>(kernel: K) -> K::Out {
        crate::wide::dispatch(kernel)
    }
    /// Eight angles at a time, as the lanes of one call.
    #[inline(always)]
    fn sin_cos_each<const J: usize>(angles: &[f64; J], count: usize) -> ([f64; J], [f64; J]) {
        let (mut sin, mut cos) = ([0.0; J], [0.0; J]);
        for first in (0..count.min(J)).step_by(8) {
            let mut some = Lanes::<8>::default();
            for (lane, angle) in some.0.iter_mut().zip(&angles[first..]) {
                *lane = *angle;
            }
            let (s, c) = some.sin_cos();
            let out = sin[first..].iter_mut().zip(&mut cos[first..]);
            for ((sin, cos), (s, c)) in out.zip(s.0.iter().zip(&c.0)) {
                (*sin, *cos) = (*s, *c);
            }
        }
        (sin, cos)
    }
});
float!(f32, libm::sqrtf, sin_cos_f32, libm::atan2f, libm::acosf, libm::expf, libm::logf, {});

#[cfg(test)]
mod tests {
    use super::*;

    fn chosen<T: Scalar>() {
        let t = T::from_f64;
        assert_eq!((t(-2.5).abs(), t(2.5).abs()), (t(2.5), t(2.5)));
        assert_eq!((t(1.0).max(t(2.0)), t(1.0).min(t(2.0))), (t(2.0), t(1.0)));
        assert_eq!((t(2.0).max(t(1.0)), t(2.0).min(t(1.0))), (t(2.0), t(1.0)));
        let held = [-9.0, -0.5, 0.5, 9.0].map(|x| t(x).clamp_to(T::one()));
        assert_eq!(held, [-1.0, -0.5, 0.5, 1.0].map(t));
        assert!(T::one() + T::epsilon() > T::one());
        assert_eq!(T::one() + T::epsilon() * t(0.5), T::one());
        assert!(!(T::one() / T::zero()).is_finite() && T::one().is_finite());
    }

    #[test]
    fn both_floats_choose_alike() {
        chosen::<f64>();
        chosen::<f32>();
    }

    /// libm against the host's own functions: within two units in the last place of 1.
    #[test]
    fn elementary_functions_are_those_of_the_textbook() {
        for k in -40..=40 {
            let x = 0.3 * f64::from(k);
            let (s, c) = Real::sin_cos(x);
            assert!((s - f64::sin(x)).abs() < 3e-16 && (c - f64::cos(x)).abs() < 3e-16);
            assert!((Real::atan2(s, c) - f64::atan2(s, c)).abs() < 1e-15);
            assert!((Scalar::acos(c) - f64::acos(c)).abs() < 1e-15);
            assert!((Scalar::exp(x) / f64::exp(x) - 1.0).abs() < 1e-15);
            assert!((Scalar::ln(f64::exp(x)) - x).abs() < 1e-14);
            assert!((Real::sqrt(x * x) - x.abs()).abs() < 1e-14);
        }
    }
}
