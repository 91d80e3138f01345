//! Thruster selection against the smallest cost of all corners, wrenches that are known to be
//! possible, and sets that lack something.

use proptest::prelude::*;
use proptest::test_runner::{Config, RngSeed};
use wrasse_flight::allocation::{Selection, WrenchAxes, controllable_axes, thruster_duties};
use wrasse_hardware::{THRUSTERS, Thruster};
use wrasse_spatial::{SpatialForce, Vec3, vec3};
use wrasse_testing::{largest, smaller};

const USABLE: [bool; THRUSTERS] = [true; THRUSTERS];

fn cases(cases: u32) -> Config {
    let rng_seed = RngSeed::Fixed(20_040_901);
    Config { cases, rng_seed, failure_persistence: None, ..Config::default() }
}

fn thruster(position_B: Vec3<f64>, direction_B: Vec3<f64>, force: f64) -> Thruster<f64> {
    Thruster { position_B, direction_B, force, specific_impulse: 230.0, ..Thruster::default() }
}

/// At each corner of a box of 2 x 1.6 x 1.6 m three thrusters, each pushing inwards along an axis:
/// 24 of 22 N, which give any torque and any force.
fn corners() -> Vec<Thruster<f64>> {
    let mut set = vec![];
    for [x, y, z] in [
        [1.0, 1.0, 1.0],
        [1.0, 1.0, -1.0],
        [1.0, -1.0, 1.0],
        [1.0, -1.0, -1.0],
        [-1.0, 1.0, 1.0],
        [-1.0, 1.0, -1.0],
        [-1.0, -1.0, 1.0],
        [-1.0, -1.0, -1.0],
    ] {
        let p = vec3(x, 0.8 * y, 0.8 * z);
        for d in [vec3(-x, 0.0, 0.0), vec3(0.0, -y, 0.0), vec3(0.0, 0.0, -z)] {
            set.push(thruster(p, d, 22.0));
        }
    }
    set
}

/// Couples about each axis, both ways: twelve thrusters of 22 N in pairs that cancel their force.
fn couples() -> Vec<Thruster<f64>> {
    let (x, y, z) = (vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0), vec3(0.0, 0.0, 1.0));
    let mut set = vec![];
    for (arm, push) in [(y, z), (z, x), (x, y)] {
        for side in [1.0, -1.0] {
            set.push(thruster(arm * side, push * side, 22.0));
            set.push(thruster(arm * side, push * -side, 22.0));
        }
    }
    set
}

fn given(set: &[Thruster<f64>], p_cm: Vec3<f64>, duty: &[f64]) -> SpatialForce<f64> {
    set.iter().zip(duty).fold(SpatialForce::zero(), |sum, (t, &duty)| {
        let f = t.direction_B * (t.force * duty);
        sum + SpatialForce::new((t.position_B - p_cm).cross(f), f)
    })
}

fn propellant(set: &[Thruster<f64>], duty: &[f64]) -> f64 {
    set.iter().zip(duty).map(|(t, duty)| t.force / t.specific_impulse * duty).sum()
}

fn size(F: SpatialForce<f64>) -> f64 {
    largest(F.to_array().into_iter().map(f64::abs))
}

fn wrench(torque: [f64; 3], force: [f64; 3]) -> SpatialForce<f64> {
    SpatialForce::new(Vec3::from_array(torque), Vec3::from_array(force))
}

/// What any selection owes: duties between zero and one, and an honest rest.
#[track_caller]
fn check(set: &[Thruster<f64>], p_cm: Vec3<f64>, wanted: SpatialForce<f64>, s: &Selection<f64>) {
    assert!(s.best, "cut short");
    assert!(s.duty.iter().all(|d| (0.0..=1.0).contains(d)), "{:?}", s.duty);
    let off = size(given(set, p_cm, &s.duty) + s.missing - wanted);
    // Round-off of sums of 24 terms of up to 50 N·m. Measured 9e-14.
    assert!(off < 1e-12, "given and missing make not what was wanted: {off}");
}

fn unit() -> impl Strategy<Value = f64> {
    -1.0..1.0_f64
}

fn vector(size: f64) -> impl Strategy<Value = Vec3<f64>> {
    (unit(), unit(), unit()).prop_map(move |(x, y, z)| vec3(x, y, z) * size)
}

