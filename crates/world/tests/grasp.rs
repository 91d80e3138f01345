//! Grasp and release: what continues, what is lost, what is refused.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

mod branched;

use branched::{J, grip, load, moving, pose};
use wrasse_dynamics::{
    BodyId, Frame, Joint, JointKind, MassProperties, Robot, State, jacobian, kinematics,
    mass_matrix,
};
use wrasse_hardware::{ActuatorCommand, SetPoint, SetPointMotion};
use wrasse_spatial::{
    At, Pose, Quat, SpatialForce, SpatialInertia, SpatialVelocity, Sym3, Vec3, vec3,
};
use wrasse_testing::{larger, largest};
use wrasse_world::{
    Account, BaseAttitude, Drive, Equipment, FreeBody, GraspRefused, GripOffset, Ledger, Source,
    Stepper,
};
use wrasse_world_testing::{OneSystem, OneSystemSetup};

/// Largest relative twist that is accepted, where a test does not ask for another (rad/s, m/s).
const BOUNDS: (f64, f64) = (1.0, 1.0);

/// A grasp that takes what moves at most so fast against the grip (rad/s, m/s), wherever it is.
fn moving_at_most(angular_speed: f64, linear_speed: f64) -> GripOffset {
    GripOffset { distance: f64::INFINITY, angle: f64::INFINITY, angular_speed, linear_speed }
}

fn at_rest() -> State<f64, J> {
    State { v: [0.0; J], ..moving() }
}

/// A world whose joints are prescribed: they keep their rates.
fn world(start: State<f64, J>, base: BaseAttitude) -> OneSystem<J> {
    let mut world = branched::world(start, base, 0.01);
    world.command(&keeping_rates(&start), Vec3::zero(), &ActuatorCommand::default(), 0.01);
    world
}

fn keeping_rates<const N: usize>(state: &State<f64, N>) -> [Drive; N] {
    std::array::from_fn(|j| {
        let at = |t: f64| SetPoint {
            position: state.q[j] + state.v[j] * t,
            rate: state.v[j],
            acceleration: 0.0,
        };
        Drive::Follow(SetPointMotion::between(at(0.0), at(0.01), 0.01))
    })
}

/// Joints driven by torque give way: what they and the base have of momentum before, with the
/// payload's at the grip, is what they have after (`M⁺ ν⁺ = M ν + Jᵀ h`), and the tool then moves as
/// the payload does. Energy only falls. Measured: 3e-14 of the momenta.
#[test]
fn joints_driven_by_torque_give_way_at_a_grasp() {
    let mut world = branched::world(moving(), BaseAttitude::Free, 0.01);
    let (frame, alone, before) = (grip(), *world.robot(), world.state());
    let body = in_the_grip(&world, &frame, vec3(0.02, -0.01, 0.03), vec3(0.05, 0.02, -0.04));
    let number = world.add_body(&body);
    let start = world.account();
    let change = world
        .grasp(&frame, number, &moving_at_most(BOUNDS.0, BOUNDS.1))
        .expect("within the bounds");
    let after = world.state();
    assert!((0..J).any(|j| (after.v[j] - before.v[j]).abs() > 1e-4), "no joint gave way");
    // Generalized momentum of the joints, by the mass matrices, and the payload's by the Jacobian.
    let momenta = |robot: &Robot<f64, J>, state: &State<f64, J>| -> [f64; J] {
        let M = mass_matrix(&kinematics(robot, state));
        std::array::from_fn(|i| {
            let own: f64 = (0..J).map(|j| M.M_jj[i][j] * state.v[j]).sum();
            own + state.V_NB_B.power(&M.M_bj.at(i))
        })
    };
    let k = kinematics(&alone, &before);
    let columns = jacobian(&k, &frame).joints.columns();
    let h = SpatialForce::new(body.angular, body.linear)
        .about(k.pose(&frame).translation - body.p_NTcm_N);
    let (own, whole) = (momenta(&alone, &before), momenta(world.robot(), &after));
    for j in 0..J {
        let rest = whole[j] - own[j] - columns[j].power(&h);
        assert!(rest.abs() < 1e-12, "joint {j}: {rest:.1e}");
    }
    let now = world.account();
    assert!(change < 0.0, "{change}");
    assert!((now.energy - start.energy - change).abs() < 1e-13, "{change}");
    assert!(momentum_apart(&start, &now) < 1e-14);
}

