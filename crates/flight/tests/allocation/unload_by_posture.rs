//! Momentum management by posture: hand checks, momentum summed over the bodies, finite differences,
//! and the cases in which there is no relief.

use wrasse_dynamics::{
    BodyId, Frame, GeneralizedVelocity, PerBody, Robot, State, attitude_held_jacobian,
    attitude_torque, base_twist, inverse_dynamics, jacobian, kinematics, mass_matrix, momentum,
};
use wrasse_flight::allocation::{
    NoPostureUnloading, PostureUnloading, PostureUnloadingUse, ToolTask, momentum_rate,
    unload_by_posture,
};
use wrasse_spatial::{At, Mat3, Pose, SpatialForce, SpatialMomentum, Vec3, vec3};
use wrasse_testing::Page;
use wrasse_testing::arms::atlas_class;
use wrasse_testing::larger;
use wrasse_testing::random_robot::Random;

/// A posture with shoulder, elbow and wrist well bent.
const BENT: [f64; 7] = [0.3, 0.7, -0.4, 1.1, 0.2, -0.8, 0.5];

fn at(q: [f64; 7]) -> State<f64, 7> {
    State { X_NB: Pose::identity(), q, ..State::default() }
}

fn push(force: Vec3<f64>) -> SpatialForce<f64> {
    SpatialForce::new(Vec3::zero(), force)
}

/// 0.2 rad/s for every joint: a slow arm.
fn slowly(task: ToolTask) -> PostureUnloadingUse<f64, 7> {
    PostureUnloadingUse { task, gain: 0.05, rate_limit: [0.2; 7] }
}

fn demand(
    robot: &Robot<f64, 7>,
    tool: &Frame<f64>,
    state: &State<f64, 7>,
    F: &SpatialForce<f64>,
) -> Vec3<f64> {
    momentum_rate(&kinematics(robot, state), tool, F)
}

fn relief(
    state: &State<f64, 7>,
    F: &SpatialForce<f64>,
    task: ToolTask,
) -> Result<PostureUnloading<f64, 7>, NoPostureUnloading<f64>> {
    let (robot, tool) = atlas_class();
    unload_by_posture(&kinematics(&robot, state), &tool, F, &slowly(task))
}

/// The state with the base moved as it answers these joint rates, momentum zero, base not turned.
fn sliding(robot: &Robot<f64, 7>, state: &State<f64, 7>, qdot: [f64; 7]) -> State<f64, 7> {
    let M = mass_matrix(&kinematics(robot, state));
    let V_NB_B = base_twist(&M, &SpatialMomentum::zero(), &qdot);
    State { V_NB_B, v: qdot, ..*state }
}

fn random_wrench(random: &mut Random) -> SpatialForce<f64> {
    SpatialForce::new(random.vector(20.0), random.vector(200.0))
}

/// 200 N along x at the straight arm of the offset mount: the tool is 0.5 m off, the centre of mass
/// 56·0.5/1556 m, so the base must store 200·0.5·1500/1556 N·m about -z. Measured: no difference.
#[test]
fn the_demand_is_force_times_lever_by_hand() {
    let (robot, tool) = atlas_class();
    let found = demand(&robot, &tool, &at([0.0; 7]), &push(vec3(200.0, 0.0, 0.0)));
    let by_hand = vec3(0.0, 0.0, -100.0 * 1500.0 / 1556.0);
    assert!((found - by_hand).norm() < 1e-12, "{found:?}");
}

/// The attitude torque of inverse dynamics, with the force pushing the whole vehicle along, is the
/// opposite of the demand. Round-off: measured 4e-13 of 200 N·m.
#[test]
fn the_demand_is_what_inverse_dynamics_asks_of_the_attitude_control() {
    let ((robot, tool), mut random) = (atlas_class(), Random(20_040_901));
    for _ in 0..50 {
        let q = [(); 7].map(|()| random.within(2.0));
        let state = State { X_NB: random.pose(3.0), ..at(q) };
        let (k, F) = (kinematics(&robot, &state), random_wrench(&mut random));
        // The wrench at the body's origin, in its axes.
        let X_NE = k.X_NB(tool.body);
        let at_body = F.about(X_NE.translation - k.pose(&tool).translation);
        let turned = |v: Vec3<f64>| X_NE.rotation.transpose_mul(v);
        let mut external = PerBody::filled(SpatialForce::zero());
        external[tool.body] = SpatialForce::new(turned(at_body.torque), turned(at_body.force));
        let mut nudot = GeneralizedVelocity::<f64, 7>::default();
        let per_mass = 1.0 / robot.mass();
        nudot.base.linear = state.X_NB.rotation.transpose_mul(F.force) * per_mass;
        let torque = attitude_torque(&k, &inverse_dynamics(&k, &nudot, &external));
        let off = (torque + momentum_rate(&k, &tool, &F)).norm();
        assert!(off < 1e-11, "{off}");
    }
}

