//! A body without torque, against closed forms: by itself, and as a robot without joints.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

use wrasse_dynamics::{MassProperties, PerBody, Robot, State};
use wrasse_hardware::ActuatorCommand;
use wrasse_spatial::{Mat3, Pose, Quat, SpatialForce, SpatialVelocity, Sym3, Vec3, vec3};
use wrasse_world::{BaseAttitude, Equipment, FreeBody, Instant, Source, Stepper};
use wrasse_world_testing::{OneSystem, OneSystemSetup};

/// Where the bodies are at the start: in no special place.
fn X_NT() -> Pose<f64> {
    Pose::from_quat(Quat::exp(vec3(0.4, -1.1, 0.7)), vec3(1.0, -2.0, 0.5))
}

/// Twist of the body's frame for a body rate `w` (rad/s) and a velocity of the centre of mass at
/// `p_cm` (m/s, body axes).
fn twist(w: Vec3<f64>, v_cm: Vec3<f64>, p_cm: Vec3<f64>) -> SpatialVelocity<f64> {
    SpatialVelocity::new(w, v_cm - w.cross(p_cm))
}

/// A body of 300 kg with its centre of mass off its origin.
const P_CM: Vec3<f64> = vec3(0.3, -0.2, 0.5);
fn body(I: Sym3<f64>) -> MassProperties<f64> {
    MassProperties::from_central(300.0, P_CM, I)
}

/// Attitude after `t` (s), by both: as a free body in steps of `h` (s), and as a robot.
fn both(matter: MassProperties<f64>, V: SpatialVelocity<f64>, t: f64, h: f64) -> [FreeBody; 2] {
    let mut alone = FreeBody::new(matter, &X_NT(), &V);
    let steps = (t / h).round();
    let mut done = 0.0;
    while done < steps {
        alone.step(h);
        done += 1.0;
    }
    let robot: Robot<f64, 0> = Robot::new(matter, &[]).expect("no joints to refuse");
    let mut world = OneSystem::new(&OneSystemSetup {
        robot: &robot,
        limits: &[],
        actuator: None,
        equipment: Equipment::default(),
        base: BaseAttitude::Free,
        stepper: Stepper::Fixed { step: h },
        start: State { X_NB: X_NT(), V_NB_B: V, ..State::default() },
        held: &[],
    });
    world.command(&[], Vec3::zero(), &ActuatorCommand::default(), t);
    world.advance(t).expect("stays finite");
    let state = world.state();
    [alone, FreeBody::new(matter, &state.X_NB, &state.V_NB_B)]
}

/// Inertia (kg·m²) across and along the axis of symmetry, z.
const ACROSS: f64 = 40.0;
const ALONG: f64 = 70.0;

/// A symmetric top: the body turns with `L/I_across` about its momentum, and about its own axis with
/// `(1 - I_along/I_across) w_z`.
fn precessed(w: Vec3<f64>, t: f64) -> Quat<f64> {
    let quat_NT = Quat::from_matrix(&X_NT().rotation);
    let L_N = X_NT().rotation * vec3(ACROSS * w.x, ACROSS * w.y, ALONG * w.z);
    let own = vec3(0.0, 0.0, (1.0 - ALONG / ACROSS) * w.z * t);
    Quat::exp(L_N * (t / ACROSS)) * quat_NT * Quat::exp(own)
}

