//! Control moment gyros: against closed forms, and against gimbals and rotors as links of a
//! multibody.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

mod equipped;

use equipped::{block, cmg, turning_block};
use wrasse_dynamics::{BodyId, Joint, JointKind, MassProperties, Robot, State};
use wrasse_hardware::{ActuatorCommand, CMGS, ControlMomentGyro, List, SetPoint, SetPointMotion};
use wrasse_spatial::{Mat3, Pose, SpatialVelocity, Sym3, Vec3, vec3};
use wrasse_testing::larger;
use wrasse_world::{BaseAttitude, Drive, Equipment, Failure, Saturation, Stepper};
use wrasse_world_testing::{OneSystem, OneSystemSetup};

const PERIOD: f64 = 0.01;

fn told(rate: &[f64]) -> ActuatorCommand<f64> {
    let mut command = ActuatorCommand::default();
    command.gimbal_rate[..rate.len()].copy_from_slice(rate);
    command
}

fn cmgs(list: &[ControlMomentGyro<f64>]) -> Equipment {
    let mut equipment = Equipment::default();
    equipment.actuators.cmgs = List::new(list);
    equipment
}

/// Gimbal about z, spin along x at zero angle.
fn upright() -> ControlMomentGyro<f64> {
    cmg(vec3(0.0, 0.0, 1.0), vec3(1.0, 0.0, 0.0))
}

fn run(world: &mut OneSystem<1>, periods: usize, rate: &[f64]) -> Vec<Saturation> {
    let mut cut = Vec::new();
    for _ in 0..periods {
        cut.extend(world.command(&[], Vec3::zero(), &told(rate), PERIOD));
        world.advance(PERIOD).expect("stays finite");
    }
    cut
}

/// A base that turns loads the gimbal motor: 60 N·m·s at 2 mrad/s is 0.12 N·m. The base is so heavy
/// that it turns evenly: it gathers 2.4e-12 N·m of it, as measured.
#[test]
fn the_gimbal_motor_carries_the_rotor_along_with_the_base() {
    let robot = block(1e9, Sym3::diagonal(1e9, 1e9, 1e9));
    let big = ControlMomentGyro { momentum: 60.0, ..upright() };
    let mut world = turning_block(&robot, vec3(0.0, 2e-3, 0.0), &cmgs(&[big]), 1e-2);
    run(&mut world, 10, &[0.0]);
    let torque = world.gimbal_motor_torque()[0];
    assert!((torque + 0.12).abs() < 1e-11, "{torque}");
}

/// A motor too weak for that load gives way: the gimbal is turned by what the motor lacks.
#[test]
fn a_gimbal_motor_that_is_too_weak_gives_way_and_says_so() {
    let robot = block(1e9, Sym3::diagonal(1e9, 1e9, 1e9));
    let weak = ControlMomentGyro { momentum: 60.0, motor_limit: 0.1, ..upright() };
    let mut world = turning_block(&robot, vec3(0.0, 2e-3, 0.0), &cmgs(&[weak]), 1e-3);
    assert_eq!(run(&mut world, 1, &[0.0]), [Saturation::GimbalMotor(0)]);
    let (found, expected) = (world.actuator_readings().gimbal_rate[0], 0.02 / 0.02 * PERIOD);
    let off = (found / expected - 1.0).abs();
    // As the gimbal turns the load falls with its cosine. Measured 4.5e-9.
    assert!(off < 1e-8, "{off:e}");
    // The base's own acceleration is not in what the motor can: 0.02 kg·m² of it, 2e-12 N·m here.
    assert!((world.gimbal_motor_torque()[0] + 0.1).abs() < 1e-11);
}

#[test]
fn a_gimbal_gathers_speed_by_its_servo_within_its_limits() {
    let robot = block(1e9, Sym3::diagonal(1e9, 1e9, 1e9));
    let mut world = turning_block(&robot, Vec3::zero(), &cmgs(&[upright()]), 1e-3);
    assert_eq!(run(&mut world, 10, &[0.2]), []);
    // First-order servo of 20 rad/s: far below 10 rad/s². Measured off, in steps of 1 ms: 4e-10.
    let found = world.actuator_readings();
    let lag = (1.0 - f64::exp(-2.0)) / 20.0;
    let off_rate = (found.gimbal_rate[0] / (0.2 * (1.0 - f64::exp(-2.0))) - 1.0).abs();
    let off_angle = (found.gimbal_angle[0] / (0.2 * (0.1 - lag)) - 1.0).abs();
    assert!(off_rate < 1e-8 && off_angle < 1e-8, "{off_rate:e} {off_angle:e}");

    let mut world = turning_block(&robot, Vec3::zero(), &cmgs(&[upright()]), 1e-3);
    assert_eq!(run(&mut world, 1, &[-7.0]), [Saturation::GimbalRate(0)]);
    // 20 rad/s times 1 rad/s is more than 10 rad/s².
    let off = (world.actuator_readings().gimbal_rate[0] / (-10.0 * PERIOD) - 1.0).abs();
    assert!(off < 1e-13, "{off:e}");
    run(&mut world, 200, &[-7.0]);
    let off = (world.actuator_readings().gimbal_rate[0] + 1.0).abs();
    assert!(off < 1e-12, "{off:e}");
}

