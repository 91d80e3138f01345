//! The real-time claim: a control period of the flight computer does not touch the heap.

use crate::allocation::bench;
use crate::laws::flights::{Flight, aside, at_rest, drifting, robot, setup};
use std::hint::black_box;
use wrasse_dynamics::{BodyId, Configuration, Frame, kinematics};
use wrasse_flight::allocation::{
    AllocationSetup, Allocator, CmgLaw, CmgSharing, Damping, Unit, Waves, WheelLaw, WheelSharing,
    cmg_rates, preferred_angles, wheel_torques,
};
use wrasse_flight::{
    Actuation, ArmLaw, ArmTask, Assignment, Axes, BaseReading, Condition, EstimatorSetup,
    FlightComputer, Grip, Held, JointReading, JointTarget, JointTiming, Measurement,
    NavigationSetup, Next, NoWay, Phase, PositionHold, Sensed, SensedSignal, Step, Task,
};
use wrasse_hardware::{
    ActuatorReadings, CMGS, ControlMomentGyro, RateGyro, ReactionWheel, StarTracker,
    TrackerReading, WHEELS,
};
use wrasse_spatial::{Pose, Quat, SpatialForce, Vec3, vec3};
use wrasse_testing::allocations;

fn to_tool_pose(X: Pose<f64>) -> Phase<f64, 7> {
    let to = JointTarget::Tool(X, Axes::Base);
    Phase::MoveJoints { to, timing: JointTiming::Duration(0.2) }
}

#[test]
fn the_counter_sees_an_allocation() {
    assert_eq!(allocations(|| drop(black_box(Box::new(1)))), 2, "one box made, one dropped");
}

/// Each kind of phase, inverse kinematics included, by each law.
#[test]
fn a_control_period_allocates_nothing() {
    for law in [ArmLaw::Terrestrial, ArmLaw::AttitudeHeld, ArmLaw::FreeFloating] {
        let setup = setup(law, Measurement::Base);
        let base = wrasse_dynamics::State { X_NB: Pose::identity(), ..at_rest() };
        let mut X = kinematics(&robot(), &base).pose(&setup.assignment.tool);
        X.translation += vec3(0.02, 0.05, 0.03);
        let phases = [
            aside(Axes::Inertial, 0.2),
            Phase::Hold { what: Held::Tool, duration: 0.1 },
            to_tool_pose(X),
            Phase::Grip { action: Grip::Grasp(0), keep: Held::Joints },
            Phase::Hold { what: Held::Nothing, duration: 0.1 },
            Phase::Hold { what: Held::Joints, duration: 0.1 },
        ];
        let (mut flight, same) = (Flight::new(&setup, drifting(), &phases), robot());
        let mut place = Configuration::new();
        let calls = allocations(|| {
            while !flight.computer.done() {
                black_box(flight.step().unwrap());
                black_box(flight.computer.believed_tool_error());
                black_box(flight.computer.task_jacobian(&mut place));
            }
            flight.computer.robot_changed(&same);
        });
        assert_eq!(calls, 0, "{law:?}");
    }
}

/// Two tools at once, and steps that end by conditions, timeouts and faults.
#[test]
fn steps_of_several_arms_allocate_nothing() {
    let setup = setup(ArmLaw::FreeFloating, Measurement::Base);
    let elbow = Assignment {
        tool: Frame { body: BodyId::Link(3), X_BF: Pose::identity() },
        task: Task::Position,
        ..setup.assignment
    };
    let (line, still) = (aside(Axes::Inertial, 0.5), Held::Tool);
    let keep = Phase::Hold { what: still, duration: 0.5 };
    let both = [
        Some(ArmTask { motion: line, assignment: None }),
        Some(ArmTask { motion: keep, assignment: Some(elbow) }),
        None,
    ];
    let beyond = Condition::Beyond { signal: SensedSignal::ToolForce, above: true, bound: 1.0 };
    let reached = Condition::Reached { distance: 1e-9, angle: 1e-9 };
    let mut steps = [Step::from(line); 3];
    steps[0].tasks = both;
    for (step, until, next) in [(1, beyond, 1), (2, reached, 0)] {
        steps[step].until = until;
        steps[step].timeout = Some(0.2);
        steps[step].attempts = Some(2);
        steps[step].on_exhausted = Some(Next::InOrder);
        steps[step].on_fault = Some(Next::Step(next));
    }
    let mut flight = Flight::with(FlightComputer::new(setup, &robot(), &steps), drifting());
    let mut begun = 0;
    let calls = allocations(|| {
        while !flight.computer.done() && begun < 20 {
            begun += usize::from(black_box(flight.step().unwrap()).begins);
        }
    });
    assert_eq!(calls, 0);
    // Both; twice at the force, which nobody feels; there and back as often as attempts allow.
    assert!((5..20).contains(&begun), "{begun} steps");
}

/// Damped least squares tries in vain, and still nothing is allocated.
#[test]
fn a_refusal_allocates_nothing() {
    let away = Pose { translation: vec3(9.0, 0.0, 0.0), ..Pose::identity() };
    let setup = setup(ArmLaw::AttitudeHeld, Measurement::None);
    let mut flight = Flight::new(&setup, at_rest(), &[to_tool_pose(away)]);
    let calls = allocations(|| {
        let bad = flight.step().unwrap_err();
        assert!(matches!(bad.reason, NoWay::Unreachable(_)));
    });
    assert_eq!(calls, 0);
}

