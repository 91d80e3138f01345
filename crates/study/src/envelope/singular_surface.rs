//! Singular surfaces of an array of gyros: the momenta at which it cannot give torque along some
//! direction, whatever its gimbals do.

use super::directions::unit;
use wrasse_hardware::ControlMomentGyro;
use wrasse_spatial::{Real, Vec3, vec3};

/// A surface as points and faces.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Mesh {
    /// Points (N·m·s).
    pub points: Vec<Vec3<f64>>,
    /// Corners of each face, as numbers of points.
    pub faces: Vec<Vec<usize>>,
    /// How many rotors stand against the singular direction; none on the outermost surface.
    pub against: u32,
}

/// All singular surfaces, the outermost first: for the direction `u` in which no torque can be given
/// each rotor stands at `± (u - g (g·u)) / |u - g (g·u)|`, and each pattern of signs makes a surface
/// over all `u`. `rings` from pole to pole, twice as many around. Where a gimbal axis pierces a face
/// the surface has a window, and the face is left out.
///
/// # Source
/// G. Margulies, J. Aubrun, *Geometric theory of single-gimbal control moment gyro systems*, Journal
/// of the Astronautical Sciences 26(2), 1978.
pub fn singular_surfaces(gyros: &[ControlMomentGyro<f64>], rings: u16) -> Vec<Mesh> {
    let patterns = 1_u32 << gyros.len().min(8);
    // A pattern and its opposite make the same surface: keep that with fewer rotors against `u`.
    let kept = (0..patterns).filter(|pattern| {
        let opposite = patterns - 1 - pattern;
        (pattern.count_ones(), pattern) <= (opposite.count_ones(), &opposite)
    });
    let mut surfaces: Vec<Mesh> = kept.map(|pattern| surface(gyros, pattern, rings)).collect();
    surfaces.sort_by_key(|mesh| mesh.against);
    surfaces
}

fn surface(gyros: &[ControlMomentGyro<f64>], pattern: u32, rings: u16) -> Mesh {
    let around = 2 * rings;
    let mut directions = vec![];
    for ring in 0..=rings {
        for step in 0..around {
            let pi = core::f64::consts::PI;
            let (across, z) = Real::sin_cos(pi * f64::from(ring) / f64::from(rings));
            // Half a step aside, so that no sample lies on an axis of the base.
            let (y, x) = Real::sin_cos(pi * (f64::from(step) + 0.5) / f64::from(rings));
            directions.push(vec3(across * x, across * y, z));
        }
    }
    let points = directions.iter().map(|u| {
        gyros.iter().enumerate().fold(Vec3::zero(), |h, (i, gyro)| {
            let sign = if pattern >> i & 1 == 1 { -1.0 } else { 1.0 };
            h + rotor_along(gyro, *u) * (sign * gyro.momentum)
        })
    });
    let mut faces = vec![];
    for ring in 0..usize::from(rings) {
        for step in 0..usize::from(around) {
            let next = (step + 1) % usize::from(around);
            let [above, below] = [ring, ring + 1].map(|r| r * usize::from(around));
            let face = [above + step, below + step, below + next, above + next];
            let corners = face.map(|k| directions[k]);
            if !gyros.iter().any(|gyro| has_window(gyro, &corners)) {
                faces.push(face.to_vec());
            }
        }
    }
    Mesh { points: points.collect(), faces, against: pattern.count_ones() }
}

/// Unit spin axis nearest to `u`; zero where none is nearest.
fn rotor_along(gyro: &ControlMomentGyro<f64>, u: Vec3<f64>) -> Vec3<f64> {
    unit(u - gyro.gimbal_axis_B * u.dot(gyro.gimbal_axis_B))
}

/// Whether the rotor turns by more than a right angle over a face: the gimbal axis pierces it.
fn has_window(gyro: &ControlMomentGyro<f64>, corners: &[Vec3<f64>; 4]) -> bool {
    let rotors = corners.map(|u| rotor_along(gyro, u));
    rotors.iter().any(|a| rotors.iter().any(|b| a.dot(*b) < 0.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::envelope::pyramid::pyramid;

    /// Angle of the gimbal at which the rotor points along `u`, and the other way.
    fn torque_along(gyro: &ControlMomentGyro<f64>, rotor: Vec3<f64>, u: Vec3<f64>) -> f64 {
        gyro.gimbal_axis_B.cross(rotor).dot(u)
    }

    /// On a singular surface every torque axis is across the singular direction.
    #[test]
    fn rotors_of_a_singular_surface_give_no_torque_along_its_direction() {
        let gyros = pyramid(0.6, 1.0);
        let u = unit(vec3(0.3, -0.8, 0.5));
        for gyro in &gyros {
            // Measured 6e-17.
            assert!(torque_along(gyro, rotor_along(gyro, u), u).abs() < 1e-15);
        }
    }

    #[test]
    fn four_gyros_have_one_outer_surface_four_with_one_against_it_and_three_with_two() {
        let meshes = singular_surfaces(&pyramid(0.6, 1.0), 12);
        let against: Vec<_> = meshes.iter().map(|mesh| mesh.against).collect();
        assert_eq!(against, [0, 1, 1, 1, 1, 2, 2, 2]);
    }

    /// The outermost surface touches the solid's every supporting plane.
    #[test]
    fn the_outer_surface_lies_on_the_convex_hull() {
        let gyros = pyramid(0.6, 75.0);
        let mesh = &singular_surfaces(&gyros, 10)[0];
        let solid = crate::envelope::pyramid::momentum_of(&gyros);
        for ring in 1..10_usize {
            let h = mesh.points[ring * 20 + 3];
            // The last golden section. Measured 2e-16.
            assert!((solid.load(h) - 1.0).abs() < 1e-8, "{}", solid.load(h) - 1.0);
        }
    }

    /// Two windows for each gyro, at both ends of its gimbal axis.
    #[test]
    fn a_face_is_missing_at_each_end_of_each_gimbal_axis() {
        let mesh = &singular_surfaces(&pyramid(0.6, 1.0), 24)[0];
        let missing = 24 * 48 - mesh.faces.len();
        // One face, or the two or four that meet where the axis pierces.
        assert!((8..=32).contains(&missing), "{missing}");
        let all_exist = mesh.faces.iter().flatten().all(|k| *k < mesh.points.len());
        assert!(all_exist);
    }
}
