//! What others may ask the flight computer: what it believes, and how it judges its way.

use crate::computer::FlightComputer;
use crate::interface::Axes;
use crate::law::Task;
use crate::navigation::Navigation;
use crate::phase::{Held, Path};
use crate::resolved_motion::{Assignment, task_jacobian_in};
use crate::tool_pose::{Unreachable, joints_for_tool, wrist_too_far};
use wrasse_dynamics::{Configuration, Frame, Robot, State, configure};
use wrasse_spatial::{Pose, Quat, Scalar, SpatialVelocity};

/// An arm at work.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ArmAtWork<T> {
    /// Its tool.
    pub tool: Frame<T>,
    /// Which part of the tool's motion counts.
    pub task: Task,
    /// Whether its tool is on a way, or kept in its place.
    pub follows_tool: bool,
    /// Where the tool should be at the end of the period, and the axes of that; `None` where the joints
    /// are guided.
    pub reference: Option<(Pose<T>, Axes)>,
}

impl<T: Scalar, const J: usize> FlightComputer<T, J> {
    /// What the navigation makes of gyro and star tracker, if it has them.
    pub fn navigation(&self) -> &Navigation<T, J> {
        &self.navigation
    }

    /// Where the law believes the vehicle to be, and how it moves.
    pub fn believed_state(&self) -> State<T, J> {
        self.memory.believed_state()
    }

    /// The robot as the laws know it.
    pub fn robot(&self) -> &Robot<T, J> {
        &self.robot
    }

    /// The tool frame that is guided.
    pub fn tool(&self) -> &Frame<T> {
        &self.setup.assignment.tool
    }

    /// Which part of the tool's motion counts.
    pub fn task(&self) -> Task {
        self.setup.assignment.task
    }

    /// How far the law believes the tool to be from its reference: distance (m) and angle (rad).
    pub fn believed_tool_error(&self) -> (T, T) {
        let (X, wanted) = (self.believed_tool(self.memory.axes), self.memory.reference.X_NE);
        let turned = Quat::from_matrix(&(wanted.rotation * X.rotation.transpose())).log();
        ((wanted.translation - X.translation).norm(), turned.norm())
    }

    /// The law's Jacobian now: columns are the tool's twist per joint rate. `place` is for what its posture
    /// gives.
    pub fn task_jacobian(&self, place: &mut Configuration<T, J>) -> [SpatialVelocity<T>; J] {
        let to = Assignment { axes: self.memory.axes, ..self.setup.assignment };
        configure(&self.robot, &self.memory.belief.q, place);
        task_jacobian_in(&self.robot, &to, place, &self.memory.belief)
    }

    /// What is left of the line's end at the nearest joint positions that the law can find, if the
    /// end of the current line is out of reach. A floating base is taken as held here: where it ends
    /// depends on the way.
    pub fn end_out_of_reach(&self) -> Option<Unreachable<T>> {
        let Path::Line(line, axes) = self.executive.arms[0].guidance.path else { return None };
        let X = line.at(line.duration()).X_NE;
        let (tool, law) = (&self.setup.assignment.tool, self.setup.assignment.law);
        joints_for_tool(&self.robot, tool, &self.still(), &X, axes, law, &self.setup.limits).err()
    }

    /// Poses of the tool at the start of the current line, as far along it as it could be brought at the
    /// attitude that is wanted there, and at its end; if that is out of reach. Seen from here, and the
    /// base as above.
    pub fn reach_along_line(&self) -> Option<[Pose<T>; 3]> {
        let Path::Line(line, axes) = self.executive.arms[0].guidance.path else { return None };
        let (tool, law) = (&self.setup.assignment.tool, self.setup.assignment.law);
        let state = self.still();
        let is_reached = |t: T| {
            let X = line.at(t).X_NE;
            joints_for_tool(&self.robot, tool, &state, &X, axes, law, &self.setup.limits).is_ok()
        };
        let (mut near, mut far) = (T::zero(), line.duration());
        if is_reached(far) {
            return None;
        }
        // To a millionth of the duration.
        for _ in 0..20 {
            let middle = (near + far) * T::from_f64(0.5);
            if is_reached(middle) {
                near = middle;
            } else {
                far = middle;
            }
        }
        Some([T::zero(), near, line.duration()].map(|t| line.at(t).X_NE))
    }

    /// Distance of the wrist from the shoulder that the end of the line asks for at its attitude, and
    /// the largest that there is (m), where that is too far and the arm has a spherical shoulder and
    /// wrist. Where the base gives way both are lengths as they count from the common centre of mass.
    pub fn wrist_too_far(&self) -> Option<(T, T)> {
        let Path::Line(line, axes) = self.executive.arms[0].guidance.path else { return None };
        let X = line.at(line.duration()).X_NE;
        let (tool, law) = (&self.setup.assignment.tool, self.setup.assignment.law);
        wrist_too_far(&self.robot, tool, &self.still(), &X, axes, law)
    }

    /// The vehicle where it is believed to be, at rest.
    fn still(&self) -> State<T, J> {
        State { X_NB: self.memory.belief.X_NB, q: self.memory.belief.q, ..State::default() }
    }

    /// Whether the current phase moves the tool along a line.
    pub fn follows_tool(&self) -> bool {
        self.executive.arms[0].guidance.follows_tool()
    }

    /// Whether nothing is driven in the current phase.
    pub fn coasts(&self) -> bool {
        matches!(self.executive.arms[0].guidance.path, Path::Still(Held::Nothing))
    }

    /// Whether a fault of the current step leads to another step.
    pub fn handles_faults(&self) -> bool {
        self.executive.handles_faults()
    }

    /// The tool whose grip acts.
    pub fn gripping_tool(&self) -> &Frame<T> {
        &self.executive.gripping
    }

    /// The arms at work.
    pub fn arms(&self) -> impl Iterator<Item = ArmAtWork<T>> + '_ {
        self.executive.arms.iter().filter(|arm| arm.works).map(|arm| ArmAtWork {
            tool: arm.assignment.tool,
            task: arm.assignment.task,
            follows_tool: arm.guidance.follows_tool(),
            reference: arm.reference.map(|(motion, axes)| (motion.X_NE, axes)),
        })
    }

    /// Whether all steps are done, as far as that is known before the sensors are read again.
    pub fn done(&self) -> bool {
        self.executive.is_done(self.setup.tuning.period)
    }
}
