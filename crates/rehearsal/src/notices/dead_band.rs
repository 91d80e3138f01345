//! Thrusters that stay shut though something is wanted of them: it is too little to open them.

use crate::case::Case;
use wrasse_flight::Command;
use wrasse_vehicle::JOINTS;

/// For how long thrusters must have stayed shut before it is told (s).
const LONG: f64 = 3.0;

/// Torque (N·m) and force (N) below which nothing is wanted.
const NOTHING: f64 = 1e-3;

/// Since when thrusters have stayed shut under what is wanted.
#[derive(Debug, Default)]
pub(crate) struct DeadBand {
    since: Option<f64>,
}

impl DeadBand {
    /// Note a period that ends at `time` (s); what to say of it.
    pub(crate) fn note(
        &mut self,
        case: &Case,
        command: &Command<f64, JOINTS>,
        time: f64,
    ) -> Option<String> {
        let actuators = &case.equipment.actuators;
        let alone = actuators.wheels.is_empty() && actuators.cmgs.is_empty();
        let setup = case.setup.base.actuation.allocation()?;
        let (torque, force) =
            (command.allocation.wanted.torque.norm(), command.allocation.wanted.force.norm());
        let shut = command.actuators.thruster_on.iter().all(|on| *on <= 0.0);
        if !(alone && shut && (torque > NOTHING || force > NOTHING)) {
            self.since = None;
            return None;
        }
        let since = *self.since.get_or_insert(time);
        if time - since < LONG {
            return None;
        }
        let law = &setup.modulation;
        let opens = 50.0 * (law.on_level - law.off_level) / law.gain;
        Some(format!(
            "the thrusters stay shut: what is wanted, {torque:.3} N·m and {force:.3} N, is below the \
             {opens:.1} % of their force at which the modulation opens them"
        ))
    }
}
