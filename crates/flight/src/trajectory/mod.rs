//! Motions over time: profiles of one path parameter, straight lines of the tool, joint moves.

mod cube_root;
mod joint_move;
mod limits;
mod profile;
mod quintic;
mod s_curve;
mod straight_line;

pub use joint_move::{JointMove, JointSetPoint};
pub use limits::{BadNumber, BadNumbers, Expected, MotionLimits, Quantity};
pub use profile::{Profile, ProfileShape};
pub use quintic::Quintic;
pub use s_curve::SCurve;
pub use straight_line::{StraightLine, ToolMotion, ToolWay};

/// Where one coordinate is, how fast, and how fast that changes.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Motion<T> {
    /// Position (m, rad, or – for a fraction of a path).
    pub position: T,
    /// Its rate (per s).
    pub velocity: T,
    /// The rate of that (per s²).
    pub acceleration: T,
}
