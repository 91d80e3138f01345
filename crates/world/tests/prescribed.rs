//! Joints that follow their set-points exactly: their forces, their work, and the same motion again
//! when those forces drive the joints.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

mod branched;

use branched::{J, moving};
use wrasse_dynamics::{Dynamics, Generalized, PerBody, State, inverse_dynamics, kinematics};
use wrasse_hardware::{ActuatorCommand, SetPoint, SetPointMotion};
use wrasse_spatial::{SpatialForce, SpatialVelocity, Vec3};
use wrasse_testing::largest;
use wrasse_world::{BaseAttitude, Drive, Source};
use wrasse_world_testing::OneSystem;

/// Control period (s).
const PERIOD: f64 = 0.01;

/// Where joint `j` shall be at period `k`: a swing of its own.
fn set_point(j: usize, k: u32) -> SetPoint<f64> {
    let (t, rhythm) = (f64::from(k) * PERIOD, [1.1, 0.7, 1.6, 1.3][j]);
    let (swing, [q, v]) = (0.2, [moving().q[j], moving().v[j]]);
    let (sin, cos) = (rhythm * t).sin_cos();
    SetPoint {
        position: q + v * t + swing * (1.0 - cos),
        rate: v + swing * rhythm * sin,
        acceleration: swing * rhythm * rhythm * cos,
    }
}

fn motion(j: usize, k: u32) -> SetPointMotion<f64> {
    SetPointMotion::between(set_point(j, k), set_point(j, k + 1), PERIOD)
}

fn follow(k: u32) -> [Drive; J] {
    core::array::from_fn(|j| Drive::Follow(motion(j, k)))
}

fn start(base: BaseAttitude) -> State<f64, J> {
    let mut start = moving();
    if base == BaseAttitude::Held {
        start.V_NB_B.angular = Vec3::zero();
    }
    start
}

const BASES: [BaseAttitude; 3] = [BaseAttitude::Held, BaseAttitude::Controlled, BaseAttitude::Free];

/// At the end of each period, whatever the steps in it, to the bit: and that is the set-point, to
/// the round-off of the quintic.
#[test]
fn joints_that_follow_are_where_their_set_points_are() {
    for base in BASES {
        // 3 steps of 10/3 ms.
        let mut world = branched::world(start(base), base, 0.0035);
        for k in 0..100 {
            world.command(&follow(k), Vec3::zero(), &ActuatorCommand::default(), PERIOD);
            world.advance(PERIOD).expect("stays finite");
            let state = world.state();
            for j in 0..J {
                let at_end = motion(j, k).at(PERIOD);
                assert_eq!((state.q[j], state.v[j]), (at_end.position, at_end.rate));
                assert_eq!(
                    (variables(&world).0[j], variables(&world).1[j]),
                    (state.q[j], state.v[j])
                );
                let off = (state.q[j] - set_point(j, k + 1).position).abs();
                assert!(off < 1e-15, "{off:e}");
            }
        }
    }
}

/// 49 steps of 1/49 s are not one second to the bit; the period is.
#[test]
fn the_last_step_of_a_period_ends_where_the_period_does() {
    let mut world = branched::world(moving(), BaseAttitude::Free, 1.0 / 48.5);
    let whole = |j| SetPointMotion::between(set_point(j, 0), set_point(j, 100), 1.0);
    world.command(
        &core::array::from_fn::<_, J, _>(|j| Drive::Follow(whole(j))),
        Vec3::zero(),
        &ActuatorCommand::default(),
        1.0,
    );
    world.advance(1.0).expect("stays finite");
    for j in 0..J {
        assert_eq!(variables(&world).0[j], whole(j).at(1.0).position);
        assert_eq!(variables(&world).1[j], whole(j).at(1.0).rate);
    }
}

/// Positions and rates of the joints as they are integrated.
fn variables(world: &OneSystem<J>) -> (&[f64], &[f64]) {
    world.variables(world.id)[3..].split_at(J)
}

/// Acceleration of the base that the flown motion shows: its twist at five instants `h` (s) apart,
/// and the state and forces in the middle.
fn seen(base: BaseAttitude, h: f64) -> (SpatialVelocity<f64>, State<f64, J>, Dynamics<f64, J>) {
    let drives: [Drive; J] = core::array::from_fn(|j| {
        let (from, to) = (set_point(j, 0), set_point(j, 50));
        Drive::Follow(SetPointMotion::between(from, to, 50.0 * PERIOD))
    });
    let mut world = branched::world(start(base), base, 1e-3);
    world.command(&drives, Vec3::zero(), &ActuatorCommand::default(), 50.0 * PERIOD);
    world.advance(0.2).expect("stays finite");
    let mut twists = vec![];
    let mut middle = None;
    for i in 0..5 {
        world.advance(h).expect("stays finite");
        twists.push(world.state().V_NB_B);
        if i == 2 {
            middle = Some((world.state(), world.dynamics()));
        }
    }
    let rate = (twists[0] - twists[4]) + (twists[3] - twists[1]) * 8.0;
    let (state, dynamics) = middle.expect("the third of five");
    (rate * (1.0 / (12.0 * h)), state, dynamics)
}

