//! Gears: joints that follow others (accelerations, momentum, energy, jumps), and rotors behind them.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

mod branched;

use branched::{J, grip, load, moving, robot, world};
use nalgebra::{SMatrix, SVector};
use wrasse_dynamics::{BodyId, MassProperties, Robot, State, bias_force, kinematics, mass_matrix};
use wrasse_hardware::{ActuatorCommand, Follower, SetPoint, SetPointMotion};
use wrasse_spatial::{SpatialVelocity, Vec3};
use wrasse_testing::largest;
use wrasse_world::{BaseAttitude, Drive, Equipment, FreeBody, GripOffset, Source, Stepper};
use wrasse_world_testing::{OneSystem, OneSystemSetup};

/// The second joint slides as the first turns, the fourth turns against the third.
fn followers() -> [Follower<f64>; 2] {
    [
        Follower { joint: 1, leader: 0, ratio: 0.2, offset: 0.05 },
        Follower { joint: 3, leader: 2, ratio: -1.5, offset: -0.1 },
    ]
}

fn geared(base: BaseAttitude, step: f64) -> OneSystem<J> {
    let mut world = world(moving(), base, step);
    let id = world.id;
    world.set_followers(id, &followers());
    world
}

fn drive(world: &mut OneSystem<J>, efforts: [f64; 2], period: f64) {
    let [a, b] = efforts;
    // What is asked of a follower is not given: it has no drive.
    let drives = [a, 7.0, b, -9.0].map(Drive::Effort);
    world.command(&drives, Vec3::zero(), &ActuatorCommand::default(), period);
}

/// How far the joints are from where and how fast their leaders have them.
fn off(state: &State<f64, J>) -> f64 {
    let each = followers().map(|Follower { joint, leader, ratio, offset }| {
        let q = state.q[joint] - (ratio * state.q[leader] + offset);
        q.abs().max((state.v[joint] - ratio * state.v[leader]).abs())
    });
    largest(each)
}

/// The equations of motion in the coordinates that are left: `Gᵀ M G ẍ = Gᵀ (τ - c)`, with `ν = G x` and
/// `G` the same at all times.
#[test]
fn accelerations_are_those_of_the_coordinates_that_are_left() {
    for (efforts, bound) in [([0.9, -0.7], 1e-13), ([0.0, 0.0], 1e-13)] {
        let mut world = geared(BaseAttitude::Free, 0.01);
        drive(&mut world, efforts, 0.01);
        let state = world.state();
        let (found, robot) = (world.dynamics(), robot());
        let k = kinematics(&robot, &state);
        let (M, c) = (mass_matrix(&k), bias_force(&k));
        let M = SMatrix::<f64, 10, 10>::from_fn(|i, k| M.element(i, k));
        let mut G = SMatrix::<f64, 10, 8>::zeros();
        for i in 0..6 {
            G[(i, i)] = 1.0;
        }
        (G[(6, 6)], G[(8, 7)]) = (1.0, 1.0);
        (G[(7, 6)], G[(9, 7)]) = (0.2, -1.5);
        let c = SVector::<f64, 10>::from_iterator(c.base.to_array().into_iter().chain(c.joints));
        let mut tau = SVector::<f64, 10>::zeros();
        (tau[6], tau[8]) = (efforts[0], efforts[1]);
        let reduced = (G.transpose() * M * G).cholesky().expect("positive definite");
        let expected = G * reduced.solve(&(G.transpose() * (tau - c)));
        let nudot = found.nudot.base.to_array().into_iter().chain(found.nudot.joints);
        let off = largest(nudot.zip(expected.iter()).map(|(a, b)| a - b));
        assert!(off < bound, "of accelerations up to 1; measured 1.1e-15: {off:e}");
        // The motors: leaders give what they are told, followers nothing.
        let motors = [efforts[0], 0.0, efforts[1], 0.0];
        let off = largest(found.force.joints.iter().zip(motors).map(|(a, b)| a - b));
        assert!(off < 1e-13, "measured 4.4e-16: {off:e}");
    }
}

#[test]
fn followers_stay_with_their_leaders_and_neither_momentum_nor_energy_is_lost_in_the_gears() {
    let mut world = geared(BaseAttitude::Free, 0.01);
    assert!(off(&world.state()) < 1e-15, "they were brought there");
    let mut ledger = world.open_ledger();
    for k in 0..200 {
        drive(&mut world, [0.4 * (0.1 * f64::from(k)).sin(), -0.3], 0.01);
        world.advance(0.01).expect("finite");
        assert!(off(&world.state()) < 1e-15);
    }
    world.update_ledger(&mut ledger);
    let [angular, linear, energy] = ledger.worst;
    assert!(
        angular < 4e-14 && linear < 2e-14,
        "measured 4.1e-15 and 1.8e-15: {angular:e} {linear:e}"
    );
    assert!(energy < 4e-11, "of the integration; measured 3.4e-12 J: {energy:e}");
    let work = ledger.sources[Source::JointDrives].work;
    assert!(work.abs() > 0.05, "{work} J");
}

