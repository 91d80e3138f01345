//! The coupling of base and joints: whatever torque the base gets, the joints get their accelerations.

use wrasse_dynamics::{
    BaseMode, BodyId, JointDrive, PerBody, State, driven_dynamics, kinematics, momentum,
};
use wrasse_flight::{
    ArmLaw, CouplingInertia, Feedforward, Tuning, computed_torque, feedforward_torque,
};
use wrasse_hardware::SetPoint;
use wrasse_spatial::{SpatialForce, SpatialInertia, SpatialVelocity, Vec3};
use wrasse_testing::Worst;
use wrasse_testing::random_robot::{Random, Recipe, Scene};

/// Trees of one to nine joints on one to three arms, the base not turning.
fn scenes() -> impl Iterator<Item = Scene> {
    (0..200_usize).map(|seed| {
        let mut scene = Scene::new(&Recipe {
            seed: seed as u64,
            joints: 1 + seed % 9,
            arms: 1 + seed % 3,
            sliding: 0.25,
            branching: 0.3,
        });
        let V = SpatialVelocity::new(Vec3::zero(), scene.state.V_NB_B.linear);
        scene.state = State { V_NB_B: V, ..scene.state };
        scene
    })
}

/// The system with its joints locked, about the base's origin in base axes.
fn locked(s: &Scene) -> SpatialInertia<f64> {
    wrasse_dynamics::mass_matrix(&kinematics(&s.robot, &s.state)).M_bb
}

/// Second route: the momentum of all bodies, by their poses and twists. Measured 1.0e-14 of it.
#[test]
fn the_reaction_is_the_angular_momentum_of_such_rates_on_a_base_that_slides() {
    let mut worst = Worst::none();
    for s in scenes() {
        let coupling = CouplingInertia::new(&s.robot, &s.state.q);
        let still = State { V_NB_B: SpatialVelocity::zero(), ..s.state };
        let angular = momentum(&kinematics(&s.robot, &still)).angular;
        let angular_B = s.state.X_NB.rotation.transpose_mul(angular);
        let found = coupling.reaction(&s.state.v);
        worst.see((found - angular_B).norm() / (1.0 + angular_B.norm()));
    }
    worst.is_below(3e-13);
}

/// The torques of an attitude-held law, corrected for a base that gets any torque instead of the one
/// that holds it, give the accelerations that were asked for. Third route: forward dynamics. Measured
/// 4.9e-14 rad/s².
#[test]
fn joints_get_their_accelerations_whatever_torque_the_base_gets() {
    let (mut worst, mut uncorrected) = (Worst::none(), Worst::none());
    for s in scenes() {
        let mut random = Random(s.robot.mass().to_bits());
        let torque_B = random.vector(50.0);
        let joints = core::array::from_fn(|j| SetPoint {
            position: s.state.q[j],
            rate: s.state.v[j],
            acceleration: s.nudot.joints[j],
        });
        let tuning = Tuning {
            period: 0.01,
            tool_gain: 0.0,
            joint_bandwidth: 0.0,
            joint_damping: 1.0,
            attitude_bandwidth: 0.0,
            attitude_damping: 1.0,
        };
        let law = ArmLaw::AttitudeHeld;
        let plain = computed_torque(&s.robot, law, &tuning, &s.state, &joints, &s.nudot.joints);
        let holding_B = feedforward_torque(&s.robot, Feedforward::Exact, &joints);
        let coupling = CouplingInertia::new(&s.robot, &s.state.q);
        let change = coupling.effort(locked(&s).central().solve(torque_B - holding_B));
        let found = |tau: &dyn Fn(usize) -> f64| {
            let mut outside = PerBody::filled(SpatialForce::zero());
            outside[BodyId::Base].torque = torque_B;
            let drives = core::array::from_fn(|j| JointDrive::Effort(tau(j)));
            let k = kinematics(&s.robot, &s.state);
            driven_dynamics(&k, &drives, BaseMode::Free, &outside).nudot.joints
        };
        for j in s.robot.joints() {
            worst.see((found(&|j| plain[j] + change[j])[j] - s.nudot.joints[j]).abs());
            uncorrected.see((found(&|j| plain[j])[j] - s.nudot.joints[j]).abs());
        }
    }
    worst.is_below(1e-12);
    assert!(uncorrected.largest() > 1.0, "the correction is needed");
}
