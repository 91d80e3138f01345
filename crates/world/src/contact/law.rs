//! The law of a pair of surfaces.

use super::friction::FrictionForce;
use super::normal_force::NormalForce;

/// What holds and what slides, of a whole pair.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FrictionLaw {
    /// Nothing rubs.
    None,
    /// See [`FrictionForce::ElastoPlastic`].
    ElastoPlastic(Bristle),
    /// See [`FrictionForce::LuGre`].
    LuGre(Bristle),
    /// See [`FrictionForce::Tanh`].
    Tanh {
        /// μ (–)
        mu: f64,
        /// v_s (m/s)
        speed: f64,
    },
}

/// The bristle of a whole pair: its places share its stiffness and its damping.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bristle {
    /// μ (–)
    pub mu: f64,
    /// σ₀ (N/m)
    pub stiffness: f64,
    /// σ₁
    pub damping: BristleDamping,
}

/// How a bristle is damped.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum BristleDamping {
    /// σ₁ (N·s/m)
    Given(f64),
    /// A share of the critical damping `2 √(σ₀ m)` (–), with the effective mass m along the surface as it is
    /// when the place begins to touch.
    Ratio(f64),
}

impl FrictionLaw {
    /// At a place with a share (–) of the pair, where the least effective mass along the surface is `mass`
    /// (kg).
    pub(crate) fn at_place(&self, share: f64, mass: f64) -> FrictionForce {
        let shared = |bristle: &Bristle| {
            let stiffness = share * bristle.stiffness;
            let damping = match bristle.damping {
                BristleDamping::Given(whole) => share * whole,
                BristleDamping::Ratio(ratio) => 2.0 * ratio * (stiffness * mass).sqrt(),
            };
            (bristle.mu, stiffness, damping)
        };
        match self {
            Self::None => FrictionForce::None,
            Self::Tanh { mu, speed } => FrictionForce::Tanh { mu: *mu, speed: *speed },
            Self::ElastoPlastic(bristle) => {
                let (mu, stiffness, damping) = shared(bristle);
                FrictionForce::ElastoPlastic { mu, stiffness, damping }
            }
            Self::LuGre(bristle) => {
                let (mu, stiffness, damping) = shared(bristle);
                FrictionForce::LuGre { mu, stiffness, damping }
            }
        }
    }
}

/// How two surfaces push each other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactLaw {
    /// Along the normal.
    pub normal: NormalForce,
    /// Along the surface.
    pub friction: FrictionLaw,
    /// How much of the depth the first surface gives way by (–); the second one gives way by the rest.
    pub given_by_A: f64,
}
