//! The signals of any vehicle, one row each.

use crate::case::{AttitudeActuation, Case};
use crate::signals::actuator_demand::{gimbal_rates, wheel_speeds};
use crate::signals::observe::{largest, there};
use crate::signals::quantity::Kind;
use crate::signals::quantity::Statistic::{Final, Max, Min, Rms};
use crate::signals::{Needs, Seen, Signal, row};
use wrasse_dynamics::JointKind;
use wrasse_spatial::Vec3;
use wrasse_world::BaseAttitude;

const MM: f64 = 1e3;
const DEG: f64 = 180.0 / std::f64::consts::PI;

/// The signals of any vehicle.
pub(crate) const SIGNALS: &[Signal] = &[
    row("tool.position_error", "distance of the tool from where it should be", Kind::Length, &[Max, Final, Rms], Needs::NONE, |s| {
        off(s, s.truth.tool_error.0)
    })
    .drawn("Tool error", "distance", "mm", MM),
    row("tool.along_track_error", "that distance along the way of the tool, with its sign", Kind::Length, &[Max, Final], Needs::NONE, |s| {
        s.track.split(s.truth.tool_error.0).0
    })
    .drawn("Tool error", "along the way", "mm", MM),
    row("tool.lateral_error", "that distance across the way of the tool", Kind::Length, &[Max, Final], Needs::NONE, |s| {
        s.track.split(s.truth.tool_error.0).1
    })
    .drawn("Tool error", "across it", "mm", MM),
    row("tool.attitude_error", "angle of the tool from how it should be turned", Kind::Angle, &[Max, Final, Rms], Needs::NONE, |s| {
        off(s, s.truth.tool_error.1)
    })
    .drawn("Tool orientation error", "angle", "deg", DEG),
    row("tool.speed", "speed of the tool", Kind::Speed, &[Max, Final], Needs::NONE, |s| {
        there(s.truth.V_NE.linear.norm())
    }),
    row("tool.turn_speed", "how fast the tool turns", Kind::AngularSpeed, &[Max, Final], Needs::NONE, |s| {
        there(s.truth.V_NE.angular.norm())
    }),
    row("base.rotation", "angle by which the base has turned since the start; whole turns count: 600 deg after 60 s at 10 deg/s", Kind::Angle, &[Max, Final], Needs::NONE, |s| {
        there(s.truth.base_turn.norm())
    }),
    row("base.translation", "distance of the base from where it was at the start", Kind::Length, &[Max, Final], Needs::NONE, |s| {
        there(s.truth.base_shift.norm())
    }),
    row("base.turn_speed", "how fast the base turns", Kind::AngularSpeed, &[Max, Final], Needs::NONE, |s| {
        there(s.truth.state.V_NB_B.angular.norm())
    }),
    row("joints.rate_use", "the rate that the way asks of the joint that asks most, before its rate limit slows the tool, or the rate that it has where that is more; share of the limit", Kind::Number, &[Max], Needs::NONE, |s| {
        let limits = &s.case.vehicle.limits;
        largest_use(s, &|j| (s.asked.rates[j], limits[j].rate))
    }),
    row("joints.effort_use", "what the law asks of the drive that it asks most of, before it is cut; of prescribed joints what it takes to move them; share of the limit", Kind::Number, &[Max], Needs::DYNAMICS, |s| {
        let limits = &s.case.vehicle.limits;
        largest_use(s, &|j| (s.asked.efforts[j], limits[j].effort))
    }),
    row("joints.travel_margin", "the least way left to an end of travel, of the turning joints", Kind::Angle, &[Min], Needs::NONE, |s| {
        travel_margin(s, JointKind::Revolute)
    }),
    row("joints.slide_margin", "the least way left to an end of travel, of the sliding joints", Kind::Length, &[Min], Needs::NONE, |s| {
        travel_margin(s, JointKind::Prismatic)
    }),
    row("arm.reach_margin", "how much farther the stretched arm would reach", Kind::Length, &[Min, Final], Needs::SHAPE, |s| s.shape.0).drawn(
        "Reach left",
        "to the stretched arm",
        "mm",
        MM,
    ),
    row("arm.singularity_distance", "smallest singular value of the law's Jacobian", Kind::Number, &[Min, Final], Needs::SHAPE, |s| s.shape.1)
        .drawn("Distance from a singular posture", "smallest singular value", "–", 1.0),
    row("mount.force", "largest force that a mount bears in truth", Kind::Force, &[Max], Needs::MOUNTS, |s| s.mounts.0),
    row("mount.moment", "largest moment that a mount bears in truth", Kind::Torque, &[Max], Needs::MOUNTS, |s| s.mounts.1),
    // Of what is given and what is cut: what was asked for. What is stored goes the other way.
    row("attitude.torque", "what turns the base and what is missing of it; on a held base what it takes to hold it", Kind::Torque, &[Max], Needs::DYNAMICS, |s| {
        given(s, s.truth.torque_B, s.asked.torque_cut_B)
    }),
    row("attitude.momentum", "what is stored, and what would be by the end of the period had nothing been missing in it", Kind::AngularMomentum, &[Max, Final], Needs::READINGS, |s| {
        given(s, s.truth.stored_B, -(s.asked.torque_cut_B * s.case.period()))
    }),
    row("energy", "kinetic energy of all that moves", Kind::Energy, &[Max, Final], Needs::ENERGY, |s| s.energy),
    row("attitude.torque_missing", "demanded and not given, by wheels, CMGs and thrusters according to the control allocation, or by an ideal actuator within its limits", Kind::Torque, &[Max, Rms], Needs::NONE, |s| {
        missing(s.case.base == BaseAttitude::Controlled, s.asked.torque_cut_B)
    })
    .drawn_if("Torque that was wanted and not given", "missing", ("N·m", 1.0), is_fitted),
    row("attitude.force_missing", "the same of the force that holds the position", Kind::Force, &[Max, Rms], Needs::NONE, |s| {
        let holds = is_fitted(s.case) && s.case.setup.base.position_hold.is_some();
        missing(holds, s.command.allocation.missing.force)
    }),
    row("attitude.estimate_error", "angle of the estimated attitude from the true one", Kind::Angle, &[Max, Final, Rms], Needs::NONE, |s| {
        s.estimate_error
    })
    .drawn_if("Error of the attitude estimate", "angle", ("arcsec", DEG * 3600.0), |case| {
        case.sensors.is_some_and(|sensors| sensors.attitude.is_some())
    }),
    row("wheels.speed_use", "the speed of a wheel, or the one it would have by the end of the period had it given what is missing about its axis; share of the limit", Kind::Number, &[Max, Final], Needs::READINGS, |s| {
        largest(wheel_speeds(s.case, s.asked.torque_cut_B, &s.truth.readings).map(use_of))
    }),
    row("cmgs.rate_use", "the rate that a gimbal is told, what is missing about its torque axis added, or the rate that it has where that is more; share of the limit", Kind::Number, &[Max], Needs::READINGS, |s| {
        let cut_B = s.asked.torque_cut_B;
        largest(gimbal_rates(s.case, s.command, cut_B, &s.truth.readings).map(use_of))
    }),
    row("cmgs.motor_torque", "what a gimbal's motor gives, or what it would have needed to do as it was told", Kind::Torque, &[Max], Needs::MOTORS, |s| s.motors),
    row("cmgs.singularity_distance", "distance of the CMGs from a singular setting, det(A Aᵀ)", Kind::Number, &[Min, Final], Needs::NONE, |s| {
        let steered = is_fitted(s.case) && has_cmgs(s.case) && !s.track.coasting;
        if steered { there(s.command.allocation.singularity) } else { f64::NAN }
    })
    .drawn_if(
        "Distance of the CMGs from a singular setting",
        "det(A Aᵀ)",
        ("–", 1.0),
        has_cmgs,
    ),
    row("thrusters.propellant_used", "propellant that has left the tank", Kind::Mass, &[Final], Needs::READINGS, |s| {
        let tank = s.case.equipment.actuators.tank;
        tank.map_or(f64::NAN, |tank| tank.propellant) - s.truth.readings.propellant
    })
    .drawn_if("Propellant used", "used", ("g", 1e3), |case| {
        case.equipment.actuators.tank.is_some()
    }),
    row("slosh.angle", "angle of the propellant that swings from the axis of its tank", Kind::Angle, &[Max, Final, Rms], Needs::NONE, |s| s.slosh_angle).drawn_if(
        "Swing of the propellant",
        "from the axis of its tank",
        ("deg", DEG),
        |case| case.equipment.slosh.is_some(),
    ),
];

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
