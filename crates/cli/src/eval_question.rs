//! The states that `wrasse eval` is asked about, from JSON.

use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::path::Path;
use wrasse_document::{Complaint, Document, at, closest};
use wrasse_dynamics::{Generalized, State};
use wrasse_spatial::{Mat3, Pose, SpatialForce, SpatialVelocity, Vec3};
use wrasse_vehicle::{AttitudeFile, JOINTS, NotARotation, Vehicle};

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
            Err(NotARotation { message, help }) => {
                let at = at!["states", i, "base", "attitude"];
                let message = format!("state {i}: {message}");
                let complaint = part.document.error(at, message, "this attitude");
                complaints.push(complaint.with_help(help));
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

fn question(file: &StateFile, vehicle: &Vehicle) -> Result<Question, NotARotation> {
    let v3 = Vec3::from_array;
    let R_NB = file.base.attitude.map_or(Ok(Mat3::identity()), AttitudeFile::rotation)?;
    let mut q = Question {
        state: State {
            X_NB: Pose::new(R_NB, v3(file.base.position)),
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
