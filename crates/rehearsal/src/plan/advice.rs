//! What would help where a way cannot be gone. Every piece of advice is planned before it is given: the
//! phase is gone through with the very numbers that are told.

use crate::case::{Case, StepCase};
use crate::outcome::End;
use crate::plan::other_postures::other_postures;
use crate::plan::{Plan, plan_through};
use wrasse_flight::{Axes, Held, JointTarget, Phase, Target, Task, Timing};
use wrasse_spatial::{Pose, Vec3};
use wrasse_vehicle::JOINTS;

/// Control periods that may be planned in search of advice: some seconds of a processor.
const PERIODS: u64 = 400_000;
/// Halvings of the way that is left out, and the finest step that is told (m).
const HALVINGS: u32 = 6;
const FINEST: f64 = 1e-3;
/// A way shorter than this share of the one that is wanted is no help.
const SHORTEST: f64 = 0.05;
/// Factors by which a phase is slowed down.
const SLOWER: [f64; 5] = [1.25, 1.5, 2.0, 4.0, 8.0];
/// Other postures that are planned: eight branches at eight arm angles. One that does not help is soon
/// done with.
const POSTURES: usize = 64;

/// A search for what helps.
struct Search<'a> {
    case: &'a Case,
    /// The phase that cannot be gone.
    phase: usize,
    /// Pose of the tool as it begins: in inertial axes, and in those of the base.
    tool: [Pose<f64>; 2],
    left: u64,
}

/// What lets the phase in which a plan is blocked be gone, a sentence for each; none where the reason is
/// no way of the tool, or where nothing that is tried helps.
pub(crate) fn advice(case: &Case, plan: &Plan) -> Vec<String> {
    let Some(End::Infeasible { phase, .. }) = &plan.blocked else { return vec![] };
    let Some(phase) = case.phases.iter().position(|p| p.name == *phase) else { return vec![] };
    let mut search = Search { case, phase, tool: plan.tool, left: PERIODS };
    let all = [
        search.nearer(),
        search.less_turn(),
        search.slower(),
        search.position_alone(),
        search.other_posture(),
    ];
    all.into_iter().flatten().collect()
}

/// A reason with what would help.
pub(crate) fn with_advice(reason: &str, advice: &[String]) -> String {
    if advice.is_empty() {
        return reason.to_owned();
    }
    format!("{reason}; planned, and it can be gone: with {}", advice.join("; or with "))
}

