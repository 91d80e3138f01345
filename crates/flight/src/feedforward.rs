//! The arm's reaction on the base, known before it is felt.

use crate::law::Feedforward;
use wrasse_dynamics::{
    BodyId, Configuration, Generalized, InverseDynamics, Outside, PerBody, PrintedReaction, Robot,
    State, drive_configuration, inverse_dynamics, kinematics, printed_reaction,
};
use wrasse_hardware::SetPoint;
use wrasse_spatial::{Real, SpatialForce, SpatialVelocity, Vec3};

/// Torque (N·m, base axes) that the attitude control must supply so that the base does not turn while
/// the joints follow their set-points, by the chosen equation.
///
/// The exact form runs inverse dynamics as if the base were bolted down, then lets the base recoil:
/// `a = -F/m_T`, `τ = N + m_T p_BScm × a`. The printed forms see the same accelerations.
///
/// # Source
/// [`Longman1987`](wrasse_spatial::references::Longman1987);
/// [`Ellery2004`](wrasse_spatial::references::Ellery2004) eq. (3) for the printed forms.
pub fn feedforward_torque<T: Real, const J: usize>(
    robot: &Robot<T, J>,
    kind: Feedforward,
    joints: &[SetPoint<T>; J],
) -> Vec3<T> {
    match kind {
        Feedforward::Exact => exact(robot, joints),
        Feedforward::AsPrinted => printed(robot, joints, |r| r.N_r_arm_cm),
        Feedforward::AsPrintedSystemCm => printed(robot, joints, |r| r.N_r_system_cm),
        Feedforward::None => Vec3::zero(),
    }
}

#[inline(always)]
fn exact<T: Real, const J: usize>(robot: &Robot<T, J>, joints: &[SetPoint<T>; J]) -> Vec3<T> {
    let configuration = Configuration::at(robot, &joints.map(|s| s.position));
    let (still, mut motion) = (SpatialVelocity::zero(), InverseDynamics::new());
    let nu = Generalized { base: still, joints: joints.map(|s| s.rate) };
    let nudot = Generalized { base: still, joints: joints.map(|s| s.acceleration) };
    drive_configuration(robot, &configuration, &nu, &nudot, Outside::nothing(), &mut motion);
    let (F, M_bb) = (motion.force.base, configuration.base.M_bb);
    F.torque + M_bb.first_moment.cross(F.force * (-T::one() / M_bb.mass))
}

fn printed<T: Real, const J: usize>(
    robot: &Robot<T, J>,
    joints: &[SetPoint<T>; J],
    pick: impl Fn(&PrintedReaction<T>) -> Vec3<T>,
) -> Vec3<T> {
    // The base stands in the origin of its own axes, so that all comes out in base axes.
    let state =
        State { q: joints.map(|s| s.position), v: joints.map(|s| s.rate), ..State::default() };
    let k = kinematics(robot, &state);
    let mut nudot =
        Generalized { base: SpatialVelocity::zero(), joints: joints.map(|s| s.acceleration) };
    let bolted = inverse_dynamics(&k, &nudot, &PerBody::filled(SpatialForce::zero())).force.base;
    nudot.base.linear = bolted.force * (-T::one() / k.centre_of_mass().0);
    let roots = robot.joints().filter(|&j| robot.joint(j).parent == BodyId::Base);
    roots.fold(Vec3::zero(), |sum, root| sum + pick(&printed_reaction(&k, &nudot, root)))
}
