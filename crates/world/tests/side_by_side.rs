//! A world has the same bits alone and in any lane, whatever goes on in the others.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]
#![allow(clippy::unwrap_used, reason = "a failed set-up is a failed test")]

use wrasse_dynamics::{BodyId, Joint, JointKind, Payload, Robot, State};
use wrasse_hardware::{ActuatorCommand, AttitudeActuator, JointLimits, SetPoint, SetPointMotion};
use wrasse_lanes::{Level, OnAnyLevel};
use wrasse_spatial::{
    Baseline, Instructions, Lanes, Pose, SideBySide, SpatialVelocity, Sym3, Vec3, vec3,
};
use wrasse_world::{
    BaseAttitude, Drive, Equipment, FreeBody, Ledger, Stepper, World, WorldSetup, WorldsSideBySide,
};

const N: usize = 4;
const PERIOD: f64 = 0.01;

/// A base with two links; each weighs otherwise and begins otherwise.
fn world(base: BaseAttitude, i: usize) -> World<2> {
    let x = [0.0, 0.3, -0.2, 0.1][i];
    let bus = Payload::from_central(50.0 + x, Vec3::zero(), Sym3::diagonal(4.0 + x, 5.0, 6.0));
    let link =
        Payload::from_central(5.0 - x, vec3(0.4, x, 0.1), Sym3::diagonal(0.1, 0.3, 0.3 + 0.1 * x));
    let mount = Pose { translation: vec3(0.5, 0.2, 0.0), ..Pose::identity() };
    let joint = |on, axis| (Joint::new(on, JointKind::Revolute, mount, axis), link);
    let links =
        [joint(BodyId::Base, vec3(0.1, 0.3, 1.0)), joint(BodyId::Link(0), vec3(1.0, 0.0, 0.3))];
    let limited = JointLimits { effort: Some(0.35), ..JointLimits::default() };
    World::new(&WorldSetup {
        robot: &Robot::new(bus, &links).unwrap(),
        limits: &[limited, JointLimits::default()],
        actuator: Some(AttitudeActuator { torque_limit: 0.15, momentum_limit: 0.02 }),
        equipment: Equipment::default(),
        base,
        stepper: Stepper::Fixed { step: 0.004 },
        start: State {
            q: [x, 0.5],
            v: [0.2, -x],
            V_NB_B: SpatialVelocity::from_array([0.02, x, 0.03, 0.1, 0.0, -0.1]),
            ..State::default()
        },
        held: &[],
    })
}

/// Drives and torque of a period of one lane: the first joint is driven by torque, the second follows.
fn told(i: usize, period: usize) -> ([Drive; 2], Vec3<f64>) {
    let [t, x] = [period, i].map(|k| f64::from(u8::try_from(k).unwrap()));
    let at = |t: f64| SetPoint { position: 0.5 + 0.1 * t * x, rate: 0.0, acceleration: 0.0 };
    let follow = Drive::Follow(SetPointMotion::between(at(t), at(t + 1.0), PERIOD));
    ([Drive::Effort(0.2 + 0.1 * x), follow], vec3(0.1 * x, -0.2, 0.3 - 0.01 * t))
}

fn fly_alone(world: &mut World<2>, i: usize, periods: usize) -> Ledger {
    let mut ledger = world.open_ledger();
    for period in 0..periods {
        let (drives, torque_B) = told(i, period);
        world.command(&drives, torque_B, &ActuatorCommand::default(), PERIOD);
        world.advance(PERIOD).unwrap();
        world.update_ledger(&mut ledger);
    }
    ledger
}

