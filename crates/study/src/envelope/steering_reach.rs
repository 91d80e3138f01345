//! How far steering by the pseudo-inverse gets along a direction before a singular surface stops it:
//! the honest size of an array whose law does not avoid or escape singularities.

use wrasse_hardware::{CMGS, ControlMomentGyro};
use wrasse_spatial::{Mat3, Vec3};

/// Where the steering ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SteeringReach {
    /// Momentum gained along the direction (N·m·s).
    pub momentum: f64,
    /// Gimbal angles there (rad).
    pub angles: [f64; CMGS],
}

/// How far along a path the steering gets.
#[derive(Debug, Clone, PartialEq)]
pub struct SteeringPath {
    /// Gimbal angles at each point that is reached (rad).
    pub angles: Vec<[f64; CMGS]>,
    /// Share of the way from the last point that is reached to the next one (–); none if all are.
    pub stopped: Option<f64>,
}

/// Largest turn of the gimbals in one step (rad).
const STEP: f64 = 0.01;
/// Momentum gained for each radian, as a share of the array's, below which the way has ended.
const STALLED: f64 = 2e-3;
/// Most steps between two points: a hundred radians.
const STEPS: usize = 10_000;
/// A point counts as reached within this share of the array's momentum.
const REACHED: f64 = 1e-6;

/// From `angles`, gather momentum along the unit vector `d` with gimbal rates of least norm, until
/// turning the gimbals no longer adds to it: at an internal singular surface, or at the envelope.
pub fn steering_reach(
    cmgs: &[ControlMomentGyro<f64>],
    angles: &[f64; CMGS],
    d: Vec3<f64>,
) -> SteeringReach {
    let start = momentum(cmgs, angles);
    let at = gathered(cmgs, angles, d, f64::INFINITY);
    SteeringReach { momentum: (momentum(cmgs, &at) - start).dot(d), angles: at }
}

/// From `angles`, follow a path of momenta (N·m·s, seen from the momentum at the start) with gimbal
/// rates of least norm, as far as that gets.
pub fn steering_path(
    cmgs: &[ControlMomentGyro<f64>],
    angles: &[f64; CMGS],
    path: &[Vec3<f64>],
) -> SteeringPath {
    let start = momentum(cmgs, angles);
    let all: f64 = cmgs.iter().map(|cmg| cmg.momentum).sum();
    let mut at = *angles;
    let mut reached = vec![];
    for point in path {
        let way = start + *point - momentum(cmgs, &at);
        let length = way.norm();
        let next =
            if length > 0.0 { gathered(cmgs, &at, way * (1.0 / length), length) } else { at };
        let missing = (start + *point - momentum(cmgs, &next)).norm();
        if missing.is_nan() || missing > REACHED * all {
            return SteeringPath {
                angles: reached,
                stopped: Some(1.0 - (missing / length).min(1.0)),
            };
        }
        at = next;
        reached.push(at);
    }
    SteeringPath { angles: reached, stopped: None }
}

/// Gimbal angles after gathering `most` (N·m·s) along the unit vector `d`, or as much as there is.
fn gathered(
    cmgs: &[ControlMomentGyro<f64>],
    angles: &[f64; CMGS],
    d: Vec3<f64>,
    most: f64,
) -> [f64; CMGS] {
    let all: f64 = cmgs.iter().map(|cmg| cmg.momentum).sum();
    let (mut at, mut left) = (*angles, most);
    for _ in 0..STEPS {
        // Fourth order in the turn of the gimbals, which gains this much a radian.
        let Some((k1, gain)) = way(cmgs, &at, d, STALLED * all) else { break };
        // A step too far is taken back.
        let step = (left / gain).clamp(-STEP, STEP);
        let Some((k2, _)) = way(cmgs, &moved(&at, &k1, 0.5 * step), d, 0.0) else { break };
        let Some((k3, _)) = way(cmgs, &moved(&at, &k2, 0.5 * step), d, 0.0) else { break };
        let Some((k4, _)) = way(cmgs, &moved(&at, &k3, step), d, 0.0) else { break };
        let next = [(k1, 1.0), (k2, 2.0), (k3, 2.0), (k4, 1.0)]
            .iter()
            .fold(at, |at, (k, weight)| moved(&at, k, step * weight / 6.0));
        let gained = (momentum(cmgs, &next) - momentum(cmgs, &at)).dot(d);
        // Past a singular surface the way leads back.
        if gained.is_nan() || gained * step <= 0.0 {
            break;
        }
        at = next;
        left -= gained;
        if left.abs() <= 0.1 * REACHED * all {
            break;
        }
    }
    at
}