/// A body in the grip of a frame, moving relative to it by an angular (rad/s) and a linear velocity
/// (m/s) of the grip point, inertial axes.
fn in_the_grip(world: &OneSystem<J>, frame: &Frame<f64>, w: Vec3<f64>, v: Vec3<f64>) -> FreeBody {
    let state = world.state();
    let k = kinematics(world.robot(), &state);
    let X_FT = pose(vec3(0.2, -0.4, 0.1), vec3(0.1, 0.0, -0.05));
    let (X_NT, X_NF, V_NF_N) = (k.pose(frame) * X_FT, k.pose(frame), k.velocity(frame));
    let at_F = V_NF_N + SpatialVelocity::new(w, v);
    let at_T = at_F.shifted_by(X_NT.translation - X_NF.translation);
    let R_NT = X_NT.rotation;
    let V_NT_T =
        SpatialVelocity::new(R_NT.transpose_mul(at_T.angular), R_NT.transpose_mul(at_T.linear));
    FreeBody::new(load(), &X_NT, &V_NT_T)
}

/// Largest difference of momentum, each part relative to the sum of the bodies' momenta.
fn momentum_apart(a: &Account, b: &Account) -> f64 {
    let linear = (a.linear - b.linear).norm() / a.linear_scale;
    let angular = (a.angular - b.angular).norm() / a.angular_scale;
    larger(linear, angular)
}

/// Largest difference of all poses and joint positions (rad or –, m).
fn place_apart(a: &State<f64, J>, b: &State<f64, J>) -> f64 {
    let rotation = a.X_NB.rotation - b.X_NB.rotation;
    let mut farthest = (a.X_NB.translation - b.X_NB.translation).norm();
    for row in rotation.rows {
        farthest = larger(farthest, row.norm());
    }
    larger(farthest, largest((0..J).map(|j| (a.q[j] - b.q[j]).abs())))
}

/// Largest difference of the base's twist and the joint rates.
fn motion_apart(a: &State<f64, J>, b: &State<f64, J>) -> f64 {
    let V = (a.V_NB_B - b.V_NB_B).to_array();
    let rates = (0..J).map(|j| a.v[j] - b.v[j]);
    largest(V.into_iter().chain(rates).map(f64::abs))
}

/// Relative velocity that the grip has to swallow in these tests (rad/s, m/s).
const SPIN: Vec3<f64> = vec3(0.05, -0.02, 0.03);
const DRIFT: Vec3<f64> = vec3(-0.04, 0.06, 0.02);

/// Measured: momentum within 3.6e-16 of its scale, places within 1.1e-16.
#[test]
fn at_a_grasp_momentum_and_place_continue_and_the_joints_keep_their_rates() {
    for start in [at_rest(), moving()] {
        let mut world = world(start, BaseAttitude::Free);
        let i = {
            let body = in_the_grip(&world, &grip(), SPIN, DRIFT);
            world.add_body(&body)
        };
        let (state, before) = (world.state(), world.account());
        world.grasp(&grip(), i, &moving_at_most(BOUNDS.0, BOUNDS.1)).expect("within the bounds");
        let (then, after) = (world.state(), world.account());
        let momentum = momentum_apart(&before, &after);
        assert!(momentum < 1e-14, "momentum jumped by {momentum:e} of its scale");
        let place = place_apart(&state, &then);
        assert!(place < 1e-14, "the robot jumped by {place:e}");
        assert_eq!(state.v, then.v);
        assert!(motion_apart(&state, &then) > 1e-3, "the base felt the grasp");
    }
}

/// The whole system as one rigid body about the inertial origin, from its parts: inertia, momentum.
fn rigid(world: &OneSystem<J>) -> (SpatialInertia<f64>, SpatialForce<f64>) {
    let state = world.state();
    let k = kinematics(world.robot(), &state);
    let (mut M, mut h) = (SpatialInertia::zero(), SpatialForce::zero());
    let mut add = |X: &Pose<f64>, M_B: &SpatialInertia<f64>, V_B: SpatialVelocity<f64>| {
        M += X.inertia_to_parent(M_B);
        h += X.force_to_parent(&(*M_B * V_B));
    };
    for body in world.robot().bodies() {
        add(&k.X_NB(body), world.robot().inertia(body), k.V_NB_B(body));
    }
    for body in world.free_bodies() {
        add(&body.pose(), &body.matter.M_F_F, body.twist());
    }
    (M, h)
}

