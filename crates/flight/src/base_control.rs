//! Control of the base: the torque and force that it should feel, and who gives them.

use crate::law::{Feedforward, Tuning};
use crate::period_command::Told;
use crate::steering::{Needs, Steered, Steering, SteeringSetup, Unit};
use wrasse_dynamics::{Robot, State, kinematics, momentum};
use wrasse_hardware::ActuatorReadings;
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
    /// The actuators and how they are steered; without them the torque goes to an ideal actuator.
    pub steering: Option<SteeringSetup<T>>,
}

impl<T: Real> BaseControlSetup<T> {
    /// The attitude `quat_ND` kept by an ideal actuator; the base goes where the arm pushes it.
    pub fn ideal(feedforward: Feedforward, quat_ND: Quat<T>) -> Self {
        Self { feedforward, quat_ND, position_hold: None, steering: None }
    }
}

/// Attitude and position loops and the steering behind them.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BaseControl<T> {
    setup: BaseControlSetup<T>,
    steering: Option<Steering<T>>,
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
        Self { steering: setup.steering.as_ref().map(Steering::new), setup, home: None }
    }

    /// What the actuators are told so that the base feels what it was `told` to.
    pub(crate) fn command<const J: usize>(
        &mut self,
        robot: &Robot<T, J>,
        tuning: &Tuning<T>,
        told: &Told<T, J>,
        sensed: &State<T, J>,
        readings: &ActuatorReadings<T>,
    ) -> Steered<T> {
        let mut force_B = self.holding_force(robot, sensed, tuning.period);
        if self.setup.position_hold.is_some() {
            force_B += told.ahead_force_B;
        }
        let Some(steering) = &mut self.steering else { return Steered::nothing() };
        let wanted = SpatialForce::new(told.attitude_torque_B, force_B);
        let (w_NB_B, p_BScm_B) = (sensed.V_NB_B.angular, told.M_B.centre_of_mass());
        steering.steer(&Needs { wanted, w_NB_B, p_BScm_B, period: tuning.period }, readings)
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
