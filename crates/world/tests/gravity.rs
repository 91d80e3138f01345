//! Uniform gravity: what falls, what swings, and what the ledger says of it.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]
#![allow(clippy::unwrap_used, reason = "a test may stop where it finds nothing")]

mod branched;

use branched::{J, moving, world};
use std::f64::consts::TAU;
use wrasse_dynamics::{
    BodyId, Joint, JointKind, MassProperties, Outside, PerBody, Robot, State, inverse_dynamics,
    kinematics,
};
use wrasse_hardware::{ActuatorCommand, SetPointMotion};
use wrasse_spatial::{Pose, SpatialForce, SpatialVelocity, Sym3, Vec3, vec3};
use wrasse_world::{BaseAttitude, Drive, Environment, Equipment, FreeBody, Source, Stepper};
use wrasse_world_testing::{OneSystem, OneSystemSetup};

const G: Vec3<f64> = Vec3 { x: 1.2, y: -0.7, z: -9.6 };
const EFFORTS: [f64; J] = [0.9, -0.5, 0.7, -0.3];

/// The branched robot, moving, driven by torques for two seconds.
fn flown(environment: Environment, step: f64) -> OneSystem<J> {
    let mut world = world(moving(), BaseAttitude::Free, step);
    world.set_environment(environment);
    world.command(&EFFORTS.map(Drive::Effort), Vec3::zero(), &ActuatorCommand::default(), 2.0);
    world.advance(2.0).unwrap();
    world
}

fn gravity() -> Environment {
    Environment::UniformGravity { acceleration_N: G }
}

/// What falls freely moves as in free space, but for `g t²/2` of everything. The centre of mass does to
/// rounding, for a Runge–Kutta step is exact for a parabola: measured 3e-15 m. Angular momentum about the
/// origin of N grows with the cube of time, which the stages of a step do not see exactly: attitude and
/// joints keep within what the step leaves, measured 9e-10 m and rad at 0.01 s, and a sixteenth
/// of it at half the step.
#[test]
fn a_tree_that_falls_moves_as_in_free_space_beside_its_fall() {
    let apart = [0.01, 0.005].map(|step| {
        let (falling, floating) = (flown(gravity(), step), flown(Environment::FreeSpace, step));
        let fallen = |world: &OneSystem<J>| world.centre_of_mass(world.id);
        let off = (fallen(&falling) - fallen(&floating) - G * 2.0).norm();
        assert!(off < 1e-13, "{off:e} m");
        let (a, b) = (falling.state(), floating.state());
        let (v, u) = (a.X_NB.rotation * a.V_NB_B.linear, b.X_NB.rotation * b.V_NB_B.linear);
        let mut all = vec![
            (a.X_NB.translation - b.X_NB.translation - G * 2.0).norm(),
            (falling.quat_NB().conjugate() * floating.quat_NB()).log().norm(),
            (v - u - G * 2.0).norm(),
        ];
        all.extend((0..J).flat_map(|j| [a.q[j] - b.q[j], a.v[j] - b.v[j]]).map(f64::abs));
        wrasse_testing::largest(all)
    });
    assert!(apart[0] < 1e-8 && apart[1] < apart[0] / 14.0, "{apart:?}");
}

/// A tree at rest that falls: no joint accelerates, and joints that are held need no torque. Measured
/// 4e-15.
#[test]
fn joints_that_fall_need_no_torque() {
    let start = State { V_NB_B: SpatialVelocity::zero(), v: [0.0; J], ..moving() };
    let mut world = world(start, BaseAttitude::Free, 0.01);
    world.set_environment(gravity());
    let mut check = |drives: [Drive; J]| {
        world.command(&drives, Vec3::zero(), &ActuatorCommand::default(), 0.1);
        let found = world.dynamics();
        let fall_B = start.X_NB.rotation.transpose_mul(G);
        assert!((found.nudot.base.linear - fall_B).norm() < 1e-13);
        assert!(found.nudot.base.angular.norm() < 1e-13);
        let joints = found.nudot.joints.iter().chain(&found.force.joints);
        assert!(joints.clone().all(|x| x.abs() < 1e-13), "{:?}", joints.collect::<Vec<_>>());
    };
    check([Drive::Effort(0.0); J]);
    check(start.q.map(|q| Drive::Follow(SetPointMotion::still(q))));
}

