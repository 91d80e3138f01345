//! How far steering by the pseudo-inverse gets along a direction before a singular surface stops it:
//! the honest size of an array whose law does not avoid or escape singularities.

use wrasse_hardware::{ControlMomentGyro, GYROS};
use wrasse_spatial::{Mat3, Vec3};

/// Where the steering ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SteeringReach {
    /// Momentum gained along the direction (N·m·s).
    pub momentum: f64,
    /// Gimbal angles there (rad).
    pub angles: [f64; GYROS],
}

/// Largest turn of the gimbals in one step (rad).
const STEP: f64 = 0.01;
/// Momentum gained for each radian, as a share of the array's, below which the way has ended.
const STALLED: f64 = 2e-3;
/// Most steps: a hundred radians.
const STEPS: usize = 10_000;

/// From `angles`, gather momentum along the unit vector `d` with gimbal rates of least norm, until
/// turning the gimbals no longer adds to it: at an internal singular surface, or at the envelope.
pub fn steering_reach(
    gyros: &[ControlMomentGyro<f64>],
    angles: &[f64; GYROS],
    d: Vec3<f64>,
) -> SteeringReach {
    let mut at = *angles;
    let start = momentum(gyros, &at);
    let all: f64 = gyros.iter().map(|gyro| gyro.momentum).sum();
    for _ in 0..STEPS {
        // Fourth order in the turn of the gimbals.
        let Some(k1) = way(gyros, &at, d, STALLED * all) else { break };
        let Some(k2) = way(gyros, &moved(&at, &k1, 0.5 * STEP), d, 0.0) else { break };
        let Some(k3) = way(gyros, &moved(&at, &k2, 0.5 * STEP), d, 0.0) else { break };
        let Some(k4) = way(gyros, &moved(&at, &k3, STEP), d, 0.0) else { break };
        let next = [(k1, 1.0), (k2, 2.0), (k3, 2.0), (k4, 1.0)]
            .iter()
            .fold(at, |at, (k, weight)| moved(&at, k, STEP * weight / 6.0));
        // Past the singular surface the way leads back.
        if (momentum(gyros, &next) - momentum(gyros, &at)).dot(d) <= 0.0 {
            break;
        }
        at = next;
    }
    SteeringReach { momentum: (momentum(gyros, &at) - start).dot(d), angles: at }
}

fn momentum(gyros: &[ControlMomentGyro<f64>], angles: &[f64; GYROS]) -> Vec3<f64> {
    gyros
        .iter()
        .zip(angles)
        .fold(Vec3::zero(), |h, (gyro, &angle)| h + gyro.spin_axis(angle) * gyro.momentum)
}

fn moved(angles: &[f64; GYROS], way: &[f64; GYROS], step: f64) -> [f64; GYROS] {
    core::array::from_fn(|i| angles[i] + way[i] * step)
}

/// Rates of least norm that change the momentum along `d` alone, for one radian of turning; none if
/// a radian brings no more than `least`.
fn way(
    gyros: &[ControlMomentGyro<f64>],
    angles: &[f64; GYROS],
    d: Vec3<f64>,
    least: f64,
) -> Option<[f64; GYROS]> {
    let columns: Vec<_> =
        gyros.iter().zip(angles).map(|(gyro, &a)| gyro.torque_axis(a) * gyro.momentum).collect();
    let square = columns.iter().fold(Mat3::zero(), |sum, a| sum + a.outer(*a));
    // Where a direction is lost that nobody asks for, the others are still there.
    let trace: f64 = columns.iter().map(|a| a.dot(*a)).sum();
    let along = solved(&(square + Mat3::identity().scaled(1e-10 * trace)), d)?;
    let mut rates = [0.0; GYROS];
    rates.iter_mut().zip(&columns).for_each(|(rate, a)| *rate = a.dot(along));
    let norm = rates.iter().map(|r| r * r).sum::<f64>().sqrt();
    let rates = rates.map(|rate| rate / norm);
    let gained: f64 = columns.iter().zip(rates).map(|(a, rate)| a.dot(d) * rate).sum();
    (gained > least).then_some(rates)
}

/// Solution of `A x = b` by Cramer's rule; none if there is no single one.
fn solved(A: &Mat3<f64>, b: Vec3<f64>) -> Option<Vec3<f64>> {
    let [a1, a2, a3] = [0, 1, 2].map(|k| A.column(k));
    let volume = a1.dot(a2.cross(a3));
    let x = Vec3 { x: b.dot(a2.cross(a3)), y: a1.dot(b.cross(a3)), z: a1.dot(a2.cross(b)) };
    (volume.abs() > 0.0).then(|| x * (1.0 / volume))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::envelope::pyramid::{momentum_of, pyramid};
    use wrasse_spatial::vec3;

    const X: Vec3<f64> = vec3(1.0, 0.0, 0.0);

    /// The classic figure: -90°, 0°, 90°, 0° at 2 cos β = 1.2 times a rotor's momentum.
    #[test]
    fn a_pyramid_from_zero_angles_stops_at_twice_the_cosine_of_its_skew() {
        let reach = steering_reach(&pyramid(0.6, 75.0), &[0.0; GYROS], X);
        // It ends some milliradians early. Measured 3.9e-5.
        assert!((reach.momentum / 75.0 - 1.2).abs() < 1e-4, "{}", reach.momentum / 75.0);
        let quarter = core::f64::consts::FRAC_PI_2;
        for (angle, expected) in reach.angles.iter().zip([-quarter, 0.0, quarter, 0.0]) {
            // Within a step. Measured 8e-3.
            assert!((angle - expected).abs() < 1e-2, "{angle} {expected}");
        }
    }

    #[test]
    fn a_pyramid_from_preferred_angles_reaches_its_envelope() {
        let eighth = core::f64::consts::FRAC_PI_4;
        let mut angles = [0.0; GYROS];
        angles[..4].copy_from_slice(&[eighth, -eighth, eighth, -eighth]);
        let gyros = pyramid(0.6, 1.0);
        let reach = steering_reach(&gyros, &angles, X);
        let outer = momentum_of(&gyros).radius(X);
        // Measured 7e-6.
        assert!((reach.momentum - outer).abs() < 1e-4 && (outer - 3.2).abs() < 1e-8, "{reach:?}");
    }

    /// Across the corner of the pyramid nothing is in the way.
    #[test]
    fn along_its_axis_a_pyramid_reaches_its_envelope_from_zero_angles() {
        let reach = steering_reach(&pyramid(0.6, 1.0), &[0.0; GYROS], vec3(0.0, 0.0, 1.0));
        // Measured 1e-6.
        assert!((reach.momentum - 3.2).abs() < 1e-4, "{reach:?}");
    }

    #[test]
    fn steering_that_is_started_at_a_singular_surface_goes_nowhere() {
        let quarter = core::f64::consts::FRAC_PI_2;
        let mut angles = [0.0; GYROS];
        angles[..4].copy_from_slice(&[-quarter, 0.0, quarter, 0.0]);
        assert_eq!(steering_reach(&pyramid(0.6, 1.0), &angles, X).momentum, 0.0);
        assert_eq!(steering_reach(&[], &angles, X).momentum, 0.0);
    }
}
