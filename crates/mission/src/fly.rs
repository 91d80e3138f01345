//! One case flown: the flight computer and the world, a control period at a time.

use crate::case_world::world_of;
use crate::dead_band::DeadBand;
use crate::limits_passed::{Passed, limits_passed};
use crate::mission::{Case, PayloadStart};
use crate::observe::{Observation, Track, observe};
use crate::outcome::{DemandSample, End, Event, EventKind, Snapshot, Telemetry};
use crate::picture::snapshot;
use crate::plan::{Plan, cannot_begin};
use crate::quantity::Watch;
use crate::read_base::Turning;
use crate::saturations::{EquipmentLimits, MISSED, at_limits, describe};
use crate::sensing::{Refusals, Sensing};
use crate::telemetry::Recorder;
use wrasse_dynamics::{Payload, kinematics};
use wrasse_flight::{Command, FlightComputer, Grip};
use wrasse_hardware::{SetPoint, SetPointMotion};
use wrasse_spatial::{Pose, Quat, Vec3};
use wrasse_vehicle::JOINTS;
use wrasse_world::{BaseAttitude, Drive, Saturation, Stepper, World};

/// What a flight leaves behind.
#[derive(Debug)]
pub(crate) struct Flown {
    pub(crate) end: End,
    pub(crate) watch: Watch,
    pub(crate) ledger: wrasse_world::Ledger,
    pub(crate) events: Vec<Event>,
    pub(crate) telemetry: Telemetry,
    pub(crate) snapshots: Vec<Snapshot>,
    pub(crate) demand: Vec<DemandSample>,
    /// The last thing seen.
    pub(crate) last: Option<Observation>,
}

/// Share of the vehicle's mass whose loss as propellant the flight computer is told of.
const NOTICED: f64 = 1e-4;

/// Angle from which on the attitude counts as lost (rad): 5 deg, where a tool 1 m out is 9 cm off.
const LOST: f64 = 0.0873;

/// A flight under way.
struct Flight<'a> {
    case: &'a Case,
    world: World<JOINTS>,
    computer: FlightComputer<f64, JOINTS>,
    sensing: Sensing,
    refusals: Refusals,
    limits: EquipmentLimits,
    dead_band: DeadBand,
    /// For each failure: whether it has happened, and whether the computer was told.
    failed: Vec<bool>,
    told: Vec<bool>,
    /// Propellant when the computer was last told (kg).
    weighed: f64,
    /// Whether the tank was said to be empty.
    dry: bool,
    /// Whether the attitude was lost.
    lost: bool,
    /// Whether thrusters empty wheels and gyros.
    unloads: bool,
    /// Angle of the estimated attitude from the true one (rad); NaN where nothing is estimated.
    estimate_error: f64,
    /// Number of each payload among the world's free bodies, while it floats.
    floating: Vec<Option<usize>>,
    /// Payloads in the grips, in the world's order.
    holding: Vec<usize>,
    set_points: [SetPoint<f64>; JOINTS],
    /// What was already said of the current phase.
    said: Vec<Saturation>,
    said_passed: Vec<Passed>,
    events: Vec<Event>,
}

/// Fly a case as planned; `progress` is told the share that is done.
pub(crate) fn fly(
    case: &Case,
    plan: &Plan,
    stepper: Stepper,
    progress: &mut dyn FnMut(f64),
) -> Flown {
    let mut flight = Flight::new(case, stepper);
    let mut watch = Watch::new(case.quantities.clone(), case.phases.len());
    let mut ledger = flight.world.open_ledger();
    let (mut recorder, mut track) = (Recorder::default(), Track::default());
    let (mut snapshots, mut last, mut phase) = (vec![], None, usize::MAX);
    let every = case.periods_per_sample();
    let mut end = End::Completed;
    let mut demand = vec![];
    let tool = flight.world.pose(flight.computer.tool()).translation;
    snapshots.push(snapshot(case, &flight.world, &flight.payload_poses(), [tool; 2]));
    for period in 0..plan.periods {
        flight.break_what_breaks();
        let command = match flight.command() {
            Ok(command) => command,
            Err(stop) => {
                end = stop;
                break;
            }
        };
        if command.phase != phase {
            phase = command.phase;
            flight.enter(phase);
        }
        if let Some(stop) = flight.period(&command) {
            end = stop;
            break;
        }
        track.follow(&command, flight.computer.follows_tool());
        flight.world.update_ledger(&mut ledger);
        let error = flight.estimate_error;
        let seen = observe(case, &flight.world, &flight.computer, &command, &track, error);
        flight.tell_limits(&seen);
        flight.tell_missing(&command);
        demand.push(DemandSample::of(flight.world.time(), &command, &seen));
        watch.add(phase, &seen.values);
        let done = period + 1;
        if done % every == 0 || done == plan.periods {
            recorder.sample(flight.world.time(), case, &seen, &ledger);
        }
        if is_snapshot(done, plan.periods, case.snapshots) {
            let reference = command.reference.X_NE.translation;
            let tips = [seen.X_NE.translation, reference];
            snapshots.push(snapshot(case, &flight.world, &flight.payload_poses(), tips));
        }
        last = Some(seen);
        progress(done as f64 / plan.periods as f64);
    }
    flight.sum_up();
    Flown {
        end,
        watch,
        ledger,
        events: flight.events,
        telemetry: recorder.finish(),
        snapshots,
        demand,
        last,
    }
}

