//! Joints with a spring and a damper: a sprung solar panel, a hinge that is never driven.

use super::{Effector, Load, Stage};
use crate::source::Source;

/// A spring and damper of a joint.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct JointSpring {
    /// The joint.
    pub joint: usize,
    /// Stiffness (N·m/rad or N/m).
    pub stiffness: f64,
    /// Damping (N·m·s/rad or N·s/m).
    pub damping: f64,
    /// Where the spring is at rest (rad or m).
    pub rest: f64,
}

impl JointSpring {
    /// What it does to its joint at a position and a rate (N·m or N).
    pub fn effort(&self, position: f64, rate: f64) -> f64 {
        -self.stiffness * (position - self.rest) - self.damping * rate
    }
}

/// The springs of a system's joints.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct PassiveJoints(pub Vec<JointSpring>);

impl<const J: usize> Effector<J> for PassiveJoints {
    fn source(&self) -> Source {
        Source::JointSprings
    }
    fn acts_on_held_base(&self) -> bool {
        true
    }
    fn act(&self, at: &Stage<'_, J>, _own: &[f64], load: &mut Load<'_, J>, _rates: &mut [f64]) {
        for spring in &self.0 {
            let (q, v) = (at.state.q[spring.joint], at.state.v[spring.joint]);
            load.drive(spring.joint, v, spring.effort(q, v));
        }
    }
}
