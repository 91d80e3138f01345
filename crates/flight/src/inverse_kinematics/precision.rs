//! How fine the scalar is.

use wrasse_spatial::Scalar;

/// Distance from one to the next larger number: 2⁻⁵² or 2⁻²³.
pub(super) fn epsilon<T: Scalar>() -> T {
    let double = T::from_f64(f64::EPSILON);
    let single = T::from_f64(f64::from(f32::EPSILON));
    if T::one() + double > T::one() { double } else { single }
}

#[cfg(test)]
mod tests {
    use super::epsilon;

    #[test]
    fn the_precision_is_that_of_the_scalar() {
        assert_eq!(epsilon::<f64>(), f64::EPSILON);
        assert_eq!(epsilon::<f32>(), f32::EPSILON);
    }
}
