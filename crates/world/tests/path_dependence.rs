//! A floating base remembers the way the joints went: closed loops turn it, the way back turns it
//! back, and motions in the reaction null space do not turn it at all.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

mod atlas_class;

use atlas_class::{J, SIDEWAYS_300MM_DEG, cube, tool, unladen};
use wrasse_dynamics::{State, kinematics, mass_matrix, reaction_null_space};
use wrasse_hardware::{ActuatorCommand, SetPoint, SetPointMotion};
use wrasse_spatial::{Pose, Quat, Vec3};
use wrasse_world::{BaseAttitude, Drive, Equipment, Stepper};
use wrasse_world_testing::{OneSystem, OneSystemSetup};

/// A floating servicer with 500 kg, at rest.
fn at_rest() -> OneSystem<J> {
    let robot = unladen();
    let start = State { q: SIDEWAYS_300MM_DEG.map(f64::to_radians), ..State::default() };
    OneSystem::new(&OneSystemSetup {
        robot: &robot,
        limits: &[],
        actuator: None,
        equipment: Equipment::default(),
        base: BaseAttitude::Free,
        stepper: Stepper::Fixed { step: 0.005 },
        start,
        held: &[(tool(), cube(500.0))],
    })
}

/// Lead the joints through set-points, `period` (s) apart.
fn lead(world: &mut OneSystem<J>, period: f64, set_points: &[[SetPoint<f64>; J]]) {
    for pair in set_points.windows(2) {
        let drives: [Drive; J] = std::array::from_fn(|j| {
            Drive::Follow(SetPointMotion::between(pair[0][j], pair[1][j], period))
        });
        world.command(&drives, Vec3::zero(), &ActuatorCommand::default(), period);
        world.advance(period).expect("it stays finite");
    }
}

/// Turn of the base since the start (rad).
fn turned(world: &OneSystem<J>) -> f64 {
    Quat::from_matrix(&world.state().X_NB.rotation).log().norm()
}

/// Set-points of a circle of two joints with radius `A` (rad), from rest to rest in 10 s.
fn circle(joints: (usize, usize), A: f64, forward: bool) -> Vec<[SetPoint<f64>; J]> {
    let steps = 1000;
    let start = SIDEWAYS_300MM_DEG.map(f64::to_radians);
    (0..=steps)
        .map(|i| {
            // Phase by a quintic: φ = 2π (10 s³ - 15 s⁴ + 6 s⁵).
            let s = f64::from(i) / f64::from(steps);
            let sign = if forward { 1.0 } else { -1.0 };
            let full = sign * std::f64::consts::TAU;
            let phi = full * s.powi(3) * (10.0 - 15.0 * s + 6.0 * s * s);
            let rate = full * 3.0 * s * s * (1.0 - s).powi(2);
            let bend = full * 0.6 * s * (1.0 - s) * (1.0 - 2.0 * s);
            let (sin, cos) = phi.sin_cos();
            let mut at = start.map(|position| SetPoint { position, ..SetPoint::default() });
            at[joints.0].position += A * (1.0 - cos);
            at[joints.0].rate = A * sin * rate;
            at[joints.0].acceleration = A * (sin * bend + cos * rate * rate);
            at[joints.1].position += A * sin;
            at[joints.1].rate = A * cos * rate;
            at[joints.1].acceleration = A * (cos * bend - sin * rate * rate);
            at
        })
        .collect()
}

/// Net turn of a closed loop, after the joints are back where they were.
fn net_turn(joints: (usize, usize), A: f64) -> f64 {
    let mut world = at_rest();
    lead(&mut world, 0.01, &circle(joints, A, true));
    turned(&world)
}

/// The net turn goes as the area of the loop. Measured: slopes 2.014, 2.007, 2.005; the larger circles
/// turn the base by 0.07, 0.07 and 0.28 deg.
#[test]
fn closed_loops_of_the_joints_turn_the_base_by_their_area() {
    for joints in [(0, 1), (0, 3), (2, 3)] {
        let (small, large) = (net_turn(joints, 0.05), net_turn(joints, 0.1));
        let slope = (large / small).log2();
        assert!((slope - 2.0).abs() < 0.05, "{joints:?}: {slope}");
        assert!(large > 1e-3, "{joints:?}: {large} rad");
    }
}

/// Measured: 3.6e-16 rad, after a turn of 0.011 rad.
#[test]
fn a_loop_gone_backwards_turns_the_base_back() {
    let mut world = at_rest();
    lead(&mut world, 0.01, &circle((0, 1), 0.3, true));
    let there = turned(&world);
    lead(&mut world, 0.01, &circle((0, 1), 0.3, false));
    assert!(there > 0.01, "{there}");
    assert!(turned(&world) < 1e-14, "{:e}", turned(&world));
}

/// Joint rates without angular momentum, integrated by themselves: the base knows nothing of it.
/// Measured: the base turns by 7e-14 deg while the tool goes 0.24 m.
#[test]
fn a_motion_in_the_reaction_null_space_leaves_the_attitude_alone() {
    let mut world = at_rest();
    let robot = *world.robot();
    let wish = [0.3, -0.2, 0.4, 0.25, -0.3, 0.2, 0.1];
    let rates = |q: &[f64; J]| {
        let still = State { q: *q, ..State::default() };
        reaction_null_space(&robot, &mass_matrix(&kinematics(&robot, &still)), &wish)
    };
    let moved = |q: &[f64; J], v: &[f64; J], h: f64| -> [f64; J] {
        std::array::from_fn(|j| q[j] + v[j] * h)
    };
    let (h, mut q) = (1e-3, world.state().q);
    let mut set_points = vec![];
    for _ in 0..=4000 {
        let v = rates(&q);
        // How the rates change along the motion, by central differences.
        let (before, after) = (rates(&moved(&q, &v, -1e-5)), rates(&moved(&q, &v, 1e-5)));
        set_points.push(std::array::from_fn(|j| SetPoint {
            position: q[j],
            rate: v[j],
            acceleration: (after[j] - before[j]) / 2e-5,
        }));
        let k2 = rates(&moved(&q, &v, 0.5 * h));
        let k3 = rates(&moved(&q, &k2, 0.5 * h));
        let k4 = rates(&moved(&q, &k3, h));
        q = std::array::from_fn(|j| q[j] + h / 6.0 * (v[j] + 2.0 * k2[j] + 2.0 * k3[j] + k4[j]));
    }
    let tip = |world: &OneSystem<J>| world.pose(&tool()).translation;
    let start = tip(&world);
    let X_start: Pose<f64> = world.state().X_NB;
    lead(&mut world, h, &set_points);
    let way = (tip(&world) - start).norm();
    assert_eq!(X_start.rotation, Pose::<f64>::identity().rotation);
    assert!(way > 0.2, "{way}");
    assert!(turned(&world).to_degrees() < 1e-11, "{:e} deg", turned(&world).to_degrees());
}
