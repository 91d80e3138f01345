//! A checked period is the period, or none at all.

use super::spanning_states::{servicer, setup, states};
use wrasse_dynamics::{Robot, State};
use wrasse_flight::{
    ArmLaw, ArmReference, OutOfBounds, PeriodFault, PeriodMemory, Quantity, checked_period,
    control_period,
};

const LAWS: [ArmLaw; 3] = [ArmLaw::Terrestrial, ArmLaw::AttitudeHeld, ArmLaw::FreeFloating];

/// Singular postures and the ends of the travel included: 1,000 states by each law, none is refused.
#[test]
fn checks_refuse_no_good_period_and_change_no_bit_of_it() {
    let (robot, tool): (Robot<f64, 7>, _) = servicer();
    for law in LAWS {
        let setup = setup(law, tool);
        let (mut bare, mut checked) = (PeriodMemory::new(), PeriodMemory::new());
        for (k, state) in states().into_iter().enumerate() {
            let asked = if k % 3 == 0 { ArmReference::Coast } else { ArmReference::Still };
            let expected = control_period(&robot, &setup, &mut bare, &state, &asked, None);
            let told = checked_period(&robot, &setup, &mut checked, &state, &asked, None);
            assert_eq!(told, Ok(expected), "state {k}");
            assert_eq!(checked, bare, "state {k}");
        }
    }
}

#[test]
fn a_reading_beyond_its_bound_is_named_and_leaves_the_memory_as_it_was() {
    let (robot, tool): (Robot<f64, 7>, _) = servicer();
    let setup = setup(LAWS[1], tool);
    let mut memory = PeriodMemory::new();
    let good = State::default();
    checked_period(&robot, &setup, &mut memory, &good, &ArmReference::Still, None).unwrap();
    let before = memory;
    let mut wrong = good;
    wrong.q[3] = f64::INFINITY;
    let refused = checked_period(&robot, &setup, &mut memory, &wrong, &ArmReference::Still, None);
    let found = OutOfBounds { quantity: Quantity::JointPosition, index: 3, found: f64::INFINITY };
    assert_eq!(refused, Err(PeriodFault::Reading(found)));
    assert_eq!(memory, before);
    // A rotation that is none: NaN is beyond every bound, a stretched one by how far it is stretched.
    for stretched in [f64::NAN, 1.1, 0.9] {
        let mut wrong = good;
        wrong.X_NB.rotation = wrong.X_NB.rotation.scaled(stretched);
        let refused =
            checked_period(&robot, &setup, &mut memory, &wrong, &ArmReference::Still, None);
        let Err(PeriodFault::Reading(OutOfBounds { quantity: Quantity::Attitude, .. })) = refused
        else {
            panic!("{stretched}: {refused:?}")
        };
    }
}

/// Within their bounds the readings of one robot are not what breaks another: here its mass does.
#[test]
fn a_result_that_is_not_finite_is_refused_and_not_remembered() {
    let (robot, tool): (Robot<f64, 7>, _) = servicer();
    let mut setup = setup(LAWS[1], tool);
    let mut memory = PeriodMemory::new();
    let state = State::default();
    checked_period(&robot, &setup, &mut memory, &state, &ArmReference::Still, None).unwrap();
    let before = memory;
    setup.tuning.joint_bandwidth = 1e200;
    let mut moving = state;
    moving.q[2] = 0.1;
    let refused = checked_period(&robot, &setup, &mut memory, &moving, &ArmReference::Still, None);
    let Err(PeriodFault::ControlOutput(OutOfBounds { quantity: Quantity::Effort, .. })) = refused
    else {
        panic!("{refused:?}")
    };
    assert_eq!(memory, before);
    let nothing = memory.safe_output();
    assert_eq!(nothing.effort, [0.0; 7]);
    assert!(nothing.set_points.iter().all(|s| s.position == 0.0 && s.rate == 0.0));
}
