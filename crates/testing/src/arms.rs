//! The arms that the tests bend, and how far a tool is from its target.

use proptest::test_runner::{Config, RngSeed};
use wrasse_dynamics::{BodyId, Frame, Joint, JointKind, MassProperties, Robot, State, kinematics};
use wrasse_spatial::{Mat3, Pose, Quat, Sym3, Vec3, vec3};

/// Axis x.
pub const X: Vec3<f64> = vec3(1.0, 0.0, 0.0);
/// Axis y.
pub const Y: Vec3<f64> = vec3(0.0, 1.0, 0.0);
/// Axis z.
pub const Z: Vec3<f64> = vec3(0.0, 0.0, 1.0);

/// The same cases every time.
pub fn cases() -> Config {
    Config {
        cases: 256,
        rng_seed: RngSeed::Fixed(20_040_901),
        failure_persistence: None,
        ..Config::default()
    }
}

/// A cylinder-like body: mass (kg), centre of mass (m), inertia about x and about the others.
fn body(mass: f64, p_cm: Vec3<f64>, about_x: f64, across: f64) -> MassProperties<f64> {
    MassProperties::from_central(mass, p_cm, Sym3::diagonal(about_x, across, across))
}

/// The ATLAS-class servicer: 1500 kg bus, seven joints x, y, x | y | x, y, x with 0.45, 0.40 and
/// 0.20 m between shoulder, elbow, wrist and tool, mounted at (0.9, 0.5, 0) m.
pub fn atlas_class() -> (Robot<f64, 7>, Frame<f64>) {
    atlas_class_with_offset(Vec3::zero())
}

/// The same with the centres of mass of the links moved off their axes (m).
pub fn atlas_class_with_offset(off: Vec3<f64>) -> (Robot<f64, 7>, Frame<f64>) {
    let bus =
        MassProperties::from_central(1500.0, Vec3::zero(), Sym3::diagonal(640.0, 725.0, 725.0));
    // From the joint before (m), axis, mass (kg), centre of mass along x (m), inertias (kg m²).
    let rows = [
        (vec3(0.9, 0.5, 0.0), X, 10.0, 0.0, 0.018, 0.021),
        (Vec3::zero(), Y, 10.0, 0.05, 0.018, 0.021),
        (Vec3::zero(), X, 8.0, 0.225, 0.0144, 0.1422),
        (vec3(0.45, 0.0, 0.0), Y, 8.0, 0.05, 0.0144, 0.0168),
        (Vec3::zero(), X, 6.0, 0.2, 0.0108, 0.0854),
        (vec3(0.4, 0.0, 0.0), Y, 6.0, 0.03, 0.0108, 0.0104),
        (Vec3::zero(), X, 8.0, 0.1, 0.0144, 0.033_867),
    ];
    let mut links = Vec::new();
    for (j, (p, axis, mass, cm, about_x, across)) in rows.into_iter().enumerate() {
        let parent = if j == 0 { BodyId::Base } else { BodyId::Link(j - 1) };
        let joint = Joint::new(parent, JointKind::Revolute, Pose::new(Mat3::identity(), p), axis);
        links.push((joint, body(mass, vec3(cm, 0.0, 0.0) + off, about_x, across)));
    }
    let tool =
        Frame { body: BodyId::Link(6), X_BF: Pose::new(Mat3::identity(), vec3(0.2, 0.0, 0.0)) };
    (Robot::new(bus, &links).expect("parents come first"), tool)
}

/// A cube of 1 m gripped at a face: its centre of mass is 0.5 m ahead, and `aside` (m) off.
pub fn cube(mass: f64, aside: Vec3<f64>) -> MassProperties<f64> {
    let I = mass / 6.0;
    MassProperties::from_central(mass, vec3(0.5, 0.0, 0.0) + aside, Sym3::diagonal(I, I, I))
}

