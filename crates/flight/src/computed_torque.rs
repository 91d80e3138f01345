//! Computed torque, in the three forms: base fixed, attitude held, free-floating.

use crate::answered_motion::{on_base, recoil};
use crate::law::{ArmLaw, Tuning};
use crate::newton_euler::Swing;
use crate::posture::Posture;
use wrasse_dynamics::{BodyId, Robot, State};
use wrasse_hardware::SetPoint;
use wrasse_spatial::{Real, SpatialVelocity, Vec3, Work};

/// Joint torques (N·m, N) that follow the set-points: `τ = H (q̈_d + 2ζω ė + ω² e) + c`.
///
/// `H` and `c` are those of the law: `M_jj, c_j` (terrestrial), `H̄, c̄` (attitude held), `H*, c*`
/// (free-floating). They are not formed: the forces of the motion on a base that does not answer come
/// first, then those of its recoil. `acceleration` is the one to feed forward over the period.
///
/// # Source
/// [`UmetaniYoshida1989`](wrasse_spatial::references::UmetaniYoshida1989) for the reduced dynamics.
pub fn computed_torque<T: Real, const J: usize>(
    robot: &Robot<T, J>,
    law: ArmLaw,
    tuning: &Tuning<T>,
    sensed: &State<T, J>,
    now: &[SetPoint<T>; J],
    acceleration: &[T; J],
) -> [T; J] {
    T::apart(Torque { robot, law, tuning, sensed, now, acceleration })
}

/// Acceleration of each joint that its loop asks for (rad/s², m/s²): `2ζω ė + ω² e`.
#[inline(always)]
pub(crate) fn joint_feedback<T: Real, const J: usize>(
    robot: &Robot<T, J>,
    tuning: &Tuning<T>,
    sensed: &State<T, J>,
    now: &[SetPoint<T>; J],
) -> [T; J] {
    let stiffness = tuning.joint_bandwidth * tuning.joint_bandwidth;
    let damping = T::from_f64(2.0) * tuning.joint_damping * tuning.joint_bandwidth;
    let mut back = [T::zero(); J];
    for j in robot.joints() {
        back[j] =
            damping * (now[j].rate - sensed.v[j]) + stiffness * (now[j].position - sensed.q[j]);
    }
    back
}

/// The torques as a piece of work.
struct Torque<'a, T, const J: usize> {
    robot: &'a Robot<T, J>,
    law: ArmLaw,
    tuning: &'a Tuning<T>,
    sensed: &'a State<T, J>,
    now: &'a [SetPoint<T>; J],
    acceleration: &'a [T; J],
}

impl<T: Real, const J: usize> Work for Torque<'_, T, J> {
    type Out = [T; J];
    #[inline(always)]
    fn run(self) -> [T; J] {
        let Self { robot, law, tuning, sensed, now, acceleration } = self;
        let back = joint_feedback(robot, tuning, sensed, now);
        let mut joints = *now;
        for j in robot.joints() {
            let (position, rate) = (sensed.q[j], sensed.v[j]);
            joints[j] = SetPoint { position, rate, acceleration: acceleration[j] + back[j] };
        }
        match law {
            ArmLaw::Terrestrial => Swing::new(robot, &joints).effort(robot, Vec3::zero()),
            ArmLaw::AttitudeHeld => {
                // Where a base that does not turn goes has no part in it, only that it gives way.
                let swing = Swing::new(robot, &joints);
                swing.effort(robot, swing.base.F.force * (-T::one() / swing.base.mass))
            }
            ArmLaw::FreeFloating => on_floating_base(robot, &sensed.V_NB_B, &joints),
        }
    }
}

/// The forces of the motion on a base that moves on steadily, and those of its recoil.
#[inline(always)]
fn on_floating_base<T: Real, const J: usize>(
    robot: &Robot<T, J>,
    V_NB_B: &SpatialVelocity<T>,
    joints: &[SetPoint<T>; J],
) -> [T; J] {
    let posture = Posture::new(robot, &joints.map(|s| s.position));
    let matter = posture.matter(robot);
    let (qdot, qddot) = (joints.map(|s| s.rate), joints.map(|s| s.acceleration));
    let mut F = posture.forces(robot, &matter, V_NB_B, &qdot, &qddot);
    let A_NB_B = recoil(ArmLaw::FreeFloating, &matter.whole, &on_base(robot, V_NB_B, &F));
    let mut effort = [T::zero(); J];
    for j in robot.joints().rev() {
        // Tip to base: the recoil's part, what the motor feels, and all of it to the parent.
        let carried = F[j] + matter.links[j] * A_NB_B;
        effort[j] = posture.S[j].power(&carried);
        if let BodyId::Link(p) = robot.joint(j).parent
            && p < J
        {
            F[p] += carried;
        }
    }
    effort
}
