//! Liquid that swings in a tank: the shape of the tank, what damps the swing, what restores it.

use wrasse_spatial::Vec3;

/// An upright cylinder with a flat bottom and a liquid in it.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Slosh {
    /// Unit axis of the tank, from its bottom to its top, base axes (–).
    pub axis_B: Vec3<f64>,
    /// Inner radius (m).
    pub radius: f64,
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