/// Forward dynamics with a weight on each body, against inverse dynamics with none and a base that
/// accelerates against gravity: the route of Featherstone, which knows no centre of mass. Measured 4e-14
/// of some 40 N and N·m.
#[test]
fn weights_on_the_bodies_are_a_base_that_accelerates_upwards() {
    let mut world = world(moving(), BaseAttitude::Free, 0.01);
    world.set_environment(gravity());
    world.command(&EFFORTS.map(Drive::Effort), Vec3::zero(), &ActuatorCommand::default(), 0.1);
    let (state, mut nudot) = (world.state(), world.dynamics().nudot);
    let k = kinematics(world.robot(), &state);
    nudot.base.linear -= state.X_NB.rotation.transpose_mul(G);
    let asked = inverse_dynamics(&k, &nudot, Outside::nothing()).force;
    for (j, effort) in EFFORTS.iter().enumerate() {
        assert!((asked.joints[j] - effort).abs() < 1e-12, "joint {j}: {}", asked.joints[j]);
    }
    let held = asked.base.torque.norm().max(asked.base.force.norm());
    assert!(held < 1e-11, "a base that nothing holds: {:?}", asked.base);
}

/// Impulse `m g t`, angular impulse `∫ p_cm × m g`, work `m g·Δp_cm`, in closed form; and the ledger closes.
/// Residuals measured 6e-12 N·m·s, 4e-13 N·s and 9e-10 J, the last of the quadrature of the work.
#[test]
fn the_ledger_of_a_fall_closes_and_has_the_closed_form() {
    let mut world = world(moving(), BaseAttitude::Free, 0.01);
    world.set_environment(gravity());
    let body =
        MassProperties::from_central(7.0, vec3(0.1, 0.2, 0.0), Sym3::diagonal(1.0, 2.0, 2.5));
    let V = SpatialVelocity::from_array([0.2, 0.1, -0.3, 0.4, 0.0, 0.1]);
    let _ = world.add_body(&FreeBody::new(body, &Pose::identity(), &V));
    let mut ledger = world.open_ledger();
    let mass = world.robot().mass() + 7.0;
    let v_cm = ledger.start.linear * (1.0 / mass);
    world.command(&EFFORTS.map(Drive::Effort), Vec3::zero(), &ActuatorCommand::default(), 2.0);
    world.advance(2.0).unwrap();
    world.update_ledger(&mut ledger);
    let (t, given) = (2.0, ledger.sources[Source::Gravity]);
    let p = ledger.start.centre_of_mass;
    let fallen = v_cm * t + G * (0.5 * t * t);
    let turned = (p * t + v_cm * (0.5 * t * t)).cross(G * mass);
    assert!((given.linear - G * (mass * t)).norm() < 1e-11, "{:?}", given.linear);
    assert!((given.angular - turned).norm() < 1e-10, "{:?} {turned:?}", given.angular);
    assert!((given.work - mass * G.dot(fallen)).abs() < 1e-8, "{}", given.work);
    let [angular, linear, energy] = ledger.residuals();
    assert!(angular < 1e-10 && linear < 1e-11, "{angular:e} N·m·s, {linear:e} N·s");
    assert!(energy < 1e-8, "{energy:e} J");
}

