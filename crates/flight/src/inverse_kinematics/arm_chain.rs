//! An arm of seven revolute joints as the closed form sees it: axes, and the vectors between them.

use core::fmt;
use wrasse_dynamics::{BodyId, Frame, JointKind, Robot, State, barycentric_vectors, kinematics};
use wrasse_spatial::{Mat3, Real, Scalar, Vec3};

/// Seven revolute joints from an anchor A to the tool E, in its zero posture and in base axes.
///
/// The tool is at `p_AE = vectors[0] + Σ R_i vectors[i]`, `R_i` the turn of link i since zero.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ArmChain<T> {
    /// The robot's numbers of the joints, base to tool.
    pub joints: [usize; 7],
    /// Unit axes (–).
    pub axes: [Vec3<T>; 7],
    /// From the anchor to joint 1, from each joint to the next, from joint 7 to the tool (m).
    pub vectors: [Vec3<T>; 8],
    /// `R_BE` in the zero posture.
    pub R_BE0: Mat3<T>,
}

/// Why an arm has no closed form here.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum NotThisKind<T> {
    /// Not seven joints between base and tool.
    JointCount {
        /// Joints on the way.
        found: usize,
    },
    /// A joint on the way slides.
    Slides {
        /// The robot's number of the joint.
        joint: usize,
    },
    /// Two neighbouring axes of the shoulder or the wrist are not at right angles.
    NotPerpendicular {
        /// The robot's numbers of the joints.
        joints: [usize; 2],
        /// Cosine of the angle between their axes (–); zero was expected.
        cosine: T,
    },
    /// Three axes of the shoulder or the wrist do not meet in one point.
    AxesDoNotMeet {
        /// The robot's numbers of the joints.
        joints: [usize; 3],
        /// How far they pass each other (m).
        gap: T,
    },
    /// The shoulder or the wrist lies on the elbow's axis, so that the elbow does not change
    /// their distance.
    NoElbow {
        /// Distance of the shoulder from the axis (m).
        upper: T,
        /// Distance of the wrist from the axis (m).
        fore: T,
    },
}

impl<T: Scalar> fmt::Display for NotThisKind<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::JointCount { found } => {
                write!(f, "{found} joints between base and tool, the closed form expects 7")
            }
            Self::Slides { joint } => {
                write!(f, "joint {joint} slides, the closed form expects revolute joints")
            }
            Self::NotPerpendicular { joints: [a, b], cosine } => write!(
                f,
                "the axes of joints {a} and {b} are not at right angles: cosine {}, expected 0",
                cosine.to_f64()
            ),
            Self::AxesDoNotMeet { joints: [a, b, c], gap } => write!(
                f,
                "the axes of joints {a}, {b} and {c} miss each other by {} m, expected to meet",
                gap.to_f64()
            ),
            Self::NoElbow { upper, fore } => write!(
                f,
                "shoulder and wrist are {} m and {} m from the elbow's axis, expected more than 0",
                upper.to_f64(),
                fore.to_f64()
            ),
        }
    }
}
impl<T: Scalar> core::error::Error for NotThisKind<T> {}

impl<T: Scalar> ArmChain<T> {
    /// Anchored in the base frame: the vectors are the arm's own.
    ///
    /// # Errors
    /// If there are not seven revolute joints between base and tool.
    pub fn fixed_base<const J: usize>(
        robot: &Robot<T, J>,
        tool: &Frame<T>,
    ) -> Result<Self, NotThisKind<T>> {
        let ZeroPosture { joints, R_B0 } = zero_posture(robot, tool)?;
        let mut vectors = [Vec3::zero(); 8];
        for i in 0..7 {
            vectors[i] = R_B0[i] * robot.joint(joints[i]).X_PB_zero.translation;
        }
        vectors[7] = R_B0[7] * tool.X_BF.translation;
        Ok(Self::new(robot, tool, joints, &R_B0, vectors))
    }
    /// Anchored in the system's centre of mass, with axes parallel to the base's: the vectors are
    /// the barycentric ones. Joints of other arms, whose masses count, stay at `q` (rad or m).
    ///
    /// # Errors
    /// If there are not seven revolute joints between base and tool.
    ///
    /// # Source
    /// [`Ellery2004`](wrasse_spatial::references::Ellery2004) eqs (6)–(7), with `R0` before `s0`;
    /// [`VafaDubowsky1990`](wrasse_spatial::references::VafaDubowsky1990).
    #[doc(alias = "virtual manipulator")]
    pub fn attitude_held<const J: usize>(
        robot: &Robot<T, J>,
        tool: &Frame<T>,
        q: &[T; J],
    ) -> Result<Self, NotThisKind<T>> {
        let ZeroPosture { joints, R_B0 } = zero_posture(robot, tool)?;
        let state = State { q: *q, ..State::default() };
        let k = kinematics(robot, &state);
        let lambda = barycentric_vectors(&k, tool);
        let mut vectors = [Vec3::zero(); 8];
        for body in robot.bodies() {
            // A body off the way stands still on the one from which its branch leaves.
            let (i, carrier) = place_on_way(robot, &joints, body);
            let R_carrier = k.X_NB(carrier).rotation.transpose() * k.X_NB(body).rotation;
            vectors[i] += R_B0[i] * (R_carrier * lambda[body]);
        }
        Ok(Self::new(robot, tool, joints, &R_B0, vectors))
    }
    fn new<const J: usize>(
        robot: &Robot<T, J>,
        tool: &Frame<T>,
        joints: [usize; 7],
        R_B0: &[Mat3<T>; 8],
        vectors: [Vec3<T>; 8],
    ) -> Self {
        let axes = core::array::from_fn(|i| R_B0[i + 1] * robot.joint(joints[i]).axis_B);
        Self { joints, axes, vectors, R_BE0: R_B0[7] * tool.X_BF.rotation }
    }
}

/// The arm with all its joints at zero.
struct ZeroPosture<T> {
    /// The robot's numbers of the joints, base to tool.
    joints: [usize; 7],
    /// Orientation of the base, then of each link.
    R_B0: [Mat3<T>; 8],
}

/// The seven joints between base and tool, and how they stand at zero.
fn zero_posture<T: Real, const J: usize>(
    robot: &Robot<T, J>,
    tool: &Frame<T>,
) -> Result<ZeroPosture<T>, NotThisKind<T>> {
    let found = robot.path_to_base(tool.body).count();
    if found != 7 {
        return Err(NotThisKind::JointCount { found });
    }
    let mut joints = [0; 7];
    for (slot, j) in joints.iter_mut().rev().zip(robot.path_to_base(tool.body)) {
        *slot = j;
    }
    let mut R_B0 = [Mat3::identity(); 8];
    for (i, &j) in joints.iter().enumerate() {
        let joint = robot.joint(j);
        if joint.kind != JointKind::Revolute {
            return Err(NotThisKind::Slides { joint: j });
        }
        R_B0[i + 1] = R_B0[i] * joint.X_PB_zero.rotation;
    }
    Ok(ZeroPosture { joints, R_B0 })
}

/// Which body of the way carries `body`: its place on the way (0 for the base), and itself.
fn place_on_way<T: Real, const J: usize>(
    robot: &Robot<T, J>,
    joints: &[usize; 7],
    body: BodyId,
) -> (usize, BodyId) {
    let on_way = |j: usize| joints.iter().position(|&way| way == j).map(|i| (i + 1, j));
    let first = robot.path_to_base(body).find_map(on_way);
    first.map_or((0, BodyId::Base), |(i, j)| (i, BodyId::Link(j)))
}
