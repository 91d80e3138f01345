//! CMG steering on the pyramid of four: printed formulas, the classic test, laws.

use crate::figures::Page;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};
use wrasse_flight::allocation::{
    CmgLaw, CmgSharing, Damping, Waves, cmg_rates, cmg_singularity, preferred_angles,
};
use wrasse_hardware::{CMGS, ControlMomentGyro};
use wrasse_spatial::{Real, Vec3, vec3};

/// Sine and cosine of the skew angle of 53.13°.
const S: f64 = 0.8;
const C: f64 = 0.6;
const ALL: [bool; CMGS] = [true; CMGS];
const PAGE: &str = "book/src/theory/cmg_steering.md";

/// The pyramid of momentum `h0`: faces across x, y, -x, -y, gimbal axes tilted by the skew angle.
fn pyramid(h0: f64) -> [ControlMomentGyro<f64>; 4] {
    let cmg = |gimbal: Vec3<f64>, spin: Vec3<f64>| ControlMomentGyro {
        gimbal_axis_B: gimbal,
        spin_axis_B: spin,
        momentum: h0,
        rate_limit: 1.0,
        ..Default::default()
    };
    [
        cmg(vec3(S, 0.0, C), vec3(0.0, 1.0, 0.0)),
        cmg(vec3(0.0, S, C), vec3(-1.0, 0.0, 0.0)),
        cmg(vec3(-S, 0.0, C), vec3(0.0, -1.0, 0.0)),
        cmg(vec3(0.0, -S, C), vec3(1.0, 0.0, 0.0)),
    ]
}
fn angles(of: [f64; 4]) -> [f64; CMGS] {
    [of[0], of[1], of[2], of[3], 0.0, 0.0, 0.0, 0.0]
}

fn momentum(cmgs: &[ControlMomentGyro<f64>], angles: &[f64; CMGS]) -> Vec3<f64> {
    let each = cmgs.iter().zip(angles);
    each.fold(Vec3::zero(), |h, (cmg, &angle)| h + cmg.spin_axis(angle) * cmg.momentum)
}
/// k0 0.01 and μ 10.
fn damping() -> Damping<f64> {
    Damping { k0: 0.01, fading: 10.0 }
}

fn law(sharing: CmgSharing<f64>) -> CmgLaw<f64> {
    CmgLaw { sharing, null_gain: 0.0 }
}

/// Waves of 0.01 at a quarter of a hertz, a quarter of a turn apart.
fn waves() -> Waves<f64> {
    Waves { height: 0.01, frequency: FRAC_PI_2, phases: [0.0, FRAC_PI_2, PI] }
}

/// What a steady command does.
struct Push {
    angles: [f64; CMGS],
    law: CmgLaw<f64>,
    time: f64,
    /// h0/s.
    wanted: Vec3<f64>,
}

impl Push {
    const STEP: f64 = 0.01;

    /// 0.1 h0 a second along +x.
    fn from(start: [f64; 4], sharing: CmgSharing<f64>) -> Self {
        Self { angles: angles(start), law: law(sharing), time: 0.0, wanted: vec3(0.1, 0.0, 0.0) }
    }
    /// Momentum along x (h0).
    fn hx(&self) -> f64 {
        momentum(&pyramid(1.0), &self.angles).x
    }
    /// One step by the midpoint.
    fn step(&mut self) {
        let rates = |angles: &[f64; CMGS], time: f64| {
            cmg_rates(&pyramid(1.0), &ALL, &self.law, self.wanted, angles, time).values
        };
        let first = rates(&self.angles, self.time);
        let middle = std::array::from_fn(|k| self.angles[k] + 0.5 * Self::STEP * first[k]);
        let second = rates(&middle, self.time + 0.5 * Self::STEP);
        self.angles = std::array::from_fn(|k| self.angles[k] + Self::STEP * second[k]);
        self.time += Self::STEP;
    }
    /// Time (s) at which the momentum along x passes a height, within a duration.
    fn passes(&mut self, hx: f64, duration: f64) -> Option<f64> {
        while self.time < duration {
            self.step();
            if self.hx() > hx {
                return Some(self.time);
            }
        }
        None
    }
}

/// Sines and cosines of four angles.
fn sines(a: &[f64; CMGS]) -> ([f64; 4], [f64; 4]) {
    (std::array::from_fn(|k| a[k].sin()), std::array::from_fn(|k| a[k].cos()))
}

/// Columns of A over h0 as the product's CMGs give them.
fn columns(a: &[f64; CMGS]) -> [Vec3<f64>; 4] {
    let cmgs = pyramid(1.0);
    std::array::from_fn(|k| cmgs[k].torque_axis(a[k]))
}

/// The null vector of four columns: each element the determinant of the other three, in turn.
fn null_vector(a: &[f64; CMGS]) -> [f64; 4] {
    let [p, q, r, s] = columns(a);
    let det = |a: Vec3<f64>, b: Vec3<f64>, c: Vec3<f64>| a.dot(b.cross(c));
    [det(q, r, s), -det(p, r, s), det(p, q, s), -det(p, q, r)]
}

fn any_angles() -> impl Strategy<Value = [f64; CMGS]> {
    prop::array::uniform8(-3.2..3.2)
}

fn vector(size: f64) -> impl Strategy<Value = Vec3<f64>> {
    [-size..size, -size..size, -size..size].prop_map(Vec3::from_array)
}

