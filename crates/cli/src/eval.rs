//! `wrasse eval`: every quantity of the dynamics at given states, as JSON.

use crate::eval_answer::answer;
use crate::input::{complain, say, tell, text_of};
use crate::{YES, bad};
use clap::Args;
use serde::Deserialize;
use serde_json::Value;
use std::collections::BTreeMap;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;
use wrasse_document::{Complaint, Source, closest};
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

/// What `--states` holds.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct StatesFile {
    frame: String,
    states: Vec<StateFile>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct StateFile {
    base: BaseFile,
    base_velocity: TwistFile,
    base_acceleration: TwistFile,
    base_wrench: WrenchFile,
    joints: BTreeMap<String, JointFile>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct BaseFile {
    position: [f64; 3],
    attitude: Option<AttitudeFile>,
}

#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
struct AttitudeFile {
    w: f64,
    x: f64,
    y: f64,
    z: f64,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct TwistFile {
    angular: [f64; 3],
    linear: [f64; 3],
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct WrenchFile {
    torque: [f64; 3],
    force: [f64; 3],
}

#[derive(Debug, Default, Deserialize)]
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
            Err(NoVehicle::NotFound { message, help }) => {
                tell(&format!("error: {message}\nhelp: {help}"));
                return bad();
            }
            Err(_) => return bad(),
        };
        let text = match text_of(&self.states) {
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
        say(&answer.to_string());
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
    let source = Source::new(path, text);
    let file: StatesFile =
        serde_json::from_str(&source.text).map_err(|error| vec![misshapen(&source, &error)])?;
    let mut complaints = vec![];
    let mut unknown = |name: &str, what: &str, names: Vec<&str>| {
        let at = source.text.find(&format!("\"{name}\"")).unwrap_or(0);
        let message = format!("the vehicle has no {what} called {name:?}");
        let complaint = Complaint::error(&source, message).at(at..at + name.len() + 2, "this name");
        complaints.push(match closest(name, names.iter().copied()) {
            Some(close) => complaint.with_help(format!("did you mean {close:?}?")),
            None => complaint.with_help(format!("one of {}", names.join(", "))),
        });
    };
    if vehicle.frame(&file.frame).is_none() {
        let names = vehicle.frames.iter().map(|f| f.name.as_str()).collect();
        unknown(&file.frame, "link", names);
    }
    let mut asked: Vec<&str> = vec![];
    for name in file.states.iter().flat_map(|s| s.joints.keys()) {
        if vehicle.joint(name).is_none() && !asked.contains(&name.as_str()) {
            asked.push(name);
            let names = vehicle.joint_names.iter().map(String::as_str).collect();
            unknown(name, "moving joint", names);
        }
    }
    let mut questions = vec![];
    for (i, state) in file.states.iter().enumerate() {
        match question(state, vehicle) {
            Ok(question) => questions.push(question),
            Err(why) => {
                let complaint = Complaint::error(&source, format!("state {i}: {why}"))
                    .with_help("divide all four components by the length");
                complaints.push(match attitude_span(&source.text, &file.states[..i]) {
                    Some(span) => complaint.at(span, "this attitude"),
                    None => complaint,
                });
            }
        }
    }
    if complaints.is_empty() { Ok((file.frame, questions)) } else { Err(complaints) }
}

/// What keeps a text from being states.
fn misshapen(source: &Arc<Source>, error: &serde_json::Error) -> Complaint {
    let message = error.to_string();
    let message = message.split(" at line ").next().unwrap_or_default();
    let message = message.replace("expected f64", "expected a number");
    let span = token(&source.text, error.line(), error.column());
    Complaint::error(source, message).at(span, "here")
}

/// Byte range of the word, number or mark that ends at a line and column, both from 1.
fn token(text: &str, line: usize, column: usize) -> Range<usize> {
    let before: usize = text.split_inclusive('\n').take(line.saturating_sub(1)).map(str::len).sum();
    let mut end = (before + column).min(text.len());
    while !text.is_char_boundary(end) {
        end += 1;
    }
    let head = &text[..end];
    let start = if let Some(word) = head.strip_suffix('"') {
        word.rfind('"').unwrap_or(word.len())
    } else {
        let number = |c: char| c.is_ascii_alphanumeric() || "+-.".contains(c);
        let start = head.trim_end_matches(number).len();
        start.min(head.char_indices().last().map_or(0, |(last, _)| last))
    };
    start..end
}

/// Byte range of the key of the first attitude that stands behind those of `earlier` states.
fn attitude_span(text: &str, earlier: &[StateFile]) -> Option<Range<usize>> {
    const KEY: &str = "\"attitude\"";
    let count = earlier.iter().filter(|state| state.base.attitude.is_some()).count();
    text.match_indices(KEY).nth(count).map(|(at, _)| at..at + KEY.len())
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
