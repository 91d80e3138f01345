//! Samples flown side by side, one in each lane of the processor. What decides, and what is seen, takes
//! each lane's numbers alone; the law and the world take all at once.

use crate::books::ledger;
use crate::flight::Flight;
use crate::mission::Case;
use crate::observe::{Track, Truth, observe};
use crate::outcome::End;
use crate::plan::Plan;
use crate::quantity::Watch;
use crate::read_base::Turning;
use crate::sample::{Flown, SamplePlan};
use wrasse_dynamics::{Dynamics, Robot, State};
use wrasse_flight::steering::Steered;
use wrasse_flight::{
    Asked, Assignment, Command, Guidance, Guided, PeriodMemory, Phase, Setup, Told,
    asked_side_by_side, task_jacobian,
};
use wrasse_hardware::{SetPoint, SetPointMotion};
use wrasse_lanes::{Kernel, Level};
use wrasse_spatial::{Lanes, Real, SideBySide, SpatialForce, Vec3};
use wrasse_vehicle::JOINTS;
use wrasse_world::{BaseAttitude, Drive, Ledger, WorldsSideBySide};

/// Samples that fly at once.
pub(crate) const LANES: usize = 8;

type L = Lanes<LANES>;

/// Whether samples of a case can fly side by side: sensors and attitude actuator are ideal, nothing is
/// grasped, nothing fails and nothing pushes.
pub(crate) fn flies_side_by_side(case: &Case) -> bool {
    let steered = case.setup.base.steering.is_some() || case.setup.base.position_hold.is_some();
    let felt =
        case.sensors.is_some() || case.feels_wrench || case.setup.navigation.attitude.is_some();
    let disturbed = !(case.failures.is_empty() && case.wrenches.is_empty());
    let simple =
        |phase: &Phase<f64, JOINTS>| !matches!(phase, Phase::Grip(_) | Phase::Relieve { .. });
    let ideal = case.turning != Turning::Fitted || case.base != BaseAttitude::Controlled;
    ideal && !steered && !felt && !disturbed && case.phases.iter().all(|p| simple(&p.phase))
}

/// One sample on its way.
struct Lane<'a> {
    flight: Flight<'a>,
    periods: u64,
    guidance: Guidance<f64, JOINTS>,
    watch: Watch,
    track: Track,
    /// It flies as the others do, and its numbers are finite.
    keeps_up: bool,
}

/// Samples on their way, and what they share.
struct Formation<'a> {
    planned: &'a SamplePlan<'a>,
    level: Level,
    lanes: Vec<Lane<'a>>,
    worlds: WorldsSideBySide<LANES, JOINTS>,
    ledgers: [Ledger; LANES],
    /// The vehicles as the laws believe them to be.
    robot: Robot<L, JOINTS>,
    setup: Setup<L, JOINTS>,
    memory: PeriodMemory<L, JOINTS>,
    set_points: [SetPoint<L>; JOINTS],
    state: State<L, JOINTS>,
}

/// Fly samples as planned; `None` for each that must fly alone, for it does otherwise than the others or
/// breaks down.
pub(crate) fn fly_side_by_side(
    planned: &SamplePlan<'_>,
    cases: [(&Case, &Plan); LANES],
    level: Level,
) -> [Option<Flown>; LANES] {
    let nothing = || core::array::from_fn(|_| None);
    let Some(mut formation) = Formation::new(planned, cases, level) else { return nothing() };
    let longest = cases.iter().map(|(_, plan)| plan.periods).max().unwrap_or(0);
    for period in 0..longest {
        if !formation.period(period) {
            return nothing();
        }
    }
    let base = planned.case.base;
    let mut books = formation.ledgers.iter();
    let mut lanes = formation.lanes.into_iter();
    core::array::from_fn(|_| {
        let (lane, books) = (lanes.next()?, books.next()?);
        lane.keeps_up.then(|| (End::Completed, lane.watch, ledger(books, base).closes))
    })
}

