//! What turns, feels and pushes the base, out of a mission file.

use crate::applied_wrench::AppliedWrench;
use crate::base_format::{
    ActuatorsFile, CmgLawFile, FailureKindFile, SensingFile, SteeringFile, WheelLawFile,
};
use crate::format::{BaseFile, FeedforwardFile, MissionFile};
use crate::mission::FailureCase;
use crate::read_setup::{attitude, axes, tool, vector};
use crate::reading::Reading;
use wrasse_document::{Severity, Step, at};
use wrasse_flight::allocation::{
    AllocationSetup, CmgLaw, CmgSharing, Damping, Desaturation, Modulation, Unit, Waves, WheelLaw,
    WheelSharing, preferred_angles,
};
use wrasse_flight::{
    Actuation, BaseControlSetup, EstimatorSetup, Feedforward, NavigationSetup, PositionHold,
    TRACKER_MEMORY,
};
use wrasse_hardware::{AttitudeActuator, Sensors};
use wrasse_spatial::{SpatialForce, Vec3};
use wrasse_vehicle::{Equipment, check_equipment, read_equipment, read_sensors};
use wrasse_world::Failure;

/// Wheels, CMGs and thrusters of this mission.
pub(crate) fn equipment(r: &mut Reading<'_>, file: &MissionFile) -> Equipment {
    let mut equipment = given_equipment(r, file);
    if let Some(direction) = file.control.steering.preferred_for {
        if let Some(angles) = preferred_angles(&equipment.actuators.cmgs, vector(direction)) {
            equipment.gimbal_angle = angles;
        } else {
            let message = "no gimbal angles can be searched for this direction".into();
            let help = "it takes CMGs whose rotors can cancel each other, and a direction that has a \
                        length";
            r.error(at!["control", "steering", "preferred_for"], message, help);
        }
    }
    equipment
}

fn given_equipment(r: &mut Reading<'_>, file: &MissionFile) -> Equipment {
    match &file.actuators {
        None => r.vehicle.equipment.clone(),
        Some(given) => {
            let path = at!["actuators"];
            let (equipment, found) = read_equipment(r.document, path, given);
            r.knows_actuators = found.iter().all(|c| c.severity != Severity::Error);
            r.complaints.extend(found);
            let robot = &r.vehicle.robot;
            r.complaints.extend(check_equipment(r.document, path, &equipment, robot));
            equipment
        }
    }
}

/// Sensors of this mission as they are fitted, and those that the laws use; `None`: perfect ones.
pub(crate) fn sensors(
    r: &mut Reading<'_>,
    file: &MissionFile,
) -> (Sensors<f64>, Option<Sensors<f64>>) {
    let mut sensors = r.vehicle.sensors;
    if let Some(given) = &file.sensors {
        let (read, found) = read_sensors(r.document, at!["sensors"], given);
        r.complaints.extend(found);
        sensors = read;
    }
    let there = sensors != Sensors::default();
    let used = match file.control.sensing {
        Some(SensingFile::Perfect) => None,
        Some(SensingFile::Fitted) if !there => {
            let message = format!("vehicle {} has no sensors", file.vehicle);
            let help = "add [sensors] to the mission or to the vehicle's file";
            r.error(at!["control", "sensing"], message, help);
            None
        }
        _ => there.then_some(sensors),
    };
    (sensors, used)
}

/// What turns a controlled base.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Turning {
    /// An ideal actuator, within limits if it has them.
    Ideal(Option<AttitudeActuator<f64>>),
    /// Wheels, CMGs and thrusters.
    Fitted,
}

/// What turns the base of this mission.
pub(crate) fn turning(r: &mut Reading<'_>, file: &MissionFile, equipment: &Equipment) -> Turning {
    let ideal = r.vehicle.attitude_actuator;
    if file.world.base_attitude != BaseFile::Controlled {
        return Turning::Ideal(ideal);
    }
    let none = r.knows_actuators && equipment.actuators.is_empty();
    let add = "add [actuators] to the mission or to the vehicle's file";
    match file.control.actuators {
        Some(ActuatorsFile::Unlimited) => return Turning::Ideal(None),
        Some(ActuatorsFile::Ideal) if ideal.is_none() => {
            let message = format!("vehicle {} has no attitude actuator", file.vehicle);
            let help = "add [attitude_actuator] to its file, or choose \"unlimited\"";
            r.error(at!["control", "actuators"], message, help);
        }
        Some(ActuatorsFile::Fitted) if none => {
            let message = format!("vehicle {} has no wheels, CMGs or thrusters", file.vehicle);
            r.error(at!["control", "actuators"], message, add);
        }
        None if none && ideal.is_none() => {
            let message = format!("vehicle {} has no attitude actuator", file.vehicle);
            let help = format!(
                "{add}, set control.actuators = \"unlimited\", or choose \"held\" or \"free\""
            );
            r.error(at!["world", "base_attitude"], message, &help);
        }
        Some(ActuatorsFile::Fitted) => return Turning::Fitted,
        None if !none => return Turning::Fitted,
        Some(ActuatorsFile::Ideal) | None => {}
    }
    Turning::Ideal(ideal)
}