/// One to eight CMGs of different sizes in general position.
fn array() -> impl Strategy<Value = Vec<ControlMomentGyro<f64>>> {
    let long = |v: &Vec3<f64>| v.norm() > 0.2;
    let one =
        (vector(1.0).prop_filter("an axis has a length", long), vector(1.0), 5.0..50.0, 0.2..2.0);
    let one = one.prop_filter_map("the axes differ", |(gimbal, other, momentum, rate_limit)| {
        let across = gimbal.cross(other);
        (across.norm() > 0.05).then(|| ControlMomentGyro {
            gimbal_axis_B: gimbal * (1.0 / gimbal.norm()),
            spin_axis_B: across * (1.0 / across.norm()),
            momentum,
            rate_limit,
            ..Default::default()
        })
    });
    prop::collection::vec(one, 1..=CMGS)
}

fn every_sharing() -> [CmgSharing<f64>; 3] {
    [
        CmgSharing::PseudoInverse,
        CmgSharing::SingularityRobust(damping()),
        CmgSharing::GeneralizedSingularityRobust(damping(), waves()),
    ]
}

/// Change of momentum that rates give.
fn given(cmgs: &[ControlMomentGyro<f64>], angles: &[f64; CMGS], rates: &[f64; CMGS]) -> Vec3<f64> {
    let each = cmgs.iter().zip(angles).zip(rates);
    each.fold(Vec3::zero(), |sum, ((cmg, &angle), &rate)| {
        sum + cmg.torque_axis(angle) * (cmg.momentum * rate)
    })
}

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
                .map(|cmg| (1.0 - cmg.gimbal_axis_B.dot(along).powi(2)).max(0.0).sqrt())
                .sum();
            // A rotor whose gimbal axis lies along the direction: root of round-off.
            assert!((holds - closed).abs() < 5e-8, "{holds} {closed}");
            (least, most) = (least.min(holds), most.max(holds));
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
    let (least, most) = orders.iter().fold((f64::MAX, 0.0_f64), |(l, m), &x| (l.min(x), m.max(x)));
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
        least = least.min(cmg_singularity(&pyramid(1.0), &ALL, &push.angles));
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
        farthest = farthest.max((0..4).map(|k| (a[k] - proposed[k]).abs()).fold(0.0, f64::max));
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

/// Numbers that are none are refused; without CMGs all is missing.
#[test]
fn what_is_not_a_number_turns_no_gimbal() {
    let (cmgs, a) = (pyramid(1.0), angles([0.1, 0.2, 0.3, 0.4]));
    let wanted = vec3(0.02, -0.05, 0.04);
    for sharing in every_sharing() {
        let law = CmgLaw { sharing, null_gain: 0.1 };
        let told = cmg_rates(&cmgs, &ALL, &law, vec3(f64::NAN, 0.0, 0.0), &a, 0.0);
        assert_eq!(told.values, [0.0; CMGS]);
        let mut bad = a;
        bad[3] = f64::NAN;
        let told = cmg_rates(&cmgs, &ALL, &law, wanted, &bad, 0.0);
        assert!(told.values[3] == 0.0 && told.missing_B.norm() < 1e-3, "{told:?}");
        let told = cmg_rates(&[], &ALL, &law, wanted, &a, 0.0);
        assert_eq!((told.values, told.missing_B), ([0.0; CMGS], wanted));
    }
}

/// Numbers at either end of the range: rates within limits, or none.
#[test]
fn extreme_torques_and_angles_stay_within_limits() {
    let cmgs = pyramid(60.0);
    for sharing in every_sharing() {
        for size in [f64::MIN_POSITIVE, 1e-200, 1e200, f64::MAX] {
            for angle in [0.0, size, -size] {
                let law = CmgLaw { sharing, null_gain: 1.0 };
                let wanted = vec3(size, -size, 0.3 * size);
                let told = cmg_rates(&cmgs, &ALL, &law, wanted, &[angle; CMGS], size);
                let within = |rate: &f64| rate.abs() <= 1.0;
                assert!(told.values.iter().all(within), "{size:e} {angle:e}: {told:?}");
            }
        }
    }
}

/// 10,000 s in steps of 10 ms in single precision are 2,500 waves of 4 s. A plain clock would stand still
/// from 262,144 s on.
#[test]
fn the_clock_of_the_waves_never_stalls() {
    assert_eq!(262_144.0_f32 + 0.01, 262_144.0);
    let waves = Waves { height: 0.01_f32, frequency: 0.5 * std::f32::consts::PI, phases: [0.0; 3] };
    let sharing = CmgSharing::GeneralizedSingularityRobust(Damping::default(), waves);
    let law = CmgLaw { sharing, null_gain: 0.0 };
    let (mut time, mut count, mut most) = (0.0_f32, 0, 0.0_f32);
    for _ in 0..1_000_000 {
        let next = law.within_a_wave(time + 0.01);
        count += i32::from(next < time);
        (time, most) = (next, most.max(next.abs()));
    }
    // Each step rounds by up to 1.2e-7 s, half a wave in 1e6 steps: measured 2,500 waves.
    assert!((count - 2500).abs() <= 1, "{count}");
    assert!(most <= 2.0 + 1e-6, "half a wave: {most}");
    // A law without waves has no clock, and NaN does not stay.
    let still = CmgLaw { sharing: CmgSharing::PseudoInverse, ..law };
    assert_eq!([still.within_a_wave(7.0), law.within_a_wave(f32::NAN)], [0.0, 0.0]);
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
