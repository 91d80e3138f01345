//! The world: a vehicle in free space, what drives it, and its motion through time.

use crate::cmgs::Cmgs;
use crate::flow::Flow;
use crate::free_body::FreeBody;
use crate::propellant::{Carried, InTank};
use crate::rates::Places;
use crate::setup::{BaseAttitude, Drive, Equipment, Instant, OutsideWrench, WorldSetup};
use crate::stepper::{Displacement, Stepper};
use crate::thrusters::Thrusters;
use crate::wheels::Wheels;
use std::cell::Cell;
use std::fmt;
use wrasse_dynamics::{
    BodyId, Dynamics, Frame, Kinematics, MassProperties, PerBody, Robot, State, kinematics,
    momentum,
};
use wrasse_hardware::{ActuatorReadings, AttitudeActuator, CMGS, JointLimits, WHEELS};
use wrasse_spatial::{Pose, Quat, Real, SpatialForce, Vec3};

/// The integrated state: all of it in inertial axes but the joints.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SystemState<const J: usize, T = f64> {
    /// Attitude of the base, `quat_NB`.
    pub quat_NB: Quat<T>,
    /// Joint positions (rad or m).
    pub q: [T; J],
    /// Joint rates (rad/s or m/s).
    pub v: [T; J],
    /// Centre of mass (m).
    pub p_NScm_N: Vec3<T>,
    /// Linear momentum (N·s).
    pub linear: Vec3<T>,
    /// Angular momentum of bodies, wheels and CMGs about the centre of mass (N·m·s); follows from
    /// the rest where the attitude is held.
    pub angular: Vec3<T>,
    /// Momentum of each wheel about its own axis, as seen from inertial space (N·m·s).
    pub wheel_momentum: [T; WHEELS],
    /// Angle of each gimbal (rad).
    pub gimbal_angle: [T; CMGS],
    /// Rate of each gimbal (rad/s).
    pub gimbal_rate: [T; CMGS],
}

impl<const J: usize> SystemState<J> {
    /// Where a world starts, before anything moves.
    fn at_rest(setup: &WorldSetup<'_, J>) -> Self {
        let (start, o) = (&setup.start, Vec3::zero());
        Self {
            quat_NB: Quat::from_matrix(&start.X_NB.rotation),
            q: start.q,
            v: start.v,
            p_NScm_N: o,
            linear: o,
            angular: o,
            wheel_momentum: [0.0; WHEELS],
            gimbal_angle: [0.0; CMGS],
            gimbal_rate: [0.0; CMGS],
        }
    }
}

impl<const J: usize, T: Real> SystemState<J, T> {
    /// The state after a displacement.
    #[inline(always)]
    pub(crate) fn displaced(&self, d: &Flow<J, T>) -> Self {
        Self {
            quat_NB: self.quat_NB * Quat::exp(d.turn),
            q: core::array::from_fn(|j| self.q[j] + d.q[j]),
            v: core::array::from_fn(|j| self.v[j] + d.v[j]),
            p_NScm_N: self.p_NScm_N + d.p_NScm_N,
            linear: self.linear + d.linear,
            angular: self.angular + d.angular,
            wheel_momentum: core::array::from_fn(|i| self.wheel_momentum[i] + d.wheel_momentum[i]),
            gimbal_angle: core::array::from_fn(|i| self.gimbal_angle[i] + d.gimbal_angle[i]),
            gimbal_rate: core::array::from_fn(|i| self.gimbal_rate[i] + d.gimbal_rate[i]),
        }
    }
}