/// Where the leader follows set-points, so does the follower, and the leader's drive takes both.
#[test]
fn a_leader_on_set_points_takes_its_followers_along() {
    let mut world = geared(BaseAttitude::Free, 0.01);
    let from = world.state();
    let point =
        |j: usize, t: f64| SetPoint { position: from.q[j] + 0.2 * t, rate: 0.2, acceleration: 0.0 };
    let way = |j: usize| Drive::Follow(SetPointMotion::between(point(j, 0.0), point(j, 0.1), 0.1));
    let drives = [way(0), Drive::Effort(5.0), way(2), Drive::Effort(5.0)];
    world.command(&drives, Vec3::zero(), &ActuatorCommand::default(), 0.1);
    let mut ledger = world.open_ledger();
    for _ in 0..10 {
        world.advance(0.01).expect("finite");
    }
    world.update_ledger(&mut ledger);
    let state = world.state();
    assert!(off(&state) < 1e-15);
    assert!((state.q[0] - from.q[0] - 0.02).abs() < 1e-14, "{}", state.q[0]);
    let force = world.dynamics().force.joints;
    assert_eq!((force[1], force[3]), (0.0, 0.0), "followers have no drive");
    assert!(ledger.worst[2] < 1e-13, "measured 8.1e-15 J: {:e}", ledger.worst[2]);
}

/// A grasp: rates jump, and still follow; momentum stays.
#[test]
fn rates_that_jump_still_follow() {
    let mut world = geared(BaseAttitude::Free, 0.01);
    drive(&mut world, [0.3, 0.2], 0.01);
    let X_NT = world.pose(&grip());
    let moving = SpatialVelocity::from_array([0.1, -0.2, 0.1, 0.05, 0.1, -0.1]);
    let body = world.add_body(&FreeBody::new(load(), &X_NT, &moving));
    let mut ledger = world.open_ledger();
    let most = GripOffset { distance: 1e-6, angle: 1e-6, angular_speed: 9.0, linear_speed: 9.0 };
    let before = world.state();
    world.grasp(&grip(), body, &most).expect("it lies in the grip");
    let after = world.state();
    assert!((after.v[0] - before.v[0]).abs() > 1e-3, "the grasp is felt");
    assert!(off(&after) < 1e-15, "measured 0: {:e}", off(&after));
    world.update_ledger(&mut ledger);
    let [angular, linear, energy] = ledger.worst;
    assert!(largest([angular, linear, energy]) < 4e-14, "measured 4.1e-15: {:?}", ledger.worst);
}

/// Rotors behind gears have energy and no momentum: both stay on a coast, and the joints swing slower.
#[test]
fn a_coast_with_rotors_keeps_energy_and_momentum() {
    let bare = robot();
    let matter = |body| MassProperties {
        M_F_F: *bare.inertia(body),
        I_parts_F: *bare.inertia_of_parts(body),
    };
    let links: Vec<_> = (0..J)
        .map(|j| (bare.joint(j).with_rotor([2.0, 5.0, 0.5, 1.0][j]), matter(BodyId::Link(j))))
        .collect();
    let geared = Robot::new(matter(BodyId::Base), &links).expect("the same tree");
    let mut world = OneSystem::new(&OneSystemSetup {
        robot: &geared,
        limits: &[],
        actuator: None,
        equipment: Equipment::default(),
        base: BaseAttitude::Free,
        stepper: Stepper::Fixed { step: 0.01 },
        start: moving(),
        held: &[],
    });
    let mut ledger = world.open_ledger();
    let rotors = 0.5 * (0..J).map(|j| [2.0, 5.0, 0.5, 1.0][j] * moving().v[j].powi(2)).sum::<f64>();
    assert!(ledger.start.energy > rotors, "they have {rotors} J of it");
    let coast = [Drive::Effort(0.0); J];
    world.command(&coast, Vec3::zero(), &ActuatorCommand::default(), 2.0);
    world.advance(2.0).expect("finite");
    world.update_ledger(&mut ledger);
    let [angular, linear, energy] = ledger.worst;
    assert!(angular < 1e-13 && linear < 1e-13, "{angular:e} {linear:e}");
    assert!(energy < 1e-9, "of the integration: {energy:e}");
}
