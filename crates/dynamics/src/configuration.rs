//! What the positions of the joints give: where the links are, and what they weigh there.

use crate::composite_inertia::compose_links;
use crate::posture::place_links;
use crate::{BaseRows, CompositeInertia, Posture, Robot};
use wrasse_spatial::{At, Real, Rows, SpatialVelocity, kernel};

/// All that the positions of the joints give.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Configuration<T, const J: usize> {
    /// Where the links are.
    pub posture: Posture<T, J>,
    /// What they weigh, alone and with all that they carry.
    pub composite: CompositeInertia<T, J>,
    /// The base's rows of the mass matrix.
    pub base: BaseRows<T, J>,
}

kernel! {
    /// The configuration at joint positions `q` (rad or m), into its place.
    pub fn configure<L, T, J>(
        robot: &Robot<T, J>,
        q: &[T; J],
        configuration: &mut Configuration<T, J>,
    ) {
        let Configuration { posture, composite, base } = configuration;
        place_links::<L, J>(robot, q, posture);
        compose_links::<L, J>(robot, posture, composite, base);
    }
}

impl<T: Real, const J: usize> Default for Configuration<T, J> {
    fn default() -> Self {
        Self::new()
    }
}

impl<T: Real, const J: usize> Configuration<T, J> {
    /// Room for one.
    #[inline(always)]
    pub fn new() -> Self {
        let (posture, composite) = (Posture::new(), CompositeInertia::new());
        Self { posture, composite, base: BaseRows::new() }
    }
    /// At joint positions `q` (rad or m).
    #[inline(always)]
    pub fn at(robot: &Robot<T, J>, q: &[T; J]) -> Self {
        let mut configuration = Self::new();
        configure(robot, q, &mut configuration);
        configuration
    }
    /// Twists of the links relative to the base, about Bo in base axes, at joint rates `qdot` (rad/s,
    /// m/s).
    #[inline(always)]
    pub fn twists(&self, robot: &Robot<T, J>, qdot: &[T; J]) -> SpatialVelocity<[T; J]> {
        let (S, mut V) = (&self.base.S, SpatialVelocity::zero_rows());
        robot.base_to_tips(SpatialVelocity::zero(), &mut V, |j, V_P: SpatialVelocity<T>| {
            V_P + S.at(j) * qdot.at(j)
        });
        V
    }
}
