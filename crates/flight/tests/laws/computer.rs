//! The flight computer on its way: set-points that join, beliefs that keep what their law keeps.

use crate::flights::{Flight, PERIOD, aside, at_rest, drifting, robot, setup};
use crate::postures::LAWS;
use crate::worst::Worst;
use wrasse_dynamics::{
    BaseMode, Generalized, JointDrive, PerBody, Robot, State, base_twist, driven_dynamics,
    kinematics, mass_matrix, momentum,
};
use wrasse_flight::{
    Actuation, ArmLaw, Axes, Command, FlightComputer, Held, JointTarget, JointTiming, Measurement,
    Phase, Sensed, attitude_acceleration,
};
use wrasse_hardware::{ActuatorReadings, SetPoint, SetPointMotion};
use wrasse_spatial::{
    Pose, Quat, SpatialForce, SpatialMomentum, SpatialVelocity, Vec3, rotation_vector_rate,
    turned_by, vec3,
};

fn joints_to(q: [f64; 7], duration: f64) -> Phase<f64, 7> {
    let to = JointTarget::Positions(q.map(Some));
    Phase::MoveJoints { to, timing: JointTiming::Duration(duration) }
}

/// A tool move, a hold of the tool, a joint move that brings the joints on, and a hold of the joints.
fn tour(axes: Axes) -> [Phase<f64, 7>; 4] {
    let q = at_rest().q.map(|q| q + 0.2);
    [
        aside(axes, 4.0),
        Phase::Hold { what: Held::Tool, duration: 0.5 },
        joints_to(q, 3.0),
        Phase::Hold { what: Held::Joints, duration: 0.5 },
    ]
}

/// Set-points at the ends of all periods, the start included, on the same joint.
fn of_joint(start: &State<f64, 7>, commands: &[Command<f64, 7>], j: usize) -> Vec<SetPoint<f64>> {
    let first = SetPoint { position: start.q[j], rate: start.v[j], acceleration: 0.0 };
    core::iter::once(first).chain(commands.iter().map(|c| c.set_points[j])).collect()
}

/// Position by the Hermite quadrature `h (v₀+v₁)/2 + h² (a₀-a₁)/12`: of fourth order, so that the
/// quintic that joins two set-points does not wiggle. Positions measured 2.0e-10 rad off, where a
/// joint move stops what is left of holding the tool; rates against the trapezium of the
/// accelerations 3.9e-7 rad/s, for h³/12 of their third derivative.
#[test]
fn set_points_join_in_position_and_rate_by_each_law() {
    let (mut position, mut rate) = (Worst::none(), Worst::none());
    for law in LAWS {
        for axes in [Axes::Inertial, Axes::Base] {
            let start = at_rest();
            let mut flight = Flight::new(&setup(law, Measurement::None), start, &tour(axes));
            let commands = flight.fly_on();
            for j in 0..7 {
                for pair in of_joint(&start, &commands, j).windows(2) {
                    let [a, b] = [pair[0], pair[1]];
                    let way = PERIOD * (a.rate + b.rate) / 2.0
                        + PERIOD * PERIOD * (a.acceleration - b.acceleration) / 12.0;
                    position.see((b.position - a.position - way).abs());
                    let gain = PERIOD * (a.acceleration + b.acceleration) / 2.0;
                    rate.see((b.rate - a.rate - gain).abs());
                }
            }
        }
    }
    position.is_below(1e-9);
    rate.is_below(1e-6);
}

/// Between two set-points the quintic stays within what the set-points themselves do. Measured 1.4e-4
/// of the largest acceleration.
#[test]
fn nothing_wiggles_between_set_points() {
    let start = at_rest();
    let mut worst = Worst::none();
    for law in LAWS {
        let mut flight = Flight::new(&setup(law, Measurement::None), start, &tour(Axes::Inertial));
        let commands = flight.fly_on();
        for j in 0..7 {
            let points = of_joint(&start, &commands, j);
            let largest = points.iter().fold(0.0, |m: f64, p| m.max(p.acceleration.abs()));
            for pair in points.windows(2) {
                let between = SetPointMotion::between(pair[0], pair[1], PERIOD);
                let ends = pair[0].acceleration.abs().max(pair[1].acceleration.abs());
                for part in [0.2, 0.4, 0.6, 0.8] {
                    let inside = between.at(part * PERIOD).acceleration.abs();
                    worst.see((inside - ends).max(0.0) / largest);
                }
            }
        }
    }
    worst.is_below(1e-3);
}