/// With the joints still, vehicle and payload go on as one rigid body: `V = M⁻¹ h`, and what is
/// lost is the difference of the energies. Measured: 0.0212 J lost, predicted within 4e-16 J.
#[test]
fn a_grasp_by_a_still_arm_loses_what_two_bodies_that_stick_together_lose() {
    let mut world = world(at_rest(), BaseAttitude::Free);
    let i = {
        let body = in_the_grip(&world, &grip(), SPIN, DRIFT);
        world.add_body(&body)
    };
    let mut ledger = world.open_ledger();
    let (M, h) = rigid(&world);
    let together = 0.5 * M.velocity_of(&h).power(&h);
    let predicted = together - ledger.start.energy;
    world.grasp(&grip(), i, &moving_at_most(BOUNDS.0, BOUNDS.1)).expect("within the bounds");
    world.update_ledger(&mut ledger);
    assert!(predicted < -1e-3, "a loss of {predicted} J would prove little");
    assert!((ledger.sources[Source::Grasps].work - predicted).abs() < 1e-13);
    // The books are made from momenta before, the account from motion after. Measured 1.8e-15 J.
    assert!(ledger.residuals()[2] < 1e-13, "rest {:e} J", ledger.residuals()[2]);
}

/// Nothing moves in the grip: nothing is lost, whatever the arm does. Measured: velocities
/// within 1.1e-16, energy within 2.7e-15 J of 3.8 J.
#[test]
fn a_grasp_without_relative_motion_changes_no_velocity() {
    let mut world = world(moving(), BaseAttitude::Free);
    let o = Vec3::zero();
    let i = {
        let body = in_the_grip(&world, &grip(), o, o);
        world.add_body(&body)
    };
    let (state, before) = (world.state(), world.account());
    let relative = world.relative_twist(&grip(), i).to_array();
    // Its momentum is kept about the origin of N, some metres away. Measured 1.1e-15.
    assert!(relative.iter().all(|x| x.abs() < 1e-14), "{relative:?}");
    world.grasp(&grip(), i, &moving_at_most(1e-12, 1e-12)).expect("nothing moves in the grip");
    let jump = motion_apart(&state, &world.state());
    assert!(jump < 1e-14, "velocities jumped by {jump:e}");
    let lost = world.account().energy - before.energy;
    assert!(lost.abs() < 1e-14, "lost {lost:e} J");
}

/// A link slides out from a base at rest and grips a payload at rest. Its drive keeps the rate, so
/// it starts the payload and pushes the base back: energy comes in, `½ m v²` of the two masses'
/// reduced mass, and the books say where. 0.15 J, measured within
/// 9e-12, the share of the link of 1e-9 kg.
#[test]
fn a_drive_that_keeps_its_rate_can_put_energy_in_at_a_grasp() {
    let ball =
        |mass: f64| MassProperties::from_central(mass, Vec3::zero(), Sym3::diagonal(1.0, 1.0, 1.0));
    let slide =
        Joint::new(BodyId::Base, JointKind::Prismatic, Pose::identity(), vec3(1.0, 0.0, 0.0));
    let robot: Robot<f64, 1> =
        Robot::new(ball(30.0), &[(slide, ball(1e-9))]).expect("one joint fits");
    let mut world = OneSystem::new(&OneSystemSetup {
        robot: &robot,
        limits: &[],
        actuator: None,
        equipment: Equipment::default(),
        base: BaseAttitude::Free,
        stepper: Stepper::Fixed { step: 0.01 },
        start: State { v: [0.2], ..State::default() },
        held: &[],
    });
    let start = world.state();
    world.command(&keeping_rates(&start), Vec3::zero(), &ActuatorCommand::default(), 0.01);
    let i = world.add_body(&FreeBody::new(ball(10.0), &Pose::identity(), &SpatialVelocity::zero()));
    let mut ledger = world.open_ledger();
    let tip = Frame { body: BodyId::Link(0), X_BF: Pose::identity() };
    world.grasp(&tip, i, &moving_at_most(BOUNDS.0, BOUNDS.1)).expect("within the bounds");
    world.update_ledger(&mut ledger);
    let reduced = 30.0 * 10.0 / 40.0;
    let expected = 0.5 * reduced * 0.2 * 0.2;
    assert!((ledger.sources[Source::Grasps].work - expected).abs() < 1e-9);
    assert!(ledger.residuals()[1] < 1e-15, "{:?}", ledger.residuals());
}

