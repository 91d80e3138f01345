//! Signals of each tool of a vehicle that has several.

use crate::signals::observe::there;
use crate::signals::quantity::Statistic::{Final, Max, Rms};
use crate::signals::quantity::{Kind, Statistic};
use wrasse_spatial::Vec3;
use wrasse_vehicle::Vehicle;

/// Tool less reference: position (m) and rotation vector (rad), in the reference's axes.
pub(crate) type ToolError = (Vec3<f64>, Vec3<f64>);

/// Most tools of a vehicle that are watched one by one.
pub(crate) const TOOLS: usize = 4;

/// The tools that have signals of their own: where there are several, the first of them.
pub fn watched_tools(vehicle: &Vehicle) -> &[String] {
    match vehicle.tools.len() {
        0 | 1 => &[],
        many => &vehicle.tools[..many.min(TOOLS)],
    }
}

/// A signal that each of several tools has.
pub(super) struct ToolSignal {
    pub(super) name: &'static str,
    pub(super) meaning: &'static str,
    pub(super) kind: Kind,
    pub(super) statistics: &'static [Statistic],
    pub(super) value: fn(&ToolError) -> f64,
}

/// The signals of each tool, while an arm guides it.
pub(super) const TOOL_SIGNALS: [ToolSignal; 2] = [
    ToolSignal {
        name: "position_error",
        meaning: "distance of this tool from where it should be, while an arm guides it",
        kind: Kind::Length,
        statistics: &[Max, Final, Rms],
        value: |error| there(error.0.norm()),
    },
    ToolSignal {
        name: "attitude_error",
        meaning: "angle of this tool from how it should be turned, while an arm guides it",
        kind: Kind::Angle,
        statistics: &[Max, Final, Rms],
        value: |error| there(error.1.norm()),
    },
];
