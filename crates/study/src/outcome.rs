//! What a study leaves behind: demands, sets, verdicts, findings. Plain data for those who record or
//! draw it.

use crate::bounds::Bounds;
use crate::demand::Demand;
use crate::envelope::Mesh;
use crate::judgement::Answer;
use serde::Serialize;
use wrasse_mission::ProvenanceRow;

/// Everything about one `wrasse size`.
#[derive(Debug, Clone, Serialize)]
pub struct StudyOutcome {
    /// Name of the study.
    pub study: String,
    /// What it is for, from its file.
    pub summary: String,
    /// The file, as given.
    pub file: String,
    /// The whole text of the file.
    #[serde(skip)]
    pub text: String,
    /// Values that the command line laid over it.
    #[serde(skip)]
    pub settings: Vec<String>,
    /// wrasse's version.
    pub version: String,
    /// Seed of everything random.
    pub seed: u64,
    /// What the study puts to the test, in the words of its file.
    pub claim: String,
    /// Most mass that a set may have (kg), if the study says so.
    pub mass_limit_kg: Option<f64>,
    /// Most power that a set may take (W), if the study says so.
    pub power_limit_w: Option<f64>,
    /// Number of cases that were flown.
    pub flights: usize,
    /// Whether the ledger of every flight closes.
    pub closes: bool,
    /// The sets of actuators, in the order of the file.
    pub sets: Vec<SetCard>,
    /// What each task asks, and how the sets stand to it.
    pub tasks: Vec<TaskOutcome>,
    /// What follows for the claim.
    pub findings: Vec<Finding>,
}

/// What a set is made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum SetKind {
    /// Any torque at once: the reference.
    Ideal,
    /// The vehicle's ideal actuator, within its limits.
    Actuator,
    /// Reaction wheels alone.
    Wheels,
    /// Control moment gyros, with or without wheels.
    Cmgs,
    /// Thrusters alone.
    Thrusters,
    /// Thrusters beside wheels or CMGs.
    Hybrid,
    /// None at all.
    Nothing,
}

/// A set of actuators, as tables and figures show it.
#[derive(Debug, Clone, Serialize)]
pub struct SetCard {
    /// Its name.
    pub name: String,
    /// What it is made of.
    pub kind: SetKind,
    /// Mass of its units (kg), if each says its own.
    pub mass_kg: Option<f64>,
    /// Power of its units (W), if each says its own.
    pub power_w: Option<f64>,
    /// Whether the mass is within the study's limit; none without a limit or a mass.
    pub within_mass_limit: Option<bool>,
    /// Whether the power is within the study's limit; none without a limit or a power.
    pub within_power_limit: Option<bool>,
    /// Propellant at the start (kg), if it has a tank.
    pub propellant_kg: Option<f64>,
    /// Torque along x, y and z of the base (N·m); none if endless.
    pub torque_nm: [Option<Bounds<f64>>; 3],
    /// Momentum along x, y and z of the base (N·m·s); none if endless.
    pub momentum_nms: [Option<Bounds<f64>>; 3],
    /// Momentum that it holds in every direction, with the best steering (N·m·s); none if endless.
    pub momentum_everywhere_nms: Option<f64>,
    /// Where its numbers come from.
    pub provenance: Vec<ProvenanceRow>,
    /// Its momentum as surfaces, the outermost first; none without wheels and CMGs.
    #[serde(skip)]
    pub surfaces: Vec<Mesh>,
}

/// A task: what it asks, and how each set stands to it.
#[derive(Debug, Clone, Serialize)]
pub struct TaskOutcome {
    /// Its name: the rows of all axes but that of the sets.
    pub name: String,
    /// (axis, row) of all axes but that of the sets.
    pub labels: Vec<(String, String)>,
    /// Why there is no demand, where its flight did not come to its end.
    pub unflown: Option<String>,
    /// Whether it is the vehicle's own motion, which can be done more slowly; else something from
    /// outside acts on the tool.
    pub own_motion: bool,
    /// How long it takes (s).
    pub duration_s: f64,
    /// Largest torque that the base needs (N·m).
    pub peak_torque_nm: f64,
    /// Largest torque about each axis of the base, whenever it is (N·m).
    pub peak_torque_by_axis_nm: [f64; 3],
    /// Largest momentum that has to be held (N·m·s).
    pub peak_momentum_nms: f64,
    /// Momentum gathered every second at the end, if the end is no rest (N·m·s/s).
    pub gathered_nm: Option<f64>,
    /// The same by hand.
    pub by_hand: Option<HandCheck>,
    /// Largest error of the tool with the reference (mm).
    pub tool_error_mm: f64,
    /// How each set stands to it, in the order of the sets.
    pub verdicts: Vec<SetVerdict>,
    /// What it asks, over time.
    #[serde(skip)]
    pub demand: Demand,
}

/// A demand by hand.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct HandCheck {
    /// Momentum (N·m·s).
    pub momentum: f64,
    /// Peak torque (N·m).
    pub torque: f64,
    /// How, with the numbers.
    pub how: String,
}

/// How a set stands to a task.
#[derive(Debug, Clone, Serialize)]
pub struct SetVerdict {
    /// Name of the set.
    pub set: String,
    /// Torque, momentum and propellant together, for as long as the task lasts.
    pub suffices: Answer,
    /// Whether the torque can be given.
    pub torque: Answer,
    /// Whether the momentum can be held.
    pub momentum: Answer,
    /// Whether the tank holds the propellant for it; yes where none is needed or no tank is given.
    pub propellant: Answer,
    /// Torque asked over torque there is, at its worst (–); none where there is none.
    pub torque_load: Bounds<Option<f64>>,
    /// Torque along the peak of the demand (N·m); none if endless.
    pub torque_nm: Bounds<Option<f64>>,
    /// Momentum along the peak of the demand (N·m·s); none if endless.
    pub momentum_nms: Bounds<Option<f64>>,
    /// When the set can hold no more (s); none if never.
    pub saturates_s: Bounds<Option<f64>>,
    /// How many times slower the task must be; none if that is no remedy.
    pub slower: Bounds<Option<f64>>,
    /// Propellant for the torque (kg).
    pub fuel_kg: Option<f64>,
    /// Propellant for the torque and for the force that keeps the base in place (kg).
    pub fuel_in_place_kg: Option<f64>,
    /// What came of it in closed loop, where it was flown.
    pub flown: Option<Flown>,
}

/// A task flown in closed loop with a set.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Flown {
    /// Largest error of the tool (mm).
    pub tool_error_mm: f64,
    /// Error of the tool at the end (mm).
    pub tool_error_at_end_mm: f64,
    /// Largest attitude error of the base (deg).
    pub attitude_error_deg: f64,
    /// Propellant that was used (kg).
    pub propellant_kg: Option<f64>,
    /// Whether all requirements of the study's file hold.
    pub requirements_hold: bool,
    /// How it ended, if not at its end.
    pub ended: Option<String>,
    /// First limit that was reached.
    pub limit: Option<String>,
    /// Whether its ledger closes.
    pub closes: bool,
}

/// Something that follows from the verdicts.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Finding {
    /// What it is about.
    pub about: String,
    /// What follows, with numbers.
    pub text: String,
    /// The tasks that it rests on.
    pub tasks: Vec<String>,
}
