//! What gimbal rates give, by each law, on random arrays.

use super::pyramid::*;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use wrasse_flight::allocation::{CmgLaw, CmgSharing, cmg_rates, cmg_singularity};
use wrasse_hardware::CMGS;
use wrasse_spatial::{Vec3, vec3};

fn cases() -> ProptestConfig {
    ProptestConfig {
        cases: 512,
        rng_seed: RngSeed::Fixed(19_910_415),
        failure_persistence: None,
        ..ProptestConfig::default()
    }
}

proptest! {
    #![proptest_config(cases())]

    /// Round-off of sums of four: measured 4.8e-16 and 1.7e-16.
    #[test]
    fn momentum_and_torque_of_the_pyramid_are_the_printed_ones(a in any_angles()) {
        let (s, c) = sines(&a);
        let h = vec3(
            -C * s[0] - c[1] + C * s[2] + c[3],
            c[0] - C * s[1] - c[2] + C * s[3],
            S * (s[0] + s[1] + s[2] + s[3]),
        );
        prop_assert!((momentum(&pyramid(1.0), &a) - h).norm() < 1e-15);
        let A = [
            vec3(-C * c[0], -s[0], S * c[0]),
            vec3(s[1], -C * c[1], S * c[1]),
            vec3(C * c[2], s[2], S * c[2]),
            vec3(-s[3], C * c[3], S * c[3]),
        ];
        for k in 0..4 {
            prop_assert!((columns(&a)[k] - A[k]).norm() < 1e-15);
        }
    }

    /// `A n = 0` and `n·n = det A Aᵀ`: round-off of products of three and six, measured
    /// 3.3e-16 and 1.3e-15.
    #[test]
    fn the_singularity_measure_is_the_square_of_the_null_vector(a in any_angles()) {
        let n = null_vector(&a);
        let none = columns(&a).iter().zip(n).fold(Vec3::zero(), |sum, (&c, n)| sum + c * n);
        prop_assert!(none.norm() < 3e-15, "{:e}", none.norm());
        let square: f64 = n.iter().map(|n| n * n).sum();
        for h0 in [1.0, 60.0] {
            let off = cmg_singularity(&pyramid(h0), &ALL, &a) - square;
            prop_assert!(off.abs() < 1e-14, "{off:e}");
        }
    }

    /// Every law, with and without null motion: nothing beyond a rate limit, nothing hidden. Round-off of
    /// torques of up to 800 N·m: measured 1.4e-14.
    #[test]
    fn what_is_given_and_what_is_missing_add_up_to_what_is_wanted(
        cmgs in array(), a in any_angles(), wanted in vector(20.0), time in 0.0..100.0,
        usable in prop::array::uniform8(prop::bool::weighted(0.8)),
    ) {
        for sharing in every_sharing() {
            for null_gain in [0.0, 0.3] {
                let law = CmgLaw { sharing, null_gain };
                let told = cmg_rates(&cmgs, &usable, &law, wanted, &a, time);
                let sum = given(&cmgs, &a, &told.values) + told.missing_B;
                prop_assert!((sum - wanted).norm() < 1e-12, "{:e}", (sum - wanted).norm());
                for k in 0..CMGS {
                    let limit = cmgs.get(k).filter(|_| usable[k]).map_or(0.0, |cmg| cmg.rate_limit);
                    prop_assert!(told.values[k].abs() <= limit);
                }
            }
        }
    }

    /// Away from singularities, at which the round-off grows without bound: measured 5.8e-16 of what is
    /// wanted missing, 9.8e-16 rad turned.
    #[test]
    fn the_pseudo_inverse_gives_all_or_cuts_without_turning(
        cmgs in array(), a in any_angles(), wanted in vector(20.0),
    ) {
        prop_assume!(cmg_singularity(&cmgs, &ALL, &a) > 0.01);
        let told = cmg_rates(&cmgs, &ALL, &law(CmgSharing::PseudoInverse), wanted, &a, 0.0);
        let sum = given(&cmgs, &a, &told.values);
        let cut = told.values.iter().zip(&cmgs).any(|(rate, cmg)| rate.abs() > 0.999_999 * cmg.rate_limit);
        prop_assert!(cut || told.missing_B.norm() < 1e-14 * wanted.norm());
        prop_assert!(sum.cross(wanted).norm() < 1e-14 * sum.norm() * wanted.norm());
    }

    /// Damping fades: far from singularities the robust laws give the same as the pseudo-inverse.
    #[test]
    fn far_from_singularities_the_laws_agree(a in any_angles(), wanted in vector(0.1)) {
        let cmgs = pyramid(1.0);
        let measure = cmg_singularity(&cmgs, &ALL, &a);
        prop_assume!(measure > 0.8);
        let [exact, robust, waved] =
            every_sharing().map(|s| cmg_rates(&cmgs, &ALL, &law(s), wanted, &a, 3.0));
        // What is missing is k (A Aᵀ + k)⁻¹ of what is wanted: measured up to 3.9 k.
        let k = 0.01 * (-10.0 * measure).exp();
        prop_assert!(exact.missing_B.norm() < 1e-15);
        for told in [robust, waved] {
            prop_assert!(told.missing_B.norm() < 10.0 * k * wanted.norm());
            prop_assert!(told.missing_B.norm() > 0.0);
        }
    }

    /// The gradient less its torque: the momentum stays, and the measure rises as the gradient says.
    #[test]
    fn null_motion_gives_no_torque_and_leads_away_from_singularities(
        cmgs in array(), a in any_angles(),
    ) {
        prop_assume!(cmg_singularity(&cmgs, &ALL, &a) > 0.01);
        let law = CmgLaw { sharing: CmgSharing::PseudoInverse, null_gain: 0.05 };
        let told = cmg_rates(&cmgs, &ALL, &law, Vec3::zero(), &a, 0.0);
        let size: f64 = told.values.iter().map(|rate| rate * rate).sum();
        prop_assert!(told.missing_B.norm() < 1e-12, "measured 3.1e-14: {:e}", told.missing_B.norm());
        let h = 1e-4;
        let moved = |by: f64| std::array::from_fn(|k| a[k] + by * told.values[k]);
        let rise = cmg_singularity(&cmgs, &ALL, &moved(h)) - cmg_singularity(&cmgs, &ALL, &moved(-h));
        // Along its projection, the gradient's slope is the square of the projection over the gain;
        // more, where a rate limit has shortened it.
        let expected = size / 0.05;
        // Measured short by 1.0e-8 at most, the square of the step.
        prop_assert!(rise / (2.0 * h) >= expected * (1.0 - 1e-6) - 1e-9, "{rise:e} {expected:e}");
    }
}

