//! Control of the base: the torque and force that it should feel, and who gives them.

use crate::law::{Feedforward, Tuning};
use crate::period_command::Told;
use crate::steering::{Needs, Steered, Steering, SteeringSetup, Unit};
use wrasse_dynamics::{Robot, State, kinematics, momentum};
use wrasse_hardware::{ActuatorReadings, AttitudeActuator};
use wrasse_spatial::{Quat, Real, Scalar, SpatialForce, Vec3};

/// How the centre of mass of the system is kept where it was at the start.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PositionHold<T> {
    /// Bandwidth of the loop (rad/s).
    pub bandwidth: T,
    /// Damping ratio of the loop (–).
    pub damping: T,
}

/// How the base is controlled.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BaseControlSetup<T> {
    /// What the attitude control is told of the arm.
    pub feedforward: Feedforward,
    /// Attitude that is kept.
    pub quat_ND: Quat<T>,
    /// Whether and how the centre of mass is kept in its place.
    pub position_hold: Option<PositionHold<T>>,
    /// What turns the base.
    pub actuation: Actuation<T>,
}

/// What turns the base, as far as the flight computer is concerned.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Actuation<T> {
    /// Nothing that it steers: the base floats, or is held by something else.
    None,
    /// An ideal actuator, within limits if it has them.
    Ideal(Option<AttitudeActuator<T>>),
    /// Wheels, CMGs and thrusters, and how they are steered.
    Fitted(SteeringSetup<T>),
}

impl<T> Actuation<T> {
    /// The actuators and how they are steered, if there are any.
    pub fn steering(&self) -> Option<&SteeringSetup<T>> {
        match self {
            Self::Fitted(steering) => Some(steering),
            Self::None | Self::Ideal(_) => None,
        }
    }

    /// Whether a torque is given in the period in which it is wanted. Thrusters alone give pulses, and
    /// those when the lag of their modulation lets them.
    pub(crate) fn answers_at_once(&self) -> bool {
        self.steering().is_none_or(|steering| {
            let actuators = &steering.actuators;
            !actuators.wheels.is_empty() || !actuators.cmgs.is_empty()
        })
    }
}

impl<T: Real> BaseControlSetup<T> {
    /// The attitude `quat_ND` kept by an ideal actuator without limits; the base goes where the arm
    /// pushes it.
    pub fn ideal(feedforward: Feedforward, quat_ND: Quat<T>) -> Self {
        Self { feedforward, quat_ND, position_hold: None, actuation: Actuation::Ideal(None) }
    }
}

/// Attitude and position loops and the steering behind them.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BaseControl<T> {
    setup: BaseControlSetup<T>,
    steering: Option<Steering<T>>,
    /// Momentum that an ideal actuator stores by what it was told, base axes (N·m·s).
    stored_B: Vec3<T>,
    home: Option<Home<T>>,
}

/// Where the centre of mass is kept, and where it was last seen.
#[derive(Debug, Clone, Copy)]
struct Home<T> {
    /// Where it was when it was first seen, inertial axes (m).
    p_NScm_N: Vec3<T>,
    /// Where it should be seen next if nothing pushes, inertial axes (m).
    next_N: Vec3<T>,
    /// Mass of the system (kg).
    mass: T,
}

impl<T: Scalar> BaseControl<T> {
    pub(crate) fn new(setup: BaseControlSetup<T>) -> Self {
        let steering = setup.actuation.steering().map(Steering::new);
        Self { steering, setup, stored_B: Vec3::zero(), home: None }
    }

    /// What the actuators are told so that the base feels what it was `told` to, and the torque that it
    /// will not feel for all that (N·m, base axes).
    pub(crate) fn command<const J: usize>(
        &mut self,
        robot: &Robot<T, J>,
        tuning: &Tuning<T>,
        told: &Told<T, J>,
        sensed: &State<T, J>,
        readings: &ActuatorReadings<T>,
    ) -> (Steered<T>, Vec3<T>) {
        let mut force_B = self.holding_force(robot, sensed, tuning.period);
        if self.setup.position_hold.is_some() {
            force_B += told.ahead_force_B;
        }
        let w_NB_B = sensed.V_NB_B.angular;
        let Some(steering) = &mut self.steering else {
            let given_B = self.ideal_torque(told.attitude_torque_B, w_NB_B, tuning.period);
            return (Steered::nothing(), told.attitude_torque_B - given_B);
        };
        let wanted = SpatialForce::new(told.attitude_torque_B, force_B);
        let p_BScm_B = told.M_B.centre_of_mass();
        let needs = Needs { wanted, w_NB_B, p_BScm_B, period: tuning.period };
        let steered = steering.steer(&needs, readings);
        (steered, told.attitude_torque_B - steered.expected_B)
    }

    /// Torque that an ideal actuator gives of the one that is wanted (N·m, base axes).
    fn ideal_torque(&mut self, wanted_B: Vec3<T>, w_NB_B: Vec3<T>, period: T) -> Vec3<T> {
        let Actuation::Ideal(Some(limits)) = self.setup.actuation else { return wanted_B };
        let carried_B = w_NB_B.cross(self.stored_B);
        let given_B = limits.given(wanted_B, (self.stored_B, carried_B), period, |_, _| {});
        self.stored_B -= (given_B + carried_B) * period;
        given_B
    }

    /// Force that brings the centre of mass back to where it was, base axes (N).
    ///
    /// What is grasped or let go, and propellant that is gone, shift the centre of mass within the
    /// vehicle; the vehicle should not move for that, so its home shifts as much.
    fn holding_force<const J: usize>(
        &mut self,
        robot: &Robot<T, J>,
        sensed: &State<T, J>,
        period: T,
    ) -> Vec3<T> {
        let Some(hold) = self.setup.position_hold else { return Vec3::zero() };
        let h = momentum(&kinematics(robot, sensed));
        let home_N = match self.home {
            None => h.p_NScm_N,
            Some(home) if home.mass == h.mass => home.p_NScm_N,
            Some(home) => home.p_NScm_N + (h.p_NScm_N - home.next_N),
        };
        let next_N = h.p_NScm_N + h.linear * (period / h.mass);
        self.home = Some(Home { p_NScm_N: home_N, next_N, mass: h.mass });
        let stiffness = hold.bandwidth * hold.bandwidth * h.mass;
        let damping = T::from_f64(2.0) * hold.damping * hold.bandwidth;
        let force_N = (home_N - h.p_NScm_N) * stiffness - h.linear * damping;
        sensed.X_NB.rotation.transpose_mul(force_N)
    }

    /// Nothing is controlled for a while: nobody owes anything for it.
    pub(crate) fn rest(&mut self) -> Steered<T> {
        if let Some(steering) = &mut self.steering {
            steering.rest();
        }
        Steered::nothing()
    }

    /// Do without a unit from now on.
    pub(crate) fn isolate(&mut self, unit: Unit) {
        if let Some(steering) = &mut self.steering {
            steering.isolate(unit);
        }
    }
}
