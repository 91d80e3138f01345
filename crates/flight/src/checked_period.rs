//! A control period that is checked on both sides: readings and reference against their bounds, output and
//! memory for being finite. Until all of it holds nothing is kept.

use crate::control_period::{ArmReference, PeriodMemory, control_period};
use crate::period_bounds::{OutOfBounds, Quantity, check_reading, check_reference, within};
use crate::period_command::ControlOutput;
use crate::resolved_motion::{Belief, Resolved, ResolvedMotion};
use crate::setup::Setup;
use wrasse_dynamics::{Robot, State};
use wrasse_hardware::SetPoint;
use wrasse_spatial::{Pose, Scalar, SpatialForce, SpatialInertia, SpatialVelocity};

/// Why a period is refused.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PeriodFault<T> {
    /// A reading is not finite, or beyond its bound.
    Reading(OutOfBounds<T>),
    /// The same of the reference.
    ArmReference(OutOfBounds<T>),
    /// The same of the output.
    ControlOutput(OutOfBounds<T>),
    /// A number that would be remembered is not finite.
    Memory,
}

/// One [`control_period`], or none at all: a period that is refused leaves the memory as it was, so that
/// later periods are those of a flight without it.
///
/// # Errors
/// A reading or a wish beyond its bound ([`Quantity::bound`]), or a result that is not finite, beyond its
/// bound or above the limit of an effort.
pub fn checked_period<T: Scalar, const J: usize>(
    robot: &Robot<T, J>,
    setup: &Setup<T, J>,
    memory: &mut PeriodMemory<T, J>,
    sensed: &State<T, J>,
    reference: &ArmReference<T, J>,
    tool_wrench_E: Option<&SpatialForce<T>>,
) -> Result<ControlOutput<T, J>, PeriodFault<T>> {
    let joints = robot.joint_count();
    check_reading(sensed, joints, tool_wrench_E).map_err(PeriodFault::Reading)?;
    check_reference(reference, joints).map_err(PeriodFault::ArmReference)?;
    let mut next = *memory;
    let output = control_period(robot, setup, &mut next, sensed, reference, tool_wrench_E);
    check_output(setup, &output, joints).map_err(PeriodFault::ControlOutput)?;
    if !next.is_finite() {
        return Err(PeriodFault::Memory);
    }
    *memory = next;
    Ok(output)
}

impl<T: Scalar, const J: usize> PeriodMemory<T, J> {
    /// Output where a period is refused: no torque, no force, and the last set-points, at rest.
    pub fn safe_output(&self) -> ControlOutput<T, J> {
        let at_rest = |s: SetPoint<T>| SetPoint { position: s.position, ..SetPoint::default() };
        ControlOutput::nothing(self.now.map(at_rest), SpatialInertia::zero())
    }

    /// Whether every number in it is finite.
    fn is_finite(&self) -> bool {
        // Each field by its name: one that is added must be looked at too.
        let Self {
            belief, motion, reference, acceleration, now, joint_momentum_B, innovation, ..
        } = self;
        let Belief { X_NB, q, h_Scm_N } = belief;
        let ResolvedMotion { rate: Resolved { qdot, V_NB_B }, qddot, A_NB_B } = motion;
        let mut rest = Rest::none();
        rest.pose(X_NB);
        rest.pose(&reference.X_NE);
        for V in [V_NB_B, A_NB_B, innovation, &reference.V_NE_N, &reference.Vdot_NE_N] {
            rest.twist(V);
        }
        rest.numbers(joint_momentum_B.to_array());
        rest.numbers(h_Scm_N.torque.to_array());
        rest.numbers(h_Scm_N.force.to_array());
        for joints in [q, qdot, qddot, acceleration] {
            rest.numbers(*joints);
        }
        for s in now {
            rest.numbers([s.position, s.rate, s.acceleration]);
        }
        rest.is_none()
    }
}

/// What is left of numbers times zero: nothing, or NaN if one was not finite.
struct Rest<T>(T);

impl<T: Scalar> Rest<T> {
    fn none() -> Self {
        Self(T::zero())
    }

    fn numbers(&mut self, numbers: impl IntoIterator<Item = T>) {
        numbers.into_iter().for_each(|x| self.0 += x * T::zero());
    }

    fn pose(&mut self, X: &Pose<T>) {
        X.rotation.rows.iter().for_each(|row| self.numbers(row.to_array()));
        self.numbers(X.translation.to_array());
    }

    fn twist(&mut self, V: &SpatialVelocity<T>) {
        self.numbers(V.angular.to_array());
        self.numbers(V.linear.to_array());
    }

    fn is_none(&self) -> bool {
        self.0 == T::zero()
    }
}

/// Set-points within the bounds of readings, efforts within their limits, the rest finite.
fn check_output<T: Scalar, const J: usize>(
    setup: &Setup<T, J>,
    output: &ControlOutput<T, J>,
    joints: usize,
) -> Result<(), OutOfBounds<T>> {
    let bound = |quantity: Quantity| T::from_f64(quantity.bound());
    let largest = |quantity, pick: fn(&SetPoint<T>) -> T| {
        within(quantity, bound(quantity), output.set_points.iter().map(pick).take(joints))
    };
    largest(Quantity::JointPosition, |s| s.position)?;
    largest(Quantity::JointRate, |s| s.rate)?;
    finite(Quantity::JointAcceleration, output.set_points.iter().map(|s| s.acceleration))?;
    for (index, (found, limits)) in output.effort.iter().zip(&setup.limits).enumerate() {
        // Scaling by the share of the limit rounds twice.
        let over = T::one() + T::from_f64(4.0) * T::epsilon();
        let inside = limits.effort.is_none_or(|limit| found.abs() <= limit * over);
        if !(inside && found.is_finite()) {
            return Err(OutOfBounds { quantity: Quantity::Effort, index, found: *found });
        }
    }
    finite(Quantity::AttitudeTorque, output.attitude_torque_B.to_array())?;
    finite(Quantity::ForceAhead, output.ahead_force_B.to_array())
}

fn finite<T: Scalar>(
    quantity: Quantity,
    numbers: impl IntoIterator<Item = T>,
) -> Result<(), OutOfBounds<T>> {
    for (index, found) in numbers.into_iter().enumerate() {
        if !found.is_finite() {
            return Err(OutOfBounds { quantity, index, found });
        }
    }
    Ok(())
}