/// Free space is no field of zero strength: nothing is asked and nothing booked.
#[test]
fn free_space_does_nothing_bit_for_bit() {
    let mut plain = world(moving(), BaseAttitude::Free, 0.01);
    plain.command(&EFFORTS.map(Drive::Effort), Vec3::zero(), &ActuatorCommand::default(), 2.0);
    plain.advance(2.0).unwrap();
    assert_eq!(flown(Environment::FreeSpace, 0.01).bits(), plain.bits());
    assert_eq!(Environment::default(), Environment::FreeSpace);
}

const LENGTH: f64 = 0.8;
const STRENGTH: f64 = 9.81;

/// A point mass of 1 kg on a rod, hanging from a base of 1e9 kg that is pushed up by what all weighs
/// together: so it stays where it is to within 1e-9 of the pendulum's motion. The period of the swing
/// from `angle` (rad), by four of them (s).
fn period(angle: f64) -> f64 {
    let base = MassProperties::from_central(1e9, Vec3::zero(), Sym3::diagonal(1e9, 1e9, 1e9));
    let bob = MassProperties::from_central(1.0, vec3(0.0, 0.0, -LENGTH), Sym3::zero());
    let axis = vec3(0.0, 1.0, 0.0);
    let hinge = Joint::new(BodyId::Base, JointKind::Revolute, Pose::identity(), axis);
    let robot: Robot<f64, 1> = Robot::new(base, &[(hinge, bob)]).unwrap();
    let start = State { q: [angle], ..State::default() };
    let mut world = OneSystem::new(&OneSystemSetup {
        robot: &robot,
        limits: &[],
        actuator: None,
        equipment: Equipment::default(),
        base: BaseAttitude::Held,
        stepper: Stepper::Fixed { step: 1e-3 },
        start,
        held: &[],
    });
    world
        .set_environment(Environment::UniformGravity { acceleration_N: vec3(0.0, 0.0, -STRENGTH) });
    let support = SpatialForce::new(Vec3::zero(), vec3(0.0, 0.0, STRENGTH * robot.mass()));
    let on_base = PerBody { base: support, links: [SpatialForce::zero()] };
    world.set_outside_wrench(Box::new(move |_, _| on_base), &[]);
    world.command(&[Drive::Effort(0.0)], Vec3::zero(), &ActuatorCommand::default(), 1e-3);
    let (mut crossings, mut before) = (vec![], angle);
    for _ in 0..30_000 {
        world.begin_period();
        world.advance(1e-3).unwrap();
        let (q, v) = (world.state().q[0], world.state().v[0]);
        if (q < 0.0) != (before < 0.0) {
            // At the lowest point nothing accelerates: the crossing is linear to the third order.
            crossings.push(world.time() - q / v);
        }
        before = q;
    }
    assert!(crossings.len() > 8, "it does not swing: {crossings:?}");
    (crossings[8] - crossings[0]) / 4.0
}

/// `2π √(l/g)`. Measured 6.2e-8 off it at a thousandth of a radian, as `θ²/16` says.
#[test]
fn a_pendulum_that_swings_little_has_the_textbook_period() {
    let textbook = TAU * (LENGTH / STRENGTH).sqrt();
    let off = period(1e-3) / textbook - 1.0;
    assert!((off - 1e-6 / 16.0).abs() < 1e-8, "{off:e}");
}

/// `4 √(l/g) K(sin θ/2)`, by the arithmetic-geometric mean of 1 and `cos θ/2`. Measured 5e-10, which is the
/// base's part.
#[test]
fn a_pendulum_that_swings_far_has_the_period_of_the_elliptic_integral() {
    for angle in [0.5, 1.5, 2.5] {
        let (mut a, mut b): (f64, f64) = (1.0, libm::cos(0.5 * angle));
        for _ in 0..8 {
            (a, b) = (0.5 * (a + b), (a * b).sqrt());
        }
        let exact = TAU * (LENGTH / STRENGTH).sqrt() / a;
        let off = period(angle) / exact - 1.0;
        assert!(off.abs() < 1e-8, "{angle} rad: {off:e}");
    }
}