/// The simulated truth.
pub struct World<const J: usize> {
    pub(crate) robot: Robot<f64, J>,
    /// The vehicle without payloads and propellant, and what is in its grips.
    pub(crate) empty: Robot<f64, J>,
    pub(crate) held: Vec<(Frame<f64>, MassProperties<f64>)>,
    /// Bodies that float by themselves.
    pub(crate) free: Vec<FreeBody>,
    pub(crate) limits: [JointLimits<f64>; J],
    pub(crate) actuator: Option<AttitudeActuator<f64>>,
    pub(crate) base: BaseAttitude,
    pub(crate) stepper: Stepper,
    pub(crate) mass: f64,
    pub(crate) system: SystemState<J>,
    /// What rounding took from the last sums, to be given back in the next.
    pub(crate) carry: Flow<J>,
    /// Impulses and work since the start.
    pub(crate) booked: Flow<J>,
    pub(crate) energy_at_grasps: f64,
    pub(crate) drives: [Drive; J],
    pub(crate) actuator_torque_B: Vec3<f64>,
    outside: Option<OutsideWrench<J>>,
    /// Times at which it jumps or bends (s).
    pub(crate) outside_bends: Vec<f64>,
    pub(crate) wheels: Wheels,
    pub(crate) cmgs: Cmgs,
    pub(crate) thrusters: Thrusters,
    /// What feeds the thrusters; without a tank they never run dry.
    pub(crate) tank: Option<InTank>,
    pub(crate) carried: Carried,
    /// An instant in the current stretch, in which no force of a thruster bends (s).
    pub(crate) stretch_middle: f64,
    /// Time (s), and what rounding took from it.
    pub(crate) time: f64,
    pub(crate) time_carry: f64,
    /// Start of the current period (s), and how much of it has gone (s).
    pub(crate) period_start: f64,
    pub(crate) into_period: f64,
    /// Last accepted step of the adaptive stepper (s).
    pub(crate) last_step: f64,
    /// Places for the right-hand side; they are away while it is worked out.
    pub(crate) places: Cell<Option<Box<Places<J>>>>,
}

impl<const J: usize> fmt::Debug for World<J> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("World")
            .field("time", &self.time)
            .field("base", &self.base)
            .field("system", &self.system)
            .finish_non_exhaustive()
    }
}