#[test]
fn a_grasp_above_its_bounds_is_refused_with_the_numbers_and_changes_nothing() {
    let mut world = world(moving(), BaseAttitude::Free);
    let i = {
        let body = in_the_grip(&world, &grip(), SPIN, DRIFT);
        world.add_body(&body)
    };
    let (state, before) = (world.state(), world.account());
    let (w, v) = (SPIN.norm(), DRIFT.norm());
    for (angular, linear) in [(0.99 * w, 1.0), (1.0, 0.99 * v), (0.0, 0.0)] {
        let bounds = moving_at_most(angular, linear);
        let GraspRefused(refused) = world.grasp(&grip(), i, &bounds).expect_err("too fast");
        let off = larger((refused.angular_speed - w).abs(), (refused.linear_speed - v).abs());
        // Measured: 3e-17.
        assert!(off < 1e-15, "speeds {refused:?}, expected {w} rad/s and {v} m/s");
    }
    assert_eq!((world.state(), world.account()), (state, before));
    assert_eq!((world.free_bodies().len(), world.held().len()), (1, 0));
    assert!(world.grasp(&grip(), i, &moving_at_most(1.01 * w, 1.01 * v)).is_ok());
}

/// A module at rest, 20 mm and 2 deg from the tool: refused for either, and for nothing else.
#[test]
fn a_grasp_beside_its_grip_is_refused_with_distance_and_angle_and_changes_nothing() {
    let mut world = world(at_rest(), BaseAttitude::Free);
    let angle = 2.0_f64.to_radians();
    let beside = Pose::from_quat(Quat::exp(vec3(0.0, angle, 0.0)), vec3(0.012, 0.0, -0.016));
    let X_NT = world.pose(&grip()) * beside;
    let i = world.add_body(&FreeBody::new(load(), &X_NT, &SpatialVelocity::zero()));
    let bounds = |distance, angle| GripOffset { distance, angle, ..moving_at_most(1.0, 1.0) };
    let before = (world.state(), world.account());
    for (distance, most) in [(0.019, 0.1), (0.1, 0.99 * angle), (0.005, 0.5_f64.to_radians())] {
        let GraspRefused(found) =
            world.grasp(&grip(), i, &bounds(distance, most)).expect_err("beside it");
        // Measured: 7e-17 m, 3e-16 rad.
        assert!((found.distance - 0.02).abs() < 1e-14, "{found:?}");
        assert!((found.angle - angle).abs() < 1e-14, "{found:?}");
    }
    assert_eq!((world.state(), world.account()), before);
    assert!(world.grasp(&grip(), i, &bounds(0.0201, 1.01 * angle)).is_ok());
}

/// A speed that is not a number is within no bound.
#[test]
fn a_grasp_of_a_body_without_a_motion_is_refused() {
    let mut world = world(moving(), BaseAttitude::Free);
    let mut body = in_the_grip(&world, &grip(), SPIN, DRIFT);
    body.angular.x = f64::NAN;
    let i = world.add_body(&body);
    assert!(world.grasp(&grip(), i, &moving_at_most(BOUNDS.0, BOUNDS.1)).is_err());
}

/// The held base takes the angular impulse; the actuator books it and the books close. An
/// impulse of 1.16 N·m·s; rests measured: 0 and 1.8e-15.
#[test]
fn a_grasp_with_the_attitude_held_books_the_impulse_of_the_actuator() {
    let start =
        State { V_NB_B: SpatialVelocity::new(Vec3::zero(), vec3(0.05, -0.02, 0.04)), ..moving() };
    let mut world = world(start, BaseAttitude::Held);
    let i = {
        let body = in_the_grip(&world, &grip(), SPIN, DRIFT);
        world.add_body(&body)
    };
    let mut ledger = world.open_ledger();
    world.grasp(&grip(), i, &moving_at_most(BOUNDS.0, BOUNDS.1)).expect("within the bounds");
    world.update_ledger(&mut ledger);
    let [angular, linear, _] = ledger.residuals();
    assert!(ledger.sources[Source::AttitudeActuator].angular.norm() > 0.01, "no impulse to book");
    assert!(angular < 1e-14 && linear < 1e-14, "rests {:?}", ledger.residuals());
    assert_eq!(world.state().V_NB_B.angular, Vec3::zero());
    // Held, it stays so after the release as well.
    world.release(0);
    world.update_ledger(&mut ledger);
    assert!(ledger.residuals()[0] < 1e-14, "rests {:?}", ledger.residuals());
    assert_eq!(world.state().V_NB_B.angular, Vec3::zero());
}