/// Whether the drawing shows this period: the last, and some evenly between it and the start.
fn is_snapshot(done: u64, all: u64, count: u32) -> bool {
    let gaps = u64::from(count - 1).max(1);
    (1..=gaps).any(|i| (all * i / gaps).max(1) == done)
}

impl<'a> Flight<'a> {
    fn new(case: &'a Case, stepper: Stepper) -> Self {
        let mut world = world_of(case, stepper);
        let is_held = |i: &usize| matches!(case.payloads[*i].start, PayloadStart::Held(_));
        let payloads = 0..case.payloads.len();
        let floats = |i| (!is_held(&i)).then(|| world.add_free_body(case.free_body(i)));
        let floating = payloads.clone().map(floats).collect();
        let holding = payloads.filter(is_held).collect();
        let start = |j: usize| SetPoint {
            position: case.start.q[j],
            rate: case.start.v[j],
            acceleration: 0.0,
        };
        Self {
            case,
            computer: FlightComputer::new(case.setup, world.robot(), &case.flight_phases()),
            world,
            sensing: Sensing::new(case),
            refusals: Refusals::default(),
            limits: EquipmentLimits::default(),
            dead_band: DeadBand::default(),
            failed: vec![false; case.failures.len()],
            told: vec![false; case.failures.len()],
            weighed: case.equipment.actuators.tank.map_or(0.0, |tank| tank.propellant),
            dry: false,
            lost: false,
            unloads: false,
            estimate_error: f64::NAN,
            floating,
            holding,
            set_points: core::array::from_fn(start),
            said: vec![],
            said_passed: vec![],
            events: vec![],
        }
    }

    /// Where each payload's centre of mass is, and how it is turned.
    fn payload_poses(&self) -> Vec<(usize, Pose<f64>)> {
        let state = self.world.state();
        let k = kinematics(self.world.robot(), &state);
        let at_cm = |X: Pose<f64>, i: usize, matter: &Payload<f64>| {
            let p_cm = X.point(matter.M_F_F.centre_of_mass());
            (i, Pose::new(X.rotation, p_cm))
        };
        let held = self.holding.iter().zip(self.world.held());
        let held = held.map(|(&i, (frame, matter))| at_cm(k.pose(frame), i, matter));
        let floating = self.floating.iter().enumerate().filter_map(|(i, n)| n.map(|n| (i, n)));
        let floating = floating.map(|(i, n)| {
            let body = &self.world.free_bodies()[n];
            at_cm(body.pose(), i, &body.matter)
        });
        held.chain(floating).collect()
    }

    fn say(&mut self, kind: EventKind, text: String) {
        self.events.push(Event { time_s: self.world.time(), kind, text });
    }

    fn enter(&mut self, phase: usize) {
        self.said.clear();
        self.said_passed.clear();
        if let Some(phase) = self.case.phases.get(phase) {
            self.say(EventKind::Phase, format!("phase {}", phase.name));
        }
    }

    /// What the flight computer says to what the sensors say.
    fn command(&mut self) -> Result<Command<f64, JOINTS>, End> {
        let sensed = self.sensing.read(self.case, &self.world);
        let quat_NB = self.world.system().quat_NB;
        let time = self.world.time();
        // What the planning let pass, the truth may still refuse: by then things have moved.
        let command = self.computer.step(&sensed).map_err(|bad| {
            match cannot_begin(self.case, &bad, time) {
                End::Infeasible { phase, time_s, reason } => End::Stopped { phase, time_s, reason },
                end => end,
            }
        })?;
        let estimate = self.computer.navigation().attitude_estimate();
        self.estimate_error =
            estimate.map_or(f64::NAN, |e| (e.quat_NB.conjugate() * quat_NB).log().norm());
        Ok(command)
    }

