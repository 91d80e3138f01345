//! Control of the base: the torque and force that it should feel, and who gives them.

use crate::allocation::{Allocation, Allocator, Demand, Unit};
use crate::law::Tuning;
use crate::period_command::ControlOutput;
use crate::setup::{Actuation, BaseControlSetup};
use wrasse_dynamics::{Robot, State, kinematics, momentum};
use wrasse_hardware::ActuatorReadings;
use wrasse_spatial::{Scalar, SpatialForce, Vec3};

/// Attitude and position loops and the control allocation behind them.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BaseControl<T> {
    setup: BaseControlSetup<T>,
    allocator: Option<Allocator<T>>,
    /// Momentum that an ideal actuator stores by its commands, base axes (N·m·s).
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
        let allocator = setup.actuation.allocation().map(Allocator::new);
        Self { allocator, setup, stored_B: Vec3::zero(), home: None }
    }

    /// Commands by which the base feels the torque of `output`, and the part of it that it will not
    /// feel (N·m, base axes).
    pub(crate) fn command<const J: usize>(
        &mut self,
        robot: &Robot<T, J>,
        tuning: &Tuning<T>,
        output: &ControlOutput<T, J>,
        sensed: &State<T, J>,
        readings: &ActuatorReadings<T>,
    ) -> (Allocation<T>, Vec3<T>) {
        let mut force_B = self.holding_force(robot, sensed, tuning.period);
        if self.setup.position_hold.is_some() {
            force_B += output.ahead_force_B;
        }
        let w_NB_B = sensed.V_NB_B.angular;
        let Some(allocator) = &mut self.allocator else {
            let given_B = self.ideal_torque(output.attitude_torque_B, w_NB_B, tuning.period);
            return (Allocation::nothing(), output.attitude_torque_B - given_B);
        };
        let wanted = SpatialForce::new(output.attitude_torque_B, force_B);
        let p_BScm_B = output.M_B.centre_of_mass();
        let demand = Demand { wanted, w_NB_B, p_BScm_B, period: tuning.period };
        let allocation = allocator.allocate(&demand, readings);
        (allocation, output.attitude_torque_B - allocation.expected_B)
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

    /// Nothing is controlled for a while: no error is integrated.
    pub(crate) fn reset(&mut self) -> Allocation<T> {
        if let Some(allocator) = &mut self.allocator {
            allocator.reset();
        }
        Allocation::nothing()
    }

    /// Disable a unit from now on.
    pub(crate) fn disable(&mut self, unit: Unit) {
        if let Some(allocator) = &mut self.allocator {
            allocator.disable(unit);
        }
    }
}