fn any_set(count: usize) -> impl Strategy<Value = Vec<Thruster<f64>>> {
    let one = (vector(1.5), vector(1.0), 1.0..50.0_f64, 60.0..300.0_f64);
    let one = one.prop_map(|(p, d, force, specific_impulse)| {
        let direction_B = d * (1.0 / (d.norm() + 1e-9));
        Thruster { specific_impulse, ..thruster(p, direction_B, force) }
    });
    prop::collection::vec(one, count)
}

#[test]
fn a_couple_is_fired_as_a_couple_by_hand() {
    // 44 N·m about z take the pair at x = ±1 m: full force.
    let wanted = wrench([0.0, 0.0, 44.0], [0.0; 3]);
    let s = thruster_duties(&couples(), &USABLE, Vec3::zero(), &wanted, WrenchAxes::ALL);
    check(&couples(), Vec3::zero(), wanted, &s);
    assert!(size(s.missing) < 1e-13, "{:?}", s.missing);
    let fired: Vec<_> = (0..12).filter(|&i| s.duty[i] > 0.0).collect();
    assert_eq!(fired, [8, 10]);
    assert!(fired.iter().all(|&i| (s.duty[i] - 1.0).abs() < 1e-14), "{:?}", s.duty);
}

#[test]
fn twice_what_couples_can_give_is_given_by_half() {
    let wanted = wrench([0.0, -60.0, 88.0], [0.0; 3]);
    let s = thruster_duties(&couples(), &USABLE, Vec3::zero(), &wanted, WrenchAxes::ALL);
    check(&couples(), Vec3::zero(), wanted, &s);
    // Half of both; of the torque about y there is more: all that the couple can give.
    let off = size(s.missing - wrench([0.0, -16.0, 44.0], [0.0; 3]));
    assert!(off < 1e-12, "{:?}", s.missing);
}

#[test]
fn torque_goes_before_force() {
    // All the force that there is along x, and all the torque about z that there is.
    let wanted = wrench([0.0, 0.0, 4.0 * 22.0 * 0.8], [88.0, 0.0, 0.0]);
    let s = thruster_duties(&corners(), &USABLE, Vec3::zero(), &wanted, WrenchAxes::ALL);
    check(&corners(), Vec3::zero(), wanted, &s);
    assert!(size(SpatialForce::new(s.missing.torque, Vec3::zero())) < 1e-12, "{:?}", s.missing);
    // With force at the four corners behind, torque about z comes from pushes along y: 88 N·m of it
    // at 1 m. Nothing is missing.
    assert!(size(s.missing) < 1e-12, "{:?}", s.missing);
    let more = wrench([0.0, 0.0, 88.0 + 35.2], [88.0, 0.0, 0.0]);
    let s = thruster_duties(&corners(), &USABLE, Vec3::zero(), &more, WrenchAxes::ALL);
    check(&corners(), Vec3::zero(), more, &s);
    assert!(s.missing.torque.norm() < 1e-12, "{:?}", s.missing);
    assert!(s.missing.force.x > 10.0 && s.missing.force.y.abs() < 1e-12, "{:?}", s.missing);
}

#[test]
fn couples_give_no_force_and_say_so() {
    let s_wanted = wrench([10.0, 0.0, 0.0], [5.0, 0.0, -7.0]);
    let one = &couples()[..];
    let axes = controllable_axes(one, &USABLE, Vec3::zero());
    assert_eq!(axes, WrenchAxes::ALL, "single ones of the pairs push along every axis");
    // Pairs of which one is broken: torque with a push.
    let mut usable = USABLE;
    for i in [2, 3, 6, 7, 10, 11] {
        usable[i] = false;
    }
    let axes = controllable_axes(one, &usable, Vec3::zero());
    assert_eq!(axes, WrenchAxes::TORQUE);
    let s = thruster_duties(one, &usable, Vec3::zero(), &s_wanted, WrenchAxes::ALL);
    check(one, Vec3::zero(), s_wanted, &s);
    assert!(s.missing.torque.norm() < 1e-12, "{:?}", s.missing);
    // Torque about x comes with 10 N along z; that much and no other force is given.
    let off = (s.missing.force - vec3(5.0, 0.0, -17.0)).norm();
    assert!(off < 1e-12, "{:?}", s.missing);
}

