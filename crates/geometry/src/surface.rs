//! The surface of a shape, as seen from a point.

use crate::shape::Shape;
use wrasse_spatial::{Vec3, vec3};

/// The place on a surface that is nearest to a point, in the axes of the shape's frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nearest {
    /// From the surface to the point (m): negative inside.
    pub distance: f64,
    /// Out of the shape, of length one: the gradient of the distance.
    pub normal: Vec3<f64>,
}

/// The nearest place on the surface of a shape to a point of its frame (m).
pub fn nearest(shape: &Shape, p: Vec3<f64>) -> Nearest {
    match shape {
        Shape::Sphere { radius } => {
            let far = p.norm();
            let normal = if far > 0.0 { p * (1.0 / far) } else { vec3(0.0, 0.0, 1.0) };
            Nearest { distance: far - radius, normal }
        }
        Shape::Plane => Nearest { distance: p.z, normal: vec3(0.0, 0.0, 1.0) },
        other => unimplemented!("{other:?}"),
    }
}