/// The motion carries no angular momentum, summed body by body, and the free base does not turn.
/// Round-off: measured 1e-15.
#[test]
fn the_relief_does_not_turn_the_base() {
    let ((robot, _), mut random) = (atlas_class(), Random(7));
    let mut found = 0;
    for task in [ToolTask::Free, ToolTask::Orientation] {
        for _ in 0..50 {
            let q = [(); 7].map(|()| random.within(2.0));
            let state = State { X_NB: random.pose(3.0), ..at(q) };
            if let Ok(relief) = relief(&state, &random_wrench(&mut random), task) {
                let moving = sliding(&robot, &state, relief.qdot);
                let h = momentum(&kinematics(&robot, &moving));
                let off = larger(moving.V_NB_B.angular.norm(), h.angular.norm());
                assert!(off < 3e-14, "{off:e}");
                found += 1;
            }
        }
    }
    assert!(found > 80, "{found} motions of 100");
}

/// The demand changes as predicted, by finite difference, and towards the least at the wanted gain
/// where no limit is met (in half of the cases; round-off, measured 7e-15). Step 1e-5 s: measured 2e-8 N·m/s of 4.
#[test]
fn the_demand_falls_as_predicted() {
    let ((robot, tool), mut random) = (atlas_class(), Random(11));
    let step = 1e-5;
    for task in [ToolTask::Free, ToolTask::Orientation] {
        for _ in 0..50 {
            let q = [(); 7].map(|()| random.within(2.0));
            let state = State { X_NB: random.pose(3.0), ..at(q) };
            let F = random_wrench(&mut random);
            let Ok(relief) = relief(&state, &F, task) else { continue };
            let along = |t: f64| {
                let moved = std::array::from_fn(|j| q[j] + t * relief.qdot[j]);
                demand(&robot, &tool, &State { q: moved, ..state }, &F)
            };
            let slope = (along(step) - along(-step)) * (0.5 / step);
            let off = (slope - relief.demand_rate_N).norm();
            let falls = relief.demand_N.dot(relief.demand_rate_N);
            let beyond = relief.demand_N.norm().powi(2) - relief.least.powi(2);
            assert!(off < 1e-6, "{off}");
            let gain = -falls / beyond;
            assert!(gain > 0.05 * 1e-3 && gain < 0.05 * (1.0 + 1e-9), "{gain}");
            let limited = relief.qdot.iter().any(|rate| rate.abs() > 0.2 * (1.0 - 1e-9));
            assert!(limited || (gain / 0.05 - 1.0).abs() < 1e-9, "{gain}");
        }
    }
}

/// 200 N for a minute: the demand falls from 272 N·m to 14 with the tool free, and to 62 with its
/// orientation held, where the one motion that is left leads no further. The orientation is held to the
/// error of steps of 0.05 s: measured 0.03 over its three rows.
#[test]
fn a_whole_motion_lowers_the_demand() {
    let ((robot, tool), F) = (atlas_class(), push(vec3(0.0, 0.0, 200.0)));
    let mut demands = vec![demand(&robot, &tool, &at(BENT), &F).norm()];
    for (task, below) in [(ToolTask::Free, 0.06), (ToolTask::Orientation, 0.25)] {
        let (mut state, step) = (at(BENT), 0.05);
        let before = kinematics(&robot, &state).pose(&tool);
        let first = demand(&robot, &tool, &state, &F).norm();
        let mut end = None;
        for _ in 0..1200 {
            match relief(&state, &F, task) {
                Ok(relief) => (0..7).for_each(|j| state.q[j] += step * relief.qdot[j]),
                Err(why) => {
                    end = Some(why);
                    break;
                }
            }
        }
        let after = kinematics(&robot, &state).pose(&tool);
        let last = demand(&robot, &tool, &state, &F).norm();
        let tilt: f64 =
            (0..3).map(|r| (before.rotation.rows[r] - after.rotation.rows[r]).norm()).sum();
        assert!(last < below * first, "{first} to {last}");
        demands.push(last);
        match task {
            ToolTask::Orientation => {
                assert!(tilt < 0.05, "{tilt}");
                assert!(
                    matches!(end, Some(NoPostureUnloading::NotFromHere { freedom: 1, .. })),
                    "{end:?}"
                );
            }
            _ => assert!(tilt > 1.0 && end.is_none(), "{tilt}, {end:?}"),
        }
    }
    let mut page = Page::open("book/src/theory/momentum_management.md");
    let words = "200 N along z ask for {} N·m. In a minute of motion at up to 0.2 rad/s they ask for {} \
                 N·m if the tool is free, and for {} N·m if its orientation is kept";
    page.says(words, &demands);
    page.holds();
}

