//! The example in C, compiled by a C compiler, gives what Rust gives.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]
#![allow(clippy::unwrap_used, reason = "a test may stop where it finds nothing")]

mod c_programs;

use c_programs::run_in_c;
use wrasse_dynamics::{Frame, State};
use wrasse_flight::trajectory::ToolMotion;
use wrasse_flight::{
    ArmLaw, ArmReference, Assignment, Axes, BaseControlSetup, ControlOutput, Feedforward, JointUse,
    Measurement, NavigationSetup, PeriodMemory, Setup, Task, Tuning, control_period,
};
use wrasse_flight_c::{WRASSE_JOINTS, WrasseFlight};
use wrasse_hardware::{JointLimits, List};
use wrasse_spatial::{Mat3, Pose, Quat, SpatialVelocity, vec3};
use wrasse_testing::largest;
use wrasse_vehicle::{JOINTS, Vehicle, catalogue};

fn atlas_class() -> Vehicle {
    catalogue().iter().find(|entry| entry.name == "atlas-class").unwrap().read().unwrap()
}

/// The same two periods in Rust, with the robot of the catalogue.
fn in_rust() -> ControlOutput<f64, JOINTS> {
    let vehicle = atlas_class();
    let robot: &wrasse_vehicle::VehicleRobot = &vehicle.robot;
    let tool: Frame<f64> = vehicle.frame(&vehicle.tools[0]).unwrap();
    let setup = Setup {
        assignment: Assignment {
            tool,
            axes: Axes::Inertial,
            task: Task::Pose,
            law: ArmLaw::AttitudeHeld,
            damped_below: 0.02,
        },
        joints: JointUse {
            gain: 0.0,
            gain_rate: 0.0,
            posture: [0.0; JOINTS],
            rate_limit: [0.2; JOINTS],
        },
        base: BaseControlSetup::ideal(Feedforward::Exact, Quat::identity()),
        navigation: NavigationSetup::perfect(),
        measurement: Measurement::Base,
        tuning: Tuning {
            period: 0.01,
            tool_gain: 2.0,
            joint_bandwidth: 10.0,
            joint_damping: 1.0,
            attitude_bandwidth: 0.3,
            attitude_damping: 1.0,
        },
        limits: [JointLimits { effort: Some(500.0), ..JointLimits::default() }; JOINTS],
        position_driven: [false; JOINTS],
        followers: List::empty(),
    };
    let mut state = State::default();
    state.V_NB_B.angular = vec3(0.001, -0.002, 0.0005);
    for (j, q) in [0.2, -0.6, -0.6, 1.9, -0.3, -1.3, 0.4].into_iter().enumerate() {
        state.q[j] = q;
        state.v[j] = 0.01 * (f64::from(u8::try_from(j).unwrap()) - 3.0);
    }
    let mut memory = PeriodMemory::new();
    control_period(robot, &setup, &mut memory, &state, &ArmReference::Still, None);
    let reference = ToolMotion {
        X_NE: Pose::new(Mat3::identity(), vec3(1.5, 0.4, 0.1)),
        V_NE_N: SpatialVelocity::from_array([0.0, 0.0, 0.0, 0.05, 0.0, 0.0]),
        Vdot_NE_N: SpatialVelocity::zero(),
    };
    let asked = ArmReference::Tool { reference, axes: Axes::Inertial, gain: 0.0, gain_rate: 0.0 };
    control_period(robot, &setup, &mut memory, &state, &asked, None)
}

/// Round-off of a control period: the table holds central inertias, the catalogue those about the
/// origin. Measured 0 of the largest of each kind.
#[test]
fn the_example_in_c_is_told_what_rust_is_told() {
    let Some(printed) = run_in_c("one_period", &[]) else { return };
    let rows: Vec<Vec<f64>> = printed
        .lines()
        .map(|line| line.split(' ').map(|word| word.parse().unwrap()).collect())
        .collect();
    let told = in_rust();
    let mut expected: Vec<Vec<f64>> = (0..7)
        .map(|j| vec![told.set_points[j].position, told.set_points[j].rate, told.effort[j]])
        .collect();
    expected.push(told.attitude_torque_B.to_array().to_vec());
    assert_eq!(rows.len(), expected.len(), "{printed}");
    for kind in 0..3 {
        let size = largest(expected[..7].iter().map(|row| row[kind].abs()));
        let apart = largest((0..8).map(|k| (rows[k][kind] - expected[k][kind]).abs()));
        assert!(size > 1e-3 && apart <= 1e-12 * size, "column {kind}: {apart:e} of {size}");
    }
}

#[test]
fn the_memory_that_c_gives_is_as_large_as_the_header_says() {
    assert_eq!((size_of::<WrasseFlight>(), WRASSE_JOINTS), (32 * 1024, 14));
}
