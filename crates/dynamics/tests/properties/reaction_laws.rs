//! The reaction at the mounts and the attitude torque: exact, by the sum over bodies, and as
//! printed.

use crate::in_time::{Rate, in_time};
use crate::measure::{any_robot, for_every, for_every_robot};
use proptest::prelude::Strategy;
use wrasse_dynamics::{
    BaseMode, BodyId, Generalized, JointDrive, PerBody, State, attitude_torque, driven_dynamics,
    inverse_dynamics, kinematics, mount_reaction, printed_reaction,
};
use wrasse_spatial::{Dual, SpatialForce, SpatialVelocity, Sym3, Vec3};
use wrasse_testing::random_robot::{JOINTS, Recipe, Scene};
use wrasse_testing::{gap, gap_at, larger, largest, size};

fn nothing() -> PerBody<SpatialForce<f64>, JOINTS> {
    PerBody::filled(SpatialForce::zero())
}

fn one_armed() -> impl Strategy<Value = Recipe> {
    any_robot().prop_map(|recipe| Recipe { arms: 1, branching: 0.0, ..recipe })
}

/// One body of the sum: `m`, `p_cm`, `a_cm` and the rate of its spin, all inertial, by derivatives.
struct Part {
    body: BodyId,
    m: f64,
    p: Vec3<f64>,
    a: Vec3<f64>,
    spin_rate: Vec3<f64>,
}

fn parts(s: &Scene) -> Vec<Part> {
    let robot = s.robot.cast::<Dual<f64>>();
    let moving = in_time(&s.state, &s.nudot);
    let k = kinematics(&robot, &moving);
    let part = |body: BodyId| {
        let (M, X, V) = (robot.inertia(body), &k.X_NB(body), &k.V_NB_B(body));
        let p_BBcm_B = M.centre_of_mass();
        let v = X.rotation * V.shifted_by(p_BBcm_B).linear;
        let spin = X.rotation * (M.central() * V.angular);
        Part {
            body,
            m: M.mass.value,
            p: X.point(p_BBcm_B).map(|x| x.value),
            a: v.rate(),
            spin_rate: spin.rate(),
        }
    };
    robot.bodies().map(part).collect()
}

/// The parts of the arm that joint `root` mounts.
fn arm(s: &Scene, root: usize) -> Vec<Part> {
    let mut all = parts(s);
    all.retain(|part| s.robot.chain_root(part.body) == Some(root));
    all
}

fn force_of(parts: &[Part]) -> Vec3<f64> {
    parts.iter().fold(Vec3::zero(), |F, part| F + part.a * part.m)
}

/// `Σ [N_i + (r_ci - p) × F_i]`.
fn moment_of(parts: &[Part], p: Vec3<f64>) -> Vec3<f64> {
    parts
        .iter()
        .fold(Vec3::zero(), |N, part| N + part.spin_rate + (part.p - p).cross(part.a * part.m))
}

fn centre_of(parts: &[Part]) -> Vec3<f64> {
    let m: f64 = parts.iter().map(|part| part.m).sum();
    parts.iter().fold(Vec3::zero(), |p, part| p + part.p * (part.m / m))
}

fn mounts(s: &Scene) -> impl Iterator<Item = usize> + '_ {
    s.robot.joints().filter(|&j| s.robot.joint(j).parent == BodyId::Base)
}

/// A scene whose base does not turn and which nothing pushes: attitude held, joints as told.
fn attitude_held(s: &Scene) -> Scene {
    let mut held = Scene { ..*s };
    held.state.V_NB_B.angular = Vec3::zero();
    let k = kinematics(&held.robot, &held.state);
    let drives = s.nudot.joints.map(JointDrive::Acceleration);
    held.nudot = driven_dynamics(&k, &drives, BaseMode::AttitudeHeld, &nothing()).nudot;
    held
}

/// Measured 2e-15.
#[test]
fn the_reaction_of_each_arm_is_the_sum_over_its_bodies() {
    for_every_robot(1e-13, |s| {
        let k = kinematics(&s.robot, &s.state);
        let dynamics = inverse_dynamics(&k, &s.nudot, &nothing());
        largest(mounts(s).map(|root| {
            let (arm, p_1) = (arm(s, root), k.joint_origin(root));
            let expected = SpatialForce::new(moment_of(&arm, p_1), force_of(&arm));
            gap(&mount_reaction(&k, &dynamics, root), &expected)
        }))
    });
}