/// Doubts units that are fitted and do nothing.
pub(crate) fn doubt_idle_units(
    r: &mut Reading<'_>,
    file: &MissionFile,
    turning: Turning,
    equipment: &Equipment,
) {
    let is_controlled = file.world.base_attitude == BaseFile::Controlled;
    // Of failing units on a held base it is said with their failures.
    if file.world.base_attitude == BaseFile::Held && !file.failure.is_empty() {
        return;
    }
    if equipment.actuators.is_empty() || (is_controlled && turning == Turning::Fitted) {
        return;
    }
    let (path, why, help) = if is_controlled {
        (
            at!["control", "actuators"],
            "an ideal actuator turns the base",
            "\"fitted\" flies with them",
        )
    } else {
        let why = match file.world.base_attitude {
            BaseFile::Held => "the base is held from outside",
            _ => "the base floats",
        };
        (at!["world", "base_attitude"], why, "\"controlled\" flies with them")
    };
    let by_default = if r.is_there(path) { "" } else { ", by default" };
    let message = format!(
        "wheels, CMGs and thrusters are fitted and do nothing: {why}{by_default}; their masses count"
    );
    r.warning(path, message, help);
}

/// How the base is controlled.
pub(crate) fn base_control(
    r: &mut Reading<'_>,
    file: &MissionFile,
    turning: Turning,
    fitted: Option<&Equipment>,
) -> BaseControlSetup<f64> {
    let c = &file.control;
    let position_hold = c.position_hold.as_ref().map(|hold| PositionHold {
        bandwidth: r
            .positive(at!["control", "position_hold", "bandwidth_rad_s"], hold.bandwidth_rad_s),
        damping: r
            .not_negative(at!["control", "position_hold", "damping_ratio"], hold.damping_ratio),
    });
    let known = r.knows_actuators;
    if known && position_hold.is_some() && fitted.is_none_or(|e| e.actuators.thrusters.is_empty()) {
        let message = "only thrusters can hold a position: there are none".into();
        let help = "add [[actuators.thruster]], or leave position_hold out";
        r.error(at!["control", "position_hold"], message, help);
    }
    let steering = steering(r, &c.steering);
    if let (true, Some(equipment), Some(_)) = (known, fitted, steering.desaturation) {
        check_unloading(r, equipment);
    }
    BaseControlSetup {
        feedforward: match c.feedforward {
            FeedforwardFile::Exact => Feedforward::Exact,
            FeedforwardFile::AsPrinted => Feedforward::AsPrinted,
            FeedforwardFile::AsPrintedSystemCm => Feedforward::AsPrintedSystemCm,
            FeedforwardFile::None => Feedforward::None,
        },
        quat_ND: attitude(r, at!["initial", "attitude"], file.initial.attitude),
        actuation: match (turning, fitted) {
            _ if file.world.base_attitude != BaseFile::Controlled => Actuation::None,
            (Turning::Fitted, Some(e)) => Actuation::Fitted(AllocationSetup {
                actuators: e.actuators,
                holds_position: position_hold.is_some(),
                ..steering
            }),
            (Turning::Fitted, None) => Actuation::None,
            (Turning::Ideal(limits), _) => Actuation::Ideal(limits),
        },
        position_hold,
    }
}

/// Thrusters empty wheels and CMGs: both must be there.
fn check_unloading(r: &mut Reading<'_>, equipment: &Equipment) {
    let path = at!["control", "steering", "unloading"];
    let help = "add them to [actuators], or leave unloading out";
    let actuators = &equipment.actuators;
    if actuators.thrusters.is_empty() {
        r.error(path, "unloading takes thrusters: there are none".into(), help);
    }
    if actuators.wheels.is_empty() && actuators.cmgs.is_empty() {
        r.error(path, "unloading takes wheels or CMGs to empty: there are none".into(), help);
    }
}

