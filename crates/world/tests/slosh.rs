//! Propellant that swings: against the same pendulum as joints of a tree built by hand, against Newton's
//! equations written out, against a closed form; and what the ledger says of it.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]
#![allow(clippy::unwrap_used, reason = "a test may stop where it finds nothing")]

mod equipped;
mod sloshing;

use equipped::busy;
use sloshing::{
    AXIS, J, LIQUID, POSITION, bare, bob_N, equipment, flying, hung_by_hand, slosh, world,
};
use wrasse_dynamics::{BodyId, PerBody, State};
use wrasse_hardware::{ActuatorCommand, Slosh};
use wrasse_spatial::{SpatialForce, SpatialVelocity, Vec3, vec3};
use wrasse_world::{BaseAttitude, Course, Drive, Equipment, SloshPendulum, Source};
use wrasse_world_testing::OneSystem;

/// A push on the base, aside and turning, in base axes.
fn push() -> SpatialForce<f64> {
    SpatialForce::new(vec3(0.3, 0.5, -0.2), vec3(4.0, -3.0, 6.0))
}

fn on_base(F_B: SpatialForce<f64>) -> Course<J> {
    Box::new(move |_, _| PerBody { base: F_B, links: [SpatialForce::zero(); J] })
}

fn coast(world: &mut OneSystem<J>, span: f64) {
    world.command(&[], Vec3::zero(), &ActuatorCommand::default(), span);
    world.advance(span).unwrap();
}

/// Spring and damper of the rod as a couple between rod and base, from their motion in N.
fn couple(p: SloshPendulum, slosh: Slosh) -> Course<J> {
    Box::new(move |_, k| {
        let (X_NB, X_NP) = (k.X_NB(BodyId::Base), k.X_NB(BodyId::Link(1)));
        let u = X_NP.rotation * vec3(0.0, 0.0, -1.0);
        let down = X_NB.rotation * -AXIS;
        let w = X_NP.rotation * k.V_NB_B(BodyId::Link(1)).angular
            - X_NB.rotation * k.V_NB_B(BodyId::Base).angular;
        let torque = u.cross(down) * slosh.stiffness - (w - u * u.dot(w)) * p.damping;
        let on = |X: wrasse_spatial::Pose<f64>, torque_N: Vec3<f64>| {
            SpatialForce::new(X.rotation.transpose_mul(torque_N), Vec3::zero())
        };
        let mut all = PerBody::filled(push());
        all.links = [SpatialForce::zero(); J];
        all.base += on(X_NB, -torque);
        all.links[1] = on(X_NP, torque);
        all
    })
}

/// The same vehicle with the pendulum as two joints of its own, in the other order, its spring and damper
/// as wrenches from outside on rod and base. A push from outside and a swing of 0.9 rad/s: the rod goes
/// more than a quarter turn from the axis, where the coordinates of the slosh have begun anew. Measured over 20 s, at a
/// tolerance of 1e-12 for a step: base 5e-11 m and 1e-11 rad, bob 4e-11 m.
#[test]
fn a_tank_swings_as_the_same_pendulum_on_joints_of_a_tree_built_by_hand() {
    let slosh = Slosh { stiffness: 0.2, ..slosh() };
    let p = SloshPendulum::of(&slosh, LIQUID).unwrap();
    let (mut tank, mut tree) = (
        world(&bare(), flying([0.4, 0.8]), &equipment(Some(slosh)), BaseAttitude::Free),
        world(&hung_by_hand(&p), flying([0.8, 0.4]), &Equipment::default(), BaseAttitude::Free),
    );
    tank.set_outside_wrench(on_base(push()), &[]);
    tree.set_outside_wrench(couple(p, slosh), &[]);
    let (mut farthest, mut anew) = (0.0_f64, false);
    for _ in 0..80 {
        coast(&mut tank, 0.25);
        coast(&mut tree, 0.25);
        let (a, b) = (tank.state(), tree.state());
        let off = (a.X_NB.translation - b.X_NB.translation).norm();
        let turn = (tank.quat_NB().conjugate() * tree.quat_NB()).log().norm();
        let apart = (bob_N(&tank, 0, &p) - bob_N(&tree, 0, &p)).norm();
        assert!(off < 1e-9 && turn < 1e-9 && apart < 1e-9, "{off:e} m {turn:e} {apart:e} m");
        let hinge = tank.pose(&wrasse_dynamics::Frame {
            body: BodyId::Link(0),
            X_BF: wrasse_spatial::Pose::identity(),
        });
        let along = (bob_N(&tank, 0, &p) - hinge.translation) * (1.0 / p.length);
        let angle = libm::acos(-along.dot(a.X_NB.rotation * AXIS));
        let seen = tank.slosh_angle(tank.id).unwrap();
        assert!((libm::cos(seen) - libm::cos(angle)).abs() < 1e-12, "{seen} rad, {angle} rad");
        farthest = farthest.max(angle);
        anew |= angle > 1.2 && a.q[1].abs() < 0.6;
    }
    assert!(farthest > 1.6 && anew, "swung by {farthest} rad");
}

