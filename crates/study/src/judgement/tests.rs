//! Judgements that can be checked by hand.

use super::*;
use crate::demand::Demand;
use crate::envelope::pyramid::pyramid;
use wrasse_hardware::{ControlMomentGyro, List, ReactionWheel};
use wrasse_spatial::{Vec3, vec3};
use wrasse_vehicle::Equipment;

/// A motion along x that needs `momentum` half way and comes to rest after 10 s: torque a full
/// cosine wave, momentum a raised cosine.
fn motion(momentum: f64) -> Demand {
    use wrasse_spatial::Real;
    let turn = core::f64::consts::TAU;
    let time: Vec<f64> = (0..=1000).map(|k| 0.01 * f64::from(k)).collect();
    let along = |f: &dyn Fn(f64, f64) -> f64| {
        time.iter()
            .map(|t| Real::sin_cos(turn * 0.1 * t))
            .map(|(s, c)| vec3(f(s, c), 0.0, 0.0))
            .collect()
    };
    Demand {
        torque_B: along(&|s, _| -0.5 * momentum * 0.1 * turn * s),
        momentum_B: along(&|_, c| 0.5 * momentum * (1.0 - c)),
        force_B: vec![Vec3::zero(); 1001],
        time,
    }
}

/// A torque along x held for 5 s, and on.
fn push(torque: f64) -> Demand {
    let time: Vec<f64> = (0..=50).map(|k| 0.1 * f64::from(k)).collect();
    Demand {
        torque_B: vec![vec3(torque, 0.0, 0.0); 51],
        momentum_B: time.iter().map(|t| vec3(-torque * t, 0.0, 0.0)).collect(),
        force_B: vec![Vec3::zero(); 51],
        time,
    }
}

fn wheels() -> Capability {
    let wheel = |axis_B| ReactionWheel {
        axis_B,
        inertia: 0.1,
        torque_limit: 0.2,
        speed_limit: 500.0,
        ..Default::default()
    };
    let axes = [vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0), vec3(0.0, 0.0, 1.0)];
    let mut equipment = Equipment::default();
    equipment.actuators.wheels = List::new(&axes.map(wheel));
    Capability::of(&equipment, Vec3::zero())
}

fn cmgs(momentum: f64) -> Capability {
    let mut equipment = Equipment::default();
    let cmgs = pyramid(0.6, momentum).map(|cmg| ControlMomentGyro { rate_limit: 1.0, ..cmg });
    equipment.actuators.cmgs = List::new(&cmgs);
    Capability::of(&equipment, Vec3::zero())
}

/// 40 N·m·s against 50 fit, 4π N·m against 0.2 do not: √(62.8) times slower they do.
#[test]
fn wheels_hold_what_they_cannot_give_fast_enough() {
    let verdict = judge(&motion(40.0), &wheels(), true);
    assert_eq!((verdict.torque, verdict.momentum), (Answer::No, Answer::Yes));
    let expected = (2.0 * core::f64::consts::TAU / 0.2).sqrt();
    let found = verdict.time_scaling.best.unwrap();
    // The peak is a sample. Measured 0.
    assert!((found - expected).abs() < 1e-9, "{found} {expected}");
    assert_eq!(verdict.time_scaling.plain, verdict.time_scaling.best);
    assert_eq!(judge(&motion(40.0), &wheels(), false).time_scaling.best, None);
}

/// 60 N·m·s is the middle of the way to 120, where the raised cosine has gained a quarter period.
#[test]
fn a_motion_leaves_the_envelope_where_its_momentum_says() {
    let verdict = judge(&motion(100.0), &wheels(), true);
    assert_eq!(verdict.momentum, Answer::No);
    // Linear between samples 0.05 s apart. Measured 0.
    assert!((verdict.saturates.best.unwrap() - 2.5).abs() < 1e-3, "{verdict:?}");
}