/// In steps of 0.1 s, whose error of order 4 grows with the time. Measured, alone and as a robot
/// alike: attitude 4.2e-10 rad after 60 s and 4.2e-9 rad after 600 s, spin within 1.6e-12 rad/s; the
/// centre of mass, 24 m on its way after 600 s, within 1.7e-12 m.
#[test]
fn a_symmetric_body_precesses_as_the_closed_form_says() {
    let (w, v_cm) = (vec3(0.05, -0.02, 0.1), vec3(0.02, 0.01, -0.03));
    let matter = body(Sym3::diagonal(ACROSS, ACROSS, ALONG));
    for (t, bound) in [(60.0, 1e-9), (600.0, 1e-8)] {
        for found in both(matter, twist(w, v_cm, P_CM), t, 0.1) {
            let off = (found.quat_NT.conjugate() * precessed(w, t)).log().norm();
            assert!(off < bound, "attitude off by {off:e} rad after {t} s");
            let gone = X_NT().point(P_CM) + X_NT().rotation * v_cm * t;
            let astray = (found.p_NTcm_N - gone).norm();
            assert!(astray < 1e-11, "centre of mass off by {astray:e} m after {t} s");
            let spin = (found.twist().angular.z - w.z).abs();
            assert!(spin < 1e-11, "spin off by {spin:e} rad/s after {t} s");
        }
    }
}