fn momentum(cmgs: &[ControlMomentGyro<f64>], angles: &[f64; CMGS]) -> Vec3<f64> {
    cmgs.iter()
        .zip(angles)
        .fold(Vec3::zero(), |h, (cmg, &angle)| h + cmg.spin_axis(angle) * cmg.momentum)
}

fn moved(angles: &[f64; CMGS], way: &[f64; CMGS], step: f64) -> [f64; CMGS] {
    core::array::from_fn(|i| angles[i] + way[i] * step)
}

/// Rates of least norm that change the momentum along `d` alone, for one radian of turning, and what
/// that brings (N·m·s); none if it is no more than `least`.
fn way(
    cmgs: &[ControlMomentGyro<f64>],
    angles: &[f64; CMGS],
    d: Vec3<f64>,
    least: f64,
) -> Option<([f64; CMGS], f64)> {
    let columns: Vec<_> =
        cmgs.iter().zip(angles).map(|(cmg, &a)| cmg.torque_axis(a) * cmg.momentum).collect();
    let square = columns.iter().fold(Mat3::zero(), |sum, a| sum + a.outer(*a));
    // Where a direction is lost that nobody asks for, the others are still there.
    let trace: f64 = columns.iter().map(|a| a.dot(*a)).sum();
    let along = solved(&(square + Mat3::identity().scaled(1e-10 * trace)), d)?;
    let mut rates = [0.0; CMGS];
    rates.iter_mut().zip(&columns).for_each(|(rate, a)| *rate = a.dot(along));
    let norm = rates.iter().map(|r| r * r).sum::<f64>().sqrt();
    let rates = rates.map(|rate| rate / norm);
    let gained: f64 = columns.iter().zip(rates).map(|(a, rate)| a.dot(d) * rate).sum();
    (gained > least).then_some((rates, gained))
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
        let reach = steering_reach(&pyramid(0.6, 75.0), &[0.0; CMGS], X);
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
        let mut angles = [0.0; CMGS];
        angles[..4].copy_from_slice(&[eighth, -eighth, eighth, -eighth]);
        let cmgs = pyramid(0.6, 1.0);
        let reach = steering_reach(&cmgs, &angles, X);
        let outer = momentum_of(&cmgs).radius(X);
        // Measured 7e-6.
        assert!((reach.momentum - outer).abs() < 1e-4 && (outer - 3.2).abs() < 1e-8, "{reach:?}");
    }

    /// Across the corner of the pyramid nothing is in the way.
    #[test]
    fn along_its_axis_a_pyramid_reaches_its_envelope_from_zero_angles() {
        let reach = steering_reach(&pyramid(0.6, 1.0), &[0.0; CMGS], vec3(0.0, 0.0, 1.0));
        // Measured 1e-6.
        assert!((reach.momentum - 3.2).abs() < 1e-4, "{reach:?}");
    }

    #[test]
    fn a_path_is_followed_until_a_singular_surface_stops_it() {
        let cmgs = pyramid(0.6, 75.0);
        let path: Vec<_> = (0..=10).map(|k| X * (10.0 * f64::from(k))).collect();
        let followed = steering_path(&cmgs, &[0.0; CMGS], &path);
        // The surface is at 90 N·m·s.
        assert_eq!((followed.angles.len(), followed.stopped), (9, Some(followed.stopped.unwrap())));
        assert!(followed.stopped.unwrap() > 0.99, "{followed:?}");
        for (angles, point) in followed.angles.iter().zip(&path) {
            let missing = momentum(&cmgs, angles) - *point;
            // Measured 5.2e-6 of 300.
            assert!(missing.norm() < 3e-4, "{}", missing.norm());
        }
        let there_and_back = [X * 80.0, vec3(0.0, 60.0, 40.0), Vec3::zero()];
        assert_eq!(steering_path(&cmgs, &[0.0; CMGS], &there_and_back).stopped, None);
    }

    #[test]
    fn steering_that_is_started_at_a_singular_surface_goes_nowhere() {
        let quarter = core::f64::consts::FRAC_PI_2;
        let mut angles = [0.0; CMGS];
        angles[..4].copy_from_slice(&[-quarter, 0.0, quarter, 0.0]);
        assert_eq!(steering_reach(&pyramid(0.6, 1.0), &angles, X).momentum, 0.0);
        assert_eq!(steering_reach(&[], &angles, X).momentum, 0.0);
    }
}
