//! The loops that a flight computer closes once a period, and how far each is from the bandwidth at
//! which it would be unstable as sampled (book/src/theory/sampled_loops.md).

use crate::case::AttitudeActuation;
use crate::case::Case;
use crate::figures::{rounded_down, rounded_up, shown};
use nalgebra::{Cholesky, DMatrix};
use wrasse_dynamics::{
    GeneralizedForce, State, attitude_held_dynamics, free_floating_dynamics, kinematics,
    mass_matrix,
};
use wrasse_flight::{ArmLaw, Feedforward, Measurement};
use wrasse_spatial::Real;
use wrasse_vehicle::{JOINTS, VehicleRobot};
use wrasse_world::BaseAttitude;

/// Distance of a bandwidth from its limit below which it is worth a remark (–): loops with half the
/// bandwidth of their limit still forgive a model that is wrong by a factor of two.
pub const REMARK_BELOW: f64 = 2.0;

/// Largest product of the guidance's gain and the control period (–): the spectral radius of
/// `[x v a] -> [(x+v/2+a/12) - (g/2+g²/12) p, -g p, g² p]`, `p = x+v+a/2`, is one there.
const TOOL_LIMIT: f64 = 2.261_324_772_583_615;

/// A loop that is closed once a period.
#[derive(Debug, Clone, PartialEq)]
pub struct SampledLoop {
    /// Which: `joints`, `attitude`, `position hold`, `tool`, `joint estimator`, `attitude estimator`.
    pub name: &'static str,
    /// Its bandwidth (rad/s); of the tool's guidance, its gain (1/s).
    pub bandwidth: f64,
    /// How often it is closed (Hz).
    pub rate_hz: f64,
    /// Largest bandwidth at which it is stable at this rate (rad/s); infinite: at any.
    pub limit: f64,
    /// Acceleration that the plant gives for one that the loop asks for (–): one unless the law takes the
    /// base for something else than it is.
    pub gain: f64,
    /// Key of its bandwidth in the table `[control]`.
    pub key: &'static str,
    /// Whether the servos of the CMGs set the limit, so that no rate helps.
    servos: bool,
}

impl SampledLoop {
    /// The limit over the bandwidth (–): unstable below one.
    pub fn margin(&self) -> f64 {
        self.limit / self.bandwidth
    }

    /// Bandwidth, rate, limit and margin in words.
    pub fn text(&self) -> String {
        let unit = if self.name == "tool" { "1/s" } else { "rad/s" };
        let at =
            format!("{} {} {unit} at {} Hz", self.name, shown(self.bandwidth), shown(self.rate_hz));
        if self.limit.is_infinite() {
            return format!("{at}, stable at any rate");
        }
        let by = if self.servos { " by the servos of the CMGs" } else { "" };
        let gain = if (self.gain - 1.0).abs() < 1e-6 {
            String::new()
        } else {
            format!(", the plant answers {} times what is asked", shown(self.gain))
        };
        format!(
            "{at}, limit {} {unit}{by}, margin {}{gain}",
            shown(self.limit),
            shown(self.margin())
        )
    }

    /// Whether it is unstable as sampled.
    pub fn is_unstable(&self) -> bool {
        let margin = self.margin();
        margin.is_nan() || margin < 1.0
    }

    /// What would help: the bandwidth or the rate at which it has the margin that is asked for.
    pub fn help(&self) -> String {
        let bandwidth = self.limit / REMARK_BELOW;
        let rate = rounded_up(self.rate_hz * REMARK_BELOW / self.margin());
        let or = if self.servos {
            String::new()
        } else {
            format!(", or control.rate_hz to {rate} or more,")
        };
        let (key, bandwidth) = (self.key, rounded_down(bandwidth));
        format!("set control.{key} to {bandwidth} or less{or} for a margin of {REMARK_BELOW}")
    }
}

