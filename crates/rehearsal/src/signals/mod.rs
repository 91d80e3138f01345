//! The signals of a flight, one row each: name, kind, statistics, what must be worked out for it, the plot
//! that it belongs to, and its value. Quantities, statistics, telemetry and what a sweep works out are
//! read from here.

pub(crate) mod actuator_demand;
mod any_vehicle;
pub(crate) mod arm_shape;
mod joint_signals;
pub(crate) mod observe;
pub(crate) mod quantity;
pub(crate) mod requirement;
pub(crate) mod tool_signals;
pub(crate) mod watch;

use crate::case::Case;
use crate::signals::actuator_demand::ActuatorDemand;
pub(crate) use crate::signals::any_vehicle::SIGNALS;
use crate::signals::joint_signals::JOINT_SIGNALS;
use crate::signals::observe::{Observation, Track};
use crate::signals::quantity::{Kind, Quantity, Statistic};
use crate::signals::tool_signals::{TOOL_SIGNALS, TOOLS, ToolError, watched_tools};
use wrasse_flight::Command;
use wrasse_vehicle::JOINTS;

/// What is worked out beside where everything is: the rest costs time, and is NaN where it is not needed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(clippy::struct_excessive_bools, reason = "each is a need of its own")]
pub struct Needs {
    /// Accelerations, forces of the joints, torque on the base.
    pub(crate) dynamics: bool,
    /// Forces at the mounts, and what the base feels of the arms.
    pub(crate) mounts: bool,
    /// How near the arm is to its reach and to a singular posture.
    pub(crate) shape: bool,
    pub(crate) energy: bool,
    /// What wheels, CMGs and tank say of themselves.
    pub(crate) readings: bool,
    /// Torque of the gimbals' motors.
    pub(crate) motors: bool,
}

impl Needs {
    const NONE: Self = Self {
        dynamics: false,
        mounts: false,
        shape: false,
        energy: false,
        readings: false,
        motors: false,
    };
    const DYNAMICS: Self = Self { dynamics: true, ..Self::NONE };
    const MOUNTS: Self = Self { mounts: true, ..Self::DYNAMICS };
    const SHAPE: Self = Self { shape: true, ..Self::NONE };
    const ENERGY: Self = Self { energy: true, ..Self::NONE };
    const READINGS: Self = Self { readings: true, ..Self::NONE };
    const MOTORS: Self = Self { motors: true, ..Self::NONE };
    /// Everything.
    pub const ALL: Self = Self {
        dynamics: true,
        mounts: true,
        shape: true,
        energy: true,
        readings: true,
        motors: true,
    };
    fn and(self, other: Self) -> Self {
        Self {
            dynamics: self.dynamics || other.dynamics,
            mounts: self.mounts || other.mounts,
            shape: self.shape || other.shape,
            energy: self.energy || other.energy,
            readings: self.readings || other.readings,
            motors: self.motors || other.motors,
        }
    }
    /// What the signals of these numbers need, in a case.
    pub fn of(case: &Case, numbers: &[usize]) -> Self {
        let tools = watched_tools(&case.vehicle).len();
        numbers.iter().fold(Self::NONE, |all, &number| all.and(needs(number, tools)))
    }
}

/// What the value of a signal may look at.
pub(crate) struct Seen<'a> {
    pub(crate) case: &'a Case,
    pub(crate) command: &'a Command<f64, JOINTS>,
    pub(crate) track: &'a Track,
    pub(crate) truth: &'a Observation,
    pub(crate) asked: &'a ActuatorDemand,
    /// Angle of the estimated attitude from the true one (rad); NaN where nothing is estimated.
    pub(crate) estimate_error: f64,
    /// Largest force (N) and moment (N·m) at a mount.
    pub(crate) mounts: (f64, f64),
    /// How much farther the tool could reach (m), and how far the arm is from a singular posture (–).
    pub(crate) shape: (f64, f64),
    /// (J)
    pub(crate) energy: f64,
    /// Of the propellant from the axis of its tank (rad); NaN where none swings.
    pub(crate) slosh_angle: f64,
    /// Largest torque of a gimbal's motor (N·m).
    pub(crate) motors: f64,
    /// Errors of the tools that have signals of their own, while an arm guides them.
    pub(crate) tools: [Option<ToolError>; TOOLS],
}

