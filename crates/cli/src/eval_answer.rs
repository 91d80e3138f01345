//! The answer of `wrasse eval`: quantities by name, generalized vectors ordered `[ω_B; v_B; q̇]`.

use crate::eval_question::Question;
use serde_json::{Value, json};
use wrasse_dynamics::{
    BodyId, Frame, GeneralizedForce, GeneralizedVelocity, Kinematics, Outside,
    attitude_held_jacobian, attitude_torque, barycentric_vectors, bias_force, forward_dynamics,
    generalized_jacobian, inverse_dynamics, jacobian, kinematics, kinetic_energy, mass_matrix,
    momentum, mount_reaction, printed_reaction,
};
use wrasse_spatial::{Quat, SpatialVelocity, Vec3};
use wrasse_vehicle::{JOINTS, Vehicle};

/// The answer to all questions; the frame must be one of the vehicle's.
pub(crate) fn answer(vehicle: &Vehicle, frame: &str, questions: &[Question]) -> Value {
    let Some(frame) = vehicle.frame(frame) else { return Value::Null };
    let results: Vec<Value> = questions.iter().map(|q| result(vehicle, &frame, q)).collect();
    json!({ "joint_names": vehicle.joint_names, "results": results })
}

fn xyz(v: Vec3<f64>) -> Value {
    json!(v.to_array())
}

/// Base first, then the joints that there are.
fn flat(base: [f64; 6], joints: &[f64; JOINTS], n: usize) -> Vec<f64> {
    base.into_iter().chain(joints[..n].iter().copied()).collect()
}
fn flat_force(f: &GeneralizedForce<f64, JOINTS>, n: usize) -> Vec<f64> {
    flat(f.base.to_array(), &f.joints, n)
}
fn flat_velocity(v: &GeneralizedVelocity<f64, JOINTS>, n: usize) -> Vec<f64> {
    flat(v.base.to_array(), &v.joints, n)
}

/// Six rows from columns.
fn rows(columns: &[SpatialVelocity<f64>]) -> Vec<Vec<f64>> {
    let columns: Vec<[f64; 6]> = columns.iter().map(|c| c.to_array()).collect();
    (0..6).map(|r| columns.iter().map(|c| c[r]).collect()).collect()
}

fn result(vehicle: &Vehicle, frame: &Frame<f64>, q: &Question) -> Value {
    let n = vehicle.joint_names.len();
    let k = kinematics(&vehicle.robot, &q.state);
    let none = Outside::nothing();
    let (M, J) = (mass_matrix(&k), jacobian(&k, frame));
    let h = momentum(&k);
    let R_NB = q.state.X_NB.rotation;
    let pose = k.pose(frame);
    let attitude = Quat::from_matrix(&pose.rotation);
    let dynamics = inverse_dynamics(&k, &q.nudot, none);
    let matrix: Vec<Vec<f64>> =
        (0..6 + n).map(|r| (0..6 + n).map(|c| M.element(r, c)).collect()).collect();
    let all_columns: Vec<_> =
        J.base().into_iter().chain(J.joints.columns().into_iter().take(n)).collect();
    json!({
        "mass_matrix": matrix,
        "bias_force": flat_force(&bias_force(&k), n),
        "inverse_dynamics": flat_force(&dynamics.force, n),
        "forward_dynamics": flat_velocity(&forward_dynamics(&k, &q.force, none), n),
        "momentum": { "angular": xyz(h.angular), "linear": xyz(h.linear) },
        "kinetic_energy": kinetic_energy(&k),
        "mass": h.mass,
        "centre_of_mass": xyz(h.p_NScm_N),
        "pose": {
            "position": xyz(pose.translation),
            "attitude": { "w": attitude.w, "x": attitude.x, "y": attitude.y, "z": attitude.z },
        },
        "jacobian": rows(&all_columns),
        "generalized_jacobian": rows(&generalized_jacobian(&J, &M).columns()[..n]),
        "fixed_attitude_jacobian": rows(&attitude_held_jacobian(&J, &M, &R_NB).columns()[..n]),
        "lambda": lambda(vehicle, &k, frame),
        "reaction": reactions(vehicle, &k, q),
        "attitude_torque": xyz(attitude_torque(&k, &dynamics)),
    })
}

fn lambda(vehicle: &Vehicle, k: &Kinematics<'_, f64, JOINTS>, frame: &Frame<f64>) -> Value {
    let vectors = barycentric_vectors(k, frame);
    let one = |body: BodyId| {
        let joint = match body {
            BodyId::Base => "base",
            BodyId::Link(j) => &vehicle.joint_names[j],
        };
        json!({ "joint": joint, "vector": xyz(vectors[body]) })
    };
    k.robot.bodies().map(one).collect()
}

/// One for each chain that leaves the base.
fn reactions(vehicle: &Vehicle, k: &Kinematics<'_, f64, JOINTS>, q: &Question) -> Value {
    let none = Outside::nothing();
    let dynamics = inverse_dynamics(k, &q.nudot, none);
    let roots = k.robot.joints().filter(|&j| k.robot.joint(j).parent == BodyId::Base);
    roots
        .map(|root| {
            let F = mount_reaction(k, &dynamics, root);
            let printed = printed_reaction(k, &q.nudot, root);
            json!({
                "arm": vehicle.joint_names[root],
                "force": xyz(F.force),
                "moment": xyz(F.torque),
                "printed": {
                    "N_T": xyz(printed.N_T),
                    "N_r_arm_cm": xyz(printed.N_r_arm_cm),
                    "N_r_system_cm": xyz(printed.N_r_system_cm),
                },
            })
        })
        .collect()
}
