//! Thrusters and their tank: against closed forms.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

mod equipped;

use equipped::{block, thruster, turning_block};
use wrasse_dynamics::{Robot, State};
use wrasse_hardware::{ActuatorCommand, List, STANDARD_GRAVITY, Tank, Thruster};
use wrasse_spatial::{Sym3, Vec3, vec3};
use wrasse_testing::largest;
use wrasse_world::{Booking, Equipment, Failure, Saturation, Source, Stepper};
use wrasse_world_testing::{OneSystem, OneSystemSetup};

const PERIOD: f64 = 0.1;

fn told(on: &[f64]) -> ActuatorCommand<f64> {
    let mut command = ActuatorCommand::default();
    command.thruster_on[..on.len()].copy_from_slice(on);
    command
}

fn thrusters(list: &[Thruster<f64>], tank: Option<Tank<f64>>) -> Equipment {
    let mut equipment = Equipment::default();
    equipment.actuators.thrusters = List::new(list);
    equipment.actuators.tank = tank;
    equipment
}

fn run(world: &mut OneSystem<1>, on: &[f64]) -> Vec<Saturation> {
    let cut = world.command(&[], Vec3::zero(), &told(on), PERIOD);
    world.advance(PERIOD).expect("stays finite");
    cut
}

fn slab() -> Robot<f64, 1> {
    block(50.0, Sym3::diagonal(4.0, 5.0, 6.0))
}

/// Along y, beside the centre of mass: pushes and turns about z.
fn aside() -> Thruster<f64> {
    thruster(vec3(0.7, 0.0, 0.0), vec3(0.0, 1.0, 0.0))
}

/// Impulse (N·s) of the pulses, from the turn of the base.
fn impulse(thruster: Thruster<f64>, on: &[f64]) -> f64 {
    let robot = slab();
    let mut world = turning_block(&robot, Vec3::zero(), &thrusters(&[thruster], None), 0.01);
    for on in on {
        assert_eq!(run(&mut world, &[*on]), []);
    }
    world.state().V_NB_B.angular.z * 6.0 / 0.7
}

#[track_caller]
fn near(what: &str, found: f64, expected: f64, within: f64) {
    let off = (found / expected - 1.0).abs();
    assert!(off < within, "{what}: {found} instead of {expected}, off by {off:e}");
}

/// Force 4 N, rise 6 ms, fall 9 ms. The force is linear between its bends and the turn is about one axis;
/// momentum is counted about the origin of N, from which the base goes away meanwhile: a quadrature of
/// fourth order over steps of 10 ms. Measured 1.2e-11; about the centre of mass it would be rounding.
#[test]
fn the_impulse_of_a_pulse_is_the_area_of_its_trapezoid() {
    near("pulse", impulse(aside(), &[0.05]), 4.0 * (0.05 - 0.003 + 0.0045), 1e-10);
    // Shut before the force is full: a triangle, its falling side as steep as ever.
    let quick = Thruster { minimum_on_time: 0.0, ..aside() };
    let share: f64 = 0.003 / 0.006;
    near("triangle", impulse(quick, &[0.003]), 4.0 * share * (0.0015 + share * 0.0045), 1e-10);
    // The fall reaches into the next period.
    near("tail", impulse(aside(), &[0.097, 0.0]), 4.0 * (0.097 - 0.003 + 0.0045), 1e-10);
    let sharp = Thruster { rise_time: 0.0, fall_time: 0.0, ..aside() };
    near("sharp", impulse(sharp, &[0.05, 0.0, 0.03]), 4.0 * 0.08, 1e-10);
}

#[test]
fn a_thruster_that_is_open_goes_on_without_a_new_rise() {
    let expected = 4.0 * (0.1 + 0.1 + 0.05 - 0.003 + 0.0045);
    near("through", impulse(aside(), &[0.1, 0.1, 0.05]), expected, 1e-10);
    near("anew", impulse(aside(), &[0.05, 0.05]), 2.0 * 4.0 * (0.05 - 0.003 + 0.0045), 1e-10);
    // PeriodCommand to shut at once after a whole period: only its fall is left.
    near("fall", impulse(aside(), &[0.1, 0.0]), 4.0 * (0.1 - 0.003 + 0.0045), 1e-10);
}

#[test]
fn push_and_turn_are_force_and_lever() {
    let robot = slab();
    let mut world = turning_block(&robot, Vec3::zero(), &thrusters(&[aside()], None), 0.001);
    let mut ledger = world.open_ledger();
    run(&mut world, &[0.05]);
    world.update_ledger(&mut ledger);
    let pulse = 4.0 * 0.0515;
    // About the origin of N: the base goes 0.1 mm aside meanwhile. Measured 1.6e-8.
    near("angular", ledger.sources[Source::Thrusters].angular.z, 0.7 * pulse, 1e-7);
    // The base turns by a milliradian meanwhile: the sine of it goes to -x.
    let linear = ledger.sources[Source::Thrusters].linear;
    near("linear", linear.y, pulse, 1e-5);
    assert!(linear.x < 0.0 && linear.x > -1e-2 * pulse);
    assert_eq!(ledger.sources[Source::Applied], Booking::default());
}

