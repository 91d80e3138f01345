//! Things made of numbers, and how far two of them are apart; a NaN is never dropped.

use crate::worst::{larger, largest};
use nalgebra::{DMatrix, DVector};
use wrasse_dynamics::Generalized;
use wrasse_spatial::{Mat3, Pose, SpatialForce, SpatialVelocity, Vec3};

/// Something made of numbers.
pub trait Numbers {
    /// All of them, in order.
    fn numbers(&self) -> Vec<f64>;
}
impl Numbers for f64 {
    fn numbers(&self) -> Vec<f64> {
        vec![*self]
    }
}
impl Numbers for Vec3<f64> {
    fn numbers(&self) -> Vec<f64> {
        self.to_array().to_vec()
    }
}
impl Numbers for Mat3<f64> {
    fn numbers(&self) -> Vec<f64> {
        self.rows.numbers()
    }
}
impl Numbers for Pose<f64> {
    fn numbers(&self) -> Vec<f64> {
        [self.rotation.numbers(), self.translation.numbers()].concat()
    }
}
impl Numbers for SpatialVelocity<f64> {
    fn numbers(&self) -> Vec<f64> {
        self.to_array().to_vec()
    }
}
impl Numbers for SpatialForce<f64> {
    fn numbers(&self) -> Vec<f64> {
        self.to_array().to_vec()
    }
}
impl<E: Numbers, const N: usize> Numbers for [E; N] {
    fn numbers(&self) -> Vec<f64> {
        self.iter().flat_map(Numbers::numbers).collect()
    }
}
impl<E: Numbers> Numbers for Vec<E> {
    fn numbers(&self) -> Vec<f64> {
        self.iter().flat_map(Numbers::numbers).collect()
    }
}
impl<B: Numbers, const N: usize> Numbers for Generalized<B, f64, N> {
    fn numbers(&self) -> Vec<f64> {
        [self.base.numbers(), self.joints.to_vec()].concat()
    }
}
impl Numbers for DMatrix<f64> {
    fn numbers(&self) -> Vec<f64> {
        self.as_slice().to_vec()
    }
}
impl Numbers for DVector<f64> {
    fn numbers(&self) -> Vec<f64> {
        self.as_slice().to_vec()
    }
}

/// Largest element.
pub fn size(a: &impl Numbers) -> f64 {
    largest(a.numbers().into_iter().map(f64::abs))
}

/// Largest difference, relative to the largest element of either.
pub fn gap(a: &impl Numbers, b: &impl Numbers) -> f64 {
    gap_at(a, b, larger(size(a), size(b)))
}

/// Largest difference relative to a scale: where both sides are sums of terms that cancel.
pub fn gap_at(a: &impl Numbers, b: &impl Numbers, scale: f64) -> f64 {
    let (a, b) = (a.numbers(), b.numbers());
    assert_eq!(a.len(), b.len(), "as many numbers on either side");
    let worst = largest(a.iter().zip(&b).map(|(x, y)| (x - y).abs()));
    if worst == 0.0 { 0.0 } else { worst / scale }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_nan_on_either_side_is_no_agreement() {
        let (good, bad) = (vec![1.0, 2.0, 3.0], vec![1.0, f64::NAN, 3.0]);
        assert!(size(&bad).is_nan());
        for (a, b) in [(&good, &bad), (&bad, &good), (&bad, &bad)] {
            assert!(gap(a, b).is_nan() && gap_at(a, b, 1.0).is_nan());
        }
        // A scale that is none spoils what is measured by it, unless nothing is off at all.
        assert!(gap_at(&good, &vec![1.0, 2.0, 3.5], f64::NAN).is_nan());
        assert_eq!((gap(&good, &good), gap_at(&good, &vec![1.0, 2.0, 4.0], 2.0)), (0.0, 0.5));
    }
}
