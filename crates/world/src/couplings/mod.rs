//! What acts between two frames, with a wrench and its opposite by type: one file each.

mod bushing;

pub use bushing::Bushing;

use crate::contact::Contact;
use crate::integrate::add_compensated;
use crate::scene::{HeldId, SystemId};
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

/// One side of a coupling: a frame of a system, or of a payload that it holds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Side {
    pub(crate) system: SystemId,
    pub(crate) frame: Frame<f64>,
    /// The payload, and the frame on its body: let go, it takes the side along.
    pub(crate) held: Option<(HeldId, Frame<f64>)>,
}

impl From<(SystemId, Frame<f64>)> for Side {
    fn from((system, frame): (SystemId, Frame<f64>)) -> Self {
        Self { system, frame, held: None }
    }
}

impl Side {
    /// The same side while a system holds the payload that it is on, whose frame is then `at`.
    pub(crate) fn on_held(self, system: SystemId, held: HeldId, at: &Frame<f64>) -> Self {
        let X_BF = at.X_BF * self.frame.X_BF;
        Self { system, frame: Frame { body: at.body, X_BF }, held: Some((held, self.frame)) }
    }
    /// The same side on a payload that is let go, and is a system of its own.
    pub(crate) fn let_go(self, payload: SystemId) -> Self {
        self.held.map_or(self, |(_, frame)| Self { system: payload, frame, held: None })
    }
}

/// A coupling between frames of two systems, or of one.
#[derive(Debug)]
pub(crate) struct Coupled {
    pub(crate) E: Side,
    pub(crate) F: Side,
    pub(crate) by: Box<dyn Coupling>,
    /// Its variables, and what rounding took from their last sums.
    pub(crate) row: Vec<f64>,
    pub(crate) carry: Vec<f64>,
}

impl Coupled {
    /// Whether both sides are on one body: then nothing can come of it.
    pub(crate) fn is_within_a_body(&self) -> bool {
        self.E.system == self.F.system && self.E.frame.body == self.F.frame.body
    }
    /// Add a displacement of its variables.
    pub(crate) fn accept(&mut self, d: &[f64]) {
        let own = self.row.iter_mut().zip(d).zip(&mut self.carry);
        own.for_each(|((x, d), carry)| add_compensated(x, *d, carry));
    }
}
