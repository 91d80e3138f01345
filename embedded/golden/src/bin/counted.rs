//! Calls each main kernel once, for an instruction counter: `valgrind --tool=callgrind
//! --toggle-collect=counted::counted --dump-after=counted::counted counted` writes one dump for each
//! line printed. `cargo xtask counts` reads them.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

use std::hint::black_box;
use wrasse_dynamics::{
    BaseMode, Configuration, ForwardDynamics, Generalized, InverseDynamics, JointDrive, MassMatrix,
    Outside, accelerate, configure, drive, fill, forward_dynamics_derivatives, generalized_columns,
    generalized_jacobian, inverse_dynamics_derivatives, jacobian, jacobian_columns, kinematics,
    momentum_columns, momentum_matrix, place,
};
use wrasse_flight::ArmLaw;
use wrasse_golden_periods::{STATES, Subject, one_arm, two_arms};
use wrasse_spatial::{Level, SpatialForce, SpatialVelocity};

/// What the counter counts: from entering this function to leaving it.
#[inline(never)]
fn counted<R>(call: impl FnOnce() -> R) -> R {
    call()
}

/// Count one call, and say which it was.
fn count(name: &str, joints: usize, call: impl FnOnce()) {
    counted(call);
    println!("{name}/{joints}");
}

/// Kernels from the state on, the sines and cosines of the joints included, into places that are there.
fn kernels<const J: usize>(subject: &Subject<f64, J>) {
    let (robot, state) = (black_box(&subject.robot), subject.start(1).state);
    let (state, n) = (black_box(&state), robot.joint_count());
    let (tool, nu) = (black_box(&subject.setup.assignment.tool), state.velocity());
    let nudot = Generalized { base: SpatialVelocity::zero(), joints: [0.1; J] };
    let force = Generalized { base: SpatialForce::zero(), joints: [0.5; J] };
    let drives = force.joints.map(JointDrive::Effort);
    let (mut at, none) = (Configuration::new(), Outside::nothing());
    let mut k = kinematics(robot, state);
    count("posture", n, || place(robot, &state.q, &mut at.posture));
    count("configuration", n, || configure(robot, &state.q, &mut at));
    let mut inverse = InverseDynamics::new();
    count("inverse_dynamics", n, || {
        place(robot, &state.q, &mut at.posture);
        drive(robot, &at.posture, &nu, &nudot, none, &mut inverse);
    });
    let mut forward = ForwardDynamics::new();
    count("forward_dynamics", n, || {
        configure(robot, &state.q, &mut at);
        accelerate(robot, &at, &nu, &drives, BaseMode::Free, none, &mut forward);
    });
    let mut M = MassMatrix::new();
    count("mass_matrix", n, || {
        place(robot, &state.q, &mut at.posture);
        fill(robot, &at.posture, &mut at.composite, &mut M);
    });
    let mut A = momentum_matrix(&at.base, &state.X_NB.rotation);
    count("momentum_matrix", n, || {
        configure(robot, &state.q, &mut at);
        momentum_columns(&at.base, &state.X_NB.rotation, &mut A);
    });
    let (mut J_tool, mut columns) =
        (jacobian(&k, tool), generalized_jacobian(&jacobian(&k, tool), &M));
    count("jacobian", n, || {
        place(robot, &state.q, &mut at.posture);
        jacobian_columns(robot, &at.posture, tool, &mut J_tool);
    });
    count("generalized_jacobian", n, || {
        configure(robot, &state.q, &mut at);
        jacobian_columns(robot, &at.posture, tool, &mut J_tool);
        generalized_columns(&J_tool, &at.base, &mut columns);
    });
    count("inverse_dynamics_derivatives", n, || {
        place(robot, &state.q, &mut k.posture);
        black_box(inverse_dynamics_derivatives(&k, &nudot, none));
    });
    count("forward_dynamics_derivatives", n, || {
        place(robot, &state.q, &mut k.posture);
        black_box(forward_dynamics_derivatives(&k, &force, none));
    });
    black_box((&at, &inverse, &forward, &M, &A, &J_tool, &columns));
}

/// Control periods over the first golden states.
fn periods<const J: usize>(law: &str, subject: &Subject<f64, J>, states: u32) {
    for number in 0..states {
        let mut start = subject.start(number);
        black_box(counted(|| subject.period(black_box(&mut start))));
        println!("control_period_{law}/{}", subject.robot.joint_count());
    }
}

fn main() {
    // Four links abreast, whatever more this processor has.
    Level::Avx2.restrict();
    let one = |law| one_arm::<f64, 8>(law).expect("the table is a robot");
    let two = |law| two_arms::<f64, 16>(law).expect("the table is a robot");
    kernels(&one(ArmLaw::AttitudeHeld));
    kernels(&two(ArmLaw::AttitudeHeld));
    periods("held", &one(ArmLaw::AttitudeHeld), STATES);
    periods("floating", &one(ArmLaw::FreeFloating), STATES);
    periods("held", &two(ArmLaw::AttitudeHeld), STATES / 10);
    periods("floating", &two(ArmLaw::FreeFloating), STATES / 10);
}
