//! Links abreast in registers of any width, one by one, and vehicles side by side: the same bits. One
//! test alone: the level is the program's.
#![allow(clippy::unwrap_used, reason = "a test that unwraps nothing fails")]
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

use std::array;
use wrasse_dynamics::{
    BaseMode, Generalized, JointDrive, PerBody, Robot, State, driven_dynamics, forward_dynamics,
    forward_dynamics_derivatives, generalized_jacobian, inverse_dynamics, jacobian, kinematics,
    mass_matrix, momentum_matrix,
};
use wrasse_spatial::{Lanes, Level, Pose, Real, SideBySide, SpatialForce, SpatialVelocity};
use wrasse_testing::random_robot::{JOINTS, Recipe, Scene};

/// What is worked out, number by number.
fn numbers<T: Real>(
    robot: &Robot<T, JOINTS>,
    state: &State<T, JOINTS>,
    nudot: &Generalized<SpatialVelocity<T>, T, JOINTS>,
    external: &PerBody<SpatialForce<T>, JOINTS>,
    frame: &wrasse_dynamics::Frame<T>,
) -> Vec<T> {
    let k = kinematics(robot, state);
    let (M, J_frame) = (mass_matrix(&k), jacobian(&k, frame));
    let inverse = inverse_dynamics(&k, nudot, external).force;
    let base = SpatialForce::new(nudot.base.angular, nudot.base.linear);
    let force = Generalized { base, joints: nudot.joints };
    let forward = forward_dynamics(&k, &force, external);
    let drives = array::from_fn(|j| match j % 3 {
        0 => JointDrive::Acceleration(nudot.joints[j]),
        _ => JointDrive::Effort(nudot.joints[j]),
    });
    let held = driven_dynamics(&k, &drives, BaseMode::AttitudeHeld, external);
    let changes = forward_dynamics_derivatives(&k, &force, external);
    let A = momentum_matrix(&M, &state.X_NB.rotation).joints;
    let free = generalized_jacobian(&J_frame, &M);
    let mut all = vec![M.M_bb.mass];
    all.extend(M.M_jj.as_flattened());
    all.extend(M.M_bj.columns().iter().chain(&A.columns()).flat_map(|h| h.to_array()));
    all.extend(free.columns().iter().flat_map(|V| V.to_array()));
    all.extend(inverse.base.to_array().iter().chain(&inverse.joints));
    all.extend(forward.base.to_array().iter().chain(&forward.joints));
    all.extend(held.nudot.joints.iter().chain(&held.force.joints));
    all.extend(changes.by_position.joints.as_flattened());
    all
}

/// Bits of a number; places of links that are not there hold zeros of either sign.
fn bits_of(x: f64) -> u64 {
    (x + 0.0).to_bits()
}

/// The bits of a scene's numbers, worked with numbers of one kind.
fn bits(scene: &Scene) -> Vec<u64> {
    let Scene { robot, state, nudot, external, frame, .. } = scene;
    numbers(robot, state, nudot, external, frame).into_iter().map(bits_of).collect()
}

/// The same with the scene in the second of two lanes, another one beside it.
fn bits_in_a_lane(scene: &Scene, beside: &Scene) -> Vec<u64> {
    type L = Lanes<2>;
    let both = [beside, scene];
    let nudot = Generalized {
        base: SideBySide::<2>::side_by_side(&|i| both[i].nudot.base),
        joints: SideBySide::<2>::side_by_side(&|i| both[i].nudot.joints),
    };
    let external = PerBody {
        base: SideBySide::<2>::side_by_side(&|i| both[i].external.base),
        links: SideBySide::<2>::side_by_side(&|i| both[i].external.links),
    };
    let frame = wrasse_dynamics::Frame {
        body: scene.frame.body,
        X_BF: Pose::<L>::from_f64(&scene.frame.X_BF),
    };
    let state = SideBySide::<2>::side_by_side(&|i| both[i].state);
    let robot: Robot<L, JOINTS> = scene.robot.cast();
    numbers(&robot, &state, &nudot, &external, &frame).iter().map(|x| bits_of(x.lane(1))).collect()
}

#[test]
fn every_level_gives_the_same_bits_as_links_one_by_one() {
    for seed in 0..60 {
        let recipe = |seed| Recipe {
            seed,
            joints: 1 + usize::try_from(seed).unwrap() % JOINTS,
            arms: 1 + usize::try_from(seed).unwrap() % 3,
            sliding: if seed % 4 == 0 { 0.0 } else { 0.3 },
            branching: if seed % 2 == 0 { 0.0 } else { 0.3 },
        };
        let of_arms = |recipe: Recipe| Recipe { arms: recipe.arms.min(recipe.joints), ..recipe };
        let (scene, mut beside) =
            (Scene::new(&of_arms(recipe(seed))), Scene::new(&of_arms(recipe(seed))));
        beside.state.q = beside.state.q.map(|q| 0.7 - q);
        let alone = bits_in_a_lane(&scene, &beside);
        assert!(alone.len() > 400 && alone.iter().filter(|x| **x != 0).count() > 20);
        for level in Level::ALL.into_iter().filter(|level| level.is_available()) {
            level.restrict();
            assert_eq!(bits(&scene), alone, "{level:?}, seed {seed}");
        }
    }
}
