//! The arm's reaction on the base, known before it is felt.

use crate::law::Feedforward;
use crate::newton_euler::{Sum, Swing};
use wrasse_dynamics::{
    BodyId, Generalized, PerBody, PrintedReaction, Robot, State, inverse_dynamics, kinematics,
    printed_reaction,
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
    let Sum { F, mass, first_moment } = Swing::new(robot, joints).base;
    F.torque + first_moment.cross(F.force * (-T::one() / mass))
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
