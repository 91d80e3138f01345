//! Trajectories: exact ends, limits that hold, derivatives that are those of the pose.

mod moves;
mod profiles;

use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use wrasse_flight::trajectory::{MotionLimits, ProfileShape};

const SHAPES: [ProfileShape; 2] = [ProfileShape::Quintic, ProfileShape::SCurve];

fn limits(speed: f64, acceleration: f64, jerk: f64) -> MotionLimits<f64> {
    MotionLimits { speed, acceleration, jerk }
}

/// The same cases every time.
fn cases() -> ProptestConfig {
    ProptestConfig {
        cases: 512,
        rng_seed: RngSeed::Fixed(20_040_901),
        failure_persistence: None,
        ..ProptestConfig::default()
    }
}
