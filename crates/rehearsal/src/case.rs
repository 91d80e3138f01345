//! A case: what is flown, in plain data.

use crate::applied_wrench::AppliedWrench;
use crate::case_world::fuelled;
use crate::samples::dispersion::Dispersion;
use crate::signals::quantity::Quantity;
use crate::signals::requirement::Requirement;
use serde::Serialize;
use std::sync::Arc;
use wrasse_dynamics::{Frame, JointKind, MassProperties, State};
use wrasse_flight::allocation::Unit;
use wrasse_flight::{Phase, Setup, Step};
use wrasse_hardware::{AttitudeActuator, Sensors};
use wrasse_spatial::{Pose, SpatialVelocity};
use wrasse_vehicle::{Equipment, JOINTS, Vehicle, VehicleRobot};
use wrasse_world::{BaseAttitude, Environment, Failure, FreeBody, GripOffset, Stepper};

/// One thing to run.
#[derive(Debug, Clone)]
pub struct Case {
    /// (axis, row) of each comparison.
    pub labels: Vec<(String, String)>,
    /// The vehicle, checked.
    pub vehicle: Arc<Vehicle>,
    /// As the mission names it.
    pub vehicle_name: String,
    /// State of the vehicle at the start.
    pub start: State<f64, JOINTS>,
    /// Bodies that can be held.
    pub payloads: Vec<PayloadCase>,
    /// What becomes of the base's attitude.
    pub base: BaseAttitude,
    /// What turns the base where it is controlled.
    pub actuation: AttitudeActuation,
    /// Wheels, CMGs and thrusters.
    pub equipment: Equipment,
    /// Imperfect sensors, if there are any.
    pub sensors: Option<Sensors<f64>>,
    /// Whether the tool has a force-torque sensor.
    pub measures_wrench: bool,
    /// Units that fail on the way.
    pub failures: Vec<FailureCase>,
    /// What surrounds the vehicle.
    pub environment: Environment,
    /// What pushes from outside.
    pub wrenches: Vec<AppliedWrench>,
    /// Seed of everything random.
    pub seed: u64,
    /// The integrator.
    pub stepper: Stepper,
    /// Which joints are driven by torque.
    pub torque: [bool; JOINTS],
    /// How the flight computer is set up.
    pub setup: Setup<f64, JOINTS>,
    /// What happens.
    pub phases: Vec<StepCase>,
    /// What a sample of a sweep draws anew.
    pub dispersions: Vec<Dispersion>,
    /// What the flight computer takes the masses for, where they are otherwise.
    pub believed: Option<Box<Believed>>,
    /// What must hold.
    pub requirements: Vec<Requirement>,
    /// The quantities that can be required.
    pub quantities: Vec<Quantity>,
    /// Samples per second in the telemetry.
    pub output_rate: f64,
    /// Instants in the drawing.
    pub snapshots: u32,
    /// Laws and world as they are flown.
    pub as_flown: Vec<Setting>,
}

/// What turns a controlled base.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum AttitudeActuation {
    /// An ideal actuator, within limits if it has them.
    Ideal(Option<AttitudeActuator<f64>>),
    /// Wheels, CMGs and thrusters.
    Fitted,
}

/// A setting of laws or world.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Setting {
    /// Its key in a mission file: `control.arm_law`.
    pub key: String,
    /// Its value, in the unit of the key.
    pub value: String,
    /// Whence: `mission file`, `default`, `tank and fill level` or `tool and phase`.
    pub origin: &'static str,
}

/// Mass properties in the flight computer's belief.
#[derive(Debug, Clone)]
pub struct Believed {
    /// The vehicle with nothing in its grips and tank.
    pub robot: VehicleRobot,
    /// The payloads.
    pub matters: Vec<MassProperties<f64>>,
}

/// A unit that fails on the way.
#[derive(Debug, Clone)]
pub struct FailureCase {
    /// Its name.
    pub name: String,
    /// In which way, in a word.
    pub how: String,
    /// The unit.
    pub unit: Unit,
    /// What becomes of it.
    pub breaks: Failure,
    /// When it fails (s).
    pub at: f64,
    /// When the flight computer is told (s); never without one.
    pub told_at: Option<f64>,
}

/// A payload and where it is at the start.
#[derive(Debug, Clone)]
pub struct PayloadCase {
    /// Its name.
    pub name: String,
    /// Its mass properties, about its grip.
    pub matter: MassProperties<f64>,
    /// Where it is at the start.
    pub start: PayloadStart,
    /// Edges for drawings (m), centred on the centre of mass.
    pub box_m: Option<[f64; 3]>,
}

/// Where a payload is at the start.
#[derive(Debug, Clone, Copy)]
pub enum PayloadStart {
    /// Held in this frame.
    Held(Frame<f64>),
    /// Floating: pose `X_NT` and twist `V_NT_T`.
    Free(Pose<f64>, SpatialVelocity<f64>),
}

/// A step and what the mission knows of it beyond the flight computer.
#[derive(Debug, Clone)]
pub struct StepCase {
    /// Its name.
    pub name: String,
    /// What is done in it, until when, and what comes next.
    pub step: Step<f64, JOINTS>,
    /// What a grasp allows between tool and grip; nothing where the step is none.
    pub grasp_bounds: Option<GripOffset>,
}

