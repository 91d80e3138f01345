//! A flight under way: a flight computer, what it flies, and what passes between them. Running, planning,
//! sweeps and whoever else looks on are observers of this one loop, or another plant under it.

use crate::case::{Case, StepCase};
use crate::outcome::{End, Event, EventKind};
use crate::plan::{cannot_begin, no_way};
use wrasse_flight::{Command, Condition, FlightComputer, Grip, GripAnswer, Sensed, StepEnd};
use wrasse_hardware::SetPoint;
use wrasse_vehicle::JOINTS;

/// What a flight computer flies: the simulated world, or the vehicle as its own laws believe it to be.
pub trait Plant {
    /// Mission time (s).
    fn time(&self) -> f64;
    /// What the sensors say as a control period begins.
    fn sense(&mut self, computer: &FlightComputer<f64, JOINTS>) -> Sensed<f64, JOINTS>;
    /// Takes the commands of the coming period.
    fn command(&mut self, command: &Command<f64, JOINTS>);
    /// Moves on by one control period under them.
    ///
    /// # Errors
    /// If it cannot: what is no longer finite.
    fn advance(
        &mut self,
        computer: &mut FlightComputer<f64, JOINTS>,
        events: &mut Vec<Event>,
    ) -> Result<(), End>;
    /// Grasps or releases at the end of a period, in the step of this number; what to say of it.
    ///
    /// # Errors
    /// Why it is refused.
    fn grip(
        &mut self,
        grip: Grip,
        phase: usize,
        computer: &mut FlightComputer<f64, JOINTS>,
    ) -> Result<String, String>;
    /// What happens to it as a period begins: failures.
    fn begin(&mut self, _: &mut FlightComputer<f64, JOINTS>, _: &mut Vec<Event>) {}
}

/// One who looks at a flight, and changes nothing of it.
pub trait Observer<P> {
    /// The commands of a period are given, and nothing has moved yet.
    fn commanded(
        &mut self,
        _flight: &Simulation<'_, P>,
        _command: &Command<f64, JOINTS>,
        _events: &mut Vec<Event>,
    ) {
    }
    /// The period is flown; what its command tells the grip is not done yet.
    fn flown(
        &mut self,
        flight: &Simulation<'_, P>,
        command: &Command<f64, JOINTS>,
        events: &mut Vec<Event>,
    );
}

/// Nobody looks.
impl<P> Observer<P> for () {
    fn flown(&mut self, _: &Simulation<'_, P>, _: &Command<f64, JOINTS>, _: &mut Vec<Event>) {}
}

/// A flight computer and what it flies.
#[derive(Debug)]
pub struct Simulation<'a, P> {
    pub(crate) case: &'a Case,
    pub(crate) plant: P,
    pub(crate) computer: FlightComputer<f64, JOINTS>,
    /// Control periods that were flown.
    periods: u64,
    /// The step that the last period belonged to.
    phase: Option<usize>,
    /// What the grip has to say of what it was told last.
    answer: Option<GripAnswer>,
    events: Vec<Event>,
}

impl<'a, P: Plant> Simulation<'a, P> {
    /// At its start.
    pub(crate) fn at_start(
        case: &'a Case,
        plant: P,
        computer: FlightComputer<f64, JOINTS>,
    ) -> Self {
        Self { case, plant, computer, periods: 0, phase: None, answer: None, events: vec![] }
    }

    /// The case that is flown.
    pub fn case(&self) -> &Case {
        self.case
    }

    /// What is flown.
    pub fn plant(&self) -> &P {
        &self.plant
    }

    /// What flies.
    pub fn computer(&self) -> &FlightComputer<f64, JOINTS> {
        &self.computer
    }

    /// Control periods that were flown.
    pub fn periods(&self) -> u64 {
        self.periods
    }

    /// Mission time (s).
    pub fn time(&self) -> f64 {
        self.plant.time()
    }

    /// Whether all steps are done.
    pub fn is_done(&self) -> bool {
        self.computer.done()
    }

    /// The end of a flight that does not come to one.
    pub(crate) fn too_long(&self) -> End {
        let (time_s, phase) = (self.time(), self.phase.and_then(|i| self.case.phases.get(i)));
        let reason =
            format!("the mission is not over after {time_s} s: no mission is planned for longer");
        let phase = phase.map_or(String::new(), |p| p.name.clone());
        End::Stopped { phase, time_s, reason }
    }

