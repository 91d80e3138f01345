//! Motions of an arm, as the flight computer knows them.

use crate::allocation::ToolTask;
use crate::interface::{Axes, Grip};
use crate::trajectory::{
    BadNumbers, JointMove, MotionLimits, Profile, ProfileShape, Quintic, StraightLine, ToolWay,
};
use wrasse_spatial::{Pose, Scalar, Vec3};

/// What one arm does in a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Phase<T, const J: usize> {
    /// The tool goes on a straight line, turning on the geodesic.
    MoveTool {
        /// Where to.
        target: Target<T>,
        /// Axes of the target, and of the line.
        axes: Axes,
        /// How fast.
        timing: Timing<T>,
    },
    /// All joints go to a posture, starting and ending together.
    MoveJoints {
        /// Where to.
        to: JointTarget<T, J>,
        /// How fast; limits are those of each joint.
        timing: JointTiming<T, J>,
    },
    /// The reference stays.
    Hold {
        /// What stays.
        what: Held,
        /// For how long (s).
        duration: T,
    },
    /// The arm moves so that what pushes at the tool asks the base to store less, without turning it.
    UnloadByPosture {
        /// What of the tool must stay.
        task: ToolTask,
        /// Rate at which what can be lowered fades (1/s).
        gain: T,
        /// For how long (s).
        duration: T,
    },
    /// The grip takes or lets go of something at the end of one control period.
    Grip {
        /// What the grip does.
        action: Grip,
        /// What stays meanwhile.
        keep: Held,
    },
}

/// What a hold keeps.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Held {
    /// The joints stand still.
    Joints,
    /// The tool stays where its reference is.
    Tool,
    /// Nothing: the joints move on as they do, no actuator acts.
    Nothing,
}

/// Where a tool should go.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Target<T> {
    /// From where it is: displacement (m) and rotation vector (rad, of any number of turns), in the
    /// phase's axes.
    By {
        /// Displacement (m).
        displacement: Vec3<T>,
        /// Rotation vector (rad).
        turn: Vec3<T>,
    },
    /// To a pose in the phase's axes.
    To(Pose<T>),
}

/// Where the joints should go.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum JointTarget<T, const J: usize> {
    /// To positions (rad or m); joints without one stay.
    Positions([Option<T>; J]),
    /// By so much (rad or m) from where each is as the phase begins; joints without an amount stay.
    By([Option<T>; J]),
    /// To the positions that bring the tool to a pose in these axes.
    Tool(Pose<T>, Axes),
}

/// How fast a tool moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Timing<T> {
    /// A quintic of this duration (s).
    Duration(T),
    /// The shortest under limits of position (m) and turn (rad).
    Limits {
        /// Shape of the profile.
        shape: ProfileShape,
        /// Limits of the position.
        linear: MotionLimits<T>,
        /// Limits of the turn.
        angular: MotionLimits<T>,
    },
}

/// How fast the joints move.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum JointTiming<T, const J: usize> {
    /// A quintic of this duration (s).
    Duration(T),
    /// The shortest under limits of each joint.
    Limits {
        /// Shape of the profile.
        shape: ProfileShape,
        /// Limits of each joint.
        limits: [MotionLimits<T>; J],
    },
}

/// What is followed while a phase lasts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Path<T, const J: usize> {
    Line(StraightLine<T>, Axes),
    Joints(JointMove<T, J>),
    PostureUnloading { task: ToolTask, gain: T },
    Still(Held),
}

impl<T: Scalar> Target<T> {
    /// The way from `X`, both in the phase's axes.
    pub(crate) fn way_from(&self, X: &Pose<T>) -> ToolWay<T> {
        match *self {
            Self::To(pose) => ToolWay::between(X, &pose),
            Self::By { displacement, turn } => {
                ToolWay { displacement_N: displacement, turn_N: turn }
            }
        }
    }
}

impl<T: Scalar> Timing<T> {
    /// The line from a pose to a target.
    pub(crate) fn line(
        &self,
        from: Pose<T>,
        target: &Target<T>,
    ) -> Result<StraightLine<T>, BadNumbers> {
        let way = target.way_from(&from);
        match self {
            Self::Duration(duration) => {
                let profile = Profile::Quintic(Quintic::new(T::one(), *duration)?);
                StraightLine::along(from, &way, profile)
            }
            Self::Limits { shape, linear, angular } => {
                StraightLine::along_within(from, &way, *shape, linear, angular)
            }
        }
    }
}

impl<T: Scalar, const J: usize> JointTiming<T, J> {
    /// The way from one posture to another (rad or m).
    pub(crate) fn way(&self, from: [T; J], to: [T; J]) -> Result<JointMove<T, J>, BadNumbers> {
        match self {
            Self::Duration(duration) => {
                JointMove::new(from, to, Profile::Quintic(Quintic::new(T::one(), *duration)?))
            }
            Self::Limits { shape, limits } => JointMove::within(from, to, *shape, limits),
        }
    }
}
