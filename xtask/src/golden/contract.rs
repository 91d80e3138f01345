//! The contract of `wrasse eval` on random vehicles: files `one_arm` and `two_arms`.

use super::comparison::{Bound, Found, Tolerances};
use super::file::{Case, Complaint};
use super::kind::Kind;
use super::product::{eval, vehicle_file};
use serde_json::{Value, json};

/// Of arrays where a matrix of condition 1e5 is solved, or large terms cancel.
const SOLVED: Bound = Bound { relative: 1e-9, absolute: 1e-12 };

/// Also those of the other files of the contract; what stands under `printed` belongs to a reaction.
/// Measured: at most a tenth of it is used up, by a centre of mass that lies in the origin but for
/// 3e-13 m.
pub(super) const TOLERANCES: Tolerances = Tolerances {
    sentence: "Agreement asked: 1e-11 relative to the largest element of each array, with a floor of \
               1e-12 absolute (1e-9 for forward_dynamics, reaction, attitude_torque).",
    every: Bound { relative: 1e-11, absolute: 1e-12 },
    of: &[
        ("forward_dynamics", SOLVED),
        ("reaction", SOLVED),
        ("printed", SOLVED),
        ("attitude_torque", SOLVED),
    ],
    arrays: &[],
};

/// Every quantity of `wrasse eval`, joints by name.
pub(super) struct Contract;

impl Kind for Contract {
    fn takes(&self, kind: &str) -> bool {
        ["one_arm", "two_arms"].contains(&kind)
    }

    fn tolerances(&self) -> &'static Tolerances {
        &TOLERANCES
    }

    fn found(&self, case: &Case) -> Result<Found, Complaint> {
        let stem = case.file.file_stem().unwrap_or_default().to_string_lossy();
        let vehicle = vehicle_file(case, &format!("{stem}.urdf"))
            .or_else(|_| vehicle_file(case, &format!("{}.urdf", case.kind)))?;
        let mut value = eval(case, &vehicle, case.at("input")?)?;
        let names: Vec<String> = case.read("expect.joint_names")?;
        let order = places(case, &value["joint_names"], &names)?;
        for result in value["results"].as_array_mut().into_iter().flatten() {
            for (key, quantity) in result.as_object_mut().into_iter().flatten() {
                put_in_order(key, quantity, &order);
            }
        }
        value["joint_names"] = json!(names);
        Ok(Found { value, left_out: vec![] })
    }
}

/// Where each expected joint stands in the answer.
fn places(case: &Case, found: &Value, expected: &[String]) -> Result<Vec<usize>, Complaint> {
    let found = found.as_array().map_or([].as_slice(), Vec::as_slice);
    let place = |name: &String| found.iter().position(|other| other == name);
    let order: Option<Vec<usize>> = expected.iter().map(place).collect();
    let wrong = || case.complaint("expect.joint_names", format!("the vehicle's are {found:?}"));
    order.filter(|order| order.len() == found.len()).ok_or_else(wrong)
}

/// Rows and columns of joints in the order of the file.
fn put_in_order(key: &str, quantity: &mut Value, joints: &[usize]) {
    let whole: Vec<usize> = (0..6).chain(joints.iter().map(|j| 6 + j)).collect();
    let each_row = |quantity: &mut Value, order: &[usize]| {
        quantity.as_array_mut().into_iter().flatten().for_each(|row| *row = picked(row, order));
    };
    match key {
        "bias_force" | "inverse_dynamics" | "forward_dynamics" => {
            *quantity = picked(quantity, &whole);
        }
        "mass_matrix" => {
            *quantity = picked(quantity, &whole);
            each_row(quantity, &whole);
        }
        "jacobian" => each_row(quantity, &whole),
        "generalized_jacobian" | "fixed_attitude_jacobian" => each_row(quantity, joints),
        _ => {}
    }
}

fn picked(list: &Value, places: &[usize]) -> Value {
    places.iter().map(|&i| list[i].clone()).collect()
}
