//! Accelerations and torques that go with the set-points.

use super::tours::*;
use crate::laws::flights::{PERIOD, at_rest, drifting, robot, setup};
use wrasse_dynamics::{
    BaseMode, Generalized, JointDrive, PerBody, Robot, State, driven_dynamics, kinematics,
    mass_matrix, momentum,
};
use wrasse_flight::{
    Actuation, ArmLaw, Axes, Command, FlightComputer, Held, Measurement, Phase, Sensed,
    attitude_acceleration,
};
use wrasse_hardware::{ActuatorReadings, SetPoint};
use wrasse_spatial::{Quat, SpatialForce, SpatialVelocity, Vec3, vec3};
use wrasse_testing::Worst;

/// Largest gap between the rates of a law that takes the base for fixed and the trapezium of its
/// accelerations (rad/s), while the tool is held and the base really moves.
fn gap_over_unexpected(V_NB_B: SpatialVelocity<f64>) -> Worst {
    let phases = [Phase::Hold { what: Held::Tool, duration: 1.0 }];
    let setup = setup(ArmLaw::Terrestrial, Measurement::Base);
    let mut computer = FlightComputer::new(setup, &robot(), &phases);
    let mut state = State { V_NB_B, ..at_rest() };
    let (mut commands, mut worst) = (vec![], Worst::none());
    while !computer.done() {
        commands
            .push(computer.step(&Sensed::perfect(&state, ActuatorReadings::default())).unwrap());
        let R = state.X_NB.rotation;
        let half = Quat::exp(V_NB_B.angular * (0.5 * PERIOD)).to_matrix();
        state.X_NB.rotation = R * Quat::exp(V_NB_B.angular * PERIOD).to_matrix();
        state.X_NB.translation += R * half * V_NB_B.linear * PERIOD;
    }
    for j in 0..7 {
        // The first period joins the rates of before.
        for pair in of_joint(&at_rest(), &commands, j)[2..].windows(2) {
            let gain = PERIOD * (pair[0].acceleration + pair[1].acceleration) / 2.0;
            worst.see((pair[1].rate - pair[0].rate - gain).abs());
        }
    }
    worst
}

/// How the tool's error grows by it is counted: measured 8.9e-8 rad/s. How the Jacobian turns by it is
/// not: 5.5e-5 rad/s while the base turns at 0.037 rad/s.
#[test]
fn accelerations_know_of_base_motion_that_the_law_does_not_expect() {
    let linear = vec3(0.02, -0.01, 0.03);
    gap_over_unexpected(SpatialVelocity::new(Vec3::zero(), linear)).is_below(1e-6);
    gap_over_unexpected(SpatialVelocity::new(vec3(0.01, -0.02, 0.03), linear)).is_below(1e-4);
}

/// Integrates the arm under a command: torques constant over the period.
fn driven(
    robot: &Robot<f64, 7>,
    state: &State<f64, 7>,
    command: &Command<f64, 7>,
    base: BaseMode,
) -> State<f64, 7> {
    let drives = command.effort.map(JointDrive::Effort);
    let steps = 4;
    let h = PERIOD / f64::from(steps);
    let nothing = PerBody::filled(SpatialForce::zero());
    let rates =
        |s: &State<f64, 7>| driven_dynamics(&kinematics(robot, s), &drives, base, &nothing).nudot;
    let on = |s: &State<f64, 7>,
              at: &State<f64, 7>,
              a: &Generalized<SpatialVelocity<f64>, f64, 7>,
              h| {
        let mut next = *s;
        for j in 0..7 {
            next.q[j] += at.v[j] * h;
            next.v[j] += a.joints[j] * h;
        }
        let V = at.V_NB_B;
        next.X_NB.rotation = s.X_NB.rotation * Quat::exp(V.angular * h).to_matrix();
        next.X_NB.translation += at.X_NB.rotation * V.linear * h;
        next.V_NB_B += a.base * h;
        next
    };
    (0..steps).fold(*state, |s, _| {
        let middle = on(&s, &s, &rates(&s), 0.5 * h);
        on(&s, &middle, &rates(&middle), h)
    })
}