/// The tool of the believed vehicle is on its reference, by a step of third order of 10 ms: measured
/// 1.6e-8 m and 2.5e-8 rad.
#[test]
fn the_believed_tool_stays_on_its_reference() {
    let (mut off, mut turned) = (Worst::none(), Worst::none());
    for law in LAWS {
        for axes in [Axes::Inertial, Axes::Base] {
            let phases = [aside(axes, 4.0)];
            let mut flight = Flight::new(&setup(law, Measurement::None), at_rest(), &phases);
            while !flight.computer.done() {
                flight.step().unwrap();
                let (m, rad) = flight.computer.believed_tool_error();
                off.see(m);
                turned.see(rad);
            }
        }
    }
    off.is_below(1e-7);
    turned.is_below(1e-7);
}

/// Believed states at the ends of 20 s of moves, from a drifting start.
fn beliefs(law: ArmLaw, axes: Axes) -> Vec<State<f64, 7>> {
    let q = drifting().q.map(|q| q - 0.25);
    let phases = [aside(axes, 8.0), joints_to(q, 7.0), aside(Axes::Base, 5.0)];
    let mut flight = Flight::new(&setup(law, Measurement::None), drifting(), &phases);
    let mut states = vec![];
    while !flight.computer.done() {
        flight.step().unwrap();
        states.push(flight.computer.believed_state());
    }
    assert_eq!(states.len(), 2000);
    states
}

#[test]
fn a_terrestrial_law_believes_that_the_base_never_moves() {
    for state in beliefs(ArmLaw::Terrestrial, Axes::Inertial) {
        assert_eq!(state.V_NB_B, SpatialVelocity::zero());
        let X = drifting().X_NB;
        assert_eq!(state.X_NB.translation, X.translation);
        let off = state.X_NB.rotation - X.rotation;
        assert!(off.rows.iter().all(|row| row.norm() < 1e-15), "measured 3e-16");
    }
}

/// Attitude to round-off of 2000 steps: measured 7.4e-16. Centre of mass on the straight line of the
/// believed linear momentum: measured 3.1e-10 m.
#[test]
fn an_attitude_held_law_believes_in_a_still_attitude_and_a_straight_centre_of_mass() {
    let (robot, start) = (robot(), drifting());
    let h = momentum(&kinematics(&robot, &start));
    let (mut turned, mut off) = (Worst::none(), Worst::none());
    for (k, state) in beliefs(ArmLaw::AttitudeHeld, Axes::Base).iter().enumerate() {
        assert_eq!(state.V_NB_B.angular, Vec3::zero());
        let R = state.X_NB.rotation - start.X_NB.rotation;
        R.rows.iter().for_each(|row| turned.see(row.norm()));
        let gone = h.linear * (PERIOD * (k + 1) as f64 / h.mass);
        let (_, p_NScm) = kinematics(&robot, state).centre_of_mass();
        off.see((p_NScm - h.p_NScm_N - gone).norm());
    }
    turned.is_below(1e-12);
    off.is_below(1e-9);
}

