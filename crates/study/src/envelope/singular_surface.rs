//! Singular surfaces of an array of CMGs: the momenta at which it cannot give torque along some
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

/// Longest edge of a face, as a share of the rotors' momenta together.
const LONGEST: f64 = 0.11;
/// How often a face is divided at most.
const FINEST: u32 = 3;

/// All singular surfaces, the outermost first: for the direction `u` in which no torque can be given
/// each rotor stands at `± (u - g (g·u)) / |u - g (g·u)|`, and each pattern of signs makes a surface
/// over all `u`. `rings` from pole to pole, twice as many around. Where a gimbal axis pierces a face
/// the surface has a window, and the face is left out.
///
/// # Source
/// G. Margulies, J. Aubrun, *Geometric theory of single-gimbal control moment gyro systems*, Journal
/// of the Astronautical Sciences 26(2), 1978.
pub fn singular_surfaces(cmgs: &[ControlMomentGyro<f64>], rings: u16) -> Vec<Mesh> {
    let patterns = 1_u32 << cmgs.len().min(8);
    // A pattern and its opposite make the same surface: keep that with fewer rotors against `u`.
    let kept = (0..patterns).filter(|pattern| {
        let opposite = patterns - 1 - pattern;
        (pattern.count_ones(), pattern) <= (opposite.count_ones(), &opposite)
    });
    let mut surfaces: Vec<Mesh> = kept.map(|pattern| surface(cmgs, pattern, rings)).collect();
    surfaces.sort_by_key(|mesh| mesh.against);
    surfaces
}

/// Directions over the sphere from pole to pole, and faces between them.
fn surface(cmgs: &[ControlMomentGyro<f64>], pattern: u32, rings: u16) -> Mesh {
    let mut mesh = Mesh { against: pattern.count_ones(), ..Mesh::default() };
    let all: f64 = cmgs.iter().map(|cmg| cmg.momentum).sum();
    let point = |u: Vec3<f64>| {
        cmgs.iter().enumerate().fold(Vec3::zero(), |h, (i, cmg)| {
            let sign = if pattern >> i & 1 == 1 { -1.0 } else { 1.0 };
            h + rotor_along(cmg, u) * (sign * cmg.momentum)
        })
    };
    for ring in 0..rings {
        for step in 0..2 * rings {
            let corner = |down: u16, on: u16| Place { ring: ring + down, step: step + on };
            let corners = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
            let corners = corners.map(|place| place.angles(rings));
            divide(cmgs, &point, corners, LONGEST * all, FINEST, &mut mesh);
        }
    }
    mesh
}

/// Place of a sample: ring from the pole, step around.
struct Place {
    ring: u16,
    step: u16,
}

impl Place {
    /// Angle from the pole and around (rad), half a step aside, so that none lies on an axis.
    fn angles(&self, rings: u16) -> [f64; 2] {
        let unit = core::f64::consts::PI / f64::from(rings);
        [unit * f64::from(self.ring), unit * (f64::from(self.step) + 0.5)]
    }
}

fn direction([from_pole, around]: [f64; 2]) -> Vec3<f64> {
    let ((across, z), (y, x)) = (Real::sin_cos(from_pole), Real::sin_cos(around));
    vec3(across * x, across * y, z)
}