impl<'a> Formation<'a> {
    fn new(
        planned: &'a SamplePlan<'_>,
        cases: [(&'a Case, &'a Plan); LANES],
        level: Level,
    ) -> Option<Self> {
        let (first, _) = cases[0];
        if cases.iter().any(|(case, _)| case.setup != first.setup) {
            return None;
        }
        let lane = |(case, plan): (&'a Case, &'a Plan)| Lane {
            flight: Flight::new(case, case.stepper, false),
            periods: plan.periods,
            guidance: Guidance::new(&case.flight_phases()),
            watch: Watch::new(case.quantities.clone(), case.phases.len()),
            track: Track::default(),
            keeps_up: true,
        };
        let lanes: Vec<Lane<'a>> = cases.into_iter().map(lane).collect();
        let worlds =
            WorldsSideBySide::new(&core::array::from_fn(|i| &lanes[i].flight.world), level)?;
        let believed = core::array::from_fn(|i| *lanes[i].flight.computer.robot());
        Some(Self {
            planned,
            level,
            ledgers: core::array::from_fn(|i| lanes[i].flight.world.open_ledger()),
            robot: Robot::side_by_side(&believed)?,
            setup: first.setup.bare(),
            memory: PeriodMemory::new(),
            set_points: SideBySide::side_by_side(&|i| lanes[i].flight.set_points),
            state: worlds.state(),
            lanes,
            worlds,
        })
    }

    /// One control period of all; whether enough of them keep up for it to be worth while.
    fn period(&mut self, period: u64) -> bool {
        let Self { robot, setup, memory, state, .. } = self;
        self.level.run(Look { robot, setup, memory, state });
        let Some(asked) = self.ask() else { return false };
        let Self { robot, setup, memory, state, .. } = self;
        let told = self.level.run(Act { robot, setup, memory, state, asked: &asked });
        self.drive(&told);
        self.state = self.worlds.state();
        let flying = core::array::from_fn(|i| {
            let lane = &mut self.lanes[i];
            lane.keeps_up &= self.worlds.is_finite(i);
            lane.keeps_up && period < lane.periods
        });
        self.worlds.update_ledgers(&self.state, &mut self.ledgers, &flying);
        let found = self.planned.needs.dynamics.then(|| self.worlds.dynamics(&self.state));
        for i in (0..LANES).filter(|i| flying[*i]) {
            self.observe(i, &told, found.as_ref());
        }
        true
    }

    /// What is asked of all: a lane of which something else is asked than of most falls behind.
    fn ask(&mut self) -> Option<Asked<L, JOINTS>> {
        let mut asked = [Asked::Still; LANES];
        for (i, lane) in self.lanes.iter_mut().enumerate().filter(|(_, lane)| lane.keeps_up) {
            let memory = self.memory.lane(i);
            let (robot, setup) = (lane.flight.computer.robot(), &lane.flight.case.setup);
            let of = Guided { robot, setup, memory: &memory };
            lane.keeps_up = lane.guidance.begin(&of).is_ok();
            asked[i] = lane.guidance.next(&of, &SpatialForce::zero());
        }
        let most = self.most_frequent(&asked)?;
        for (lane, asked) in self.lanes.iter_mut().zip(&mut asked) {
            lane.keeps_up &= is_alike(asked, &most);
            if !lane.keeps_up {
                *asked = most;
            }
        }
        asked_side_by_side(&asked)
    }

    /// What is asked of most of those that keep up; nothing if less than two do.
    fn most_frequent(&self, asked: &[Asked<f64, JOINTS>; LANES]) -> Option<Asked<f64, JOINTS>> {
        let up = || self.lanes.iter().zip(asked).filter(|(lane, _)| lane.keeps_up).map(|(_, a)| a);
        let like = |a: &Asked<f64, JOINTS>| up().filter(|b| is_alike(a, b)).count();
        up().max_by_key(|a| like(a)).filter(|a| like(a) > 1).copied()
    }

