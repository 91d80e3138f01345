//! Friction at one place of a contact: what holds, what slides, and how the bristle moves.
//!
//! # Source
//! Coulomb slider in series with spring and damper: [`Dupont2002`](wrasse_spatial::references::Dupont2002)
//! for the idea of elasto-plastic presliding; LuGre:
//! [`CanudasDeWit1995`](wrasse_spatial::references::CanudasDeWit1995).

use wrasse_spatial::Vec3;

/// How two surfaces rub at one place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FrictionForce {
    /// Not at all.
    None,
    /// Spring and damper in series with a Coulomb slider: below the limit a linear spring and damper,
    /// which holds; never beyond `μ f_n`.
    ElastoPlastic {
        /// μ (–)
        mu: f64,
        /// σ₀ (N/m)
        stiffness: f64,
        /// σ₁ (N·s/m), above zero.
        damping: f64,
    },
    /// `-μ f_n tanh(|v|/v_s) v/|v|`: it creeps under any load. For comparison.
    Tanh {
        /// μ (–)
        mu: f64,
        /// v_s (m/s)
        speed: f64,
    },
    /// LuGre without Stribeck effect and viscosity: it walks under pulsating loads. For comparison.
    LuGre {
        /// μ (–)
        mu: f64,
        /// σ₀ (N/m)
        stiffness: f64,
        /// σ₁ (N·s/m)
        damping: f64,
    },
}

impl FrictionForce {
    /// The force (N) on A that slides on B with velocity `slip` (m/s) under a normal force (N), and the rate
    /// of the bristle `z` (m); all in the plane of contact.
    pub fn act(&self, normal: f64, slip: Vec3<f64>, z: Vec3<f64>) -> (Vec3<f64>, Vec3<f64>) {
        match *self {
            Self::None => (Vec3::zero(), Vec3::zero()),
            Self::ElastoPlastic { mu, stiffness, damping } => {
                let held = z * stiffness + slip * damping;
                let (size, limit) = (held.norm(), mu * normal);
                if size <= limit {
                    (-held, slip)
                } else {
                    let force = held * (-limit / size);
                    (force, (-force - z * stiffness) * (1.0 / damping))
                }
            }
            Self::Tanh { mu, speed } => {
                let v = slip.norm();
                // tanh(x)/x tends to one at rest.
                let share = if v > 0.0 { libm::tanh(v / speed) / v } else { 1.0 / speed };
                (slip * (-mu * normal * share), Vec3::zero())
            }
            Self::LuGre { mu, stiffness, damping } => {
                let limit = mu * normal;
                let leak = if limit > 0.0 { stiffness * slip.norm() / limit } else { 0.0 };
                let zdot = slip - z * leak;
                (-(z * stiffness + zdot * damping), zdot)
            }
        }
    }
    /// Energy in the bristle (J).
    pub fn stored(&self, z: Vec3<f64>) -> f64 {
        match *self {
            Self::None | Self::Tanh { .. } => 0.0,
            Self::ElastoPlastic { stiffness, .. } | Self::LuGre { stiffness, .. } => {
                0.5 * stiffness * z.dot(z)
            }
        }
    }
    /// Squared frequency of the bristle and rate of what damps it (1/s², 1/s), where an impulse along the
    /// surface gives `mobility` (1/kg), under a normal force (N) and at a sliding speed (m/s).
    pub(crate) fn pace(&self, mobility: f64, normal: f64, slip: f64) -> (f64, f64) {
        match *self {
            Self::None => (0.0, 0.0),
            Self::Tanh { mu, speed } => (0.0, mu * normal * mobility / speed),
            Self::ElastoPlastic { stiffness, damping, .. } => {
                (stiffness * mobility, stiffness / damping)
            }
            Self::LuGre { mu, stiffness, damping } => {
                let leak = if normal > 0.0 { stiffness * slip / (mu * normal) } else { 0.0 };
                (stiffness * mobility, leak + damping * mobility)
            }
        }
    }
    /// Whether there is a bristle.
    pub(crate) fn has_bristle(&self) -> bool {
        matches!(self, Self::ElastoPlastic { .. } | Self::LuGre { .. })
    }
}