/// Where a signal is drawn.
pub(crate) struct Plot {
    pub(crate) title: &'static str,
    pub(crate) label: &'static str,
    /// Its unit there, and how many of it are one in SI.
    pub(crate) unit: &'static str,
    pub(crate) per_si: f64,
    /// Whether the case has it.
    pub(crate) shown: fn(&Case) -> bool,
}

/// A signal of any vehicle.
pub(crate) struct Signal {
    pub(crate) name: &'static str,
    /// What it is, in words.
    pub(crate) meaning: &'static str,
    kind: Kind,
    statistics: &'static [Statistic],
    needs: Needs,
    pub(crate) plot: Option<Plot>,
    /// NaN where it is absent.
    pub(crate) value: fn(&Seen<'_>) -> f64,
}

/// A row without a plot.
const fn row(
    name: &'static str,
    meaning: &'static str,
    kind: Kind,
    statistics: &'static [Statistic],
    needs: Needs,
    value: fn(&Seen<'_>) -> f64,
) -> Signal {
    Signal { name, meaning, kind, statistics, needs, plot: None, value }
}

impl Signal {
    /// Drawn in a plot, always.
    const fn drawn(
        self,
        title: &'static str,
        label: &'static str,
        unit: &'static str,
        per_si: f64,
    ) -> Self {
        self.drawn_if(title, label, (unit, per_si), |_| true)
    }
    /// Drawn in a plot where a case has it.
    const fn drawn_if(
        mut self,
        title: &'static str,
        label: &'static str,
        (unit, per_si): (&'static str, f64),
        shown: fn(&Case) -> bool,
    ) -> Self {
        self.plot = Some(Plot { title, label, unit, per_si, shown });
        self
    }
}

/// Most signals that a vehicle can have.
pub(crate) const MOST: usize =
    SIGNALS.len() + TOOL_SIGNALS.len() * TOOLS + JOINT_SIGNALS.len() * JOINTS;

/// All quantities: those of any vehicle, then those of each of several tools, then those of each joint and
/// whether it turns.
pub fn quantities(tools: &[String], joints: &[(String, bool)]) -> Vec<Quantity> {
    let quantity = |signal: &Signal| Quantity {
        name: signal.name.into(),
        meaning: signal.meaning.into(),
        kind: signal.kind,
        statistics: signal.statistics,
    };
    let of_joint = |(name, turns): &(String, bool)| {
        let (name, turns) = (name.clone(), *turns);
        JOINT_SIGNALS.iter().map(move |signal| Quantity {
            name: format!("joint.{name}.{}", signal.name),
            meaning: signal.meaning.into(),
            kind: signal.kinds[usize::from(!turns)],
            statistics: signal.statistics,
        })
    };
    let of_tool = |tool: &String| {
        let tool = tool.clone();
        TOOL_SIGNALS.iter().map(move |signal| Quantity {
            name: format!("tool.{tool}.{}", signal.name),
            meaning: signal.meaning.into(),
            kind: signal.kind,
            statistics: signal.statistics,
        })
    };
    let of_tools = tools.iter().flat_map(of_tool);
    SIGNALS.iter().map(quantity).chain(of_tools).chain(joints.iter().flat_map(of_joint)).collect()
}

/// Values of all signals, in the order of the quantities; NaN behind the last.
pub(crate) fn values(seen: &Seen<'_>) -> [f64; MOST] {
    let mut all = [f64::NAN; MOST];
    let of_any = SIGNALS.iter().map(|signal| (signal.value)(seen));
    let joints = seen.case.vehicle.robot.joints();
    let of_joints = joints.flat_map(|j| JOINT_SIGNALS.iter().map(move |s| (s.value)(seen, j)));
    let tools = watched_tools(&seen.case.vehicle).len();
    let of_tools = seen.tools.iter().take(tools).flat_map(|error| {
        TOOL_SIGNALS.iter().map(move |s| error.map_or(f64::NAN, |error| (s.value)(&error)))
    });
    let values = of_any.chain(of_tools).chain(of_joints);
    all.iter_mut().zip(values).for_each(|(to, value)| *to = value);
    all
}

/// The tools that have signals of their own, with the values of these (m, rad).
pub(crate) fn tool_values<'c>(
    case: &'c Case,
    values: &[f64; MOST],
) -> impl Iterator<Item = (&'c str, [f64; TOOL_SIGNALS.len()])> {
    let values = *values;
    watched_tools(&case.vehicle).iter().enumerate().map(move |(i, tool)| {
        let first = SIGNALS.len() + TOOL_SIGNALS.len() * i;
        (tool.as_str(), std::array::from_fn(|k| values[first + k]))
    })
}

/// What the signal of a number needs, where so many tools have signals of their own.
fn needs(number: usize, tools: usize) -> Needs {
    if number < SIGNALS.len() {
        return SIGNALS[number].needs;
    }
    let of_joints = (number - SIGNALS.len()).checked_sub(TOOL_SIGNALS.len() * tools);
    of_joints.map_or(Needs::NONE, |i| JOINT_SIGNALS[i % JOINT_SIGNALS.len()].needs)
}

/// Number of a signal of any vehicle.
const fn number_of(name: &str) -> usize {
    let mut i = 0;
    while i < SIGNALS.len() {
        if is_same(SIGNALS[i].name.as_bytes(), name.as_bytes()) {
            return i;
        }
        i += 1;
    }
    panic!("no signal of this name")
}

const fn is_same(a: &[u8], b: &[u8]) -> bool {
    let mut i = 0;
    while i < a.len() && i < b.len() && a[i] == b[i] {
        i += 1;
    }
    a.len() == b.len() && i == a.len()
}

/// How far the CMGs are from a singular setting; that there is such a signal is checked as this is built.
pub(crate) const CMG_SINGULARITY: usize = number_of("cmgs.singularity_distance");

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    #[test]
    fn no_two_signals_share_a_name() {
        let names: Vec<String> =
            quantities(&["t".into()], &[("a".into(), true), ("b".into(), false)])
                .into_iter()
                .map(|q| q.name)
                .collect();
        for (i, name) in names.iter().enumerate() {
            assert!(!names[..i].contains(name), "{name}");
        }
    }

    /// A row of the guide for a quantity.
    fn row_of(quantity: &Quantity) -> String {
        let statistics: Vec<_> = quantity.statistics.iter().map(|s| s.name()).collect();
        let units = if quantity.name.starts_with("joint.") {
            "as the joint turns or slides".to_owned()
        } else {
            quantity.kind.units().join(", ")
        };
        let Quantity { name, meaning, .. } = quantity;
        format!("| `{name}` | {meaning} | {} | {units} |\n", statistics.join(", "))
    }

    /// The table of the guide is that of the signals. `WRASSE_WRITE_FIGURES=1` writes it.
    #[test]
    fn the_guide_has_the_table_of_signals() {
        let path =
            Path::new(env!("CARGO_MANIFEST_DIR")).join("../../book/src/guide/mission_files.md");
        let guide = std::fs::read_to_string(&path).expect("the guide");
        let head = "| quantity | what it is | statistics | units |\n|---|---|---|---|\n";
        let all = quantities(&["NAME".into()], &[("NAME".into(), true)]);
        let rows: String = all.iter().map(row_of).collect();
        let (before, rest) = guide.split_once(head).expect("the table's head");
        let end = rest.find("\n\n").expect("an end of the table") + 1;
        if std::env::var_os("WRASSE_WRITE_FIGURES").is_some() {
            let whole = [before, head, &rows, &rest[end..]].concat();
            std::fs::write(&path, whole).expect("room for the guide");
            return;
        }
        assert!(rest[..end] == rows, "the guide's table is not that of the signals:\n{rows}");
    }
}
