//! Liquid that swings in a tank: the shape of the tank, what damps the swing, what restores it.

use wrasse_spatial::{Real, Scalar, Vec3};

/// Depth, as a share of the radius, below which the liquid is still: the pendulum of a film is endless.
const SHALLOW: f64 = 0.1;
/// Depth, as a share of the height, above which the liquid in a sphere is still: next to nothing swings.
const BRIMFUL: f64 = 0.95;

/// The inside of a tank.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum TankShape {
    /// An upright cylinder with a flat bottom.
    UprightCylinder {
        /// (m)
        radius: f64,
        /// (m)
        height: f64,
    },
    /// A sphere.
    Sphere {
        /// (m)
        radius: f64,
    },
}

impl TankShape {
    /// Radius (m).
    pub fn radius(&self) -> f64 {
        match *self {
            Self::UprightCylinder { radius, .. } | Self::Sphere { radius } => radius,
        }
    }
    /// From bottom to top (m).
    pub fn height(&self) -> f64 {
        match *self {
            Self::UprightCylinder { height, .. } => height,
            Self::Sphere { radius } => 2.0 * radius,
        }
    }
    /// How much it holds (m³).
    pub fn capacity(&self) -> f64 {
        match *self {
            Self::UprightCylinder { radius, height } => {
                core::f64::consts::PI * radius * radius * height
            }
            Self::Sphere { radius } => 4.0 / 3.0 * core::f64::consts::PI * radius * radius * radius,
        }
    }
    /// How deep a volume (m³) of liquid is that hangs along the axis (m); of more than the capacity the
    /// depth of a cylinder that goes on, and NaN in a sphere.
    pub fn depth(&self, volume: f64) -> f64 {
        match *self {
            Self::UprightCylinder { radius, .. } => {
                volume / (core::f64::consts::PI * radius * radius)
            }
            Self::Sphere { radius } => {
                // The surface is x radii above the centre: x³ - 3x + 3v - 2 = 0.
                let v = volume / (core::f64::consts::PI * radius * radius * radius);
                let third = (Scalar::acos(1.0 - 1.5 * v) + 4.0 * core::f64::consts::PI) / 3.0;
                let (_, cos) = Real::sin_cos(third);
                radius * (1.0 + 2.0 * cos)
            }
        }
    }
    /// Centre of a liquid of some depth (m) above the bottom (m).
    pub fn centre_height(&self, depth: f64) -> f64 {
        match *self {
            Self::UprightCylinder { .. } => 0.5 * depth,
            Self::Sphere { radius } => {
                depth * (8.0 * radius - 3.0 * depth) / (12.0 * radius - 4.0 * depth)
            }
        }
    }
}

/// A tank and a liquid in it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slosh {
    /// Unit axis of the tank, from its bottom to its top, base axes (–).
    pub axis_B: Vec3<f64>,
    /// The inside of the tank.
    pub shape: TankShape,
    /// Density of the liquid (kg/m³).
    pub density: f64,
    /// Damping ratio of the first mode (–) where `acceleration` and `stiffness` restore it.
    pub damping_ratio: f64,
    /// Acceleration of the tank along its axis for which the damping ratio holds (m/s²).
    pub acceleration: f64,
    /// Stiffness of what brings the liquid back to the axis without any acceleration, surface tension or
    /// a device in the tank (N·m/rad).
    pub stiffness: f64,
}

impl Slosh {
    /// How deep so much liquid (kg) is (m).
    pub fn depth(&self, liquid: f64) -> f64 {
        self.shape.depth(liquid / self.density)
    }
    /// Whether so much liquid (kg) swings: it is neither a film, nor does it leave no room.
    pub fn swings(&self, liquid: f64) -> bool {
        let (depth, height) = (self.depth(liquid), self.shape.height());
        let most = match self.shape {
            TankShape::UprightCylinder { .. } => height,
            TankShape::Sphere { .. } => BRIMFUL * height,
        };
        // What is not a number does not swing.
        depth >= SHALLOW * self.shape.radius() && depth < most
    }
    /// Centre of so much liquid (kg) above the bottom (m).
    pub fn centre_height(&self, liquid: f64) -> f64 {
        self.shape.centre_height(self.depth(liquid))
    }
}

#[cfg(test)]
mod tests {
    use super::TankShape;

    const SPHERE: TankShape = TankShape::Sphere { radius: 0.4 };

    /// `∫ π (2Rz - z²) dz` to the surface and its moment, by Simpson's rule, which is exact for it.
    /// Measured 2e-16.
    #[test]
    fn the_liquid_in_a_sphere_is_its_slices() {
        for depth in [0.01, 0.2, 0.4, 0.65, 0.79] {
            let slice = |z: f64| core::f64::consts::PI * (0.8 * z - z * z);
            let of =
                |f: &dyn Fn(f64) -> f64| depth / 6.0 * (f(0.0) + 4.0 * f(0.5 * depth) + f(depth));
            let (volume, moment) = (of(&slice), of(&|z| z * slice(z)));
            assert!((SPHERE.depth(volume) / depth - 1.0).abs() < 1e-13, "{depth}");
            let centre = SPHERE.centre_height(depth);
            assert!((centre / (moment / volume) - 1.0).abs() < 1e-14, "{depth}");
        }
    }

    #[test]
    fn a_full_tank_is_as_deep_as_it_is_high() {
        for shape in [SPHERE, TankShape::UprightCylinder { radius: 0.3, height: 0.7 }] {
            let depth = shape.depth(shape.capacity() * (1.0 - 1e-15));
            assert!((depth / shape.height() - 1.0).abs() < 1e-7, "{depth}");
            let middle = shape.centre_height(shape.height());
            assert!((middle - 0.5 * shape.height()).abs() < 1e-15);
        }
        assert!(SPHERE.depth(SPHERE.capacity() * 1.01).is_nan());
    }
}
