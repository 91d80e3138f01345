//! What was drawn: the values flown beside their deviations from the files.

use crate::row::Row;
use serde::Serialize;
use wrasse_mission::Mission;

/// A quantity that is drawn anew in each sample.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Drawn {
    /// Its name: `payload.module.mass_kg`.
    pub quantity: String,
    /// Unit of all its values; `%` of the value in the files.
    pub unit: String,
    /// What the files say. A rotation counts from there: zero.
    pub nominal: f64,
    /// The least value that was flown; absent without samples.
    pub least: Option<f64>,
    /// The largest.
    pub largest: Option<f64>,
}

/// Its value in one sample.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DrawnValue {
    /// Its name.
    pub quantity: String,
    /// The value flown, in its unit.
    pub flown: f64,
    /// How far that is from what the files say.
    pub deviation: f64,
    /// Unit of both.
    pub unit: String,
}

impl Drawn {
    /// All that is drawn in a case.
    pub(crate) fn all(mission: &Mission, case: usize, rows: &[Row]) -> Vec<Self> {
        let names = mission.cases[case].dispersed().into_iter().zip(mission.cases[case].nominal());
        let each = names.enumerate().map(|(i, (name, (nominal, unit)))| {
            let flown = || rows.iter().map(|row| nominal + row.deviations[i]);
            Self {
                quantity: name.into(),
                unit: unit.into(),
                nominal,
                least: flown().reduce(f64::min),
                largest: flown().reduce(f64::max),
            }
        });
        each.collect()
    }

    /// Its value in a sample that deviates so much.
    pub fn with(&self, deviation: f64) -> DrawnValue {
        DrawnValue {
            quantity: self.quantity.clone(),
            flown: self.nominal + deviation,
            deviation,
            unit: self.unit.clone(),
        }
    }
}
