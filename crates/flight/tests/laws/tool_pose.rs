//! Joint positions for a tool pose: where the tool then is, with the arm angle kept, within travel.

use super::postures::{Arm, J, LAWS};
use wrasse_dynamics::{State, kinematics};
use wrasse_flight::inverse_kinematics::SphericalRevoluteSpherical;
use wrasse_flight::{ArmLaw, Axes, joints_for_tool};
use wrasse_hardware::JointLimits;
use wrasse_spatial::{Pose, Vec3};
use wrasse_testing::arms::difference;
use wrasse_testing::random_robot::Random;
use wrasse_testing::{Worst, larger};

const FREE: [JointLimits<f64>; J] = [JointLimits { travel: None, rate: None, effort: None }; J];

/// An arm somewhere, and the pose that its tool has in another posture: the joints are moved there
/// with the base fixed, or with attitude and centre of mass held, as the law takes them.
struct Task {
    arm: Arm,
    state: State<f64, J>,
    law: ArmLaw,
}

impl Task {
    fn all() -> impl Iterator<Item = Self> {
        let mut random = Random(14);
        Arm::three().into_iter().flat_map(move |arm| {
            let belief = arm.belief(&mut random);
            let state = State { X_NB: belief.X_NB, q: belief.q, ..State::default() };
            LAWS.map(|law| Self { arm, state, law })
        })
    }
    /// Pose of the tool with these joints, the base as the law says.
    fn tool_at(&self, q: &[f64; J]) -> Pose<f64> {
        let moved = State { q: *q, ..self.state };
        let (from, to) =
            (kinematics(&self.arm.robot, &self.state), kinematics(&self.arm.robot, &moved));
        let recoil = match self.law {
            ArmLaw::Terrestrial => Vec3::zero(),
            _ => from.centre_of_mass().1 - to.centre_of_mass().1,
        };
        let X = to.pose(&self.arm.tool);
        Pose::new(X.rotation, X.translation + recoil)
    }
    fn nearby(&self) -> [f64; J] {
        let mut q = self.state.q;
        (0..7).for_each(|i| q[self.arm.own(i)] += 0.1 - 0.03 * i as f64);
        q
    }
    fn solve(&self, X: &Pose<f64>, limits: &[JointLimits<f64>; J]) -> Option<[f64; J]> {
        let Arm { robot, tool } = &self.arm;
        joints_for_tool(robot, tool, &self.state, X, Axes::Inertial, self.law, limits).ok()
    }
    /// Angle of the elbow about the line from shoulder to wrist (rad), as the law sees the arm.
    fn arm_angle(&self, q: &[f64; J]) -> f64 {
        let Arm { robot, tool } = &self.arm;
        let arm = match self.law {
            ArmLaw::Terrestrial => SphericalRevoluteSpherical::fixed_base(robot, tool),
            _ => SphericalRevoluteSpherical::attitude_held(robot, tool, q),
        };
        let arm = arm.unwrap();
        arm.arm_angle(&arm.positions(q)).0
    }
}

/// Measured 1.4e-15 (m, rad) for the tool and 8.9e-16 rad for the arm angle.
#[test]
fn the_tool_gets_there_and_the_arm_keeps_its_angle() {
    let (mut off, mut turned) = (Worst::none(), Worst::none());
    for task in Task::all() {
        let X = task.tool_at(&task.nearby());
        let q = task.solve(&X, &FREE).unwrap();
        let (m, rad) = difference(&task.tool_at(&q), &X);
        off.see(larger(m, rad));
        turned.see((task.arm_angle(&q) - task.arm_angle(&task.state.q)).abs());
    }
    off.is_below(1e-14);
    turned.is_below(1e-14);
}

/// The nearest solution is left out where it passes a travel; what comes instead keeps it.
/// Measured 1.6e-15 (m, rad) off.
#[test]
fn no_joint_leaves_its_travel() {
    let mut off = Worst::none();
    for task in Task::all() {
        let X = task.tool_at(&task.nearby());
        let free = task.solve(&X, &FREE).unwrap();
        // A wall in the way of the first of the arm's joints.
        let j = task.arm.own(0);
        let (at, to) = (task.state.q[j], free[j]);
        let wall = 0.5 * (at + to);
        let mut limits = FREE;
        limits[j].travel = Some(if to > at { (-7.0, wall) } else { (wall, 7.0) });
        let (low, high) = limits[j].travel.unwrap();
        let q = task.solve(&X, &limits).unwrap();
        assert!((low..=high).contains(&q[j]), "{} from {low} to {high}", q[j]);
        let (m, rad) = difference(&task.tool_at(&q), &X);
        off.see(larger(m, rad));
    }
    off.is_below(1e-14);
}
