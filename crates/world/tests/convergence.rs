//! The fixed step is of order 4 in everything that is integrated, each quantity by itself; the
//! adaptive stepper follows its tolerance.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

mod atlas_class;
mod branched;

use branched::{J, moving};
use wrasse_dynamics::{BodyId, PerBody, State};
use wrasse_hardware::{ActuatorCommand, SetPoint, SetPointMotion};
use wrasse_spatial::{Quat, SpatialForce, Vec3, vec3};
use wrasse_world::{Account, BaseAttitude, Course, Drive, Equipment, Instant, Stepper};
use wrasse_world_testing::{OneSystem, OneSystemSetup};

/// What a run ends with: where, how fast, and the momentum and energy summed over the bodies.
struct End<const J: usize> {
    quat_NB: Quat<f64>,
    q: [f64; J],
    v: [f64; J],
    account: Account,
}

/// One control period of `span` (s), integrated in the world's own steps.
fn end<const J: usize>(mut world: OneSystem<J>, drives: &[Drive; J], span: f64) -> End<J> {
    world.command(drives, Vec3::zero(), &ActuatorCommand::default(), span);
    world.advance(span).expect("stays finite");
    let s = world.state();
    End { quat_NB: world.quat_NB(), q: s.q, v: s.v, account: world.account() }
}

/// Errors of attitude (rad), joint positions, joint rates, energy (J), linear (N·s) and angular
/// momentum (N·m·s).
fn errors<const J: usize>(a: &End<J>, b: &End<J>) -> [f64; 6] {
    let distance = |a: [f64; J], b: [f64; J]| {
        a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
    };
    [
        (a.quat_NB.conjugate() * b.quat_NB).log().norm(),
        distance(a.q, b.q),
        distance(a.v, b.v),
        (a.account.energy - b.account.energy).abs(),
        (a.account.linear - b.account.linear).norm(),
        (a.account.angular - b.account.angular).norm(),
    ]
}

/// Slopes of the errors at four times, twice and once the step `h` (s). The reference runs at a
/// quarter of it: its own error, 1/256, moves the last slope by 0.006.
fn slopes<const J: usize>(h: f64, run: impl Fn(f64) -> End<J>) -> [[f64; 2]; 6] {
    let reference = run(0.25 * h);
    let found = [4.0, 2.0, 1.0].map(|k| errors(&run(k * h), &reference));
    core::array::from_fn(|i| [0, 1].map(|k| (found[k][i] / found[k + 1][i]).log2()))
}

#[track_caller]
fn is_of_order_4(quantity: &str, slopes: [f64; 2]) {
    for slope in slopes {
        assert!((slope - 4.0).abs() < 0.2, "{quantity}: slopes {slopes:.3?}");
    }
}

/// Wrenches from outside on three bodies, each with its own rhythm.
fn pushed_and_twisted() -> Course<J> {
    Box::new(|Instant { time: t, .. }, _| {
        let mut on = PerBody::filled(SpatialForce::zero());
        on[BodyId::Base] = SpatialForce::new(
            vec3(0.8 * (1.3 * t).sin(), -0.5, 0.3 * (2.0 * t).cos()),
            vec3(2.0, 1.5 * (0.9 * t).cos(), -1.0),
        );
        on[BodyId::Link(1)] = SpatialForce::new(
            vec3(0.1, 0.2 * (1.7 * t).cos(), -0.1),
            vec3(-0.8 * (1.1 * t).sin(), 0.6, 0.9),
        );
        on[BodyId::Link(3)] = SpatialForce::new(
            vec3(-0.2, 0.1, 0.15 * (2.3 * t).sin()),
            vec3(0.5, -0.7 * (1.9 * t).cos(), 0.4),
        );
        on
    })
}

/// Length of the runs of the light robot (s), and the finest of the steps that are compared (s):
/// its errors are 1e-10 of the quantities, far above round-off.
const SPAN: f64 = 2.0;
const FINEST: f64 = 0.00625;

