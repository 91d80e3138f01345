//! Simulated truth: motion of the bodies, drives and actuators as they behave, the ledger.
//!
//! The state is attitude, joints, centre of mass and total momentum in inertial axes; the base's
//! twist follows from them, less what wheels and CMGs hold. So only an outside wrench, a thruster or
//! the ideal actuator can change momentum, at any step size. The ledger never reads that state: it sums the bodies one by one.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

mod advance;
mod cmgs;
mod command;
mod failure;
mod flow;
mod free_body;
mod free_flight;
mod grasp;
mod ledger;
mod noise;
mod propellant;
mod rates;
mod sensors;
mod setup;
mod stepper;
mod thrusters;
mod wheels;
mod world;

pub use advance::NonFinite;
pub use command::Saturation;
pub use failure::Failure;
pub use flow::Flow;
pub use free_body::FreeBody;
pub use grasp::{GraspRefused, GripOffset};
pub use ledger::{Account, Ledger};
pub use noise::Noise;
pub use propellant::Carried;
pub use sensors::{SensorReadings, SensorSuite};
pub use setup::{BaseAttitude, Drive, Equipment, Instant, OutsideWrench, WorldSetup};
pub use stepper::{Displacement, Judged, Stepper, dormand_prince, runge_kutta_4};
pub use world::{SystemState, World};