/// An industrial lightweight arm, axes z, y, z | y | z, y, z, its frames placed off the points
/// where the axes meet, on a turned mount; the elbow's axis is `elbow_offset` (m) off the line,
/// and the forearm 0.03 m along it.
pub fn upright_arm(elbow_offset: f64) -> (Robot<f64, 8>, Frame<f64>) {
    let turned = |r: Vec3<f64>, p: Vec3<f64>| Pose::from_quat(Quat::exp(r), p);
    let rows = [
        (turned(vec3(0.4, -0.3, 0.7), vec3(0.2, -0.1, 0.3)), Z),
        (turned(vec3(0.0, 0.0, 0.2), vec3(0.0, 0.0, 0.31)), Y),
        (turned(vec3(0.0, -0.5, 0.0), Vec3::zero()), vec3(-(0.5_f64.sin()), 0.0, 0.5_f64.cos())),
        (turned(Vec3::zero(), along_third(0.4) + X * elbow_offset), Y),
        (turned(vec3(0.0, 0.3, 0.0), along_third(0.1) + X * (-elbow_offset) + Y * 0.03), fifth()),
        (turned(Vec3::zero(), fifth() * 0.29), Y),
        (turned(Vec3::zero(), Y * 0.0), fifth()),
    ];
    let mut links = Vec::new();
    for (j, (X_PB, axis)) in rows.into_iter().enumerate() {
        let parent = if j == 0 { BodyId::Base } else { BodyId::Link(j - 1) };
        links.push((
            Joint::new(parent, JointKind::Revolute, X_PB, axis),
            body(5.0, X * 0.1, 0.1, 0.2),
        ));
    }
    let base = body(400.0, Vec3::zero(), 60.0, 70.0);
    let tool =
        Frame { body: BodyId::Link(6), X_BF: turned(vec3(0.1, 0.9, -0.4), vec3(0.05, 0.02, 0.2)) };
    (Robot::new(base, &links).expect("parents come first"), tool)
}

fn along_third(length: f64) -> Vec3<f64> {
    vec3(-(0.5_f64.sin()), 0.0, 0.5_f64.cos()) * length
}

fn fifth() -> Vec3<f64> {
    vec3(-(0.8_f64.sin()), 0.0, 0.8_f64.cos())
}

/// The ATLAS-class arm behind a two-joint arm that holds 150 kg.
pub fn two_arms() -> (Robot<f64, 9>, Frame<f64>) {
    let (one, tool) = atlas_class();
    let matter = |body| MassProperties { M_F_F: *one.inertia(body), ..MassProperties::default() };
    let heavy =
        MassProperties::from_central(150.0, vec3(0.3, 0.2, -0.1), Sym3::diagonal(9.0, 8.0, 7.0));
    let mount = Pose::from_quat(Quat::exp(vec3(0.3, 0.1, -0.2)), vec3(0.9, -0.5, 0.0));
    let mut links = vec![
        (Joint::new(BodyId::Base, JointKind::Revolute, mount, vec3(0.2, 0.3, 0.9)), heavy),
        (Joint::new(BodyId::Link(0), JointKind::Prismatic, mount, vec3(0.5, -0.3, 0.1)), heavy),
    ];
    for j in 0..7 {
        let parent = if j == 0 { BodyId::Base } else { BodyId::Link(j + 1) };
        let joint = one.joint(j);
        let joint = Joint::new(parent, joint.kind, joint.X_PB_zero, joint.axis_B);
        links.push((joint, matter(BodyId::Link(j))));
    }
    let tool = Frame { body: BodyId::Link(8), ..tool };
    (Robot::new(matter(BodyId::Base), &links).expect("parents come first"), tool)
}

/// Distance (m) and angle (rad) between two poses.
pub fn difference(a: &Pose<f64>, b: &Pose<f64>) -> (f64, f64) {
    let turn = Quat::from_matrix(&(a.rotation.transpose() * b.rotation)).log().norm();
    ((a.translation - b.translation).norm(), turn)
}

/// Pose of the tool from the anchor, by the robot's own kinematics: `X_BE` of a fixed base.
pub fn tool_from_base<const J: usize>(
    robot: &Robot<f64, J>,
    tool: &Frame<f64>,
    q: &[f64; J],
) -> Pose<f64> {
    let state = State { q: *q, ..State::default() };
    kinematics(robot, &state).pose(tool)
}

/// The same from the centre of mass of the whole system, with base axes.
pub fn tool_from_centre_of_mass<const J: usize>(
    robot: &Robot<f64, J>,
    tool: &Frame<f64>,
    q: &[f64; J],
) -> Pose<f64> {
    let state = State { q: *q, ..State::default() };
    let k = kinematics(robot, &state);
    let X_BE = k.pose(tool);
    Pose::new(X_BE.rotation, X_BE.translation - k.centre_of_mass().1)
}