/// A wrench that the environment puts on the tip is that much less for the mount.
/// Measured 8e-16.
#[test]
fn a_tip_wrench_relieves_the_mount_by_itself() {
    for_every_robot(1e-14, |s| {
        let k = kinematics(&s.robot, &s.state);
        let body = s.frame.body;
        let root = s.robot.chain_root(body).unwrap();
        let mut pushed = nothing();
        pushed[body] = s.external[body];
        let free = mount_reaction(&k, &inverse_dynamics(&k, &s.nudot, &nothing()), root);
        let relieved = mount_reaction(&k, &inverse_dynamics(&k, &s.nudot, &pushed), root);
        let F_e = k.X_NB(body).force_to_parent(&pushed[body]).about(k.joint_origin(root));
        gap_at(&(free - relieved), &F_e, larger(size(&free), size(&relieved)))
    });
}

/// All bodies, the base too, about the base's centre of mass. Measured 2e-15.
#[test]
fn the_attitude_torque_is_the_sum_over_all_bodies() {
    for_every_robot(1e-13, |s| {
        let k = kinematics(&s.robot, &s.state);
        let torque = attitude_torque(&k, &inverse_dynamics(&k, &s.nudot, &nothing()));
        let all = parts(s);
        gap_at(&torque, &moment_of(&all, all[0].p), larger(size(&torque), size(&force_of(&all))))
    });
}

/// The torque is what the arms take at their mounts, carried to the base's centre of mass: with the
/// attitude held the base adds nothing. Measured 5e-13.
#[test]
fn the_attitude_torque_of_a_held_base_is_the_mount_moments_and_their_levers() {
    for_every_robot(1e-11, |s| {
        let held = attitude_held(s);
        let k = kinematics(&held.robot, &held.state);
        let dynamics = inverse_dynamics(&k, &held.nudot, &nothing());
        let p_0 = k.X_NB(BodyId::Base).point(held.robot.inertia(BodyId::Base).centre_of_mass());
        let sum = mounts(&held).fold(Vec3::zero(), |sum, root| {
            let F = mount_reaction(&k, &dynamics, root);
            sum + F.torque + (k.joint_origin(root) - p_0).cross(F.force)
        });
        gap(&attitude_torque(&k, &dynamics), &sum)
    });
}

/// What holds the base in forward dynamics is the attitude torque of inverse dynamics, and the bus
/// recoils: `F_T = -m_0 a_0` over all arms. Measured 2e-14.
#[test]
fn the_torque_that_holds_the_base_is_the_attitude_torque() {
    for_every_robot(1e-12, |s| {
        let held = attitude_held(s);
        let k = kinematics(&held.robot, &held.state);
        let drives = s.nudot.joints.map(JointDrive::Acceleration);
        let found = driven_dynamics(&k, &drives, BaseMode::AttitudeHeld, &nothing());
        let dynamics = inverse_dynamics(&k, &found.nudot, &nothing());
        let torque = held.state.X_NB.rotation * found.force.base.torque;
        let all = parts(&held);
        let (F_T, recoil) = (force_of(&all[1..]), all[0].a * -all[0].m);
        larger(gap(&torque, &attitude_torque(&k, &dynamics)), gap(&F_T, &recoil))
    });
}

/// The exact lumped form: `N = N_T + (p_a - p_1) × F_T + Σ m (r_c - p_a) × (a_c - a_a)`. The last
/// sum is what eq. (3) leaves out. Measured 2e-15.
#[test]
fn the_printed_moment_lacks_the_orbital_part_of_the_arm() {
    for_every_robot(1e-13, |s| {
        let k = kinematics(&s.robot, &s.state);
        let dynamics = inverse_dynamics(&k, &s.nudot, &nothing());
        largest(mounts(s).map(|root| {
            let exact = mount_reaction(&k, &dynamics, root);
            let printed = printed_reaction(&k, &s.nudot, root);
            let arm = arm(s, root);
            let (m, p_a) = (arm.iter().map(|part| part.m).sum::<f64>(), centre_of(&arm));
            let a_a = force_of(&arm) * (1.0 / m);
            let orbital = arm.iter().fold(Vec3::zero(), |sum, part| {
                sum + (part.p - p_a).cross((part.a - a_a) * part.m)
            });
            let scale = larger(size(&exact), size(&orbital));
            let spin = arm.iter().fold(Vec3::zero(), |sum, part| sum + part.spin_rate);
            largest([
                gap_at(&(printed.N_r_arm_cm + orbital), &exact.torque, scale),
                gap_at(&printed.F_T, &exact.force, scale),
                gap_at(&printed.N_T, &spin, scale),
            ])
        }))
    });
}

