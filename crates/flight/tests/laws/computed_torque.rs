//! Computed torque: forward dynamics under its torques returns the acceleration that was commanded.

use std::array;
use wrasse_dynamics::{
    BaseMode, BodyId, Frame, Joint, JointDrive, JointKind, MassProperties, PerBody, Robot, State,
    bias_force, driven_dynamics, free_floating_dynamics, kinematics, mass_matrix,
};
use wrasse_flight::{ArmLaw, Tuning, computed_torque};
use wrasse_hardware::SetPoint;
use wrasse_spatial::{Pose, SpatialForce, SpatialVelocity, Sym3, Vec3, vec3};
use wrasse_testing::random_robot::{JOINTS, Random, Recipe, Scene};
use wrasse_testing::{Worst, largest};

/// Trees of one to nine joints on one to three arms.
fn scenes() -> impl Iterator<Item = Scene> {
    (0..200_usize).map(|seed| {
        Scene::new(&Recipe {
            seed: seed as u64,
            joints: 1 + seed % 9,
            arms: 1 + seed % 3,
            sliding: 0.25,
            branching: 0.3,
        })
    })
}

fn tuning(joint_bandwidth: f64) -> Tuning<f64> {
    Tuning {
        period: 0.01,
        tool_gain: 0.0,
        joint_bandwidth,
        joint_damping: 0.7,
        attitude_bandwidth: 0.0,
        attitude_damping: 1.0,
    }
}

/// Joint accelerations under the law's torques, and those that it commanded: what is fed forward,
/// and `2ζω ė + ω² e` of set-points that the joints are off from.
fn found_and_commanded(
    s: &Scene,
    law: ArmLaw,
    state: &State<f64, JOINTS>,
    base: BaseMode,
) -> [[f64; JOINTS]; 2] {
    let mut random = Random(s.robot.mass().to_bits());
    let off: [[f64; 2]; JOINTS] = array::from_fn(|_| [random.within(0.1), random.within(0.2)]);
    let now = array::from_fn(|j| SetPoint {
        position: state.q[j] + off[j][0],
        rate: state.v[j] + off[j][1],
        acceleration: 99.0,
    });
    let tau = computed_torque(&s.robot, law, &tuning(3.0), state, &now, &s.nudot.joints);
    let found = accelerations(&s.robot, state, &tau, base);
    let commanded = array::from_fn(|j| {
        let back = 2.0 * 0.7 * 3.0 * off[j][1] + 9.0 * off[j][0];
        if j < s.robot.joint_count() { s.nudot.joints[j] + back } else { 0.0 }
    });
    [found, commanded]
}

fn accelerations<const J: usize>(
    robot: &Robot<f64, J>,
    state: &State<f64, J>,
    tau: &[f64; J],
    base: BaseMode,
) -> [f64; J] {
    let drives = tau.map(JointDrive::Effort);
    let nothing = PerBody::filled(SpatialForce::zero());
    driven_dynamics(&kinematics(robot, state), &drives, base, &nothing).nudot.joints
}

/// Round-off of two eliminations. Measured 2.5e-14 rad/s².
#[test]
fn a_free_floating_law_gets_its_acceleration_whatever_the_base_does() {
    let mut worst = Worst::none();
    for s in scenes() {
        let [found, commanded] =
            found_and_commanded(&s, ArmLaw::FreeFloating, &s.state, BaseMode::Free);
        worst.see_all(found, commanded);
    }
    worst.is_below(3e-13);
}

/// The base translates as it likes. Measured 3.4e-14 rad/s².
#[test]
fn an_attitude_held_law_gets_its_acceleration_where_the_attitude_is_held() {
    let mut worst = Worst::none();
    for s in scenes() {
        let V = SpatialVelocity::new(Vec3::zero(), s.state.V_NB_B.linear);
        let state = State { V_NB_B: V, ..s.state };
        let [found, commanded] =
            found_and_commanded(&s, ArmLaw::AttitudeHeld, &state, BaseMode::AttitudeHeld);
        worst.see_all(found, commanded);
    }
    worst.is_below(3e-13);
}

/// A base of 1e9 times the mass still gives way by 1e-9 of the arm's motion, and light joints feel
/// that of heavy ones. Measured 2.2e-8 rad/s².
#[test]
fn a_terrestrial_law_gets_its_acceleration_on_a_heavy_base() {
    let mut worst = Worst::none();
    for mut s in scenes() {
        let on_base = Frame { body: BodyId::Base, X_BF: Pose::identity() };
        let ballast = Random(11).matter(1e9 * s.robot.mass(), 2.0);
        s.robot = s.robot.with_payload(&on_base, &ballast);
        let state = State { V_NB_B: SpatialVelocity::zero(), ..s.state };
        let [found, commanded] =
            found_and_commanded(&s, ArmLaw::Terrestrial, &state, BaseMode::Free);
        worst.see_all(found, commanded);
    }
    worst.is_below(2e-7);
}

