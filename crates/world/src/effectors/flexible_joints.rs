//! Driven joints whose transmission gives: motor and link are joined by a spring.

use super::{Effector, Load, Stage};
use crate::setup::Drive;
use crate::source::Source;

/// A flexible transmission of a joint, seen from the link's side of the gear.
///
/// # Source
/// [`Spong1987`](wrasse_spatial::references::Spong1987): `H q̈ + c = K (θ - q) + D (θ̇ - q̇)`,
/// `B θ̈ = τ - K (θ - q) - D (θ̇ - q̇)`; the motor's turning counts along its own axis alone.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct FlexibleJoint {
    /// The joint.
    pub joint: usize,
    /// Stiffness of the transmission (N·m/rad or N/m).
    pub stiffness: f64,
    /// Damping of the transmission (N·m·s/rad or N·s/m).
    pub damping: f64,
    /// Inertia of the motor behind the gear (kg·m² or kg).
    pub motor_inertia: f64,
}

/// The flexible joints of a system. Their motors begin without a twist of the transmission.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct FlexibleJoints(pub Vec<FlexibleJoint>);

impl<const J: usize> Effector<J> for FlexibleJoints {
    fn source(&self) -> Source {
        Source::JointSprings
    }
    fn acts_on_held_base(&self) -> bool {
        true
    }
    /// Of each joint how far the motor is ahead of it (rad or m), and how fast it turns (rad/s or m/s).
    fn variables(&self) -> Vec<String> {
        let each = self.0.iter().map(|f| f.joint);
        each.flat_map(|j| [format!("twist of joint {j}"), format!("motor rate of joint {j}")])
            .collect()
    }
    fn act(&self, at: &Stage<'_, J>, own: &[f64], load: &mut Load<'_, J>, rates: &mut [f64]) {
        for (i, joint) in self.0.iter().enumerate() {
            let (twist, motor_rate) = (own[2 * i], own[2 * i + 1]);
            let v = at.state.v[joint.joint];
            let passed_on = joint.stiffness * twist + joint.damping * (motor_rate - v);
            let Drive::Effort(tau) = at.drives[joint.joint] else { continue };
            rates[2 * i] = motor_rate - v;
            rates[2 * i + 1] = (tau - passed_on) / joint.motor_inertia;
            // The link feels the transmission in place of the motor.
            load.drive(joint.joint, v, passed_on - tau);
        }
    }
}