/// The laws of the steering, for no actuators yet.
fn steering(r: &mut Reading<'_>, file: &SteeringFile) -> AllocationSetup<f64> {
    let path = |key| [Step::Key("control"), Step::Key("steering"), Step::Key(key)];
    let wheels = WheelLaw {
        sharing: match file.wheels {
            WheelLawFile::PseudoInverse => WheelSharing::PseudoInverse,
            WheelLawFile::MinimumPeak => WheelSharing::MinimumPeak,
        },
        null_gain: r.not_negative(&path("wheel_null_gain_per_s"), file.wheel_null_gain_per_s),
    };
    let null_gain = r.not_negative(&path("cmg_null_gain_rad_s"), file.cmg_null_gain_rad_s);
    // The numbers of the literature: Wie, Bailey, Heiberg 2001.
    let damping = Damping { k0: 0.01, fading: 10.0 };
    let quarter = std::f64::consts::FRAC_PI_2;
    let waves = Waves { height: 0.01, frequency: quarter, phases: [0.0, quarter, 2.0 * quarter] };
    let sharing = match file.cmgs {
        CmgLawFile::PseudoInverse => CmgSharing::PseudoInverse,
        CmgLawFile::SingularityRobust => CmgSharing::SingularityRobust(damping),
        CmgLawFile::GeneralizedSingularityRobust => {
            CmgSharing::GeneralizedSingularityRobust(damping, waves)
        }
    };
    let unloading = file.unloading.as_ref().map(|u| {
        let path = |key| {
            [Step::Key("control"), Step::Key("steering"), Step::Key("unloading"), Step::Key(key)]
        };
        if u.ends_at_nms >= u.begins_at_nms {
            let message = format!(
                "unloading would end at {} N·m·s, before it begins at {}",
                u.ends_at_nms, u.begins_at_nms
            );
            r.error(&path("ends_at_nms"), message, "let it end below where it begins");
        }
        Desaturation {
            target_B: Vec3::zero(),
            start: r.positive(&path("begins_at_nms"), u.begins_at_nms),
            stop: r.not_negative(&path("ends_at_nms"), u.ends_at_nms),
            gain: r.positive(&path("gain_per_s"), u.gain_per_s),
            active: false,
        }
    });
    AllocationSetup {
        actuators: wrasse_hardware::Actuators::default(),
        wheels,
        cmgs: CmgLaw { sharing, null_gain },
        modulation: modulation(r, file),
        holds_position: false,
        desaturation: unloading,
    }
}

fn modulation(r: &mut Reading<'_>, file: &SteeringFile) -> Modulation<f64> {
    let path = |key| {
        [Step::Key("control"), Step::Key("steering"), Step::Key("modulation"), Step::Key(key)]
    };
    let m = &file.modulation;
    if m.shuts_at >= m.opens_at {
        let message = format!("it opens at {} and would shut at {}", m.opens_at, m.shuts_at);
        r.error(&path("shuts_at"), message, "a thruster shuts below where it opens");
    }
    Modulation {
        gain: r.positive(&path("gain"), m.gain),
        lag: r.positive(&path("lag_s"), m.lag_s),
        on_level: r.positive(&path("opens_at"), m.opens_at),
        off_level: r.not_negative(&path("shuts_at"), m.shuts_at),
    }
}

/// What the navigation must know.
pub(crate) fn navigation(
    r: &mut Reading<'_>,
    file: &MissionFile,
    sensors: Option<&Sensors<f64>>,
) -> NavigationSetup<f64> {
    let e = &file.control.estimation;
    let path = |key| [Step::Key("control"), Step::Key("estimation"), Step::Key(key)];
    let attitude_sigma = r.positive(&path("attitude_sigma_deg"), e.attitude_sigma_deg);
    let bias_sigma = r.positive(&path("bias_sigma_deg_h"), e.bias_sigma_deg_h);
    if let Some((_, tracker)) = sensors.and_then(|s| s.attitude) {
        check_latency(r, file, tracker.latency);
    }
    NavigationSetup {
        attitude: sensors.and_then(|s| s.attitude).map(|(gyro, tracker)| EstimatorSetup {
            gyro,
            tracker,
            start_attitude_sigma: attitude_sigma.to_radians(),
            start_bias_sigma: bias_sigma.to_radians() / 3600.0,
        }),
        joint_bandwidth: r.positive(&path("joint_bandwidth_rad_s"), e.joint_bandwidth_rad_s),
        quat_NB: attitude(r, at!["initial", "attitude"], file.initial.attitude),
    }
}