impl StepCase {
    /// What the first arm does.
    pub fn motion(&self) -> Option<&Phase<f64, JOINTS>> {
        self.step.tasks().next().map(|task| &task.motion)
    }

    /// The same step with another motion of the first arm.
    pub(crate) fn set_motion(&mut self, motion: &Phase<f64, JOINTS>) {
        if let Some(task) = self.step.tasks.iter_mut().flatten().next() {
            task.motion = *motion;
        }
    }
}

impl Case {
    /// The ideal actuator that turns the base, where it has limits.
    pub fn ideal_actuator(&self) -> Option<AttitudeActuator<f64>> {
        match self.actuation {
            AttitudeActuation::Ideal(actuator) if self.base == BaseAttitude::Controlled => actuator,
            AttitudeActuation::Ideal(_) | AttitudeActuation::Fitted => None,
        }
    }
    /// The name of a frame that a phase guides: that of the tool there, or of a link.
    pub fn frame_name(&self, frame: &Frame<f64>) -> &str {
        let vehicle = &self.vehicle;
        let here = || vehicle.frames.iter().filter(|named| named.frame == *frame);
        let tool = here().find(|named| vehicle.tools.contains(&named.name));
        tool.or_else(|| here().next()).map_or("of the base", |named| named.name.as_str())
    }
    /// The tools of a phase, in words: those of its tasks, or that of the laws.
    pub(crate) fn tools_of(&self, phase: usize) -> String {
        let tasks = self.phases.get(phase).into_iter().flat_map(|phase| phase.step.tasks());
        let each = tasks.map(|task| task.assignment.unwrap_or(self.setup.assignment).tool);
        let names: Vec<_> = each.map(|tool| self.frame_name(&tool).to_owned()).collect();
        names.join(" or ")
    }
    /// Control period (s).
    pub fn period(&self) -> f64 {
        self.setup.tuning.period
    }
    /// Control periods from one telemetry sample to the next.
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "rounded, at least 1"
    )]
    pub fn periods_per_sample(&self) -> u64 {
        (1.0 / (self.output_rate * self.period())).round().max(1.0) as u64
    }
    /// The vehicle as the flight computer believes it to be, with nothing in its grips and tank.
    pub fn believed_robot(&self) -> &VehicleRobot {
        self.believed.as_ref().map_or(&self.vehicle.robot, |believed| &believed.robot)
    }
    /// A payload as the flight computer believes it to be.
    pub fn believed_matter(&self, payload: usize) -> MassProperties<f64> {
        let believed = self.believed.as_ref().and_then(|believed| believed.matters.get(payload));
        believed.copied().unwrap_or(self.payloads[payload].matter)
    }
    /// The robot that the flight computer believes in, with what it holds from the start, and with its
    /// propellant.
    pub fn robot_at_start(&self) -> VehicleRobot {
        let held = self.payloads.iter().enumerate().filter_map(|(i, p)| match p.start {
            PayloadStart::Held(frame) => Some((frame, self.believed_matter(i))),
            PayloadStart::Free(..) => None,
        });
        held.fold(fuelled(self), |robot, (frame, matter)| robot.with_payload(&frame, &matter))
    }
    /// Payloads held from the start.
    pub fn held_at_start(&self) -> Vec<(Frame<f64>, MassProperties<f64>)> {
        let held = self.payloads.iter().filter_map(|p| match p.start {
            PayloadStart::Held(frame) => Some((frame, p.matter)),
            PayloadStart::Free(..) => None,
        });
        held.collect()
    }
    /// A payload of this matter as a free body; where it would be, if it is held.
    pub fn free_body(&self, payload: usize, matter: MassProperties<f64>) -> FreeBody {
        match self.payloads[payload].start {
            PayloadStart::Free(X_NT, V_NT_T) => FreeBody::new(matter, &X_NT, &V_NT_T),
            PayloadStart::Held(_) => {
                FreeBody::new(matter, &Pose::identity(), &SpatialVelocity::zero())
            }
        }
    }
    pub(crate) fn steps(&self) -> Vec<Step<f64, JOINTS>> {
        self.phases.iter().map(|p| p.step).collect()
    }
    /// Whether the fitted equipment can take up momentum.
    pub fn stores_momentum(&self) -> bool {
        let actuators = &self.equipment.actuators;
        !(actuators.wheels.is_empty() && actuators.cmgs.is_empty())
    }
    /// Name of a joint.
    pub fn joint_name(&self, j: usize) -> &str {
        self.vehicle.joint_names.get(j).map_or("?", String::as_str)
    }
    /// Whether a joint turns; else it slides.
    pub fn turns(&self, j: usize) -> bool {
        self.vehicle.robot.joint(j).kind == JointKind::Revolute
    }
    /// A joint's position in words (from rad or m).
    pub fn position_text(&self, j: usize, x: f64) -> String {
        if self.turns(j) { format!("{:.2} deg", x.to_degrees()) } else { format!("{x:.4} m") }
    }
    /// A joint's rate in words (from rad/s or m/s).
    pub fn rate_text(&self, j: usize, x: f64) -> String {
        if self.turns(j) { format!("{:.2} deg/s", x.to_degrees()) } else { format!("{x:.4} m/s") }
    }
    /// A joint's torque or force in words.
    pub fn effort_text(&self, j: usize, x: f64) -> String {
        format!("{x:.2} {}", if self.turns(j) { "N·m" } else { "N" })
    }
}
