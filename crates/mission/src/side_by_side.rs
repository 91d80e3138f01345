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
use wrasse_lanes::{Level, OnAnyLevel};
use wrasse_spatial::{Instructions, Lanes, Real, SideBySide, SpatialForce, Vec3};
use wrasse_vehicle::JOINTS;
use wrasse_world::{BaseAttitude, Drive, Ledger, WorldsSideBySide};

/// Samples that fly at once.
pub(crate) const LANES: usize = 8;

type L<I> = Lanes<LANES, I>;

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
    flight: Box<Flight<'a>>,
    periods: u64,
    guidance: Guidance<f64, JOINTS>,
    watch: Watch,
    track: Track,
    /// It flies as the others do, and its numbers are finite.
    keeps_up: bool,
}

/// Samples on their way, and what they share.
struct Formation<'a, I: Instructions> {
    planned: &'a SamplePlan<'a>,
    lanes: Vec<Lane<'a>>,
    worlds: Box<WorldsSideBySide<I, LANES, JOINTS>>,
    ledgers: [Ledger; LANES],
    /// The vehicles as the laws believe them to be.
    robot: Box<Robot<L<I>, JOINTS>>,
    setup: Setup<L<I>, JOINTS>,
    memory: Box<PeriodMemory<L<I>, JOINTS>>,
    set_points: [SetPoint<L<I>>; JOINTS],
    state: State<L<I>, JOINTS>,
}

/// Samples of a case, each as planned.
type Cases<'a> = [(&'a Case, &'a Plan); LANES];

/// Fly samples as planned, on a level of the processor; `None` for each that must fly alone, for it does
/// otherwise than the others or breaks down.
///
/// On the base level all do: two lanes at a time gain less than a formation takes to build.
pub(crate) fn fly_side_by_side(
    planned: &SamplePlan<'_>,
    cases: Cases<'_>,
    level: Level,
) -> [Option<Flown>; LANES] {
    let flown = level.choose_wide(FlySideBySide { planned, cases }).flatten();
    flown.unwrap_or_else(|| core::array::from_fn(|_| None))
}

struct FlySideBySide<'a> {
    planned: &'a SamplePlan<'a>,
    cases: Cases<'a>,
}

impl OnAnyLevel for FlySideBySide<'_> {
    type Out = Option<[Option<Flown>; LANES]>;
    // Lanes are large: each level has a stack frame of its own, and the rest lies on the heap.
    #[inline(never)]
    fn with<I: Instructions>(self) -> Self::Out {
        Formation::<I>::new(self.planned, self.cases)?.fly()
    }
}

impl<'a, I: Instructions> Formation<'a, I> {
    fn new(planned: &'a SamplePlan<'a>, cases: Cases<'a>) -> Option<Self> {
        let (first, _) = cases[0];
        if cases.iter().any(|(case, _)| case.setup != first.setup) {
            return None;
        }
        let lane = |(case, plan): (&'a Case, &'a Plan)| Lane {
            flight: Box::new(Flight::new(case, case.stepper, false)),
            periods: plan.periods,
            guidance: Guidance::new(&case.flight_phases()),
            watch: Watch::new(case.quantities.clone(), case.phases.len()),
            track: Track::default(),
            keeps_up: true,
        };
        let lanes: Vec<Lane<'a>> = cases.into_iter().map(lane).collect();
        let worlds = WorldsSideBySide::new(&core::array::from_fn(|i| &lanes[i].flight.world))?;
        let worlds = Box::new(worlds);
        let believed = core::array::from_fn(|i| lanes[i].flight.computer.robot());
        Some(Self {
            planned,
            ledgers: core::array::from_fn(|i| lanes[i].flight.world.open_ledger()),
            robot: Box::new(Robot::side_by_side(&believed)?),
            setup: first.setup.bare(),
            memory: Box::new(PeriodMemory::new()),
            set_points: SideBySide::side_by_side(&|i| lanes[i].flight.set_points),
            state: worlds.state(),
            lanes,
            worlds,
        })
    }

    /// All periods; `None` if too few keep up for it to be worth while.
    fn fly(mut self) -> Option<[Option<Flown>; LANES]> {
        let longest = self.lanes.iter().map(|lane| lane.periods).max().unwrap_or(0);
        for period in 0..longest {
            self.period(period)?;
        }
        let base = self.planned.case.base;
        let mut books = self.ledgers.iter();
        let mut lanes = self.lanes.into_iter();
        Some(core::array::from_fn(|_| {
            let (lane, books) = (lanes.next()?, books.next()?);
            lane.keeps_up.then(|| (End::Completed, lane.watch, ledger(books, base).closes))
        }))
    }

    /// One control period of all; `None` if less than two keep up.
    fn period(&mut self, period: u64) -> Option<()> {
        self.memory.look(&self.robot, &self.setup, &self.state);
        let asked = self.ask()?;
        let told = self.memory.act(&self.robot, &self.setup, &self.state, &asked, None);
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
        Some(())
    }

    /// What is asked of all: a lane of which something else is asked than of most falls behind.
    fn ask(&mut self) -> Option<Asked<L<I>, JOINTS>> {
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
    fn drive(&mut self, told: &Told<L<I>, JOINTS>) {
        let case = self.planned.case;
        let period = case.period();
        let drives: [Drive<L<I>>; JOINTS] = core::array::from_fn(|j| {
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
    fn observe(
        &mut self,
        i: usize,
        told: &Told<L<I>, JOINTS>,
        found: Option<&Dynamics<L<I>, JOINTS>>,
    ) {
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
fn command_of<I: Instructions>(
    told: &Told<L<I>, JOINTS>,
    memory: &PeriodMemory<L<I>, JOINTS>,
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