/// The force turns with the base and bends where no step would end: order 4 all the same. Measured
/// 3.76 (the steps between bends do not all shrink alike); without the split at the bends 2.26.
#[test]
fn steps_keep_their_order_over_the_bends_of_the_force() {
    let odd = Thruster {
        force: 40.0,
        rise_time: 0.013_7,
        fall_time: 0.017_3,
        position_B: vec3(0.5, 0.2, -0.3),
        ..aside()
    };
    let robot = slab();
    let flown = |step: f64| {
        let mut world = turning_block(&robot, vec3(0.9, -2.0, 1.5), &thrusters(&[odd], None), step);
        for on in [0.0561, 0.0, 0.1, 0.0333, 0.0789] {
            run(&mut world, &[on]);
        }
        world.state()
    };
    let fine = flown(1e-4);
    let error = |step: f64| {
        let d: State<f64, 1> = flown(step);
        largest((d.V_NB_B - fine.V_NB_B).to_array().iter().map(|x| x.abs()))
    };
    let (coarse, finer) = (error(0.02), error(0.005));
    let order = (coarse / finer).log2() / 2.0;
    assert!(order > 3.5 && order < 4.5, "order {order}");
}

#[test]
fn a_pulse_that_is_too_short_is_not_given_and_said() {
    let robot = slab();
    let mut world = turning_block(&robot, Vec3::zero(), &thrusters(&[aside(); 2], None), 0.01);
    assert_eq!(run(&mut world, &[0.019, 0.0]), [Saturation::PulseTooShort(0)]);
    assert_eq!(world.state().V_NB_B.angular, Vec3::zero());
    assert_eq!(run(&mut world, &[0.02, -1.0]), []);
    assert_eq!(run(&mut world, &[f64::NAN, 0.0]), []);
    // Periods shorter than the shortest pulse: what is open stays so for its time.
    let mut world = turning_block(&robot, Vec3::zero(), &thrusters(&[aside()], None), 0.001);
    let mut cut = vec![];
    for on in [0.008, 0.0, 0.0, 0.0, 0.0, 0.0] {
        cut.push(world.command(&[], Vec3::zero(), &told(&[on]), 0.008));
        world.advance(0.008).expect("stays finite");
    }
    let short = vec![Saturation::PulseTooShort(0)];
    assert_eq!(cut, [vec![], short.clone(), short, vec![], vec![], vec![]]);
    let found = world.state().V_NB_B.angular.z * 6.0 / 0.7;
    near("shortest", found, 4.0 * (0.02 - 0.003 + 0.0045), 1e-8);
}

/// 2000 pulses of a noise of 5 %: the mean within 4 of its own deviations (0.05/√2000), the deviation
/// within 4 of its own (0.05/√4000). Measured: mean 1.0005, deviation 0.0494.
#[test]
fn the_noise_of_pulses_has_its_deviation_and_comes_from_the_seed() {
    let noisy = Thruster { impulse_noise: 0.05, ..aside() };
    // So heavy that 2000 pulses hardly turn it: each gain is read from a gain of spin.
    let robot = block(50e3, Sym3::diagonal(4e3, 5e3, 6e3));
    let pulses = |seed: u64, of: usize| {
        let mut list = [aside(), noisy];
        list[0].impulse_noise = if of == 0 { 0.3 } else { 0.0 };
        let equipment = Equipment { seed, ..thrusters(&list, None) };
        let mut world = turning_block(&robot, Vec3::zero(), &equipment, 0.1);
        let mut before = 0.0;
        let mut gains = vec![];
        for i in 0..2000 {
            let other = if of == 0 && i % 3 == 0 { 0.05 } else { 0.0 };
            run(&mut world, &[other, 0.05]);
            let spin = world.state().V_NB_B.angular.z;
            gains.push((spin - before) * 6e3 / 0.7 / (4.0 * 0.0515));
            before = spin;
        }
        gains
    };
    let gains = pulses(7, 1);
    let n = gains.len() as f64;
    let mean = gains.iter().sum::<f64>() / n;
    let deviation = (gains.iter().map(|g| (g - mean) * (g - mean)).sum::<f64>() / (n - 1.0)).sqrt();
    assert!((mean - 1.0).abs() < 4.0 * 0.05 / n.sqrt(), "mean {mean}");
    assert!((deviation - 0.05).abs() < 4.0 * 0.05 / (2.0 * n).sqrt(), "deviation {deviation}");
    assert_eq!(gains, pulses(7, 1));
    assert_ne!(gains, pulses(8, 1));
    // Another thruster that fires beside it draws from a stream of its own. (It adds to every third
    // pulse: the others stay, but for the rounding of the larger sum.)
    let beside = pulses(7, 0);
    let off = (0..2000).filter(|i| i % 3 != 0).map(|i| (beside[i] - gains[i]).abs());
    let off = largest(off);
    assert!(off < 1e-10, "{off:e}");
}

