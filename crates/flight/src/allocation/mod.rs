//! Control allocation: from a demanded torque and force to the command of each actuator, within
//! limits. What cannot be given is reported.

mod allocator;
mod bounded_simplex;
mod cmg_null_motion;
mod cmg_steering;
mod desaturation;
mod least_peak;
mod preferred_angles;
mod pulse_modulation;
mod rate_conditions;
mod span;
mod thruster_selection;
mod unload_by_posture;
mod wheel_allocation;

pub use allocator::{Allocation, AllocationReport, AllocationSetup, Allocator, Demand, Unit};
pub use bounded_simplex::BoundedSimplex;
pub use cmg_steering::{CmgLaw, CmgSharing, Damping, Waves, cmg_rates, cmg_singularity};
pub use desaturation::Desaturation;
pub use preferred_angles::preferred_angles;
pub use pulse_modulation::{Modulation, Modulator};
pub use thruster_selection::{Selection, WrenchAxes, controllable_axes, thruster_duties};
pub use unload_by_posture::{
    NoPostureUnloading, PostureUnloading, PostureUnloadingUse, ToolTask, momentum_rate,
    unload_by_posture,
};
pub use wheel_allocation::{WheelLaw, WheelSharing, wheel_torques};

use wrasse_spatial::Vec3;

/// Commands of the units of a group, and what is missing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GroupAllocation<T, const N: usize> {
    /// For each unit: torque of a wheel's motor (N·m) or rate of a gimbal (rad/s).
    pub values: [T; N],
    /// What was wanted less what these give, base axes (N·m).
    pub missing_B: Vec3<T>,
}
