//! How the base is believed to answer joint motion that is given.

use crate::law::ArmLaw;
use crate::locked::Locked;
use crate::posture::Posture;
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
    answered_motion_in(
        robot,
        law,
        &posture,
        &Locked::new(robot, &belief.q, qdot),
        belief,
        qdot,
        qddot,
    )
}

/// The same in a posture that is at hand, with what the joints' motion adds to the locked system.
#[inline(always)]
pub(crate) fn answered_motion_in<T: Real, const J: usize>(
    robot: &Robot<T, J>,
    law: ArmLaw,
    posture: &Posture<T, J>,
    locked: &Locked<T>,
    belief: &Belief<T, J>,
    qdot: &[T; J],
    qddot: &[T; J],
) -> ResolvedMotion<T, J> {
    let V_NB_B = answered_twist(law, locked, &belief.h_Scm_B());
    let F = posture.forces(robot, &posture.matter(robot), &V_NB_B, qdot, qddot);
    let A_NB_B = recoil(law, &locked.M, &on_base(robot, &V_NB_B, &F));
    ResolvedMotion { rate: Resolved { qdot: *qdot, V_NB_B }, qddot: *qddot, A_NB_B }
}

/// Base twist `V_NB_B` by which the momentum is kept, as far as the law asks for that.
#[inline(always)]
pub(crate) fn answered_twist<T: Real>(
    law: ArmLaw,
    locked: &Locked<T>,
    h_Scm_B: &SpatialMomentum<T>,
) -> SpatialVelocity<T> {
    match law {
        ArmLaw::Terrestrial => SpatialVelocity::zero(),
        ArmLaw::AttitudeHeld => {
            let push = h_Scm_B.force - locked.h.force;
            SpatialVelocity::new(Vec3::zero(), push * (T::one() / locked.M.mass))
        }
        ArmLaw::FreeFloating => {
            locked.M.velocity_of(&(h_Scm_B.about(-locked.M.centre_of_mass()) - locked.h))
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
