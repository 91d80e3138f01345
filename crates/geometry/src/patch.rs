//! Where two shapes touch: the places that share a pair's stiffness.

use crate::feeler::{Feeler, Side, meet};
use crate::shape::Shape;
use wrasse_spatial::{Pose, Vec3, vec3};

/// One place where two shapes meet, or would.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Meeting {
    /// How deep the surfaces are in each other (m); negative where they are apart.
    pub depth: f64,
    /// Out of B, towards A, of length one, inertial axes.
    pub normal: Vec3<f64>,
    /// On the surface of A (m, inertial axes).
    pub on_A: Vec3<f64>,
    /// On the surface of B (m): `on_A + depth normal`.
    pub on_B: Vec3<f64>,
    /// Of the pair's stiffness (–).
    pub share: f64,
}

/// How two shapes touch.
///
/// Each place is a point or a ball that is fixed to one shape, or slides along a curve of it to where it is
/// deepest in the other. So the gradient of its depth is its normal at its own point: the elastic forces have
/// a potential, whatever the shapes do.
///
/// A ball touches at one place with all of the stiffness; a capsule at its ends, which share it. A box has
/// a grid of points on each face, of which those of one face share it; of two boxes the smaller one has them,
/// and of the larger one the corners. A cylinder has a disc of points on each end. Of a peg in a bore the rims of
/// the peg and the edges of the bore touch, each with all of the stiffness.
///
/// What is not felt: crossing edges of boxes between the points; flats of kinds that have no points here.
#[derive(Debug, Clone, PartialEq)]
pub struct Patch {
    A: Shape,
    B: Shape,
    feelers: Vec<(Side, Feeler)>,
}

/// Most places of a flat.
pub const MOST_PLACES: usize = 1024;

impl Patch {
    /// Of a pair of shapes, with about so many places where a flat lies on a flat: a square number is met on a
    /// box, 16, 64 and 256 on a disc. None where the pair has no rule.
    pub fn new(A: &Shape, B: &Shape, places: usize) -> Option<Self> {
        let places = places.clamp(1, MOST_PLACES);
        let feelers = of_pair(A, B, places)?;
        Some(Self { A: A.clone(), B: B.clone(), feelers })
    }
    /// How many places there are.
    pub fn len(&self) -> usize {
        self.feelers.len()
    }
    /// Whether these shapes never touch.
    pub fn is_empty(&self) -> bool {
        self.feelers.is_empty()
    }
    /// All places now, one after the other.
    pub fn meet(&self, X_NA: &Pose<f64>, X_NB: &Pose<f64>, meetings: &mut [Meeting]) {
        for ((side, feeler), meeting) in self.feelers.iter().zip(meetings) {
            *meeting = match side {
                Side::A => meet(feeler, X_NA, (&self.B, X_NB)),
                Side::B => meet(feeler, X_NB, (&self.A, X_NA)).seen_from_other_side(),
            };
        }
    }
}

impl Meeting {
    /// A and B exchanged.
    fn seen_from_other_side(self) -> Self {
        Self { normal: -self.normal, on_A: self.on_B, on_B: self.on_A, ..self }
    }
}

/// The places of a pair, if there is a rule for it.
fn of_pair(A: &Shape, B: &Shape, places: usize) -> Option<Vec<(Side, Feeler)>> {
    use Shape::{Bore, Box, Capsule, Cylinder, Plane, Sphere};
    let all =
        |side: Side, feelers: Vec<Feeler>| Some(feelers.into_iter().map(|f| (side, f)).collect());
    match (A, B) {
        (Sphere { radius }, _) => all(Side::A, vec![Feeler::ball(Vec3::zero(), *radius, 1.0)]),
        (_, Sphere { radius }) => all(Side::B, vec![Feeler::ball(Vec3::zero(), *radius, 1.0)]),
        (Capsule { radius, length }, Capsule { .. }) => {
            all(Side::A, vec![Feeler::Axis { half: 0.5 * length, radius: *radius, share: 1.0 }])
        }
        (Cylinder { .. }, Bore { .. }) => Some(peg_in_bore((Side::A, A), (Side::B, B))),
        (Bore { .. }, Cylinder { .. }) => Some(peg_in_bore((Side::B, B), (Side::A, A))),
        (Capsule { .. }, _) => all(Side::A, ends(A)),
        (_, Capsule { .. }) => all(Side::B, ends(B)),
        (Box { .. }, Box { .. }) => Some(two_boxes(A, B, places)),
        (Box { .. }, Plane | Cylinder { .. }) => all(Side::A, faces(A, places)),
        (Plane | Cylinder { .. }, Box { .. }) => all(Side::B, faces(B, places)),
        (Cylinder { .. }, Plane) => all(Side::A, discs(A, places)),
        (Plane, Cylinder { .. }) => all(Side::B, discs(B, places)),
        _ => None,
    }
}

/// The balls at the ends of a capsule.
fn ends(of: &Shape) -> Vec<Feeler> {
    let Shape::Capsule { radius, length } = of else { return vec![] };
    [-0.5, 0.5].map(|share| Feeler::ball(vec3(0.0, 0.0, share * length), *radius, 0.5)).to_vec()
}