/// The pyramid of 50 N·m·s stops at 60 with plain steering and holds 160 at most.
#[test]
fn cmgs_answer_with_steering_between_the_inner_and_the_outer_surface() {
    let answers = [50.0, 100.0, 200.0].map(|h| judge(&motion(h), &cmgs(50.0), true).momentum);
    assert_eq!(answers, [Answer::Yes, Answer::WithSteering, Answer::No]);
    let verdict = judge(&motion(100.0), &cmgs(50.0), true);
    assert_eq!(verdict.time_scaling.best, Some(1.0));
    // 100 / 60 suffices for the momentum; the torque near the surface asks for a little more.
    let plain = verdict.time_scaling.plain.unwrap();
    assert!(plain > 100.0 / 60.0 && plain < 1.1 * 100.0 / 60.0, "{plain}");
    let stops = verdict.saturates.plain.unwrap();
    // 50 (1 - cos) = 60 after a quarter and 0.0320 of the turn: 2.8205 s. Measured 2.8204.
    assert!((stops - 2.8205).abs() < 5e-3, "{stops}");
}

fn jets(force: f64, propellant: f64) -> Equipment {
    use wrasse_hardware::{Tank, Thruster};
    let mut equipment = Equipment::default();
    // Couples about x: from one metre above and below the centre, along y.
    let jet = |z: f64, y: f64| Thruster {
        position_B: vec3(0.0, 0.0, z),
        direction_B: vec3(0.0, y, 0.0),
        force,
        specific_impulse: 200.0,
        ..Default::default()
    };
    let all = [jet(1.0, 1.0), jet(1.0, -1.0), jet(-1.0, 1.0), jet(-1.0, -1.0)];
    equipment.actuators.thrusters = List::new(&all);
    equipment.actuators.tank = Some(Tank { propellant, ..Default::default() });
    equipment
}

/// Couples of 2 N·m beside wheels of 50 N·m·s: of 4 N·m half is stored, and lasts 25 s.
#[test]
fn wheels_beside_thrusters_fill_with_what_couples_do_not_take() {
    let mut equipment = jets(1.0, 40.0);
    let wheel = ReactionWheel {
        axis_B: vec3(1.0, 0.0, 0.0),
        inertia: 0.1,
        torque_limit: 5.0,
        speed_limit: 500.0,
        ..Default::default()
    };
    equipment.actuators.wheels = List::new(&[wheel]);
    let capability = Capability::of(&equipment, Vec3::zero());
    let full = judge(&push(4.0), &capability, false).saturates.best.unwrap();
    // Measured 3e-11.
    assert!((full - 25.0).abs() < 1e-6, "{full}");
    // What couples take whole is never full.
    assert_eq!(judge(&push(1.9), &capability, false).saturates.best, None);
}

/// 1 N·m for 5 s takes 2 x 0.5 N for 5 s: 5 / (200 · 9.80665) = 2.55 g.
#[test]
fn a_tank_that_holds_too_little_is_a_no() {
    let answer = |kg| {
        let capability = Capability::of(&jets(1.0, kg), Vec3::zero());
        let judged = judge(&push(1.0), &capability, false);
        // Measured 5e-19 kg.
        assert!((judged.fuel.unwrap() - 5.0 / (200.0 * 9.80665)).abs() < 1e-8, "{judged:?}");
        judged.propellant
    };
    assert_eq!([answer(0.003), answer(0.002)], [Answer::Yes, Answer::No]);
}

/// 4 N·m along x: 60 N·m·s last 15 s, 160 last 40 s; three wheels of 50 last 12.5 s.
#[test]
fn a_torque_that_lasts_is_followed_beyond_the_task() {
    let verdict = judge(&push(4.0), &cmgs(50.0), false);
    assert_eq!((verdict.torque, verdict.momentum), (Answer::Yes, Answer::Yes));
    let (plain, best) = (verdict.saturates.plain.unwrap(), verdict.saturates.best.unwrap());
    // Measured 4.4e-4 and 6e-11.
    assert!((plain - 15.0).abs() < 5e-3 && (best - 40.0).abs() < 1e-6, "{plain} {best}");
    let wheels = judge(&push(4.0), &wheels(), false).saturates.best.unwrap();
    assert!((wheels - 12.5).abs() < 1e-9, "{wheels}");
    assert_eq!(judge(&push(4.0), &Capability::ideal(), false).saturates.best, None);
}
