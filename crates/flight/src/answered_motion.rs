//! How the base is believed to answer joint motion that is given.

use crate::law::ArmLaw;
use crate::posture::{Matter, Posture};
use crate::resolved_motion::{Belief, Resolved, ResolvedMotion};
use wrasse_dynamics::{BodyId, Robot};
use wrasse_spatial::{
    Real, SpatialAcceleration, SpatialForce, SpatialInertia, SpatialMomentum, SpatialVelocity, Vec3,
};

/// Base motion that answers given joint rates and accelerations, by the law.
pub fn answered_motion<T: Real, const J: usize>(
    robot: &Robot<T, J>,
    law: ArmLaw,
    belief: &Belief<T, J>,
    qdot: &[T; J],
    qddot: &[T; J],
) -> ResolvedMotion<T, J> {
    let posture = Posture::new(robot, &belief.q);
    let matter = posture.matter(robot);
    let h_links = momentum_of_rates(robot, &posture, &matter, qdot);
    answered_motion_in(robot, law, (&posture, &matter, &h_links), belief, qdot, qddot)
}

/// The same in a posture that is at hand, with the momentum of the links relative to the base.
#[inline(always)]
pub(crate) fn answered_motion_in<T: Real, const J: usize>(
    robot: &Robot<T, J>,
    law: ArmLaw,
    (posture, matter, h_links): (&Posture<T, J>, &Matter<T, J>, &SpatialMomentum<T>),
    belief: &Belief<T, J>,
    qdot: &[T; J],
    qddot: &[T; J],
) -> ResolvedMotion<T, J> {
    let V_NB_B = answered_twist(law, &matter.whole, &belief.h_Scm_B(), h_links);
    let F = posture.forces(robot, matter, &V_NB_B, qdot, qddot);
    let A_NB_B = recoil(law, &matter.whole, &on_base(robot, &V_NB_B, &F));
    ResolvedMotion { rate: Resolved { qdot: *qdot, V_NB_B }, qddot: *qddot, A_NB_B }
}

/// Momentum of the links about the base's origin, base axes, for joint rates on a base at rest.
#[inline(always)]
pub(crate) fn momentum_of_rates<T: Real, const J: usize>(
    robot: &Robot<T, J>,
    posture: &Posture<T, J>,
    matter: &Matter<T, J>,
    qdot: &[T; J],
) -> SpatialMomentum<T> {
    let V = posture.twists(robot, &SpatialVelocity::zero(), qdot);
    robot.joints().fold(SpatialMomentum::zero(), |h, j| h + matter.links[j] * V[j])
}

/// Angular momentum about the system's centre of mass (N·m·s, base axes) of the same motion, on a
/// base that does not turn but gives way.
#[inline(always)]
pub(crate) fn swing_of<T: Real>(
    whole: &SpatialInertia<T>,
    h_links: &SpatialMomentum<T>,
) -> Vec3<T> {
    h_links.about(whole.centre_of_mass()).torque
}

/// Base twist `V_NB_B` by which the momentum is kept, as far as the law asks for that.
#[inline(always)]
pub(crate) fn answered_twist<T: Real>(
    law: ArmLaw,
    whole: &SpatialInertia<T>,
    h_Scm_B: &SpatialMomentum<T>,
    h_links: &SpatialMomentum<T>,
) -> SpatialVelocity<T> {
    match law {
        ArmLaw::Terrestrial => SpatialVelocity::zero(),
        ArmLaw::AttitudeHeld => {
            let push = h_Scm_B.force - h_links.force;
            SpatialVelocity::new(Vec3::zero(), push * (T::one() / whole.mass))
        }
        ArmLaw::FreeFloating => {
            whole.velocity_of(&(h_Scm_B.about(-whole.centre_of_mass()) - *h_links))
        }
    }
}

/// Force on the base about its origin (N·m, N) that holds it on its steady twist `V_NB_B` while the
/// links take the forces `F`.
#[inline(always)]
pub(crate) fn on_base<T: Real, const J: usize>(
    robot: &Robot<T, J>,
    V_NB_B: &SpatialVelocity<T>,
    F: &[SpatialForce<T>; J],
) -> SpatialForce<T> {
    let M = robot.inertia(BodyId::Base);
    let own = V_NB_B.cross_force(&(*M * *V_NB_B));
    robot.joints().fold(own, |sum, j| sum + F[j])
}

/// Acceleration of the base when the force that would hold it is not there, by the law.
#[inline(always)]
pub(crate) fn recoil<T: Real>(
    law: ArmLaw,
    whole: &SpatialInertia<T>,
    holding: &SpatialForce<T>,
) -> SpatialAcceleration<T> {
    match law {
        ArmLaw::Terrestrial => SpatialAcceleration::zero(),
        ArmLaw::AttitudeHeld => {
            SpatialAcceleration::new(Vec3::zero(), holding.force * (-T::one() / whole.mass))
        }
        ArmLaw::FreeFloating => -whole.velocity_of(holding),
    }
}