/// A gimbal that is stuck takes no part; three are left, and give what they can.
#[test]
fn the_others_steer_when_a_gimbal_is_stuck() {
    let mut usable = ALL;
    usable[1] = false;
    let a = angles([0.3, 0.7, -0.2, 0.5]);
    let wanted = vec3(0.02, -0.05, 0.04);
    let told = cmg_rates(&pyramid(1.0), &usable, &law(CmgSharing::PseudoInverse), wanted, &a, 0.0);
    assert_eq!(told.values[1], 0.0);
    assert!(told.missing_B.norm() < 1e-15, "{told:?}");
}

/// Two gimbals turn the momentum in a plane at most: without the other two all settings are singular.
/// Three have a measure of their own, the square of what the fourth leaves of the null vector.
#[test]
fn a_gimbal_that_is_not_used_does_not_count_in_the_singularity_measure() {
    let (cmgs, a) = (pyramid(1.0), angles([0.3, -0.2, 0.5, 0.1]));
    let usable = |count: usize| std::array::from_fn(|k| k < count);
    let measure = |count| cmg_singularity(&cmgs, &usable(count), &a);
    let n = null_vector(&a);
    assert!((measure(3) - n[3] * n[3]).abs() < 1e-15, "{:e}", measure(3) - n[3] * n[3]);
    assert!(measure(2) < 1e-15 && measure(4) > measure(3) && measure(3) > 0.01, "{}", measure(2));
}
