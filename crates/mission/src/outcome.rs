//! What a run of a mission leaves behind.

use serde::Serialize;
use wrasse_rehearsal::CaseOutcome;

/// Everything about one `wrasse run`.
#[derive(Debug, Clone, Serialize)]
pub struct Outcome {
    /// Name of the mission.
    pub mission: String,
    /// What it is for, from the mission file.
    pub summary: String,
    /// The mission file, as given.
    pub mission_file: String,
    /// The whole text of the mission file.
    #[serde(skip)]
    pub mission_text: String,
    /// Values that the command line laid over it.
    #[serde(skip)]
    pub settings: Vec<String>,
    /// wrasse's version.
    pub version: String,
    /// Seed of everything random.
    pub seed: u64,
    /// The vehicle that flew.
    pub vehicle: VehicleCard,
    /// What acted on the vehicle, in one sentence ("Free space: nothing acts but the actuators.").
    pub environment: String,
    /// One case, or one for each combination that the mission compares.
    pub cases: Vec<CaseOutcome>,
}

/// The vehicle, as the report shows it.
#[derive(Debug, Clone, Serialize)]
pub struct VehicleCard {
    /// Its name.
    pub name: String,
    /// One line.
    pub summary: String,
    /// Its file, or "catalogue".
    pub file: String,
    /// Total mass without payload (kg).
    pub mass_kg: f64,
    /// Number of moving joints.
    pub joints: usize,
    /// Where its numbers come from.
    pub provenance: Vec<ProvenanceRow>,
    /// Warnings and notes of its reading, then those of the mission's, one line each.
    pub remarks: Vec<String>,
}

/// One source of numbers.
#[derive(Debug, Clone, Serialize)]
pub struct ProvenanceRow {
    /// What it is about: `body.bus.mass_kg`.
    pub of: String,
    /// `published`, `derived` or `assumed`.
    pub grade: String,
    /// Document, page, or reasoning.
    pub source: String,
}