/// What a law takes the base for is what it leaves out of the sensed twist: the same bits come out.
#[test]
fn a_law_ignores_the_base_motion_that_it_rules_out() {
    for s in scenes() {
        let torque = |law, V_NB_B| {
            let (state, at_rest) = (State { V_NB_B, ..s.state }, [SetPoint::default(); JOINTS]);
            computed_torque(&s.robot, law, &tuning(3.0), &state, &at_rest, &s.xi)
        };
        let V = s.state.V_NB_B;
        let along = SpatialVelocity::new(Vec3::zero(), V.linear);
        assert_eq!(
            torque(ArmLaw::Terrestrial, V),
            torque(ArmLaw::Terrestrial, SpatialVelocity::zero())
        );
        assert_eq!(torque(ArmLaw::AttitudeHeld, V), torque(ArmLaw::AttitudeHeld, along));
        assert_ne!(torque(ArmLaw::FreeFloating, V), torque(ArmLaw::FreeFloating, along));
    }
}

/// `H* q̈ = M_jj q̈_c`: nothing moves yet, so that inertia alone decides. Measured 2.7e-15 of the
/// largest effort.
#[test]
fn a_terrestrial_law_on_a_free_flyer_multiplies_accelerations_by_the_ratio_of_inertias() {
    let mut worst = Worst::none();
    for s in scenes() {
        let state = State { q: s.state.q, ..State::default() };
        let now = array::from_fn(|j| SetPoint { position: state.q[j], ..SetPoint::default() });
        let tau = computed_torque(&s.robot, ArmLaw::Terrestrial, &tuning(3.0), &state, &now, &s.xi);
        let found = accelerations(&s.robot, &state, &tau, BaseMode::Free);
        let k = kinematics(&s.robot, &state);
        let reduced = free_floating_dynamics(&s.robot, &mass_matrix(&k), &bias_force(&k));
        let most = largest(tau.iter().map(|t| t.abs()));
        for (effort, tau) in reduced.effort(&s.robot, &found).into_iter().zip(tau) {
            worst.see((effort - tau).abs() / most);
        }
    }
    worst.is_below(3e-14);
}

/// Two bodies in a plane: with the reduced mass μ = m₀m₁/(m₀+m₁), A = I₀ + μa², B = I₁ + μb² and
/// C = μab cos q, zero momentum leaves `H* = (AB - C²)/(A + B + 2C)` of `H_m = I₁ + m₁b²`. Measured
/// 2.2e-16.
#[test]
fn one_joint_of_a_free_flyer_is_accelerated_too_much_by_the_closed_form_ratio() {
    let (m0, I0, a) = (40.0, 6.0, 0.5);
    let (m1, I1, b) = (10.0, 0.8, 0.7);
    let flat = |mass, p, I| MassProperties::from_central(mass, p, Sym3::diagonal(I, I, I));
    let mount = Pose { translation: vec3(a, 0.0, 0.0), ..Pose::identity() };
    let joint = Joint::new(BodyId::Base, JointKind::Revolute, mount, vec3(0.0, 0.0, 1.0));
    let link = flat(m1, vec3(b, 0.0, 0.0), I1);
    let robot: Robot<f64, 1> = Robot::new(flat(m0, Vec3::zero(), I0), &[(joint, link)]).unwrap();
    let mut worst = Worst::none();
    for q in [-2.0, -0.4, 0.7, 3.0] {
        let state = State { q: [q], ..State::default() };
        let now = [SetPoint { position: q, ..SetPoint::default() }];
        let tau = computed_torque(&robot, ArmLaw::Terrestrial, &tuning(3.0), &state, &now, &[1.0]);
        let [found] = accelerations(&robot, &state, &tau, BaseMode::Free);
        let mu = m0 * m1 / (m0 + m1);
        let (A, B, C) = (I0 + mu * a * a, I1 + mu * b * b, mu * a * b * q.cos());
        let ratio = (I1 + m1 * b * b) * (A + B + 2.0 * C) / (A * B - C * C);
        assert!(ratio > 1.3, "measured 1.43 to 2.52: {ratio}");
        worst.see((found / ratio - 1.0).abs());
    }
    worst.is_below(2e-15);
}
