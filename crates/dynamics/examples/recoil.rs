//! An arm swings and the base recoils: how far an Earth-bound law is off.
//!
//! `cargo run -p wrasse-dynamics --example recoil`
#![allow(non_snake_case, clippy::print_stdout, reason = "monogram notation; an example prints")]

use wrasse_dynamics::{
    BodyId, Frame, Joint, JointKind, MassProperties, Robot, RobotError, State,
    generalized_jacobian, jacobian, kinematics, mass_matrix, momentum,
};
use wrasse_spatial::{At, Pose, SpatialVelocity, Sym3, Vec3, vec3};

fn main() -> Result<(), RobotError> {
    // A 100 kg box with a shoulder on its side; the arm is a 10 kg rod of 1 m with the tool at its end.
    let bus = MassProperties::from_central(100.0, Vec3::zero(), Sym3::diagonal(17.0, 17.0, 17.0));
    let rod =
        MassProperties::from_central(10.0, vec3(0.5, 0.0, 0.0), Sym3::diagonal(0.01, 0.83, 0.83));
    let at = |p| Pose { translation: p, ..Pose::identity() };
    let shoulder =
        Joint::new(BodyId::Base, JointKind::Revolute, at(vec3(0.5, 0.0, 0.0)), vec3(0.0, 0.0, 1.0));
    let robot: Robot<f64, 1> = Robot::new(bus, &[(shoulder, rod)])?;
    let tool = Frame { body: BodyId::Link(0), X_BF: at(vec3(1.0, 0.0, 0.0)) };

    // At zero momentum, one joint rate says how everything moves.
    let mut state = State { v: [0.1], ..State::default() };
    let M = mass_matrix(&kinematics(&robot, &state));
    state.V_NB_B = M.M_bb.velocity_of(&-M.momentum_of_rates(&state.v));

    let k = kinematics(&robot, &state);
    let J = jacobian(&k, &tool);
    let on_the_ground = J.joints.linear.at(0) * 0.1;
    let floating: SpatialVelocity<f64> = generalized_jacobian(&J, &M).at(0) * 0.1;
    println!(
        "tool on the ground: {:.4} m/s, floating: {:.4} m/s",
        on_the_ground.y, floating.linear.y
    );

    let h = momentum(&k);
    assert!(h.linear.norm() < 1e-15 && h.angular.norm() < 1e-15, "nothing was pushed off");
    assert!((k.velocity(&tool).linear - floating.linear).norm() < 1e-15);
    Ok(())
}