    /// Let the worlds do what was told.
    fn drive(&mut self, told: &Told<L, JOINTS>) {
        let case = self.planned.case;
        let period = case.period();
        let drives: [Drive<L>; JOINTS] = core::array::from_fn(|j| {
            if case.torque[j] {
                return Drive::Effort(told.effort[j]);
            }
            let (from, to) = (self.set_points[j], told.set_points[j]);
            Drive::Follow(SetPointMotion::between(from, to, L::from_f64(period)))
        });
        self.set_points = told.set_points;
        let torque_B = match case.turning {
            Turning::Ideal(_) => told.attitude_torque_B,
            Turning::Fitted => Vec3::zero(),
        };
        self.worlds.command(&drives, torque_B, period);
        self.worlds.advance(period);
    }

    /// See the truth of one lane.
    fn observe(&mut self, i: usize, told: &Told<L, JOINTS>, found: Option<&Dynamics<L, JOINTS>>) {
        let needs = self.planned.needs;
        let lane = &mut self.lanes[i];
        let command = command_of(told, &self.memory, i, lane.guidance.phase());
        lane.track.follow(&command, lane.guidance.follows_tool());
        self.worlds.lane_into(i, &mut lane.flight.world);
        let (case, world) = (lane.flight.case, &lane.flight.world);
        let dynamics = found.map(|found| found.lane(i));
        let truth = Truth::seen(world, &self.state.lane(i), dynamics.as_ref());
        let jacobian = || {
            let memory = self.memory.lane(i);
            let to = Assignment { axes: memory.axes, ..case.setup.assignment };
            task_jacobian(lane.flight.computer.robot(), &to, &memory.belief)
        };
        let seen = observe(case, &truth, &command, &lane.track, f64::NAN, needs, &jacobian);
        lane.watch.add_only(&self.planned.watched, command.phase, &seen.values);
    }
}

/// Whether the same kind of thing is asked.
fn is_alike(a: &Asked<f64, JOINTS>, b: &Asked<f64, JOINTS>) -> bool {
    match (a, b) {
        (Asked::Tool { axes: a, .. }, Asked::Tool { axes: b, .. }) => a == b,
        _ => core::mem::discriminant(a) == core::mem::discriminant(b),
    }
}

/// What the actuators of one lane are told, those of the base being ideal.
fn command_of(
    told: &Told<L, JOINTS>,
    memory: &PeriodMemory<L, JOINTS>,
    i: usize,
    phase: usize,
) -> Command<f64, JOINTS> {
    let nothing = Steered::nothing();
    Command {
        set_points: told.set_points.lane(i),
        effort: told.effort.lane(i),
        attitude_torque_B: told.attitude_torque_B.lane(i),
        actuators: nothing.command,
        steering: nothing.report,
        no_relief: None,
        grip: None,
        phase,
        reference: memory.reference_of(i),
        axes: memory.axes,
    }
}

/// The first half of a control period.
struct Look<'a> {
    robot: &'a Robot<L, JOINTS>,
    setup: &'a Setup<L, JOINTS>,
    memory: &'a mut PeriodMemory<L, JOINTS>,
    state: &'a State<L, JOINTS>,
}

impl Kernel for Look<'_> {
    type Out = ();
    #[inline(always)]
    fn run(self) {
        self.memory.look(self.robot, self.setup, self.state);
    }
}

/// The second half.
struct Act<'a> {
    robot: &'a Robot<L, JOINTS>,
    setup: &'a Setup<L, JOINTS>,
    memory: &'a mut PeriodMemory<L, JOINTS>,
    state: &'a State<L, JOINTS>,
    asked: &'a Asked<L, JOINTS>,
}

impl Kernel for Act<'_> {
    type Out = Told<L, JOINTS>;
    #[inline(always)]
    fn run(self) -> Self::Out {
        self.memory.act(self.robot, self.setup, self.state, self.asked, None)
    }
}
