//! `wrasse eval`: every quantity of the dynamics at given states, as JSON.

use crate::eval_answer::answer;
use crate::input::{complain, say_json, tell, text_up_to};
use crate::{YES, bad};
use clap::Args;
use schemars::JsonSchema;
use serde::Deserialize;
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use wrasse_document::{Complaint, Document, at, closest};
use wrasse_dynamics::{Generalized, State};
use wrasse_spatial::{Pose, Quat, SpatialForce, SpatialVelocity, Vec3};
use wrasse_vehicle::{JOINTS, NoVehicle, Vehicle, find_vehicle};

/// Evaluate the dynamics of a vehicle at given states, for any other program.
///
/// The states are JSON: {"frame": NAME, "states": [STATE, …]}. The answer goes to standard output.
/// The book's page "Evaluating from other programs" has the whole contract.
#[derive(Debug, Args)]
pub(crate) struct Eval {
    /// A vehicle of the catalogue, or a vehicle file.
    vehicle: String,
    /// The states, as a JSON file.
    #[arg(long, value_name = "FILE")]
    states: PathBuf,
}

/// Largest file of states (bytes): some 100,000 states.
const MOST_STATES: u64 = 64 << 20;

/// What `--states` holds.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct StatesFile {
    frame: String,
    states: Vec<StateFile>,
}

#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
struct StateFile {
    base: BaseFile,
    base_velocity: TwistFile,
    base_acceleration: TwistFile,
    base_wrench: WrenchFile,
    joints: BTreeMap<String, JointFile>,
}

#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
struct BaseFile {
    position: [f64; 3],
    attitude: Option<AttitudeFile>,
}

#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct AttitudeFile {
    w: f64,
    x: f64,
    y: f64,
    z: f64,
}

#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
struct TwistFile {
    angular: [f64; 3],
    linear: [f64; 3],
}

#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
struct WrenchFile {
    torque: [f64; 3],
    force: [f64; 3],
}

#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
struct JointFile {
    position: f64,
    velocity: f64,
    acceleration: f64,
    torque: f64,
}

/// One state, and what acts in it.
#[derive(Debug, Clone)]
pub(crate) struct Question {
    pub(crate) state: State<f64, JOINTS>,
    pub(crate) nudot: Generalized<SpatialVelocity<f64>, f64, JOINTS>,
    pub(crate) force: Generalized<SpatialForce<f64>, f64, JOINTS>,
}

impl Eval {
    pub(crate) fn go(&self) -> ExitCode {
        let vehicle = match find_vehicle(&self.vehicle, None) {
            Ok(vehicle) => vehicle,
            Err(NoVehicle::Faulty(complaints)) => {
                complain(&complaints);
                return bad();
            }
            Err(NoVehicle::NotFound { message, help, .. }) => {
                tell(&format!("error: {message}\nhelp: {help}"));
                return bad();
            }
            Err(_) => return bad(),
        };
        let text = match text_up_to(&self.states, MOST_STATES) {
            Ok(text) => text,
            Err(sentence) => {
                tell(&format!("error: {sentence}"));
                return bad();
            }
        };
        match questions(&self.states, text, &vehicle) {
            Ok((frame, questions)) => answered(&answer(&vehicle, &frame, &questions)),
            Err(complaints) => {
                complain(&complaints);
                bad()
            }
        }
    }
}

/// Print an answer; refuse it where a number is not finite, for JSON has no such numbers.
fn answered(answer: &Value) -> ExitCode {
    let results = answer["results"].as_array().into_iter().flatten().enumerate();
    let members =
        results.flat_map(|(i, r)| r.as_object().into_iter().flatten().map(move |m| (i, m)));
    let broken: Vec<String> = members
        .filter(|(_, (_, value))| holds_null(value))
        .map(|(i, (name, _))| format!("error: state {i}: {name} is not finite"))
        .collect();
    if broken.is_empty() {
        say_json(answer);
        return YES;
    }
    let help = "help: the numbers of the state are too large to be worked with";
    tell(&format!("{}\n{help}", broken.join("\n")));
    bad()
}