/// What the rotor has less, the base has more. Measured off: 8e-19 N·m·s of 3.
#[test]
fn a_gimbal_that_turns_hands_the_rotors_momentum_to_the_base() {
    let robot = block(50.0, Sym3::diagonal(40.0, 50.0, 60.0));
    let mut world = turning_block(&robot, Vec3::zero(), &cmgs(&[upright()]), 1e-3);
    run(&mut world, 20, &[0.3]);
    let (readings, state) = (world.actuator_readings(), world.state());
    let (sin, cos) = f64::sin_cos(readings.gimbal_angle[0]);
    let in_cmg = vec3(3.0 * cos, 3.0 * sin, 0.02 * readings.gimbal_rate[0]);
    let w = state.V_NB_B.angular;
    let of_base = vec3(40.0 * w.x, 50.0 * w.y, 60.0 * w.z);
    let off = (state.X_NB.rotation * (in_cmg + of_base) - vec3(3.0, 0.0, 0.0)).norm();
    assert!(off < 1e-13, "{off:e}");
    assert!(of_base.y < -0.1);
}

/// Measured: the jump of the base off by 2e-16; rests of 0 N·m·s, and 1.9e-11 J of the quadrature.
#[test]
fn a_stuck_gimbal_stands_still_at_once_and_its_momentum_is_the_bases() {
    let robot = block(50.0, Sym3::diagonal(4.0, 5.0, 6.0));
    let heavy = ControlMomentGyro { gimbal_inertia: 0.5, ..upright() };
    let mut world = turning_block(&robot, Vec3::zero(), &cmgs(&[heavy]), 1e-3);
    let mut ledger = world.open_ledger();
    run(&mut world, 20, &[0.5]);
    let (rate, before) = (world.actuator_readings().gimbal_rate[0], world.state().V_NB_B.angular);
    world.fail(Failure::Gimbal(0));
    let jump = world.state().V_NB_B.angular - before;
    let off = (jump.z / (0.5 * rate / 6.0) - 1.0).abs();
    assert!(rate > 0.2 && off < 1e-12, "{off:e}");
    assert_eq!(run(&mut world, 20, &[0.5]), []);
    assert_eq!(world.actuator_readings().gimbal_rate[0], 0.0);
    assert_eq!(world.gimbal_motor_torque()[0], 0.0);
    world.fail(Failure::Gimbal(CMGS));
    world.update_ledger(&mut ledger);
    let [angular, _, energy] = ledger.residuals();
    assert!(angular < 1e-13 && energy < 1e-10, "{angular:e} {energy:e}");
}

/// Two CMGs of 60 N·m·s on an arm's base, as they are built: each rotor (0.1 kg·m² about its axis)
/// in a gimbal.
const MOMENTUM: f64 = 60.0;
const ROTOR: f64 = 0.1;
/// Rotor and gimbal about the gimbal axis, and across both axes (kg·m²).
const ABOUT_GIMBAL: f64 = 0.12;

fn mounts() -> [(Vec3<f64>, Vec3<f64>); 2] {
    [(vec3(0.8, 0.0, 0.6), vec3(0.0, 1.0, 0.0)), (vec3(0.0, 0.6, 0.8), vec3(1.0, 0.0, 0.0))]
}

/// Matter of a gimbal with its rotor standing still: `odd` (kg·m²) more about the spin axis than
/// across it.
fn gimbal_matter(odd: f64) -> Sym3<f64> {
    Sym3::diagonal(0.15 + odd, 0.15, ABOUT_GIMBAL)
}

/// Axes of a gimbal at angle zero: x along the spin axis, z along the gimbal axis.
fn mount_pose((g, s): (Vec3<f64>, Vec3<f64>)) -> Pose<f64> {
    Pose::new(Mat3::from_columns(s, g.cross(s), g), g * 0.3)
}

fn bus() -> MassProperties<f64> {
    MassProperties::from_central(400.0, vec3(0.1, 0.0, -0.1), Sym3::diagonal(900.0, 1100.0, 1200.0))
}

fn flying<const J: usize>(
    robot: &Robot<f64, J>,
    v: [f64; J],
    equipment: &Equipment,
) -> OneSystem<J> {
    OneSystem::new(&OneSystemSetup {
        robot,
        limits: &[],
        actuator: None,
        equipment: *equipment,
        base: BaseAttitude::Free,
        stepper: Stepper::Fixed { step: 1e-3 },
        start: State {
            V_NB_B: SpatialVelocity::from_array([0.02, -0.03, 0.01, 0.0, 0.0, 0.0]),
            v,
            ..State::default()
        },
        held: &[],
    })
}