#[test]
fn seven_joints_that_hold_the_tools_pose_have_no_freedom_left() {
    let why = relief(&at(BENT), &push(vec3(0.0, 0.0, 200.0)), ToolTask::Pose).unwrap_err();
    let NoPostureUnloading::NoFreedom { joints: 7, conditions: 7, demand } = why else {
        panic!("{why:?}");
    };
    assert!(demand > 100.0, "{demand}");
    let said = why.to_string();
    assert!(said.contains("7 joints") && said.contains("a second arm or a grapple"), "{said}");
}

/// With the tool's place held there is a free motion, and it is of no use: the demand is the same all
/// along it, because no joint moves the centre of mass. Round-off of the steps: measured
/// 2e-10 N·m/s of 200 N at 0.1 m/s.
#[test]
fn a_held_place_is_a_held_lever() {
    let ((robot, tool), F) = (atlas_class(), push(vec3(0.0, 0.0, 200.0)));
    let why = relief(&at(BENT), &F, ToolTask::Position).unwrap_err();
    let NoPostureUnloading::LeverHeld { freedom: 1, lever, demand: stays } = why else {
        panic!("{why:?}");
    };
    // Round-off: measured 0.
    assert!((lever * 200.0 - stays).abs() < 1e-10, "{lever} m, {stays} N·m");
    // Random rates less the part that moves the tool: the second route.
    let (state, mut random, step) = (at(BENT), Random(3), 1e-4);
    let k = kinematics(&robot, &state);
    let J_held =
        attitude_held_jacobian(&jacobian(&k, &tool), &mass_matrix(&k), &state.X_NB.rotation);
    let mut rates = [(); 7].map(|()| random.within(0.2));
    for _ in 0..2000 {
        for r in 0..3 {
            let row: [f64; 7] = std::array::from_fn(|j| J_held.linear.at(j).to_array()[r]);
            let square: f64 = row.iter().map(|x| x * x).sum();
            let along: f64 = (0..7).map(|j| row[j] * rates[j]).sum();
            (0..7).for_each(|j| rates[j] -= row[j] * along / square);
        }
    }
    assert!(rates.iter().any(|rate| rate.abs() > 0.05), "{rates:?}");
    let moved =
        |sign: f64| State { q: std::array::from_fn(|j| BENT[j] + sign * step * rates[j]), ..state };
    let slope = (demand(&robot, &tool, &moved(1.0), &F) - demand(&robot, &tool, &moved(-1.0), &F))
        * (0.5 / step);
    assert!(slope.norm() < 1e-5, "{slope:?}");
}

#[test]
fn what_cannot_be_lowered_says_why() {
    let torque = SpatialForce::new(vec3(3.0, 4.0, 0.0), Vec3::zero());
    let why = relief(&at(BENT), &torque, ToolTask::Free).unwrap_err();
    assert_eq!(why, NoPostureUnloading::NoForce { demand: 5.0 });
    // Along the line from the centre of mass to the tool.
    let (robot, tool) = atlas_class();
    let state = at(BENT);
    let k = kinematics(&robot, &state);
    let lever = k.pose(&tool).translation - k.centre_of_mass().1;
    let why = relief(&at(BENT), &push(lever * 100.0), ToolTask::Free).unwrap_err();
    assert!(
        matches!(why, NoPostureUnloading::AlreadyLeast { demand } if demand < 1e-10),
        "{why:?}"
    );
    // The straight arm and a force across it: every joint moves the tool along the force or not at all.
    let why = relief(&at([0.0; 7]), &push(vec3(0.0, 0.0, 50.0)), ToolTask::Free).unwrap_err();
    assert!(matches!(why, NoPostureUnloading::NotFromHere { .. }), "{why:?}");
    let nothing = push(vec3(f64::NAN, 1.0, 0.0));
    assert!(relief(&at(BENT), &nothing, ToolTask::Free).is_err());
}

/// In single precision the same rates. Measured 9e-8 of 0.2 rad/s.
#[test]
fn single_precision_moves_alike() {
    let ((robot, _), F) = (atlas_class(), push(vec3(0.0, 0.0, 200.0)));
    let double = relief(&at(BENT), &F, ToolTask::Free).unwrap();
    let small = robot.cast::<f32>();
    let state = State::<f32, 7> {
        X_NB: Pose::identity(),
        q: BENT.map(<f32 as wrasse_spatial::Real>::from_f64),
        ..State::default()
    };
    let frame =
        Frame { body: BodyId::Link(6), X_BF: Pose::new(Mat3::identity(), vec3(0.2, 0.0, 0.0)) };
    let joints = PostureUnloadingUse { task: ToolTask::Free, gain: 0.05_f32, rate_limit: [0.2; 7] };
    let force = SpatialForce::new(Vec3::zero(), vec3(0.0_f32, 0.0, 200.0));
    let single = unload_by_posture(&kinematics(&small, &state), &frame, &force, &joints).unwrap();
    for j in 0..7 {
        let off = (f64::from(single.qdot[j]) - double.qdot[j]).abs();
        assert!(off < 1e-5, "joint {j}: {off}");
    }
}
