//! A scene with one vehicle in it, and rigid bodies that float beside it.

use std::ops::{Deref, DerefMut};
use wrasse_dynamics::{Dynamics, Frame, MassProperties, Robot, State};
use wrasse_hardware::{ActuatorCommand, ActuatorReadings, AttitudeActuator, CMGS, JointLimits};
use wrasse_spatial::{Pose, Quat, SpatialVelocity, Vec3};
use wrasse_world::{
    AppliedWrench, BaseAttitude, Course, Drive, Equipment, Failure, FreeBody, GraspRefused,
    GripOffset, Held, HeldId, Saturation, Scene, Stepper, SystemId, SystemSetup,
};

/// What it is made of.
#[derive(Debug, Clone)]
pub struct OneSystemSetup<'a, const J: usize> {
    /// The vehicle, with nothing in its grip.
    pub robot: &'a Robot<f64, J>,
    /// Limits of its joints.
    pub limits: &'a [JointLimits<f64>],
    /// The ideal attitude actuator, if it has one.
    pub actuator: Option<AttitudeActuator<f64>>,
    /// Wheels, CMGs, thrusters.
    pub equipment: Equipment,
    /// What becomes of the base's attitude.
    pub base: BaseAttitude,
    /// How the motion is integrated.
    pub stepper: Stepper,
    /// State at the start.
    pub start: State<f64, J>,
    /// Payloads held from the start.
    pub held: &'a [(Frame<f64>, MassProperties<f64>)],
}

/// A scene with one vehicle: the vehicle need not be named.
#[derive(Debug)]
pub struct OneSystem<const J: usize> {
    scene: Scene<J>,
    /// The vehicle.
    pub id: SystemId,
}

impl<const J: usize> Deref for OneSystem<J> {
    type Target = Scene<J>;
    fn deref(&self) -> &Scene<J> {
        &self.scene
    }
}

impl<const J: usize> DerefMut for OneSystem<J> {
    fn deref_mut(&mut self) -> &mut Scene<J> {
        &mut self.scene
    }
}

impl<const J: usize> OneSystem<J> {
    /// At time zero.
    pub fn new(setup: &OneSystemSetup<'_, J>) -> Self {
        let mut scene = Scene::new(setup.stepper);
        let id = scene.add(&SystemSetup {
            robot: setup.robot,
            limits: setup.limits,
            actuator: setup.actuator,
            equipment: setup.equipment,
            base: setup.base,
            start: setup.start,
            held: setup.held,
        });
        Self { scene, id }
    }
    /// A control period begins with these commands; what the limits cut.
    pub fn command(
        &mut self,
        drives: &[Drive],
        torque_B: Vec3<f64>,
        actuators: &ActuatorCommand<f64>,
        period: f64,
    ) -> Vec<Saturation> {
        let mut cut = vec![];
        self.command_noting(drives, torque_B, actuators, period, &mut cut);
        cut
    }
    /// The same, what the limits cut put into a place.
    pub fn command_noting(
        &mut self,
        drives: &[Drive],
        torque_B: Vec3<f64>,
        actuators: &ActuatorCommand<f64>,
        period: f64,
        cut: &mut Vec<Saturation>,
    ) {
        self.scene.begin_period();
        self.scene.command(self.id, (drives, torque_B), actuators, period, cut);
    }
    /// A wrench from outside that acts from now on, not smooth at these times (s).
    pub fn set_outside_wrench(&mut self, course: Course<J>, breakpoints: &[f64]) {
        self.scene.apply(self.id, AppliedWrench::new(course, breakpoints));
    }
    /// Let a unit of the vehicle fail.
    pub fn fail(&mut self, failure: Failure) {
        self.scene.fail(self.id, failure);
    }
    /// The robot with what it holds.
    pub fn robot(&self) -> &Robot<f64, J> {
        self.scene.robot(self.id)
    }
    /// Where the vehicle is and how it moves.
    pub fn state(&self) -> State<f64, J> {
        self.scene.state(self.id)
    }
    /// Attitude of its base.
    pub fn quat_NB(&self) -> Quat<f64> {
        self.scene.attitude(self.id)
    }
    /// Accelerations and forces now.
    pub fn dynamics(&self) -> Dynamics<f64, J> {
        self.scene.dynamics(self.id)
    }
    /// Torque of the ideal actuator now (N·m, base axes).
    pub fn actuator_torque_B(&self) -> Vec3<f64> {
        self.scene.actuator_torque_B(self.id)
    }
    /// What the ideal actuator stores (N·m·s, base axes).
    pub fn stored_momentum_B(&self) -> Vec3<f64> {
        self.scene.stored_momentum_B(self.id)
    }
    /// What wheels, CMGs and tank say.
    pub fn actuator_readings(&self) -> ActuatorReadings<f64> {
        self.scene.actuator_readings(self.id)
    }
    /// Pose of a frame now.
    pub fn pose(&self, frame: &Frame<f64>) -> Pose<f64> {
        self.scene.pose(self.id, frame)
    }
    /// What is in the grips.
    pub fn held(&self) -> Vec<(HeldId, Held)> {
        self.scene.held(self.id).map(|(id, held)| (id, *held)).collect()
    }
    /// Rigid bodies that float beside the vehicle.
    pub fn free_bodies(&self) -> Vec<FreeBody> {
        self.scene.systems().filter(|id| *id != self.id).map(|id| self.scene.body(id)).collect()
    }
    /// Twist of a rigid body against a frame of the vehicle.
    pub fn relative_twist(&self, frame: &Frame<f64>, body: SystemId) -> SpatialVelocity<f64> {
        self.scene.relative_twist(self.id, frame, body)
    }
    /// Grasp a rigid body; the change of energy (J).
    ///
    /// # Errors
    /// If it is not within the bounds.
    pub fn grasp(
        &mut self,
        frame: &Frame<f64>,
        body: SystemId,
        most: &GripOffset,
    ) -> Result<f64, GraspRefused> {
        self.scene.grasp(self.id, frame, body, most).map(|(_, change)| change)
    }
    /// Let go of what is held, by its place among [`held`](Self::held).
    pub fn release(&mut self, place: usize) -> SystemId {
        let (held, _) = self.held()[place];
        self.scene.release(self.id, held)
    }
    /// Torque of each gimbal's motor now (N·m).
    pub fn gimbal_motor_torque(&self) -> [f64; CMGS] {
        self.scene.motor_torques(self.id).gimbal
    }
    /// Attitude and all other variables: what two flights must share to the bit.
    pub fn bits(&self) -> (Quat<f64>, Vec<f64>) {
        (self.quat_NB(), self.scene.variables(self.id).to_vec())
    }
}
