//! Any words as periods of the flight library for C: a refusal changes nothing and tells no torque, what
//! is accepted is finite, and after either a good period is flown.
#![no_main]
#![allow(non_snake_case)]

#[path = "../../embedded/golden/src/atlas_class.rs"]
mod atlas_class;

use atlas_class::{BASE, LINKS, TOOL};
use libfuzzer_sys::fuzz_target;
use std::ptr::null_mut;
use wrasse_flight_c::{
    WRASSE_FLIGHT_WORDS, WRASSE_JOINTS, WrasseArmReference, WrasseComplaint, WrasseControlOutput,
    WrasseFlight, WrasseLaws, WrasseSensed, WrasseStatus, wrasse_flight_period,
    wrasse_flight_set_up,
};

/// Overwrite words of a plain struct: each change is a number of a word and its eight bytes.
fn spoil<T: Copy>(of: &mut T, changes: &mut &[u8], most: usize) {
    let words = size_of::<T>() / 8;
    for _ in 0..most {
        let Some((change, rest)) = changes.split_at_checked(9) else { return };
        *changes = rest;
        let at = usize::from(change[0]) % words * 8;
        // SAFETY: every field is a number, which any bits are, and the word lies in the struct.
        unsafe {
            (&raw mut *of).cast::<u8>().add(at).copy_from_nonoverlapping(change[1..].as_ptr(), 8);
        }
    }
}

fn laws() -> WrasseLaws {
    WrasseLaws {
        law: 1,
        task: 0,
        feedforward: 1,
        measurement: 1,
        period: 0.01,
        tool_gain: 2.0,
        joint_bandwidth: 10.0,
        joint_damping: 1.0,
        attitude_bandwidth: 0.3,
        attitude_damping: 1.0,
        damped_below: 0.02,
        kept_attitude: [1.0, 0.0, 0.0, 0.0],
        posture: [0.0; WRASSE_JOINTS],
        rate_limit: [0.2; WRASSE_JOINTS],
        effort_limit: [500.0; WRASSE_JOINTS],
    }
}

fn sensed() -> WrasseSensed {
    let mut joint_position = [0.0; WRASSE_JOINTS];
    joint_position[..7].copy_from_slice(&[0.2, -0.6, -0.6, 1.9, -0.3, -1.3, 0.4]);
    WrasseSensed {
        attitude: [1.0, 0.0, 0.0, 0.0],
        position: [0.0; 3],
        angular_velocity: [0.001, -0.002, 0.0005],
        velocity: [0.0; 3],
        joint_position,
        joint_rate: [0.01; WRASSE_JOINTS],
        wrench_measured: 0,
        wrench: [0.0; 6],
    }
}

fn asked() -> WrasseArmReference {
    WrasseArmReference {
        kind: 0,
        axes: 0,
        tool_position: [1.5, 0.4, 0.1],
        tool_attitude: [1.0, 0.0, 0.0, 0.0],
        tool_velocity: [0.0, 0.0, 0.0, 0.05, 0.0, 0.0],
        tool_acceleration: [0.0; 6],
        posture_gain: 0.1,
        posture_gain_rate: 0.0,
        joint_position: sensed().joint_position,
        joint_rate: [0.0; WRASSE_JOINTS],
        joint_acceleration: [0.0; WRASSE_JOINTS],
    }
}

fn fly(
    flight: &mut WrasseFlight,
    sensed: &WrasseSensed,
    asked: &WrasseArmReference,
) -> WrasseStatus {
    let mut told =
        WrasseControlOutput { effort: [f64::NAN; WRASSE_JOINTS], ..WrasseControlOutput::default() };
    let mut complaint =
        WrasseComplaint { field: null_mut(), index: 0, found: 0.0, expected: null_mut() };
    let before = flight.memory;
    // SAFETY: all point to what they are.
    let status =
        unsafe { wrasse_flight_period(flight, sensed, asked, &raw mut told, &raw mut complaint) };
    let joints = [told.joint_position, told.joint_rate, told.joint_acceleration, told.effort];
    assert!(joints.iter().flatten().all(|x| x.is_finite()), "{status:?}: {told:?}");
    let base = [told.attitude_torque, told.force_ahead];
    assert!(base.iter().flatten().all(|x| x.is_finite()), "{status:?}: {told:?}");
    if status != WrasseStatus::WRASSE_OK {
        assert!(flight.memory == before, "{status:?}: the memory has changed");
        assert!(told.effort.iter().all(|x| *x == 0.0), "{status:?}: {told:?}");
        assert!(!complaint.field.is_null() && !complaint.expected.is_null());
    }
    status
}

fuzz_target!(|bytes: &[u8]| {
    let (mut base, mut links, mut tool, mut laws) = (BASE, LINKS, TOOL, laws());
    let Some((counts, mut rest)) = bytes.split_at_checked(4) else { return };
    laws.law = i32::from(counts[0] % 3);
    let set_up = usize::from(counts[1] % 4);
    spoil(&mut base, &mut rest, usize::from(set_up == 1));
    spoil(&mut links, &mut rest, usize::from(set_up == 2));
    spoil(&mut tool, &mut rest, usize::from(set_up == 3));
    spoil(&mut laws, &mut rest, usize::from(counts[2] % 2));
    let mut flight = WrasseFlight { memory: [0; WRASSE_FLIGHT_WORDS] };
    let (count, to) = (7, &raw mut flight);
    // SAFETY: all point to what they are; the complaint may be null.
    let status =
        unsafe { wrasse_flight_set_up(to, &base, links.as_ptr(), count, &tool, &laws, null_mut()) };
    if status != WrasseStatus::WRASSE_OK {
        assert!(flight.memory.iter().all(|word| *word == 0));
        return;
    }
    for k in 0..1 + counts[3] % 4 {
        let (mut read, mut wish) = (sensed(), WrasseArmReference { kind: i32::from(k), ..asked() });
        spoil(&mut read, &mut rest, 2);
        spoil(&mut wish, &mut rest, 2);
        fly(&mut flight, &read, &wish);
    }
    fly(&mut flight, &sensed(), &asked());
});