    /// One control period of the world; why the flight ends, if it does.
    fn period(&mut self, command: &Command<f64, JOINTS>) -> Option<End> {
        if let Some(stop) = command.grip.and_then(|grip| self.grip(grip, command.phase)) {
            return Some(stop);
        }
        let period = self.case.period();
        let drives: [Drive; JOINTS] = core::array::from_fn(|j| {
            if self.case.torque[j] {
                Drive::Effort(command.effort[j])
            } else {
                let (from, to) = (self.set_points[j], command.set_points[j]);
                Drive::Follow(SetPointMotion::between(from, to, period))
            }
        });
        self.set_points = command.set_points;
        let torque_B = match self.case.turning {
            Turning::Ideal(_) => command.attitude_torque_B,
            Turning::Fitted => Vec3::zero(),
        };
        let mut cut = self.world.command(&drives, torque_B, &command.actuators, period);
        for limit in at_limits(self.case, command, &self.world.actuator_readings()) {
            if !cut.contains(&limit) {
                cut.push(limit);
            }
        }
        let (missing, turned) = (command.steering.missing.torque.norm(), self.turned());
        self.limits.note(&cut, self.world.time(), missing, turned);
        for saturation in cut {
            if !self.said.contains(&saturation) {
                self.said.push(saturation);
                let text = describe(self.case, saturation);
                self.say(EventKind::Limit, text);
            }
        }
        let broken = self.world.advance(period).err();
        self.weigh_propellant();
        let broken = broken?;
        let quantity = match broken.joint {
            Some(j) => format!("position or rate of joint {}", self.case.joint_name(j)),
            None => broken.quantity,
        };
        Some(End::Breakdown {
            time_s: broken.time,
            reason: format!("{quantity} is no longer finite"),
        })
    }

    /// Tell the computer what it is made of once enough propellant has gone: its gauge says so.
    fn weigh_propellant(&mut self) {
        let left = self.world.actuator_readings().propellant;
        if self.case.equipment.actuators.tank.is_some() && left <= 0.0 && !self.dry {
            self.dry = true;
            let text = describe(self.case, Saturation::TankEmpty);
            self.say(EventKind::Limit, text);
        }
        if (self.weighed - left).abs() > NOTICED * self.world.robot().mass() {
            self.weighed = left;
            self.computer.robot_changed(self.world.robot());
        }
    }

    /// Angle of the base from the attitude that it began with (rad).
    fn turned(&self) -> f64 {
        let start = Quat::from_matrix(&self.case.start.X_NB.rotation);
        (start.conjugate() * self.world.system().quat_NB).log().norm()
    }

    /// Let units fail whose time has come, and tell the computer of those that it is told of.
    fn break_what_breaks(&mut self) {
        // To within the rounding of a sum of periods.
        let now = self.world.time() + 1e-9;
        let case = self.case;
        for (i, failure) in case.failures.iter().enumerate() {
            let due = |at: f64, already: bool| !already && at <= now;
            if due(failure.at, self.failed[i]) {
                self.failed[i] = true;
                self.world.fail(failure.breaks);
                self.say(EventKind::Failure, format!("{} fails: {}", failure.name, failure.how));
            }
            if due(failure.told_at.unwrap_or(f64::INFINITY), self.told[i]) {
                self.told[i] = true;
                self.computer.isolate(failure.unit);
                let text = format!("the flight computer is told to do without {}", failure.name);
                self.say(EventKind::Failure, text);
            }
        }
    }

    /// Say how long limits were met, and which failures and wrenches the flight was too short for.
    fn sum_up(&mut self) {
        let met = self.limits.summary(self.case);
        for text in met.into_iter().chain(self.refusals.summary()) {
            self.say(EventKind::Limit, text);
        }
        let end = self.world.time();
        let failures = self.case.failures.iter().zip(&self.failed).filter(|(_, failed)| !**failed);
        let mut never: Vec<String> = failures
            .map(|(f, _)| format!("{} was to fail at {} s: the flight ended before", f.name, f.at))
            .collect();
        let wrenches = self.case.wrenches.iter().filter(|wrench| wrench.from >= end);
        never.extend(
            wrenches.map(|w| {
                format!("a wrench was to act from {} s on: the flight ended before", w.from)
            }),
        );
        for text in never {
            self.say(EventKind::Failure, text);
        }
    }

