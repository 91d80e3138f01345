//! What would fly: guidance, inverse kinematics, arm and attitude control. No heap, no `std`.
#![no_std]
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

pub mod inverse_kinematics;
pub mod steering;
pub mod trajectory;

mod answered_motion;
mod attitude_control;
mod attitude_estimator;
mod base_control;
mod carried_rates;
mod checked_period;
mod computed_torque;
mod computer;
mod computer_answers;
mod control_period;
mod coupling_inertia;
mod damped_inverse;
mod door;
mod error_covariance;
mod feedforward;
mod guidance;
mod joint_estimator;
mod law;
mod navigation;
mod period_bounds;
mod period_command;
mod phase;
mod resolved_motion;
mod sequence;
mod tool_pose;
mod tool_wrench;

pub use answered_motion::answered_motion;
pub use attitude_control::attitude_acceleration;
pub use attitude_estimator::{AttitudeEstimate, AttitudeEstimator, EstimatorSetup, TRACKER_MEMORY};
pub use base_control::{Actuation, BaseControlSetup, PositionHold};
pub use checked_period::{PeriodFault, checked_period};
pub use computed_torque::computed_torque;
pub use computer::{FlightComputer, Setup};
pub use control_period::{Asked, PeriodMemory, control_period};
pub use coupling_inertia::CouplingInertia;
pub use door::{Axes, BaseReading, Command, Grip, JointReading, Sensed};
pub use feedforward::feedforward_torque;
pub use guidance::{Guidance, Guided};
pub use joint_estimator::JointEstimator;
pub use law::{ArmLaw, Feedforward, Measurement, Task, Tuning};
pub use navigation::{Navigation, NavigationSetup};
pub use period_bounds::{OutOfBounds, Quantity, check_asked, check_reading};
pub use period_command::Told;
pub use phase::{Held, JointTarget, JointTiming, PHASES, Phase, Target, Timing};
pub use resolved_motion::{
    Assignment, Belief, JointUse, Resolved, ResolvedMotion, WantedMotion, joint_rates,
    resolved_motion, task_jacobian,
};
pub use sequence::{BadPhase, LONGEST, NoWay};
pub use tool_pose::{Unreachable, joints_for_tool};
pub use tool_wrench::against_tool_wrench;
