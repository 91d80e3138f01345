//! Rotations as vehicle files give them: in degrees, where quarter turns are exact, and in radians.

use wrasse_spatial::{Mat3, Real, Vec3, vec3};

/// Turn about x (deg): `R_PB` of a frame B turned so from P.
pub(crate) fn about_x(deg: f64) -> Mat3<f64> {
    let (s, c) = sin_cos(deg);
    Mat3::from_rows(vec3(1.0, 0.0, 0.0), vec3(0.0, c, -s), vec3(0.0, s, c))
}

/// Turn about y (deg).
pub(crate) fn about_y(deg: f64) -> Mat3<f64> {
    let (s, c) = sin_cos(deg);
    Mat3::from_rows(vec3(c, 0.0, s), vec3(0.0, 1.0, 0.0), vec3(-s, 0.0, c))
}

/// Turn about z (deg).
pub(crate) fn about_z(deg: f64) -> Mat3<f64> {
    let (s, c) = sin_cos(deg);
    Mat3::from_rows(vec3(c, -s, 0.0), vec3(s, c, 0.0), vec3(0.0, 0.0, 1.0))
}

/// `R_PB = Rz(yaw) Ry(pitch) Rx(roll)` from roll, pitch, yaw (deg): turns about the fixed axes of P,
/// roll first.
pub fn from_rpy_deg([roll, pitch, yaw]: [f64; 3]) -> Mat3<f64> {
    about_z(yaw) * about_y(pitch) * about_x(roll)
}

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

/// Sine and cosine of an angle in degrees. A file that says 90 means a right angle, and its
/// conversion to radians is not one.
pub(crate) fn sin_cos(deg: f64) -> (f64, f64) {
    let quarters = deg / 90.0;
    if quarters % 1.0 != 0.0 {
        return Real::sin_cos(deg.to_radians());
    }
    match quarters.rem_euclid(4.0) {
        0.0 => (0.0, 1.0),
        1.0 => (1.0, 0.0),
        2.0 => (0.0, -1.0),
        _ => (-1.0, 0.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use wrasse_spatial::Quat;
    use wrasse_testing::largest;

    #[test]
    fn degrees_turn_as_the_same_angles_in_radians_do() {
        let rpy = [12.0, -75.0, 211.0];
        let by_radians = from_roll_pitch_yaw(Vec3::from_array(rpy.map(f64::to_radians)));
        let off = (from_rpy_deg(rpy) - by_radians).rows.map(Vec3::norm);
        let off = largest(off);
        assert!(off < 4.0 * f64::EPSILON, "measured 0: {off:e}");
    }

    #[test]
    fn quarter_turns_are_exact() {
        let y = vec3(0.0, 1.0, 0.0);
        assert_eq!(about_x(90.0) * y, vec3(0.0, 0.0, 1.0));
        assert_eq!(about_x(-90.0) * y, vec3(0.0, 0.0, -1.0));
        assert_eq!(about_z(540.0) * y, vec3(0.0, -1.0, 0.0));
        assert_eq!(about_y(-270.0) * vec3(0.0, 0.0, 1.0), vec3(1.0, 0.0, 0.0));
    }

    #[test]
    fn roll_comes_first_and_yaw_last_about_fixed_axes() {
        let (r, p, y) = (0.3, -0.7, 1.9);
        let turn = |a| Quat::exp(a).to_matrix();
        let by_turns = turn(vec3(0.0, 0.0, y)) * turn(vec3(0.0, p, 0.0)) * turn(vec3(r, 0.0, 0.0));
        let R = from_roll_pitch_yaw(vec3(r, p, y));
        let off = largest((R - by_turns).rows.map(Vec3::norm));
        assert!(off < 4.0 * f64::EPSILON, "{off:e}");
    }
}