/// Summed body by body. The base's twist at the end of a period is that of the posture predicted for it:
/// off by its distance from the posture that comes, h³ of the joints' jerk over six. Measured 1.2e-6 N·m·s
/// of 3.6, 6.3e-7 N·s of 9.3, and the centre of mass 6.3e-9 m off.
#[test]
fn a_free_floating_law_believes_in_constant_momentum() {
    let (robot, start) = (robot(), drifting());
    let h = momentum(&kinematics(&robot, &start));
    let [mut angular, mut linear, mut off] = [Worst::none(), Worst::none(), Worst::none()];
    for (k, state) in beliefs(ArmLaw::FreeFloating, Axes::Base).iter().enumerate() {
        let now = momentum(&kinematics(&robot, state));
        angular.see((now.angular - h.angular).norm());
        linear.see((now.linear - h.linear).norm());
        let gone = h.linear * (PERIOD * (k + 1) as f64 / h.mass);
        off.see((now.p_NScm_N - h.p_NScm_N - gone).norm());
    }
    angular.is_below(1e-5);
    linear.is_below(1e-5);
    off.is_below(1e-7);
}

/// A tool that is still in inertial space is left at rates against the drift; that the next phase stops
/// the joints at once moves the centre of mass by 1.0e-8 m, and for one period the base's twist is that of
/// the posture in which they went on: measured 2.7e-4 N·m·s of 3.6.
#[test]
fn joints_that_stop_at_once_cost_one_period_of_the_drift() {
    let (robot, start) = (robot(), drifting());
    let h = momentum(&kinematics(&robot, &start));
    let (mut angular, mut off) = (Worst::none(), Worst::none());
    for (k, state) in beliefs(ArmLaw::FreeFloating, Axes::Inertial).iter().enumerate() {
        let now = momentum(&kinematics(&robot, state));
        angular.see((now.angular - h.angular).norm());
        let gone = h.linear * (PERIOD * (k + 1) as f64 / h.mass);
        off.see((now.p_NScm_N - h.p_NScm_N - gone).norm());
    }
    angular.is_below(1e-2);
    off.is_below(1e-7);
}

/// A base that is measured, and moves as the law believes, has the momentum that it began with: what is
/// read a period after the other is the same momentum, although it is taken half a period on. Measured
/// over 1500 periods 3.9e-4 of 3.6 N·m·s and 2.1e-4 of 9.3 N·s, most of it where a phase begins.
#[test]
fn a_law_that_measures_the_base_reads_the_same_momentum_in_each_period() {
    let (robot, start) = (robot(), drifting());
    let h = momentum(&kinematics(&robot, &start));
    let phases = [aside(Axes::Base, 8.0), joints_to(start.q.map(|q| q - 0.25), 7.0)];
    let free = setup(ArmLaw::FreeFloating, Measurement::Base);
    let mut flight = Flight::new(&free, start, &phases);
    let (mut state, mut angular, mut linear) = (start, Worst::none(), Worst::none());
    while !flight.computer.done() {
        let sensed = Sensed::perfect(&state, ActuatorReadings::default());
        flight.computer.step(&sensed).unwrap();
        state = flight.computer.believed_state();
        let now = momentum(&kinematics(&robot, &state));
        angular.see((now.angular - h.angular).norm());
        linear.see((now.linear - h.linear).norm());
    }
    angular.is_below(1e-3);
    linear.is_below(1e-3);
}

/// Attitude of the base a period later while the joints go from set-point to set-point and the momentum
/// stays: a step of order four on the rotation vector, with the twist by momentum at each stage.
fn carried(
    robot: &Robot<f64, 7>,
    h_Scm_N: &SpatialMomentum<f64>,
    quat_NB: Quat<f64>,
    joints: &[SetPointMotion<f64>; 7],
) -> Quat<f64> {
    let rate = |t: f64, u: Vec3<f64>| {
        let at = joints.map(|joint| joint.at(t));
        let R = turned_by(quat_NB, u).to_matrix();
        let q = at.map(|s| s.position);
        let M = mass_matrix(&kinematics(robot, &State { q, ..State::default() }));
        let h_Scm_B =
            SpatialMomentum::new(R.transpose_mul(h_Scm_N.torque), R.transpose_mul(h_Scm_N.force));
        rotation_vector_rate(u, base_twist(&M, &h_Scm_B, &at.map(|s| s.rate)).angular)
    };
    let half = 0.5 * PERIOD;
    let a = rate(0.0, Vec3::zero());
    let b = rate(half, a * half);
    let c = rate(half, b * half);
    let d = rate(PERIOD, c * PERIOD);
    turned_by(quat_NB, (a + b * 2.0 + c * 2.0 + d) * (PERIOD / 6.0))
}