/// The base's twist follows from momentum here, not from accelerations: its rate, by differences
/// over 5 ms, is another witness. Measured apart: base rates 1.2e-11, joint forces 2.7e-11, wrench on
/// the base 6.2e-10 (the mass of 58 kg times the first).
#[test]
fn the_forces_found_are_those_that_the_flown_motion_takes() {
    for base in BASES {
        let (base_rate, state, found) = seen(base, 5e-3);
        let robot = branched::robot();
        let k = kinematics(&robot, &state);
        let nudot = Generalized { base: base_rate, joints: found.nudot.joints };
        let taken = inverse_dynamics(&k, &nudot, &PerBody::filled(SpatialForce::zero())).force;
        let worst = |a: &[f64]| largest(a.iter().map(|x| x.abs()));
        let rates = worst(&(base_rate - found.nudot.base).to_array());
        let forces =
            worst(&core::array::from_fn::<_, J, _>(|j| taken.joints[j] - found.force.joints[j]));
        let on_base = worst(&(taken.base - found.force.base).to_array());
        assert!(worst(&found.force.joints) > 0.1, "hardly any force: {:?}", found.force);
        assert!(rates < 1e-9, "base accelerates {rates:e} otherwise");
        assert!(forces < 1e-9, "joint forces {forces:e} apart");
        assert!(on_base < 1e-9, "wrench on the base {on_base:e} apart");
    }
}

/// Joints after 1 s: following, and driven by the forces that this took in the middle of each period
/// of `period` (s).
fn followed_and_driven(base: BaseAttitude, period: f64) -> f64 {
    let count = (1.0 / period).round();
    let drive_to = |k: f64| -> [Drive; J] {
        core::array::from_fn(|j| {
            let whole = SetPointMotion::between(set_point(j, 0), set_point(j, 100), 1.0);
            let (from, to) = (whole.at(k * period), whole.at((k + 1.0) * period));
            Drive::Follow(SetPointMotion::between(from, to, period))
        })
    };
    let new = || branched::world(start(base), base, 0.5 * period);
    let (mut following, mut driven): (OneSystem<J>, OneSystem<J>) = (new(), new());
    let mut k = 0.0;
    while k < count {
        following.command(&drive_to(k), Vec3::zero(), &ActuatorCommand::default(), period);
        following.advance(0.5 * period).expect("stays finite");
        let efforts = following.dynamics().force.joints.map(Drive::Effort);
        following.advance(0.5 * period).expect("stays finite");
        driven.command(&efforts, Vec3::zero(), &ActuatorCommand::default(), period);
        driven.advance(period).expect("stays finite");
        k += 1.0;
    }
    let (a, b) = (following.state(), driven.state());
    largest((0..J).map(|j| (a.q[j] - b.q[j]).abs()))
}

/// A force that is constant over a period is wrong by its curvature: the difference falls with the
/// square of the period. Measured at 10 ms: 6.2e-6 held, 3.4e-6 free; slopes
/// 2.00.
#[test]
fn the_forces_found_drive_the_joints_through_the_same_motion() {
    for base in [BaseAttitude::Held, BaseAttitude::Free] {
        let apart = [0.02, 0.01, 0.005].map(|period| followed_and_driven(base, period));
        assert!(apart[1] < 1e-4, "{:e} apart", apart[1]);
        for pair in apart.windows(2) {
            let slope = (pair[0] / pair[1]).log2();
            assert!((slope - 2.0).abs() < 0.2, "slope {slope:.2}: {apart:?}");
        }
    }
}

/// Measured: 2.1e-11 of the energy with the base held, 1.0e-11 with the base free.
#[test]
fn the_work_booked_for_the_drives_is_the_energy_gained() {
    for base in BASES {
        let mut world = branched::world(start(base), base, PERIOD);
        let mut ledger = world.open_ledger();
        for k in 0..200 {
            world.command(&follow(k), Vec3::zero(), &ActuatorCommand::default(), PERIOD);
            world.advance(PERIOD).expect("stays finite");
            world.update_ledger(&mut ledger);
        }
        let [joints, actuator, outside] =
            [Source::JointDrives, Source::AttitudeActuator, Source::Applied]
                .map(|source| ledger.sources[source].work);
        assert_eq!((actuator, outside), (0.0, 0.0));
        assert!(joints.abs() > 0.1, "the drives did {joints} J only");
        let off = (ledger.now.energy - ledger.start.energy - joints).abs() / ledger.scale[2];
        assert!(off < 1e-9, "work and energy differ by {off:e} of the energy");
    }
}
