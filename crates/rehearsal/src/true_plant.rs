//! The simulated world as a plant: its scene, its sensors, what fails in it, and its ledger.

use crate::case::{AttitudeActuation, Case};
use crate::case_world::{CaseWorld, believed_alone};
use crate::notices::saturations::describe;
use crate::outcome::{End, Event, EventKind};
use crate::sensing::Sensing;
use crate::simulation::{Plant, Simulation};
use wrasse_dynamics::{BodyId, Frame, MassProperties};
use wrasse_flight::{Command, FlightComputer, Grip, Sensed};
use wrasse_hardware::{ActuatorReadings, CMGS, SetPoint, SetPointMotion, THRUSTERS, WHEELS};
use wrasse_spatial::{Pose, Quat, Sym3, Vec3};
use wrasse_vehicle::{JOINTS, VehicleRobot};
use wrasse_world::{Drive, Ledger, Saturation, Stepper};

/// Most limits that can cut the commands of a period: efforts, an ideal actuator's torque and momentum,
/// wheels' and CMGs' two limits each, thrusters and their tank.
const LIMITS: usize = JOINTS + 6 + 2 * WHEELS + 2 * CMGS + THRUSTERS + 1;

/// Share of the vehicle's mass whose loss as propellant the flight computer is told of.
const NOTICED: f64 = 1e-4;

/// The simulated world of a case.
#[derive(Debug)]
pub struct TruePlant<'a> {
    pub(crate) case: &'a Case,
    pub(crate) world: CaseWorld,
    pub(crate) sensing: Sensing,
    pub(crate) ledger: Ledger,
    /// For each failure: whether it has happened, and whether the computer was told.
    pub(crate) failed: Vec<bool>,
    told: Vec<bool>,
    /// Propellant when the computer was last told (kg).
    weighed: f64,
    /// Whether the tank was found empty.
    pub(crate) is_dry: bool,
    /// The vehicle that the computer believes in, with nothing in its grips and tank, where its masses
    /// are otherwise in truth.
    believed_alone: Option<VehicleRobot>,
    /// What limits cut of the commands of this period.
    pub(crate) cut: Vec<Saturation>,
    set_points: [SetPoint<f64>; JOINTS],
}

impl<'a> Simulation<'a, TruePlant<'a>> {
    /// A case at its start, in its world.
    pub fn new(case: &'a Case) -> Self {
        Self::with_stepper(case, case.stepper)
    }

    /// The same with another integrator than the case names.
    pub fn with_stepper(case: &'a Case, stepper: Stepper) -> Self {
        let plant = TruePlant::new(case, stepper);
        let robot = plant.believed_robot();
        let computer = FlightComputer::new(case.setup, &robot, &case.steps());
        Self::at_start(case, plant, computer)
    }

    /// Angle of the estimated attitude from the true one (rad); NaN where nothing is estimated.
    pub(crate) fn estimate_error(&self) -> f64 {
        let estimate = self.computer.navigation().attitude_estimate();
        estimate.map_or(f64::NAN, |e| {
            (e.quat_NB.conjugate() * self.plant.sensing.sensed_at).log().norm()
        })
    }
}

impl<'a> TruePlant<'a> {
    fn new(case: &'a Case, stepper: Stepper) -> Self {
        let world = CaseWorld::new(case, stepper);
        let start = |j: usize| SetPoint {
            position: case.start.q[j],
            rate: case.start.v[j],
            acceleration: 0.0,
        };
        Self {
            case,
            sensing: Sensing::new(case),
            ledger: world.open_ledger(),
            world,
            failed: vec![false; case.failures.len()],
            told: vec![false; case.failures.len()],
            weighed: case.equipment.actuators.tank.map_or(0.0, |tank| tank.propellant),
            is_dry: false,
            believed_alone: case.believed.is_some().then(|| believed_alone(case)),
            cut: Vec::with_capacity(LIMITS),
            set_points: core::array::from_fn(start),
        }
    }

    /// Momentum and energy so far, and who changed them.
    pub fn ledger(&self) -> &Ledger {
        &self.ledger
    }

    /// What wheels, CMGs, thrusters and tank say of themselves.
    pub fn actuator_readings(&self) -> ActuatorReadings<f64> {
        self.world.actuator_readings()
    }

    /// The vehicle with what it holds and its propellant, as the flight computer believes it to be: the
    /// true one unless masses are otherwise than it knows.
    pub(crate) fn believed_robot(&self) -> VehicleRobot {
        let Some(alone) = self.believed_alone else { return *self.world.rigid_robot() };
        let fed = match self.case.equipment.actuators.tank {
            Some(tank) => {
                let left = self.world.actuator_readings().propellant;
                let base = Frame { body: BodyId::Base, X_BF: Pose::identity() };
                alone.with_payload(
                    &base,
                    &MassProperties::from_central(left, tank.position_B, Sym3::zero()),
                )
            }
            None => alone,
        };
        self.world.held().fold(fed, |robot, (i, held)| {
            robot.with_payload(&held.frame, &self.case.believed_matter(i))
        })
    }

