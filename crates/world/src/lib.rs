//! Simulated truth: motion of the bodies, drives and actuators as they behave, the ledger.
//!
//! The state is attitude, joints, centre of mass and total momentum in inertial axes; the base's
//! twist follows from them, less what wheels and CMGs hold. So only an outside wrench, a thruster or
//! the ideal actuator can change momentum, at any step size. The ledger never reads that state: it sums the bodies one by one.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

mod advance;
mod command;
mod contact;
mod couplings;
mod effectors;
mod environment;
mod events;
mod failure;
mod free_body;
mod gears;
mod grasp;
mod impulse;
mod integrate;
mod ledger;
mod noise;
mod scene;
mod sensors;
mod setup;
mod source;
mod stage;
mod system;
mod variables;

pub use advance::NonFinite;
pub use command::Saturation;
pub use contact::{
    Bristle, BristleDamping, Contact, ContactAccuracy, ContactEnergy, ContactEvent, ContactLaw,
    ContactRecord, Curvature, FrictionForce, FrictionLaw, LEAST_RESTITUTION, NormalForce,
    PairRefused, damping_number, law_of_pair, restitution_at, uniform_disc_friction,
};
pub use couplings::{Bushing, Coupling, FrameMotion, Side};
pub use effectors::{
    AppliedWrench, Course, Effector, Instant, Load, MotorTorques, PeriodCommand, SloshPendulum,
    SloshingTank, Stage, TankWithPropellant,
};
pub use effectors::{FlexibleJoint, FlexibleJoints, JointSpring, PassiveJoints};
pub use environment::Environment;
pub use events::{Crossing, Event, EventValue, Happening};
pub use failure::Failure;
pub use free_body::FreeBody;
pub use grasp::{GraspRefused, GripOffset};
pub use integrate::{DormandPrince, RungeKutta4, Stepper};
pub use ledger::{Account, Ledger};
pub use noise::Noise;
pub use scene::{CouplingId, HeldId, Scene, SystemId};
pub use sensors::{SensorReadings, SensorSuite};
pub use setup::{BaseAttitude, Drive, Equipment, SystemSetup};
pub use source::{Booking, Bookings, Source};
pub use system::Held;