impl Search<'_> {
    /// Whether a case comes through the phase; not if too much was planned already.
    fn passes(&mut self, case: &Case) -> bool {
        if self.left == 0 {
            return false;
        }
        let plan = plan_through(case, self.phase);
        self.left = self.left.saturating_sub(plan.periods.max(1));
        plan.blocked.is_none()
    }

    /// The case with another phase in place of the one that cannot be gone.
    fn with(&self, phase: &Phase<f64, JOINTS>) -> Case {
        let mut case = self.case.clone();
        case.phases[self.phase].set_motion(phase);
        case
    }

    /// What the first arm does in the phase that cannot be gone.
    fn motion(&self) -> Phase<f64, JOINTS> {
        let nothing = Phase::Hold { what: Held::Joints, duration: 0.0 };
        self.case.phases[self.phase].motion().copied().unwrap_or(nothing)
    }

    /// How much of the way can be gone.
    fn nearer(&mut self) -> Option<String> {
        let way = self.way()?;
        let whole = way.norm();
        let near = self.share(|search, share| search.shortened(way * share));
        // As it is told: whole millimetres, and a tenth of that for the components.
        let length = (near * whole / FINEST).floor() * FINEST;
        let told = (way * (length / whole)).to_array().map(|x| (x * 1e4).round() / 1e4);
        let shorter = self.shortened(Vec3::from_array(told))?;
        if length < SHORTEST * whole || !self.passes(&self.with(&shorter)) {
            return None;
        }
        let by = (whole - length) * 1e3;
        Some(match shorter {
            Phase::MoveTool { target: Target::By { .. }, .. } => {
                format!("by_m = {told:?}, {by:.0} mm less")
            }
            Phase::MoveTool { target: Target::To(X), .. } => {
                format!("to_position_m = {:?}, {by:.0} mm nearer", rounded(X.translation))
            }
            Phase::MoveJoints { to: JointTarget::Tool(X, _), .. } => {
                format!("position_m = {:?}, {by:.0} mm nearer", rounded(X.translation))
            }
            _ => return None,
        })
    }

    /// How much of a turn in place can be gone.
    fn less_turn(&mut self) -> Option<String> {
        let Phase::MoveTool { target: Target::By { displacement, turn }, axes, timing } =
            self.motion()
        else {
            return None;
        };
        if displacement.norm() > 2.0 * FINEST || turn.norm() == 0.0 {
            return None;
        }
        let by = |turn| {
            let target = Target::By { displacement, turn };
            Phase::MoveTool { target, axes, timing }
        };
        let near = self.share(|_, share| Some(by(turn * share)));
        // As it is told: whole degrees, and hundredths for the components.
        let whole = turn.norm().to_degrees();
        let angle = (near * whole).floor();
        let told = (turn * (angle / whole)).to_array().map(|x| two_digits(x.to_degrees()));
        let less = by(Vec3::from_array(told.map(f64::to_radians)));
        let helps = angle >= SHORTEST * whole && self.passes(&self.with(&less));
        helps.then(|| format!("turn_by_deg = {told:?}, {:.0} deg less", whole - angle))
    }

    /// The largest share (–) of what a phase asks that can be gone, by halving.
    fn share(&mut self, part: impl Fn(&Self, f64) -> Option<Phase<f64, JOINTS>>) -> f64 {
        let (mut near, mut far) = (0.0, 1.0);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (near + far);
            let phase = part(self, middle);
            if phase.is_some_and(|phase| self.passes(&self.with(&phase))) {
                near = middle;
            } else {
                far = middle;
            }
        }
        near
    }

    /// The way of the tool in the phase, in its axes (m), if it is one that can be shortened.
    fn way(&self) -> Option<Vec3<f64>> {
        let from = |axes| match axes {
            Axes::Inertial => self.tool[0].translation,
            Axes::Base => self.tool[1].translation,
        };
        let way = match self.motion() {
            Phase::MoveTool { target: Target::By { displacement, .. }, .. } => displacement,
            Phase::MoveTool { target: Target::To(X), axes, .. }
            | Phase::MoveJoints { to: JointTarget::Tool(X, axes), .. } => {
                X.translation - from(axes)
            }
            _ => return None,
        };
        (way.norm() > 2.0 * FINEST).then_some(way)
    }

    /// The phase with this way of the tool (m), and its attitude as it is wanted.
    fn shortened(&self, way: Vec3<f64>) -> Option<Phase<f64, JOINTS>> {
        let at = |axes| {
            let from = match axes {
                Axes::Inertial => self.tool[0].translation,
                Axes::Base => self.tool[1].translation,
            };
            Vec3::from_array(rounded(from + way))
        };
        Some(match self.motion() {
            Phase::MoveTool { target: Target::By { turn, .. }, axes, timing } => {
                Phase::MoveTool { target: Target::By { displacement: way, turn }, axes, timing }
            }
            Phase::MoveTool { target: Target::To(X), axes, timing } => {
                let target = Target::To(Pose::new(X.rotation, at(axes)));
                Phase::MoveTool { target, axes, timing }
            }
            Phase::MoveJoints { to: JointTarget::Tool(X, axes), timing } => {
                let to = JointTarget::Tool(Pose::new(X.rotation, at(axes)), axes);
                Phase::MoveJoints { to, timing }
            }
            _ => return None,
        })
    }

    /// The same way in more time.
    fn slower(&mut self) -> Option<String> {
        let Phase::MoveTool { target, axes, timing: Timing::Duration(duration) } = self.motion()
        else {
            return None;
        };
        SLOWER.into_iter().find_map(|factor| {
            let longer = (duration * factor * 10.0).ceil() / 10.0;
            let timing = Timing::Duration(longer);
            let slow = self.with(&Phase::MoveTool { target, axes, timing });
            self.passes(&slow).then(|| format!("duration_s = {longer:?}"))
        })
    }

    /// The tool's attitude left free.
    fn position_alone(&mut self) -> Option<String> {
        let moves = matches!(self.motion(), Phase::MoveTool { .. });
        if !moves || self.case.setup.assignment.task == Task::Position {
            return None;
        }
        let mut case = self.case.clone();
        case.setup.assignment.task = Task::Position;
        case.phases.iter_mut().for_each(leave_attitude_free);
        let helps = self.passes(&case);
        helps.then(|| "control.task = \"position\", which leaves the tool's attitude free".into())
    }

    /// The tool where it is at the start, and the arm bent otherwise.
    fn other_posture(&mut self) -> Option<String> {
        let postures = other_postures(self.case);
        postures.into_iter().take(POSTURES).find_map(|q| {
            let mut case = self.case.clone();
            case.start.q = q;
            self.passes(&case)
                .then(|| format!("another posture of the same arm, {}", self.told(&q)))
        })
    }

    /// Joint positions as a mission file has them.
    fn told(&self, q: &[f64; JOINTS]) -> String {
        let joints = || self.case.vehicle.robot.joints();
        let each = |turning: bool| {
            let of_kind = joints().filter(move |j| self.case.turns(*j) == turning);
            let named = of_kind.map(|j| {
                let x = if turning { two_digits(q[j].to_degrees()) } else { q[j] };
                format!("{} = {x:?}", self.case.joint_name(j))
            });
            named.collect::<Vec<_>>().join(", ")
        };
        let tables = [("joints_deg", each(true)), ("joints_m", each(false))];
        let there = tables.into_iter().filter(|(_, list)| !list.is_empty());
        let told: Vec<_> =
            there.map(|(key, list)| format!("initial.{key} = {{ {list} }}")).collect();
        told.join(" and ")
    }
}

fn two_digits(x: f64) -> f64 {
    (x * 100.0).round() / 100.0
}

/// To a tenth of a millimetre (m).
fn rounded(v: Vec3<f64>) -> [f64; 3] {
    v.to_array().map(|x| (x * 1e4).round() / 1e4)
}

/// The tools of a step need not be turned in any way.
fn leave_attitude_free(step: &mut StepCase) {
    for task in step.step.tasks.iter_mut().flatten() {
        if let Some(assignment) = &mut task.assignment {
            assignment.task = Task::Position;
        }
    }
}