impl<const J: usize> World<J> {
    /// A world at time zero.
    pub fn new(setup: &WorldSetup<'_, J>) -> Self {
        let equipment = setup.equipment;
        let wheels = Wheels::new(&equipment.actuators.wheels);
        let tank = equipment
            .actuators
            .tank
            .map(|tank| InTank { position_B: tank.position_B, mass: tank.propellant });
        let base = Frame { body: BodyId::Base, X_BF: Pose::identity() };
        let mut empty = *setup.robot;
        if !wheels.is_empty() {
            empty = empty.with_payload(&base, &wheels.taken_from_base());
        }
        let mut limits = [JointLimits::default(); J];
        limits.iter_mut().zip(setup.limits).for_each(|(to, from)| *to = *from);
        let mut world = Self {
            robot: empty,
            empty,
            held: setup.held.to_vec(),
            free: Vec::new(),
            limits,
            actuator: setup.actuator,
            base: setup.base,
            stepper: setup.stepper,
            mass: 0.0,
            system: SystemState::at_rest(setup),
            carry: Flow::zero(),
            booked: Flow::zero(),
            energy_at_grasps: 0.0,
            drives: [Drive::Effort(0.0); J],
            actuator_torque_B: Vec3::zero(),
            outside: None,
            outside_bends: Vec::new(),
            wheels,
            cmgs: Cmgs::new(&equipment.actuators.cmgs),
            thrusters: Thrusters::new(&equipment.actuators.thrusters, equipment.seed),
            tank,
            carried: Carried::default(),
            stretch_middle: 0.0,
            time: 0.0,
            time_carry: 0.0,
            period_start: 0.0,
            into_period: 0.0,
            last_step: 0.01,
            places: Cell::new(Some(Box::default())),
        };
        world.start(&setup.start, &equipment);
        world
    }
    /// Robot, mass and momentum at the start.
    fn start(&mut self, start: &State<f64, J>, equipment: &Equipment) {
        self.robot = self.laden();
        let h = momentum(&kinematics(&self.robot, start));
        self.mass = h.mass;
        let w_NB_B = start.V_NB_B.angular;
        let s = &mut self.system;
        (s.p_NScm_N, s.linear) = (h.p_NScm_N, h.linear);
        s.wheel_momentum = self.wheels.momenta(&equipment.wheel_speed, w_NB_B);
        s.gimbal_angle = equipment.gimbal_angle;
        let inside_B = self.inside_B(&self.system);
        self.system.angular = h.angular + start.X_NB.rotation * inside_B;
    }
    /// A wrench from outside that acts from now on. At the times of its bends (s) it jumps, or changes
    /// otherwise than smoothly: no step of the integrator reaches over them.
    pub fn set_outside_wrench(&mut self, outside: OutsideWrench<J>, bends: &[f64]) {
        self.outside = Some(outside);
        self.outside_bends = bends.to_vec();
    }
    /// Let a body float beside the vehicle; its number.
    pub fn add_free_body(&mut self, body: FreeBody) -> usize {
        self.free.push(body);
        self.free.len() - 1
    }
    /// The robot with its propellant and what it holds. Where it has wheels, their inertia about
    /// their axes is not in its base: they turn by themselves.
    pub fn robot(&self) -> &Robot<f64, J> {
        &self.robot
    }
    /// Bodies that float by themselves.
    pub fn free_bodies(&self) -> &[FreeBody] {
        &self.free
    }
    /// The integrated state.
    pub fn system(&self) -> &SystemState<J> {
        &self.system
    }
    /// Time (s).
    pub fn time(&self) -> f64 {
        self.time
    }
    /// Where everything is and how it moves.
    pub fn state(&self) -> State<f64, J> {
        self.expand(&self.system, self.into_period)
    }
    /// Accelerations and forces now, with the drives as they are.
    pub fn dynamics(&self) -> Dynamics<f64, J> {
        let t = self.into_period;
        let state = self.state();
        let k = kinematics(&self.robot, &state);
        self.dynamics_at(&k, t, &self.acting_at(&self.system, &k, t))
    }
    /// Torque of the attitude actuator on the base now (N·m, base axes), within its limits. What
    /// holds an attitude exactly is the base's entry of [`dynamics`](Self::dynamics).
    pub fn actuator_torque_B(&self) -> Vec3<f64> {
        self.actuator_torque_B
    }
    /// What wheels, CMGs and tank say of themselves.
    pub fn actuator_readings(&self) -> ActuatorReadings<f64> {
        let w_NB_B = self.state().V_NB_B.angular;
        ActuatorReadings {
            wheel_speed: self.wheels.speeds(&self.system.wheel_momentum, w_NB_B),
            gimbal_angle: self.system.gimbal_angle,
            gimbal_rate: self.system.gimbal_rate,
            propellant: self.tank.map_or(0.0, |tank| tank.mass),
        }
    }
    /// Torque of each gimbal's motor now (N·m), what it bears of the turning base included.
    pub fn gimbal_motor_torque(&self) -> [f64; CMGS] {
        let (t, s) = (self.into_period, &self.system);
        let state = self.state();
        let k = kinematics(&self.robot, &state);
        let acting = self.acting_at(s, &k, t);
        let wdot_NB_B = self.dynamics_at(&k, t, &acting).nudot.base.angular;
        let (acceleration, w_NB_B) = (acting.gimbal_acceleration, state.V_NB_B.angular);
        self.cmgs.motor_torques(&s.gimbal_angle, &acceleration, w_NB_B, wdot_NB_B)
    }
    /// Torque that each gimbal's motor would have needed to do as it was told as the period began (N·m),
    /// whatever it can give.
    pub fn gimbal_motor_asked(&self) -> [f64; CMGS] {
        self.cmgs.motor_asked()
    }
    /// Torque of wheels and CMGs on the base now (N·m, base axes).
    pub fn turning_torque_B(&self) -> Vec3<f64> {
        let (t, s) = (self.into_period, &self.system);
        let state = self.state();
        self.acting_at(s, &kinematics(&self.robot, &state), t).turning_B
    }
    /// What is in the grips: the frame that holds it, and its matter seen from there.
    pub fn held(&self) -> &[(Frame<f64>, MassProperties<f64>)] {
        &self.held
    }
    /// Momentum that the attitude actuator stores (N·m·s, base axes), zero at the start.
    pub fn stored_momentum_B(&self) -> Vec3<f64> {
        -self.system.quat_NB.to_matrix().transpose_mul(self.booked.from_actuator)
    }
    /// Whether anything pushes from outside.
    pub(crate) fn is_pushed(&self) -> bool {
        self.outside.is_some()
    }
    pub(crate) fn outside_wrench(
        &self,
        t: f64,
        k: &Kinematics<'_, f64, J>,
    ) -> Option<PerBody<SpatialForce<f64>, J>> {
        let within = self.period_start + self.stretch_middle;
        let wrench = self.outside.as_ref()?;
        Some(wrench(Instant { time: self.period_start + t, within }, k))
    }
    /// Pose `X_NF` of a frame now.
    pub fn pose(&self, frame: &Frame<f64>) -> Pose<f64> {
        kinematics(&self.robot, &self.state()).pose(frame)
    }
}
