//! A checked mission: ready to be planned and flown.

use crate::applied_wrench::AppliedWrench;
use crate::as_flown::Setting;
use crate::base_format::{ClaimIs, StudyFile};
use crate::case_world::fuelled;
use crate::dispersion::Dispersion;
use crate::quantity::Quantity;
use crate::read_base::Turning;
use crate::requirement::Requirement;
use crate::sampled_loops::{SampledLoop, sampled_loops};
use std::sync::Arc;
use wrasse_document::Complaint;
use wrasse_dynamics::{Frame, JointKind, MassProperties, State};
use wrasse_flight::allocation::Unit;
use wrasse_flight::{Phase, Setup};
use wrasse_hardware::{AttitudeActuator, Sensors};
use wrasse_spatial::{Pose, SpatialVelocity};
use wrasse_vehicle::{Equipment, JOINTS, Vehicle, VehicleRobot};
use wrasse_world::{BaseAttitude, Failure, FreeBody, GripOffset, Stepper};

/// A mission file, checked.
#[derive(Debug, Clone)]
pub struct Mission {
    /// Its name: results go to `out/NAME`.
    pub name: String,
    /// What it is for.
    pub summary: String,
    /// The file, as given.
    pub file: String,
    /// Its text.
    pub text: String,
    /// Seed of everything random.
    pub seed: u64,
    /// What `wrasse size` makes of the cases.
    pub study: Option<Study>,
    /// Warnings about the file: it can be flown, but is worth a second look.
    pub remarks: Vec<Complaint>,
    pub(crate) cases: Vec<Case>,
}

/// What `wrasse size` makes of the cases of a mission.
#[derive(Debug, Clone, PartialEq)]
pub struct Study {
    /// The claim that is examined.
    pub claim: String,
    /// What it says, if verdicts can be held against it.
    pub claim_is: Option<ClaimIs>,
    /// Name of the compared axis whose rows are tasks, if there is one.
    pub tasks: Option<String>,
    /// Name of the compared axis whose rows are sets of actuators.
    pub sets: String,
    /// The row of that axis that is ideal.
    pub reference: String,
    /// Tasks that are flown with every set.
    pub closed_loop: Vec<String>,
    /// Most mass that a set may have (kg).
    pub mass_limit_kg: Option<f64>,
    /// Most power that a set may take (W).
    pub power_limit_w: Option<f64>,
}

impl Study {
    pub(crate) fn of(file: &StudyFile) -> Self {
        Self {
            claim: file.claim.clone(),
            claim_is: file.claim_is,
            tasks: file.tasks.clone(),
            sets: file.sets.clone(),
            reference: file.reference.clone(),
            closed_loop: file.closed_loop.clone(),
            mass_limit_kg: file.mass_limit_kg,
            power_limit_w: file.power_limit_w,
        }
    }
}

impl Mission {
    /// What tells a case from the others: axis and row of each comparison.
    ///
    /// # Panics
    /// If there is no case of this number.
    pub fn case_labels(&self, case: usize) -> &[(String, String)] {
        &self.cases[case].labels
    }
    /// Wheels, CMGs and thrusters of a case.
    ///
    /// # Panics
    /// If there is no case of this number.
    pub fn equipment(&self, case: usize) -> &Equipment {
        &self.cases[case].equipment
    }
    /// The vehicle of a case.
    ///
    /// # Panics
    /// If there is no case of this number.
    pub fn vehicle(&self, case: usize) -> &Vehicle {
        &self.cases[case].vehicle
    }
    /// The loops that the flight computer of a case closes once a period.
    ///
    /// # Panics
    /// If there is no case of this number.
    pub fn sampled_loops(&self, case: usize) -> Vec<SampledLoop> {
        sampled_loops(&self.cases[case])
    }
    /// The ideal actuator that turns the base of a case, where it has limits.
    ///
    /// # Panics
    /// If there is no case of this number.
    pub fn ideal_actuator(&self, case: usize) -> Option<AttitudeActuator<f64>> {
        let case = &self.cases[case];
        match case.turning {
            Turning::Ideal(actuator) if case.base == BaseAttitude::Controlled => actuator,
            Turning::Ideal(_) | Turning::Fitted => None,
        }
    }
    /// Number of cases: one, or one for each combination that is compared.
    pub fn case_count(&self) -> usize {
        self.cases.len()
    }
}

