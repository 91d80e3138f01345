//! How the base is believed to answer joint motion that is given.

use crate::computed_torque::recoil;
use crate::law::ArmLaw;
use crate::resolved_motion::{Belief, Resolved, ResolvedMotion};
use wrasse_dynamics::{
    BaseMode, BaseRows, Configuration, Generalized, InverseDynamics, Outside, Robot,
    drive_configuration,
};
use wrasse_spatial::{Real, SpatialInertia, SpatialMomentum, SpatialVelocity, Vec3};

/// Base motion that answers given joint rates and accelerations, by the law.
pub fn believed_base_response<T: Real, const J: usize>(
    robot: &Robot<T, J>,
    law: ArmLaw,
    belief: &Belief<T, J>,
    qdot: &[T; J],
    qddot: &[T; J],
) -> ResolvedMotion<T, J> {
    let (at, mut forces) = (Configuration::at(robot, &belief.q), InverseDynamics::new());
    believed_base_response_in(robot, law, (&at, &mut forces), belief, qdot, qddot)
}

/// The same in a configuration that is at hand.
#[inline(always)]
pub(crate) fn believed_base_response_in<T: Real, const J: usize>(
    robot: &Robot<T, J>,
    law: ArmLaw,
    (configuration, forces): (&Configuration<T, J>, &mut InverseDynamics<T, J>),
    belief: &Belief<T, J>,
    qdot: &[T; J],
    qddot: &[T; J],
) -> ResolvedMotion<T, J> {
    let M = &configuration.base;
    let V_NB_B = base_twist_response(law, &M.M_bb, &M.momentum_of_rates(qdot), &belief.h_Scm_B());
    let still = SpatialVelocity::zero();
    let nu = Generalized { base: V_NB_B, joints: *qdot };
    let nudot = Generalized { base: still, joints: *qddot };
    drive_configuration(robot, configuration, &nu, &nudot, Outside::nothing(), forces);
    let A_NB_B = recoil(law.base(), M, &forces.force.base);
    ResolvedMotion { rate: Resolved { qdot: *qdot, V_NB_B }, qddot: *qddot, A_NB_B }
}

/// Base twist `V_NB_B` by which the momentum is kept, as far as the law asks for that; `h_rates` is
/// that of the joint rates alone, about Bo in base axes.
#[inline(always)]
pub(crate) fn base_twist_response<T: Real>(
    law: ArmLaw,
    M_bb: &SpatialInertia<T>,
    h_rates: &SpatialMomentum<T>,
    h_Scm_B: &SpatialMomentum<T>,
) -> SpatialVelocity<T> {
    match law.base() {
        BaseMode::Fixed => SpatialVelocity::zero(),
        BaseMode::AttitudeHeld => {
            let push = h_Scm_B.force - h_rates.force;
            SpatialVelocity::new(Vec3::zero(), push * (T::one() / M_bb.mass))
        }
        BaseMode::Free => {
            let mobility = M_bb.inverse();
            mobility.velocity_of(&(h_Scm_B.about(-mobility.p_cm) - *h_rates))
        }
    }
}

/// Angular momentum of the joints' motion about the system's centre of mass (N·m·s, base axes), on a
/// base that does not turn but gives way.
#[inline(always)]
pub(crate) fn joint_momentum_B<T: Real>(
    M_bb: &SpatialInertia<T>,
    h_rates: &SpatialMomentum<T>,
) -> Vec3<T> {
    h_rates.about(M_bb.centre_of_mass()).torque
}

/// Total momentum about the system's centre of mass, base axes, as far as the law asks for it: all of it,
/// its linear part, or nothing.
#[inline(always)]
pub(crate) fn momentum_for<T: Real, const J: usize>(
    law: ArmLaw,
    M: &BaseRows<T, J>,
    state: &wrasse_dynamics::State<T, J>,
) -> SpatialMomentum<T> {
    let h = M.momentum_of_rates(&state.v) + M.M_bb * state.V_NB_B;
    match law.base() {
        BaseMode::Fixed => SpatialMomentum::zero(),
        BaseMode::AttitudeHeld => SpatialMomentum::new(Vec3::zero(), h.force),
        BaseMode::Free => h.about(M.M_bb.centre_of_mass()),
    }
}
