//! What acts between two frames, with a wrench and its opposite by type: one file each.

mod bushing;

pub use bushing::Bushing;

use crate::scene::SystemId;
use std::fmt::Debug;
use wrasse_dynamics::Frame;
use wrasse_spatial::{Pose, SpatialForce, SpatialVelocity};

/// How a frame stands and moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrameMotion {
    /// Pose `X_NF`.
    pub X_NF: Pose<f64>,
    /// Twist of its origin, inertial axes (rad/s, m/s).
    pub V_NF_N: SpatialVelocity<f64>,
}

/// Something that acts between frame E of one system and frame F of another, or of the same.
pub trait Coupling: Debug + Send + Sync {
    /// The wrench on F at its origin, inertial axes (N·m, N). Its opposite, along the same line, acts on
    /// E: that is not for the coupling to say.
    fn wrench(&self, E: &FrameMotion, F: &FrameMotion) -> SpatialForce<f64>;
    /// Energy that it stores (J).
    fn stored_energy(&self, _E: &FrameMotion, _F: &FrameMotion) -> f64 {
        0.0
    }
}

/// A coupling between frames of two systems, or of one.
#[derive(Debug)]
pub(crate) struct Coupled {
    pub(crate) E: (SystemId, Frame<f64>),
    pub(crate) F: (SystemId, Frame<f64>),
    pub(crate) by: Box<dyn Coupling>,
}