/// Of two boxes: the points of the smaller one, and the corners of the larger one.
fn two_boxes(A: &Shape, B: &Shape, places: usize) -> Vec<(Side, Feeler)> {
    let size = |of: &Shape| if let Shape::Box { edges, .. } = of { edges.norm() } else { 0.0 };
    let ((small, its), (large, other)) = if size(A) <= size(B) {
        ((Side::A, A), (Side::B, B))
    } else {
        ((Side::B, B), (Side::A, A))
    };
    let points = faces(its, places).into_iter().map(|feeler| (small, feeler));
    let share = 0.25 / (per_edge(places) - 1.0).powi(2);
    let corners = faces(other, 4).into_iter().map(|feeler| (large, feeler.with_share(share)));
    points.chain(corners).collect()
}

/// Points along an edge of a face with so many places.
fn per_edge(places: usize) -> f64 {
    (places as f64).sqrt().round().max(2.0)
}

/// Points on all faces of a box, its corners and edges among them: on each face a grid with the weights of the
/// trapezoidal rule, whose sum is one and whose middle is that of the face.
fn faces(of: &Shape, places: usize) -> Vec<Feeler> {
    let Shape::Box { edges, rounding } = of else { return vec![] };
    let half = edges.map(|edge| 0.5 * edge - rounding).to_array();
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "2 to 32")]
    let m = per_edge(places) as usize;
    let at = |i: usize, k: usize| half[k] * (2.0 * i as f64 / (m - 1) as f64 - 1.0);
    let mut points = vec![];
    for (i, j, k) in (0..m * m * m).map(|n| (n / (m * m), n / m % m, n % m)) {
        let at_ends = [i, j, k].iter().filter(|n| **n == 0 || **n == m - 1).count();
        if at_ends == 0 {
            continue;
        }
        // A point of a face is halved once for each edge of the face that it is on.
        let weight = 0.5_f64.powi(i32::try_from(at_ends - 1).unwrap_or(0));
        let share = weight / ((m - 1) * (m - 1)) as f64;
        let sign = |n: usize| {
            if n == 0 {
                -1.0
            } else if n == m - 1 {
                1.0
            } else {
                0.0
            }
        };
        let place = Feeler::ball(vec3(at(i, 0), at(j, 1), at(k, 2)), *rounding, share);
        points.push(place.facing(vec3(sign(i), sign(j), sign(k))));
    }
    points
}

/// Points on both ends of a cylinder: on rings whose radii and weights are those of Radau's rule in the square
/// of the radius, so that the outermost is the rim.
fn discs(of: &Shape, places: usize) -> Vec<Feeler> {
    let Shape::Cylinder { radius, length } = of else { return vec![] };
    let (rings, around): (&[(f64, f64)], u32) = match places {
        0..=31 => (&RADAU_2, 8),
        32..=127 => (&RADAU_4, 16),
        _ => (&RADAU_8, 32),
    };
    let mut points = vec![];
    for z in [-0.5 * length, 0.5 * length] {
        for (square, weight) in rings {
            for i in 0..around {
                let angle = core::f64::consts::TAU * f64::from(i) / f64::from(around);
                let r = radius * square.sqrt();
                let p = vec3(r * libm::cos(angle), r * libm::sin(angle), z);
                points.push(Feeler::ball(p, 0.0, weight / f64::from(around)));
            }
        }
    }
    points
}

/// Nodes and weights of Radau's rules on 0 to 1 with the end 1.
const RADAU_2: [(f64, f64); 2] = [(1.0 / 3.0, 0.75), (1.0, 0.25)];
const RADAU_4: [(f64, f64); 4] = [
    (0.088_587_959_512_704, 0.220_462_211_176_768),
    (0.409_466_864_440_735, 0.388_193_468_843_172),
    (0.787_659_461_760_847, 0.328_844_319_980_060),
    (1.0, 0.0625),
];
const RADAU_8: [(f64, f64); 8] = [
    (0.022_479_386_438_713, 0.057_254_407_372_129),
    (0.114_679_053_160_904, 0.124_823_950_664_933),
    (0.265_789_822_784_589, 0.173_507_397_817_249),
    (0.452_846_373_669_445, 0.195_786_083_726_247),
    (0.647_375_282_886_830, 0.188_258_772_694_560),
    (0.819_759_308_263_108, 0.152_065_310_323_391),
    (0.943_737_439_463_078, 0.092_679_077_401_492),
    (1.0, 0.015_625),
];

/// A peg in a bore: the rims of the peg against the bore, the edges of the bore against the peg's side. Each
/// touches at the point of its circle that is deepest, with the whole stiffness: where two touch at once they
/// are on opposite walls, or at the two ends of a peg that lies along the bore.
fn peg_in_bore(
    (peg_side, peg): (Side, &Shape),
    (bore_side, bore): (Side, &Shape),
) -> Vec<(Side, Feeler)> {
    let Shape::Cylinder { radius: r, length } = peg else { return vec![] };
    let Shape::Bore { radius: R, depth, chamfer_depth, chamfer_angle, .. } = bore else {
        return vec![];
    };
    let circle = |z: f64, radius: f64| Feeler::Circle { z, radius, share: 1.0 };
    let mut all = vec![
        (peg_side, circle(-0.5 * length, *r)),
        (peg_side, circle(0.5 * length, *r)),
        (bore_side, circle(-chamfer_depth, *R)),
        (bore_side, circle(-depth, *R)),
    ];
    if *chamfer_depth > 0.0 {
        let mouth = R + chamfer_depth * libm::tan(*chamfer_angle);
        all.push((bore_side, circle(0.0, mouth)));
    }
    all
}