#[test]
fn a_set_that_pushes_one_way_controls_nothing() {
    let x = vec3(1.0, 0.0, 0.0);
    let set = [thruster(vec3(-1.0, 0.5, 0.0), x, 10.0), thruster(vec3(-1.0, -0.5, 0.0), x, 10.0)];
    let axes = controllable_axes(&set, &USABLE, Vec3::zero());
    assert_eq!(axes, WrenchAxes { torque: [false, false, true], force: [false; 3] });
    assert_eq!(
        controllable_axes::<f64>(&[], &USABLE, Vec3::zero()),
        WrenchAxes { torque: [false; 3], force: [false; 3] }
    );
    // Both ways, but along a diagonal: force along one axis comes with force along another.
    let slanted = vec3(0.6, 0.8, 0.0);
    let both_ways = [slanted, -slanted].map(|d| thruster(Vec3::zero(), d, 10.0));
    assert_eq!(
        controllable_axes(&both_ways, &USABLE, Vec3::zero()),
        WrenchAxes { torque: [false; 3], force: [false; 3] }
    );
    // Straight through the centre of mass with both: force without torque, one way only.
    let wanted = wrench([0.0; 3], [12.0, 0.0, 0.0]);
    let s = thruster_duties(&set, &USABLE, Vec3::zero(), &wanted, WrenchAxes::ALL);
    assert!(size(s.missing) < 1e-13 && (s.duty[0] - 0.6).abs() < 1e-14, "{s:?}");
}

/// One thruster fails: the torque that it alone gave is missing, torque about other axes is not.
#[test]
fn a_dead_axis_does_not_take_the_others_with_it() {
    let mut usable = USABLE;
    for i in [8, 10] {
        usable[i] = false;
    }
    let wanted = wrench([10.0, -20.0, 30.0], [0.0; 3]);
    let s = thruster_duties(&couples(), &usable, Vec3::zero(), &wanted, WrenchAxes::TORQUE);
    check(&couples(), Vec3::zero(), wanted, &s);
    assert!((s.missing.torque - vec3(0.0, 0.0, 30.0)).norm() < 1e-12, "{:?}", s.missing);
}

#[test]
fn wrong_numbers_fire_nothing() {
    let mut set = corners();
    set[3].position_B.x = f64::NAN;
    set[7].force = -22.0;
    set[9].specific_impulse = 0.0;
    let wanted = wrench([5.0, 6.0, -7.0], [3.0, 0.0, 0.0]);
    let s = thruster_duties(&set, &USABLE, Vec3::zero(), &wanted, WrenchAxes::ALL);
    assert!((s.duty[3], s.duty[7], s.duty[9]) == (0.0, 0.0, 0.0), "{:?}", s.duty);
    assert!(size(s.missing) < 1e-12, "{:?}", s.missing);
    for bad in [f64::NAN, f64::INFINITY] {
        let wanted = wrench([bad, 0.0, 0.0], [0.0; 3]);
        let s = thruster_duties(&corners(), &USABLE, Vec3::zero(), &wanted, WrenchAxes::ALL);
        assert_eq!(s.duty, [0.0; THRUSTERS]);
    }
    let huge = wrench([1e300, -1e300, 3e299], [1e300; 3]);
    let s = thruster_duties(&corners(), &USABLE, Vec3::zero(), &huge, WrenchAxes::ALL);
    assert!(s.best && s.duty.iter().all(|d| (0.0..=1.0).contains(d)), "{:?}", s.duty);
}

/// The least cost over all corners of the feasible set: three thrusters (or the share) solve the
/// three rows, the others stand at a bound. `None`: not possible.
fn best_corner(columns: &[Vec3<f64>], cost: &[f64], target: Vec3<f64>) -> Option<f64> {
    let (n, mut best) = (columns.len(), None);
    for (a, b, c) in (0..n).flat_map(|a| (0..a).flat_map(move |b| (0..b).map(move |c| (a, b, c)))) {
        let [x, y, z] = [a, b, c].map(|i| columns[i]);
        let det = x.dot(y.cross(z));
        if det.abs() < 1e-9 {
            continue;
        }
        let others: Vec<_> = (0..n).filter(|&i| i != a && i != b && i != c).collect();
        for bits in 0..1_u32 << others.len() {
            let full = others.iter().enumerate().filter(|&(k, _)| bits >> k & 1 == 1);
            let (mut rest, mut sum) = (target, 0.0);
            for (_, &i) in full {
                rest -= columns[i];
                sum += cost[i];
            }
            let solved =
                [rest.dot(y.cross(z)), x.dot(rest.cross(z)), x.dot(y.cross(rest))].map(|d| d / det);
            if solved.iter().all(|s| (-1e-12..=1.0 + 1e-12).contains(s)) {
                sum += cost[a] * solved[0] + cost[b] * solved[1] + cost[c] * solved[2];
                best = Some(best.map_or(sum, |best: f64| best.min(sum)));
            }
        }
    }
    best
}

