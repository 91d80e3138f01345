//! Forward dynamics against inverse dynamics and a dense solve.

use crate::measure::{dense, dense_vector, for_every_robot};
use std::array;
use wrasse_dynamics::{
    BaseMode, Generalized, JointDrive, PerBody, bias_force, driven_dynamics, forward_dynamics,
    inverse_dynamics, kinematics, mass_matrix,
};
use wrasse_spatial::{SpatialForce, SpatialVelocity, Vec3};
use wrasse_testing::random_robot::{JOINTS, Scene};
use wrasse_testing::{gap, gap_at, larger, largest, size};

/// Some joints follow the scene's accelerations, the others feel the scene's efforts.
fn mixed_drives(scene: &Scene, effort: &[f64; JOINTS]) -> [JointDrive<f64>; JOINTS] {
    array::from_fn(|j| {
        if scene.follows[j] {
            JointDrive::Acceleration(scene.nudot.joints[j])
        } else {
            JointDrive::Effort(effort[j])
        }
    })
}

/// Round-off times the condition of M, up to 4e4 here. Measured 7e-14.
#[test]
fn forward_dynamics_undoes_inverse_dynamics() {
    for_every_robot(1e-12, |s| {
        let k = kinematics(&s.robot, &s.state);
        let force = inverse_dynamics(&k, &s.nudot, &s.external).force;
        gap(&forward_dynamics(&k, &force, &s.external), &s.nudot)
    });
}

/// Articulated bodies against a factored matrix: they share the kinematics only.
/// Measured 3e-14.
#[test]
fn forward_dynamics_solves_the_equations_of_motion() {
    for_every_robot(1e-12, |s| {
        let k = kinematics(&s.robot, &s.state);
        let force = Generalized { base: s.external.base, joints: s.xi };
        let none = PerBody::filled(SpatialForce::zero());
        let found = dense_vector(&s.robot, &forward_dynamics(&k, &force, &none));
        let rest = dense_vector(&s.robot, &force) - dense_vector(&s.robot, &bias_force(&k));
        let solved = dense(&mass_matrix(&k)).cholesky().unwrap().solve(&rest);
        gap(&found, &solved)
    });
}

/// Force some joints, move the others, in both modes of the base: inverse dynamics of the motion
/// that comes out gives the forces that came out. Measured 7e-15.
#[test]
fn driven_dynamics_agrees_with_inverse_dynamics_of_what_it_finds() {
    for mode in [BaseMode::Free, BaseMode::AttitudeHeld, BaseMode::Fixed] {
        for_every_robot(1e-13, |s| {
            let k = kinematics(&s.robot, &s.state);
            let found = driven_dynamics(&k, &mixed_drives(s, &s.xi), mode, &s.external);
            let inverse = inverse_dynamics(&k, &found.nudot, &s.external);
            let scale = larger(1.0, largest(s.robot.bodies().map(|b| size(&inverse.F_B_B(&k, b)))));
            gap_at(&found.force, &inverse.force, scale)
        });
    }
}

/// What is given comes back untouched, what is held does not move, what is free feels nothing.
/// Measured 0: they are handed through.
#[test]
fn what_is_given_is_kept() {
    for mode in [BaseMode::Free, BaseMode::AttitudeHeld, BaseMode::Fixed] {
        for_every_robot(0.0, |s| {
            let k = kinematics(&s.robot, &s.state);
            let found = driven_dynamics(&k, &mixed_drives(s, &s.xi), mode, &s.external);
            let kept = s.robot.joints().all(|j| {
                let (given, kept) = if s.follows[j] {
                    (s.nudot.joints[j], found.nudot.joints[j])
                } else {
                    (s.xi[j], found.force.joints[j])
                };
                given == kept
            });
            let base = match mode {
                BaseMode::Free => found.force.base == SpatialForce::zero(),
                BaseMode::AttitudeHeld => {
                    found.nudot.base.angular == Vec3::zero()
                        && found.force.base.force == Vec3::zero()
                }
                BaseMode::Fixed => found.nudot.base == SpatialVelocity::zero(),
            };
            f64::from(!(kept && base))
        });
    }
}

/// The motion of mixed drives is that of the efforts they took. Measured 2e-14.
#[test]
fn the_efforts_of_joints_that_follow_give_the_same_motion_when_all_are_forced() {
    for mode in [BaseMode::Free, BaseMode::AttitudeHeld, BaseMode::Fixed] {
        for_every_robot(1e-12, |s| {
            let k = kinematics(&s.robot, &s.state);
            let found = driven_dynamics(&k, &mixed_drives(s, &s.xi), mode, &s.external);
            let again = forward_dynamics(&k, &found.force, &s.external);
            gap(&again, &found.nudot)
        });
    }
}

/// Joints that do not move are no joints: with all of them locked the robot is one rigid body.
/// Measured 5e-15.
#[test]
fn a_robot_with_locked_joints_moves_like_its_composite_inertia() {
    for_every_robot(1e-13, |s| {
        let mut state = s.state;
        state.v = [0.0; JOINTS];
        let k = kinematics(&s.robot, &state);
        let none = PerBody { links: [SpatialForce::zero(); JOINTS], ..s.external };
        let locked = [JointDrive::Acceleration(0.0); JOINTS];
        let found = driven_dynamics(&k, &locked, BaseMode::Free, &none);
        let (M, V) = (mass_matrix(&k).M_bb, state.V_NB_B);
        let whole = M.velocity_of(&(s.external.base - V.cross_force(&(M * V))));
        gap(&found.nudot.base, &whole)
    });
}