/// The two readings of `p*_cm` differ by the lever between them. Measured 4e-15.
#[test]
fn the_two_readings_of_equation_3_differ_by_a_lever() {
    for_every_robot(1e-13, |s| {
        let k = kinematics(&s.robot, &s.state);
        largest(mounts(s).map(|root| {
            let printed = printed_reaction(&k, &s.nudot, root);
            let lever = centre_of(&arm(s, root)) - k.centre_of_mass().1;
            let expected = lever.cross(printed.F_T);
            let scale = larger(size(&printed.N_r_arm_cm), size(&printed.N_r_system_cm));
            gap_at(&(printed.N_r_arm_cm - printed.N_r_system_cm), &expected, scale)
        }))
    });
}

/// Eq. (4) sums over the parts as they were listed: a load that is fixed to the last link counts
/// with its own central inertia, wherever it sits. Measured 4e-15.
#[test]
fn a_fixed_part_adds_its_own_spin_to_the_printed_moment() {
    for_every_robot(1e-13, |s| {
        let k = kinematics(&s.robot, &s.state);
        let loaded = s.robot.with_payload(&s.frame, &s.load);
        let k_loaded = kinematics(&loaded, &s.state);
        let root = s.robot.chain_root(s.frame.body).unwrap();
        let with = printed_reaction(&k_loaded, &s.nudot, root).N_T;
        let without = printed_reaction(&k, &s.nudot, root).N_T;
        let robot = s.robot.cast::<Dual<f64>>();
        let moving = in_time(&s.state, &s.nudot);
        let moving = kinematics(&robot, &moving);
        let w_B = moving.V_NB_B(s.frame.body).angular;
        let (R, I_F) = (s.frame.X_BF.rotation, s.load.I_parts_F.to_mat3());
        let I_B = Sym3::symmetric_part(&(R * I_F * R.transpose()));
        let spin = moving.X_NB(s.frame.body).rotation * (Sym3::from_f64(I_B) * w_B);
        gap_at(&(with - without), &spin.rate(), larger(size(&with), size(&spin.rate())))
    });
}

/// The by-product of a terrestrial run: `F_T = (m_0/m_T) F_fix` and
/// `N = N_fix - (m_a/m_T) (p_a - p_1) × F_fix`. Measured 3e-15.
#[test]
fn a_terrestrial_run_gives_the_reaction_after_two_vector_operations() {
    for_every(one_armed(), 1e-13, |s| {
        let held = attitude_held(s);
        let k = kinematics(&held.robot, &held.state);
        let free = mount_reaction(&k, &inverse_dynamics(&k, &held.nudot, &nothing()), 0);
        let fixed = State { V_NB_B: SpatialVelocity::zero(), ..held.state };
        let k_fixed = kinematics(&held.robot, &fixed);
        let nudot = Generalized { base: SpatialVelocity::zero(), ..held.nudot };
        let F_fix = mount_reaction(&k_fixed, &inverse_dynamics(&k_fixed, &nudot, &nothing()), 0);
        let arm = arm(&held, 0);
        let (m_a, m_T) = (arm.iter().map(|part| part.m).sum::<f64>(), held.robot.mass());
        let lever = centre_of(&arm) - k.joint_origin(0);
        let N = F_fix.torque - lever.cross(F_fix.force) * (m_a / m_T);
        let expected = SpatialForce::new(N, F_fix.force * ((m_T - m_a) / m_T));
        gap_at(&free, &expected, size(&F_fix))
    });
}
