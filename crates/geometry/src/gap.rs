//! How far two shapes are from each other.

use crate::shape::Shape;
use wrasse_spatial::{Pose, Vec3};

/// How far two shapes are from each other, in the axes in which their poses are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gap {
    /// Between their surfaces (m); where they overlap, less than zero: the shortest way that parts them.
    pub distance: f64,
    /// Out of B, towards A, of length one.
    pub normal: Vec3<f64>,
    /// The nearest point of A (m).
    pub on_A: Vec3<f64>,
    /// The nearest point of B (m): `on_B + distance normal = on_A`.
    pub on_B: Vec3<f64>,
}

/// The gap between shape A and shape B at their poses.
pub fn gap(A: &Shape, X_NA: &Pose<f64>, B: &Shape, X_NB: &Pose<f64>) -> Gap {
    let Shape::Sphere { radius } = A else { unimplemented!() };
    let p = X_NB.inverse().point(X_NA.translation);
    let near = crate::nearest(B, p);
    let normal = X_NB.rotation * near.normal;
    let on_A = X_NA.translation - normal * *radius;
    let distance = near.distance - radius;
    Gap { distance, normal, on_A, on_B: on_A - normal * distance }
}