/// One thing to run.
#[derive(Debug, Clone)]
pub(crate) struct Case {
    /// (axis, row) of each comparison.
    pub(crate) labels: Vec<(String, String)>,
    pub(crate) vehicle: Arc<Vehicle>,
    pub(crate) vehicle_name: String,
    pub(crate) start: State<f64, JOINTS>,
    pub(crate) payloads: Vec<PayloadCase>,
    pub(crate) base: BaseAttitude,
    /// What turns the base where it is controlled.
    pub(crate) turning: Turning,
    pub(crate) equipment: Equipment,
    /// Imperfect sensors, if there are any.
    pub(crate) sensors: Option<Sensors<f64>>,
    /// Whether the tool has a force-torque sensor.
    pub(crate) measures_wrench: bool,
    pub(crate) failures: Vec<FailureCase>,
    pub(crate) wrenches: Vec<AppliedWrench>,
    pub(crate) seed: u64,
    pub(crate) stepper: Stepper,
    /// Which joints are driven by torque.
    pub(crate) torque: [bool; JOINTS],
    pub(crate) setup: Setup<f64, JOINTS>,
    pub(crate) phases: Vec<PhaseCase>,
    /// What a sample of a sweep draws anew.
    pub(crate) dispersions: Vec<Dispersion>,
    /// What the flight computer takes the masses for, where they are otherwise.
    pub(crate) believed: Option<Box<Believed>>,
    pub(crate) requirements: Vec<Requirement>,
    pub(crate) quantities: Vec<Quantity>,
    /// Samples per second in the telemetry.
    pub(crate) output_rate: f64,
    /// Instants in the drawing.
    pub(crate) snapshots: u32,
    /// Laws and world as they are flown.
    pub(crate) as_flown: Vec<Setting>,
}

/// Mass properties in the flight computer's belief.
#[derive(Debug, Clone)]
pub(crate) struct Believed {
    /// The vehicle with nothing in its grips and tank.
    pub(crate) robot: VehicleRobot,
    /// The payloads.
    pub(crate) matters: Vec<MassProperties<f64>>,
}

/// A unit that fails on the way.
#[derive(Debug, Clone)]
pub(crate) struct FailureCase {
    /// Its name.
    pub(crate) name: String,
    /// In which way, in a word.
    pub(crate) how: String,
    pub(crate) unit: Unit,
    pub(crate) breaks: Failure,
    /// When it fails, and when the flight computer is told (s).
    pub(crate) at: f64,
    pub(crate) told_at: Option<f64>,
}

/// A payload and where it is at the start.
#[derive(Debug, Clone)]
pub(crate) struct PayloadCase {
    pub(crate) name: String,
    pub(crate) matter: MassProperties<f64>,
    pub(crate) start: PayloadStart,
    /// Edges for drawings (m), centred on the centre of mass.
    pub(crate) box_m: Option<[f64; 3]>,
}

/// Where a payload is at the start.
#[derive(Debug, Clone, Copy)]
pub(crate) enum PayloadStart {
    /// Held in this frame.
    Held(Frame<f64>),
    /// Floating: pose `X_NT` and twist `V_NT_T`.
    Free(Pose<f64>, SpatialVelocity<f64>),
}

/// A phase and what the mission knows of it beyond the flight computer.
#[derive(Debug, Clone)]
pub(crate) struct PhaseCase {
    pub(crate) name: String,
    pub(crate) phase: Phase<f64, JOINTS>,
    /// What a grasp allows between tool and grip; nothing where the phase is none.
    pub(crate) grasp_bounds: Option<GripOffset>,
}