    /// Say once in a phase that torque or force is missing, and once that the attitude is lost.
    fn tell_missing(&mut self, command: &Command<f64, JOINTS>) {
        let (wanted, missing) = (command.steering.wanted, command.steering.missing);
        for (kind, of, missing, wanted, unit) in [
            (Passed::TorqueMissing, "torque", missing.torque, wanted.torque, "N·m"),
            (Passed::ForceMissing, "force", missing.force, wanted.force, "N"),
        ] {
            let (missing, wanted) = (missing.norm(), wanted.norm());
            if missing > MISSED * wanted && missing > MISSED {
                let text = format!(
                    "the actuators cannot give the {of} that is wanted: {missing:.3} of {wanted:.3} {unit} \
                     missing"
                );
                self.tell_once(kind, text);
            }
        }
        let time = self.world.time();
        if let Some(text) = self.dead_band.note(self.case, command, time).filter(|_| !self.dry) {
            self.tell_once(Passed::DeadBand, text);
        }
        if command.steering.unloading != self.unloads {
            self.unloads = command.steering.unloading;
            let stored = command.steering.stored_B.norm();
            let done = if self.unloads { "begin to empty" } else { "have emptied" };
            let text = format!("thrusters {done} wheels and gyros: {stored:.2} N·m·s are stored");
            self.say(EventKind::Limit, text);
        }
        if let Some(reason) = command.no_relief {
            let text = format!("the posture cannot relieve the base: {reason}");
            self.tell_once(Passed::NoRelief, text);
        }
        if self.sensing.blinded {
            let text = "the base turns too fast for its star tracker".into();
            self.tell_once(Passed::Blinded, text);
        }
        if let Some(estimate) = self.computer.navigation().attitude_estimate() {
            for (passed, text) in self.refusals.note(estimate, self.world.time()) {
                self.tell_once(passed, text);
            }
        }
        let turned = self.turned();
        if self.case.base == BaseAttitude::Controlled && turned > LOST && !self.lost {
            self.lost = true;
            let text = format!(
                "attitude control lost: the base stands {:.2} deg from the attitude it should keep",
                turned.to_degrees()
            );
            self.say(EventKind::Limit, text);
        }
    }

    /// Say which limits the truth passes, each once in a phase.
    fn tell_limits(&mut self, seen: &Observation) {
        for (passed, text) in limits_passed(self.case, seen) {
            self.tell_once(passed, text);
        }
    }

    /// Say something that was not yet said in this phase.
    fn tell_once(&mut self, passed: Passed, text: String) {
        if !self.said_passed.contains(&passed) {
            self.said_passed.push(passed);
            self.say(EventKind::Limit, text);
        }
    }

    /// Grasp or release; why the flight ends, if it is refused.
    fn grip(&mut self, grip: Grip, phase: usize) -> Option<End> {
        let done = match grip {
            Grip::Grasp(i) => self.grasp(i, self.case.phases[phase].grasp_bounds),
            Grip::Release(i) => self.release(i),
        };
        match done {
            Ok(text) => {
                self.say(EventKind::Grip, text);
                self.computer.robot_changed(self.world.robot());
                None
            }
            Err(reason) => {
                let phase = self.case.phases[phase].name.clone();
                Some(End::Stopped { phase, time_s: self.world.time(), reason })
            }
        }
    }

    fn grasp(&mut self, i: usize, (angular, linear): (f64, f64)) -> Result<String, String> {
        let name = &self.case.payloads[i].name;
        let Some(number) = self.floating[i] else {
            return Err(format!("{name} does not float: it is held already"));
        };
        let tool = *self.computer.tool();
        let refused = |r: wrasse_world::GraspRefused| {
            format!(
                "grasp of {name} refused: relative speed {:.4} m/s (at most {linear} m/s), relative \
                 turning speed {:.4} deg/s (at most {:.4} deg/s)",
                r.linear_speed,
                r.angular_speed.to_degrees(),
                angular.to_degrees()
            )
        };
        let change = self.world.grasp(&tool, number, angular, linear).map_err(refused)?;
        self.floating[i] = None;
        self.floating.iter_mut().flatten().filter(|n| **n > number).for_each(|n| *n -= 1);
        self.holding.push(i);
        Ok(format!("grasped {name}: energy changes by {change:.3e} J"))
    }

    fn release(&mut self, i: usize) -> Result<String, String> {
        let name = &self.case.payloads[i].name;
        let Some(number) = self.holding.iter().position(|&held| held == i) else {
            return Err(format!("{name} cannot be released: nobody holds it"));
        };
        self.holding.remove(number);
        self.floating[i] = Some(self.world.release(number));
        Ok(format!("released {name}"))
    }
}