/// All loops of a case, with its robot as it begins.
pub fn sampled_loops(case: &Case) -> Vec<SampledLoop> {
    let setup = &case.setup;
    let (tuning, rate_hz) = (&setup.tuning, 1.0 / setup.tuning.period);
    let add = |name, key, bandwidth: f64, limit: f64| {
        let found = SampledLoop { name, bandwidth, rate_hz, limit, gain: 1.0, key, servos: false };
        (bandwidth > 0.0).then_some(found)
    };
    let mut loops = vec![joint_loop(case, joint_gain(case, &case.robot_at_start(), &case.start))];
    if case.sensors.is_some_and(|s| s.encoder_step > 0.0) {
        let bandwidth = setup.navigation.joint_bandwidth;
        let key = "estimation.joint_bandwidth_rad_s";
        loops.push(add("joint estimator", key, bandwidth, f64::INFINITY));
    }
    if case.base == BaseAttitude::Controlled {
        let (bandwidth, damping) = (tuning.attitude_bandwidth, tuning.attitude_damping);
        let (sampled, by_servos) = (plain_limit(damping) * rate_hz, servo_limit(case, damping));
        let (key, limit) = ("attitude_bandwidth_rad_s", sampled.min(by_servos));
        let attitude = add("attitude", key, bandwidth, limit);
        loops.push(attitude.map(|found| SampledLoop { servos: by_servos < sampled, ..found }));
        loops.extend(setup.base.position_hold.as_ref().map(|hold| {
            let (key, limit) = ("position_hold.bandwidth_rad_s", plain_limit(hold.damping));
            add("position hold", key, hold.bandwidth, limit * rate_hz)
        }));
    }
    if setup.measurement == Measurement::Base {
        loops.push(add("tool", "tool_gain_per_s", tuning.tool_gain, TOOL_LIMIT * rate_hz));
    }
    loops.push(attitude_estimator(case));
    loops.into_iter().flatten().collect()
}

/// The loops of the joints that torques drive, on a plant that answers `gain` times what they ask.
pub(crate) fn joint_loop(case: &Case, gain: f64) -> Option<SampledLoop> {
    let tuning = &case.setup.tuning;
    let (bandwidth, rate_hz) = (tuning.joint_bandwidth, 1.0 / tuning.period);
    let limit = joint_limit(tuning.joint_damping, gain) * rate_hz;
    let key = "joint_bandwidth_rad_s";
    let there = bandwidth > 0.0 && case.torque.iter().any(|torque| *torque);
    there.then_some(SampledLoop {
        name: "joints",
        bandwidth,
        rate_hz,
        limit,
        gain,
        key,
        servos: false,
    })
}

/// The filter behind gyro and star tracker: about each axis a steady gain of `σ_v/(σ_n √T)` (rad/s).
fn attitude_estimator(case: &Case) -> Option<SampledLoop> {
    let (gyro, tracker) = case.sensors?.attitude?;
    let bandwidth = gyro.angle_random_walk / (tracker.noise_across * Real::sqrt(tracker.interval));
    (bandwidth > 0.0 && bandwidth.is_finite()).then_some(SampledLoop {
        name: "attitude estimator",
        bandwidth,
        rate_hz: 1.0 / tracker.interval,
        limit: f64::INFINITY,
        gain: 1.0,
        key: "estimation",
        servos: false,
    })
}

/// Largest product of bandwidth and period of the joint loops (–), on a plant that answers λ times what
/// is asked.
///
/// The torque is held over the period and counts with the rate half a period on:
/// `ë = -λ (2ζx + x²/2) ė/h - λ x² e/h²`, sampled, is stable below `λ (2ζx + x²/2) = 2`.
fn joint_limit(damping: f64, gain: f64) -> f64 {
    let z = 2.0 * damping;
    Real::sqrt(z * z + 4.0 / gain) - z
}

/// The same of a loop that counts with what is sensed as the period begins: stable for `ζ x < 1` and
/// `x < 4 ζ`.
fn plain_limit(damping: f64) -> f64 {
    (1.0 / damping).min(4.0 * damping)
}

/// Largest bandwidth of the attitude loop (rad/s) with servos of CMGs that lag by their bandwidth b:
/// `s³/b + s² + 2ζω s + ω²` is stable for `ω < 2ζ b`.
fn servo_limit(case: &Case, damping: f64) -> f64 {
    if case.actuation != AttitudeActuation::Fitted {
        return f64::INFINITY;
    }
    let servos = case.equipment.actuators.cmgs.iter().map(|cmg| cmg.servo_bandwidth);
    servos.fold(f64::INFINITY, |least, b| least.min(2.0 * damping * b))
}

