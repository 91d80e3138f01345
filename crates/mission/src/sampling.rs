//! Whether the integrator's step and the control period are short enough for what is fitted.

use crate::reading::Reading;
use crate::toml::MissionFile;
use wrasse_document::{Step, at};
use wrasse_flight::allocation::Modulation;
use wrasse_rehearsal::AttitudeActuation;
use wrasse_rehearsal::figures::rounded;
use wrasse_vehicle::Equipment;
use wrasse_world::{BaseAttitude, Stepper};

/// Largest product of a servo's bandwidth and the integrator's step (–). A method of order four is
/// stable to 2.79; at 1 it follows the servo to a few parts in a hundred.
const SERVO_STEP: f64 = 1.0;

/// Control periods that the lag of a modulation should last at least (–): the level must not move far in
/// one of them.
const LAG_PERIODS: f64 = 10.0;

/// A little less than one, for products of decimal numbers.
const NEARLY: f64 = 1.0 - 1e-9;

/// What decides how finely the equipment of a case is followed.
pub(crate) struct Sampling<'a> {
    pub(crate) equipment: &'a Equipment,
    pub(crate) base: BaseAttitude,
    pub(crate) actuation: AttitudeActuation,
    pub(crate) stepper: Stepper,
    /// Control period (s).
    pub(crate) period: f64,
    pub(crate) modulation: Option<Modulation<f64>>,
}

/// Complains of a step that is too long for the servos, doubts a modulation that does not suit the
/// thrusters.
pub(crate) fn check_sampling(r: &mut Reading<'_>, file: &MissionFile, sampling: &Sampling<'_>) {
    if sampling.base != BaseAttitude::Held {
        check_servos(r, file, sampling);
    }
    if sampling.actuation == AttitudeActuation::Fitted
        && let Some(modulation) = &sampling.modulation
    {
        doubt_pulses(r, sampling, modulation);
    }
}

fn check_servos(r: &mut Reading<'_>, file: &MissionFile, sampling: &Sampling<'_>) {
    let Stepper::Fixed { step } = sampling.stepper else { return };
    let step = step.min(sampling.period);
    let equipment = sampling.equipment;
    let cmgs = equipment.cmg_names.iter().zip(equipment.actuators.cmgs.iter());
    let fastest = cmgs.max_by(|a, b| a.1.servo_bandwidth.total_cmp(&b.1.servo_bandwidth));
    let Some((name, cmg)) = fastest else { return };
    let bandwidth = cmg.servo_bandwidth;
    if bandwidth * step <= SERVO_STEP {
        return;
    }
    let message = format!(
        "a step of {step} s is too long for the servo of CMG {name}, {bandwidth} rad/s: it turns its \
         gimbal within {} s",
        rounded(1.0 / bandwidth)
    );
    let help = format!("set world.step_s to {} or less", rounded(SERVO_STEP / bandwidth));
    let path: &[Step<'_>] = match file.world.step_s {
        Some(_) => at!["world", "step_s"],
        None => at!["actuators"],
    };
    r.error(path, message, &help);
}

fn doubt_pulses(r: &mut Reading<'_>, sampling: &Sampling<'_>, modulation: &Modulation<f64>) {
    let path = at!["control", "steering", "modulation"];
    let equipment = sampling.equipment;
    let thrusters = equipment.thruster_names.iter().zip(equipment.actuators.thrusters.iter());
    let slowest = thrusters.max_by(|a, b| a.1.minimum_on_time.total_cmp(&b.1.minimum_on_time));
    let Some((name, thruster)) = slowest else { return };
    let (shortest, least) = (modulation.shortest_pulse(), thruster.minimum_on_time);
    if shortest > 0.0 && shortest < least * NEARLY {
        let message = format!(
            "the modulation makes pulses down to {} s, and thruster {name} opens for {least} s at \
             least: it gives more than is wanted where little is wanted",
            rounded(shortest)
        );
        let help = "the shortest pulse is lag_s (opens_at - shuts_at) / gain: raise lag_s, say";
        r.warning(path, message, help);
    }
    let due = LAG_PERIODS * sampling.period;
    if modulation.lag < due * NEARLY {
        let message = format!(
            "the lag of the modulation is {} s, and a control period {} s: pulses come out uneven",
            modulation.lag,
            rounded(sampling.period)
        );
        let help = format!("a lag of ten periods, {} s, or more makes them even", rounded(due));
        r.warning(path, message, &help);
    }
}