/// Measured: velocities within 4.0e-16, places within 1.6e-16, momentum within 3.1e-16, energy to the bit.
#[test]
fn a_release_changes_no_velocity_no_place_no_momentum_and_no_energy() {
    let robot = branched::robot();
    let mut world = OneSystem::new(&OneSystemSetup {
        robot: &robot,
        limits: &[],
        actuator: None,
        equipment: Equipment::default(),
        base: BaseAttitude::Free,
        stepper: Stepper::Fixed { step: 0.01 },
        start: moving(),
        held: &[(grip(), load())],
    });
    let (state, before, X_NT) = (world.state(), world.account(), world.pose(&grip()));
    let V_NT_N = kinematics(world.robot(), &state).velocity(&grip());
    let i = world.release(0);
    let (then, after) = (world.state(), world.account());
    let (velocity, place) = (motion_apart(&state, &then), place_apart(&state, &then));
    let (momentum, energy) = (momentum_apart(&before, &after), after.energy - before.energy);
    assert!(velocity < 1e-14 && place < 1e-14, "jumped by {velocity:e}, {place:e}");
    assert!(momentum < 1e-14 && energy.abs() < 1e-14, "{momentum:e} {energy:e}");
    let body = world.body(i);
    assert!((body.pose().translation - X_NT.translation).norm() < 1e-14);
    let off = X_NT.rotation * body.twist().linear - V_NT_N.linear;
    assert!(off.norm() < 1e-14, "the payload left at another velocity: {off:?}");
    assert_eq!(world.held(), []);
}

/// Grasped, carried, released, grasped again, among others: the books close over the day. Measured:
/// 8e-16, 4e-16 and, with the quadrature of the work, 7e-11 of the scales.
#[test]
fn the_books_close_over_grasps_and_releases_of_several_payloads() {
    let elbow = Frame { body: BodyId::Link(2), X_BF: Pose::identity() };
    let mut world = world(moving(), BaseAttitude::Free);
    let first = {
        let body = in_the_grip(&world, &grip(), SPIN, DRIFT);
        world.add_body(&body)
    };
    let second = {
        let body = in_the_grip(&world, &elbow, -SPIN, DRIFT);
        world.add_body(&body)
    };
    let mut ledger = world.open_ledger();
    let fly = |world: &mut OneSystem<J>, ledger: &mut Ledger| {
        for _ in 0..50 {
            world.command(
                &[0.3, -0.2, 0.1, 0.2].map(Drive::Effort),
                Vec3::zero(),
                &ActuatorCommand::default(),
                0.01,
            );
            world.advance(0.01).expect("stays finite");
            world.update_ledger(ledger);
        }
    };
    world.grasp(&elbow, second, &moving_at_most(BOUNDS.0, BOUNDS.1)).expect("within the bounds");
    world.grasp(&grip(), first, &moving_at_most(BOUNDS.0, BOUNDS.1)).expect("within the bounds");
    fly(&mut world, &mut ledger);
    let free = world.release(0);
    fly(&mut world, &mut ledger);
    world.grasp(&grip(), free, &moving_at_most(10.0, 10.0)).expect("within the bounds");
    fly(&mut world, &mut ledger);
    for (i, bound) in [1e-14, 1e-14, 1e-7].into_iter().enumerate() {
        let share = ledger.worst[i] / ledger.scale[i];
        assert!(share < bound, "entry {i}: rest {share:e} of the scale");
    }
}

/// A handle goes on to mean the same body, whatever is grasped and released around it.
#[test]
fn handles_of_bodies_and_of_held_payloads_do_not_shift() {
    let mut world = world(at_rest(), BaseAttitude::Free);
    let bodies = [1.0, 2.0, 3.0].map(|mass| {
        let mut body = in_the_grip(&world, &grip(), Vec3::zero(), Vec3::zero());
        body.matter.M_F_F.mass = mass;
        world.add_body(&body)
    });
    let mass = |world: &OneSystem<J>, id| world.body(id).matter.M_F_F.mass;
    let held = |world: &OneSystem<J>| {
        world.held().iter().map(|(_, held)| held.matter.M_F_F.mass).collect::<Vec<_>>()
    };
    let any = f64::INFINITY;
    world.grasp(&grip(), bodies[1], &moving_at_most(any, any)).expect("any speed will do");
    assert!(!world.contains(bodies[1]));
    assert_eq!((mass(&world, bodies[0]), mass(&world, bodies[2])), (1.0, 3.0));
    world.grasp(&grip(), bodies[0], &moving_at_most(any, any)).expect("any speed will do");
    assert_eq!((mass(&world, bodies[2]), held(&world)), (3.0, vec![2.0, 1.0]));
    let kept = world.held()[1].0;
    let released = world.release(0);
    assert_eq!((mass(&world, released), mass(&world, bodies[2])), (2.0, 3.0));
    assert_eq!((world.held()[0].0, held(&world)), (kept, vec![1.0]));
}
