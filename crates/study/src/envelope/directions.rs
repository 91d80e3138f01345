//! Directions spread evenly over the sphere, and the search for a least value among them.

use wrasse_spatial::{Real, Vec3, vec3};

/// The golden angle (rad): `π (3 - √5)`.
const GOLDEN_ANGLE: f64 = 2.399_963_229_728_653;

/// `count` unit vectors on a spiral from pole to pole, each with the same share of the sphere.
pub(crate) fn spread(count: u32) -> impl Iterator<Item = Vec3<f64>> {
    (0..count).map(move |k| {
        let z = 1.0 - (2.0 * f64::from(k) + 1.0) / f64::from(count);
        let (sin, cos) = Real::sin_cos(GOLDEN_ANGLE * f64::from(k));
        let across = (1.0 - z * z).max(0.0).sqrt();
        vec3(across * cos, across * sin, z)
    })
}

/// Two unit vectors that make a right-handed frame with the unit vector `d`.
pub(crate) fn across(d: Vec3<f64>) -> (Vec3<f64>, Vec3<f64>) {
    let [x, y, z] = d.map(f64::abs).to_array();
    let least = if x <= y && x <= z {
        vec3(1.0, 0.0, 0.0)
    } else if y <= z {
        vec3(0.0, 1.0, 0.0)
    } else {
        vec3(0.0, 0.0, 1.0)
    };
    let e1 = least - d * least.dot(d);
    let e1 = e1 * (1.0 / e1.norm());
    (e1, d.cross(e1))
}

/// `v` made one long; zero stays zero.
pub(crate) fn unit(v: Vec3<f64>) -> Vec3<f64> {
    let norm = v.norm();
    if norm > 0.0 { v * (1.0 / norm) } else { v }
}

/// Least value of a function of the direction: the least of a spread of samples and `candidates`,
/// then from the best of them down by steps that are halved when none leads further.
pub(crate) fn least_over_directions(
    candidates: &[Vec3<f64>],
    f: impl Fn(Vec3<f64>) -> f64,
) -> (Vec3<f64>, f64) {
    let samples = spread(2000).chain(candidates.iter().map(|c| unit(*c)));
    let mut best = (vec3(0.0, 0.0, 1.0), f64::INFINITY);
    for u in samples {
        let value = f(u);
        if value < best.1 {
            best = (u, value);
        }
    }
    // The samples are some 0.08 rad apart.
    let mut step = 0.05;
    while step > 1e-10 {
        let (e1, e2) = across(best.0);
        let around = [e1, e2, -e1, -e2].map(|e| unit(best.0 + e * step));
        let next =
            around.into_iter().map(|u| (u, f(u))).fold(best, |a, b| if b.1 < a.1 { b } else { a });
        if next.1 < best.1 {
            best = next;
        } else {
            step *= 0.5;
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_spread_is_of_unit_vectors_that_weigh_each_other_out() {
        let all: Vec<_> = spread(500).collect();
        assert!(all.iter().all(|u| (u.norm() - 1.0).abs() < 1e-15));
        let sum = all.iter().fold(Vec3::zero(), |a, u| a + *u);
        // Measured 0.017 of 500.
        assert!(sum.norm() < 0.1, "{}", sum.norm());
    }

    #[test]
    fn the_least_value_is_found_between_the_samples() {
        let pole = unit(vec3(0.3, -0.5, 0.7));
        let (at, value) = least_over_directions(&[], |u| (u - pole).norm());
        // The step that ends the search. Measured 8e-11.
        assert!(value < 1e-9 && (at - pole).norm() < 1e-9, "{value:e}");
    }
}
