//! What is drawn of a link, as a region in which its matter would lie.

use super::principal::{PrincipalAxis, principal_axes};
use crate::vehicle::ShapeKind;
use core::f64::consts::{PI, TAU};
use wrasse_dynamics::MassProperties;
use wrasse_spatial::{Pose, Sym3, Vec3, vec3};

/// Corners of the polygon around each end of a cylinder: it reaches beyond the circle by 0.9 %.
const CORNERS: usize = 24;

/// Outlines in the axes of one frame. What is said of their extent is said of their convex hull.
#[derive(Debug, Clone, Default)]
pub(crate) struct Drawn {
    /// Points whose hull, widened about each by its radius (m), holds all outlines.
    points: Vec<(Vec3<f64>, f64)>,
    /// Sum of the volumes (m³): what outlines share is counted twice.
    pub(crate) volume: f64,
    /// All outlines at one kilogram per cubic metre.
    even: MassProperties<f64>,
}

impl Drawn {
    /// Outlines in the axes of a frame in which their poses are given.
    pub(crate) fn of(outlines: impl IntoIterator<Item = (Pose<f64>, ShapeKind)>) -> Self {
        let mut drawn = Self::default();
        for (X, kind) in outlines {
            let corners = corners(kind).into_iter();
            drawn.points.extend(corners.map(|(p, radius)| (X.point(p), radius)));
            let (volume, unit) = solid(kind);
            drawn.volume += volume;
            let even = MassProperties::from_central(volume, Vec3::zero(), unit.scaled(volume));
            drawn.even = drawn.even.and(&even.seen_from(&X));
        }
        drawn
    }
    /// Whether nothing is drawn.
    pub(crate) fn is_empty(&self) -> bool {
        self.points.is_empty()
    }
    /// How far it reaches along a unit vector, both ends (m).
    pub(crate) fn ends_along(&self, axis: Vec3<f64>) -> (f64, f64) {
        let ends = |(lower, upper): (f64, f64), (p, radius): &(Vec3<f64>, f64)| {
            let at = axis.dot(*p);
            (lower.min(at - radius), upper.max(at + radius))
        };
        self.points.iter().fold((f64::INFINITY, f64::NEG_INFINITY), ends)
    }
    /// Largest distance from a point (m).
    pub(crate) fn farthest_from(&self, point: Vec3<f64>) -> f64 {
        let away = |(p, radius): &(Vec3<f64>, f64)| (*p - point).norm() + radius;
        self.points.iter().map(away).fold(0.0, f64::max)
    }
    /// The principal axes of an even solid that fills it.
    pub(crate) fn solid_axes(&self) -> Option<[PrincipalAxis; 3]> {
        principal_axes(self.volume, self.even.M_F_F.central())
    }
}

/// Points and radii whose hull is a shape, centred on its frame.
fn corners(kind: ShapeKind) -> Vec<(Vec3<f64>, f64)> {
    match kind {
        ShapeKind::Sphere(radius) => vec![(Vec3::zero(), radius)],
        ShapeKind::Box(edges) => {
            let side = |bit: usize, of: usize| if of >> bit & 1 == 1 { 0.5 } else { -0.5 };
            let corner = |k| vec3(edges.x * side(0, k), edges.y * side(1, k), edges.z * side(2, k));
            (0..8).map(|k| (corner(k), 0.0)).collect()
        }
        ShapeKind::Cylinder { radius, length } => {
            let around = radius / (PI / CORNERS as f64).cos();
            let corner = |k: usize| {
                let (sin, cos) = (k as f64 * TAU / CORNERS as f64).sin_cos();
                let end = |z: f64| (vec3(around * cos, around * sin, z), 0.0);
                [end(0.5 * length), end(-0.5 * length)]
            };
            (0..CORNERS).flat_map(corner).collect()
        }
    }
}

/// Volume (m³), and the inertia of an even solid for each kilogram about its middle (m²).
fn solid(kind: ShapeKind) -> (f64, Sym3<f64>) {
    match kind {
        ShapeKind::Box(e) => {
            let [x, y, z] = e.map(|edge| edge * edge / 12.0).to_array();
            (e.x * e.y * e.z, Sym3::diagonal(y + z, z + x, x + y))
        }
        ShapeKind::Cylinder { radius: r, length: l } => {
            let across = r * r / 4.0 + l * l / 12.0;
            (PI * r * r * l, Sym3::diagonal(across, across, r * r / 2.0))
        }
        ShapeKind::Sphere(r) => {
            let moment = 0.4 * r * r;
            (4.0 / 3.0 * PI * r.powi(3), Sym3::diagonal(moment, moment, moment))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_boxes_side_by_side_are_one_box() {
        let half = ShapeKind::Box(vec3(1.0, 1.0, 1.0));
        let at = |x: f64| Pose::new(wrasse_spatial::Mat3::identity(), vec3(x, 0.0, 0.0));
        let drawn = Drawn::of([(at(0.0), half), (at(1.0), half)]);
        assert_eq!(drawn.volume, 2.0);
        let x = vec3(1.0, 0.0, 0.0);
        assert_eq!(drawn.ends_along(x), (-0.5, 1.5));
        assert!((drawn.farthest_from(vec3(0.5, 0.0, 0.0)) - 1.5f64.sqrt()).abs() < 1e-15);
        let axes = drawn.solid_axes().unwrap();
        // An even box of 2 m: l²/12 along it.
        assert!((axes[0].spread - 4.0 / 12.0).abs() < 1e-12, "{axes:?}");
        assert!((axes[2].spread - 1.0 / 12.0).abs() < 1e-12, "{axes:?}");
    }

    #[test]
    fn cylinder_and_sphere_reach_as_far_as_they_are_drawn() {
        let rod = Drawn::of([(Pose::identity(), ShapeKind::Cylinder { radius: 0.1, length: 2.0 })]);
        assert_eq!(rod.ends_along(vec3(0.0, 0.0, 1.0)), (-1.0, 1.0));
        let (_, side) = rod.ends_along(vec3(0.0, 1.0, 0.0));
        assert!((0.1..0.101).contains(&side), "{side}");
        let ball = Drawn::of([(Pose::identity(), ShapeKind::Sphere(2.0))]);
        assert_eq!(ball.ends_along(vec3(0.0, 1.0, 0.0)), (-2.0, 2.0));
        assert_eq!(ball.farthest_from(vec3(1.0, 0.0, 0.0)), 3.0);
    }
}