/// All wheels, at a speed limit too, so that they share more than once.
#[test]
fn wheel_allocation_allocates_nothing() {
    let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.6, 0.0, 0.8]];
    let wheels = axes.map(|[x, y, z]| ReactionWheel {
        axis_B: vec3(x, y, z),
        inertia: 0.1,
        torque_limit: 0.2,
        speed_limit: 600.0,
        ..Default::default()
    });
    let speeds = [600.0, 20.0, -300.0, 100.0, 0.0, 0.0, 0.0, 0.0];
    for sharing in [WheelSharing::PseudoInverse, WheelSharing::MinimumPeak] {
        let law = WheelLaw { sharing, null_gain: 0.1 };
        let wanted = vec3(0.1, -0.2, 0.3);
        let calls = allocations(|| {
            black_box(wheel_torques(&wheels, &[true; WHEELS], &law, wanted, &speeds, 0.01));
        });
        assert_eq!(calls, 0, "{sharing:?}");
    }
}

/// Steering by each law, and the search for angles to start from.
#[test]
fn cmg_steering_allocates_nothing() {
    let mounted = [([0.8, 0.6], 1.0), ([-0.8, 0.6], -1.0)];
    let cmgs = mounted.map(|([x, z], y)| ControlMomentGyro {
        gimbal_axis_B: vec3(x, 0.0, z),
        spin_axis_B: vec3(0.0, y, 0.0),
        momentum: 15.0,
        rate_limit: 1.0,
        ..Default::default()
    });
    let (damping, waves) = (Damping { k0: 0.01, fading: 10.0 }, Waves::default());
    for sharing in [
        CmgSharing::PseudoInverse,
        CmgSharing::SingularityRobust(damping),
        CmgSharing::GeneralizedSingularityRobust(damping, waves),
    ] {
        let law = CmgLaw { sharing, null_gain: 0.1 };
        let (wanted, angles) = (vec3(1.0, -2.0, 3.0), [0.3; CMGS]);
        let calls = allocations(|| {
            black_box(cmg_rates(&cmgs, &[true; CMGS], &law, wanted, &angles, 1.5));
        });
        assert_eq!(calls, 0, "{sharing:?}");
    }
    let calls = allocations(|| {
        assert!(preferred_angles(&cmgs, vec3(0.0, 1.0, 0.0)).is_some());
    });
    assert_eq!(calls, 0);
}

/// Everything that turns or pushes the base, by the laws that work hardest.
fn all_groups() -> AllocationSetup<f64> {
    let all = bench::actuators(&bench::wheels(0.2), &bench::cmgs(), &bench::thrusters(22.0));
    let (damping, waves) = (Damping { k0: 0.01, fading: 10.0 }, Waves::default());
    AllocationSetup {
        wheels: WheelLaw { sharing: WheelSharing::MinimumPeak, null_gain: 0.1 },
        cmgs: CmgLaw {
            sharing: CmgSharing::GeneralizedSingularityRobust(damping, waves),
            null_gain: 0.1,
        },
        desaturation: Some(bench::desaturation()),
        ..bench::setup(&all)
    }
}

/// More is wanted than there is, wheels and CMGs are desaturated, a wheel is lost, a reading is NaN.
#[test]
fn steering_all_groups_allocates_nothing() {
    let mut allocator = Allocator::new(&all_groups());
    let demand = bench::demand([30.0, -20.0, 10.0], [5.0, 0.0, -8.0]);
    let wheel_speed = [400.0, 600.0, -300.0, f64::NAN, 0.0, 0.0, 0.0, 0.0];
    let readings = ActuatorReadings { wheel_speed, ..ActuatorReadings::default() };
    let calls = allocations(|| {
        for _ in 0..20 {
            assert!(black_box(allocator.allocate(&demand, &readings)).report.desaturation);
        }
        allocator.disable(Unit::Wheel(0));
        allocator.reset();
        black_box(allocator.allocate(&demand, &readings));
    });
    assert_eq!(calls, 0);
}

/// A control period with estimates, all groups, position hold and a push at the tool.
#[test]
fn a_control_period_with_sensors_and_actuators_allocates_nothing() {
    let mut setup = setup(ArmLaw::AttitudeHeld, Measurement::Base);
    setup.base.actuation = Actuation::Fitted(all_groups());
    setup.base.position_hold = Some(PositionHold { bandwidth: 0.1, damping: 1.0 });
    let quat_NB = Quat::from_matrix(&at_rest().X_NB.rotation);
    let attitude = EstimatorSetup {
        gyro: RateGyro::default(),
        tracker: StarTracker { boresight_B: vec3(1.0, 0.0, 0.0), ..StarTracker::default() },
        start_attitude_sigma: 1e-3,
        start_bias_sigma: 1e-5,
    };
    setup.navigation = NavigationSetup { attitude: Some(attitude), joint_bandwidth: 20.0, quat_NB };
    let phases = [aside(Axes::Inertial, 0.2)];
    let mut computer = FlightComputer::new(setup, &robot(), &phases);
    let sensed = Sensed {
        base: BaseReading::Felt {
            rate_B: Vec3::zero(),
            tracker: Some(TrackerReading { quat_NB, age: 0.0 }),
            p_NB_N: at_rest().X_NB.translation,
            v_NB_N: Vec3::zero(),
        },
        joints: JointReading::Encoders(at_rest().q),
        actuators: ActuatorReadings::default(),
        tool_wrench_E: Some(SpatialForce::new(vec3(1.0, 2.0, 3.0), vec3(10.0, 20.0, -30.0))),
        grip: None,
    };
    let calls = allocations(|| {
        while !computer.done() {
            black_box(computer.step(&sensed).unwrap());
        }
    });
    assert_eq!(calls, 0);
}
