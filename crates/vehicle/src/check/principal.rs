//! The principal axes of a tensor, and how far matter lies from its centre along them.

use nalgebra::{Matrix3, SymmetricEigen};
use wrasse_spatial::{Sym3, Vec3};

/// When to give up on axes: nalgebra goes on until it converges unless told; a 3×3 takes about ten steps.
const MOST_ITERATIONS: usize = 100;

/// A direction in a body, and how its matter lies to it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PrincipalAxis {
    /// Unit vector (–); the first component that counts is positive.
    pub(crate) along: Vec3<f64>,
    /// Mean square of the distance from the centre of mass along it (m²).
    pub(crate) spread: f64,
    /// Radius of gyration about it (m).
    pub(crate) gyration: f64,
}

/// The principal axes of a mass (kg) with this central inertia (kg·m²), the one along which the matter
/// lies farthest first: that is the axis of the least moment. None where there is no mass, or no axes
/// are found.
pub(crate) fn principal_axes(mass: f64, inertia: Sym3<f64>) -> Option<[PrincipalAxis; 3]> {
    let I = inertia.scaled(1.0 / mass);
    let matrix = Matrix3::new(I.xx, I.xy, I.xz, I.xy, I.yy, I.yz, I.xz, I.yz, I.zz);
    if mass <= 0.0 || !matrix.iter().all(|x| x.is_finite()) {
        return None;
    }
    let eigen = SymmetricEigen::try_new(matrix, f64::EPSILON, MOST_ITERATIONS)?;
    let trace: f64 = eigen.eigenvalues.iter().sum();
    let mut axes = [0, 1, 2].map(|k| {
        let (moment, v) = (eigen.eigenvalues[k], eigen.eigenvectors.column(k));
        let first = v.iter().find(|x| x.abs() > 1e-6).copied().unwrap_or(1.0);
        PrincipalAxis {
            along: Vec3::from_array([v[0], v[1], v[2]]) * first.signum(),
            spread: 0.5 * trace - moment,
            gyration: moment.max(0.0).sqrt(),
        }
    });
    axes.sort_by(|a, b| b.spread.total_cmp(&a.spread));
    Some(axes)
}

/// The long axis, if matter lies at least so many times as far along it as along any other.
pub(crate) fn long_axis(axes: &[PrincipalAxis; 3], times: f64) -> Option<Vec3<f64>> {
    let [first, second, _] = axes;
    (first.spread >= times * times * second.spread.max(0.0)).then_some(first.along)
}

/// Angle between two axes (rad), 0 to a quarter turn.
pub(crate) fn angle_between(a: Vec3<f64>, b: Vec3<f64>) -> f64 {
    a.cross(b).norm().atan2(a.dot(b).abs())
}

/// An axis in words: `x`, `y` or `z` where it is within a degree of one, else its components.
pub(crate) fn axis_in_words(axis: Vec3<f64>) -> String {
    let units = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(Vec3::from_array);
    let near = |unit: &Vec3<f64>| angle_between(*unit, axis) < 1f64.to_radians();
    if let Some(k) = units.iter().position(near) {
        return ["x", "y", "z"][k].to_owned();
    }
    let [x, y, z] = axis.to_array();
    format!("[{x:.2}, {y:.2}, {z:.2}]")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rod_along_y_has_its_long_axis_there() {
        // 3 kg, 2 m: m l²/12 = 1 kg·m² across; spread l²/12 along.
        let axes = principal_axes(3.0, Sym3::diagonal(1.0, 1e-4, 1.0)).unwrap();
        assert!((axes[0].spread - 1.0 / 3.0).abs() < 1e-4, "{axes:?}");
        let long = long_axis(&axes, 3.0).unwrap();
        assert_eq!(axis_in_words(long), "y");
        let ball = principal_axes(1.0, Sym3::diagonal(1.0, 1.0, 1.0)).unwrap();
        assert_eq!(long_axis(&ball, 1.01), None);
    }

    #[test]
    fn an_axis_and_its_opposite_are_the_same() {
        let [x, y] = [[1.0, 0.0, 0.0], [0.0, -2.0, 0.0]].map(Vec3::from_array);
        assert!(angle_between(x, -x) < 1e-15);
        assert!((angle_between(x, y).to_degrees() - 90.0).abs() < 1e-12);
        assert_eq!(axis_in_words(Vec3::from_array([0.6, 0.8, 0.0])), "[0.60, 0.80, 0.00]");
    }

    #[test]
    fn nothing_has_no_axes() {
        assert!(principal_axes(0.0, Sym3::diagonal(1.0, 1.0, 1.0)).is_none());
        assert!(principal_axes(1.0, Sym3::diagonal(f64::NAN, 1.0, 1.0)).is_none());
    }
}
