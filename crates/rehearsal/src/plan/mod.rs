//! Planning: the whole mission is gone through in the laws' own belief before anything moves. A way
//! that cannot be gone is found here, with where and why it ends.

pub(crate) mod advice;
mod believed_plant;
mod other_postures;
pub(crate) mod step_cycles;
mod upper_bound;

use crate::case::Case;
use crate::outcome::{End, Event, PlanLine};
use crate::sampled_loops::{SampledLoop, joint_gain, joint_loop, sampled_loops};
use crate::signals::arm_shape::{reach_margin, smallest_singular_value};
use crate::signals::observe::tool_error;
use crate::simulation::{Observer, Simulation};
use believed_plant::{BelievedPlant, believed_flight};
use upper_bound::upper_bound;
use wrasse_dynamics::{Configuration, Kinematics, State, kinematics};
use wrasse_flight::{BadPhase, Command, FlightComputer, LONGEST, NoWay, Task};
use wrasse_spatial::{Pose, Quat, Vec3};
use wrasse_vehicle::JOINTS;

/// A tool that its own law believes this far from its reference has left the way (m, rad).
const OFF_THE_WAY: (f64, f64) = (5e-5, 5e-5);

/// Periods from one look at the joint loops to the next.
const LOOP_PERIODS: u64 = 50;

/// What the planning found.
#[derive(Debug, Clone)]
pub(crate) struct Plan {
    /// A line for each phase that was gone through.
    pub(crate) lines: Vec<PlanLine>,
    /// Control periods of the whole mission.
    pub(crate) periods: u64,
    /// Where and why the way ends.
    pub(crate) blocked: Option<End>,
    /// Pose of the tool as the last phase begins: in inertial axes, and in those of the base.
    pub(crate) tool: [Pose<f64>; 2],
    /// The longest that each step took (control periods); zero for one that was not gone through.
    pub(crate) longest: Vec<u64>,
}

/// What is noted of a phase while it is gone through.
#[derive(Debug, Clone, Copy)]
struct PhaseNotes {
    periods: u64,
    /// Where the reference began, and how far it has come (m).
    start: Option<Vec3<f64>>,
    way: f64,
    singular: f64,
    reach: f64,
    /// The joint that moves fastest, and how fast (rad/s or m/s).
    fastest: (usize, f64),
    /// How far the base has come (m), and how far it has turned (rad).
    base_shift: f64,
    base_turn: f64,
    /// Largest acceleration that joints get for one that their loops ask for (–).
    loop_gain: f64,
}

impl PhaseNotes {
    const NONE: Self = Self {
        periods: 0,
        start: None,
        way: 0.0,
        singular: f64::INFINITY,
        reach: f64::INFINITY,
        fastest: (0, 0.0),
        base_shift: 0.0,
        base_turn: 0.0,
        loop_gain: 0.0,
    };
}

/// Go through all steps.
pub(crate) fn plan(case: &Case) -> Plan {
    let mut plan = plan_through(case, usize::MAX);
    plan.lines.extend(upper_bound(case, &plan));
    plan
}

/// Go through the steps until this one has ended.
pub(crate) fn plan_through(case: &Case, last: usize) -> Plan {
    let mut flight = believed_flight(case);
    let mut planner = Planner::new(case, last, believed_tool(&flight));
    let mut blocked = None;
    while !flight.is_done() && flight.periods() < u64::from(LONGEST) && !planner.has_passed {
        let stop = flight.step(&mut planner).err();
        if planner.has_passed {
            break;
        }
        if let Some(reason) = planner.reason.take() {
            let (phase, time_s) = (case.phases[planner.phase].name.clone(), flight.time());
            blocked = Some(End::Infeasible { phase, time_s, reason });
            break;
        }
        if let Some(stop) = stop {
            planner.close(case);
            planner.tool = believed_tool(&flight);
            blocked = Some(infeasible(stop));
            break;
        }
    }
    let periods = flight.periods();
    if blocked.is_none() && !planner.has_passed {
        planner.close(case);
        blocked = (!flight.is_done()).then(|| infeasible(flight.too_long()));
    }
    let Planner { lines, tool, longest, .. } = planner;
    Plan { lines, periods, blocked, tool, longest }
}