/// Largest acceleration that joints get for one that their loop asks for (–): the largest eigenvalue of
/// the inertia of the plant, inverted, times that of the law.
pub(crate) fn joint_gain(case: &Case, robot: &VehicleRobot, state: &State<f64, JOINTS>) -> f64 {
    let law = case.setup.assignment.law;
    match (law, case.base) {
        // The law knows what holds the base.
        (ArmLaw::AttitudeHeld, BaseAttitude::Held | BaseAttitude::Controlled)
        | (ArmLaw::FreeFloating, BaseAttitude::Free | BaseAttitude::Controlled) => return 1.0,
        _ if !case.torque.iter().any(|torque| *torque) => return 1.0,
        _ => {}
    }
    let M = mass_matrix(&kinematics(robot, state));
    let none = GeneralizedForce::default();
    let driven: Vec<usize> = robot.joints().filter(|&j| case.torque[j]).collect();
    let of = |H: &[[f64; JOINTS]; JOINTS]| {
        DMatrix::from_fn(driven.len(), driven.len(), |i, j| H[driven[i]][driven[j]])
    };
    let (held, free) = (
        of(&attitude_held_dynamics(robot, &M, &none).H),
        of(&free_floating_dynamics(robot, &M, &none).H),
    );
    let bolted = of(&M.M_jj);
    let fed_forward = case.setup.base.feedforward == Feedforward::Exact;
    match (law, case.base) {
        (ArmLaw::Terrestrial, BaseAttitude::Held) => largest_ratio(&held, &bolted),
        (ArmLaw::Terrestrial, BaseAttitude::Controlled) if fed_forward => {
            1.0 + largest_ratio(&free, &(bolted - held))
        }
        (ArmLaw::Terrestrial, _) => largest_ratio(&free, &bolted),
        (ArmLaw::AttitudeHeld, _) => largest_ratio(&free, &held),
        (ArmLaw::FreeFloating, _) => largest_ratio(&held, &free),
    }
}

/// Largest eigenvalue of `plant⁻¹ law`, both symmetric and the first positive definite.
fn largest_ratio(plant: &DMatrix<f64>, law: &DMatrix<f64>) -> f64 {
    let Some(factor) = Cholesky::new(plant.clone()) else { return f64::INFINITY };
    let L = factor.l();
    let half = L.solve_lower_triangular(law).unwrap_or_else(|| law.clone());
    let both = L.solve_lower_triangular(&half.transpose()).unwrap_or_else(|| half.clone());
    let symmetric = (&both + both.transpose()) * 0.5;
    symmetric.symmetric_eigenvalues().iter().copied().fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use wrasse_testing::largest;

    /// Spectral radius of a 2×2 recursion.
    fn radius(m: [[f64; 2]; 2]) -> f64 {
        let matrix = nalgebra::Matrix2::from_row_slice(&m.concat());
        largest(matrix.complex_eigenvalues().iter().map(|e| e.norm()))
    }

    /// A double integrator under `a = -p e - d ė`, held over a period of one.
    fn sampled(p: f64, d: f64) -> [[f64; 2]; 2] {
        [[1.0 - 0.5 * p, 1.0 - 0.5 * d], [-p, 1.0 - d]]
    }

    #[test]
    fn the_joint_loop_is_stable_below_its_limit_and_unstable_above() {
        for (damping, gain) in [(1.0, 1.0), (0.7, 1.0), (1.0, 30.0), (0.3, 4.0), (2.0, 0.5)] {
            let limit = joint_limit(damping, gain);
            let at = |x: f64| {
                // The law counts with the position half a period on, at the rate that is sensed.
                let d = 2.0 * damping * x + 0.5 * x * x;
                radius(sampled(gain * x * x, gain * d))
            };
            assert!(at(0.99 * limit) < 1.0 && at(1.01 * limit) > 1.0, "{damping} {gain}");
        }
    }

    #[test]
    fn the_plain_loop_is_stable_below_its_limit_and_unstable_above() {
        for damping in [0.1, 0.3, 0.5, 0.7, 1.0, 3.0] {
            let limit = plain_limit(damping);
            let at = |x: f64| radius(sampled(x * x, 2.0 * damping * x));
            assert!(at(0.99 * limit) < 1.0 && at(1.01 * limit) > 1.0, "{damping}");
        }
    }

    #[test]
    fn the_guidance_is_stable_below_its_limit_and_unstable_above() {
        let at = |g: f64| {
            let p = nalgebra::RowVector3::new(1.0, 1.0, 0.5);
            let x = nalgebra::RowVector3::new(1.0, 0.5, 1.0 / 12.0) - p * (0.5 * g + g * g / 12.0);
            let matrix = nalgebra::Matrix3::from_rows(&[x, p * -g, p * (g * g)]);
            largest(matrix.complex_eigenvalues().iter().map(|e| e.norm()))
        };
        assert!(at(0.9999 * TOOL_LIMIT) < 1.0 && at(1.0001 * TOOL_LIMIT) > 1.0);
    }
}
