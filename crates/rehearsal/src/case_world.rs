//! The scene that a case is flown in: its servicer, and the payloads beside it or in its grips.

use crate::applied_wrench::together;
use crate::case::AttitudeActuation;
use crate::case::{Case, PayloadStart};
use std::ops::{Deref, DerefMut};
use wrasse_dynamics::{BodyId, Dynamics, Frame, Kinematics, MassProperties, State, kinematics};
use wrasse_hardware::{ActuatorCommand, ActuatorReadings, SetPoint, SetPointMotion};
use wrasse_spatial::{Pose, Quat, SpatialVelocity, Sym3, Vec3};
use wrasse_vehicle::{JOINTS, VehicleRobot};
use wrasse_world::{
    AppliedWrench, Drive, Equipment, Failure, GraspRefused, GripOffset, Held, HeldId, MotorTorques,
    Saturation, Scene, Stepper, SystemId, SystemSetup,
};

/// Where a payload is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum PayloadPlace {
    /// It floats, as a system of its own.
    Free(SystemId),
    /// It is in a grip of the servicer.
    Held(HeldId),
}

/// The scene of a case. The servicer need not be named.
#[derive(Debug)]
pub(crate) struct CaseWorld {
    scene: Scene<JOINTS>,
    servicer: SystemId,
    /// Where each payload of the case is.
    pub(crate) payloads: Vec<PayloadPlace>,
}

impl Deref for CaseWorld {
    type Target = Scene<JOINTS>;
    fn deref(&self) -> &Scene<JOINTS> {
        &self.scene
    }
}

impl DerefMut for CaseWorld {
    fn deref_mut(&mut self) -> &mut Scene<JOINTS> {
        &mut self.scene
    }
}

impl CaseWorld {
    /// At the start of a case: the servicer with what it holds and what pushes at it, and the payloads
    /// that float beside it.
    pub(crate) fn new(case: &Case, stepper: Stepper) -> Self {
        let (mut scene, servicer) = scene_of(case, stepper);
        let mut in_grips = scene.held(servicer).map(|(id, _)| id).collect::<Vec<_>>().into_iter();
        let place = |(i, payload): (usize, &crate::case::PayloadCase)| {
            let held = matches!(payload.start, PayloadStart::Held(_)).then(|| in_grips.next());
            held.flatten().map_or_else(
                || PayloadPlace::Free(scene.add_body(&case.free_body(i, payload.matter))),
                PayloadPlace::Held,
            )
        };
        let payloads = case.payloads.iter().enumerate().map(place).collect();
        Self { scene, servicer, payloads }
    }
    /// The servicer with its propellant and what it holds.
    pub(crate) fn robot(&self) -> &VehicleRobot {
        self.scene.robot(self.servicer)
    }
    /// The same as if its propellant did not swing: what a flight computer is told that it is.
    pub(crate) fn rigid_robot(&self) -> &VehicleRobot {
        self.scene.rigid_robot(self.servicer)
    }
    /// Its state without the swing: what sensors can know of it.
    pub(crate) fn rigid_state(&self) -> State<f64, JOINTS> {
        self.scene.rigid_state(self.servicer)
    }
    /// Angle of the propellant's swing from the axis of its tank (rad); `None` where none swings.
    pub(crate) fn slosh_angle(&self) -> Option<f64> {
        self.scene.slosh_angle(self.servicer)
    }
    /// Where the servicer is and how it moves.
    pub(crate) fn state(&self) -> State<f64, JOINTS> {
        self.scene.state(self.servicer)
    }
    /// Attitude of its base.
    pub(crate) fn quat_NB(&self) -> Quat<f64> {
        self.scene.attitude(self.servicer)
    }
    pub(crate) fn dynamics(&self) -> Dynamics<f64, JOINTS> {
        self.scene.dynamics(self.servicer)
    }
    pub(crate) fn actuator_torque_B(&self) -> Vec3<f64> {
        self.scene.actuator_torque_B(self.servicer)
    }
    pub(crate) fn internal_torque_B(&self) -> Vec3<f64> {
        self.scene.internal_torque_B(self.servicer)
    }
    pub(crate) fn stored_momentum_B(&self) -> Vec3<f64> {
        self.scene.stored_momentum_B(self.servicer)
    }
    pub(crate) fn actuator_readings(&self) -> ActuatorReadings<f64> {
        self.scene.actuator_readings(self.servicer)
    }
    pub(crate) fn motor_torques(&self) -> MotorTorques {
        self.scene.motor_torques(self.servicer)
    }
    pub(crate) fn pose(&self, frame: &Frame<f64>) -> Pose<f64> {
        self.scene.pose(self.servicer, frame)
    }
    /// A control period begins with these commands; what the limits cut is put into `cut`.
    pub(crate) fn command(
        &mut self,
        drives: (&[Drive], Vec3<f64>),
        actuators: &ActuatorCommand<f64>,
        period: f64,
        cut: &mut Vec<Saturation>,
    ) {
        self.scene.begin_period();
        self.scene.command(self.servicer, drives, actuators, period, cut);
    }
    pub(crate) fn fail(&mut self, failure: Failure) {
        self.scene.fail(self.servicer, failure);
    }
    /// Payloads in the grips, in the order in which they came there.
    pub(crate) fn held(&self) -> impl Iterator<Item = (usize, &Held)> {
        self.scene.held(self.servicer).filter_map(|(id, held)| {
            let i = self.payloads.iter().position(|at| *at == PayloadPlace::Held(id))?;
            Some((i, held))
        })
    }
    /// Payloads with the poses and twists of their centres of mass, inertial axes, in the order of the case.
    pub(crate) fn payload_motions(&self) -> Vec<(usize, Pose<f64>, SpatialVelocity<f64>)> {
        let state = self.state();
        let k: Kinematics<'_, f64, JOINTS> = kinematics(self.robot(), &state);
        let at_cm = |X: Pose<f64>, V: SpatialVelocity<f64>, matter: &MassProperties<f64>| {
            let to_cm = X.rotation * matter.M_F_F.centre_of_mass();
            (Pose::new(X.rotation, X.translation + to_cm), V.shifted_by(to_cm))
        };
        let mut found = vec![];
        for (i, held) in self.held() {
            let (X, V) = at_cm(k.pose(&held.frame), k.velocity(&held.frame), &held.matter);
            found.push((i, X, V));
        }
        for (i, place) in self.payloads.iter().enumerate() {
            let PayloadPlace::Free(id) = place else { continue };
            let body = self.scene.body(*id);
            let (X, V_F) = (body.pose(), body.twist());
            let V = SpatialVelocity::new(X.rotation * V_F.angular, X.rotation * V_F.linear);
            let (X, V) = at_cm(X, V, &body.matter);
            found.push((i, X, V));
        }
        found.sort_by_key(|(i, ..)| *i);
        found
    }
    /// How a payload that floats lies in a tool frame; `None` if it is held.
    pub(crate) fn grip_offset(&self, tool: &Frame<f64>, payload: usize) -> Option<GripOffset> {
        let PayloadPlace::Free(id) = self.payloads[payload] else { return None };
        Some(self.scene.grip_offset(self.servicer, tool, id))
    }
    /// Grasp a payload; the change of energy (J), or `None` if it is held already.
    pub(crate) fn grasp(
        &mut self,
        tool: &Frame<f64>,
        payload: usize,
        most: &GripOffset,
    ) -> Result<Option<f64>, GraspRefused> {
        let PayloadPlace::Free(id) = self.payloads[payload] else { return Ok(None) };
        let (held, change) = self.scene.grasp(self.servicer, tool, id, most)?;
        self.payloads[payload] = PayloadPlace::Held(held);
        Ok(Some(change))
    }
    /// Let go of a payload; whether it was held.
    pub(crate) fn release(&mut self, payload: usize) -> bool {
        let PayloadPlace::Held(held) = self.payloads[payload] else { return false };
        self.payloads[payload] = PayloadPlace::Free(self.scene.release(self.servicer, held));
        true
    }
}

