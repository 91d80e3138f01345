//! Convex solids that are sums of simple pieces: what several actuators can hold or give together.

use super::directions::{across, least_over_directions};
use wrasse_flight::allocation::BoundedSimplex;
use wrasse_hardware::{CMGS, WHEELS};
use wrasse_spatial::Vec3;

/// One summand of a solid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Piece {
    /// From `-half` to `+half`: a wheel, or a CMG's torque at one gimbal angle.
    Segment {
        /// From the middle to one end.
        half: Vec3<f64>,
    },
    /// From zero to `end`: a thruster.
    OneSided {
        /// The other end.
        end: Vec3<f64>,
    },
    /// A disc about zero: a CMG at any gimbal angle.
    Disc {
        /// Unit normal: the gimbal axis (–).
        axis: Vec3<f64>,
        /// Radius.
        radius: f64,
    },
    /// Nothing to choose: all is moved by this much.
    Shift {
        /// By how much.
        by: Vec3<f64>,
    },
}

/// All that can be reached as a sum of one point from each piece. For CMGs, whose single momenta lie
/// on the rims of the discs, it is the convex hull of what can be reached: it closes the windows about
/// the gimbal axes.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Solid {
    /// The summands.
    pub pieces: Vec<Piece>,
}

/// Cuts of an interval by golden sections: 0.618^46 = 2.4e-10.
const SECTIONS: usize = 46;

/// Where the search for a bracket ends: a solid so flat reaches a millionth of its size.
const FARTHEST: f64 = 1e6;

/// Most columns of a linear program: both ways of every wheel and every CMG.
const COLUMNS: usize = 2 * (WHEELS + CMGS);

/// Its variables: the columns, the length along a direction, and the start, one for each axis.
const VARIABLES: usize = COLUMNS + 1 + 3;

impl Piece {
    /// Largest component along `u` of a point of the piece.
    fn support(&self, u: Vec3<f64>) -> f64 {
        match *self {
            Self::Segment { half } => u.dot(half).abs(),
            Self::OneSided { end } => u.dot(end).max(0.0),
            Self::Disc { axis, radius } => radius * (u - axis * u.dot(axis)).norm(),
            Self::Shift { by } => u.dot(by),
        }
    }
    fn scaled(&self, factor: f64) -> Self {
        match *self {
            Self::Segment { half } => Self::Segment { half: half * factor },
            Self::OneSided { end } => Self::OneSided { end: end * factor },
            Self::Disc { axis, radius } => Self::Disc { axis, radius: radius * factor },
            Self::Shift { by } => Self::Shift { by: by * factor },
        }
    }
}

