//! `[control]`, as far as the base is concerned: what turns it, and `[control.position_hold]`.

use crate::reading::Reading;
use crate::toml::MissionFile;
use crate::toml::control::FeedforwardFile;
use crate::toml::pose::attitude;
use crate::toml::steering::steering;
use crate::toml::world::BaseFile;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use wrasse_document::at;
use wrasse_flight::allocation::AllocationSetup;
use wrasse_flight::{Actuation, BaseControlSetup, Feedforward, PositionHold};
use wrasse_rehearsal::AttitudeActuation;
use wrasse_spatial::Quat;
use wrasse_vehicle::Equipment;

/// Keep the centre of mass where it was at the start, by thrusters.
#[derive(Debug, Clone, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct PositionHoldFile {
    /// Bandwidth of the loop.
    pub(crate) bandwidth_rad_s: f64,
    /// Damping ratio of the loop.
    #[serde(default = "one")]
    pub(crate) damping_ratio: f64,
}

fn one() -> f64 {
    1.0
}

/// How the base is controlled.
pub(crate) fn base_control(
    r: &mut Reading<'_>,
    file: &MissionFile,
    actuation: AttitudeActuation,
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
        quat_ND: Quat::from_matrix(&attitude(r, at!["initial", "attitude"], file.initial.attitude)),
        actuation: match (actuation, fitted) {
            _ if file.world.base_attitude != BaseFile::Controlled => Actuation::None,
            (AttitudeActuation::Fitted, Some(e)) => Actuation::Fitted(AllocationSetup {
                actuators: e.actuators,
                holds_position: position_hold.is_some(),
                ..steering
            }),
            (AttitudeActuation::Fitted, None) => Actuation::None,
            (AttitudeActuation::Ideal(limits), _) => Actuation::Ideal(limits),
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
