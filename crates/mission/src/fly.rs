//! One case flown: the flight computer and the world, a control period at a time.

use crate::limits_passed::{Passed, limits_passed};
use crate::mission::{Case, PayloadStart};
use crate::observe::{Observation, Track, observe};
use crate::outcome::{End, Event, EventKind, Ledger, Snapshot, Telemetry};
use crate::picture::snapshot;
use crate::plan::{Plan, cannot_begin};
use crate::quantity::Watch;
use crate::telemetry::Recorder;
use wrasse_dynamics::{Payload, kinematics};
use wrasse_flight::{Command, FlightComputer, Grip, Sensed};
use wrasse_hardware::{ActuatorCommand, SetPoint, SetPointMotion};
use wrasse_spatial::{Pose, Vec3};
use wrasse_vehicle::JOINTS;
use wrasse_world::{BaseAttitude, Drive, Equipment, Saturation, Stepper, World, WorldSetup};

/// What a flight leaves behind.
#[derive(Debug)]
pub(crate) struct Flown {
    pub(crate) end: End,
    pub(crate) watch: Watch,
    pub(crate) ledger: wrasse_world::Ledger,
    pub(crate) events: Vec<Event>,
    pub(crate) telemetry: Telemetry,
    pub(crate) snapshots: Vec<Snapshot>,
    /// The last thing seen.
    pub(crate) last: Option<Observation>,
}

