//! What torques thrusters can make that only push.

use wrasse_spatial::Vec3;

/// Two directions closer than this (–, sine) are the same: thrusters sit where they sit to a millimetre
/// in a metre.
const SAME: f64 = 1e-6;

/// Whether a sum of these torques with weights of zero or more points along `wanted` (any length).
///
/// A vector in a cone is in the cone of at most three of its generators (Carathéodory): all threes are
/// tried. Of two, the third is across both and must have no part in the sum.
pub(crate) fn can_make(torques: &[Vec3<f64>], wanted: Vec3<f64>) -> bool {
    let longest = torques.iter().map(|t| t.norm()).fold(0.0, f64::max);
    let unit = |t: &Vec3<f64>| *t * (1.0 / t.norm());
    let rays: Vec<_> = torques.iter().filter(|t| t.norm() > SAME * longest).map(unit).collect();
    let wanted = unit(&wanted);
    let alone = |ray: &Vec3<f64>| ray.dot(wanted) > 0.0 && ray.cross(wanted).norm() < SAME;
    if rays.iter().any(alone) {
        return true;
    }
    rays.iter().enumerate().any(|(i, &a)| {
        rays[i + 1..].iter().enumerate().any(|(j, &b)| {
            let across = a.cross(b);
            across.norm() > SAME
                && (in_plane(a, b, across, wanted)
                    || rays[i + j + 2..].iter().any(|&c| inside(a, b, c, wanted)))
        })
    })
}

/// Whether the direction is between two rays.
fn in_plane(a: Vec3<f64>, b: Vec3<f64>, across: Vec3<f64>, wanted: Vec3<f64>) -> bool {
    let n = across * (1.0 / across.norm());
    wanted.dot(n).abs() < SAME && inside(a, b, n, wanted)
}

/// Whether the direction is between three rays: its parts along them, by Cramer's rule.
fn inside(a: Vec3<f64>, b: Vec3<f64>, c: Vec3<f64>, wanted: Vec3<f64>) -> bool {
    let volume = a.dot(b.cross(c));
    if volume.abs() < SAME {
        return false;
    }
    let parts = [wanted.dot(b.cross(c)), wanted.dot(c.cross(a)), wanted.dot(a.cross(b))];
    parts.iter().all(|part| part / volume > -SAME)
}

#[cfg(test)]
mod tests {
    use super::*;
    use wrasse_spatial::vec3;

    #[test]
    fn three_rays_make_what_lies_between_them_and_nothing_else() {
        let rays = [vec3(2.0, 0.0, 0.0), vec3(0.0, 0.1, 0.0), vec3(0.0, 0.0, 7.0)];
        assert!(can_make(&rays, vec3(1.0, 2.0, 3.0)));
        assert!(can_make(&rays, vec3(0.0, 1.0, 1.0)));
        assert!(can_make(&rays, vec3(0.0, 0.0, 1.0)));
        assert!(!can_make(&rays, vec3(1.0, 2.0, -0.1)));
        assert!(!can_make(&rays, vec3(-1.0, 0.0, 0.0)));
    }

    #[test]
    fn opposite_rays_make_both_ways_of_their_axis_and_no_other() {
        let rays = [vec3(0.0, 1.0, 0.0), vec3(0.0, -2.0, 0.0)];
        assert!(can_make(&rays, vec3(0.0, 1.0, 0.0)) && can_make(&rays, vec3(0.0, -1.0, 0.0)));
        assert!(!can_make(&rays, vec3(1.0, 0.0, 0.0)));
    }

    #[test]
    fn four_rays_around_the_origin_make_everything() {
        let rays = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
        let rays = rays.map(Vec3::from_array);
        for wanted in [[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.3, -1.0], [-2.0, 0.1, 0.4]] {
            assert!(can_make(&rays, Vec3::from_array(wanted)));
        }
        assert!(!can_make(&rays[1..], vec3(1.0, 1.0, 1.0)));
    }
    #[test]
    fn nothing_makes_nothing() {
        assert!(!can_make(&[], vec3(1.0, 0.0, 0.0)));
        assert!(!can_make(&[Vec3::zero()], vec3(1.0, 0.0, 0.0)));
    }
}
