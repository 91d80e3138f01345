//! What a surface does when it is touched, as plain data.

/// How hard a surface is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Hardness<T> {
    /// A force of `stiffness` times the depth to the power of `exponent` (1 or 1.5), against something rigid.
    Spring {
        /// (N/mⁿ)
        stiffness: T,
        /// n (–)
        exponent: T,
    },
    /// An elastic body: what force it takes depends on how both surfaces are curved.
    Elastic {
        /// Modulus of elasticity (Pa).
        youngs_modulus: T,
        /// Poisson's ratio (–).
        poisson_ratio: T,
    },
}

/// How a surface rubs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Friction<T> {
    /// Not at all.
    None,
    /// A spring and a damper in series with a Coulomb slider: it holds what is below the limit.
    ElastoPlastic {
        /// Coefficient (–).
        mu: T,
        /// Tangential stiffness per normal stiffness (–).
        stiffness_ratio: T,
        /// Damping of the bristle as a share of the critical damping (–).
        damping_ratio: T,
    },
    /// Coulomb's force smoothed by a hyperbolic tangent: it never holds. For comparison.
    Tanh {
        /// Coefficient (–).
        mu: T,
        /// Speed of creep (m/s).
        speed: T,
    },
    /// LuGre without Stribeck effect and viscosity: it walks under pulsating loads. For comparison.
    LuGre {
        /// Coefficient (–).
        mu: T,
        /// Tangential stiffness per normal stiffness (–).
        stiffness_ratio: T,
        /// Damping of the bristle as a share of the critical damping (–).
        damping_ratio: T,
    },
}

/// A surface: how hard it is, how it throws back and how it rubs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Surface<T> {
    /// How hard.
    pub hardness: Hardness<T>,
    /// Speed after a free impact on something rigid per speed before it, at `restitution_speed` (–): 0.05 to
    /// 1.
    pub restitution: T,
    /// (m/s)
    pub restitution_speed: T,
    /// How it rubs.
    pub friction: Friction<T>,
}
