//! Calls each main kernel once, for an instruction counter: `valgrind --tool=callgrind
//! --toggle-collect=counted::counted --dump-after=counted::counted counted` writes one dump for each
//! line printed. `cargo xtask counts` reads them.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

use std::hint::black_box;
use wrasse_dynamics::{
    Generalized, Outside, base_rows, forward_dynamics, generalized_jacobian, inverse_dynamics,
    jacobian, kinematics, mass_matrix, momentum_matrix,
};
use wrasse_flight::ArmLaw;
use wrasse_golden_periods::{STATES, Subject, one_arm, two_arms};
use wrasse_spatial::{SpatialForce, SpatialVelocity};

/// What the counter counts: from entering this function to leaving it.
#[inline(never)]
fn counted<R>(call: impl FnOnce() -> R) -> R {
    call()
}

/// Count one call, and say which it was.
fn count<R>(name: &str, joints: usize, call: impl FnOnce() -> R) {
    black_box(counted(call));
    println!("{name}/{joints}");
}

/// Kernels from the state on, the sines and cosines of the joints included.
fn kernels<const J: usize>(subject: &Subject<f64, J>) {
    let (robot, state) = (black_box(&subject.robot), subject.start(1).state);
    let state = black_box(&state);
    let tool = black_box(&subject.setup.assignment.tool);
    let nudot = Generalized { base: SpatialVelocity::zero(), joints: [0.1; J] };
    let force = Generalized { base: SpatialForce::zero(), joints: [0.5; J] };
    count("kinematics", J, || kinematics(robot, state));
    count("inverse_dynamics", J, || {
        inverse_dynamics(&kinematics(robot, state), &nudot, Outside::nothing())
    });
    count("forward_dynamics", J, || {
        forward_dynamics(&kinematics(robot, state), &force, Outside::nothing())
    });
    count("mass_matrix", J, || mass_matrix(&kinematics(robot, state)));
    count("momentum_matrix", J, || {
        momentum_matrix(&base_rows(&kinematics(robot, state)), &state.X_NB.rotation)
    });
    count("jacobian", J, || jacobian(&kinematics(robot, state), tool));
    count("generalized_jacobian", J, || {
        let k = kinematics(robot, state);
        generalized_jacobian(&jacobian(&k, tool), &base_rows(&k))
    });
}

/// Control periods over the first golden states.
fn periods<const J: usize>(law: &str, subject: &Subject<f64, J>, states: u32) {
    for number in 0..states {
        let mut start = subject.start(number);
        black_box(counted(|| subject.period(black_box(&mut start))));
        println!("control_period_{law}/{J}");
    }
}

fn main() {
    let one = |law| one_arm::<f64>(law).expect("the table is a robot");
    let two = |law| two_arms::<f64>(law).expect("the table is a robot");
    kernels(&one(ArmLaw::AttitudeHeld));
    kernels(&two(ArmLaw::AttitudeHeld));
    periods("held", &one(ArmLaw::AttitudeHeld), STATES);
    periods("floating", &one(ArmLaw::FreeFloating), STATES);
    periods("held", &two(ArmLaw::AttitudeHeld), STATES / 10);
    periods("floating", &two(ArmLaw::FreeFloating), STATES / 10);
}