/// Add a face; in four parts if it is long, for about the gimbal axes the surface runs far while the
/// direction hardly turns.
fn divide(
    cmgs: &[ControlMomentGyro<f64>],
    point: &impl Fn(Vec3<f64>) -> Vec3<f64>,
    corners: [[f64; 2]; 4],
    longest: f64,
    times: u32,
    mesh: &mut Mesh,
) {
    let directions = corners.map(direction);
    let points = directions.map(point);
    let edge = (0..4).map(|k| (points[k] - points[(k + 1) % 4]).norm()).fold(0.0, f64::max);
    let window = cmgs.iter().any(|cmg| has_window(cmg, &directions));
    if times > 0 && (window || edge > longest) {
        let between = |a: [f64; 2], b: [f64; 2]| [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
        let middle = between(corners[0], corners[2]);
        for k in 0..4 {
            let (next, last) = (corners[(k + 1) % 4], corners[(k + 3) % 4]);
            let part = [corners[k], between(corners[k], next), middle, between(corners[k], last)];
            divide(cmgs, point, part, longest, times - 1, mesh);
        }
    } else if !window {
        let first = mesh.points.len();
        mesh.points.extend(points);
        mesh.faces.push((first..first + 4).collect());
    }
}

/// Unit spin axis nearest to `u`; zero where none is nearest.
fn rotor_along(cmg: &ControlMomentGyro<f64>, u: Vec3<f64>) -> Vec3<f64> {
    unit(u - cmg.gimbal_axis_B * u.dot(cmg.gimbal_axis_B))
}

/// Whether the rotor turns by more than a right angle over a face: the gimbal axis pierces it.
fn has_window(cmg: &ControlMomentGyro<f64>, corners: &[Vec3<f64>; 4]) -> bool {
    let rotors = corners.map(|u| rotor_along(cmg, u));
    rotors.iter().any(|a| rotors.iter().any(|b| a.dot(*b) < 0.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::envelope::pyramid::pyramid;

    /// Angle of the gimbal at which the rotor points along `u`, and the other way.
    fn torque_along(cmg: &ControlMomentGyro<f64>, rotor: Vec3<f64>, u: Vec3<f64>) -> f64 {
        cmg.gimbal_axis_B.cross(rotor).dot(u)
    }

    /// On a singular surface every torque axis is across the singular direction.
    #[test]
    fn rotors_of_a_singular_surface_give_no_torque_along_its_direction() {
        let cmgs = pyramid(0.6, 1.0);
        let u = unit(vec3(0.3, -0.8, 0.5));
        for cmg in &cmgs {
            // Measured 6e-17.
            assert!(torque_along(cmg, rotor_along(cmg, u), u).abs() < 1e-15);
        }
    }

    #[test]
    fn four_cmgs_have_one_outer_surface_four_with_one_against_it_and_three_with_two() {
        let meshes = singular_surfaces(&pyramid(0.6, 1.0), 12);
        let against: Vec<_> = meshes.iter().map(|mesh| mesh.against).collect();
        assert_eq!(against, [0, 1, 1, 1, 1, 2, 2, 2]);
    }

    /// The outermost surface touches the solid's every supporting plane.
    #[test]
    fn the_outer_surface_lies_on_the_convex_hull() {
        let cmgs = pyramid(0.6, 75.0);
        let mesh = &singular_surfaces(&cmgs, 10)[0];
        let solid = crate::envelope::pyramid::momentum_of(&cmgs);
        for h in mesh.points.iter().step_by(61).copied() {
            // The last golden section. Measured 2e-16.
            assert!((solid.load(h) - 1.0).abs() < 1e-8, "{}", solid.load(h) - 1.0);
        }
    }

    /// The rim of a window is the circle on which one rotor turns while the others stand still.
    #[test]
    fn the_windows_are_as_wide_as_a_rotor_is_strong() {
        let cmgs = pyramid(0.6, 1.0);
        let mesh = &singular_surfaces(&cmgs, 24)[0];
        let g = cmgs[0].gimbal_axis_B;
        let others = &cmgs[1..];
        let middle = others.iter().fold(Vec3::zero(), |h, cmg| h + rotor_along(cmg, g));
        let nearest = mesh.points.iter().map(|h| (*h - middle).norm()).fold(9.0, f64::min);
        // The samples end short of the rim. Measured 1.0084.
        assert!((nearest - 1.0).abs() < 0.02, "{nearest}");
        let all_exist = mesh.faces.iter().flatten().all(|k| *k < mesh.points.len());
        assert!(all_exist && mesh.faces.len() > 24 * 48);
    }
}