/// What stops a flight in the planning: nothing has moved.
fn infeasible(stop: End) -> End {
    match stop {
        End::Stopped { phase, time_s, reason } => End::Infeasible { phase, time_s, reason },
        other => other,
    }
}

/// Looks at how near the arm comes to where it cannot go on.
struct Planner {
    lines: Vec<PlanLine>,
    phase: usize,
    notes: PhaseNotes,
    /// Pose of the tool as the phase begins: in inertial axes, and in those of the base.
    tool: [Pose<f64>; 2],
    /// Why the way cannot be gone on.
    reason: Option<String>,
    /// The step behind whose end nothing is of interest, and whether it has ended.
    last: usize,
    has_passed: bool,
    /// The longest that each step took (control periods).
    longest: Vec<u64>,
    /// A place for what a posture gives.
    place: Box<Configuration<f64, JOINTS>>,
}

impl Planner {
    fn new(case: &Case, last: usize, tool: [Pose<f64>; 2]) -> Self {
        Self {
            lines: loop_lines(case),
            phase: 0,
            notes: PhaseNotes::NONE,
            tool,
            reason: None,
            last,
            has_passed: false,
            longest: vec![0; case.phases.len()],
            place: Box::new(Configuration::new()),
        }
    }

    fn close(&mut self, case: &Case) {
        if let Some(longest) = self.longest.get_mut(self.phase) {
            *longest = self.notes.periods.max(*longest);
        }
        self.lines.extend(finished(case, self.phase, &self.notes));
        self.notes = PhaseNotes::NONE;
    }
}

impl<'a> Observer<BelievedPlant<'a>> for Planner {
    fn commanded(
        &mut self,
        flight: &Simulation<'_, BelievedPlant<'a>>,
        command: &Command<f64, JOINTS>,
        _: &mut Vec<Event>,
    ) {
        if command.phase != self.phase || command.begins {
            self.close(flight.case());
            self.has_passed |= self.phase == self.last && flight.periods() > 0;
            self.phase = command.phase;
            self.tool = believed_tool(flight);
        }
    }

    fn flown(
        &mut self,
        flight: &Simulation<'_, BelievedPlant<'a>>,
        command: &Command<f64, JOINTS>,
        _: &mut Vec<Event>,
    ) {
        self.notes.periods += 1;
        let at = command.reference.X_NE.translation;
        self.notes.way = (at - *self.notes.start.get_or_insert(at)).norm();
        self.reason = look(flight.case(), flight.computer(), &mut self.notes, &mut self.place);
    }
}

/// Pose of the tool where the laws believed the vehicle to be before the last period: in inertial axes,
/// and in those of the base.
fn believed_tool(flight: &Simulation<'_, BelievedPlant<'_>>) -> [Pose<f64>; 2] {
    let (computer, state) = (flight.computer(), flight.plant().state());
    let X_NE = kinematics(computer.robot(), state).pose(computer.tool());
    [X_NE, state.X_NB.inverse() * X_NE]
}

/// The loops that are closed once a period.
fn loop_lines(case: &Case) -> Vec<PlanLine> {
    let line = |text| PlanLine { phase: "sampled loops".into(), text };
    sampled_loops(case).iter().map(|found| line(found.text())).collect()
}

