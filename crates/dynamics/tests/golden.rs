//! The dynamics against outside data: Pinocchio 4.1 on random trees, and the quantities of Ellery's
//! paper from a Newton–Euler sum over bodies.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]
#![allow(clippy::unwrap_used, reason = "a test may stop where it finds nothing")]
#![allow(clippy::print_stdout, reason = "prints what was measured, under --nocapture")]

mod derivatives;
mod urdf_robot;

use serde_json::Value;
use std::{array, fs, path::PathBuf};
use urdf_robot::{JOINTS, UrdfRobot};
use wrasse_dynamics::{
    BodyId, Frame, Generalized, GeneralizedForce, GeneralizedVelocity, InverseDynamics, Kinematics,
    PerBody, State, attitude_held_jacobian, attitude_torque, barycentric_vectors, bias_force,
    forward_dynamics, generalized_jacobian, inverse_dynamics, jacobian, kinematics, kinetic_energy,
    mass_matrix, momentum, mount_reaction, printed_reaction, virtual_manipulator,
};
use wrasse_spatial::{Pose, Quat, SpatialForce, SpatialVelocity, Vec3};
use wrasse_testing::{larger, largest};

/// Asked of every array, relative to its largest element: the numbers carry 17 digits and both
/// sides sum about ten bodies. Measured 8e-15 at most (angular momentum).
const RELATIVE: f64 = 1e-11;
/// Asked where a matrix of condition 1e5 is solved, or large terms cancel. Measured 1e-12
/// at most (printed N_T, whose golden sum is itself good to 2e-12).
const RELATIVE_SOLVED: f64 = 1e-9;
/// Below this a difference does not count: quantities that are zero by symmetry.
const FLOOR: f64 = 1e-12;

fn golden(file: &str) -> String {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../validation/golden");
    fs::read_to_string(folder.join(file)).unwrap()
}

fn json(file: &str) -> Value {
    serde_json::from_str(&golden(file)).unwrap()
}

/// All numbers below a value, in order.
fn flat(value: &Value) -> Vec<f64> {
    match value {
        Value::Array(items) => items.iter().flat_map(flat).collect(),
        number => vec![number.as_f64().unwrap()],
    }
}

fn vector(value: &Value) -> Vec3<f64> {
    if value.is_null() { Vec3::zero() } else { Vec3::from_array(flat(value).try_into().unwrap()) }
}

/// An attitude is the same with either sign.
fn quaternion(value: &Value) -> Quat<f64> {
    let part = |key: &str| value[key].as_f64().unwrap();
    Quat::new(part("w"), part("x"), part("y"), part("z"))
}

#[track_caller]
fn agree(what: &str, found: &[f64], expected: &Value, relative: f64) {
    agree_with(what, found, &flat(expected), relative);
}

#[track_caller]
fn agree_with(what: &str, found: &[f64], expected: &[f64], relative: f64) {
    assert_eq!(found.len(), expected.len(), "{what}: number of elements");
    let scale = largest(expected.iter().map(|x| x.abs()));
    let worst = largest(found.iter().zip(expected).map(|(a, b)| (a - b).abs()));
    println!("{what}: {:.1e} of the largest element", worst / larger(scale, 1e-300));
    let allowed = larger(FLOOR, relative * scale);
    assert!(worst <= allowed, "{what}: off by {worst:e}\n{found:?}\n{expected:?}");
}

/// One state of a golden file, as the dynamics take it.
struct Case {
    state: State<f64, JOINTS>,
    nudot: GeneralizedVelocity<f64, JOINTS>,
    force: GeneralizedForce<f64, JOINTS>,
}

fn case(vehicle: &UrdfRobot, given: &Value) -> Case {
    let attitude = quaternion(&given["base"]["attitude"]);
    let twist = |key: &str| {
        SpatialVelocity::new(vector(&given[key]["angular"]), vector(&given[key]["linear"]))
    };
    let wrench = &given["base_wrench"];
    let of_joints = |key: &str| {
        let name = |j: usize| vehicle.joint_names.get(j);
        array::from_fn(|j| name(j).map_or(0.0, |n| given["joints"][n][key].as_f64().unwrap_or(0.0)))
    };
    let state = State {
        X_NB: Pose::from_quat(attitude, vector(&given["base"]["position"])),
        V_NB_B: twist("base_velocity"),
        q: of_joints("position"),
        v: of_joints("velocity"),
    };
    Case {
        state,
        nudot: Generalized { base: twist("base_acceleration"), joints: of_joints("acceleration") },
        force: Generalized {
            base: SpatialForce::new(vector(&wrench["torque"]), vector(&wrench["force"])),
            joints: of_joints("torque"),
        },
    }
}

/// The parts of a whole generalized vector, joints in the file's order.
fn whole(base: [f64; 6], joints: &[f64; JOINTS], order: &[usize]) -> Vec<f64> {
    base.into_iter().chain(order.iter().map(|&j| joints[j])).collect()
}

