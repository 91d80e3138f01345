//! Roll, pitch and yaw, as vehicle files give orientations.

use wrasse_spatial::{Mat3, Real, Vec3, vec3};

/// `R_PB = Rz(yaw) Ry(pitch) Rx(roll)` from roll, pitch, yaw (rad): turns about the fixed axes of
/// P, roll first.
pub(crate) fn from_roll_pitch_yaw(rpy: Vec3<f64>) -> Mat3<f64> {
    let [(sr, cr), (sp, cp), (sy, cy)] = rpy.to_array().map(Real::sin_cos);
    Mat3::from_rows(
        vec3(cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr),
        vec3(sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr),
        vec3(-sp, cp * sr, cp * cr),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use wrasse_spatial::Quat;

    #[test]
    fn roll_comes_first_and_yaw_last_about_fixed_axes() {
        let (r, p, y) = (0.3, -0.7, 1.9);
        let turn = |a| Quat::exp(a).to_matrix();
        let by_turns = turn(vec3(0.0, 0.0, y)) * turn(vec3(0.0, p, 0.0)) * turn(vec3(r, 0.0, 0.0));
        let R = from_roll_pitch_yaw(vec3(r, p, y));
        let off = (R - by_turns).rows.map(Vec3::norm).into_iter().fold(0.0, f64::max);
        assert!(off < 4.0 * f64::EPSILON, "{off:e}");
    }
}
