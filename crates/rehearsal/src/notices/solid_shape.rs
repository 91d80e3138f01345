//! Simple solids: how deep a point is in one, and whether and how far two of them overlap.

use wrasse_spatial::{Pose, Vec3, vec3};
use wrasse_vehicle::ShapeKind;

/// Most steps of the search for a plane between two solids.
const STEPS: usize = 100;

/// A solid in its place.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Solid {
    /// Pose of its middle.
    pub(crate) X: Pose<f64>,
    pub(crate) kind: ShapeKind,
}

impl Solid {
    /// How deep a point is inside (m): the distance to the surface, negative outside.
    pub(crate) fn depth(&self, point: Vec3<f64>) -> f64 {
        let p = self.X.inverse().point(point).map(f64::abs);
        // Outside two faces at once: the distance from the edge between them.
        let from = |sides: &[f64]| {
            let outside = sides.iter().map(|x| x.max(0.0) * x.max(0.0)).sum::<f64>().sqrt();
            let inside = sides.iter().copied().fold(f64::NEG_INFINITY, f64::max).min(0.0);
            -(outside + inside)
        };
        match self.kind {
            ShapeKind::Box(edges) => {
                let half = edges * 0.5;
                from(&[p.x - half.x, p.y - half.y, p.z - half.z])
            }
            ShapeKind::Cylinder { radius, length } => {
                from(&[p.x.hypot(p.y) - radius, p.z - 0.5 * length])
            }
            ShapeKind::Sphere(radius) => radius - p.norm(),
        }
    }

    /// The point of the solid that is farthest in a direction (m).
    fn farthest(&self, direction: Vec3<f64>) -> Vec3<f64> {
        let d = self.X.rotation.transpose_mul(direction);
        let point = match self.kind {
            ShapeKind::Box(edges) => vec3(
                (0.5 * edges.x).copysign(d.x),
                (0.5 * edges.y).copysign(d.y),
                (0.5 * edges.z).copysign(d.z),
            ),
            ShapeKind::Cylinder { radius, length } => {
                let across = d.x.hypot(d.y);
                let share = if across > 0.0 { radius / across } else { 0.0 };
                vec3(d.x * share, d.y * share, (0.5 * length).copysign(d.z))
            }
            ShapeKind::Sphere(radius) => d * (radius / d.norm().max(f64::MIN_POSITIVE)),
        };
        self.X.point(point)
    }

    /// Whether it overlaps another: no plane lies between them.
    ///
    /// The point nearest to the origin is sought in the set of differences of their points, step by
    /// step on the line to the farthest one; a plane between them ends the search.
    ///
    /// # Source
    /// Gilbert, "An iterative procedure for computing the minimum of a quadratic form on a convex
    /// set", SIAM J. Control 4, 1966.
    pub(crate) fn overlaps(&self, other: &Self) -> bool {
        let mut nearest = self.X.translation - other.X.translation;
        for _ in 0..STEPS {
            let square = nearest.dot(nearest);
            if square < 1e-12 {
                return true;
            }
            let next = self.farthest(-nearest) - other.farthest(nearest);
            if next.dot(nearest) > 0.0 {
                return false;
            }
            let way = next - nearest;
            let share = (-nearest.dot(way) / way.dot(way)).clamp(0.0, 1.0);
            nearest += way * share;
        }
        true
    }

    /// The least shift along an axis of either, or across one of each, that parts them (m).
    pub(crate) fn shift_apart(&self, other: &Self) -> f64 {
        let axes = |solid: &Self| {
            let R = solid.X.rotation.transpose();
            R.rows
        };
        let (own, its) = (axes(self), axes(other));
        let across = own.iter().flat_map(|a| its.iter().map(|b| a.cross(*b)));
        let between = other.X.translation - self.X.translation;
        let all = own.iter().chain(&its).copied().chain(across).chain([between]);
        let units = all.filter(|axis| axis.norm() > 1e-6).map(|axis| axis * (1.0 / axis.norm()));
        let shift = |n: Vec3<f64>| {
            let reach = |solid: &Self| (solid.farthest(n).dot(n), -solid.farthest(-n).dot(n));
            let ((high, low), (its_high, its_low)) = (reach(self), reach(other));
            (high + its_low).min(its_high + low)
        };
        units.map(shift).fold(f64::INFINITY, f64::min)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use wrasse_spatial::Quat;

    fn at(x: f64, turn: Vec3<f64>, kind: ShapeKind) -> Solid {
        Solid { X: Pose::from_quat(Quat::exp(turn), vec3(x, 0.0, 0.0)), kind }
    }

    #[test]
    fn a_point_is_as_deep_as_it_is_far_from_the_surface() {
        let still = Vec3::zero();
        let cases = [
            (ShapeKind::Box(vec3(2.0, 4.0, 6.0)), vec3(0.7, 0.0, 0.0), 0.3),
            (ShapeKind::Box(vec3(2.0, 4.0, 6.0)), vec3(4.0, 6.0, 0.0), -5.0),
            (ShapeKind::Cylinder { radius: 1.0, length: 4.0 }, vec3(0.6, 0.0, 1.9), 0.1),
            (ShapeKind::Cylinder { radius: 1.0, length: 4.0 }, vec3(0.0, 4.0, 6.0), -5.0),
            (ShapeKind::Sphere(2.0), vec3(0.0, 0.5, 0.0), 1.5),
        ];
        for (kind, point, depth) in cases {
            let found = at(0.0, still, kind).depth(point);
            assert!((found - depth).abs() < 1e-15, "{kind:?} {point:?}: {found}, not {depth}");
        }
    }

    /// A cube on its edge reaches √2/2 along x; on its face 1/2. A cylinder and a sphere likewise.
    #[test]
    fn solids_overlap_from_where_they_touch() {
        let (still, on_edge) = (Vec3::zero(), vec3(0.0, 0.0, std::f64::consts::FRAC_PI_4));
        let cube = ShapeKind::Box(vec3(1.0, 1.0, 1.0));
        let long = ShapeKind::Cylinder { radius: 0.5, length: 2.0 };
        let lying = vec3(0.0, std::f64::consts::FRAC_PI_2, 0.0);
        let half_root = std::f64::consts::FRAC_1_SQRT_2;
        for (turn, kind, touch) in [
            (still, cube, 1.0),
            (on_edge, cube, 0.5 + half_root),
            (still, long, 1.0),
            (lying, long, 1.5),
            (still, ShapeKind::Sphere(0.25), 0.75),
        ] {
            let bus = at(0.0, still, cube);
            let is = |x| bus.overlaps(&at(x, turn, kind));
            assert!(is(touch - 1e-3) && !is(touch + 1e-6), "{kind:?} {turn:?} at {touch}");
            let shift = bus.shift_apart(&at(touch - 0.1, turn, kind));
            assert!((shift - 0.1).abs() < 1e-12, "{kind:?} {turn:?}: {shift}");
        }
    }
}