/// A 6-row matrix from its columns, row by row.
fn rows_of(columns: &[SpatialVelocity<f64>]) -> Vec<f64> {
    (0..6).flat_map(|row| columns.iter().map(move |c| c.to_array()[row])).collect()
}

fn check_vehicle(name: &str) {
    let vehicle = urdf_robot::read(&golden(&format!("{name}.urdf")));
    let file = json(&format!("{name}.json"));
    let frame = vehicle.frames[file["input"]["frame"].as_str().unwrap()];
    let names = file["expect"]["joint_names"].as_array().unwrap();
    let number_of = |n: &Value| vehicle.joint_names.iter().position(|m| *m == *n).unwrap();
    let order: Vec<usize> = names.iter().map(number_of).collect();
    let states = file["input"]["states"].as_array().unwrap();
    let results = file["expect"]["results"].as_array().unwrap();
    assert_eq!((states.len(), results.len()), (4, 4));
    for (given, expect) in states.iter().zip(results) {
        let case = case(&vehicle, given);
        let k = kinematics(&vehicle.robot, &case.state);
        check_motion(&k, &frame, &order, expect);
        check_forces(&vehicle, &k, &case, &order, expect);
        check_lambda(&vehicle, &k, &frame, expect);
    }
}

fn check_motion(k: &Kinematics<f64, JOINTS>, frame: &Frame<f64>, order: &[usize], expect: &Value) {
    let h = momentum(k);
    agree("momentum.angular", &h.angular.to_array(), &expect["momentum"]["angular"], RELATIVE);
    agree("momentum.linear", &h.linear.to_array(), &expect["momentum"]["linear"], RELATIVE);
    agree("mass", &[h.mass], &expect["mass"], RELATIVE);
    agree("centre_of_mass", &h.p_NScm_N.to_array(), &expect["centre_of_mass"], RELATIVE);
    agree("kinetic_energy", &[kinetic_energy(k)], &expect["kinetic_energy"], RELATIVE);
    let X_NF = k.pose(frame);
    agree("pose.position", &X_NF.translation.to_array(), &expect["pose"]["position"], RELATIVE);
    let off = Quat::from_matrix(&X_NF.rotation)
        * quaternion(&expect["pose"]["attitude"]).normalized().conjugate();
    assert!(off.log().norm() < RELATIVE, "pose.attitude: off by {:e} rad", off.log().norm());

    let (J_frame, M) = (jacobian(k, frame), mass_matrix(k));
    let in_order =
        |columns: &[SpatialVelocity<f64>]| order.iter().map(|&j| columns[j]).collect::<Vec<_>>();
    let all = [&J_frame.base()[..], &in_order(&J_frame.joints.columns())].concat();
    agree("jacobian", &rows_of(&all), &expect["jacobian"], RELATIVE);
    let free = in_order(&generalized_jacobian(&J_frame, &M).columns());
    agree("generalized_jacobian", &rows_of(&free), &expect["generalized_jacobian"], RELATIVE);
    let held = in_order(&attitude_held_jacobian(&J_frame, &M, &k.state.X_NB.rotation).columns());
    agree("fixed_attitude_jacobian", &rows_of(&held), &expect["fixed_attitude_jacobian"], RELATIVE);

    let place = |i: usize| if i < 6 { i } else { 6 + order[i - 6] };
    let size = 6 + order.len();
    let elements: Vec<f64> =
        (0..size * size).map(|e| M.element(place(e / size), place(e % size))).collect();
    agree("mass_matrix", &elements, &expect["mass_matrix"], RELATIVE);
}

fn check_forces(
    vehicle: &UrdfRobot,
    k: &Kinematics<f64, JOINTS>,
    case: &Case,
    order: &[usize],
    expect: &Value,
) {
    let nothing = PerBody::filled(SpatialForce::zero());
    let c = bias_force(k);
    let found = whole(c.base.to_array(), &c.joints, order);
    agree("bias_force", &found, &expect["bias_force"], RELATIVE);
    let dynamics = inverse_dynamics(k, &case.nudot, &nothing);
    let found = whole(dynamics.force.base.to_array(), &dynamics.force.joints, order);
    agree("inverse_dynamics", &found, &expect["inverse_dynamics"], RELATIVE);
    let nudot = forward_dynamics(k, &case.force, &nothing);
    let found = whole(nudot.base.to_array(), &nudot.joints, order);
    agree("forward_dynamics", &found, &expect["forward_dynamics"], RELATIVE_SOLVED);
    let torque = attitude_torque(k, &dynamics).to_array();
    agree("attitude_torque", &torque, &expect["attitude_torque"], RELATIVE_SOLVED);
    let arms = expect["reaction"].as_array().unwrap();
    for arm in arms {
        let root = vehicle.joint_names.iter().position(|n| *n == arm["arm"]).unwrap();
        check_mount(k, &dynamics, root, arm);
    }
    let leaving = vehicle.robot.joints().filter(|&j| vehicle.robot.joint(j).parent == BodyId::Base);
    assert_eq!(leaving.count(), arms.len(), "every arm has a reaction");
}

