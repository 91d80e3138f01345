//! Rotations given in degrees, as people write them: quarter turns are exact.

use wrasse_spatial::{Mat3, Real, vec3};

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
    use crate::roll_pitch_yaw::from_roll_pitch_yaw;
    use wrasse_spatial::Vec3;

    #[test]
    fn degrees_turn_as_the_same_angles_in_radians_do() {
        let rpy = [12.0, -75.0, 211.0];
        let by_radians = from_roll_pitch_yaw(Vec3::from_array(rpy.map(f64::to_radians)));
        let off = (from_rpy_deg(rpy) - by_radians).rows.map(Vec3::norm);
        let off = off.into_iter().fold(0.0, f64::max);
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
}