/// Angular momentum about the system's centre of mass of joints that move so, the base not turning.
fn swing(robot: &Robot<f64, 7>, joints: &[SetPoint<f64>; 7]) -> Vec3<f64> {
    let state =
        State { q: joints.map(|s| s.position), v: joints.map(|s| s.rate), ..State::default() };
    momentum(&kinematics(robot, &state)).angular
}

/// The arm itself, driven by the commanded torques only: second order in the period, at 100 Hz it
/// follows the set-points to 6.8e-6 rad with the attitude held and to 4.9e-5 rad with the base free,
/// measured; and where no loop adds to it, the impulse of the torque on the base is the angular momentum
/// that the arm gains between the postures predicted for the ends of the periods: measured 3.2e-6 N·m off
/// that between the set-points, and what one period gives too much the next takes back.
#[test]
fn the_torques_carry_the_arm_along_the_set_points() {
    let (mut off, mut torque, robot) = (Worst::none(), Worst::none(), robot());
    for (law, base, has_loops) in [
        (ArmLaw::AttitudeHeld, BaseMode::AttitudeHeld, true),
        (ArmLaw::AttitudeHeld, BaseMode::AttitudeHeld, false),
        (ArmLaw::FreeFloating, BaseMode::Free, true),
    ] {
        let mut state = at_rest();
        let mut setup = setup(law, Measurement::None);
        if base == BaseMode::Free {
            setup.base.actuation = Actuation::None;
        }
        if !has_loops {
            setup.tuning.joint_bandwidth = 0.0;
        }
        setup.base.quat_ND = Quat::from_matrix(&state.X_NB.rotation);
        let mut computer = FlightComputer::new(setup, &robot, &tour(Axes::Inertial));
        let mut now = state.q.map(|position| SetPoint { position, ..SetPoint::default() });
        while !computer.done() {
            let command =
                computer.step(&Sensed::perfect(&state, ActuatorReadings::default())).unwrap();
            state = driven(&robot, &state, &command, base);
            if has_loops {
                off.see_all(state.q, command.set_points.map(|s| s.position));
            }
            let gained = swing(&robot, &command.set_points) - swing(&robot, &now);
            if !has_loops {
                torque.see((command.attitude_torque_B - gained * (1.0 / PERIOD)).norm());
            }
            now = command.set_points;
        }
    }
    off.is_below(1e-4);
    torque.is_below(1e-4);
}

/// Fed forward by the joints, and back by the attitude sensed, with the inertia of the locked system.
/// Two ways to add up that inertia: measured 7e-15 N·m of 78.
#[test]
fn the_attitude_torque_is_the_one_fed_forward_and_the_one_fed_back() {
    let setup = setup(ArmLaw::AttitudeHeld, Measurement::None);
    let phases = [Phase::Hold { what: Held::Joints, duration: 1.0 }];
    let mut computer = FlightComputer::new(setup, &robot(), &phases);
    let state = drifting();
    let command = computer.step(&Sensed::perfect(&state, ActuatorReadings::default())).unwrap();
    let I_Scm_B = mass_matrix(&kinematics(&robot(), &state)).M_bb.central();
    let quat_NB = Quat::from_matrix(&state.X_NB.rotation);
    let w_NB_B = state.V_NB_B.angular;
    // The joints stand still, so that nothing is fed forward.
    let back =
        I_Scm_B * attitude_acceleration(&setup.tuning, &quat_NB, w_NB_B, &setup.base.quat_ND);
    let off = (command.attitude_torque_B - back).norm();
    assert!(off < 1e-13, "{off:e}");
    assert!(back.norm() > 1.0, "{back:?}");
}
