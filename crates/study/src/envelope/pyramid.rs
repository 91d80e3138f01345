//! The four-CMG pyramid of the textbooks, for tests.

use super::solid::{Piece, Solid};
use wrasse_hardware::ControlMomentGyro;
use wrasse_spatial::vec3;

/// Four CMGs whose gimbal axes lean by the skew β from the pyramid's axis z: `cos β` and the momentum
/// of a rotor (N·m·s).
pub(crate) fn pyramid(c: f64, momentum: f64) -> [ControlMomentGyro<f64>; 4] {
    let s = (1.0 - c * c).sqrt();
    [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)].map(|(x, y)| ControlMomentGyro {
        gimbal_axis_B: vec3(s * x, s * y, c),
        spin_axis_B: vec3(-y, x, 0.0),
        momentum,
        ..Default::default()
    })
}

/// What they can hold together.
pub(crate) fn momentum_of(cmgs: &[ControlMomentGyro<f64>]) -> Solid {
    let pieces =
        cmgs.iter().map(|cmg| Piece::Disc { axis: cmg.gimbal_axis_B, radius: cmg.momentum });
    Solid { pieces: pieces.collect() }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `h/h0 = [-c sin1 - cos2 + c sin3 + cos4; cos1 - c sin2 - cos3 + c sin4; s (sin1 + … + sin4)]`.
    #[test]
    fn the_momentum_of_the_pyramid_is_the_printed_one() {
        use wrasse_spatial::Real;
        let angles = [0.3, -0.9, 1.7, 2.5];
        let h = pyramid(0.6, 1.0)
            .iter()
            .zip(angles)
            .fold(vec3(0.0, 0.0, 0.0), |h, (cmg, angle)| h + cmg.spin_axis(angle));
        let [(s1, c1), (s2, c2), (s3, c3), (s4, c4)] = angles.map(Real::sin_cos);
        let printed = vec3(
            -0.6 * s1 - c2 + 0.6 * s3 + c4,
            c1 - 0.6 * s2 - c3 + 0.6 * s4,
            0.8 * (s1 + s2 + s3 + s4),
        );
        // Measured 0.
        assert!((h - printed).norm() < 1e-15);
    }

    /// Support on the axes and its extremes for 53.13°; the reach for 54.74°: 4 sin β and 2 + 2 cos β.
    #[test]
    fn the_envelope_has_the_published_size() {
        let solid = momentum_of(&pyramid(0.6, 1.0));
        for axis in [vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0), vec3(0.0, 0.0, 1.0)] {
            assert!((solid.support(axis) - 3.2).abs() < 1e-15);
            // Measured 0.
            assert!((solid.radius(axis) - 3.2).abs() < 1e-9);
        }
        let (at, least) = solid.smallest_radius();
        // 2.8266: at the end of a gimbal axis, where each window is.
        assert!((least - 2.83).abs() < 0.005, "{least}");
        assert!((at.z.abs() - 0.6).abs() < 1e-6, "{at:?}");
        let most = super::super::directions::spread(20_000).map(|u| solid.support(u));
        // 3.2998.
        assert!((wrasse_testing::largest(most) - 3.30).abs() < 0.005);

        let third = momentum_of(&pyramid(1.0 / 3.0_f64.sqrt(), 1.0));
        assert!((third.radius(vec3(0.0, 0.0, 1.0)) - 3.266).abs() < 5e-4);
        assert!((third.radius(vec3(1.0, 0.0, 0.0)) - 3.155).abs() < 5e-4);
    }
}
