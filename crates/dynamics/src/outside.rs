//! What pushes a robot from outside.

use crate::{BodyId, PerBody, Robot};
use wrasse_spatial::{Real, SpatialForce};

/// Wrenches from outside: on each body at its origin, in its axes (N·m, N).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Outside<'a, T, const J: usize> {
    /// On the base.
    pub base: SpatialForce<T>,
    /// On the links, if anything pushes them.
    pub links: Option<&'a [SpatialForce<T>; J]>,
}

impl<T: Real, const J: usize> Outside<'_, T, J> {
    /// Nothing pushes.
    #[inline(always)]
    pub fn nothing() -> Self {
        Self { base: SpatialForce::zero(), links: None }
    }
    /// On a link, in the link's axes; `None` if no link is pushed.
    #[inline(always)]
    pub(crate) fn on_link(&self, robot: &Robot<T, J>, j: usize) -> Option<SpatialForce<T>> {
        let (F_B, R_LB) = (&self.links?[j], &robot.link(j).R_LB);
        Some(SpatialForce::new(*R_LB * F_B.torque, *R_LB * F_B.force))
    }
    /// The same on any body.
    #[inline(always)]
    pub(crate) fn on(&self, robot: &Robot<T, J>, body: BodyId) -> Option<SpatialForce<T>> {
        match body {
            BodyId::Base => Some(self.base),
            BodyId::Link(j) => self.on_link(robot, j),
        }
    }
}

impl<'a, T: Real, const J: usize> From<&'a PerBody<SpatialForce<T>, J>> for Outside<'a, T, J> {
    #[inline(always)]
    fn from(on: &'a PerBody<SpatialForce<T>, J>) -> Self {
        Self { base: on.base, links: Some(&on.links) }
    }
}