impl Case {
    /// Control period (s).
    pub(crate) fn period(&self) -> f64 {
        self.setup.tuning.period
    }
    /// Control periods from one telemetry sample to the next.
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "rounded, at least 1"
    )]
    pub(crate) fn periods_per_sample(&self) -> u64 {
        (1.0 / (self.output_rate * self.period())).round().max(1.0) as u64
    }
    /// The vehicle as the flight computer believes it to be, with nothing in its grips and tank.
    pub(crate) fn believed_robot(&self) -> &VehicleRobot {
        self.believed.as_ref().map_or(&self.vehicle.robot, |believed| &believed.robot)
    }
    /// A payload as the flight computer believes it to be.
    pub(crate) fn believed_matter(&self, payload: usize) -> MassProperties<f64> {
        let believed = self.believed.as_ref().and_then(|believed| believed.matters.get(payload));
        believed.copied().unwrap_or(self.payloads[payload].matter)
    }
    /// The robot that the flight computer believes in, with what it holds from the start, and with its
    /// propellant.
    pub(crate) fn robot_at_start(&self) -> VehicleRobot {
        let held = self.payloads.iter().enumerate().filter_map(|(i, p)| match p.start {
            PayloadStart::Held(frame) => Some((frame, self.believed_matter(i))),
            PayloadStart::Free(..) => None,
        });
        held.fold(fuelled(self), |robot, (frame, matter)| robot.with_payload(&frame, &matter))
    }
    /// Payloads held from the start.
    pub(crate) fn held_at_start(&self) -> Vec<(Frame<f64>, MassProperties<f64>)> {
        let held = self.payloads.iter().filter_map(|p| match p.start {
            PayloadStart::Held(frame) => Some((frame, p.matter)),
            PayloadStart::Free(..) => None,
        });
        held.collect()
    }
    /// A payload of this matter as a free body; where it would be, if it is held.
    pub(crate) fn free_body(&self, payload: usize, matter: MassProperties<f64>) -> FreeBody {
        match self.payloads[payload].start {
            PayloadStart::Free(X_NT, V_NT_T) => FreeBody::new(matter, &X_NT, &V_NT_T),
            PayloadStart::Held(_) => {
                FreeBody::new(matter, &Pose::identity(), &SpatialVelocity::zero())
            }
        }
    }
    pub(crate) fn flight_phases(&self) -> Vec<Phase<f64, JOINTS>> {
        self.phases.iter().map(|p| p.phase).collect()
    }
    /// Whether the fitted equipment can take up momentum.
    pub(crate) fn stores_momentum(&self) -> bool {
        let actuators = &self.equipment.actuators;
        !(actuators.wheels.is_empty() && actuators.cmgs.is_empty())
    }
    pub(crate) fn joint_name(&self, j: usize) -> &str {
        self.vehicle.joint_names.get(j).map_or("?", String::as_str)
    }
    pub(crate) fn turns(&self, j: usize) -> bool {
        self.vehicle.robot.joint(j).kind == JointKind::Revolute
    }
    /// A joint's position in words (from rad or m).
    pub(crate) fn position_text(&self, j: usize, x: f64) -> String {
        if self.turns(j) { format!("{:.2} deg", x.to_degrees()) } else { format!("{x:.4} m") }
    }
    /// A joint's rate in words (from rad/s or m/s).
    pub(crate) fn rate_text(&self, j: usize, x: f64) -> String {
        if self.turns(j) { format!("{:.2} deg/s", x.to_degrees()) } else { format!("{x:.4} m/s") }
    }
    /// A joint's torque or force in words.
    pub(crate) fn effort_text(&self, j: usize, x: f64) -> String {
        format!("{x:.2} {}", if self.turns(j) { "N·m" } else { "N" })
    }
}