/// Wheels, CMGs and thrusters work while the propellant swings and grows less, for ten seconds.
/// Momentum is conserved to rounding: measured 2e-14 N·m·s of 40, 8e-15 N·s of 60. Energy to the
/// quadrature of the work.
#[test]
fn the_ledger_closes_while_everything_works_and_propellant_leaves() {
    let mut all = equipped::everything(7);
    all.slosh = Some(slosh());
    let tank = all.actuators.tank.as_mut().unwrap();
    (tank.position_B, tank.propellant) = (POSITION, LIQUID);
    let mut world = world(&bare(), flying([0.1, -0.2]), &all, BaseAttitude::Free);
    let mut ledger = world.open_ledger();
    for period in 0..200 {
        world.command(&[], Vec3::zero(), &busy(period), 0.05);
        world.advance(0.05).unwrap();
        world.update_ledger(&mut ledger);
    }
    let [angular, linear, energy] = ledger.worst;
    assert!(angular < 1e-12 && linear < 1e-12, "{angular:e} N·m·s, {linear:e} N·s");
    assert!(energy < 1e-7, "{energy:e} J");
    let given = ledger.sources[Source::Slosh];
    assert_eq!((given.angular, given.linear), (Vec3::zero(), Vec3::zero()));
    assert!(given.work < -1e-3, "the damper takes nothing: {} J", given.work);
    assert!(ledger.propellant > 0.03, "{} kg", ledger.propellant);
}

/// A tank that runs low: the pendulum grows long and light, stands still once the liquid is shallow, and
/// the rest leaves. Mass and momentum are those of the ledger throughout.
#[test]
fn a_tank_that_runs_dry_stops_swinging_and_the_ledger_closes() {
    let mut all = equipment(Some(slosh()));
    let low = sloshing::SHALLOW + 0.5;
    all.actuators.thrusters = equipped::six_thrusters();
    all.actuators.thrusters = wrasse_hardware::List::new(
        &all.actuators
            .thrusters
            .iter()
            .map(|t| wrasse_hardware::Thruster { specific_impulse: 4.0, ..*t })
            .collect::<Vec<_>>(),
    );
    all.actuators.tank.as_mut().unwrap().propellant = low;
    let mut world = world(&bare(), flying([0.1, -0.2]), &all, BaseAttitude::Free);
    let dry = world.robot().mass() - low;
    let mut ledger = world.open_ledger();
    let mut still = 0;
    for period in 0..700 {
        world.command(&[], Vec3::zero(), &busy(period), 0.1);
        world.advance(0.1).unwrap();
        world.update_ledger(&mut ledger);
        let left = world.actuator_readings().propellant;
        assert!((world.robot().mass() - dry - left).abs() < 1e-11);
        if left < sloshing::SHALLOW {
            assert_eq!(world.state().v[..2], [0.0, 0.0]);
            still += 1;
        }
    }
    assert!(still > 300 && still < 690 && world.actuator_readings().propellant == 0.0, "{still}");
    let [angular, linear, energy] = ledger.worst;
    assert!(angular < 1e-11 && linear < 1e-11, "{angular:e} N·m·s, {linear:e} N·s");
    assert!(energy < 1e-7, "{energy:e} J");
}

/// A burn of two seconds while propellant leaves, begun at `p_N` (m) by a base that stands still: base less
/// `p_N`, and its attitude.
fn burnt_at(p_N: Vec3<f64>) -> (Vec3<f64>, wrasse_spatial::Quat<f64>) {
    let mut all = equipment(Some(slosh()));
    all.actuators.thrusters = equipped::six_thrusters();
    let mut start = State { v: flying([0.4, -0.2]).v, ..State::default() };
    start.X_NB.translation = p_N;
    let mut world = world(&bare(), start, &all, BaseAttitude::Free);
    for period in 0..20 {
        world.command(&[], Vec3::zero(), &busy(period), 0.1);
        world.advance(0.1).unwrap();
    }
    assert!(world.actuator_readings().propellant < LIQUID - 1e-3);
    (world.state().X_NB.translation - p_N, world.quat_NB())
}

