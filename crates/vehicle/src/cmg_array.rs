//! Arrays of control moment gyros: where the axes of each CMG point, in the array's frame, and where
//! the gimbals start.

use crate::rotation_in_degrees::sin_cos;
#[cfg(doc)]
use wrasse_spatial::references::WieBaileyHeiberg2001;
use wrasse_spatial::{Vec3, vec3};

/// The mounting of one CMG: gimbal axis, and spin axis at zero gimbal angle (–).
pub(crate) type Mounting = (Vec3<f64>, Vec3<f64>);

/// Four CMGs on the faces of a pyramid; CMG k+1 is CMG 1 turned by k right angles about z.
///
/// With spin axes `s cos δ + (g × s) sin δ` its momentum, in units of one rotor's, is
/// `(-c s1 - c2 + c s3 + c4, c1 - c s2 - c3 + c s4, s (s1 + s2 + s3 + s4))`.
///
/// # Source
/// The numbering and the zero angles of [WieBaileyHeiberg2001].
pub(crate) fn pyramid(skew_deg: f64) -> Vec<Mounting> {
    let (s, c) = sin_cos(skew_deg);
    [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)]
        .map(|(x, y)| (vec3(s * x, s * y, c), vec3(-y, x, 0.0)))
        .to_vec()
}

/// Two rows of CMGs on the slopes of a roof whose ridge is x.
pub(crate) fn roof(skew_deg: f64, count: usize) -> Vec<Mounting> {
    let (s, c) = sin_cos(skew_deg);
    let row = |side: f64| (vec3(0.0, side * s, c), vec3(side, 0.0, 0.0));
    let half = count / 2;
    (0..count).map(|k| row(if k < half { 1.0 } else { -1.0 })).collect()
}

/// Four CMGs in the upright sides of a box.
pub(crate) fn four_sides() -> Vec<Mounting> {
    pyramid(90.0)
}

/// Gimbal angles of a roof (deg) without momentum and with torque about every axis: the CMGs of a row
/// are spread, and what is left along the ridge is made up for by the other row.
pub(crate) fn roof_angles_deg(count: usize) -> Vec<f64> {
    let half = count / 2;
    let last = half.saturating_sub(1).max(1) as f64;
    (0..count).map(|k| 45.0 * (2.0 * (k % half.max(1)) as f64 / last - 1.0)).collect()
}

/// Gimbal angles of a box (deg) without momentum and with torque about every axis.
pub(crate) const BOX_ANGLES_DEG: [f64; 4] = [45.0, -45.0, 45.0, -45.0];
