//! Attitude control: proportional and derivative on the quaternion error, plus what is fed forward.

use crate::law::Tuning;
use wrasse_spatial::{Quat, Real, Vec3};

/// Angular acceleration (rad/s², base axes) that turns the base back: `2 ω² ε - 2ζω w`, with ε the
/// vector part of the error quaternion on its shorter side (half the angle).
///
/// # Arguments
/// | name | meaning | unit |
/// |---|---|---|
/// | `quat_NB` | measured attitude | – |
/// | `w_NB_B` | measured rate, base axes | rad/s |
/// | `quat_ND` | wanted attitude, at rest | – |
///
/// # Source
/// [`Wie2008`](wrasse_spatial::references::Wie2008) ch. 7: quaternion feedback.
#[inline(always)]
pub fn attitude_acceleration<T: Real>(
    tuning: &Tuning<T>,
    quat_NB: &Quat<T>,
    w_NB_B: Vec3<T>,
    quat_ND: &Quat<T>,
) -> Vec3<T> {
    let error = quat_NB.conjugate() * *quat_ND;
    let side = T::select(error.w.lt(T::zero()), -T::one(), T::one());
    let two = T::from_f64(2.0);
    let stiffness = tuning.attitude_bandwidth * tuning.attitude_bandwidth;
    let damping = two * tuning.attitude_damping * tuning.attitude_bandwidth;
    error.vector() * (side * two * stiffness) - w_NB_B * damping
}
