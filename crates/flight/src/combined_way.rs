//! The way of all joints where several arms work at once, each on its own reference.

use crate::control_period::{ArmReference, PeriodMemory};
use crate::executive::Executive;
use crate::resolved_motion::Assignment;
use crate::setup::Setup;
use crate::several_arms::{JointMotion, JointRole, ToolTask, motion_of_several_arms};
use crate::step::ARMS;
use crate::trajectory::JointSetPoint;
use wrasse_dynamics::{Configuration, Robot};
use wrasse_spatial::Scalar;

/// Where joints are sent that go a way of their own, and how each comes to its rate.
struct Roles<T, const J: usize> {
    q: [T; J],
    each: [JointRole<T>; J],
}

impl<T: Scalar, const J: usize> Executive<T, J> {
    /// The way of all joints at the end of the period, from the references of the arms and of the joints
    /// that belong to none; and the share of their rates that the rate limits leave (–).
    pub(crate) fn combined(
        &mut self,
        (robot, setup): (&Robot<T, J>, &Setup<T, J>),
        memory: &PeriodMemory<T, J>,
        references: &[ArmReference<T, J>; ARMS + 1],
    ) -> (JointSetPoint<T, J>, T) {
        let period = setup.tuning.period;
        let roles = self.roles(memory, references);
        let mut ahead = memory.predicted(robot, period);
        for j in robot.joints() {
            if let JointRole::Given { .. } = roles.each[j] {
                ahead.q[j] = roles.q[j];
            }
        }
        let configuration = Configuration::at(robot, &ahead.q);
        let mut tasks = [None; ARMS];
        for ((arm, reference), task) in self.arms.iter_mut().zip(references).zip(&mut tasks) {
            arm.reference = None;
            let ArmReference::Tool { reference, axes, .. } = reference else { continue };
            if !arm.works {
                continue;
            }
            arm.reference = Some((*reference, *axes));
            let to = Assignment { axes: *axes, ..arm.assignment };
            let X_BE = configuration.posture.pose(robot, &to.tool);
            let wanted = memory.wanted_motion(&ahead.X_NB, setup, (reference, *axes), &X_BE);
            *task = Some(ToolTask { to, wanted });
        }
        let joints = &setup.joints;
        let found =
            motion_of_several_arms(robot, &configuration, &ahead, &tasks, &roles.each, joints);
        match found {
            None => (given(&roles), T::one()),
            Some(motion) => (way(robot, memory, &roles, &motion, period), motion.share),
        }
    }

    /// Which joints serve the tools, and where the others are sent.
    fn roles(
        &self,
        memory: &PeriodMemory<T, J>,
        references: &[ArmReference<T, J>; ARMS + 1],
    ) -> Roles<T, J> {
        let zero = T::zero();
        let still = JointRole::Given { rate: zero, acceleration: zero };
        let mut roles = Roles { q: memory.now.map(|now| now.position), each: [still; J] };
        let all = self.arms.iter().chain([&self.others]);
        for (arm, reference) in all.zip(references).filter(|(arm, _)| arm.works) {
            for j in (0..J).filter(|&j| arm.joints[j]) {
                match reference {
                    ArmReference::Tool { gain, gain_rate, .. } => {
                        roles.each[j] = JointRole::Free { gain: *gain, gain_rate: *gain_rate };
                    }
                    ArmReference::Joints(at) => {
                        roles.q[j] = at.q[j];
                        roles.each[j] =
                            JointRole::Given { rate: at.v[j], acceleration: at.vdot[j] };
                    }
                    // Nothing else is a task beside another.
                    ArmReference::Rates { .. } | ArmReference::Still | ArmReference::Coast => {}
                }
            }
        }
        roles
    }
}

/// Joints that are all sent a way of their own.
fn given<T: Scalar, const J: usize>(roles: &Roles<T, J>) -> JointSetPoint<T, J> {
    let mut way = JointSetPoint::at_rest(roles.q);
    for (j, role) in roles.each.iter().enumerate() {
        if let JointRole::Given { rate, acceleration } = role {
            (way.v[j], way.vdot[j]) = (*rate, *acceleration);
        }
    }
    way
}

/// The way with the joints that serve the tools, of fourth order: as for one arm.
fn way<T: Scalar, const J: usize>(
    robot: &Robot<T, J>,
    memory: &PeriodMemory<T, J>,
    roles: &Roles<T, J>,
    motion: &JointMotion<T, J>,
    period: T,
) -> JointSetPoint<T, J> {
    let (from, began) = (&memory.belief, &memory.motion);
    let (half, twelfth) = (T::from_f64(0.5), T::from_f64(1.0 / 12.0) * period);
    let mut way = JointSetPoint { q: roles.q, v: motion.qdot, vdot: motion.qddot };
    for j in robot.joints() {
        if let JointRole::Free { .. } = roles.each[j] {
            let mean = (began.rate.qdot[j] + motion.qdot[j]) * half
                + (began.qddot[j] - motion.qddot[j]) * twelfth;
            way.q[j] = from.q[j] + mean * period;
        }
    }
    way
}
