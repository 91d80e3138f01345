//! The control period as one piece, in every state: bounded, with the momentum that it read, and as phases mean it.

use super::spanning_states::{Period, STATES, servicer, setup, states};
use wrasse_dynamics::{Robot, State, kinematics, momentum};
use wrasse_flight::{
    ArmLaw, ControlOutput, FlightComputer, Held, Measurement, Phase, Sensed, Setup,
};
use wrasse_hardware::ActuatorReadings;
use wrasse_spatial::Vec3;
use wrasse_testing::{Worst, largest};

const LAWS: [ArmLaw; 3] = [ArmLaw::Terrestrial, ArmLaw::AttitudeHeld, ArmLaw::FreeFloating];

/// All numbers that the actuators are told.
fn numbers<const J: usize>(told: &ControlOutput<f64, J>) -> Vec<f64> {
    let set_points = told.set_points.iter().flat_map(|s| [s.position, s.rate, s.acceleration]);
    let base = told.attitude_torque_B.to_array();
    set_points.chain(told.effort).chain(base).collect()
}

fn every_state_is_bounded<const J: usize>() {
    let (robot, tool) = servicer::<J>();
    let (mut rate, mut torque) = (Worst::none(), Worst::none());
    for law in LAWS {
        let setup = setup(law, tool);
        for (k, state) in states().into_iter().enumerate() {
            let told = Period::new(&robot, &setup, state, k).fly(&robot, &setup);
            assert!(numbers(&told).iter().all(|x| x.is_finite()), "{law:?}, state {k}: {told:?}");
            told.set_points.iter().for_each(|s| rate.see(s.rate.abs()));
            told.effort.iter().for_each(|tau| torque.see(tau.abs()));
        }
    }
    // The limits of the setup, with the round-off of one product.
    rate.is_below(0.2 * (1.0 + 1e-15));
    torque.is_below(500.0 * (1.0 + 1e-15));
}

/// Anywhere in the travel, at its ends, in singular postures and next to them: rates within 0.2 rad/s,
/// torques within 500 N·m, and no NaN.
#[test]
fn every_state_of_one_arm_and_of_two_gives_bounded_commands() {
    assert_eq!(states::<7>().len(), STATES);
    every_state_is_bounded::<7>();
    every_state_is_bounded::<14>();
}

/// A flight processor counts in single precision. Of 1,000 states, singular ones among them, the worst is
/// off by this much of its largest joint torque: measured 4.0e-3 with the attitude held, 2.1e-3 with the
/// base free.
#[test]
fn single_precision_gives_the_torques_of_double_precision_in_every_state() {
    let (robot, tool) = servicer::<7>();
    for law in [ArmLaw::AttitudeHeld, ArmLaw::FreeFloating] {
        let (setup, mut worst) = (setup(law, tool), Worst::none());
        for (k, state) in states().into_iter().enumerate() {
            let period = Period::new(&robot, &setup, state, k);
            let double = period.flown_in::<f64>(&robot, &setup).effort;
            let single = period.flown_in::<f32>(&robot, &setup).effort;
            let scale = largest(double.iter().map(|tau| tau.abs()));
            for (tau, tau_single) in double.into_iter().zip(single) {
                worst.see((tau - f64::from(tau_single)).abs() / scale);
            }
        }
        worst.is_below(0.01);
    }
}

/// The period ends with the momentum that it read, in the posture predicted for its end. In these states,
/// which no motion led to, the base's twist is off by up to 7.2e-3 N·s with one arm and
/// 1.2e-2 N·s with two, of some 16 N·s.
fn momentum_is_kept<const J: usize>() -> Worst {
    let ((robot, tool), mut gained) = (servicer::<J>(), Worst::none());
    for law in [ArmLaw::AttitudeHeld, ArmLaw::FreeFloating] {
        let setup = setup(law, tool);
        for (k, state) in states().into_iter().enumerate() {
            let mut period = Period::new(&robot, &setup, state, k);
            period.fly(&robot, &setup);
            let after = momentum(&kinematics(&robot, &period.believed_state()));
            gained.see((after.linear - period.believed_momentum().force).norm());
        }
    }
    gained
}

#[test]
fn the_period_ends_with_the_linear_momentum_that_it_read() {
    let (one, two) = (momentum_is_kept::<7>(), momentum_is_kept::<14>());
    one.is_below(2e-2);
    two.is_below(4e-2);
}

/// What the phases of a computer mean, whatever is sensed, to the bit: joints that are held stay where the
/// phase found them, at rest; joints that are let go, and the base with them, get no torque; and the next
/// phase holds them where they have got to.
#[test]
fn a_hold_stands_where_it_began_and_letting_go_drives_nothing() {
    let (robot, tool): (Robot<f64, 7>, _) = servicer();
    let places: Vec<State<f64, 7>> = states().into_iter().take(15).collect();
    for law in LAWS {
        for measurement in [Measurement::Base, Measurement::None] {
            let setup = Setup { measurement, ..setup(law, tool) };
            let hold = |what| Phase::Hold { what, duration: 0.05 };
            let phases = [hold(Held::Joints), hold(Held::Nothing), hold(Held::Joints)];
            let mut computer = FlightComputer::new(setup, &robot, &phases);
            for (k, moving) in places.iter().enumerate() {
                // Joints that move as a phase begins would be brought to rest first.
                let state = State { v: [0.0; 7], ..*moving };
                let sensed = Sensed::perfect(&state, ActuatorReadings::default());
                let command = computer.step(&sensed).unwrap();
                let nothing =
                    command.effort == [0.0; 7] && command.attitude_torque_B == Vec3::zero();
                assert_eq!(nothing, (5..10).contains(&k), "{law:?} {k}: {command:?}");
                // The first period that lets go still begins at what was held; each after it, and the one
                // that holds again, where the joints are sensed.
                let held_at = if k <= 5 { 0 } else { k.min(10) };
                assert_eq!(
                    command.set_points.map(|s| s.position),
                    places[held_at].q,
                    "{law:?} {k}"
                );
                assert_eq!(command.set_points.map(|s| s.rate), [0.0; 7], "{law:?} {k}");
            }
        }
    }
}
