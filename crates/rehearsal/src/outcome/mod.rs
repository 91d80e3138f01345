//! What a run leaves behind: verdicts, ledger, telemetry, pictures. Plain data for those who
//! record, draw or judge it.

pub(crate) mod ledger;
pub(crate) mod snapshot;
pub(crate) mod telemetry;

use crate::case::Setting;
use crate::signals::observe::Observation;
use serde::{Deserialize, Serialize};
use wrasse_flight::Command;
use wrasse_vehicle::JOINTS;
use wrasse_world::{Account, Bookings};

/// How a case ended.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", tag = "kind")]
pub enum End {
    /// All phases were flown.
    Completed,
    /// The planning found that the way cannot be gone; nothing moved.
    Infeasible {
        /// Phase that cannot be flown.
        phase: String,
        /// Mission time at which the way ends (s).
        time_s: f64,
        /// Where and why the way ends, with numbers.
        reason: String,
    },
    /// The run was stopped by an outcome of a phase (a refused grasp, say).
    Stopped {
        /// Phase that stopped it.
        phase: String,
        /// Mission time (s).
        time_s: f64,
        /// Why, with numbers.
        reason: String,
    },
    /// A number was no longer finite.
    Breakdown {
        /// Mission time (s).
        time_s: f64,
        /// Which quantity of which body.
        reason: String,
    },
}

/// One case: what was asked, what came of it.
#[derive(Debug, Clone, Serialize)]
pub struct CaseOutcome {
    /// What tells it from the others: (axis, row) as the mission file names them; empty for a
    /// mission with a single case.
    pub labels: Vec<(String, String)>,
    /// How it ended.
    pub end: End,
    /// All requirements hold and the ledger closes.
    pub passed: bool,
    /// Requirements and their verdicts, in the order of the file.
    pub verdicts: Vec<Verdict>,
    /// Every metric that could have been required, in a fixed order.
    pub metrics: Vec<Metric>,
    /// Momentum and energy.
    pub ledger: Ledger,
    /// Laws and world as they were flown, and which of the settings are defaults.
    pub as_flown: Vec<Setting>,
    /// What was planned before the arm moved, a line for each phase.
    pub plan: Vec<PlanLine>,
    /// Things that happened, in order: phases, limits reached, saturations.
    pub events: Vec<Event>,
    /// Integration error, if asked for.
    pub error_estimate: Vec<Metric>,
    /// Time histories.
    #[serde(skip)]
    pub telemetry: Telemetry,
    /// What was asked of the base, in every control period.
    #[serde(skip)]
    pub demand: Vec<DemandSample>,
    /// The motion, for a drawing.
    #[serde(skip)]
    pub snapshots: Vec<Snapshot>,
}

/// What was asked of whatever turns the base, in one control period.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DemandSample {
    /// Mission time at the end of the period (s).
    pub time: f64,
    /// Torque that the base should feel, base axes (N·m).
    pub torque_B: [f64; 3],
    /// Momentum that is stored at the end, base axes (N·m·s).
    pub momentum_B: [f64; 3],
    /// Distance of the tool from its reference (m).
    pub tool_error: f64,
    /// Angle of the base from where it began (rad).
    pub base_turn: f64,
}

impl DemandSample {
    pub(crate) fn of(time: f64, command: &Command<f64, JOINTS>, seen: &Observation) -> Self {
        Self {
            time,
            torque_B: command.attitude_torque_B.to_array(),
            momentum_B: seen.stored_B.to_array(),
            tool_error: seen.tool_error.0.norm(),
            base_turn: seen.base_turn.norm(),
        }
    }
}

/// What the planning found for one phase.
#[derive(Debug, Clone, Serialize)]
pub struct PlanLine {
    /// Name of the phase.
    pub phase: String,
    /// What was found, with numbers.
    pub text: String,
}

