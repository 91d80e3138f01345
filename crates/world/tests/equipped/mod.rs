//! Wheels, CMGs and thrusters for the tests: four wheels, a pyramid of four CMGs, six thrusters
//! that push in all directions beside the centre of mass.
#![allow(dead_code, reason = "each test binary uses its own part")]

use wrasse_dynamics::{MassProperties, Robot, State};
use wrasse_hardware::{
    ActuatorCommand, Actuators, CMGS, ControlMomentGyro, List, ReactionWheel, THRUSTERS, Tank,
    Thruster, WHEELS,
};
use wrasse_spatial::{SpatialVelocity, Sym3, Vec3, vec3};
use wrasse_world::{BaseAttitude, Equipment, Stepper};
use wrasse_world_testing::{OneSystem, OneSystemSetup};

/// A wheel of 0.05 kg·m² without friction.
pub(crate) fn wheel(axis_B: Vec3<f64>) -> ReactionWheel<f64> {
    ReactionWheel {
        axis_B: axis_B * (1.0 / axis_B.norm()),
        inertia: 0.05,
        torque_limit: 0.5,
        speed_limit: 600.0,
        ..ReactionWheel::default()
    }
}

/// A CMG of 3 N·m·s with a quick servo.
pub(crate) fn cmg(gimbal_axis_B: Vec3<f64>, spin_axis_B: Vec3<f64>) -> ControlMomentGyro<f64> {
    ControlMomentGyro {
        gimbal_axis_B: gimbal_axis_B * (1.0 / gimbal_axis_B.norm()),
        spin_axis_B: spin_axis_B * (1.0 / spin_axis_B.norm()),
        momentum: 3.0,
        gimbal_inertia: 0.02,
        rate_limit: 1.0,
        acceleration_limit: 10.0,
        motor_limit: 5.0,
        servo_bandwidth: 20.0,
    }
}

/// A thruster of 4 N that rises in 6 ms and falls in 9 ms.
pub(crate) fn thruster(position_B: Vec3<f64>, direction_B: Vec3<f64>) -> Thruster<f64> {
    Thruster {
        position_B,
        direction_B: direction_B * (1.0 / direction_B.norm()),
        force: 4.0,
        minimum_on_time: 0.02,
        rise_time: 0.006,
        fall_time: 0.009,
        specific_impulse: 220.0,
        impulse_noise: 0.0,
    }
}

pub(crate) fn four_wheels() -> List<ReactionWheel<f64>, WHEELS> {
    let axes = [vec3(1.0, 0.2, 0.0), vec3(0.0, 1.0, 0.3), vec3(0.1, 0.0, 1.0), vec3(1.0, 1.0, 1.0)];
    List::new(&axes.map(|axis| ReactionWheel { coulomb: 2e-3, viscous: 1e-4, ..wheel(axis) }))
}

pub(crate) fn pyramid() -> List<ControlMomentGyro<f64>, CMGS> {
    let (s, c) = (0.8, 0.6);
    List::new(&[
        cmg(vec3(s, 0.0, c), vec3(0.0, 1.0, 0.0)),
        cmg(vec3(0.0, s, c), vec3(-1.0, 0.0, 0.0)),
        cmg(vec3(-s, 0.0, c), vec3(0.0, -1.0, 0.0)),
        cmg(vec3(0.0, -s, c), vec3(1.0, 0.0, 0.0)),
    ])
}

pub(crate) fn six_thrusters() -> List<Thruster<f64>, THRUSTERS> {
    let place = [
        (vec3(0.6, 0.3, -0.1), vec3(-1.0, 0.0, 0.0)),
        (vec3(-0.5, 0.2, 0.4), vec3(1.0, 0.0, 0.1)),
        (vec3(0.2, 0.7, 0.3), vec3(0.0, -1.0, 0.0)),
        (vec3(-0.1, -0.6, 0.2), vec3(0.0, 1.0, 0.3)),
        (vec3(0.3, 0.1, 0.8), vec3(0.0, 0.0, -1.0)),
        (vec3(0.1, -0.4, -0.7), vec3(0.2, 0.0, 1.0)),
    ];
    List::new(&place.map(|(p, d)| Thruster { impulse_noise: 0.05, ..thruster(p, d) }))
}

/// All of it, with wheels that turn and gimbals that stand askew at the start.
pub(crate) fn everything(seed: u64) -> Equipment {
    let mut equipment = Equipment { seed, ..Equipment::default() };
    equipment.actuators = Actuators {
        wheels: four_wheels(),
        cmgs: pyramid(),
        thrusters: six_thrusters(),
        tank: Some(Tank { position_B: vec3(-0.3, 0.1, 0.2), propellant: 8.0 }),
    };
    equipment.wheel_speed[..4].copy_from_slice(&[100.0, -50.0, 0.0, 200.0]);
    equipment.gimbal_angle[..4].copy_from_slice(&[0.3, -0.5, 1.1, 0.0]);
    equipment
}

/// A command that changes with the number of the period: everything does something.
pub(crate) fn busy(period: u32) -> ActuatorCommand<f64> {
    let mut command = ActuatorCommand::default();
    let way = if (period / 20).is_multiple_of(2) { 1.0 } else { -1.0 };
    command.wheel_torque[..4].copy_from_slice(&[0.2 * way, -0.3, 0.1, 0.4 * way]);
    command.gimbal_rate[..4].copy_from_slice(&[0.4, -0.2 * way, 0.7 * way, 0.1]);
    for i in 0..6 {
        let share = (period as usize + 3 * i) % 7;
        command.thruster_on[i] = [0.0, 0.0, 0.023, 0.031, 0.05, 0.05, 0.027][share];
    }
    command
}

/// A base alone: mass (kg) and central inertia (kg·m²), its centre of mass in its origin.
pub(crate) fn block(mass: f64, inertia: Sym3<f64>) -> Robot<f64, 1> {
    Robot::new(MassProperties::from_central(mass, Vec3::zero(), inertia), &[])
        .expect("a base is a robot")
}

/// A block that turns at `w` (rad/s), with equipment, in steps of `step` (s).
pub(crate) fn turning_block(
    robot: &Robot<f64, 1>,
    w: Vec3<f64>,
    equipment: &Equipment,
    step: f64,
) -> OneSystem<1> {
    OneSystem::new(&OneSystemSetup {
        robot,
        limits: &[],
        actuator: None,
        equipment: *equipment,
        base: BaseAttitude::Free,
        stepper: Stepper::Fixed { step },
        start: State { V_NB_B: SpatialVelocity::new(w, Vec3::zero()), ..State::default() },
        held: &[],
    })
}
