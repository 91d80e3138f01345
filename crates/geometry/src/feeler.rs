//! A place of one shape that feels for another: fixed, or sliding along a curve to where it is deepest.

use crate::patch::Meeting;
use crate::shape::Shape;
use crate::surface::{Nearest, nearest};
use wrasse_spatial::{Pose, Vec3, vec3};

/// Which of two shapes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Side {
    A,
    B,
}

/// A ball on a shape, in the axes of its frame; a radius of zero is a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Feeler {
    /// Fixed. Where it is on faces of a box, `outward` has a sign for each axis along which one of them faces:
    /// it feels what one of them faces only.
    Ball { p: Vec3<f64>, radius: f64, share: f64, outward: Vec3<f64> },
    /// A point that slides along a circle about z.
    Circle { z: f64, radius: f64, share: f64 },
    /// A ball whose middle slides along z, between two ends.
    Axis { half: f64, radius: f64, share: f64 },
}

impl Feeler {
    pub(crate) fn ball(p: Vec3<f64>, radius: f64, share: f64) -> Self {
        Self::Ball { p, radius, share, outward: Vec3::zero() }
    }
    pub(crate) fn facing(self, outward: Vec3<f64>) -> Self {
        match self {
            Self::Ball { p, radius, share, .. } => Self::Ball { p, radius, share, outward },
            other => other,
        }
    }
    pub(crate) fn with_share(self, share: f64) -> Self {
        match self {
            Self::Ball { p, radius, outward, .. } => Self::Ball { p, radius, share, outward },
            Self::Circle { z, radius, .. } => Self::Circle { z, radius, share },
            Self::Axis { half, radius, .. } => Self::Axis { half, radius, share },
        }
    }
}

/// A feeler of A at `X_NA` against shape B at `X_NB`.
pub(crate) fn meet(feeler: &Feeler, X_NA: &Pose<f64>, (B, X_NB): (&Shape, &Pose<f64>)) -> Meeting {
    let X_BA = X_NB.inverse() * *X_NA;
    let mut faces = Vec3::zero();
    let (p_A, radius, share) = match *feeler {
        Feeler::Ball { p, radius, share, outward } => {
            faces = outward;
            (p, radius, share)
        }
        Feeler::Circle { z, radius, share } => (deepest_on_circle(&X_BA, B, z, radius), 0.0, share),
        Feeler::Axis { half, radius, share } => (deepest_on_axis(&X_BA, B, half), radius, share),
    };
    let Nearest { distance, normal } = nearest(B, X_BA.point(p_A));
    let (normal, middle) = (X_NB.rotation * normal, X_NA.point(p_A));
    let on_A = middle - normal * radius;
    let depth = if is_faced(faces, X_NA, normal) { radius - distance } else { UNFACED };
    let on_B = on_A + normal * depth;
    Meeting { depth, normal, on_A, on_B, share }
}

/// Depth of a point on faces that look another way (m): that of the sides of a box that stands on its bottom
/// would count beside those of the bottom, were they not left out.
const UNFACED: f64 = -1.0;

/// Whether one of the faces looks against a normal, within 60°; so does a point that is on no face.
fn is_faced(faces: Vec3<f64>, X_NA: &Pose<f64>, normal: Vec3<f64>) -> bool {
    let (faces, n_A) = (faces.to_array(), X_NA.rotation.transpose_mul(normal).to_array());
    faces == [0.0; 3] || faces.iter().zip(n_A).any(|(face, n)| -face * n > 0.5)
}

/// Places on a circle that are looked at first.
const AROUND: u32 = 12;

/// The point of a circle about z that is deepest in B, in A axes (m).
fn deepest_on_circle(X_BA: &Pose<f64>, B: &Shape, z: f64, radius: f64) -> Vec3<f64> {
    let at = |angle: f64| {
        let (sin, cos) = (libm::sin(angle), libm::cos(angle));
        (vec3(radius * cos, radius * sin, z), vec3(-sin, cos, 0.0))
    };
    let distance = |angle: f64| nearest(B, X_BA.point(at(angle).0)).distance;
    let part = core::f64::consts::TAU / f64::from(AROUND);
    let first = (0..AROUND).map(|i| (distance(part * f64::from(i)), part * f64::from(i)));
    let (_, start) = first.fold((f64::INFINITY, 0.0), |a, b| if b.0 < a.0 { b } else { a });
    // The slope of the distance along the circle: its normal along the tangent.
    let slope = |angle: f64| {
        let (p, tangent) = at(angle);
        nearest(B, X_BA.point(p)).normal.dot(X_BA.rotation * tangent)
    };
    at(where_it_turns(slope, start - part, start + part)).0
}

/// The point of a segment of z that is deepest in B, in A axes (m).
fn deepest_on_axis(X_BA: &Pose<f64>, B: &Shape, half: f64) -> Vec3<f64> {
    let along = X_BA.rotation * vec3(0.0, 0.0, 1.0);
    let slope = |z: f64| nearest(B, X_BA.point(vec3(0.0, 0.0, z))).normal.dot(along);
    vec3(0.0, 0.0, where_it_turns(slope, -half, half))
}

/// Where a slope turns from falling to rising between two ends, to the last bits; the end that it falls to
/// where it does not. By secants, and by halves where these fail.
fn where_it_turns(slope: impl Fn(f64) -> f64, low: f64, high: f64) -> f64 {
    let (mut low, mut high) = (low, high);
    let (mut at_low, mut at_high) = (slope(low), slope(high));
    if at_low >= 0.0 {
        return low;
    }
    if at_high <= 0.0 {
        return high;
    }
    for turn in 0..80 {
        let width = high - low;
        let secant = low - at_low * width / (at_high - at_low);
        let halves = turn % 3 == 2;
        let middle = if halves { low + 0.5 * width } else { secant };
        if middle <= low || middle >= high {
            break;
        }
        let found = slope(middle);
        if found == 0.0 {
            return middle;
        }
        // An end that stays twice counts half, so that the other one moves as well.
        if found < 0.0 {
            (low, at_low, at_high) = (middle, found, 0.5 * at_high);
        } else {
            (high, at_high, at_low) = (middle, found, 0.5 * at_low);
        }
        if high - low <= 1e-15 * (1.0 + low.abs()) {
            break;
        }
    }
    low - at_low * (high - low) / (at_high - at_low)
}
