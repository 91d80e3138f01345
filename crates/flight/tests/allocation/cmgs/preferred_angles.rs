//! Gimbal angles to start from, which keep clear of singularities.

use super::pyramid::*;
use std::f64::consts::{FRAC_PI_4, PI};
use wrasse_flight::allocation::{CmgSharing, cmg_rates, cmg_singularity, preferred_angles};
use wrasse_hardware::CMGS;
use wrasse_spatial::{Vec3, vec3};
use wrasse_testing::{Page, smaller};
use wrasse_testing::{larger, largest};

/// From (45°, -45°, 45°, -45°), whose momentum is zero too, nothing lies in the way up to the envelope.
#[test]
fn from_preferred_angles_the_pseudo_inverse_reaches_the_envelope() {
    let q = FRAC_PI_4;
    let mut push = Push::from([q, -q, q, -q], CmgSharing::PseudoInverse);
    let on_time = push.passes(2.88, 40.0).unwrap();
    assert!((on_time - 28.8).abs() < 0.015, "0.1 h0 a second, in steps of 10 ms: {on_time}");
    while push.time < 40.0 {
        push.step();
    }
    assert!((push.hx() - 3.2).abs() < 1e-3, "measured 3.1998: {}", push.hx());
}

/// Least singularity measure while the pseudo-inverse pushes from no momentum to 2.88 h0, 0.9 of the
/// envelope; zero if it gets stuck.
fn clearance(start: [f64; CMGS], along: Vec3<f64>) -> f64 {
    let law = law(CmgSharing::PseudoInverse);
    let mut push = Push { angles: start, law, time: 0.0, wanted: along * 0.1 };
    let mut least = f64::INFINITY;
    while momentum(&pyramid(1.0), &push.angles).dot(along) < 2.88 {
        least = smaller(least, cmg_singularity(&pyramid(1.0), &ALL, &push.angles));
        push.step();
        if push.time > 40.0 {
            return 0.0;
        }
    }
    least
}

/// The classic angles for +x come as near as 0.524 on their way.
#[test]
fn proposed_angles_have_no_momentum_and_keep_clear_of_singularities() {
    let (cmgs, q) = (pyramid(1.0), FRAC_PI_4);
    let x = vec3(1.0, 0.0, 0.0);
    let classic = clearance(angles([q, -q, q, -q]), x);
    assert!((classic - 0.5243).abs() < 1e-3, "{classic}");
    let mut page = Page::open(PAGE);
    let row = "| pseudo-inverse | (45°, -45°, 45°, -45°) | 3.2 `h_0`; least measure on the way to 2.88 \
               `h_0`: {} |";
    page.says(row, &[classic]);
    let best = preferred_angles(&cmgs, x).unwrap();
    let [q1, q2, q3, q4, ..] = best.map(f64::to_degrees);
    let row = "| pseudo-inverse | proposed: ({}°, {}°, {}°, {}°) | least measure on the way to 2.88 \
               `h_0`: {} |";
    page.says(row, &[q1, q2, q3, q4, clearance(best, x)]);
    page.holds();
    let oblique = vec3(0.48, -0.8, 0.36);
    for (along, expected) in
        [(x, 1.2102), (-x, 1.2102), (vec3(0.0, 0.0, 1.0), 1.3271), (oblique, 1.4592)]
    {
        let start = preferred_angles(&cmgs, along * 7.0).unwrap();
        // Newton's method to the end: measured 1.7e-16.
        assert!(momentum(&cmgs, &start).norm() < 1e-14, "{start:?}");
        let clear = clearance(start, along);
        assert!((clear - expected).abs() < 1e-3, "{along:?}: {clear}");
    }
}

/// The states without momentum form curves. All along the one through the proposal, a turn of null
/// motion with steps of 0.1 rad, no other start keeps clearer.
#[test]
fn no_null_motion_improves_on_the_proposed_angles() {
    let (cmgs, along) = (pyramid(1.0), vec3(1.0, 0.0, 0.0));
    let proposed = preferred_angles(&cmgs, along).unwrap();
    let best = clearance(proposed, along);
    let (mut a, mut worse, mut farthest) = (proposed, 0, 0.0_f64);
    for _ in 0..70 {
        let n = null_vector(&a);
        let length = n.iter().map(|n| n * n).sum::<f64>().sqrt();
        for k in 0..4 {
            a[k] += 0.1 * n[k] / length;
        }
        // Back to no momentum: Newton's method with the law itself.
        for _ in 0..3 {
            let back = -momentum(&cmgs, &a);
            let turns = cmg_rates(&cmgs, &ALL, &law(CmgSharing::PseudoInverse), back, &a, 0.0);
            a = std::array::from_fn(|k| a[k] + turns.values[k]);
        }
        assert!(momentum(&cmgs, &a).norm() < 1e-9);
        let clear = clearance(a, along);
        assert!(clear < best + 1e-4, "{clear} at {a:?} is above {best} at {proposed:?}");
        worse += u32::from(clear < 0.9 * best);
        farthest = larger(farthest, largest((0..4).map(|k| (a[k] - proposed[k]).abs())));
    }
    assert!(worse > 20 && farthest > 1.0, "the walk goes somewhere: {worse}, {farthest} rad");
}

/// Unequal CMGs; a pair that cancels along one line only; none; a direction that is none.
#[test]
fn preferred_angles_exist_where_the_rotors_can_cancel() {
    let x = vec3(1.0, 0.0, 0.0);
    let six: Vec<_> = pyramid(40.0).into_iter().chain(pyramid(15.0).into_iter().take(2)).collect();
    let start = preferred_angles(&six, x).unwrap();
    assert!(momentum(&six, &start).norm() < 1e-12, "{start:?}");
    assert!(start[6..] == [0.0; 2] && start.iter().all(|a| a.abs() <= PI), "{start:?}");
    let pair = [pyramid(5.0)[0], pyramid(5.0)[0]];
    let opposed = preferred_angles(&pair, x).unwrap();
    assert!(momentum(&pair, &opposed).norm() < 1e-12, "{opposed:?}");
    assert_eq!(preferred_angles(&pair[..1], x), None);
    assert_eq!(preferred_angles::<f64>(&[], x), None);
    assert_eq!(preferred_angles(&six, Vec3::zero()), None);
    assert_eq!(preferred_angles(&six, vec3(f64::NAN, 0.0, 0.0)), None);
}
