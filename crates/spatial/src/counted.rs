//! A number that counts the operations done with it: how many a kernel takes, for comparison with
//! what a processor could do.

use crate::Real;
use core::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};
use core::sync::atomic::{AtomicUsize, Ordering};

static OPERATIONS: AtomicUsize = AtomicUsize::new(0);

/// An `f64` whose additions, subtractions, multiplications, divisions and square roots are counted.
/// The count is the program's: count one kernel at a time.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Counted(pub f64);

impl Counted {
    /// Operations that `work` takes, and what comes of it.
    pub fn operations<R>(work: impl FnOnce() -> R) -> (usize, R) {
        let before = OPERATIONS.load(Ordering::Relaxed);
        let result = work();
        (OPERATIONS.load(Ordering::Relaxed) - before, result)
    }
}

fn counted(x: f64) -> Counted {
    OPERATIONS.fetch_add(1, Ordering::Relaxed);
    Counted(x)
}

macro_rules! operator {
    ($trait:ident, $method:ident, $assign:ident, $assign_method:ident, $sign:tt) => {
        impl $trait for Counted {
            type Output = Self;
            fn $method(self, b: Self) -> Self {
                counted(self.0 $sign b.0)
            }
        }
        impl $assign for Counted {
            fn $assign_method(&mut self, b: Self) {
                *self = *self $sign b;
            }
        }
    };
}
operator!(Add, add, AddAssign, add_assign, +);
operator!(Sub, sub, SubAssign, sub_assign, -);
operator!(Mul, mul, MulAssign, mul_assign, *);

impl Div for Counted {
    type Output = Self;
    fn div(self, b: Self) -> Self {
        counted(self.0 / b.0)
    }
}
impl Neg for Counted {
    type Output = Self;
    fn neg(self) -> Self {
        // A sign costs nothing that counts.
        Self(-self.0)
    }
}

impl Real for Counted {
    type Mask = bool;
    fn from_f64(x: f64) -> Self {
        Self(x)
    }
    fn epsilon() -> Self {
        Self(f64::EPSILON)
    }
    fn sqrt(self) -> Self {
        counted(Real::sqrt(self.0))
    }
    fn sin_cos(self) -> (Self, Self) {
        crate::trigonometry::near_sin_cos(self)
    }
    fn atan2(self, x: Self) -> Self {
        counted(Real::atan2(self.0, x.0))
    }
    fn lt(self, other: Self) -> bool {
        self.0 < other.0
    }
    fn select(mask: bool, a: Self, b: Self) -> Self {
        if mask { a } else { b }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vec3;

    /// Three products and two sums; nine operations in a cross product.
    #[test]
    fn a_dot_takes_five_operations_and_a_cross_nine() {
        let a = vec3(Counted(1.0), Counted(2.0), Counted(3.0));
        assert_eq!(Counted::operations(|| a.dot(a)), (5, Counted(14.0)));
        assert_eq!(Counted::operations(|| a.cross(a)).0, 9);
    }
}