/// A burn goes the same wherever the origin of N is: what leaves the tank takes its share of mass and momentum from
/// where it is, and the rest stays. Measured 5e-13 m.
#[test]
fn a_burn_goes_the_same_wherever_it_happens() {
    let (here, there) = (burnt_at(Vec3::zero()), burnt_at(vec3(300.0, -500.0, 200.0)));
    let off = (here.0 - there.0).norm();
    let turn = (here.1.conjugate() * there.1).log().norm();
    assert!(off < 1e-10 && turn < 1e-11, "{off:e} m {turn:e} rad");
}

/// Pulled through the vehicle's centre of mass, across the tank's axis: propellant that is fixed lets the base
/// go straight, for good. What swings stays behind and the base turns.
#[test]
fn a_push_through_the_centre_of_mass_turns_a_base_with_slosh_alone() {
    let turned = |swings: Option<Slosh>| {
        let mut world = world(&bare(), State::default(), &equipment(swings), BaseAttitude::Free);
        let p_cm = wrasse_dynamics::kinematics(world.robot(), &world.state()).centre_of_mass().1;
        let force = AXIS.cross(vec3(1.0, 0.0, 0.0)) * 20.0;
        world.set_outside_wrench(on_base(SpatialForce::new(p_cm.cross(force), force)), &[]);
        let mut ledger = world.open_ledger();
        coast(&mut world, 5.0);
        world.update_ledger(&mut ledger);
        let [angular, linear, energy] = ledger.residuals();
        assert!(angular < 1e-10 && linear < 1e-12 && energy < 1e-8);
        world.quat_NB().log().norm()
    };
    let (fixed, swinging) = (turned(None), turned(Some(slosh())));
    assert!(fixed < 1e-13, "{fixed:e} rad");
    assert!(swinging > 1e-2, "{swinging} rad");
}

/// The rigid robot has the mass of the true one, and its state none of the swing; drives that are
/// commanded for joints that are not the vehicle's hold nothing.
#[test]
fn nobody_is_told_of_the_joints_by_which_propellant_swings() {
    let mut world =
        world(&bare(), flying([0.4, 0.0]), &equipment(Some(slosh())), BaseAttitude::Free);
    let all = [Drive::Effort(30.0); J];
    world.command(&all, Vec3::zero(), &ActuatorCommand::default(), 0.5);
    let accelerated = world.dynamics().force.joints;
    assert!(accelerated[..2].iter().all(|tau| tau.abs() < 1.0), "{accelerated:?}");
    world.advance(0.5).unwrap();
    let (rigid, state) = (world.rigid_robot(world.id), world.rigid_state(world.id));
    assert_eq!((rigid.joint_count(), world.robot().joint_count()), (0, 2));
    let whole = wrasse_dynamics::MassProperties::from_central(
        LIQUID,
        POSITION,
        wrasse_spatial::Sym3::zero(),
    );
    let expected = bare().with_payload(
        &wrasse_dynamics::Frame { body: BodyId::Base, X_BF: wrasse_spatial::Pose::identity() },
        &whole,
    );
    assert_eq!(rigid.inertia(BodyId::Base), expected.inertia(BodyId::Base));
    assert!((rigid.mass() - world.robot().mass()).abs() < 1e-12);
    assert_eq!((state.q, state.v), ([0.0; J], [0.0; J]));
    assert!(world.state().q[0].abs() > 0.01);
    assert_eq!(state.X_NB, world.state().X_NB);
}

#[test]
#[should_panic(expected = "no room for the two by which propellant swings")]
fn a_robot_without_room_for_two_joints_more_is_refused() {
    let robot = equipped::block(50.0, wrasse_spatial::Sym3::diagonal(4.0, 5.0, 6.0));
    let _ = equipped::turning_block(&robot, Vec3::zero(), &equipment(Some(slosh())), 0.01);
}

/// On a base that is held against turning the liquid swings all the same.
#[test]
fn propellant_swings_on_a_base_that_is_held() {
    let start = State { V_NB_B: SpatialVelocity::zero(), ..flying([0.4, 0.0]) };
    let mut world = world(&bare(), start, &equipment(Some(slosh())), BaseAttitude::Held);
    let mut ledger = world.open_ledger();
    coast(&mut world, 3.0);
    world.update_ledger(&mut ledger);
    assert!(world.state().q[0] > 0.1);
    let [angular, linear, energy] = ledger.residuals();
    assert!(angular < 1e-9 && linear < 1e-12 && energy < 1e-9);
}
