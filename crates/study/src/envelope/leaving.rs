//! When a path leaves an envelope.

use wrasse_spatial::Vec3;

/// First time (s) at which the path is outside, where `load` says of a point how many times it is
/// farther out than the surface: linear between the samples. None while it stays inside.
pub fn first_outside(
    times: &[f64],
    path: &[Vec3<f64>],
    load: impl Fn(Vec3<f64>) -> f64,
) -> Option<f64> {
    let mut before: Option<(f64, f64)> = None;
    for (&time, &point) in times.iter().zip(path) {
        let now = load(point);
        if now > 1.0 {
            return Some(match before {
                // An infinite load is outside from the sample before it.
                Some((was_at, was)) => was_at + (time - was_at) * (1.0 - was) / (now - was),
                None => time,
            });
        }
        before = Some((time, now));
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use wrasse_spatial::vec3;

    #[test]
    fn a_straight_path_leaves_where_it_crosses_the_surface() {
        let times = [0.0, 1.0, 2.0, 3.0];
        let path: Vec<_> = times.iter().map(|t| vec3(0.0, 4.0 * t, 0.0)).collect();
        let at = |limit: f64| first_outside(&times, &path, |p| p.norm() / limit);
        assert_eq!(at(5.0), Some(1.25));
        assert_eq!(at(12.0), None);
        let nothing =
            first_outside(&times, &path, |p| if p.norm() > 0.0 { f64::INFINITY } else { 0.0 });
        assert_eq!(nothing, Some(0.0));
        assert_eq!(first_outside(&times[..1], &[vec3(9.0, 0.0, 0.0)], Vec3::norm), Some(0.0));
    }
}