/// What kind of thing happened.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum EventKind {
    /// A phase began.
    Phase,
    /// Something was grasped or released.
    Grip,
    /// A limit was reached or passed.
    Limit,
    /// A unit failed, or the flight computer was told of it.
    Failure,
    /// The condition of a step held.
    Condition,
    /// A step ended otherwise: by a timeout, a refused grasp, or because it could not begin.
    Fault,
}

/// Something that happened.
#[derive(Debug, Clone, Serialize)]
pub struct Event {
    /// Mission time (s).
    pub time_s: f64,
    /// What kind of thing it is.
    pub kind: EventKind,
    /// What happened, with numbers.
    pub text: String,
}

/// One requirement and its verdict. Values are in the unit the requirement was written in.
#[derive(Debug, Clone, Serialize)]
pub struct Verdict {
    /// The requirement as written.
    pub requirement: String,
    /// `<=` or `>=` and so on.
    pub comparison: String,
    /// The limit.
    pub limit: f64,
    /// What came out; absent where the run ended before there was a value.
    pub value: Option<f64>,
    /// Unit of limit and value.
    pub unit: String,
    /// Whether it holds.
    pub pass: bool,
}

/// A named number.
#[derive(Debug, Clone, Serialize)]
pub struct Metric {
    /// Its name, as requirements use it: `tool.position_error.max`.
    pub name: String,
    /// Value in SI (or degrees where the unit says so).
    pub value: f64,
    /// Unit.
    pub unit: String,
}

/// Momentum and energy of a run, inertial axes, and who changed them. Angular momentum is about the origin
/// of N.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Ledger {
    /// At the start.
    pub start: Account,
    /// At the end.
    pub end: Account,
    /// What each source has given the bodies.
    pub sources: Bookings,
    /// Propellant that left (kg).
    pub propellant: f64,
    /// What no source explains, largest over the run: angular (N·m·s), linear (N·s), energy (J).
    pub residual: [f64; 3],
    /// What was in play, largest over the run: the sums of the bodies' absolute momenta, the energy.
    pub scale: [f64; 3],
    /// Whether each residual is within its bound.
    pub closes: bool,
    /// The bounds that were applied, relative to the scales.
    pub bounds: [f64; 3],
}

/// Time histories of one case.
#[derive(Debug, Clone, Default)]
pub struct Telemetry {
    /// Sample times (s).
    pub time: Vec<f64>,
    /// Name of the phase that each sample belongs to; empty once all are done.
    pub phase: Vec<String>,
    /// The channels, each as long as `time`.
    pub channels: Vec<Channel>,
}

/// One quantity over time.
#[derive(Debug, Clone)]
pub struct Channel {
    /// Name with dots, ending in the component: `base.attitude_error.x`, `joint.joint1.rate`.
    pub name: String,
    /// Unit.
    pub unit: String,
    /// What it is, in words.
    pub meaning: String,
    /// The plot it belongs to: channels of one plot share a unit (or a second axis). Empty for a channel
    /// that is not drawn.
    pub plot: String,
    /// The line's name in the plot.
    pub label: String,
    /// Values, one for each sample time; NaN where there is none.
    pub values: Vec<f64>,
}

/// The vehicle at one instant, as lines and boxes in inertial axes (m).
#[derive(Debug, Clone)]
pub struct Snapshot {
    /// Mission time (s).
    pub time: f64,
    /// Wire boxes: eight corners each, in the order of binary counting (x fastest).
    pub boxes: Vec<SnapshotBox>,
    /// The arms: each a line through its joints from the base to the tool.
    pub arms: Vec<Vec<[f64; 3]>>,
    /// The tool's position.
    pub tool: [f64; 3],
    /// Where the tool should be.
    pub reference: [f64; 3],
    /// Name of the tool that is guided then.
    pub guided: String,
}

/// A box in a drawing.
#[derive(Debug, Clone)]
pub struct SnapshotBox {
    /// What it is (a link, a payload).
    pub name: String,
    /// Corners (m).
    pub corners: [[f64; 3]; 8],
}