/// The free-floating law integrates its own model once per period; momentum carries the base to the
/// same attitude: measured 7.4e-9 rad apart, after a turn of 0.13 rad.
#[test]
fn the_believed_attitude_is_where_momentum_carries_the_base() {
    let (robot, start) = (robot(), drifting());
    let h = momentum(&kinematics(&robot, &start));
    let h_Scm_N = SpatialMomentum::new(h.angular, h.linear);
    let law = ArmLaw::FreeFloating;
    let mut flight = Flight::new(&setup(law, Measurement::None), start, &tour(Axes::Base));
    let mut quat = Quat::from_matrix(&start.X_NB.rotation);
    let mut now = start.q.map(|position| SetPoint { position, ..SetPoint::default() });
    let mut worst = Worst::none();
    while !flight.computer.done() {
        let next = flight.step().unwrap().set_points;
        let joints = std::array::from_fn(|j| SetPointMotion::between(now[j], next[j], PERIOD));
        quat = carried(&robot, &h_Scm_N, quat, &joints);
        now = next;
        let R = flight.computer.believed_state().X_NB.rotation;
        worst.see((quat.conjugate() * Quat::from_matrix(&R)).log().norm());
    }
    let turned = Quat::from_matrix(&(start.X_NB.rotation.transpose() * quat.to_matrix())).log();
    assert!(turned.norm() > 0.1, "measured 0.13: {}", turned.norm());
    worst.is_below(1e-7);
}

/// What is sensed of the base counts, and what is not asked for does not.
#[test]
fn only_a_law_that_measures_takes_the_sensed_base() {
    let elsewhere = Pose { translation: vec3(5.0, 6.0, 7.0), ..at_rest().X_NB };
    for law in LAWS {
        for measurement in [Measurement::Base, Measurement::None] {
            let phases = [Phase::Hold { what: Held::Joints, duration: 1.0 }];
            let mut flight = Flight::new(&setup(law, measurement), at_rest(), &phases);
            flight.step().unwrap();
            let state = State { X_NB: elsewhere, ..at_rest() };
            let sensed = Sensed::perfect(&state, ActuatorReadings::default());
            flight.computer.step(&sensed).unwrap();
            let expected =
                if measurement == Measurement::Base { elsewhere } else { at_rest().X_NB };
            let off = flight.computer.believed_state().X_NB.translation - expected.translation;
            assert!(off.norm() < 1e-15, "{law:?}, {measurement:?}: {off:?}");
        }
    }
}

/// Of an error of the tool `e^{-2 h}` is left after each period, with a tool gain of 2/s. Measured 1.0e-6
/// off.
#[test]
fn a_measured_error_is_taken_back_at_the_tool_gain() {
    let (shift, periods) = (vec3(0.004, -0.003, 0.002), 100);
    let phases = [Phase::Hold { what: Held::Tool, duration: 2.0 }];
    let mut worst = Worst::none();
    for law in LAWS {
        let mut flight = Flight::new(&setup(law, Measurement::Base), at_rest(), &phases);
        flight.step().unwrap();
        let mut before: Option<f64> = None;
        for k in 0..periods {
            // The base was pushed aside once, and then does what the law believes.
            let mut state = flight.computer.believed_state();
            if k == 0 {
                state.X_NB.translation += shift;
            }
            flight.computer.step(&Sensed::perfect(&state, ActuatorReadings::default())).unwrap();
            let (off, _) = flight.computer.believed_tool_error();
            // The first set-points still join the rates from before to those that take the error back.
            if let Some(before) = before
                && k > 1
            {
                worst.see((off / before / f64::exp(-2.0 * PERIOD) - 1.0).abs());
            }
            before = Some(off);
        }
    }
    worst.is_below(1e-5);
}

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
