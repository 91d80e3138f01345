//! Laws on random arrays, and the least peak by another route.

use super::arrays::*;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use wrasse_flight::allocation::{WheelLaw, WheelSharing, wheel_torques};
use wrasse_hardware::{ReactionWheel, WHEELS};
use wrasse_spatial::{Mat3, Vec3, vec3};
use wrasse_testing::larger;

/// The least peak by vertices of the other side: in the best solution all but two shares stand at
/// `±t`. Every pair, every pattern of signs, a 3×3 system for the two and t; the least feasible t.
fn least_peak_by_vertices(wheels: &[ReactionWheel<f64>], wanted: Vec3<f64>) -> f64 {
    let axes: Vec<_> = wheels.iter().map(|w| w.axis_B * w.torque_limit).collect();
    let mut least = f64::INFINITY;
    for i in 0..axes.len() {
        for j in 0..i {
            let others: Vec<_> = (0..axes.len()).filter(|k| *k != i && *k != j).collect();
            for signs in 0..1_u32 << others.len() {
                let side = |bit: usize| if signs >> bit & 1 == 1 { 1.0 } else { -1.0 };
                let at_peak = others.iter().enumerate();
                let sum = at_peak.fold(Vec3::zero(), |sum, (bit, &k)| sum + axes[k] * side(bit));
                let M = Mat3::from_columns(axes[i], axes[j], sum);
                let x = solve(&M, wanted);
                let holds = larger(x.x.abs(), x.y.abs()) <= x.z * (1.0 + 1e-9);
                if holds && x.z < least {
                    least = x.z;
                }
            }
        }
    }
    least
}

/// Cramer's rule.
fn solve(M: &Mat3<f64>, b: Vec3<f64>) -> Vec3<f64> {
    let [x, y, z] = [M.column(0), M.column(1), M.column(2)];
    let whole = x.dot(y.cross(z));
    vec3(b.dot(y.cross(z)), x.dot(b.cross(z)), x.dot(y.cross(b))) * (1.0 / whole)
}

fn cases() -> ProptestConfig {
    ProptestConfig {
        cases: 2048,
        rng_seed: RngSeed::Fixed(19_900_613),
        failure_persistence: None,
        ..ProptestConfig::default()
    }
}