/// A flight under way.
struct Flight<'a> {
    case: &'a Case,
    world: World<JOINTS>,
    computer: FlightComputer<f64, JOINTS>,
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
    let tool = flight.world.pose(flight.computer.tool()).translation;
    snapshots.push(snapshot(case, &flight.world, &flight.payload_poses(), [tool; 2]));
    for period in 0..plan.periods {
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
        let seen = observe(case, &flight.world, &flight.computer, &command, &track);
        flight.tell_limits(&seen);
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
    Flown {
        end,
        watch,
        ledger,
        events: flight.events,
        telemetry: recorder.finish(),
        snapshots,
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
        let held = case.held_at_start();
        let mut world = World::new(&WorldSetup {
            robot: &case.vehicle.robot,
            limits: &case.vehicle.limits,
            actuator: case.vehicle.attitude_actuator,
            equipment: Equipment::default(),
            base: case.base,
            stepper,
            start: case.start,
            held: &held,
        });
        // Prescribed joints keep their rates from the first instant on.
        let (start, period) = (case.start, case.period());
        let drives: [Drive; JOINTS] = core::array::from_fn(|j| {
            let at = |t: f64| SetPoint {
                position: start.q[j] + start.v[j] * t,
                rate: start.v[j],
                acceleration: 0.0,
            };
            if case.torque[j] {
                return Drive::Effort(0.0);
            }
            Drive::Follow(SetPointMotion::between(at(0.0), at(period), period))
        });
        world.command(&drives, Vec3::zero(), &ActuatorCommand::default(), period);
        let floating = case.payloads.iter().enumerate().map(|(i, p)| match p.start {
            PayloadStart::Held(_) => None,
            PayloadStart::Free(..) => Some(world.add_free_body(case.free_body(i))),
        });
        let floating = floating.collect();
        let is_held = |i: &usize| matches!(case.payloads[*i].start, PayloadStart::Held(_));
        let holding = (0..case.payloads.len()).filter(is_held).collect();
        let start = |j: usize| SetPoint {
            position: case.start.q[j],
            rate: case.start.v[j],
            acceleration: 0.0,
        };
        Self {
            case,
            computer: FlightComputer::new(case.setup, world.robot(), &case.flight_phases()),
            world,
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

    /// What the flight computer says to what the sensors say. The sensors are perfect.
    fn command(&mut self) -> Result<Command<f64, JOINTS>, End> {
        let sensed = Sensed { state: self.world.state() };
        let time = self.world.time();
        // What the planning let pass, the truth may still refuse: by then things have moved.
        self.computer.step(&sensed).map_err(|bad| match cannot_begin(self.case, &bad, time) {
            End::Infeasible { phase, time_s, reason } => End::Stopped { phase, time_s, reason },
            end => end,
        })
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
        let cut = self.world.command(
            &drives,
            command.attitude_torque_B,
            &ActuatorCommand::default(),
            period,
        );
        for saturation in cut {
            if !self.said.contains(&saturation) {
                self.said.push(saturation);
                let text = self.describe(saturation);
                self.say(EventKind::Limit, text);
            }
        }
        let broken = self.world.advance(period).err()?;
        let quantity = match broken.joint {
            Some(j) => format!("position or rate of joint {}", self.case.joint_name(j)),
            None => broken.quantity,
        };
        Some(End::Breakdown {
            time_s: broken.time,
            reason: format!("{quantity} is no longer finite"),
        })
    }

    /// Say which limits the truth passes, each once in a phase.
    fn tell_limits(&mut self, seen: &Observation) {
        for (passed, text) in limits_passed(self.case, seen) {
            if !self.said_passed.contains(&passed) {
                self.said_passed.push(passed);
                self.say(EventKind::Limit, text);
            }
        }
    }

    fn describe(&self, saturation: Saturation) -> String {
        let axis = |i: usize| ["x", "y", "z"][i.min(2)];
        match saturation {
            Saturation::JointEffort(j) => {
                let limit = self.case.vehicle.limits[j].effort.unwrap_or(f64::NAN);
                let limit = self.case.effort_text(j, limit);
                format!("drive of joint {} at its limit of {limit}", self.case.joint_name(j))
            }
            Saturation::ActuatorTorque(i) => {
                let limit =
                    self.case.vehicle.attitude_actuator.map_or(f64::NAN, |a| a.torque_limit);
                format!("attitude actuator at its torque limit of {limit} N·m about {}", axis(i))
            }
            Saturation::ActuatorMomentum(i) => {
                let limit =
                    self.case.vehicle.attitude_actuator.map_or(f64::NAN, |a| a.momentum_limit);
                format!("attitude actuator full: {limit} N·m·s about {}", axis(i))
            }
            Saturation::WheelTorque(i) => format!("motor of wheel {i} at its torque limit"),
            Saturation::WheelSpeed(i) => format!("wheel {i} at its speed limit"),
            Saturation::GimbalRate(i) => format!("gimbal {i} at its rate limit"),
            Saturation::GimbalMotor(i) => format!("motor of gimbal {i} at its torque limit"),
            Saturation::PulseTooShort(i) => {
                format!("thruster {i} stays shut: the pulse is shorter than it can be")
            }
            Saturation::TankEmpty => "thrusters stay shut: the tank is empty".to_string(),
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

/// The books in the form that is reported.
pub(crate) fn ledger(books: &wrasse_world::Ledger, base: BaseAttitude) -> Ledger {
    // Momentum is exact where it is the state; where the attitude is held its torque is a quadrature
    // of the same order as the integration, and so is all work.
    let bounds = match base {
        BaseAttitude::Held => [1e-6, 1e-11, 1e-6],
        BaseAttitude::Controlled | BaseAttitude::Free => [1e-11, 1e-11, 1e-6],
    };
    let holds = |i: usize| books.worst[i] <= bounds[i] * books.scale[i] + f64::MIN_POSITIVE;
    let [work_of_joints, work_of_actuator, work_from_outside] = books.work.to_array();
    Ledger {
        angular_start: books.start.angular.to_array(),
        angular_end: books.now.angular.to_array(),
        angular_from_actuator: books.angular_from_actuator.to_array(),
        angular_from_outside: books.angular_from_outside.to_array(),
        angular_rest: books.worst[0],
        angular_scale: books.scale[0],
        linear_start: books.start.linear.to_array(),
        linear_end: books.now.linear.to_array(),
        linear_from_outside: books.linear_from_outside.to_array(),
        linear_rest: books.worst[1],
        linear_scale: books.scale[1],
        energy_start: books.start.energy,
        energy_end: books.now.energy,
        work_of_joints,
        work_of_actuator,
        work_from_outside,
        energy_at_grasps: books.energy_at_grasps,
        energy_rest: books.worst[2],
        energy_scale: books.scale[2],
        closes: (0..3).all(holds),
        bounds,
    }
}
