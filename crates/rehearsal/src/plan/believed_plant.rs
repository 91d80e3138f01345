//! The vehicle as its own laws believe it to be, as a plant: what is planned is flown on it.

use crate::case::{Case, PayloadStart};
use crate::case_world::fuelled;
use crate::gripping::refusal;
use crate::outcome::{End, Event};
use crate::simulation::{Plant, Simulation};
use wrasse_dynamics::{Frame, MassProperties, State, kinematics};
use wrasse_flight::{Actuation, Command, FlightComputer, Grip, Sensed};
use wrasse_hardware::ActuatorReadings;
use wrasse_vehicle::{JOINTS, VehicleRobot};
use wrasse_world::{FreeBody, GripOffset};

/// The vehicle as the laws believe it to be, and the bodies beside it.
pub(crate) struct BelievedPlant<'a> {
    case: &'a Case,
    periods: u64,
    state: State<f64, JOINTS>,
    /// With propellant, and nothing in its grips.
    alone: VehicleRobot,
    held: Vec<(usize, Frame<f64>, MassProperties<f64>)>,
    free: Vec<Option<FreeBody>>,
}

/// A case at its start, in the laws' own belief.
pub(crate) fn believed_flight(case: &Case) -> Simulation<'_, BelievedPlant<'_>> {
    // The laws believe in a base that does as it is told: nobody has to be steered.
    let mut setup = case.setup;
    (setup.base.actuation, setup.base.position_hold) = (Actuation::Ideal(None), None);
    let plant = BelievedPlant::new(case);
    let computer = FlightComputer::new(setup, &plant.robot(), &case.steps()).planning();
    Simulation::at_start(case, plant, computer)
}

impl<'a> BelievedPlant<'a> {
    fn new(case: &'a Case) -> Self {
        let held = case.payloads.iter().enumerate().filter_map(|(i, p)| match p.start {
            PayloadStart::Held(frame) => Some((i, frame, case.believed_matter(i))),
            PayloadStart::Free(..) => None,
        });
        let free = case.payloads.iter().enumerate().map(|(i, p)| match p.start {
            PayloadStart::Free(..) => Some(case.free_body(i, case.believed_matter(i))),
            PayloadStart::Held(_) => None,
        });
        Self {
            case,
            periods: 0,
            state: case.start,
            alone: fuelled(case),
            held: held.collect(),
            free: free.collect(),
        }
    }

    /// Where it is believed to be.
    pub(crate) fn state(&self) -> &State<f64, JOINTS> {
        &self.state
    }

    /// The vehicle with the payloads in its grips.
    fn robot(&self) -> VehicleRobot {
        let held = self.held.iter();
        held.fold(self.alone, |robot, (_, frame, matter)| robot.with_payload(frame, matter))
    }

    /// Takes a payload; whether it is there to be grasped at all, the flight says.
    fn grasp(
        &mut self,
        tool: Frame<f64>,
        i: usize,
        most: Option<GripOffset>,
    ) -> Result<(), String> {
        let (Some(body), Some(most)) = (self.free[i].take(), most) else { return Ok(()) };
        let robot = self.robot();
        let k = kinematics(&robot, &self.state);
        let found = GripOffset::of(&k, &tool, &body);
        if !found.is_within(&most) {
            let (payload, tool) = (&self.case.payloads[i].name, self.case.frame_name(&tool));
            return Err(refusal(payload, tool, &found, &most));
        }
        let X_FT = k.pose(&tool).inverse() * body.pose();
        let at = Frame { body: tool.body, X_BF: tool.X_BF * X_FT };
        self.held.push((i, at, body.matter));
        Ok(())
    }

    /// Lets go of a payload, if it is held.
    fn release(&mut self, i: usize) {
        let Some(number) = self.held.iter().position(|(held, ..)| *held == i) else { return };
        let robot = self.robot();
        let (_, frame, matter) = self.held.remove(number);
        let k = kinematics(&robot, &self.state);
        let V_NF_F = frame.X_BF.velocity_to_child(&k.V_NB_B(frame.body));
        self.free[i] = Some(FreeBody::new(matter, &k.pose(&frame), &V_NF_F));
    }
}

impl Plant for BelievedPlant<'_> {
    fn time(&self) -> f64 {
        self.case.period() * self.periods as f64
    }

    fn sense(&mut self, _: &FlightComputer<f64, JOINTS>) -> Sensed<f64, JOINTS> {
        Sensed::perfect(&self.state, ActuatorReadings::default())
    }

    fn command(&mut self, _: &Command<f64, JOINTS>) {}

    fn advance(
        &mut self,
        computer: &mut FlightComputer<f64, JOINTS>,
        _: &mut Vec<Event>,
    ) -> Result<(), End> {
        let period = self.case.period();
        self.free.iter_mut().flatten().for_each(|body| body.step(period));
        self.state = computer.believed_state();
        self.periods += 1;
        Ok(())
    }

    fn grip(
        &mut self,
        grip: Grip,
        phase: usize,
        computer: &mut FlightComputer<f64, JOINTS>,
    ) -> Result<String, String> {
        match grip {
            Grip::Grasp(i) => {
                self.grasp(*computer.gripping_tool(), i, self.case.phases[phase].grasp_bounds)?;
            }
            Grip::Release(i) => self.release(i),
        }
        computer.robot_changed(&self.robot());
        Ok(String::new())
    }
}
