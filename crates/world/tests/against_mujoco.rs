//! The motion of coasting free-flyers against another engine: MuJoCo, whose numbers
//! `validation/tools/mujoco_coast.py` made.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

use serde_json::Value;
use std::path::{Path, PathBuf};
use wrasse_dynamics::State;
use wrasse_hardware::ActuatorCommand;
use wrasse_spatial::{Pose, Quat, SpatialVelocity, Vec3};
use wrasse_testing::largest;
use wrasse_vehicle::{JOINTS, Vehicle, read_vehicle};
use wrasse_world::{BaseAttitude, Drive, Equipment, Stepper};
use wrasse_world_testing::{OneSystem, OneSystemSetup};

fn validation() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../validation")
}

fn numbers<const N: usize>(value: &Value) -> [f64; N] {
    std::array::from_fn(|i| value[i].as_f64().expect("a number"))
}

/// MuJoCo gives the velocity of the base's origin in inertial axes, wrasse has it in base axes.
fn state_of(vehicle: &Vehicle, value: &Value) -> State<f64, JOINTS> {
    let [w, x, y, z] = numbers(&value["attitude_wxyz"]);
    let R_NB = Quat { w, x, y, z }.normalized().to_matrix();
    let velocity_N = Vec3::from_array(numbers(&value["velocity_in_inertial_axes"]));
    let mut state = State {
        X_NB: Pose::new(R_NB, Vec3::from_array(numbers(&value["position"]))),
        V_NB_B: SpatialVelocity::new(
            Vec3::from_array(numbers(&value["angular_velocity_in_base_axes"])),
            R_NB.transpose_mul(velocity_N),
        ),
        ..State::default()
    };
    for (j, name) in vehicle.joint_names.iter().enumerate() {
        let joint = &value["joints"][name];
        state.q[j] = joint["position"].as_f64().expect("a position");
        state.v[j] = joint["velocity"].as_f64().expect("a rate");
    }
    state
}

/// Largest difference of two states: attitude (rad), position (m), rates and velocities.
fn difference(a: &State<f64, JOINTS>, b: &State<f64, JOINTS>) -> f64 {
    let turn = Quat::from_matrix(&(a.X_NB.rotation.transpose() * b.X_NB.rotation)).log().norm();
    let shift = (a.X_NB.translation - b.X_NB.translation).norm();
    let twist = (a.V_NB_B - b.V_NB_B).to_array();
    let joints = a.q.iter().zip(&b.q).chain(a.v.iter().zip(&b.v)).map(|(x, y)| x - y);
    largest(twist.into_iter().chain(joints).chain([turn, shift]).map(f64::abs))
}

/// MuJoCo's own error at its finest step is about a fifteenth of the last spread that the data name
/// (order four); 1e-12 is left for rounding. Measured: 3.3e-14, 3.2e-14 and 5.7e-12, the last of which
/// is MuJoCo's error of 7e-12.
#[test]
fn coasting_free_flyers_move_as_mujoco_has_it() {
    let text = std::fs::read_to_string(validation().join("mujoco_coast.json")).expect("the data");
    let data: Value = serde_json::from_str(&text).expect("JSON");
    let cases = data["cases"].as_array().expect("cases");
    assert_eq!(cases.len(), 3);
    for case in cases {
        let file = validation().join(case["vehicle"].as_str().expect("a file"));
        let urdf = std::fs::read_to_string(&file).expect("the vehicle");
        let vehicle = read_vehicle(&file, urdf).expect("a sound vehicle");
        let mut world: OneSystem<JOINTS> = OneSystem::new(&OneSystemSetup {
            robot: &vehicle.robot,
            limits: &[],
            actuator: None,
            equipment: Equipment::default(),
            base: BaseAttitude::Free,
            stepper: Stepper::Adaptive { tolerance: 1e-13 },
            start: state_of(&vehicle, &case["start"]),
            held: &[],
        });
        let duration = case["duration_s"].as_f64().expect("a duration");
        world.command(
            &[Drive::Effort(0.0); JOINTS],
            Vec3::zero(),
            &ActuatorCommand::default(),
            duration,
        );
        world.advance(duration).expect("it stays finite");
        let off = difference(&world.state(), &state_of(&vehicle, &case["end"]));
        let spread = case["spread_of_coarser_steps"][1].as_f64().expect("a spread");
        assert!(off < 1e-12 + spread / 7.0, "{}: {off:.1e}", case["vehicle"]);
    }
}