/// Worlds side by side after some periods; one lane is given `spoilt` in place of its effort.
fn fly_together<I: Instructions>(
    worlds: &[World<2>; N],
    periods: usize,
    spoilt: Option<(usize, f64)>,
) -> (WorldsSideBySide<I, N, 2>, [Ledger; N]) {
    let mut together = WorldsSideBySide::new(&worlds.each_ref()).expect("they go side by side");
    let mut ledgers = worlds.each_ref().map(World::open_ledger);
    for period in 0..periods {
        let each: [_; N] = core::array::from_fn(|i| told(i, period));
        let effort = |i: usize| match each[i].0[0] {
            _ if spoilt.is_some_and(|(lane, _)| lane == i) => spoilt.unwrap().1,
            Drive::Effort(tau) => tau,
            Drive::Follow(_) => unreachable!("the first joint is driven by torque"),
        };
        let motion = |i: usize| match each[i].0[1] {
            Drive::Follow(motion) => motion,
            Drive::Effort(_) => unreachable!("the second joint follows"),
        };
        let drives = [
            Drive::Effort(Lanes::from_fn(effort)),
            Drive::Follow(SideBySide::side_by_side(&motion)),
        ];
        together.command(&drives, SideBySide::side_by_side(&|i| each[i].1), PERIOD);
        together.advance(PERIOD);
        together.update_ledgers(&together.state(), &mut ledgers, &[true; N]);
    }
    (together, ledgers)
}

/// Before anything is set the second joint must be known to follow.
fn begun(base: BaseAttitude) -> [World<2>; N] {
    core::array::from_fn(|i| {
        let mut world = world(base, i);
        let (drives, torque_B) = told(i, 0);
        world.command(&drives, torque_B, &ActuatorCommand::default(), PERIOD);
        world
    })
}

/// Twelve periods flown alone and beside others.
struct AloneAndTogether(BaseAttitude);

impl OnAnyLevel for AloneAndTogether {
    type Out = ();
    fn with<I: Instructions>(self) {
        let mut alone = begun(self.0);
        let (together, ledgers) = fly_together::<I>(&alone, 12, None);
        for (i, world) in alone.iter_mut().enumerate() {
            let (ledger, place) = (fly_alone(world, i, 12), (self.0, std::any::type_name::<I>()));
            assert_eq!(together.state().lane(i), world.state(), "{place:?}");
            let dynamics = together.dynamics(&together.state()).lane(i);
            assert_eq!(dynamics, world.dynamics(), "{place:?}");
            assert_eq!(ledgers[i], ledger, "{place:?}");
            assert!(together.is_finite(i));
        }
    }
}

#[test]
fn a_world_has_the_same_bits_alone_and_in_its_lane_on_every_level() {
    for base in [BaseAttitude::Free, BaseAttitude::Held, BaseAttitude::Controlled] {
        for level in Level::ALL {
            level.choose(AloneAndTogether(base));
        }
    }
}

#[test]
fn a_lane_that_breaks_down_disturbs_no_other() {
    let worlds = begun(BaseAttitude::Controlled);
    let (whole, _) = fly_together::<Baseline>(&worlds, 5, None);
    let (spoilt, _) = fly_together::<Baseline>(&worlds, 5, Some((2, f64::NAN)));
    for i in 0..N {
        assert_eq!(spoilt.is_finite(i), i != 2);
        if i != 2 {
            assert_eq!(spoilt.state().lane(i), whole.state().lane(i));
        }
    }
}

#[test]
fn worlds_that_are_moved_by_more_or_differ_in_more_do_not_go_side_by_side() {
    let goes = |change: &dyn Fn(&mut [World<2>; N])| {
        let mut worlds = begun(BaseAttitude::Free);
        change(&mut worlds);
        WorldsSideBySide::<Baseline, N, 2>::new(&worlds.each_ref()).is_some()
    };
    assert!(goes(&|_| ()));
    assert!(!goes(&|worlds| worlds[3].advance(PERIOD).unwrap()), "another time");
    assert!(!goes(&|worlds| worlds[1] = world(BaseAttitude::Held, 1)), "another base");
    let matter = Payload::from_central(1.0, Vec3::zero(), Sym3::diagonal(1.0, 1.0, 1.0));
    let body = FreeBody::new(matter, &Pose::identity(), &SpatialVelocity::zero());
    assert!(!goes(&|worlds| assert_eq!(worlds[2].add_free_body(body), 0)), "a body beside it");
}
