//! Where two shapes touch: the places that share a pair's stiffness.

use crate::gap::gap;
use crate::shape::Shape;
use wrasse_spatial::{Pose, Vec3};

/// One place where two shapes meet, or would.
#[derive(Debug, Clone, Copy, PartialEq)]
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
/// Each place is a point or a ball that is fixed to one shape, or slides on it to where it is deepest in
/// the other. So the gradient of its depth is its normal at its own point: the elastic forces have a
/// potential, whatever the shapes do.
#[derive(Debug, Clone, PartialEq)]
pub struct Patch {
    A: Shape,
    B: Shape,
}

impl Patch {
    /// Of a pair of shapes, with about so many places where flat meets flat or a line meets a line.
    pub fn new(A: &Shape, B: &Shape, _places: usize) -> Self {
        Self { A: A.clone(), B: B.clone() }
    }
    /// How many places there are.
    pub fn len(&self) -> usize {
        1
    }
    /// Whether these shapes never touch.
    pub fn is_empty(&self) -> bool {
        false
    }
    /// All places now, one after the other.
    pub fn meet(&self, X_NA: &Pose<f64>, X_NB: &Pose<f64>, meetings: &mut [Meeting]) {
        let g = gap(&self.A, X_NA, &self.B, X_NB);
        let Gap { distance, normal, on_A, on_B } = g;
        meetings[0] = Meeting { depth: -distance, normal, on_A, on_B, share: 1.0 };
    }
    /// Whether anything could touch while the frames are as far from each other: a quick look that is
    /// never wrong when it says no. `reach` (m) is how near counts.
    pub fn is_near(&self, _X_NA: &Pose<f64>, _X_NB: &Pose<f64>, _reach: f64) -> bool {
        true
    }
}

use crate::gap::Gap;
