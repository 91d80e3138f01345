//! A flight under way: the flight computer and the world, and what passes between them.

use crate::case_world::{CaseWorld, believed_alone};
use crate::dead_band::DeadBand;
use crate::limits_passed::Passed;
use crate::mission::Case;
use crate::outcome::{End, Event, EventKind};
use crate::overlap::Overlap;
use crate::plan::cannot_begin;
use crate::read_base::Turning;
use crate::saturations::{EquipmentLimits, describe};
use crate::sensing::{Refusals, Sensing};
use wrasse_flight::{Command, FlightComputer};
use wrasse_hardware::{CMGS, SetPoint, SetPointMotion, THRUSTERS, WHEELS};
use wrasse_spatial::{Quat, Vec3};
use wrasse_vehicle::{JOINTS, VehicleRobot};
use wrasse_world::{Drive, Saturation, Stepper};

/// Most limits that can cut the commands of a period: efforts, an ideal actuator's torque and momentum,
/// wheels' and CMGs' two limits each, thrusters and their tank.
const LIMITS: usize = JOINTS + 6 + 2 * WHEELS + 2 * CMGS + THRUSTERS + 1;

/// Share of the vehicle's mass whose loss as propellant the flight computer is told of.
const NOTICED: f64 = 1e-4;

/// A flight under way.
#[allow(clippy::struct_excessive_bools, reason = "each is a fact of its own")]
pub(crate) struct Flight<'a> {
    pub(crate) case: &'a Case,
    /// Whether it tells what happens beside what ends it.
    pub(crate) telling: bool,
    pub(crate) world: CaseWorld,
    pub(crate) computer: FlightComputer<f64, JOINTS>,
    pub(crate) sensing: Sensing,
    pub(crate) refusals: Refusals,
    pub(crate) limits: EquipmentLimits,
    pub(crate) dead_band: DeadBand,
    /// For each failure: whether it has happened, and whether the computer was told.
    pub(crate) failed: Vec<bool>,
    pub(crate) told: Vec<bool>,
    /// Propellant when the computer was last told (kg).
    pub(crate) weighed: f64,
    /// Whether the tank was said to be empty.
    pub(crate) dry: bool,
    /// Whether the attitude was lost.
    pub(crate) lost: bool,
    /// Whether thrusters empty wheels and CMGs.
    pub(crate) unloads: bool,
    /// Angle of the estimated attitude from the true one (rad); NaN where nothing is estimated.
    pub(crate) estimate_error: f64,
    /// The vehicle that the computer believes in, with nothing in its grips and tank, where its masses
    /// are otherwise in truth.
    pub(crate) believed_alone: Option<VehicleRobot>,
    /// What limits cut in this period.
    pub(crate) cut: Vec<Saturation>,
    pub(crate) set_points: [SetPoint<f64>; JOINTS],
    /// The phase that the last period belonged to.
    phase: Option<usize>,
    /// What was already said of the current phase.
    pub(crate) said: Vec<Saturation>,
    pub(crate) said_passed: Vec<Passed>,
    /// Tool and loads that were found inside the bus.
    pub(crate) overlaps: Vec<Overlap>,
    pub(crate) events: Vec<Event>,
}

impl<'a> Flight<'a> {
    /// A flight at its start; `telling`: it notes what a report says of it.
    pub(crate) fn new(case: &'a Case, stepper: Stepper, telling: bool) -> Self {
        let world = CaseWorld::new(case, stepper);
        let start = |j: usize| SetPoint {
            position: case.start.q[j],
            rate: case.start.v[j],
            acceleration: 0.0,
        };
        let believed_alone = case.believed.is_some().then(|| believed_alone(case));
        let computer = FlightComputer::new(case.setup, world.robot(), &case.flight_phases());
        let mut flight = Self {
            case,
            telling,
            computer,
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
            believed_alone,
            cut: Vec::with_capacity(LIMITS),
            set_points: core::array::from_fn(start),
            phase: None,
            said: vec![],
            said_passed: vec![],
            overlaps: vec![],
            events: vec![],
        };
        if case.believed.is_some() {
            let believed = flight.believed_robot();
            flight.computer = FlightComputer::new(case.setup, &believed, &case.flight_phases());
        }
        flight
    }

