//! Null motion of gimbals: away from singularities, without torque.

use super::span::{gram, least_norm, sum};
use wrasse_hardware::{CMGS, ControlMomentGyro};
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
    cmgs: &[ControlMomentGyro<T>],
    axes: &[Vec3<T>; CMGS],
    used: [bool; CMGS],
    mean: T,
    angles: &[T; CMGS],
) -> [T; CMGS] {
    let gradient = singularity_gradient(cmgs, axes, used, mean, angles);
    let torque = least_norm(axes, &used, sum(axes, &gradient));
    core::array::from_fn(|k| gradient[k] - torque[k])
}

/// Gradient of `det G`, `G = A Aᵀ`, by the angles (1/rad): `tr(adj G · dG)`, with
/// `dG = a' aᵀ + a a'ᵀ` and a' the opposite of the spin axis.
fn singularity_gradient<T: Scalar>(
    cmgs: &[ControlMomentGyro<T>],
    axes: &[Vec3<T>; CMGS],
    used: [bool; CMGS],
    mean: T,
    angles: &[T; CMGS],
) -> [T; CMGS] {
    let [x, y, z] = gram(axes, &used).to_mat3().rows;
    let adjugate = Mat3::from_rows(y.cross(z), z.cross(x), x.cross(y));
    let mut gradient = [T::zero(); CMGS];
    for (k, cmg) in cmgs.iter().enumerate().take(CMGS).filter(|(k, _)| used[*k]) {
        let slope = cmg.spin_axis(angles[k]) * (-cmg.momentum / mean);
        gradient[k] = T::from_f64(2.0) * slope.dot(adjugate * axes[k]);
    }
    gradient
}
