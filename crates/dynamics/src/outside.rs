//! What pushes a robot from outside.

use crate::{PerBody, Posture, Robot};
use wrasse_spatial::{At, Real, SpatialForce};

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
    /// On a link about its origin, in base axes.
    #[inline(always)]
    pub(crate) fn on_link(
        robot: &Robot<T, J>,
        posture: &Posture<T, J>,
        j: usize,
        F_B: &SpatialForce<T>,
    ) -> SpatialForce<T> {
        let turned = |v| posture.R_BL.at(j) * (robot.R_LB(j) * v);
        SpatialForce::new(turned(F_B.torque), turned(F_B.force))
    }
    /// Take the wrenches on the links off what the links need; about their origins, base axes.
    #[inline(always)]
    pub(crate) fn take_off(
        &self,
        robot: &Robot<T, J>,
        posture: &Posture<T, J>,
        F: &mut SpatialForce<[T; J]>,
    ) {
        let Some(links) = self.links else { return };
        for (j, F_B) in robot.joints().zip(links) {
            F.put(j, F.at(j) - Self::on_link(robot, posture, j, F_B));
        }
    }
}

impl<'a, T: Real, const J: usize> From<&'a PerBody<SpatialForce<T>, J>> for Outside<'a, T, J> {
    #[inline(always)]
    fn from(on: &'a PerBody<SpatialForce<T>, J>) -> Self {
        Self { base: on.base, links: Some(&on.links) }
    }
}