fn holds_null(value: &Value) -> bool {
    match value {
        Value::Null => true,
        Value::Array(items) => items.iter().any(holds_null),
        Value::Object(members) => members.values().any(holds_null),
        _ => false,
    }
}

/// The frame and the states that a file asks about.
pub(crate) fn questions(
    path: &Path,
    text: String,
    vehicle: &Vehicle,
) -> Result<(String, Vec<Question>), Vec<Complaint>> {
    let document = Document::parse_json(path, text)?;
    let part = document.read_in_part::<StatesFile>();
    let Some(file) = part.value else { return Err(part.complaints) };
    let mut complaints = wrong_names(&part.document, &file, vehicle);
    let mut questions = vec![];
    for (i, state) in file.states.iter().enumerate() {
        match question(state, vehicle) {
            Ok(question) => questions.push(question),
            Err(why) => {
                let at = at!["states", i, "base", "attitude"];
                let message = format!("state {i}: {why}");
                let complaint = part.document.error(at, message, "this attitude");
                complaints.push(complaint.with_help("divide all four components by the length"));
            }
        }
    }
    let complaints = document.beside(part.complaints, complaints);
    if complaints.is_empty() { Ok((file.frame, questions)) } else { Err(complaints) }
}

/// Names that the vehicle does not have; each of them once.
fn wrong_names(document: &Document, file: &StatesFile, vehicle: &Vehicle) -> Vec<Complaint> {
    let unknown = |at: Option<Range<usize>>, name: &str, what: &str, names: Vec<&str>| {
        let message = format!("the vehicle has no {what} called {name:?}");
        let complaint = Complaint::error(document.source(), message);
        let complaint = complaint.at(at.unwrap_or(0..0), "this name");
        match closest(name, names.iter().copied()) {
            Some(close) => complaint.with_help(format!("did you mean {close:?}?")),
            None => complaint.with_help(format!("one of {}", names.join(", "))),
        }
    };
    let mut complaints = vec![];
    if vehicle.frame(&file.frame).is_none() {
        let names = vehicle.frames.iter().map(|f| f.name.as_str()).collect();
        complaints.push(unknown(document.span(at!["frame"]), &file.frame, "link", names));
    }
    let mut asked = BTreeSet::new();
    for (i, state) in file.states.iter().enumerate() {
        for name in state.joints.keys() {
            if vehicle.joint(name).is_none() && asked.insert(name) {
                let names = vehicle.joint_names.iter().map(String::as_str).collect();
                let at = document.key_span(at!["states", i, "joints", name]);
                complaints.push(unknown(at, name, "moving joint", names));
            }
        }
    }
    complaints
}

fn question(file: &StateFile, vehicle: &Vehicle) -> Result<Question, String> {
    let v3 = Vec3::from_array;
    let mut quat_NB = Quat::identity();
    if let Some(AttitudeFile { w, x, y, z }) = file.base.attitude {
        quat_NB = Quat { w, x, y, z };
        let norm = quat_NB.norm();
        if (norm - 1.0).abs() > 1e-6 {
            return Err(format!("an attitude is a unit quaternion, found one of length {norm}"));
        }
    }
    let mut q = Question {
        state: State {
            X_NB: Pose::from_quat(quat_NB.normalized(), v3(file.base.position)),
            V_NB_B: SpatialVelocity::new(
                v3(file.base_velocity.angular),
                v3(file.base_velocity.linear),
            ),
            ..State::default()
        },
        nudot: Generalized::default(),
        force: Generalized::default(),
    };
    q.nudot.base =
        SpatialVelocity::new(v3(file.base_acceleration.angular), v3(file.base_acceleration.linear));
    q.force.base = SpatialForce::new(v3(file.base_wrench.torque), v3(file.base_wrench.force));
    for (name, joint) in &file.joints {
        let Some(j) = vehicle.joint(name) else { continue };
        (q.state.q[j], q.state.v[j]) = (joint.position, joint.velocity);
        (q.nudot.joints[j], q.force.joints[j]) = (joint.acceleration, joint.torque);
    }
    Ok(q)
}
