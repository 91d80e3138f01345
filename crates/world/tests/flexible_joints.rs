//! Joints with springs, and driven joints whose transmission gives.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]
#![allow(clippy::unwrap_used, reason = "a test may stop where it finds nothing")]

mod branched;

use branched::{J, robot};
use nalgebra::{DMatrix, SymmetricEigen};
use wrasse_dynamics::{Generalized, State, free_floating_dynamics, kinematics, mass_matrix};
use wrasse_hardware::ActuatorCommand;
use wrasse_spatial::{SpatialForce, Vec3};
use wrasse_world::{
    BaseAttitude, Drive, Equipment, FlexibleJoint, FlexibleJoints, JointSpring, PassiveJoints,
    Source, Stepper,
};
use wrasse_world_testing::{OneSystem, OneSystemSetup};

const Q: [f64; J] = [0.3, -0.2, 0.4, 0.1];

fn at_rest() -> State<f64, J> {
    State { q: Q, ..State::default() }
}

fn world(start: State<f64, J>, step: f64) -> OneSystem<J> {
    OneSystem::new(&OneSystemSetup {
        robot: &robot(),
        limits: &[],
        actuator: None,
        equipment: Equipment::default(),
        base: BaseAttitude::Free,
        stepper: Stepper::Fixed { step },
        start,
        held: &[],
    })
}

fn springs(stiffness: f64, damping: f64) -> PassiveJoints {
    let spring = |joint| JointSpring { joint, stiffness, damping, rest: Q[joint] };
    PassiveJoints((0..J).map(spring).collect())
}

/// `H*` of the free-floating vehicle at rest.
fn reduced_inertia() -> DMatrix<f64> {
    let (robot, state) = (robot(), at_rest());
    let M = mass_matrix(&kinematics(&robot, &state));
    let none = Generalized { base: SpatialForce::zero(), joints: [0.0; J] };
    let H = free_floating_dynamics(&robot, &M, &none).H;
    DMatrix::from_fn(J, J, |i, j| H[i][j])
}

/// Squares of the eigenfrequencies of `A ẍ + K x = 0`, in order.
fn eigenvalues(A: &DMatrix<f64>, K: &DMatrix<f64>) -> Vec<f64> {
    let L = A.clone().cholesky().unwrap().l();
    let L_inverse = L.try_inverse().unwrap();
    let mut all: Vec<f64> = SymmetricEigen::new(&L_inverse * K * L_inverse.transpose())
        .eigenvalues
        .iter()
        .copied()
        .collect();
    all.sort_by(f64::total_cmp);
    all
}

/// Accelerations that a small deflection `x` of all variables causes, per deflection: the stiffness of
/// what is simulated over its inertia. Central differences of a linear force: the size is taken so small
/// that velocity products are gone, and rounding is 1e-16 over 1e-4.
fn simulated(setup: impl Fn(&[f64]) -> Vec<f64>, count: usize) -> DMatrix<f64> {
    let h = 1e-4;
    let column = |c: usize| {
        let at = |size: f64| {
            let mut x = vec![0.0; count];
            x[c] = size;
            setup(&x)
        };
        let (plus, minus) = (at(h), at(-h));
        plus.into_iter().zip(minus).map(|(a, b)| -(a - b) / (2.0 * h)).collect::<Vec<_>>()
    };
    let columns: Vec<_> = (0..count).map(column).collect();
    DMatrix::from_fn(count, count, |r, c| columns[c][r])
}

/// Passive joints on a base that nothing holds: eigenfrequencies of `{H*, K}`. Measured 2e-13 of the
/// largest.
#[test]
fn sprung_joints_swing_at_the_eigenfrequencies_of_the_free_floating_vehicle() {
    let K = 50.0;
    let accelerations = |x: &[f64]| {
        // H* changes with the posture: the spring is moved, not the joint.
        let mut moved = springs(K, 0.0);
        moved.0.iter_mut().zip(x).for_each(|(spring, x)| spring.rest -= x);
        let mut world = world(at_rest(), 0.01);
        let id = world.id;
        world.add_effector(id, Box::new(moved));
        world.dynamics().nudot.joints.to_vec()
    };
    let found = simulated(accelerations, J);
    let mut found: Vec<f64> = found.complex_eigenvalues().iter().map(|e| e.re).collect();
    found.sort_by(f64::total_cmp);
    let expected = eigenvalues(&reduced_inertia(), &(DMatrix::identity(J, J) * K));
    for (a, b) in found.iter().zip(&expected) {
        assert!((a - b).abs() < 1e-10 * expected[J - 1], "{found:?} {expected:?}");
    }
}