/// Note how near the arm is to where it cannot go on; why, if it cannot.
fn look(
    case: &Case,
    computer: &FlightComputer<f64, JOINTS>,
    notes: &mut PhaseNotes,
    place: &mut Configuration<f64, JOINTS>,
) -> Option<String> {
    let state = computer.believed_state();
    if let Some(reason) = look_at_loops(case, computer, notes, &state) {
        return Some(reason);
    }
    let k = kinematics(computer.robot(), &state);
    let reach = reach_margin(&k, computer.tool()).unwrap_or(f64::INFINITY);
    let R = case.start.X_NB.rotation.transpose() * state.X_NB.rotation;
    notes.base_turn = Quat::from_matrix(&R).log().norm();
    notes.base_shift = (state.X_NB.translation - case.start.X_NB.translation).norm();
    notes.reach = notes.reach.min(reach);
    let mut limited = String::new();
    for j in k.robot.joints() {
        if state.v[j].abs() > notes.fastest.1 {
            notes.fastest = (j, state.v[j].abs());
        }
        let (name, limits) = (case.joint_name(j), &case.vehicle.limits[j]);
        if let Some((lower, upper)) = limits.travel
            && !(lower - 1e-9..=upper + 1e-9).contains(&state.q[j])
        {
            return Some(format!(
                "joint {name} would leave its travel: {}, from {} to {}",
                case.position_text(j, state.q[j]),
                case.position_text(j, lower),
                case.position_text(j, upper)
            ));
        }
        if let Some(rate) = limits.rate
            && state.v[j].abs() > rate * (1.0 - 1e-9)
        {
            limited = format!(", joint {name} at its rate limit of {}", case.rate_text(j, rate));
        }
    }
    if let Some(reason) = look_at_other_arms(case, computer, &k) {
        return Some(reason);
    }
    if !computer.follows_tool() {
        return None;
    }
    let singular = smallest_singular_value(&computer.task_jacobian(place), computer.task());
    notes.singular = notes.singular.min(singular);
    let (off, turned) = match (computer.task(), computer.believed_tool_error()) {
        (Task::Pose, error) => error,
        (Task::Position, (off, _)) => (off, 0.0),
    };
    (off > OFF_THE_WAY.0 || turned > OFF_THE_WAY.1).then(|| {
        format!(
            "{:.3} m along the way the tool {} falls behind its reference by {:.3} mm and {:.4} deg; \
             {}{limited}{}",
            notes.way,
            case.frame_name(computer.tool()),
            off * 1e3,
            turned.to_degrees(),
            condition(singular, reach, notes),
            about_the_end(case, computer)
        )
    })
}

/// Which tool of the arms beside the first one falls behind its reference, if one does.
fn look_at_other_arms(
    case: &Case,
    computer: &FlightComputer<f64, JOINTS>,
    k: &Kinematics<'_, f64, JOINTS>,
) -> Option<String> {
    computer.arms().skip(1).filter(|arm| arm.follows_tool).find_map(|arm| {
        let (off, turned) = tool_error(k, &k.pose(&arm.tool), arm.reference?);
        let (off, turned) = (off.norm(), turned.norm());
        let counts = arm.task == Task::Pose && turned > OFF_THE_WAY.1;
        (off > OFF_THE_WAY.0 || counts).then(|| {
            format!(
                "the tool {} falls behind its reference by {:.3} mm and {:.4} deg",
                case.frame_name(&arm.tool),
                off * 1e3,
                turned.to_degrees()
            )
        })
    })
}

/// Why the joint loops would be unstable as sampled, if they would be.
fn look_at_loops(
    case: &Case,
    computer: &FlightComputer<f64, JOINTS>,
    notes: &mut PhaseNotes,
    state: &State<f64, JOINTS>,
) -> Option<String> {
    if notes.periods % LOOP_PERIODS != 1 {
        return None;
    }
    let gain = joint_gain(case, computer.robot(), state);
    notes.loop_gain = notes.loop_gain.max(gain);
    let found = joint_loop(case, gain).filter(SampledLoop::is_unstable)?;
    Some(format!("a loop would be unstable as sampled: {}; {}", found.text(), found.help()))
}

/// Whether the end of the way is out of reach at any speed, what is missing, and what stops the arm.
fn about_the_end(case: &Case, computer: &FlightComputer<f64, JOINTS>) -> String {
    let at_end = computer.end_out_of_reach().filter(|left| left.position_error.is_finite());
    let (Task::Pose, Some(left)) = (computer.task(), at_end) else {
        return String::new();
    };
    let mut text = format!(
        "; from here, if the base turns no more, its end is out of reach at any speed: the nearest \
         is {:.1} mm and {:.2} deg off",
        left.position_error * 1e3,
        left.rotation_error.to_degrees()
    );
    if let Some(j) = left.joint {
        text += &format!(", where joint {} stands at the end of its travel", case.joint_name(j));
    }
    text += &computer.reach_along_line().map_or(String::new(), missing);
    if let Some((asked, there)) = computer.wrist_too_far() {
        text += &format!(
            "; there the wrist would have to be {asked:.3} m from the shoulder, and the stretched arm \
             has {there:.3} m (the base's giving way counted)"
        );
    }
    text
}