    /// Angle of the base from the attitude that it began with (rad).
    pub(crate) fn turned(&self) -> f64 {
        let start = Quat::from_matrix(&self.case.start.X_NB.rotation);
        (start.conjugate() * self.world.quat_NB()).log().norm()
    }

    /// Tell the computer what it is made of once enough propellant has gone: its gauge says so.
    fn weigh_propellant(
        &mut self,
        computer: &mut FlightComputer<f64, JOINTS>,
        events: &mut Vec<Event>,
    ) {
        if self.case.equipment.actuators.tank.is_none() {
            return;
        }
        let left = self.world.actuator_readings().propellant;
        if left <= 0.0 && !self.is_dry && self.thrusters_act() {
            self.is_dry = true;
            let text = describe(self.case, Saturation::TankEmpty);
            events.push(Event { time_s: self.time(), kind: EventKind::Limit, text });
        }
        if (self.weighed - left).abs() > NOTICED * self.world.robot().mass() {
            self.weighed = left;
            computer.robot_changed(&self.believed_robot());
        }
    }

    /// Whether there are thrusters that are told anything, or that something opens.
    fn thrusters_act(&self) -> bool {
        let fitted = &self.case.equipment.actuators;
        let used = fitted.tank.is_some_and(|tank| tank.propellant > 0.0);
        let is_fitted = self.case.actuation == AttitudeActuation::Fitted;
        !fitted.thrusters.is_empty() && (used || is_fitted)
    }
}

impl Plant for TruePlant<'_> {
    fn time(&self) -> f64 {
        self.world.time()
    }

    /// Lets units fail whose time has come, and tells the computer of those that it is told of.
    fn begin(&mut self, computer: &mut FlightComputer<f64, JOINTS>, events: &mut Vec<Event>) {
        // To within the rounding of a sum of periods.
        let (time_s, now) = (self.time(), self.time() + 1e-9);
        let due = |at: f64, already: bool| !already && at <= now;
        let mut say = |text| events.push(Event { time_s, kind: EventKind::Failure, text });
        for (i, failure) in self.case.failures.iter().enumerate() {
            if due(failure.at, self.failed[i]) {
                self.failed[i] = true;
                self.world.fail(failure.breaks);
                say(format!("{} fails: {}", failure.name, failure.how));
            }
            if due(failure.told_at.unwrap_or(f64::INFINITY), self.told[i]) {
                self.told[i] = true;
                computer.disable(failure.unit);
                say(format!("the flight computer is told to do without {}", failure.name));
            }
        }
    }

    fn sense(&mut self, computer: &FlightComputer<f64, JOINTS>) -> Sensed<f64, JOINTS> {
        self.sensing.read(self.case, &self.world, computer.tool())
    }

    fn command(&mut self, command: &Command<f64, JOINTS>) {
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
        let torque_B = match self.case.actuation {
            AttitudeActuation::Ideal(_) => command.attitude_torque_B,
            AttitudeActuation::Fitted => Vec3::zero(),
        };
        self.world.command((&drives, torque_B), &command.actuators, period, &mut self.cut);
    }

    fn advance(
        &mut self,
        computer: &mut FlightComputer<f64, JOINTS>,
        events: &mut Vec<Event>,
    ) -> Result<(), End> {
        let broken = self.world.advance(self.case.period());
        self.weigh_propellant(computer, events);
        let Err(broken) = broken else {
            self.world.update_ledger(&mut self.ledger);
            return Ok(());
        };
        let quantity = match broken.joint {
            Some(j) => format!("position or rate of joint {}", self.case.joint_name(j)),
            None => broken.quantity,
        };
        let reason = format!("{quantity} is no longer finite");
        Err(End::Breakdown { time_s: broken.time, reason })
    }

    fn grip(
        &mut self,
        grip: Grip,
        phase: usize,
        computer: &mut FlightComputer<f64, JOINTS>,
    ) -> Result<String, String> {
        let text = match grip {
            Grip::Grasp(i) => {
                let tool = *computer.gripping_tool();
                self.grasp(&tool, i, self.case.phases[phase].grasp_bounds)?
            }
            Grip::Release(i) => self.release(i)?,
        };
        computer.robot_changed(&self.believed_robot());
        self.world.update_ledger(&mut self.ledger);
        Ok(text)
    }
}
