//! What acts between two frames, with a wrench and its opposite by type: one file each.

mod bushing;

pub use bushing::Bushing;

use crate::contact::Contact;
use crate::integrate::add_compensated;
use crate::scene::SystemId;
use crate::source::Source;
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
pub trait Coupling: Debug + Send {
    /// Under which its work is booked.
    fn source(&self) -> Source {
        Source::Couplings
    }
    /// How many variables it has; they begin at zero.
    fn variables(&self) -> usize {
        0
    }
    /// Whether it does nothing now: then nobody asks where its frames are.
    fn is_idle(&self) -> bool {
        false
    }
    /// The wrench on F at its origin, inertial axes (N·m, N), and the rates of its own variables. Its opposite,
    /// along the same line, acts on E: that is not for the coupling to say.
    fn act(
        &self,
        E: &FrameMotion,
        F: &FrameMotion,
        own: &[f64],
        rates: &mut [f64],
    ) -> SpatialForce<f64>;
    /// Energy that it stores (J).
    fn stored_energy(&self, _E: &FrameMotion, _F: &FrameMotion, _own: &[f64]) -> f64 {
        0.0
    }
    /// Itself, if it is a contact.
    fn contact(&self) -> Option<&Contact> {
        None
    }
    /// The same, to be changed.
    fn contact_mut(&mut self) -> Option<&mut Contact> {
        None
    }
}

/// A coupling between frames of two systems, or of one.
#[derive(Debug)]
pub(crate) struct Coupled {
    pub(crate) E: (SystemId, Frame<f64>),
    pub(crate) F: (SystemId, Frame<f64>),
    pub(crate) by: Box<dyn Coupling>,
    /// Its variables, and what rounding took from their last sums.
    pub(crate) row: Vec<f64>,
    pub(crate) carry: Vec<f64>,
}

impl Coupled {
    /// Add a displacement of its variables.
    pub(crate) fn accept(&mut self, d: &[f64]) {
        let own = self.row.iter_mut().zip(d).zip(&mut self.carry);
        own.for_each(|((x, d), carry)| add_compensated(x, *d, carry));
    }
}