proptest! {
    #![proptest_config(cases())]

    /// Relative to what is wanted, round-off times the condition of the axes: the direction measured
    /// 3.0e-15, the sum 1.8e-16, the peak not above one at all.
    #[test]
    fn small_torques_are_given_whole_and_large_ones_in_their_direction(
        wheels in array(), wanted in vector(1.0), size in -3.0..1.0,
    ) {
        let wanted = wanted * 10.0_f64.powf(size);
        for sharing in BOTH {
            let told = wheel_torques(&wheels, &ALL, &law(sharing), wanted, &STILL, PERIOD);
            let sum = given(&wheels, &told.values);
            prop_assert!((sum + told.missing_B - wanted).norm() <= 1e-15 * wanted.norm());
            prop_assert!(peak(&wheels, &told.values) <= 1.0 + 1e-15);
            prop_assert!(sum.cross(wanted).norm() <= 3e-14 * sum.norm() * wanted.norm());
            // Cut only as far as the limits ask.
            let cut = told.missing_B.norm() > 1e-12 * wanted.norm();
            prop_assert!(!cut || (peak(&wheels, &told.values) - 1.0).abs() < 1e-12);
        }
    }

    /// Round-off times the condition of the axes: measured 3.6e-15, and 1.1e-15 above the pseudo-inverse.
    #[test]
    fn the_least_peak_is_that_of_all_vertices_and_below_that_of_the_pseudo_inverse(
        wheels in array(), wanted in vector(0.02),
    ) {
        let peak_of = |sharing| {
            let told = wheel_torques(&wheels, &ALL, &law(sharing), wanted, &STILL, PERIOD);
            peak(&wheels, &told.values)
        };
        let [least_norm, least_peak] = BOTH.map(peak_of);
        let oracle = least_peak_by_vertices(&wheels, wanted);
        prop_assume!(least_norm < 1.0);
        prop_assert!((least_peak - oracle).abs() <= 2e-14 * oracle, "{least_peak} {oracle}");
        prop_assert!(least_peak <= least_norm * (1.0 + 1e-14));
    }

    /// The normal condition of least squares: the shares lie in the rows of the axes.
    #[test]
    fn no_null_torque_makes_the_pseudo_inverse_smaller(
        wheels in array(), wanted in vector(0.01), other in prop::array::uniform8(-1.0..1.0),
    ) {
        let one = law(WheelSharing::PseudoInverse);
        let told = wheel_torques(&wheels, &ALL, &one, wanted, &STILL, PERIOD).values;
        prop_assume!(peak(&wheels, &told) < 1.0);
        // A null torque: anything, less the least-norm torque of the same sum.
        let small = std::array::from_fn(|k| wheels.get(k).map_or(0.0, |w| 1e-3 * w.torque_limit * other[k]));
        let same = wheel_torques(&wheels, &ALL, &one, given(&wheels, &small), &STILL, PERIOD).values;
        let shares = |k: usize| (told[k] / wheels[k].torque_limit, (small[k] - same[k]) / wheels[k].torque_limit);
        let dot: f64 = (0..wheels.len()).map(|k| shares(k).0 * shares(k).1).sum();
        // Shares below one times null shares of 1e-3, round-off times condition: measured 3.4e-18.
        prop_assert!(dot.abs() < 1e-16, "{dot:e}");
    }

    /// The torque that evens out the speeds has no sum and keeps the limits.
    #[test]
    fn evening_out_the_speeds_is_not_felt(
        wheels in array(), wanted in vector(0.02), speeds in speeds(),
    ) {
        for sharing in BOTH {
            let without = wheel_torques(&wheels, &ALL, &law(sharing), wanted, &speeds, PERIOD);
            let evening = WheelLaw { sharing, null_gain: 0.05 };
            let with = wheel_torques(&wheels, &ALL, &evening, wanted, &speeds, PERIOD);
            let off = with.missing_B - without.missing_B;
            // Against torques of up to 1 N·m, round-off times the condition: measured 4.1e-15.
            prop_assert!(off.norm() < 4e-14, "{:e}", off.norm());
            prop_assert!(peak(&wheels, &with.values) <= 1.0 + 1e-12);
        }
    }

    /// No wheel beyond its speed limit is driven on, and what the others give is along what is wanted
    /// or, if they do not span, nearest to it.
    #[test]
    fn a_wheel_at_its_speed_limit_is_not_driven_on(
        wheels in array(), wanted in vector(0.5), full in prop::array::uniform8(-1_i8..=1),
        null_gain in prop::sample::select(vec![0.0, 0.1]),
    ) {
        let speeds = full.map(|sign| 600.0 * f64::from(sign));
        for sharing in BOTH {
            let law = WheelLaw { sharing, null_gain };
            let told = wheel_torques(&wheels, &ALL, &law, wanted, &speeds, PERIOD);
            for k in 0..wheels.len() {
                prop_assert!(told.values[k] * speeds[k] <= 0.0, "{k}: {:?}", told.values);
            }
            let sum = given(&wheels, &told.values);
            // Round-off of torques below 1 N·m: measured 8.3e-17.
            prop_assert!((sum + told.missing_B - wanted).norm() < 1e-15);
            // What is given never works against what is wanted: measured 6.1e-16 against it.
            prop_assert!(sum.dot(wanted) >= -1e-14);
        }
    }

    /// Round-off of 6e-8 times the condition of the axes: measured 8.0e-6 of the peak, and 1.3e-6 of what
    /// is wanted not given.
    #[test]
    fn the_least_peak_in_single_precision_is_the_same(
        wheels in array(), wanted in vector(0.02),
    ) {
        let narrow: Vec<_> = wheels.iter().map(ReactionWheel::cast::<f32>).collect();
        let law_narrow = WheelLaw { sharing: WheelSharing::MinimumPeak, null_gain: 0.0_f32 };
        let law_wide = law(WheelSharing::MinimumPeak);
        let wide = wheel_torques(&wheels, &ALL, &law_wide, wanted, &STILL, PERIOD);
        prop_assume!(peak(&wheels, &wide.values) < 0.99 && wanted.norm() > 1e-4);
        let told = wheel_torques(&narrow, &ALL, &law_narrow, Vec3::from_f64(wanted), &[0.0; WHEELS], 0.01);
        let off = peak(&wheels, &told.values.map(f64::from)) / peak(&wheels, &wide.values) - 1.0;
        prop_assert!(off.abs() < 1e-4, "{off:e}");
        let missing = (wanted - given(&wheels, &told.values.map(f64::from))).norm() / wanted.norm();
        prop_assert!(missing < 1e-5, "{missing:e}");
    }

    #[test]
    fn an_unusable_wheel_is_told_nothing(
        wheels in array(), wanted in vector(0.1), usable in prop::array::uniform8(any::<bool>()),
        speeds in speeds(),
    ) {
        for sharing in BOTH {
            let law = WheelLaw { sharing, null_gain: 0.1 };
            let told = wheel_torques(&wheels, &usable, &law, wanted, &speeds, PERIOD);
            for k in 0..WHEELS {
                prop_assert!(told.values[k] == 0.0 || usable[k] && k < wheels.len());
            }
            let left = wanted - given(&wheels, &told.values) - told.missing_B;
            prop_assert!(left.norm() < 1e-15);
        }
    }
}