    pub(crate) fn say(&mut self, kind: EventKind, text: String) {
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
        let quat_NB = self.world.quat_NB();
        let time = self.world.time();
        // What the planning let pass, the truth may still refuse: by then things have moved.
        let command = self.computer.step(&sensed).map_err(|bad| {
            match cannot_begin(self.case, &bad, time) {
                End::Infeasible { phase, time_s, reason } => End::Stopped { phase, time_s, reason },
                end => end,
            }
        })?;
        if let Some(what) = not_finite(self.case, &command) {
            let reason = format!("the flight computer asks for what is not finite: {what}");
            return Err(End::Breakdown { time_s: time, reason });
        }
        let estimate = self.computer.navigation().attitude_estimate();
        self.estimate_error =
            estimate.map_or(f64::NAN, |e| (e.quat_NB.conjugate() * quat_NB).log().norm());
        Ok(command)
    }

    /// The next control period: what fails, what the flight computer says to it, and the world's answer.
    pub(crate) fn next_period(&mut self) -> Result<Command<f64, JOINTS>, End> {
        self.break_what_breaks();
        let command = self.command()?;
        if self.phase.replace(command.phase) != Some(command.phase) {
            self.enter(command.phase);
        }
        self.period(&command).map_or(Ok(command), Err)
    }

    /// One control period of the world; why the flight ends, if it does.
    fn period(&mut self, command: &Command<f64, JOINTS>) -> Option<End> {
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
        let told = &command.actuators;
        self.world.command((&drives, torque_B), told, period, &mut self.cut);
        if self.telling {
            self.tell_cut(command);
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
        if self.case.equipment.actuators.tank.is_none() {
            return;
        }
        let left = self.world.actuator_readings().propellant;
        if left <= 0.0 && !self.dry && self.thrusters_act() {
            self.dry = true;
            let text = describe(self.case, Saturation::TankEmpty);
            self.say(EventKind::Limit, text);
        }
        if (self.weighed - left).abs() > NOTICED * self.world.robot().mass() {
            self.weighed = left;
            let believed = self.believed_robot();
            self.computer.robot_changed(&believed);
        }
    }

    /// Whether there are thrusters that are told anything, or that something opens.
    fn thrusters_act(&self) -> bool {
        let fitted = &self.case.equipment.actuators;
        let used = fitted.tank.is_some_and(|tank| tank.propellant > 0.0);
        !fitted.thrusters.is_empty() && (used || self.case.turning == Turning::Fitted)
    }

    /// Angle of the base from the attitude that it began with (rad).
    pub(crate) fn turned(&self) -> f64 {
        let start = Quat::from_matrix(&self.case.start.X_NB.rotation);
        (start.conjugate() * self.world.quat_NB()).log().norm()
    }

    /// Let units fail whose time has come, and tell the computer of those that it is told of.
    pub(crate) fn break_what_breaks(&mut self) {
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
                self.computer.disable(failure.unit);
                let text = format!("the flight computer is told to do without {}", failure.name);
                self.say(EventKind::Failure, text);
            }
        }
    }
}

/// What of a command is not finite, if anything: no actuator can be told it.
fn not_finite(case: &Case, command: &Command<f64, JOINTS>) -> Option<String> {
    let is_bad = |x: &f64| !x.is_finite();
    for j in case.vehicle.robot.joints() {
        let SetPoint { position, rate, acceleration } = command.set_points[j];
        let name = case.joint_name(j);
        if is_bad(&command.effort[j]) {
            return Some(format!("the effort of joint {name}"));
        }
        if [position, rate, acceleration].iter().any(is_bad) {
            return Some(format!("the set-point of joint {name}"));
        }
    }
    let (told, wanted) = (&command.actuators, &command.allocation.wanted);
    [
        ("the torque on the base", &command.attitude_torque_B.to_array()[..]),
        ("the torque of the steering", &wanted.torque.to_array()),
        ("the force of the steering", &wanted.force.to_array()),
        ("the torque of a wheel", &told.wheel_torque),
        ("the rate of a gimbal", &told.gimbal_rate),
        ("the time that a thruster is open", &told.thruster_on),
    ]
    .into_iter()
    .find(|(_, numbers)| numbers.iter().any(is_bad))
    .map(|(what, _)| what.to_owned())
}
