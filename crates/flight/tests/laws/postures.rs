//! Arms in random postures, beliefs about the vehicles that carry them, and what is asked of them.

use wrasse_dynamics::{BodyId, Frame, MassProperties, Robot};
use wrasse_flight::{ArmLaw, Assignment, Axes, Belief, JointUse, Task};
use wrasse_spatial::{SpatialMomentum, SpatialVelocity, vec3};
use wrasse_testing::arms::{atlas_class, cube, two_arms, upright_arm};
use wrasse_testing::random_robot::Random;

/// Room for the joints of any of the arms.
pub(crate) const J: usize = 9;
pub(crate) const LAWS: [ArmLaw; 3] =
    [ArmLaw::Terrestrial, ArmLaw::AttitudeHeld, ArmLaw::FreeFloating];
const AXES: [Axes; 2] = [Axes::Inertial, Axes::Base];

/// A vehicle, and the tool at the end of the seven joints that come last.
#[derive(Clone, Copy)]
pub(crate) struct Arm {
    pub(crate) robot: Robot<f64, J>,
    pub(crate) tool: Frame<f64>,
}

impl Arm {
    fn new<const K: usize>((robot, tool): (Robot<f64, K>, Frame<f64>)) -> Self {
        let matter = |body| MassProperties {
            M_F_F: *robot.inertia(body),
            I_parts_F: *robot.inertia_of_parts(body),
        };
        let links: Vec<_> =
            robot.joints().map(|j| (*robot.joint(j), matter(BodyId::Link(j)))).collect();
        Self { robot: Robot::new(matter(BodyId::Base), &links).unwrap(), tool }
    }
    /// The ATLAS-class arm with this load (kg) in its grip, a little beside the axis.
    pub(crate) fn laden(mass: f64) -> Self {
        let (robot, tool) = atlas_class();
        Self::new((robot.with_payload(&tool, &cube(mass, vec3(0.0, 0.1, -0.2))), tool))
    }
    /// ATLAS-class with a load, an oblique arm on a light base, and an arm beside another.
    pub(crate) fn three() -> Vec<Self> {
        vec![Self::laden(200.0), Self::new(upright_arm(0.05)), Self::new(two_arms())]
    }
    /// The number of the joint `i` of those that carry the tool.
    pub(crate) fn own(&self, i: usize) -> usize {
        self.robot.joint_count() - 7 + i
    }
    /// Somewhere, with momentum, in a posture with shoulder, elbow and wrist bent by 0.4 rad or more.
    pub(crate) fn belief(&self, random: &mut Random) -> Belief<f64, J> {
        let mut q = [0.0; J];
        self.robot.joints().for_each(|j| q[j] = random.within(2.5));
        for j in [1, 3, 5].map(|i| self.own(i)) {
            let bend = random.between(0.4, 2.4);
            q[j] = if q[j] < 0.0 { -bend } else { bend };
        }
        let h_Scm_N = SpatialMomentum::new(random.vector(20.0), random.vector(30.0));
        Belief { X_NB: random.pose(3.0), q, h_Scm_N }
    }
    /// The tool's whole pose, by a law, in these axes.
    pub(crate) fn assignment(&self, law: ArmLaw, axes: Axes) -> Assignment<f64> {
        Assignment { tool: self.tool, axes, task: Task::Pose, law, damped_below: 1e-4 }
    }
}

/// What is asked of an arm, and when.
#[derive(Clone, Copy)]
pub(crate) struct Case {
    pub(crate) arm: Arm,
    pub(crate) to: Assignment<f64>,
    pub(crate) belief: Belief<f64, J>,
    /// Twist that is wanted of the tool.
    pub(crate) V_NE: SpatialVelocity<f64>,
}

impl Case {
    /// Each arm in 40 postures by each law in each axes.
    pub(crate) fn all() -> impl Iterator<Item = Self> {
        let mut random = Random(20_040_901);
        let mut cases = Vec::new();
        for arm in Arm::three() {
            for _ in 0..40 {
                let (belief, V_NE) = (arm.belief(&mut random), random.twist(0.1));
                let ways = LAWS.iter().flat_map(|&law| AXES.map(|axes| (law, axes)));
                cases.extend(ways.map(|(law, axes)| {
                    let to = arm.assignment(law, axes);
                    Self { arm, to, belief, V_NE }
                }));
            }
        }
        cases.into_iter()
    }
}

/// Joint rates of least norm, without limits.
pub(crate) fn free_use() -> JointUse<f64, J> {
    JointUse { gain: 0.0, gain_rate: 0.0, posture: [0.0; J], rate_limit: [f64::MAX; J] }
}