proptest! {
    #![proptest_config(cases(256))]

    /// Any wrench that some duties give is given, and with no more propellant than they take.
    /// Round-off: measured 3e-12 N·m missing. Random duties
    /// take 1.4 to 8 times the propellant.
    #[test]
    fn a_possible_wrench_is_given_with_no_more_propellant(
        set in any_set(THRUSTERS),
        duties in prop::collection::vec(0.0..1.0_f64, THRUSTERS),
        p_cm in vector(0.3),
    ) {
        let wanted = given(&set, p_cm, &duties);
        let s = thruster_duties(&set, &USABLE, p_cm, &wanted, WrenchAxes::ALL);
        check(&set, p_cm, wanted, &s);
        prop_assert!(size(s.missing) < 1e-10, "{:?}", s.missing);
        let (takes, known) = (propellant(&set, &s.duty), propellant(&set, &duties));
        prop_assert!(takes <= known, "{takes} > {known}");
    }

    /// Torque, whatever the force: propellant and share are those of the best corner, found by
    /// trying all. Where the whole torque
    /// cannot be given, no axis gets less than the share. Measured differences: 4e-15 kg/s of
    /// propellant/9.8, 6e-15 of the share.
    #[test]
    fn propellant_and_share_are_those_of_the_best_corner(
        set in any_set(7),
        torque in vector(40.0),
    ) {
        let wanted = SpatialForce::new(torque, Vec3::zero());
        let s = thruster_duties(&set, &USABLE, Vec3::zero(), &wanted, WrenchAxes::TORQUE);
        let columns: Vec<_> =
            set.iter().map(|t| t.position_B.cross(t.direction_B * t.force)).collect();
        let cost: Vec<_> = set.iter().map(|t| t.force / t.specific_impulse).collect();
        if let Some(least) = best_corner(&columns, &cost, torque) {
            prop_assert!(s.missing.torque.norm() < 1e-10, "{:?}", s.missing);
            let takes = propellant(&set, &s.duty);
            prop_assert!((takes - least).abs() < 1e-13, "{takes}, not {least}");
        } else {
            let (mut with_share, mut cost) = (columns.clone(), vec![0.0; 8]);
            with_share.push(-torque);
            cost[7] = -1.0;
            let share = best_corner(&with_share, &cost, Vec3::zero()).map_or(0.0, |cost| -cost);
            // The least share of any axis that torque is wanted about.
            let got = torque - s.missing.torque;
            let shares = torque.to_array().into_iter().zip(got.to_array()).map(|(w, g)| g / w);
            let least = shares.fold(1.0, smaller);
            prop_assert!(least > share - 1e-13, "{least}, not {share}");
        }
    }

    /// Never torque beyond what is wanted, nor the wrong way. Round-off: measured 2e-13.
    #[test]
    fn torque_never_overshoots(
        set in any_set(10),
        torque in vector(200.0),
        force in vector(100.0),
    ) {
        let wanted = SpatialForce::new(torque, force);
        let s = thruster_duties(&set, &USABLE, Vec3::zero(), &wanted, WrenchAxes::ALL);
        check(&set, Vec3::zero(), wanted, &s);
        for (missing, wanted) in s.missing.torque.to_array().into_iter().zip(torque.to_array()) {
            let share = missing / wanted;
            prop_assert!((-1e-9..=1.0 + 1e-9).contains(&share), "{missing} of {wanted}");
        }
    }

    /// In single precision the same, to its round-off: measured 7e-4 of 100 N·m.
    #[test]
    fn single_precision_gives_a_possible_wrench(
        duties in prop::collection::vec(0.0..1.0_f64, THRUSTERS),
    ) {
        let set = corners();
        let small: Vec<Thruster<f32>> = set.iter().map(Thruster::cast).collect();
        let wanted = given(&set, Vec3::zero(), &duties);
        let narrow = Vec3::<f32>::from_f64;
        let asked = SpatialForce::new(narrow(wanted.torque), narrow(wanted.force));
        let s = thruster_duties(&small, &USABLE, Vec3::zero(), &asked, WrenchAxes::ALL);
        prop_assert!(s.best);
        let wide: Vec<f64> = s.duty.iter().map(|&d| f64::from(d)).collect();
        let off = size(given(&set, Vec3::zero(), &wide) - wanted);
        prop_assert!(off < 2e-3, "{off}");
        prop_assert!(propellant(&set, &wide) < propellant(&set, &duties) + 1e-6);
    }
}
