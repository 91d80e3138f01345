//! Estimates against the truth, against their own promise, and against theory by another route.
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "counts of periods, and numbers in single precision"
)]

mod covariance;
mod joints;
mod late_readings;
mod navigation;
mod processor;
mod promises;
mod refused_readings;
mod truth;