const EFFORTS: [Drive; J] =
    [Drive::Effort(0.9), Drive::Effort(-0.5), Drive::Effort(0.7), Drive::Effort(-0.3)];

/// From where a joint is, as it moves, to rest 0.5 (rad or m) further.
fn follow(position: f64, rate: f64, span: f64) -> Drive {
    let from = SetPoint { position, rate, acceleration: 0.0 };
    let to = SetPoint { position: position + 0.5, rate: 0.0, acceleration: 0.0 };
    Drive::Follow(SetPointMotion::between(from, to, span))
}

/// Joints 1 and 2 follow, the others are driven by force.
fn mixed() -> [Drive; J] {
    let State { q, v, .. } = moving();
    [EFFORTS[0], follow(q[1], v[1], SPAN), follow(q[2], v[2], SPAN), EFFORTS[3]]
}

/// Measured: attitude 3.97 3.99, positions 3.99 4.00, rates 3.99 4.00, energy 3.97 3.99.
#[test]
fn joints_driven_by_force_move_with_order_4() {
    let run = |h| end(branched::world(moving(), BaseAttitude::Free, h), &EFFORTS, SPAN);
    let [attitude, positions, rates, energy, ..] = slopes(FINEST, run);
    is_of_order_4("attitude", attitude);
    is_of_order_4("joint positions", positions);
    is_of_order_4("joint rates", rates);
    is_of_order_4("energy", energy);
}

/// Measured: attitude 4.02 4.01, positions 4.01 4.01, rates 3.96 3.99, energy 4.12 4.07.
#[test]
fn joints_that_follow_beside_joints_driven_by_force_move_with_order_4() {
    let run = |h| end(branched::world(moving(), BaseAttitude::Free, h), &mixed(), SPAN);
    let [attitude, positions, rates, energy, ..] = slopes(FINEST, run);
    is_of_order_4("attitude", attitude);
    is_of_order_4("joint positions", positions);
    is_of_order_4("joint rates", rates);
    is_of_order_4("energy", energy);
}

/// Only a wrench from outside changes the momentum; on the light robot three bodies feel one.
/// Measured: attitude 3.95 3.98, positions 4.00 4.01, rates 3.87 3.94, energy 3.89 3.95,
/// linear 4.10 4.05, angular 4.05 4.03.
#[test]
fn momentum_given_from_outside_arrives_with_order_4() {
    let run = |h| {
        let mut world = branched::world(moving(), BaseAttitude::Free, h);
        world.set_outside_wrench(pushed_and_twisted(), &[]);
        end(world, &EFFORTS, SPAN)
    };
    let [attitude, positions, rates, energy, linear, angular] = slopes(FINEST, run);
    is_of_order_4("attitude", attitude);
    is_of_order_4("joint positions", positions);
    is_of_order_4("joint rates", rates);
    is_of_order_4("energy", energy);
    is_of_order_4("linear momentum", linear);
    is_of_order_4("angular momentum", angular);
}

/// The slow arm on the heavy bus needs long steps before its error stands out of the round-off.
/// Measured: attitude 4.02 4.02, positions 4.01 4.01, rates 4.02 4.01, energy 4.06 4.03.
#[test]
fn the_laden_servicer_moves_with_order_4_from_its_coast() {
    let held = [(atlas_class::tool(), atlas_class::cube(500.0))];
    let start = atlas_class::coasting();
    let drives = core::array::from_fn(|j| match j {
        0..4 => Drive::Effort([1.0, -1.5, 0.8, -0.5][j]),
        _ => follow(start.q[j], start.v[j], 8.0),
    });
    let run = |h| {
        let world = OneSystem::new(&OneSystemSetup {
            robot: &atlas_class::unladen(),
            limits: &[],
            actuator: None,
            equipment: Equipment::default(),
            base: BaseAttitude::Free,
            stepper: Stepper::Fixed { step: h },
            start,
            held: &held,
        });
        end(world, &drives, 8.0)
    };
    let [attitude, positions, rates, energy, ..] = slopes(0.05, run);
    is_of_order_4("attitude", attitude);
    is_of_order_4("joint positions", positions);
    is_of_order_4("joint rates", rates);
    is_of_order_4("energy", energy);
}