/// Complete elliptic integral of the first kind of modulus `k` (–), by arithmetic-geometric means.
fn quarter_period(k: f64) -> f64 {
    let (mut a, mut b) = (1.0, (1.0 - k * k).sqrt());
    for _ in 0..8 {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    std::f64::consts::FRAC_PI_2 / a
}

/// Period (s) after which the body rates of a free body with the principal inertias `a < b < c`
/// repeat, for rates `w` in its principal axes.
///
/// # Source
/// Landau and Lifshitz, *Mechanics*, section 37.
fn tumbling_period([a, b, c]: [f64; 3], w: Vec3<f64>) -> f64 {
    let [x, y, z] = [a * w.x * w.x, b * w.y * w.y, c * w.z * w.z];
    let (twice_energy, square) = (x + y + z, a * x + b * y + c * z);
    // The momentum circles the axis of largest or of smallest inertia.
    let (other, circled) = if square > twice_energy * b { (a, c) } else { (c, a) };
    let fast = (circled - b) * (square - twice_energy * other);
    let slow = (b - other) * (twice_energy * circled - square);
    4.0 * quarter_period((slow / fast).sqrt()) / (fast / (a * b * c)).sqrt()
}

/// Spun about its intermediate axis, 0.3 degrees off, the body turns over; after half a period it
/// spins the other way round, after a whole one as at the start. Steps of 50 ms over 254 s.
/// Measured, alone and as a robot alike: rates back within 3.7e-11 rad/s, energy within 7.5e-13,
/// momentum within 9e-16.
#[test]
fn a_body_spun_about_its_intermediate_axis_turns_over_and_comes_back_in_the_elliptic_period() {
    let principal = [30.0, 50.0, 70.0];
    let [a, b, c] = principal;
    let matter = body(Sym3::diagonal(a, b, c));
    let w = vec3(0.001, 0.2, 0.002);
    let V = twist(w, Vec3::zero(), P_CM);
    let start = FreeBody::new(matter, &X_NT(), &V);
    let period = tumbling_period(principal, w);
    let turned_over = vec3(-w.x, -w.y, w.z);
    for (t, expected) in [(0.5 * period, turned_over), (period, w)] {
        for found in both(matter, V, t, t / (t / 0.05).round()) {
            let off = (found.twist().angular - expected).norm();
            assert!(off < 1e-10, "rates off by {off:e} rad/s after {t} s");
            let energy = found.kinetic_energy() / start.kinetic_energy() - 1.0;
            assert!(energy.abs() < 2e-12, "energy off by {energy:e}");
            let momentum = (found.angular - start.angular).norm() / start.angular.norm();
            assert!(momentum < 1e-14, "angular momentum off by {momentum:e}");
        }
    }
}

/// A vehicle at rest with a body that tumbles beside it, flown in control periods of `period` (s).
fn beside_a_vehicle(body: FreeBody, stepper: Stepper, period: f64, count: usize) -> FreeBody {
    let robot: Robot<f64, 0> = Robot::new(body.matter, &[]).expect("no joints to refuse");
    let mut world = OneSystem::new(&OneSystemSetup {
        robot: &robot,
        limits: &[],
        actuator: None,
        equipment: Equipment::default(),
        base: BaseAttitude::Free,
        stepper,
        start: State::default(),
        held: &[],
    });
    world.add_body(&body);
    for _ in 0..count {
        world.command(&[], Vec3::zero(), &ActuatorCommand::default(), period);
        world.advance(period).expect("stays finite");
    }
    world.free_bodies()[0]
}

fn tumbling() -> FreeBody {
    let w = vec3(0.05, 0.2, -0.1);
    FreeBody::new(body(Sym3::diagonal(30.0, 50.0, 70.0)), &X_NT(), &twist(w, w, P_CM))
}

#[test]
fn a_free_body_takes_the_steps_of_the_world_however_long_the_control_period_is() {
    let stepper = Stepper::Fixed { step: 0.125 };
    let in_one = beside_a_vehicle(tumbling(), stepper, 4.0, 1);
    let in_many = beside_a_vehicle(tumbling(), stepper, 0.125, 32);
    assert_eq!(in_one, in_many);
}

/// The vehicle asks for no small steps here; the body does. Measured after 20 s: 1.3e-9, 1.3e-11
/// and 1.5e-13 rad.
#[test]
fn a_free_body_keeps_the_tolerance_of_the_adaptive_stepper() {
    let exact = beside_a_vehicle(tumbling(), Stepper::Fixed { step: 0.002 }, 20.0, 1);
    for tolerance in [1e-7, 1e-9, 1e-11] {
        let found = beside_a_vehicle(tumbling(), Stepper::Adaptive { tolerance }, 20.0, 1);
        let off = (found.quat_NT.conjugate() * exact.quat_NT).log().norm();
        assert!(off < tolerance, "attitude off by {off:e} rad at {tolerance:e}");
    }
}

/// The vehicle is pushed, the body beside it is not: torque and impulse count about the centre of
/// mass of both. Measured: angular 6.5e-10 and 6.1e-12, a quadrature now; linear 5e-16;
/// energy 4.5e-9 and 1.3e-11 of the scales.
#[test]
fn the_books_close_over_a_vehicle_that_is_pushed_beside_a_free_body() {
    let matter = body(Sym3::diagonal(30.0, 50.0, 70.0));
    let robot: Robot<f64, 0> = Robot::new(matter, &[]).expect("no joints to refuse");
    for stepper in [Stepper::Fixed { step: 0.05 }, Stepper::Adaptive { tolerance: 1e-9 }] {
        let mut world = OneSystem::new(&OneSystemSetup {
            robot: &robot,
            limits: &[],
            actuator: None,
            equipment: Equipment::default(),
            base: BaseAttitude::Free,
            stepper,
            start: State {
                X_NB: Pose::new(Mat3::identity(), vec3(-2.0, 4.0, 1.0)),
                ..State::default()
            },
            held: &[],
        });
        world.add_body(&tumbling());
        world.set_outside_wrench(
            Box::new(|Instant { time: t, .. }, _| {
                let mut on = PerBody::filled(SpatialForce::zero());
                on.base = SpatialForce::new(vec3(0.5, -0.2 * t, 0.3), vec3(3.0, 2.0 * t, -4.0));
                on
            }),
            &[],
        );
        let mut ledger = world.open_ledger();
        for _ in 0..20 {
            world.command(&[], Vec3::zero(), &ActuatorCommand::default(), 0.5);
            for part in [0.3, 0.2] {
                world.advance(part).expect("stays finite");
            }
            world.update_ledger(&mut ledger);
        }
        let [angular, linear, energy] = core::array::from_fn(|i| ledger.worst[i] / ledger.scale[i]);
        assert!(
            ledger.sources[Source::Applied].angular.norm() > 10.0,
            "{:?}",
            ledger.sources[Source::Applied].angular
        );
        assert!(angular < 1e-9, "angular rest {angular:e} of the scale");
        assert!(linear < 1e-9, "linear rest {linear:e} of the scale");
        assert!(energy < 1e-6, "energy rest {energy:e} of the scale");
    }
}
