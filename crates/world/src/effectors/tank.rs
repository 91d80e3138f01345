//! Propellant: a point mass in the tank that grows lighter.

use super::{Effector, Load, Stage};
use crate::source::Source;
use wrasse_dynamics::MassProperties;
use wrasse_hardware::{ActuatorReadings, Tank};
use wrasse_spatial::{Sym3, Vec3};

/// A tank with what is in it.
#[derive(Debug, Clone, Copy)]
pub struct TankWithPropellant {
    /// Where (m).
    pub position_B: Vec3<f64>,
    /// How much (kg).
    pub mass: f64,
}

impl TankWithPropellant {
    pub(crate) fn new(tank: &Tank<f64>) -> Self {
        Self { position_B: tank.position_B, mass: tank.propellant }
    }
    /// Let propellant go, as much as there is (kg): how much that was.
    pub(crate) fn draw(&mut self, wanted: f64) -> f64 {
        // What is not a number takes nothing away.
        if wanted.is_nan() || wanted <= 0.0 {
            return 0.0;
        }
        let drawn = wanted.min(self.mass);
        self.mass = if wanted < self.mass { self.mass - drawn } else { 0.0 };
        drawn
    }
}

impl<const J: usize> Effector<J> for TankWithPropellant {
    fn source(&self) -> Source {
        Source::Propellant
    }
    fn act(&self, _: &Stage<'_, J>, _: &[f64], _: &mut Load<'_, J>, _: &mut [f64]) {}
    fn mass_properties(&self) -> Option<MassProperties<f64>> {
        Some(MassProperties::from_central(self.mass, self.position_B, Sym3::zero()))
    }
    fn read(&self, _own: &[f64], _w_NB_B: Vec3<f64>, readings: &mut ActuatorReadings<f64>) {
        readings.propellant = self.mass;
    }
    fn tank(&mut self) -> Option<&mut TankWithPropellant> {
        Some(self)
    }
}
