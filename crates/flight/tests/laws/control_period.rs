//! The control period as one piece: bounded in every state, and the one that the flight computer flies.

use crate::spanning_states::{Period, STATES, servicer, setup, states};
use crate::worst::Worst;
use wrasse_dynamics::Robot;
use wrasse_flight::{
    ArmLaw, ArmReference, ControlOutput, FlightComputer, Held, Measurement, PeriodMemory, Phase,
    Sensed, control_period,
};
use wrasse_hardware::ActuatorReadings;

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
            let largest = double.iter().fold(0.0, |largest: f64, tau| largest.max(tau.abs()));
            for (tau, tau_single) in double.into_iter().zip(single) {
                worst.see((tau - f64::from(tau_single)).abs() / largest);
            }
        }
        worst.is_below(0.01);
    }
}

/// Joints that are asked to stand, by the computer and by the bare period: the same bits.
#[test]
fn the_computer_flies_the_control_period() {
    let (robot, tool): (Robot<f64, 7>, _) = servicer();
    for law in LAWS {
        for measurement in [Measurement::Base, Measurement::None] {
            let setup = wrasse_flight::Setup { measurement, ..setup(law, tool) };
            let hold = |what| Phase::Hold { what, duration: 0.05 };
            let phases = [hold(Held::Joints), hold(Held::Nothing), hold(Held::Joints)];
            let mut computer = FlightComputer::new(setup, &robot, &phases);
            let mut memory = PeriodMemory::new();
            for (k, moving) in states().into_iter().take(15).enumerate() {
                // Joints that move as a phase begins would be brought to rest first.
                let state = wrasse_dynamics::State { v: [0.0; 7], ..moving };
                let asked =
                    if (5..10).contains(&k) { ArmReference::Coast } else { ArmReference::Still };
                let sensed = Sensed::perfect(&state, ActuatorReadings::default());
                let command = computer.step(&sensed).unwrap();
                let told = control_period(&robot, &setup, &mut memory, &state, &asked, None);
                assert_eq!(command.set_points, told.set_points);
                assert_eq!(command.effort, told.effort);
                assert_eq!(command.attitude_torque_B, told.attitude_torque_B);
            }
        }
    }
}
