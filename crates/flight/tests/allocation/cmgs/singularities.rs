//! The momentum envelope, and the classic test: a push into an inner singularity.

use super::pyramid::*;
use std::f64::consts::{FRAC_PI_2, PI};
use wrasse_flight::allocation::{CmgLaw, CmgSharing, Damping, Waves, cmg_rates, cmg_singularity};
use wrasse_hardware::CMGS;
use wrasse_spatial::{Real, Vec3, vec3};
use wrasse_testing::{Page, smaller};
use wrasse_testing::{larger, largest};

/// Spin axes as near as can be to a direction: the outermost state, and what it holds along there.
fn outermost(along: Vec3<f64>) -> ([f64; CMGS], f64) {
    let cmgs = pyramid(1.0);
    let mut a = [0.0; CMGS];
    for k in 0..4 {
        let (s, g) = (cmgs[k].spin_axis_B, cmgs[k].gimbal_axis_B);
        a[k] = g.cross(s).dot(along).atan2(s.dot(along));
    }
    (a, momentum(&cmgs, &a).dot(along))
}

/// 3.2 h0 along x, y and z; between 2.828 and 3.298 h0 elsewhere, on a grid of a degree. What a rotor
/// can give along a direction is its momentum but for the part along its gimbal axis.
#[test]
fn the_momentum_envelope_of_the_pyramid_has_the_closed_form() {
    for axis in [vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0), vec3(0.0, 0.0, 1.0)] {
        let (a, most) = outermost(axis);
        assert!((most - 3.2).abs() < 1e-15, "{most}");
        assert!(cmg_singularity(&pyramid(1.0), &ALL, &a) < 1e-15);
    }
    let (mut least, mut most) = (f64::INFINITY, 0.0_f64);
    for i in 0..=180 {
        for j in 0..360 {
            let (up, round) = (f64::from(i).to_radians(), f64::from(j).to_radians());
            let along = vec3(up.sin() * round.cos(), up.sin() * round.sin(), up.cos());
            let (_, holds) = outermost(along);
            let closed: f64 = pyramid(1.0)
                .iter()
                .map(|cmg| larger(1.0 - cmg.gimbal_axis_B.dot(along).powi(2), 0.0).sqrt())
                .sum();
            // A rotor whose gimbal axis lies along the direction: root of round-off.
            assert!((holds - closed).abs() < 5e-8, "{holds} {closed}");
            (least, most) = (smaller(least, holds), larger(most, holds));
        }
    }
    let mut page = Page::open(PAGE);
    page.says("the sum is `{} h_0` along x, y and z, ", &[outermost(vec3(1.0, 0.0, 0.0)).1]);
    page.says("and between {} and {} `h_0` elsewhere", &[least, most]);
    page.holds();
}

/// The classic test: from zero angles towards +x there is a singularity at 1.2 h0 that cannot be passed
/// by turning the gimbals a little. Steps of 10 ms, a rate limit of 1 rad/s.
#[test]
fn pseudo_inverse_and_singularity_robust_law_stop_at_1_2_h0() {
    for sharing in [CmgSharing::PseudoInverse, CmgSharing::SingularityRobust(damping())] {
        let mut push = Push::from([0.0; 4], sharing);
        assert_eq!(push.passes(1.2 + 1e-9, 40.0), None, "{sharing:?}");
        // The pseudo-inverse rattles about the singularity at the rate limit: 10 ms × 1 rad/s.
        assert!((push.hx() - 1.2).abs() < 1e-4, "measured 1.1999980: {}", push.hx());
        let there = angles([-FRAC_PI_2, 0.0, FRAC_PI_2, 0.0]);
        for k in 0..4 {
            assert!((push.angles[k] - there[k]).abs() < 0.01, "{:?}", push.angles);
        }
        let named = match sharing {
            CmgSharing::PseudoInverse => "pseudo-inverse",
            _ => "singularity-robust",
        };
        let mut page = Page::open(PAGE);
        page.says(&format!("| {named} | 0, 0, 0, 0 | stops at {{}} `h_0`"), &[push.hx()]);
        page.holds();
        let told = cmg_rates(&pyramid(1.0), &ALL, &law(sharing), vec3(0.1, 0.0, 0.0), &there, 0.0);
        assert!((told.missing_B - vec3(0.1, 0.0, 0.0)).norm() < 1e-15, "all of it is missing");
    }
}

#[test]
fn the_generalized_law_passes_the_singularity() {
    let passes = |phases: [f64; 3]| {
        let waves = Waves { phases, ..waves() };
        let sharing = CmgSharing::GeneralizedSingularityRobust(damping(), waves);
        Push::from([0.0; 4], sharing).passes(1.5, 100.0).unwrap()
    };
    // Beyond 15 s all is delay at the singularity. It depends on the phases of the waves.
    let (a, b, c) = (0.0, FRAC_PI_2, PI);
    let orders = [[a, b, c], [a, c, b], [b, a, c], [b, c, a], [c, a, b], [c, b, a]].map(passes);
    let (least, most) = (orders.into_iter().fold(f64::MAX, smaller), largest(orders));
    let mut page = Page::open(PAGE);
    page.says("| generalized | 0, 0, 0, 0 | passes 1.5 `h_0` after {} s |", &[orders[0]]);
    page.says("from {} s to {} s over their six orders", &[least, most]);
    page.holds();
}

/// The waves are what leaves the singularity: without them a gimbal state in it stays for ever.
#[test]
fn started_at_the_singularity_only_the_generalized_law_leaves_it() {
    let there = [-FRAC_PI_2, 0.0, FRAC_PI_2, 0.0];
    let mut robust = Push::from(there, CmgSharing::SingularityRobust(damping()));
    assert_eq!(robust.passes(1.2 + 1e-9, 100.0), None);
    assert!((robust.hx() - 1.2).abs() < 1e-15, "{}", robust.hx());
    let sharing = CmgSharing::GeneralizedSingularityRobust(damping(), waves());
    let leaves = Push::from(there, sharing).passes(1.25, 100.0).unwrap();
    let mut page = Page::open(PAGE);
    let row = "| generalized | (-90°, 0, 90°, 0) | passes 1.25 `h_0` after {} s |";
    page.says(row, &[leaves]);
    page.holds();
}

/// The classic test in single precision and by plain Euler steps: past the singularity, at nearly the
/// same time.
#[test]
fn single_precision_passes_the_singularity_too() {
    let cmgs = pyramid(1.0).map(|cmg| cmg.cast::<f32>());
    let phases = waves().phases.map(f32::from_f64);
    let waves = Waves { height: 0.01, frequency: f32::from_f64(FRAC_PI_2), phases };
    let damping = Damping { k0: 0.01, fading: 10.0 };
    let sharing = CmgSharing::GeneralizedSingularityRobust(damping, waves);
    let law = CmgLaw { sharing, null_gain: 0.0_f32 };
    let (mut a, mut steps) = ([0.0_f32; CMGS], 0_u16);
    let hx = |a: &[f32; CMGS]| momentum(&pyramid(1.0), &a.map(f64::from)).x;
    while hx(&a) < 1.5 && steps < 6000 {
        let time = 0.01 * f32::from(steps);
        let told = cmg_rates(&cmgs, &ALL, &law, vec3(0.1, 0.0, 0.0), &a, time);
        a = std::array::from_fn(|k| a[k] + 0.01 * told.values[k]);
        steps += 1;
    }
    let passes = 0.01 * f64::from(steps);
    assert!((passes - 33.68).abs() < 0.2, "measured 33.80 s: {passes}");
}