fn check_mount(
    k: &Kinematics<f64, JOINTS>,
    dynamics: &InverseDynamics<f64, JOINTS>,
    root: usize,
    expect: &Value,
) {
    let F = mount_reaction(k, dynamics, root);
    agree("reaction.force", &F.force.to_array(), &expect["force"], RELATIVE_SOLVED);
    agree("reaction.moment", &F.torque.to_array(), &expect["moment"], RELATIVE_SOLVED);
}

fn check_lambda(
    vehicle: &UrdfRobot,
    k: &Kinematics<f64, JOINTS>,
    frame: &Frame<f64>,
    expect: &Value,
) {
    let lambda = barycentric_vectors(k, frame);
    let list = expect["lambda"].as_array().unwrap();
    assert_eq!(list.len(), vehicle.joint_names.len() + 1, "one vector per moving body");
    for entry in list {
        let body = match vehicle.joint_names.iter().position(|n| *n == entry["joint"]) {
            Some(j) => BodyId::Link(j),
            None => BodyId::Base,
        };
        agree("lambda", &lambda[body].to_array(), &entry["vector"], RELATIVE);
    }
}

#[test]
fn one_arm_agrees_with_pinocchio() {
    check_vehicle("one_arm");
}

#[test]
fn two_arms_with_prismatic_joints_agree_with_pinocchio() {
    check_vehicle("two_arms");
}

#[test]
fn the_quantities_of_the_paper_agree_with_the_sum_over_bodies() {
    let cases = json("paper_equations.json");
    let cases = cases.as_array().unwrap();
    assert_eq!(cases.len(), 8);
    for case in cases {
        check_paper_case(case);
    }
}

fn check_paper_case(file: &Value) {
    let name = file["vehicle"].as_str().unwrap();
    println!("{name}");
    let vehicle = urdf_robot::read(&golden(name));
    let frame = vehicle.frames[file["input"]["frame"].as_str().unwrap()];
    let (case, expect) = (case(&vehicle, &file["input"]["states"][0]), &file["expect"]);
    let k = kinematics(&vehicle.robot, &case.state);
    let p_NScm = k.centre_of_mass().1;
    agree("centre_of_mass", &p_NScm.to_array(), &expect["centre_of_mass"], RELATIVE);
    agree("position", &k.pose(&frame).translation.to_array(), &expect["position"], RELATIVE);

    let lambda = barycentric_vectors(&k, &frame);
    let p = virtual_manipulator(&k, &lambda, p_NScm);
    agree("virtual manipulator", &p.to_array(), &expect["position"], RELATIVE);
    let listed = expect["lambda_vectors"].as_array().unwrap();
    let last = listed.len() - 1;
    for (body, entry) in vehicle.robot.bodies().zip(listed) {
        let mut expected = vector(entry);
        if body == BodyId::Link(last - 1) {
            // The paper keeps the payload apart; here it is one body with the last link.
            let payload = vehicle.frames.get("payload").unwrap_or(&frame);
            expected += payload.X_BF.rotation * vector(&expect["payload_term"]);
        }
        agree_with("lambda", &lambda[body].to_array(), &expected.to_array(), RELATIVE);
    }

    let (J_frame, M) = (jacobian(&k, &frame), mass_matrix(&k));
    let held = attitude_held_jacobian(&J_frame, &M, &k.state.X_NB.rotation);
    let held = &held.columns()[..vehicle.joint_names.len()];
    agree("fixed_attitude_jacobian", &rows_of(held), &expect["fixed_attitude_jacobian"], RELATIVE);
    let dynamics = inverse_dynamics(&k, &case.nudot, &PerBody::filled(SpatialForce::zero()));
    check_mount(&k, &dynamics, 0, &expect["reaction"]);
    let torque = attitude_torque(&k, &dynamics).to_array();
    agree("attitude_torque", &torque, &expect["attitude_torque"], RELATIVE_SOLVED);
    let (printed, p) = (&expect["printed"], printed_reaction(&k, &case.nudot, 0));
    agree("printed F_T", &p.F_T.to_array(), &expect["reaction"]["force"], RELATIVE_SOLVED);
    agree("printed N_T", &p.N_T.to_array(), &printed["N_T"], RELATIVE_SOLVED);
    agree("arm cm", &p.N_r_arm_cm.to_array(), &printed["N_r_arm_cm"], RELATIVE_SOLVED);
    agree("system cm", &p.N_r_system_cm.to_array(), &printed["N_r_system_cm"], RELATIVE_SOLVED);
}
