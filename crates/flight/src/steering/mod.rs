//! Steering: from a wanted torque and force to what each actuator is told, within limits. What could
//! not be given is reported, not hidden.

mod bounded_simplex;
mod cmg_null_motion;
mod cmg_steering;
mod least_peak;
mod posture_relief;
mod preferred_angles;
mod pulse_modulation;
mod rate_conditions;
mod span;
mod steer;
mod thruster_selection;
mod unloading;
mod wheel_allocation;

pub use cmg_steering::{CmgLaw, CmgSharing, Damping, Waves, cmg_rates, cmg_singularity};
pub use posture_relief::{NoRelief, Relief, ReliefUse, ToolTask, momentum_rate, posture_relief};
pub use preferred_angles::preferred_angles;
pub use pulse_modulation::{Modulation, Modulator};
pub use steer::{Needs, Steered, Steering, SteeringReport, SteeringSetup, Unit};
pub use thruster_selection::{Selection, WrenchAxes, controllable_axes, thruster_duties};
pub use unloading::Unloading;
pub use wheel_allocation::{WheelLaw, WheelSharing, wheel_torques};

use wrasse_spatial::Vec3;

/// What each unit of a group is told, and what is missing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Allocation<T, const N: usize> {
    /// For each unit: torque of a wheel's motor (N·m) or rate of a gimbal (rad/s).
    pub values: [T; N],
    /// What was wanted less what these give, base axes (N·m).
    pub missing_B: Vec3<T>,
}