/// Through the centre of mass, with the tank in it: 100 kg, of which 40 kg are propellant.
fn rocket(period: f64) -> (f64, f64) {
    let robot = block(60.0, Sym3::diagonal(4.0, 5.0, 6.0));
    let engine =
        Thruster { force: 400.0, rise_time: 0.0, ..thruster(Vec3::zero(), vec3(0.0, 0.0, 1.0)) };
    let tank = Tank { position_B: Vec3::zero(), propellant: 40.0 };
    let mut world = turning_block(&robot, Vec3::zero(), &thrusters(&[engine], Some(tank)), period);
    let mut gone = 0.0;
    while gone < 100.0 - 0.5 * period {
        world.command(&[], Vec3::zero(), &told(&[period]), period);
        world.advance(period).expect("stays finite");
        gone += period;
    }
    (world.state().V_NB_B.linear.z, world.actuator_readings().propellant)
}

/// Mass is constant within a period: the error is of first order in it. Measured: 2.05e-3 short with
/// periods of 2 s, 1.03e-3 with 1 s; the propellant to 2e-15.
#[test]
fn the_rocket_equation_holds_to_first_order_in_the_period() {
    let exhaust = 220.0 * STANDARD_GRAVITY;
    let left = 40.0 - 400.0 * 100.0 / exhaust;
    let ideal = exhaust * (100.0 / (60.0 + left)).ln();
    let (long, short) = (rocket(2.0), rocket(1.0));
    near("propellant", short.1, left, 1e-12);
    let (off_long, off_short) = (long.0 / ideal - 1.0, short.0 / ideal - 1.0);
    assert!((off_long / off_short - 2.0).abs() < 0.01);
    assert!(off_short.abs() < 1.1e-3, "{off_short:e}");
}

#[test]
fn an_empty_tank_gives_nothing_and_says_so_once() {
    let robot = slab();
    let tank = Tank { position_B: vec3(0.1, 0.2, 0.3), propellant: 2e-4 };
    let mut world =
        turning_block(&robot, Vec3::zero(), &thrusters(&[aside(); 2], Some(tank)), 0.01);
    assert_eq!(run(&mut world, &[0.1, 0.1]), []);
    assert_eq!(world.actuator_readings().propellant, 0.0);
    assert_eq!(run(&mut world, &[0.1, 0.1]), [Saturation::TankEmpty]);
    let before = world.momentum(world.id);
    assert_eq!(run(&mut world, &[0.1, 0.03]), [Saturation::TankEmpty]);
    assert_eq!(run(&mut world, &[0.0, 0.0]), []);
    assert_eq!(world.momentum(world.id), before);
    assert_eq!(world.robot().mass(), 50.0);
}

#[test]
fn a_valve_that_is_jammed_does_not_move() {
    let robot = slab();
    let mut world = turning_block(&robot, Vec3::zero(), &thrusters(&[aside(); 2], None), 0.01);
    world.fail(Failure::ThrusterShut(0));
    world.fail(Failure::ThrusterOpen(99));
    run(&mut world, &[0.1, 0.0]);
    assert_eq!(world.state().V_NB_B.angular, Vec3::zero());
    world.fail(Failure::ThrusterOpen(1));
    run(&mut world, &[0.1, 0.0]);
    run(&mut world, &[0.1, 0.0]);
    near("open", world.state().V_NB_B.angular.z * 6.0 / 0.7, 4.0 * (0.2 - 0.003), 1e-10);
}

/// An adaptive stepper sees the same. Measured 2e-16 off.
#[test]
fn error_control_meets_the_bends_too() {
    let robot = slab();
    let mut world = OneSystem::new(&OneSystemSetup {
        robot: &robot,
        limits: &[],
        actuator: None,
        equipment: thrusters(&[aside()], None),
        base: wrasse_world::BaseAttitude::Free,
        stepper: Stepper::Adaptive { tolerance: 1e-10 },
        start: State::default(),
        held: &[],
    });
    run(&mut world, &[0.05]);
    near("adaptive", world.state().V_NB_B.angular.z * 6.0 / 0.7, 4.0 * 0.0515, 1e-12);
}