/// The estimator must reach back to when a star tracker's reading was taken.
fn check_latency(r: &mut Reading<'_>, file: &MissionFile, latency: f64) {
    let rate = file.control.rate_hz;
    let memory = TRACKER_MEMORY as f64 / rate;
    // Within round-off of the sum of periods, and for a rate that is one: any other is refused already.
    if latency <= memory * (1.0 + 1e-12) || rate.is_nan() || rate <= 0.0 {
        return;
    }
    let given = [Step::Key("sensors"), Step::Key("star_tracker"), Step::Key("latency_s")];
    let path = match &file.sensors {
        Some(_) if r.is_there(&given) => &given[..],
        Some(_) => &given[..2],
        None => at!["vehicle"],
    };
    let message = format!(
        "the star tracker's readings are {latency} s old, and the attitude estimator reaches back \
         {memory:.3} s: {TRACKER_MEMORY} control periods at {rate} Hz"
    );
    let slowest = TRACKER_MEMORY as f64 / latency;
    let help = format!(
        "it would refuse every reading: take a tracker that is faster, or control.rate_hz of at most \
         {slowest:.1}"
    );
    r.error(path, message, &help);
}

/// Wrenches from outside.
pub(crate) fn applied_wrenches(r: &mut Reading<'_>, file: &MissionFile) -> Vec<AppliedWrench> {
    let mut all = vec![];
    for (i, w) in file.world.applied_wrench.iter().enumerate() {
        let path =
            |key| [Step::Key("world"), Step::Key("applied_wrench"), Step::Index(i), Step::Key(key)];
        let duration = r.positive(&path("duration_s"), w.duration_s);
        let ramp = r.not_negative(&path("ramp_s"), w.ramp_s);
        if ramp > 0.5 * duration {
            let message =
                format!("it rises in {ramp} s and falls in {ramp} s, and lasts {duration} s");
            r.error(&path("ramp_s"), message, "at most half of duration_s");
        }
        all.push(AppliedWrench {
            on: tool(r, &path("on"), Some(&w.on)),
            wrench: SpatialForce::new(vector(w.torque_nm), vector(w.force_n)),
            axes: axes(w.axes),
            from: r.not_negative(&path("from_s"), w.from_s),
            duration,
            ramp,
        });
    }
    all
}

/// Units that fail on the way.
pub(crate) fn failures(
    r: &mut Reading<'_>,
    file: &MissionFile,
    equipment: &Equipment,
) -> Vec<FailureCase> {
    let groups = [&equipment.wheel_names, &equipment.cmg_names, &equipment.thruster_names];
    let names: Vec<String> = groups.into_iter().flatten().cloned().collect();
    if file.world.base_attitude == BaseFile::Held && !file.failure.is_empty() {
        let message = "the base is held exactly: wheels, CMGs and thrusters do not act, and their \
                       failures change nothing"
            .into();
        r.warning(at!["failure"], message, "set world.base_attitude to \"controlled\"");
    }
    let mut all: Vec<FailureCase> = vec![];
    for (i, f) in file.failure.iter().enumerate() {
        let path = |key| [Step::Key("failure"), Step::Index(i), Step::Key(key)];
        let at = r.not_negative(&path("at_s"), f.at_s);
        let told_at =
            f.reported_after_s.map(|after| at + r.not_negative(&path("reported_after_s"), after));
        let there = names.contains(&f.unit);
        if !there && r.knows_actuators {
            r.find(&path("unit"), "wheel, CMG or thruster", &f.unit, &names);
        }
        if !there {
            continue;
        }
        let place = |group: &[String]| group.iter().position(|n| *n == f.unit);
        let (unit, breaks) = match (f.kind, groups.map(|g| place(g))) {
            (FailureKindFile::Dead, [Some(n), ..]) => (Unit::Wheel(n), Failure::Wheel(n)),
            (FailureKindFile::Stuck, [_, Some(n), _]) => (Unit::Cmg(n), Failure::Gimbal(n)),
            (FailureKindFile::Shut, [.., Some(n)]) => (Unit::Thruster(n), Failure::ThrusterShut(n)),
            (FailureKindFile::Open, [.., Some(n)]) => (Unit::Thruster(n), Failure::ThrusterOpen(n)),
            _ => {
                let message = format!("{} cannot fail in this way", f.unit);
                let help =
                    "a wheel can be \"dead\", a CMG \"stuck\", a thruster \"shut\" or \"open\"";
                r.error(&path("kind"), message, help);
                continue;
            }
        };
        let same =
            |other: &FailureCase| other.unit == unit && (other.breaks == breaks || other.at == at);
        if all.iter().any(same) {
            let message = format!("{} has already failed, in this way or at this time", f.unit);
            r.error(&path("unit"), message, "a unit fails in one way once: leave this failure out");
            continue;
        }
        let how = format!("{:?}", f.kind).to_lowercase();
        all.push(FailureCase { name: f.unit.clone(), how, unit, breaks, at, told_at });
    }
    all
}
