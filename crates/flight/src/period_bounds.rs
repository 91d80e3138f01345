//! Bounds of what goes into a control period. What lies beyond them no sensor says and no plan asks; it
//! is a fault of a word, and is refused before it is flown.

use crate::control_period::ArmReference;
use crate::trajectory::ToolMotion;
use wrasse_dynamics::State;
use wrasse_spatial::{Pose, Scalar, SpatialForce, SpatialVelocity};

/// A quantity of a control period that has bounds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// How the base or the tool is turned: elements of a rotation.
    Attitude,
    /// Where the base or the tool is (m).
    Position,
    /// How fast it turns (rad/s).
    AngularVelocity,
    /// How fast it goes (m/s).
    Velocity,
    /// Change of the angular velocity per time (rad/s²).
    AngularAcceleration,
    /// Change of the velocity per time (m/s²).
    Acceleration,
    /// Joint positions (rad or m).
    JointPosition,
    /// Joint rates (rad/s or m/s).
    JointRate,
    /// Joint accelerations (rad/s² or m/s²).
    JointAcceleration,
    /// Torque of a push at the tool (N·m).
    ToolTorque,
    /// Force of a push at the tool (N).
    ToolForce,
    /// Drift towards the preferred posture (1/s).
    PostureGain,
    /// How fast that changes (1/s²).
    PostureGainRate,
    /// Torque or force of a joint (N·m or N): within its limit, if it has one.
    Effort,
    /// Torque that the base should feel (N·m): finite.
    AttitudeTorque,
    /// Force that the base should feel (N): finite.
    ForceAhead,
}

impl Quantity {
    /// Largest magnitude, in the unit of the quantity.
    pub const fn bound(self) -> f64 {
        match self {
            // Rounding of a rotation that was kept in single precision.
            Self::Attitude => 1.0 + 1e-5,
            // What a wrong one does to the tool's motion within a period grows with these two.
            Self::AngularVelocity | Self::PostureGain => 10.0,
            Self::Velocity
            | Self::AngularAcceleration
            | Self::Acceleration
            | Self::JointRate
            | Self::PostureGainRate => 100.0,
            // In axes that fall with the vehicle. A joint that turns at 0.2 rad/s gets there after two
            // months.
            Self::Position | Self::JointPosition | Self::ToolTorque | Self::ToolForce => 1e6,
            Self::JointAcceleration => 1e4,
            // Theirs are those of the set-up, or none.
            Self::Effort | Self::AttitudeTorque | Self::ForceAhead => f64::MAX,
        }
    }
}

/// A number that is not finite, or beyond its bound.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OutOfBounds<T> {
    /// What it is.
    pub quantity: Quantity,
    /// Number of the joint or of the element.
    pub index: usize,
    /// What was found.
    pub found: T,
}

/// Each of these numbers is finite and within a bound.
pub(crate) fn within<T: Scalar>(
    quantity: Quantity,
    bound: T,
    numbers: impl IntoIterator<Item = T>,
) -> Result<(), OutOfBounds<T>> {
    for (index, found) in numbers.into_iter().enumerate() {
        // Written so that NaN is beyond every bound.
        let inside = found.abs() <= bound;
        if !inside {
            return Err(OutOfBounds { quantity, index, found });
        }
    }
    Ok(())
}

/// The same with the bound of the quantity.
fn bounded<T: Scalar>(
    quantity: Quantity,
    numbers: impl IntoIterator<Item = T>,
) -> Result<(), OutOfBounds<T>> {
    within(quantity, T::from_f64(quantity.bound()), numbers)
}

/// What the sensors say of a robot with so many joints, and a push that is felt at its tool.
///
/// # Errors
/// The first number that is not finite or beyond its bound.
pub fn check_reading<T: Scalar, const J: usize>(
    sensed: &State<T, J>,
    joints: usize,
    tool_wrench_E: Option<&SpatialForce<T>>,
) -> Result<(), OutOfBounds<T>> {
    check_pose(&sensed.X_NB)?;
    check_velocity(&sensed.V_NB_B)?;
    bounded(Quantity::JointPosition, sensed.q.into_iter().take(joints))?;
    bounded(Quantity::JointRate, sensed.v.into_iter().take(joints))?;
    let Some(F_E) = tool_wrench_E else { return Ok(()) };
    bounded(Quantity::ToolTorque, F_E.torque.to_array())?;
    bounded(Quantity::ToolForce, F_E.force.to_array())
}

/// The reference of a robot with so many joints.
///
/// # Errors
/// The first number that is not finite or beyond its bound.
pub fn check_reference<T: Scalar, const J: usize>(
    reference: &ArmReference<T, J>,
    joints: usize,
) -> Result<(), OutOfBounds<T>> {
    match reference {
        ArmReference::Tool {
            reference: ToolMotion { X_NE, V_NE_N, Vdot_NE_N },
            gain,
            gain_rate,
            ..
        } => {
            check_pose(X_NE)?;
            check_velocity(V_NE_N)?;
            bounded(Quantity::AngularAcceleration, Vdot_NE_N.angular.to_array())?;
            bounded(Quantity::Acceleration, Vdot_NE_N.linear.to_array())?;
            bounded(Quantity::PostureGain, [*gain])?;
            bounded(Quantity::PostureGainRate, [*gain_rate])
        }
        ArmReference::Joints(at) => {
            bounded(Quantity::JointPosition, at.q.into_iter().take(joints))?;
            bounded(Quantity::JointRate, at.v.into_iter().take(joints))?;
            bounded(Quantity::JointAcceleration, at.vdot.into_iter().take(joints))
        }
        ArmReference::Rates { qdot, qddot } => {
            bounded(Quantity::JointRate, qdot.iter().copied().take(joints))?;
            bounded(Quantity::JointAcceleration, qddot.iter().copied().take(joints))
        }
        ArmReference::Still | ArmReference::Coast => Ok(()),
    }
}

fn check_pose<T: Scalar>(X: &Pose<T>) -> Result<(), OutOfBounds<T>> {
    let R = &X.rotation;
    bounded(Quantity::Attitude, R.rows.iter().flat_map(|row| row.to_array()))?;
    // The elements are finite, so this is.
    let close = T::from_f64(Quantity::Attitude.bound() - 1.0);
    within(Quantity::Attitude, close, [R.orthogonality_error()])?;
    bounded(Quantity::Position, X.translation.to_array())
}

fn check_velocity<T: Scalar>(V: &SpatialVelocity<T>) -> Result<(), OutOfBounds<T>> {
    bounded(Quantity::AngularVelocity, V.angular.to_array())?;
    bounded(Quantity::Velocity, V.linear.to_array())
}
