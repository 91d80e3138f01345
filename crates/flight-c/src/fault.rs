//! Why a period was refused, in the words of the header.

use crate::complaint::{ONLY, Refused, WrasseStatus, refused};
use core::ffi::CStr;
use wrasse_flight::{OutOfBounds, PeriodFault, Quantity};

/// The complaint about a fault.
pub(crate) fn refusal(fault: PeriodFault<f64>) -> Refused {
    match fault {
        PeriodFault::Reading(found) => {
            complain(WrasseStatus::WRASSE_BAD_READING, of_sensed(&found), &found)
        }
        PeriodFault::ArmReference(found) => {
            complain(WrasseStatus::WRASSE_BAD_NUMBER, of_reference(&found), &found)
        }
        PeriodFault::ControlOutput(found) => {
            complain(WrasseStatus::WRASSE_BAD_RESULT, of_output(&found), &found)
        }
        PeriodFault::Memory => refused(
            WrasseStatus::WRASSE_BAD_MEMORY,
            c"WrasseFlight.memory",
            ONLY,
            f64::NAN,
            c"finite numbers",
        ),
    }
}

fn complain(
    status: WrasseStatus,
    (field, index): (&'static CStr, usize),
    found: &OutOfBounds<f64>,
) -> Refused {
    refused(status, field, index, found.found, expected(found.quantity))
}

fn of_sensed(found: &OutOfBounds<f64>) -> (&'static CStr, usize) {
    let index = found.index;
    match found.quantity {
        Quantity::Position => (c"WrasseSensed.position", index),
        Quantity::AngularVelocity => (c"WrasseSensed.angular_velocity", index),
        Quantity::Velocity => (c"WrasseSensed.velocity", index),
        Quantity::JointPosition => (c"WrasseSensed.joint_position", index),
        Quantity::JointRate => (c"WrasseSensed.joint_rate", index),
        Quantity::ToolTorque => (c"WrasseSensed.wrench", index),
        Quantity::ToolForce => (c"WrasseSensed.wrench", index + 3),
        _ => (c"WrasseSensed.attitude", ONLY),
    }
}

fn of_reference(found: &OutOfBounds<f64>) -> (&'static CStr, usize) {
    let index = found.index;
    match found.quantity {
        Quantity::Position => (c"WrasseArmReference.tool_position", index),
        Quantity::AngularVelocity => (c"WrasseArmReference.tool_velocity", index),
        Quantity::Velocity => (c"WrasseArmReference.tool_velocity", index + 3),
        Quantity::AngularAcceleration => (c"WrasseArmReference.tool_acceleration", index),
        Quantity::Acceleration => (c"WrasseArmReference.tool_acceleration", index + 3),
        Quantity::PostureGain => (c"WrasseArmReference.posture_gain", ONLY),
        Quantity::PostureGainRate => (c"WrasseArmReference.posture_gain_rate", ONLY),
        Quantity::JointPosition => (c"WrasseArmReference.joint_position", index),
        Quantity::JointRate => (c"WrasseArmReference.joint_rate", index),
        Quantity::JointAcceleration => (c"WrasseArmReference.joint_acceleration", index),
        _ => (c"WrasseArmReference.tool_attitude", ONLY),
    }
}

fn of_output(found: &OutOfBounds<f64>) -> (&'static CStr, usize) {
    let index = found.index;
    match found.quantity {
        Quantity::JointPosition => (c"WrasseControlOutput.joint_position", index),
        Quantity::JointRate => (c"WrasseControlOutput.joint_rate", index),
        Quantity::JointAcceleration => (c"WrasseControlOutput.joint_acceleration", index),
        Quantity::Effort => (c"WrasseControlOutput.effort", index),
        Quantity::AttitudeTorque => (c"WrasseControlOutput.attitude_torque", index),
        Quantity::ForceAhead => (c"WrasseControlOutput.force_ahead", index),
        _ => (c"WrasseControlOutput", index),
    }
}

/// What a number of this quantity must be, as it stands in the header.
pub(crate) fn expected(quantity: Quantity) -> &'static CStr {
    match quantity {
        Quantity::Attitude => c"components whose squares sum to 1",
        Quantity::AngularVelocity | Quantity::PostureGain => c"between -10 and 10",
        Quantity::Velocity
        | Quantity::AngularAcceleration
        | Quantity::Acceleration
        | Quantity::JointRate
        | Quantity::PostureGainRate => c"between -100 and 100",
        Quantity::JointAcceleration => c"between -1e4 and 1e4",
        Quantity::Position
        | Quantity::JointPosition
        | Quantity::ToolTorque
        | Quantity::ToolForce => c"between -1e6 and 1e6",
        Quantity::Effort => c"a finite number within WrasseLaws.effort_limit",
        Quantity::AttitudeTorque | Quantity::ForceAhead => c"a finite number",
    }
}

#[cfg(test)]
mod tests {
    use super::expected;
    use wrasse_flight::Quantity;

    /// `between -LIMIT and LIMIT`, as a number.
    fn limit(quantity: Quantity) -> Option<f64> {
        let text = expected(quantity).to_str().ok()?;
        let (least, most) = text.strip_prefix("between ")?.split_once(" and ")?;
        let (least, most): (f64, f64) = (least.parse().ok()?, most.parse().ok()?);
        (least == -most).then_some(most)
    }

    #[test]
    fn a_refusal_states_the_bound_that_is_checked() {
        for quantity in [
            Quantity::Position,
            Quantity::AngularVelocity,
            Quantity::Velocity,
            Quantity::AngularAcceleration,
            Quantity::Acceleration,
            Quantity::JointPosition,
            Quantity::JointRate,
            Quantity::JointAcceleration,
            Quantity::ToolTorque,
            Quantity::ToolForce,
            Quantity::PostureGain,
            Quantity::PostureGainRate,
        ] {
            assert_eq!(limit(quantity), Some(quantity.bound()), "{quantity:?}");
        }
    }
}