/// How much of a line is missing, from poses of the tool at its start, as far as it can be brought, and
/// at its end.
fn missing([start, reached, end]: [Pose<f64>; 3]) -> String {
    let way = |X: Pose<f64>| (X.translation - start.translation).norm();
    let turn = |X: Pose<f64>| {
        Quat::from_matrix(&(X.rotation * start.rotation.transpose())).log().norm().to_degrees()
    };
    let mut text = "; at the attitude that is wanted the tool".to_owned();
    if way(end) > 1e-6 {
        let (reached, whole) = (way(reached), way(end));
        let short = (whole - reached) * 1e3;
        text += &format!(" reaches {reached:.3} m of the {whole:.3} m, {short:.1} mm are missing");
        return text;
    }
    let (reached, whole) = (turn(reached), turn(end));
    let short = whole - reached;
    text + &format!(" turns by {reached:.1} deg of the {whole:.1} deg, {short:.1} deg are missing")
}

/// What the arm is like, and where the base is believed to be, in words and numbers.
fn condition(singular: f64, reach: f64, notes: &PhaseNotes) -> String {
    let mut left = String::new();
    if reach.is_finite() {
        left = format!("arm {:.1} mm short of straight, ", reach * 1e3);
    }
    format!(
        "smallest singular value {singular:.4}, {left}base believed to have moved {:.1} mm and turned \
         {:.2} deg",
        notes.base_shift * 1e3,
        notes.base_turn.to_degrees()
    )
}

fn finished(case: &Case, phase: usize, notes: &PhaseNotes) -> Option<PlanLine> {
    let phase = case.phases.get(phase)?;
    if notes.periods == 0 {
        return None;
    }
    let mut text = format!(
        "{:.2} s, joint rates up to {} ({})",
        notes.periods as f64 * case.period(),
        case.rate_text(notes.fastest.0, notes.fastest.1),
        case.joint_name(notes.fastest.0)
    );
    if notes.singular.is_finite() {
        text = format!("{text}, {}", condition(notes.singular, notes.reach, notes));
    }
    if let Some(found) = joint_loop(case, notes.loop_gain).filter(|found| found.gain > 1.0) {
        text = format!("{text}, {}", found.text());
    }
    Some(PlanLine { phase: phase.name.clone(), text })
}

/// A step that cannot begin.
pub(crate) fn cannot_begin(case: &Case, bad: &BadPhase<f64>, time_s: f64) -> End {
    let phase = case.phases.get(bad.phase).map_or(String::new(), |p| p.name.clone());
    End::Stopped { phase, time_s, reason: no_way(case, bad.phase, &bad.reason) }
}

/// Why the step of this number cannot begin, in words.
pub(crate) fn no_way(case: &Case, phase: usize, reason: &NoWay<f64>) -> String {
    match reason {
        NoWay::Numbers(numbers) => numbers.to_string(),
        NoWay::TooLong { duration, longest } => {
            format!("it would take {duration:.3e} s, a phase takes at most {longest:.3e} s")
        }
        NoWay::Exhausted(most) => {
            format!("it has begun {most} times, as often as its attempts allow")
        }
        NoWay::Unreachable(u) => {
            let because = match u.joint {
                Some(j) => {
                    format!(", where joint {} stands at the end of its travel", case.joint_name(j))
                }
                None => String::new(),
            };
            format!(
                "no joint positions bring the tool {} to its pose: the nearest are {:.3} mm and {:.4} deg off{because}",
                case.tools_of(phase),
                u.position_error * 1e3,
                u.rotation_error.to_degrees()
            )
        }
    }
}