    /// What has happened so far, in order.
    pub fn events(&self) -> &[Event] {
        &self.events
    }

    /// One control period: what fails, what the sensors say, what the flight computer says to it, how the
    /// plant moves, and what the grip does in the end.
    ///
    /// # Errors
    /// Why the flight ends before its time.
    pub fn step(&mut self, observer: &mut dyn Observer<P>) -> Result<(), End> {
        let mut events = std::mem::take(&mut self.events);
        let stop = self.step_with(observer, &mut events);
        self.events = events;
        stop
    }

    fn step_with(
        &mut self,
        observer: &mut dyn Observer<P>,
        events: &mut Vec<Event>,
    ) -> Result<(), End> {
        self.plant.begin(&mut self.computer, events);
        let command = self.next_command()?;
        self.phase = Some(command.phase);
        events.extend(command.ended.and_then(|(step, end)| step_ended(self, step, &end)));
        if let Some(step) = command.exhausted.and_then(|number| self.case.phases.get(number)) {
            let most = step.step.attempts.unwrap_or_default();
            let text =
                format!("step {} does not begin again: {most} attempts are used up", step.name);
            events.push(Event { time_s: self.time(), kind: EventKind::Fault, text });
        }
        if let Some(phase) = self.case.phases.get(command.phase).filter(|_| command.begins) {
            let text = format!("phase {}", phase.name);
            events.push(Event { time_s: self.time(), kind: EventKind::Phase, text });
        }
        self.plant.command(&command);
        observer.commanded(self, &command, events);
        self.plant.advance(&mut self.computer, events)?;
        self.periods += 1;
        observer.flown(self, &command, events);
        self.grip(&command, events)
    }

    /// What the flight computer says to what the sensors say.
    fn next_command(&mut self) -> Result<Command<f64, JOINTS>, End> {
        let time_s = self.time();
        let sensed = Sensed { grip: self.answer.take(), ..self.plant.sense(&self.computer) };
        let command =
            self.computer.step(&sensed).map_err(|bad| cannot_begin(self.case, &bad, time_s))?;
        if let Some(what) = not_finite(self.case, &command) {
            let reason = format!("the flight computer asks for what is not finite: {what}");
            return Err(End::Breakdown { time_s, reason });
        }
        Ok(command)
    }

    /// What the command tells the grip. The period before is flown with what was in the grip, by a law
    /// that knows it.
    fn grip(&mut self, command: &Command<f64, JOINTS>, events: &mut Vec<Event>) -> Result<(), End> {
        let (Some(grip), Some(phase)) = (command.grip, self.case.phases.get(command.phase)) else {
            return Ok(());
        };
        let time_s = self.time();
        match self.plant.grip(grip, command.phase, &mut self.computer) {
            Ok(text) => {
                self.answer = Some(GripAnswer::Done);
                events.push(Event { time_s, kind: EventKind::Grip, text });
                Ok(())
            }
            Err(text) if self.computer.handles_faults() => {
                self.answer = Some(GripAnswer::Refused);
                events.push(Event { time_s, kind: EventKind::Grip, text });
                Ok(())
            }
            Err(reason) => Err(End::Stopped { phase: phase.name.clone(), time_s, reason }),
        }
    }
}

/// What to say of the end of a step; nothing where its motion came to its end.
fn step_ended<P: Plant>(
    flight: &Simulation<'_, P>,
    step: usize,
    end: &StepEnd<f64>,
) -> Option<Event> {
    let number = step;
    let StepCase { name, step, .. } = flight.case.phases.get(number)?;
    let (kind, text) = match end {
        StepEnd::Met if step.until == Condition::Done => return None,
        StepEnd::Met => (EventKind::Condition, format!("step {name}: its condition holds")),
        StepEnd::Timeout => {
            let time = step.timeout.unwrap_or_default();
            (EventKind::Fault, format!("step {name}: timeout after {time} s"))
        }
        StepEnd::Refused => (EventKind::Fault, format!("step {name}: the grip was refused")),
        StepEnd::Blocked(reason) => {
            let why = no_way(flight.case, number, reason);
            (EventKind::Fault, format!("step {name} cannot begin: {why}"))
        }
    };
    Some(Event { time_s: flight.time(), kind, text })
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
