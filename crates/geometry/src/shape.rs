//! The kinds of shapes, as plain data.

use wrasse_spatial::Vec3;

/// A shape about its own frame.
#[derive(Debug, Clone, PartialEq)]
pub enum Shape {
    /// A ball about the origin. A radius of zero is a point.
    Sphere {
        /// (m)
        radius: f64,
    },
    /// A cylinder along z with half balls on its ends.
    Capsule {
        /// (m)
        radius: f64,
        /// Between the middles of its ends (m).
        length: f64,
    },
    /// A box about the origin, its edges and corners rounded.
    Box {
        /// Outer edge lengths (m).
        edges: Vec3<f64>,
        /// Radius of edges and corners, zero of a sharp box (m).
        rounding: f64,
    },
    /// A cylinder along z about the origin.
    Cylinder {
        /// (m)
        radius: f64,
        /// (m)
        length: f64,
    },
    /// The frustum of a cone along z about the origin; with a wall it is hollow and open at both ends.
    Cone {
        /// Outer radius at -length/2 (m).
        bottom_radius: f64,
        /// Outer radius at +length/2 (m).
        top_radius: f64,
        /// (m)
        length: f64,
        /// Thickness of the wall, measured across z (m); none of a solid cone.
        wall: Option<f64>,
    },
    /// The half-space below z = 0: its surface has no end.
    Plane,
    /// A ring about z: the loop of a snare.
    Torus {
        /// Of the middle line (m).
        radius: f64,
        /// Of the tube (m).
        tube: f64,
    },
    /// A round hole into a cylindrical block below z = 0, about z, open at its bottom.
    Bore {
        /// Of the hole (m).
        radius: f64,
        /// Of the block, and so of the hole (m).
        depth: f64,
        /// Outer radius of the block (m).
        block_radius: f64,
        /// How far the chamfer reaches down from the mouth (m).
        chamfer_depth: f64,
        /// Angle between the chamfer's surface and z (rad).
        chamfer_angle: f64,
    },
    /// A straight channel along x, open towards +z: walls and floor of a guide.
    Rail {
        /// Clear width between the walls, along y (m).
        width: f64,
        /// Height of the walls above the floor, which is at z = 0 (m).
        height: f64,
        /// Thickness of walls and floor (m).
        wall: f64,
        /// Along x (m).
        length: f64,
    },
}
