//! The quantities of the source paper: file `paper_equations`.

use super::comparison::{Found, Tolerances};
use super::contract::TOLERANCES;
use super::file::{Case, Complaint};
use super::kind::Kind;
use super::product::{eval, vehicle, vehicle_file};
use serde_json::{Value, json};
use wrasse_spatial::Vec3;
use wrasse_vehicle::Vehicle;

/// The paper's quantities as `wrasse eval` gives them.
pub(super) struct PaperEquations;

impl Kind for PaperEquations {
    fn takes(&self, kind: &str) -> bool {
        kind == "paper_equations"
    }

    fn tolerances(&self) -> &'static Tolerances {
        &TOLERANCES
    }

    fn found(&self, case: &Case) -> Result<Found, Complaint> {
        let (name, input) = (case.text("vehicle")?, case.at("input")?);
        let answer = eval(case, &vehicle_file(case, name)?, input)?;
        let [result] = answer["results"].as_array().map_or([].as_slice(), Vec::as_slice) else {
            return Err(case.complaint("input.states", "expected one state"));
        };
        let reaction = &result["reaction"][0];
        let lambda = lambda_vectors(case, &vehicle(case, name)?, &result["lambda"])?;
        let value = json!({
            "centre_of_mass": result["centre_of_mass"],
            "position": result["pose"]["position"],
            "fixed_attitude_jacobian": result["fixed_attitude_jacobian"],
            "attitude_torque": result["attitude_torque"],
            "reaction": { "force": reaction["force"], "moment": reaction["moment"] },
            "printed": reaction["printed"],
            "lambda_vectors": lambda,
        });
        let payload = "it is taken from the last of lambda_vectors, which is compared";
        Ok(Found { value, left_out: vec![("payload_term".to_owned(), payload)] })
    }
}

/// The vectors of the base and of link 1 to n. The paper keeps the payload apart, the product makes it
/// one body with the last link: there its term, turned into that link's axes, is taken away.
fn lambda_vectors(case: &Case, vehicle: &Vehicle, lambda: &Value) -> Result<Value, Complaint> {
    let names = std::iter::once("base").chain(vehicle.joint_names.iter().map(String::as_str));
    let vector = |name: &str| {
        let of = lambda.as_array().into_iter().flatten().find(|entry| entry["joint"] == name);
        of.map_or(Value::Null, |entry| entry["vector"].clone())
    };
    let mut vectors: Vec<Value> = names.map(vector).collect();
    let frame = case.text("input.frame")?;
    let carried = vehicle.frame("payload").or_else(|| vehicle.frame(frame));
    let X_BF = carried.map(|frame| frame.X_BF).ok_or_else(|| {
        case.complaint("input.frame", format!("the vehicle has no frame {frame}"))
    })?;
    let term: [f64; 3] = case.read("expect.payload_term")?;
    let term_B = (X_BF.rotation * Vec3::from_array(term)).to_array();
    if let Some(last) = vectors.last_mut() {
        *last = (0..3).map(|i| last[i].as_f64().map(|x| x - term_B[i])).collect();
    }
    Ok(vectors.into())
}
