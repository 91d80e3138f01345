//! What would fly: guidance, inverse kinematics, arm and attitude control. No heap, no `std`.
#![no_std]
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

pub mod allocation;
pub mod inverse_kinematics;
pub mod trajectory;

mod arm_guidance;
mod attitude_control;
mod attitude_estimator;
mod base_control;
mod believed_base_response;
mod carried_rates;
mod checked_period;
mod clock;
mod combined_way;
mod computed_torque;
mod computer;
mod computer_answers;
mod condition;
mod control_period;
mod coupling_inertia;
mod damped_inverse;
mod error_covariance;
mod executive;
mod feedforward;
mod interface;
mod joint_estimator;
mod law;
mod navigation;
mod period_bounds;
mod period_command;
mod phase;
mod resolved_motion;
mod setup;
mod several_arms;
mod step;
mod tool_pose;
mod tool_wrench;

pub use attitude_control::attitude_acceleration;
pub use attitude_estimator::{AttitudeEstimate, AttitudeEstimator, EstimatorSetup, TRACKER_MEMORY};

pub use believed_base_response::believed_base_response;
pub use checked_period::{PeriodFault, checked_period};
pub use clock::{BadPhase, LONGEST, NoWay};
pub use computed_torque::computed_torque;
pub use computer::FlightComputer;
pub use computer_answers::ArmAtWork;
pub use condition::{Condition, SensedSignal};
pub use control_period::{ArmReference, PeriodMemory, control_period};
pub use coupling_inertia::CouplingInertia;
pub use executive::StepEnd;
pub use feedforward::feedforward_torque;
pub use interface::{Axes, BaseReading, Command, Grip, GripAnswer, JointReading, Sensed};
pub use joint_estimator::JointEstimator;
pub use law::{ArmLaw, Feedforward, Measurement, Task, Tuning};
pub use navigation::{Navigation, NavigationSetup};
pub use period_bounds::{OutOfBounds, Quantity, check_reading, check_reference};
pub use period_command::ControlOutput;
pub use phase::{Held, JointTarget, JointTiming, Phase, Target, Timing};
pub use resolved_motion::{
    Assignment, Belief, JointUse, Resolved, ResolvedMotion, WantedMotion, joint_rates,
    resolved_motion, task_jacobian,
};

pub use setup::{Actuation, BaseControlSetup, PositionHold, Setup};
pub use step::{ARMS, ArmTask, Next, STEPS, Step};
pub use tool_pose::{Unreachable, joints_for_tool};
pub use tool_wrench::against_tool_wrench;