/// Motors behind springs: eigenfrequencies of `{H*, B, K}`, four of them zero. From the rates of all
/// variables in the scene. Measured 3e-13 of the largest.
#[test]
fn flexible_joints_swing_at_the_eigenfrequencies_of_spong() {
    let (K, B) = (2000.0, 0.7);
    let H = reduced_inertia();
    let mut A = DMatrix::zeros(2 * J, 2 * J);
    let mut stiffness = DMatrix::zeros(2 * J, 2 * J);
    for i in 0..J {
        for j in 0..J {
            A[(i, j)] = H[(i, j)];
        }
        A[(J + i, J + i)] = B;
        for (r, c, sign) in [(i, i, 1.0), (i, J + i, -1.0), (J + i, i, -1.0), (J + i, J + i, 1.0)] {
            stiffness[(r, c)] += sign * K;
        }
    }
    let expected = eigenvalues(&A, &stiffness);
    let accelerations = |x: &[f64]| {
        let flexible =
            |joint| FlexibleJoint { joint, stiffness: K, damping: 0.0, motor_inertia: B };
        let mut world = world(at_rest(), 0.01);
        let id = world.id;
        world.add_effector(id, Box::new(FlexibleJoints((0..J).map(flexible).collect())));
        let twists: Vec<f64> = (0..J).map(|j| x[J + j] - x[j]).collect();
        let own: Vec<f64> = twists.iter().flat_map(|twist| [*twist, 0.0]).collect();
        world.set_effector_variables(id, 0, &own);
        let motors = twists.iter().map(|twist| -K * twist / B);
        world.dynamics().nudot.joints.into_iter().chain(motors).collect()
    };
    let found = simulated(accelerations, 2 * J);
    let mut found: Vec<f64> = found.complex_eigenvalues().iter().map(|e| e.re).collect();
    found.sort_by(f64::total_cmp);
    for (a, b) in found.iter().zip(&expected) {
        assert!((a - b).abs() < 1e-10 * expected[2 * J - 1], "{found:?} {expected:?}");
    }
    assert!(expected[..J].iter().all(|e| e.abs() < 1e-9 * expected[2 * J - 1]));
}

/// A torque turns the motor, and reaches the link through the transmission alone.
#[test]
fn a_torque_reaches_the_link_through_the_transmission_alone() {
    let still = at_rest();
    let accelerations = |effort: f64, twist: f64| {
        let flexible =
            |joint| FlexibleJoint { joint, stiffness: 300.0, damping: 0.0, motor_inertia: 0.5 };
        let mut world = world(still, 0.001);
        let id = world.id;
        world.add_effector(id, Box::new(FlexibleJoints((0..J).map(flexible).collect())));
        let own: Vec<f64> = (0..J).flat_map(|_| [twist, 0.0]).collect();
        world.set_effector_variables(id, 0, &own);
        let drives = [Drive::Effort(effort); J];
        world.command(&drives, Vec3::zero(), &ActuatorCommand::default(), 0.001);
        let now = world.dynamics().nudot.joints;
        world.advance(0.001).unwrap();
        (now, world.effector_variables(id, 0)[1])
    };
    // Nothing is twisted: the links feel nothing, the motor gains 2/0.5 rad/s².
    let (links, motor) = accelerations(2.0, 0.0);
    assert_eq!(links, [0.0; J]);
    assert!((motor - 2.0 / 0.5 * 0.001).abs() < 1e-6, "{motor}");
    // Twisted, the links feel the spring, whatever the torque.
    assert_eq!(accelerations(2.0, 0.01).0, accelerations(-5.0, 0.01).0);
    assert!(accelerations(0.0, 0.01).0.iter().any(|x| x.abs() > 0.01));
}

/// A sprung panel gives its energy back and forth; with a damper it comes to rest. The ledger closes.
#[test]
fn springs_and_dampers_are_in_the_ledger() {
    let start = State { q: Q.map(|q| q + 0.2), ..at_rest() };
    let mut world = world(start, 0.002);
    let id = world.id;
    world.add_effector(id, Box::new(springs(50.0, 2.0)));
    let mut ledger = world.open_ledger();
    let efforts = [Drive::Effort(0.0); J];
    for _ in 0..400 {
        world.command(&efforts, Vec3::zero(), &ActuatorCommand::default(), 0.05);
        world.advance(0.05).unwrap();
        world.update_ledger(&mut ledger);
    }
    let [angular, linear, energy] = ledger.worst;
    assert!(angular < 1e-12 && linear < 1e-12, "{angular:e} {linear:e}");
    assert!(energy < 1e-6 * ledger.scale[2], "{energy:e} J of {}", ledger.scale[2]);
    assert!(ledger.scale[2] > 0.1, "{} J", ledger.scale[2]);
    let work = ledger.sources[Source::JointSprings].work;
    assert!(
        (ledger.now.energy - work).abs() < 1e-6 * ledger.scale[2],
        "all energy is the springs'"
    );
    assert!(ledger.now.energy < 1e-3 * ledger.scale[2], "{} J", ledger.now.energy);
}