impl Solid {
    /// Whether there is no piece: only zero can be reached.
    pub fn is_empty(&self) -> bool {
        self.pieces.is_empty()
    }
    /// The solid with another beside it: everything that both can do together.
    #[must_use]
    pub fn with(&self, other: &Self) -> Self {
        Self { pieces: [self.pieces.as_slice(), &other.pieces].concat() }
    }
    /// The solid, each length times a factor.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        Self { pieces: self.pieces.iter().map(|piece| piece.scaled(factor)).collect() }
    }
    /// The same solid about its middle: every piece a segment or a disc.
    #[must_use]
    pub fn centred(&self) -> Self {
        let pieces = self.pieces.iter().filter_map(|piece| match *piece {
            Piece::OneSided { end } => Some(Piece::Segment { half: end * 0.5 }),
            Piece::Shift { .. } => None,
            other => Some(other),
        });
        Self { pieces: pieces.collect() }
    }
    /// Support function: the largest component along the unit vector `u` of any point of the solid.
    pub fn support(&self, u: Vec3<f64>) -> f64 {
        self.pieces.iter().map(|piece| piece.support(u)).sum()
    }
    /// How far the solid reaches from zero along the unit vector `d`.
    pub fn radius(&self, d: Vec3<f64>) -> f64 {
        self.radius_by_program(d).unwrap_or_else(|| self.radius_by_support(d).max(0.0))
    }
    /// How many times `point` is farther out than the surface in its direction: inside up to one.
    pub fn load(&self, point: Vec3<f64>) -> f64 {
        let size = point.norm();
        if size > 0.0 { size / self.radius(point * (1.0 / size)) } else { 0.0 }
    }
    /// How far the solid reaches in the direction in which it reaches least, and that direction.
    pub fn smallest_radius(&self) -> (Vec3<f64>, f64) {
        // The least radius is the least support, which has edges at the axes of the pieces.
        let axes = self.pieces.iter().map(|piece| match *piece {
            Piece::Segment { half } => half,
            Piece::OneSided { end } => end,
            Piece::Disc { axis, .. } => axis,
            Piece::Shift { by } => by,
        });
        let axes: Vec<_> = axes.collect();
        let pairs = axes
            .iter()
            .enumerate()
            .flat_map(|(k, a)| axes[..k].iter().flat_map(|b| [a.cross(*b), b.cross(*a)]));
        let both = axes.iter().flat_map(|a| [*a, -*a]);
        let candidates: Vec<_> = pairs.chain(both).filter(|c| c.norm() > 0.0).collect();
        least_over_directions(&candidates, |u| self.support(u))
    }
    /// Exact for a polytope of at most [`COLUMNS`] columns: the largest `t` with `t d` a sum of points
    /// of the pieces.
    fn radius_by_program(&self, d: Vec3<f64>) -> Option<f64> {
        let mut columns = vec![];
        for piece in &self.pieces {
            match *piece {
                // From -half to half is half times (share below two, less one).
                Piece::Segment { half } => columns.extend([half, -half]),
                Piece::OneSided { end } => columns.push(end),
                Piece::Disc { .. } | Piece::Shift { .. } => return None,
            }
        }
        let largest = columns.iter().flat_map(|c| c.to_array()).fold(0.0, |m, x| x.abs().max(m));
        if columns.len() > COLUMNS || largest == 0.0 {
            return (largest == 0.0).then_some(0.0);
        }
        let mut rows = [[0.0; VARIABLES]; 3];
        for (k, row) in rows.iter_mut().enumerate() {
            for (a, column) in row.iter_mut().zip(&columns) {
                *a = column.to_array()[k] / largest;
            }
            row[COLUMNS] = -d.to_array()[k];
            row[COLUMNS + 1 + k] = 1.0;
        }
        // Nothing is left over, and no sum of columns is longer.
        let mut upper = [0.0; VARIABLES];
        upper[..columns.len()].fill(1.0);
        upper[COLUMNS] = 2.0 * COLUMNS as f64;
        let mut program = BoundedSimplex::new(rows, upper).with_largest_pivots();
        let mut cost = [0.0; VARIABLES];
        cost[COLUMNS] = -1.0;
        program.minimise(&cost).then(|| program.value(COLUMNS) * largest)
    }
    /// The least of `support(u) / (u · d)`: a convex function of the two components of `u` across `d`.
    fn radius_by_support(&self, d: Vec3<f64>) -> f64 {
        let (e1, e2) = across(d);
        least_of(|a| least_of(|b| self.support(d + e1 * a + e2 * b)))
    }
}

