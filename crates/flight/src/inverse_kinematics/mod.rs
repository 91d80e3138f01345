//! Joint positions for a pose of the tool: closed form for spherical–revolute–spherical arms,
//! damped least squares for any arm; each for a fixed base, and with base attitude and system
//! centre of mass held.

mod arm_chain;
mod closed_form;
mod damped_least_squares;
mod precision;
mod spherical_joint;
mod spherical_revolute_spherical;

pub use arm_chain::{ArmChain, NotThisKind};
pub use closed_form::{ArmSolution, ClosedForm, Reference, Solutions};
pub use damped_least_squares::{
    Anchor, Attempt, DampedLeastSquares, DampedOutcome, damped_least_squares,
};
pub use spherical_joint::Side;
pub use spherical_revolute_spherical::{Branch, SphericalRevoluteSpherical};