/// Where the attitude is held, the momentum follows from the motion and the torque is booked apart:
/// the rest is the error of the quadrature. Measured: angular 4.00 4.00, energy 3.93 3.97.
#[test]
fn what_a_held_base_leaves_unexplained_falls_with_order_4() {
    let rests = |h: f64| {
        let mut start = moving();
        start.V_NB_B.angular = Vec3::zero();
        let mut world = branched::world(start, BaseAttitude::Held, h);
        let mut ledger = world.open_ledger();
        world.command(&mixed(), Vec3::zero(), &ActuatorCommand::default(), SPAN);
        world.advance(SPAN).expect("stays finite");
        world.update_ledger(&mut ledger);
        ledger.residuals()
    };
    let found = [4.0, 2.0, 1.0].map(|k| rests(k * FINEST));
    let slopes = |i: usize| [0, 1].map(|k: usize| (found[k][i] / found[k + 1][i]).log2());
    is_of_order_4("angular rest", slopes(0));
    is_of_order_4("energy rest", slopes(2));
}

/// Per step the error is kept; over the run it stays below the tolerance and falls with it.
/// Measured at 1e-8, 1e-9, 1e-10: attitude 8.6e-10, 9.7e-11, 9.6e-12; positions 2.4e-9, 2.7e-10,
/// 2.6e-11; rates 1.0e-9, 1.1e-10, 9.7e-12. The reference is wrong by 2e-14.
#[test]
fn the_error_of_the_adaptive_stepper_follows_its_tolerance() {
    let reference =
        end(branched::world(moving(), BaseAttitude::Free, FINEST / 8.0), &EFFORTS, SPAN);
    let errors_at = |tolerance: f64| {
        let world = OneSystem::new(&OneSystemSetup {
            robot: &branched::robot(),
            limits: &[],
            actuator: None,
            equipment: Equipment::default(),
            base: BaseAttitude::Free,
            stepper: Stepper::Adaptive { tolerance },
            start: moving(),
            held: &[],
        });
        errors(&end(world, &EFFORTS, SPAN), &reference)
    };
    let mut before = errors_at(1e-8);
    for tolerance in [1e-9, 1e-10] {
        let now = errors_at(tolerance);
        for i in 0..3 {
            let ratio = before[i] / now[i];
            assert!(now[i] < tolerance, "quantity {i}: {:e} at {tolerance:e}", now[i]);
            assert!((5.0..20.0).contains(&ratio), "quantity {i}: fell by {ratio:.1}");
        }
        before = now;
    }
}

/// A push of a tenth of a second, after a second in which long steps do: the step that meets it is
/// taken back. Measured off after 2 s: attitude 7.3e-11,
/// joint rates 2.4e-10; where every step is taken, some 1e-5.
#[test]
fn a_step_that_meets_a_sudden_push_is_taken_back() {
    let flown = |stepper| {
        let mut world = OneSystem::new(&OneSystemSetup {
            robot: &branched::robot(),
            limits: &[],
            actuator: None,
            equipment: Equipment::default(),
            base: BaseAttitude::Free,
            stepper,
            start: moving(),
            held: &[],
        });
        world.set_outside_wrench(
            Box::new(|Instant { time: t, .. }, _| {
                let mut on = PerBody::filled(SpatialForce::zero());
                let late = (t - 1.0) / 0.03;
                on[BodyId::Link(1)].force.y = 20.0 * (-late * late).exp();
                on
            }),
            &[],
        );
        end(world, &[Drive::Effort(0.0); J], SPAN)
    };
    let tolerance = 1e-9;
    let off =
        errors(&flown(Stepper::Adaptive { tolerance }), &flown(Stepper::Fixed { step: 5e-4 }));
    assert!(off[0] < 10.0 * tolerance, "attitude off by {:e} rad", off[0]);
    assert!(off[2] < 10.0 * tolerance, "joint rates off by {:e}", off[2]);
}