/// A scene with the servicer of a case, what it holds and what pushes at it; nothing floats beside it
/// yet.
fn scene_of(case: &Case, stepper: Stepper) -> (Scene<JOINTS>, SystemId) {
    let held = case.held_at_start();
    let mut scene = Scene::new(stepper);
    scene.set_environment(case.environment);
    let servicer = scene.add(&SystemSetup {
        robot: &case.vehicle.robot,
        limits: &case.vehicle.limits,
        actuator: match case.actuation {
            AttitudeActuation::Ideal(actuator) => actuator,
            AttitudeActuation::Fitted => None,
        },
        equipment: equipment(case),
        base: case.base,
        start: case.start,
        held: &held,
    });
    if !case.vehicle.followers.is_empty() {
        scene.set_followers(servicer, &case.vehicle.followers);
    }
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
    let none = ActuatorCommand::default();
    scene.begin_period();
    scene.command(servicer, (&drives, Vec3::zero()), &none, period, &mut vec![]);
    if !case.wrenches.is_empty() {
        let (course, breakpoints) = together(case.wrenches.clone());
        scene.apply(servicer, AppliedWrench::new(course, &breakpoints));
    }
    (scene, servicer)
}

/// What the world is told of the wheels, CMGs and thrusters of a case.
fn equipment(case: &Case) -> Equipment {
    Equipment {
        actuators: case.equipment.actuators,
        wheel_speed: case.equipment.wheel_speed,
        gimbal_angle: case.equipment.gimbal_angle,
        slosh: case.equipment.slosh,
        seed: case.seed,
    }
}

/// The vehicle as the flight computer believes it to be, with nothing in its grips and tank, and its
/// wheels counted for themselves, as the world does.
pub(crate) fn believed_alone(case: &Case) -> VehicleRobot {
    let mut equipment = equipment(case);
    equipment.actuators.tank = None;
    let mut scene = Scene::new(case.stepper);
    let alone = scene.add(&SystemSetup {
        robot: case.believed_robot(),
        limits: &case.vehicle.limits,
        actuator: None,
        equipment,
        base: case.base,
        start: case.start,
        held: &[],
    });
    *scene.robot(alone)
}

/// The vehicle that the laws believe in, with its propellant and nothing in its grips: what leaves the
/// tank on the way is not planned.
pub(crate) fn fuelled(case: &Case) -> VehicleRobot {
    let alone = believed_alone(case);
    let Some(tank) = case.equipment.actuators.tank else { return alone };
    let base = Frame { body: BodyId::Base, X_BF: Pose::identity() };
    let matter = MassProperties::from_central(tank.propellant, tank.position_B, Sym3::zero());
    alone.with_payload(&base, &matter)
}
