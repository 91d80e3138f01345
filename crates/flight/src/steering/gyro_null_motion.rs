//! Null motion of gimbals: away from singularities, without torque.

use super::span::{gram, least_norm, sum};
use wrasse_hardware::{ControlMomentGyro, GYROS};
use wrasse_spatial::{Mat3, Scalar, Vec3};

/// Gimbal rates that leave the momentum as it is and raise `det A Aᵀ` the fastest (–): its gradient
/// less the part that gives torque.
///
/// # Arguments
/// | name | meaning | unit |
/// |---|---|---|
/// | `axes` | columns of A | – |
/// | `mean` | momentum that A is measured by | N·m·s |
/// | `angles` | gimbal angles | rad |
///
/// # Source
/// [`Bedrossian1990`](wrasse_spatial::references::Bedrossian1990).
pub(super) fn null_motion<T: Scalar>(
    gyros: &[ControlMomentGyro<T>],
    axes: &[Vec3<T>; GYROS],
    used: [bool; GYROS],
    mean: T,
    angles: &[T; GYROS],
) -> [T; GYROS] {
    let gradient = singularity_gradient(gyros, axes, used, mean, angles);
    let torque = least_norm(axes, &used, sum(axes, &gradient));
    core::array::from_fn(|k| gradient[k] - torque[k])
}

/// Gradient of `det G`, `G = A Aᵀ`, by the angles (1/rad): `tr(adj G · dG)`, with
/// `dG = a' aᵀ + a a'ᵀ` and a' the opposite of the spin axis.
fn singularity_gradient<T: Scalar>(
    gyros: &[ControlMomentGyro<T>],
    axes: &[Vec3<T>; GYROS],
    used: [bool; GYROS],
    mean: T,
    angles: &[T; GYROS],
) -> [T; GYROS] {
    let [x, y, z] = gram(axes, &used).to_mat3().rows;
    let adjugate = Mat3::from_rows(y.cross(z), z.cross(x), x.cross(y));
    let mut gradient = [T::zero(); GYROS];
    for (k, gyro) in gyros.iter().enumerate().take(GYROS).filter(|(k, _)| used[*k]) {
        let slope = gyro.spin_axis(angles[k]) * (-gyro.momentum / mean);
        gradient[k] = T::from_f64(2.0) * slope.dot(adjugate * axes[k]);
    }
    gradient
}