/// Gimbals as links, rotors as links on them.
fn as_links(odd: f64) -> OneSystem<4> {
    let mut links = vec![];
    for mount in mounts() {
        // The rotor alone is round; the gimbal has the rest.
        let rotor = Sym3::diagonal(ROTOR, 0.06, 0.06);
        let gimbal = gimbal_matter(odd) - rotor;
        let revolute = |parent, X, axis| Joint::new(parent, JointKind::Revolute, X, axis);
        let on = BodyId::Link(links.len());
        links.push((
            revolute(BodyId::Base, mount_pose(mount), vec3(0.0, 0.0, 1.0)),
            MassProperties::from_central(3.0, Vec3::zero(), gimbal),
        ));
        links.push((
            revolute(on, Pose::identity(), vec3(1.0, 0.0, 0.0)),
            MassProperties::from_central(12.0, Vec3::zero(), rotor),
        ));
    }
    let robot = Robot::new(bus(), &links).expect("four joints fit");
    flying(&robot, [0.0, MOMENTUM / ROTOR, 0.0, MOMENTUM / ROTOR], &Equipment::default())
}

/// The CMGs as equipment; their matter is the bus's.
fn as_equipment(odd: f64) -> OneSystem<1> {
    let mut bus = bus();
    let mut list = vec![];
    for mount in mounts() {
        let matter = MassProperties::from_central(15.0, Vec3::zero(), gimbal_matter(odd));
        bus = bus.and(&matter.seen_from(&mount_pose(mount)));
        list.push(ControlMomentGyro {
            momentum: MOMENTUM,
            gimbal_inertia: ABOUT_GIMBAL,
            motor_limit: 100.0,
            rate_limit: 2.0,
            acceleration_limit: 1e3,
            ..cmg(mount.0, mount.1)
        });
    }
    let robot = Robot::new(bus, &[]).expect("a base is a robot");
    flying(&robot, [0.0], &cmgs(&list))
}

/// How far the rate of the base goes apart in a second in which the gimbals gather 1 rad/s, relative
/// to that rate; and the torques of the gimbal motors, relative to the larger (–).
fn apart(odd: f64) -> (f64, f64) {
    let (mut links, mut equipment) = (as_links(odd), as_equipment(odd));
    let seen = |world: &OneSystem<1>| {
        let readings = world.actuator_readings();
        core::array::from_fn::<_, 2, _>(|i| SetPoint {
            position: readings.gimbal_angle[i],
            rate: readings.gimbal_rate[i],
            acceleration: 0.0,
        })
    };
    let wanted = [1.0, -1.0];
    let (period, spin) = (1e-3, MOMENTUM / ROTOR);
    let (mut worst, mut worst_torque) = (0.0_f64, 0.0_f64);
    for n in 0..1000 {
        let at = |mut points: [SetPoint<f64>; 2]| {
            // The servo's law, for the curve between two instants.
            for (point, wanted) in points.iter_mut().zip(wanted) {
                point.acceleration = 20.0 * (wanted - point.rate);
            }
            points
        };
        let from = at(seen(&equipment));
        equipment.command(&[], Vec3::zero(), &told(&wanted), period);
        equipment.advance(period).expect("stays finite");
        let to = at(seen(&equipment));
        let turned = |n: i32| SetPoint {
            position: spin * period * f64::from(n),
            rate: spin,
            acceleration: 0.0,
        };
        let rotor = Drive::Follow(SetPointMotion::between(turned(n), turned(n + 1), period));
        let gimbal = |i: usize| Drive::Follow(SetPointMotion::between(from[i], to[i], period));
        let drives = [gimbal(0), rotor, gimbal(1), rotor];
        links.command(&drives, Vec3::zero(), &ActuatorCommand::default(), period);
        links.advance(period).expect("stays finite");
        let (full, found) = (links.state().V_NB_B.angular, equipment.state().V_NB_B.angular);
        worst = larger(worst, (full - found).norm() / found.norm());
        let (torques, force) = (equipment.gimbal_motor_torque(), links.dynamics().force.joints);
        let off = larger((force[0] - torques[0]).abs(), (force[2] - torques[1]).abs());
        worst_torque = larger(worst_torque, off / larger(torques[0].abs(), torques[1].abs()));
    }
    (worst, worst_torque)
}

/// Where rotor and gimbal together are round about the gimbal axis the reduced model is exact. Where
/// they are not, it leaves out the change of the base's inertia as the gimbal turns: in momentum that
/// is what they are odd times the rate of the base, relative to the rotor's. Measured apart, with
/// 60 N·m·s at 1 rad/s: round 6e-13 in the rate and 7e-13 in the motors' torque; odd by 0.004 kg·m²
/// 3.5e-6 and 5.0e-6; odd by half of that 1.75e-6 and 2.5e-6.
#[test]
fn cmgs_move_the_base_as_gimbals_and_rotors_of_a_multibody_do() {
    let (round, round_torque) = apart(0.0);
    assert!(round < 1e-11 && round_torque < 1e-11, "{round:e} {round_torque:e}");
    let (odd, odd_torque) = apart(0.004);
    assert!(odd < 5e-6 && odd_torque < 1e-5, "{odd:e} {odd_torque:e}");
    let (half, half_torque) = apart(0.002);
    let (ratio, ratio_torque) = (odd / half, odd_torque / half_torque);
    assert!((ratio - 2.0).abs() < 0.01 && (ratio_torque - 2.0).abs() < 0.01, "{ratio}");
}
