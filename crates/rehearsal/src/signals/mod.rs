//! The signals of a flight, one row each: name, kind, statistics, what must be worked out for it, the plot
//! that it belongs to, and its value. Quantities, statistics, telemetry and what a sweep works out are
//! read from here.

pub(crate) mod actuator_demand;
pub(crate) mod arm_shape;
pub(crate) mod observe;
pub(crate) mod quantity;
pub(crate) mod requirement;
pub(crate) mod tool_signals;
pub(crate) mod watch;

use crate::case::AttitudeActuation;
use crate::case::Case;
use crate::signals::actuator_demand::{ActuatorDemand, gimbal_rates, wheel_speeds};
use crate::signals::observe::{Observation, Track, largest, there};
use crate::signals::quantity::{Kind, Quantity, Statistic};
use crate::signals::tool_signals::{TOOL_SIGNALS, TOOLS, ToolError, watched_tools};
use Statistic::{Final, Max, Min, Rms};
use wrasse_dynamics::JointKind;
use wrasse_flight::Command;
use wrasse_spatial::Vec3;
use wrasse_vehicle::JOINTS;
use wrasse_world::BaseAttitude;

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
    kind: Kind,
    statistics: &'static [Statistic],
    needs: Needs,
    value: fn(&Seen<'_>) -> f64,
) -> Signal {
    Signal { name, kind, statistics, needs, plot: None, value }
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

const MM: f64 = 1e3;
const DEG: f64 = 180.0 / std::f64::consts::PI;

/// The signals of any vehicle.
pub(crate) const SIGNALS: &[Signal] = &[
    row("tool.position_error", Kind::Length, &[Max, Final, Rms], Needs::NONE, |s| {
        off(s, s.truth.tool_error.0)
    })
    .drawn("Tool error", "distance", "mm", MM),
    row("tool.along_track_error", Kind::Length, &[Max, Final], Needs::NONE, |s| {
        s.track.split(s.truth.tool_error.0).0
    })
    .drawn("Tool error", "along the way", "mm", MM),
    row("tool.lateral_error", Kind::Length, &[Max, Final], Needs::NONE, |s| {
        s.track.split(s.truth.tool_error.0).1
    })
    .drawn("Tool error", "across it", "mm", MM),
    row("tool.attitude_error", Kind::Angle, &[Max, Final, Rms], Needs::NONE, |s| {
        off(s, s.truth.tool_error.1)
    })
    .drawn("Tool orientation error", "angle", "deg", DEG),
    row("tool.speed", Kind::Speed, &[Max, Final], Needs::NONE, |s| {
        there(s.truth.V_NE.linear.norm())
    }),
    row("tool.turn_speed", Kind::AngularSpeed, &[Max, Final], Needs::NONE, |s| {
        there(s.truth.V_NE.angular.norm())
    }),
    row("base.rotation", Kind::Angle, &[Max, Final], Needs::NONE, |s| {
        there(s.truth.base_turn.norm())
    }),
    row("base.translation", Kind::Length, &[Max, Final], Needs::NONE, |s| {
        there(s.truth.base_shift.norm())
    }),
    row("base.turn_speed", Kind::AngularSpeed, &[Max, Final], Needs::NONE, |s| {
        there(s.truth.state.V_NB_B.angular.norm())
    }),
    row("joints.rate_use", Kind::Number, &[Max], Needs::NONE, |s| {
        let limits = &s.case.vehicle.limits;
        largest_use(s, &|j| (s.asked.rates[j], limits[j].rate))
    }),
    row("joints.effort_use", Kind::Number, &[Max], Needs::DYNAMICS, |s| {
        let limits = &s.case.vehicle.limits;
        largest_use(s, &|j| (s.asked.efforts[j], limits[j].effort))
    }),
    row("joints.travel_margin", Kind::Angle, &[Min], Needs::NONE, |s| {
        travel_margin(s, JointKind::Revolute)
    }),
    row("joints.slide_margin", Kind::Length, &[Min], Needs::NONE, |s| {
        travel_margin(s, JointKind::Prismatic)
    }),
    row("arm.reach_margin", Kind::Length, &[Min, Final], Needs::SHAPE, |s| s.shape.0).drawn(
        "Reach left",
        "to the stretched arm",
        "mm",
        MM,
    ),
    row("arm.singularity_distance", Kind::Number, &[Min, Final], Needs::SHAPE, |s| s.shape.1)
        .drawn("Distance from a singular posture", "smallest singular value", "–", 1.0),
    row("mount.force", Kind::Force, &[Max], Needs::MOUNTS, |s| s.mounts.0),
    row("mount.moment", Kind::Torque, &[Max], Needs::MOUNTS, |s| s.mounts.1),
    // Of what is given and what is cut: what was asked for. What is stored goes the other way.
    row("attitude.torque", Kind::Torque, &[Max], Needs::DYNAMICS, |s| {
        given(s, s.truth.torque_B, s.asked.torque_cut_B)
    }),
    row("attitude.momentum", Kind::AngularMomentum, &[Max, Final], Needs::READINGS, |s| {
        given(s, s.truth.stored_B, -(s.asked.torque_cut_B * s.case.period()))
    }),
    row("energy", Kind::Energy, &[Max, Final], Needs::ENERGY, |s| s.energy),
    row("attitude.torque_missing", Kind::Torque, &[Max, Rms], Needs::NONE, |s| {
        missing(s.case.base == BaseAttitude::Controlled, s.asked.torque_cut_B)
    })
    .drawn_if("Torque that was wanted and not given", "missing", ("N·m", 1.0), is_fitted),
    row("attitude.force_missing", Kind::Force, &[Max, Rms], Needs::NONE, |s| {
        let holds = is_fitted(s.case) && s.case.setup.base.position_hold.is_some();
        missing(holds, s.command.allocation.missing.force)
    }),
    row("attitude.estimate_error", Kind::Angle, &[Max, Final, Rms], Needs::NONE, |s| {
        s.estimate_error
    })
    .drawn_if("Error of the attitude estimate", "angle", ("arcsec", DEG * 3600.0), |case| {
        case.sensors.is_some_and(|sensors| sensors.attitude.is_some())
    }),
    row("wheels.speed_use", Kind::Number, &[Max, Final], Needs::READINGS, |s| {
        largest(wheel_speeds(s.case, s.asked.torque_cut_B, &s.truth.readings).map(use_of))
    }),
    row("cmgs.rate_use", Kind::Number, &[Max], Needs::READINGS, |s| {
        let cut_B = s.asked.torque_cut_B;
        largest(gimbal_rates(s.case, s.command, cut_B, &s.truth.readings).map(use_of))
    }),
    row("cmgs.motor_torque", Kind::Torque, &[Max], Needs::MOTORS, |s| s.motors),
    row("cmgs.singularity_distance", Kind::Number, &[Min, Final], Needs::NONE, |s| {
        let steered = is_fitted(s.case) && has_cmgs(s.case) && !s.track.coasting;
        if steered { there(s.command.allocation.singularity) } else { f64::NAN }
    })
    .drawn_if(
        "Distance of the CMGs from a singular setting",
        "det(A Aᵀ)",
        ("–", 1.0),
        has_cmgs,
    ),
    row("thrusters.propellant_used", Kind::Mass, &[Final], Needs::READINGS, |s| {
        let tank = s.case.equipment.actuators.tank;
        tank.map_or(f64::NAN, |tank| tank.propellant) - s.truth.readings.propellant
    })
    .drawn_if("Propellant used", "used", ("g", 1e3), |case| {
        case.equipment.actuators.tank.is_some()
    }),
    row("slosh.angle", Kind::Angle, &[Max, Final, Rms], Needs::NONE, |s| s.slosh_angle).drawn_if(
        "Swing of the propellant",
        "from the axis of its tank",
        ("deg", DEG),
        |case| case.equipment.slosh.is_some(),
    ),
];

/// A signal that every joint has.
struct JointSignal {
    name: &'static str,
    /// Where the joint turns, and where it slides.
    kinds: [Kind; 2],
    statistics: &'static [Statistic],
    needs: Needs,
    value: fn(&Seen<'_>, usize) -> f64,
}

/// The signals of each joint.
const JOINT_SIGNALS: [JointSignal; 4] = [
    JointSignal {
        name: "travel",
        kinds: [Kind::Angle, Kind::Length],
        statistics: &[Max, Final],
        needs: Needs::NONE,
        value: |s, j| there(s.truth.state.q[j] - s.case.start.q[j]),
    },
    JointSignal {
        name: "commanded_travel",
        kinds: [Kind::Angle, Kind::Length],
        statistics: &[Max, Final],
        needs: Needs::NONE,
        value: |s, j| there(s.command.set_points[j].position - s.case.start.q[j]),
    },
    JointSignal {
        name: "rate",
        kinds: [Kind::AngularSpeed, Kind::Speed],
        statistics: &[Max],
        needs: Needs::NONE,
        value: |s, j| there(s.asked.rates[j]),
    },
    JointSignal {
        name: "effort",
        kinds: [Kind::Torque, Kind::Force],
        statistics: &[Max],
        needs: Needs::DYNAMICS,
        value: |s, j| there(s.asked.efforts[j]),
    },
];

/// Most signals that a vehicle can have.
pub(crate) const MOST: usize =
    SIGNALS.len() + TOOL_SIGNALS.len() * TOOLS + JOINT_SIGNALS.len() * JOINTS;

/// All quantities: those of any vehicle, then those of each of several tools, then those of each joint and
/// whether it turns.
pub fn quantities(tools: &[String], joints: &[(String, bool)]) -> Vec<Quantity> {
    let quantity = |signal: &Signal| Quantity {
        name: signal.name.into(),
        kind: signal.kind,
        statistics: signal.statistics,
    };
    let of_joint = |(name, turns): &(String, bool)| {
        let (name, turns) = (name.clone(), *turns);
        JOINT_SIGNALS.iter().map(move |signal| Quantity {
            name: format!("joint.{name}.{}", signal.name),
            kind: signal.kinds[usize::from(!turns)],
            statistics: signal.statistics,
        })
    };
    let of_tool = |tool: &String| {
        let tool = tool.clone();
        TOOL_SIGNALS.iter().map(move |signal| Quantity {
            name: format!("tool.{tool}.{}", signal.name),
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

/// What the signal of a number needs, where so many tools have signals of their own.
fn needs(number: usize, tools: usize) -> Needs {
    if number < SIGNALS.len() {
        return SIGNALS[number].needs;
    }
    let of_joints = (number - SIGNALS.len()).checked_sub(TOOL_SIGNALS.len() * tools);
    of_joints.map_or(Needs::NONE, |i| JOINT_SIGNALS[i % JOINT_SIGNALS.len()].needs)
}

fn is_fitted(case: &Case) -> bool {
    case.actuation == AttitudeActuation::Fitted
}

fn has_cmgs(case: &Case) -> bool {
    !case.equipment.actuators.cmgs.is_empty()
}

/// Error of the tool; absent while nothing is driven, for there is nowhere that the tool should be.
fn off(s: &Seen<'_>, error: Vec3<f64>) -> f64 {
    if s.track.coasting { f64::NAN } else { there(error.norm()) }
}

fn missing(is_there: bool, x: Vec3<f64>) -> f64 {
    if is_there { there(x.norm()) } else { f64::NAN }
}

/// What the attitude control gives and what is cut of it. Thrusters alone have no torque at an instant, and
/// store nothing; a free base has nobody who could.
fn given(s: &Seen<'_>, x: Vec3<f64>, cut: Vec3<f64>) -> f64 {
    let turned = s.case.base != BaseAttitude::Free;
    let holds = turned && (!is_fitted(s.case) || s.case.stores_momentum());
    if holds && !x.norm().is_nan() { there((x + cut).norm()) } else { f64::NAN }
}

fn use_of((x, limit): (f64, f64)) -> f64 {
    x.abs() / limit
}

fn largest_use(s: &Seen<'_>, value: &dyn Fn(usize) -> (f64, Option<f64>)) -> f64 {
    let shares = (0..s.case.vehicle.limits.len()).filter_map(|j| {
        let (x, limit) = value(j);
        limit.map(|limit| use_of((x, limit)))
    });
    largest(shares)
}

/// The least way left to an end of travel, of the joints of a kind.
fn travel_margin(s: &Seen<'_>, kind: JointKind) -> f64 {
    let joints = s.case.vehicle.limits.iter().enumerate();
    let of_kind = joints.filter(|(j, _)| s.case.vehicle.robot.joint(*j).kind == kind);
    let margins = of_kind.filter_map(|(j, limits)| {
        let q = s.truth.state.q[j];
        limits.travel.map(|(lower, upper)| (q - lower).min(upper - q))
    });
    -largest(margins.map(|margin| -margin))
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

    /// The table of the guide has a row for each, with its statistics, and its unit in SI.
    #[test]
    fn the_guide_names_every_signal_with_its_statistics() {
        let guide =
            Path::new(env!("CARGO_MANIFEST_DIR")).join("../../book/src/guide/mission_files.md");
        let guide = std::fs::read_to_string(guide).expect("the guide");
        for quantity in quantities(&["NAME".into()], &[("NAME".into(), true)]) {
            let word = format!("`{}`", quantity.name);
            let row = guide.lines().find(|line| line.starts_with("| `") && line.contains(&word));
            let row = row.unwrap_or_else(|| panic!("the guide has no row for {word}"));
            let statistics: Vec<_> = quantity.statistics.iter().map(|s| s.name()).collect();
            let column = format!("| {} |", statistics.join(", "));
            assert!(row.contains(&column), "{word}: the guide has not {column}");
        }
    }
}