/// Least value of a convex function, by golden sections.
fn least_of(f: impl Fn(f64) -> f64) -> f64 {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    // While a convex function still falls at an end, its least value may lie beyond.
    let mut far = 1.0;
    while far < FARTHEST && (f(far) < f(0.5 * far) || f(-far) < f(-0.5 * far)) {
        far *= 2.0;
    }
    let (mut low, mut high) = (-far, far);
    let (mut a, mut b) = (high - GOLDEN * (high - low), low + GOLDEN * (high - low));
    let (mut at_a, mut at_b) = (f(a), f(b));
    for _ in 0..SECTIONS {
        if at_a < at_b {
            (high, b, at_b) = (b, a, at_a);
            a = high - GOLDEN * (high - low);
            at_a = f(a);
        } else {
            (low, a, at_a) = (a, b, at_b);
            b = low + GOLDEN * (high - low);
            at_b = f(b);
        }
    }
    at_a.min(at_b)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::envelope::directions::{spread, unit};
    use wrasse_spatial::vec3;
    use wrasse_testing::largest;

    fn segment(x: f64, y: f64, z: f64) -> Piece {
        Piece::Segment { half: vec3(x, y, z) }
    }

    /// Four wheels along the diagonals of a cube.
    fn tetrahedron() -> Solid {
        let s = 1.0 / 3.0_f64.sqrt();
        let axes = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
        Solid { pieces: axes.iter().map(|[x, y, z]| segment(s * x, s * y, s * z)).collect() }
    }

    /// Three wheels on the axes of a box reach its faces, edges and corners.
    #[test]
    fn three_crossed_wheels_reach_as_far_as_a_box_does() {
        let solid = Solid {
            pieces: vec![segment(3.0, 0.0, 0.0), segment(0.0, 2.0, 0.0), segment(0.0, 0.0, 1.0)],
        };
        let cases = [
            (vec3(1.0, 0.0, 0.0), 3.0),
            (vec3(0.0, -1.0, 0.0), 2.0),
            (unit(vec3(3.0, 2.0, 1.0)), 14.0_f64.sqrt()),
            (unit(vec3(1.0, 0.0, 1.0)), 2.0_f64.sqrt()),
        ];
        for (d, radius) in cases {
            // Measured 0.
            assert!((solid.radius(d) - radius).abs() < 1e-14, "{d:?} {}", solid.radius(d));
        }
        let (_, least) = solid.smallest_radius();
        assert!((least - 1.0).abs() < 1e-12, "{least}");
    }

    /// The sum of four segments along the diagonals of a cube is a rhombic dodecahedron: its corners
    /// lie at 4/√3 on the axes, its faces at (1, 1, 0)/√2 · √(8/3).
    #[test]
    fn four_wheels_of_a_tetrahedron_reach_a_rhombic_dodecahedron() {
        let solid = tetrahedron();
        let corner = 4.0 / 3.0_f64.sqrt();
        let face = (8.0_f64 / 3.0).sqrt();
        assert!((solid.radius(vec3(0.0, 0.0, 1.0)) - corner).abs() < 1e-14);
        assert!((solid.radius(unit(vec3(1.0, 1.0, 0.0))) - face).abs() < 1e-14);
        // Found by search. Measured 0.
        let (_, least) = solid.smallest_radius();
        assert!((least - face).abs() < 1e-9, "{least} {face}");
    }

    /// The two ways to the radius share nothing but the pieces.
    #[test]
    fn the_program_and_the_support_find_the_same_radius() {
        let solid = tetrahedron().with(&Solid {
            pieces: vec![Piece::OneSided { end: vec3(0.2, -0.7, 0.4) }, segment(0.1, 0.5, -0.3)],
        });
        let both = |d| (solid.radius_by_program(d).unwrap(), solid.radius_by_support(d));
        let off = largest(spread(40).map(both).map(|(program, support)| (program - support).abs()));
        // The last golden section, times the slope. Measured 1.2e-10.
        assert!(off < 1e-8, "{off:e}");
    }

    #[test]
    fn wheels_that_do_not_span_reach_nothing_outside_their_plane() {
        let flat = Solid { pieces: vec![segment(1.0, 0.0, 0.0), segment(0.0, 1.0, 0.0)] };
        assert_eq!(flat.radius(vec3(0.0, 0.0, 1.0)), 0.0);
        assert!((flat.radius(vec3(1.0, 0.0, 0.0)) - 1.0).abs() < 1e-15);
        assert_eq!(flat.load(vec3(0.0, 0.0, 0.1)), f64::INFINITY);
        assert_eq!(Solid::default().radius(vec3(0.0, 0.0, 1.0)), 0.0);
        let rotors =
            Solid { pieces: vec![Piece::Disc { axis: vec3(0.0, 0.0, 1.0), radius: 2.0 }; 2] };
        // Flatter than the search looks. Measured 5e-10.
        assert!(rotors.radius(vec3(0.0, 0.0, 1.0)) < 1e-8);
        assert!((rotors.radius(vec3(0.6, 0.8, 0.0)) - 4.0).abs() < 1e-8);
    }

    #[test]
    fn one_sided_pieces_reach_one_way_only() {
        let solid = Solid {
            pieces: vec![
                Piece::OneSided { end: vec3(2.0, 0.0, 0.0) },
                Piece::OneSided { end: vec3(-0.5, 0.0, 0.0) },
            ],
        };
        assert_eq!(solid.radius(vec3(1.0, 0.0, 0.0)), 2.0);
        assert_eq!(solid.radius(vec3(-1.0, 0.0, 0.0)), 0.5);
        assert_eq!(solid.load(vec3(-1.0, 0.0, 0.0)), 2.0);
    }
}
