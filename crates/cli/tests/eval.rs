//! `wrasse eval` as any other program sees it, against outside data: Pinocchio 4.1 on random trees,
//! and the quantities of Ellery's paper from a Newton–Euler sum over bodies.
#![allow(clippy::unwrap_used, reason = "a test may stop where it finds nothing")]
#![allow(clippy::print_stdout, reason = "prints what was measured, under --nocapture")]

mod binary;

use binary::{Folder, at, checkout};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::fs;
use wrasse_testing::{larger, largest};

/// Asked of every array, relative to its largest element: the contract's figure. Measured 3.7e-15
/// at most (angular momentum of two arms).
const RELATIVE: f64 = 1e-11;
/// Asked where a matrix of condition 1e5 is solved, or large terms cancel. Measured 1.1e-12 at most
/// (printed N_T, whose golden sum is itself good to 2e-12).
const RELATIVE_SOLVED: f64 = 1e-9;
/// Below this a difference does not count: quantities that are zero by symmetry.
const FLOOR: f64 = 1e-12;

/// The worst agreement of each quantity, relative to its largest element.
#[derive(Default)]
struct Worst(BTreeMap<String, f64>);

impl Worst {
    /// Found and expected agree; note by how much.
    #[track_caller]
    fn note(&mut self, what: &str, found: &[f64], expected: &[f64], relative: f64) {
        assert_eq!(found.len(), expected.len(), "{what}: number of elements");
        let scale = largest(expected.iter().map(|x| x.abs()));
        let off = largest(found.iter().zip(expected).map(|(a, b)| (a - b).abs()));
        let allowed = larger(FLOOR, relative * scale);
        assert!(off <= allowed, "{what}: off by {off:e}\n{found:?}\n{expected:?}");
        let worst = self.0.entry(what.to_owned()).or_default();
        // What is zero but for rounding says nothing about agreement.
        *worst = larger(*worst, if scale > 1e-6 { off / scale } else { 0.0 });
    }
    #[track_caller]
    fn values(&mut self, what: &str, found: &Value, expected: &Value, relative: f64) {
        self.note(what, &flat(found), &flat(expected), relative);
    }
}

impl Drop for Worst {
    fn drop(&mut self) {
        for (what, worst) in &self.0 {
            println!("{what}: {worst:.1e} of the largest element");
        }
    }
}

fn golden(file: &str) -> Value {
    let path = checkout("validation/golden").join(file);
    serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap()
}

/// The answer of the binary about a vehicle of the golden folder.
fn eval(vehicle: &str, input: &Value) -> Value {
    let folder = Folder::new();
    folder.put("states.json", &input.to_string());
    let vehicle = at(&format!("validation/golden/{vehicle}"));
    let said = folder.wrasse(&["eval", &vehicle, "--states", "states.json"]);
    assert_eq!((said.code, said.err.as_str()), (0, ""));
    serde_json::from_str(&said.out).unwrap()
}

/// All numbers below a value, in order.
fn flat(value: &Value) -> Vec<f64> {
    match value {
        Value::Array(items) => items.iter().flat_map(flat).collect(),
        number => vec![number.as_f64().unwrap_or_else(|| panic!("{number} is no number"))],
    }
}

fn vector(value: &Value) -> [f64; 3] {
    flat(value).try_into().unwrap()
}

/// Names of the members of an object, in alphabetical order.
fn keys(value: &Value) -> Vec<&str> {
    let mut keys: Vec<_> = value.as_object().unwrap().keys().map(String::as_str).collect();
    keys.sort_unstable();
    keys
}

fn strings(value: &Value) -> Vec<&str> {
    value.as_array().unwrap().iter().map(|name| name.as_str().unwrap()).collect()
}

/// The place of each expected joint among those that were found, after `before` other elements.
fn places(found: &[&str], expected: &[&str], before: usize) -> Vec<usize> {
    assert_eq!(found.len(), expected.len(), "number of joints");
    let of = |name| found.iter().position(|n| *n == name).unwrap();
    (0..before).chain(expected.iter().map(|name| before + of(*name))).collect()
}

/// Elements of a list in this order.
fn picked(list: &Value, places: &[usize]) -> Value {
    assert_eq!(list.as_array().unwrap().len(), places.len());
    places.iter().map(|&i| list[i].clone()).collect()
}

/// The list member whose `key` is `name`.
fn named<'a>(list: &'a Value, key: &str, name: &Value) -> &'a Value {
    let mut fitting = list.as_array().unwrap().iter().filter(|item| item[key] == *name);
    let one = fitting.next().unwrap_or_else(|| panic!("no {key} {name}"));
    assert!(fitting.next().is_none(), "two with {key} {name}");
    one
}

/// An attitude is the same with either sign.
fn compare_attitude(worst: &mut Worst, found: &Value, expected: &Value) {
    let parts = |q: &Value| ["w", "x", "y", "z"].map(|key| q[key].as_f64().unwrap());
    let (found, expected) = (parts(found), parts(expected));
    let sign = found.iter().zip(&expected).map(|(a, b)| a * b).sum::<f64>().signum();
    worst.note("pose.attitude", &found.map(|x| sign * x), &expected, RELATIVE);
}

/// One key of a result.
fn compare(
    worst: &mut Worst,
    key: &str,
    found: &Value,
    expected: &Value,
    names: (&[&str], &[&str]),
) {
    let (joints, all) = (places(names.0, names.1, 0), places(names.0, names.1, 6));
    match key {
        "mass" | "kinetic_energy" | "centre_of_mass" => {
            worst.values(key, found, expected, RELATIVE);
        }
        "attitude_torque" => worst.values(key, found, expected, RELATIVE_SOLVED),
        "momentum" => {
            assert_eq!(keys(found), keys(expected));
            for part in ["angular", "linear"] {
                let name = format!("momentum.{part}");
                worst.values(&name, &found[part], &expected[part], RELATIVE);
            }
        }
        "pose" => {
            assert_eq!(keys(found), keys(expected));
            worst.values("pose.position", &found["position"], &expected["position"], RELATIVE);
            compare_attitude(worst, &found["attitude"], &expected["attitude"]);
        }
        "bias_force" | "inverse_dynamics" => {
            worst.values(key, &picked(found, &all), expected, RELATIVE);
        }
        "forward_dynamics" => {
            worst.values(key, &picked(found, &all), expected, RELATIVE_SOLVED);
        }
        "mass_matrix" => {
            let rows = picked(found, &all);
            let both: Value =
                rows.as_array().unwrap().iter().map(|row| picked(row, &all)).collect();
            worst.values(key, &both, expected, RELATIVE);
        }
        "jacobian" | "generalized_jacobian" | "fixed_attitude_jacobian" => {
            let columns = if key == "jacobian" { &all } else { &joints };
            let rows: Value =
                found.as_array().unwrap().iter().map(|row| picked(row, columns)).collect();
            worst.values(key, &rows, expected, RELATIVE);
        }
        "lambda" => {
            let expected = expected.as_array().unwrap();
            assert_eq!(found.as_array().unwrap().len(), expected.len());
            for one in expected {
                let found = named(found, "joint", &one["joint"]);
                worst.values(key, &found["vector"], &one["vector"], RELATIVE);
            }
        }
        "reaction" => {
            let expected = expected.as_array().unwrap();
            assert_eq!(found.as_array().unwrap().len(), expected.len());
            for one in expected {
                compare_reaction(worst, named(found, "arm", &one["arm"]), one);
            }
        }
        other => panic!("nothing is known of {other}"),
    }
}

fn compare_reaction(worst: &mut Worst, found: &Value, expected: &Value) {
    for part in ["force", "moment"] {
        let name = format!("reaction.{part}");
        worst.values(&name, &found[part], &expected[part], RELATIVE_SOLVED);
    }
}

#[track_caller]
fn check_against_pinocchio(name: &str) {
    let file = golden(&format!("{name}.json"));
    let found = eval(&format!("{name}.urdf"), &file["input"]);
    let expect = &file["expect"];
    assert_eq!(keys(&found), keys(expect));
    let names = (strings(&found["joint_names"]), strings(&expect["joint_names"]));
    let (results, wanted) =
        (found["results"].as_array().unwrap(), expect["results"].as_array().unwrap());
    assert_eq!((results.len(), wanted.len()), (4, 4));
    let mut worst = Worst::default();
    for (result, expected) in results.iter().zip(wanted) {
        assert_eq!(keys(result), keys(expected), "the keys of a result");
        for (key, value) in expected.as_object().unwrap() {
            compare(&mut worst, key, &result[key], value, (&names.0, &names.1));
        }
    }
}

#[test]
fn every_quantity_of_one_arm_agrees_with_pinocchio() {
    check_against_pinocchio("one_arm");
}

#[test]
fn every_quantity_of_two_arms_with_prismatic_joints_agrees_with_pinocchio() {
    check_against_pinocchio("two_arms");
}

#[test]
fn the_quantities_of_the_paper_agree_with_the_sum_over_bodies() {
    let file = golden("paper_equations.json");
    let cases = file.as_array().unwrap();
    assert_eq!(cases.len(), 8);
    let mut worst = Worst::default();
    for case in cases {
        check_paper_case(&mut worst, case);
    }
}

fn check_paper_case(worst: &mut Worst, case: &Value) {
    let vehicle = case["vehicle"].as_str().unwrap();
    let found = eval(vehicle, &case["input"]);
    assert_eq!(found["results"].as_array().unwrap().len(), 1);
    let (result, expect) = (&found["results"][0], &case["expect"]);
    let solved = RELATIVE_SOLVED;
    // The joints of these vehicles stand in the file as the arm goes, which is the order of `expect`.
    let names = strings(&found["joint_names"]);
    assert_eq!(names, (1..=7).map(|j| format!("joint{j}")).collect::<Vec<_>>());
    let centre = "centre_of_mass";
    worst.values(centre, &result[centre], &expect[centre], RELATIVE);
    worst.values("position", &result["pose"]["position"], &expect["position"], RELATIVE);
    let held = "fixed_attitude_jacobian";
    worst.values(held, &result[held], &expect[held], RELATIVE);
    let torque = "attitude_torque";
    worst.values(torque, &result[torque], &expect[torque], solved);
    assert_eq!(result["reaction"].as_array().unwrap().len(), 1);
    let reaction = &result["reaction"][0];
    compare_reaction(worst, reaction, &expect["reaction"]);
    assert_eq!(keys(&reaction["printed"]), keys(&expect["printed"]));
    for (key, value) in expect["printed"].as_object().unwrap() {
        worst.values(&format!("printed.{key}"), &reaction["printed"][key], value, solved);
    }
    check_lambda(worst, case, result);
}

/// The paper keeps the payload apart, the contract makes it one body with the last link.
fn check_lambda(worst: &mut Worst, case: &Value, result: &Value) {
    let expect = &case["expect"];
    let listed = expect["lambda_vectors"].as_array().unwrap();
    let term = vector(&expect["payload_term"]);
    let last = listed.len() - 1;
    for (i, listed) in listed.iter().enumerate() {
        let name = if i == 0 { json!("base") } else { json!(format!("joint{i}")) };
        let mut expected = vector(listed);
        if i == last {
            let turned = in_last_link(case, term);
            (0..3).for_each(|k| expected[k] += turned[k]);
        }
        let found = named(&result["lambda"], "joint", &name);
        worst.note("lambda", &vector(&found["vector"]), &expected, RELATIVE);
    }
}

/// A vector in the payload's axes (the tool's, without payload) turned into those of link7, by the
/// attitudes that the binary itself gives them.
fn in_last_link(case: &Value, v: [f64; 3]) -> [f64; 3] {
    let vehicle = case["vehicle"].as_str().unwrap();
    let attitude = |frame: &str| {
        let mut input = case["input"].clone();
        input["frame"] = json!(frame);
        let q = eval(vehicle, &input)["results"][0]["pose"]["attitude"].clone();
        ["w", "x", "y", "z"].map(|key| q[key].as_f64().unwrap())
    };
    let payload = if vehicle.contains("unladen") { "tool" } else { "payload" };
    let [w, x, y, z] = attitude("link7");
    turned([w, -x, -y, -z], turned(attitude(payload), v))
}

/// `v + 2 u × (u × v + w v)` for a unit quaternion (w, u).
fn turned([w, x, y, z]: [f64; 4], v: [f64; 3]) -> [f64; 3] {
    let cross = |a: [f64; 3], b: [f64; 3]| {
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    };
    let u = [x, y, z];
    let mut inner = cross(u, v);
    (0..3).for_each(|k| inner[k] += w * v[k]);
    let outer = cross(u, inner);
    [v[0] + 2.0 * outer[0], v[1] + 2.0 * outer[1], v[2] + 2.0 * outer[2]]
}

/// The whole of standard error to a states file that is wrong; the exit code is 2, and nothing
/// is answered.
fn refusal(states: &str) -> String {
    let folder = Folder::new();
    folder.put("states.json", states);
    let said = folder.wrasse(&["eval", "atlas-class", "--states", "states.json"]);
    assert_eq!((said.code, said.out.as_str()), (2, ""));
    said.err
}

#[test]
fn states_that_cannot_be_used_are_answered_with_what_is_wrong_and_how_to_mend_it() {
    let wrong = [
        r#"{ "frame": "tool", "states": [], "state": [] }"#,
        r#"{ "frame": "tool", "states": [{ "base_speed": 1 }] }"#,
        r#"{ "frame": "tool", "states": [{ "joints": { "joint8": { "position": 1 } } }] }"#,
        r#"{ "frame": "tool", "states": [{ "joints": { "shoulder": { "position": 1 } } }] }"#,
        r#"{ "frame": "tol", "states": [{}] }"#,
        r#"{ "frame": "tööl", "sätes": [] }"#,
        r#"{ "frame": "tool", "states": [{ "base": { "attitude": { "w": 1, "x": 1, "y": 0, "z": 0 } } }] }"#,
        r#"{ "frame": "tool", "states": [{ "base": { "attitude": { "w": 1, "x": 0, "y": 0, "z": 0 } } },
            { "base": { "attitude": { "w": 0, "x": 0, "y": 0, "z": 0 } } }] }"#,
        r#"{ "frame": "tool", "states": [{ "joints": { "joint1": { "position": "0.3" } } }] }"#,
        r#"{ "frame": "tool", "states": [{ "joints": { "joint1": { "position": 1e999 } } }] }"#,
        r#"{ "frame": "tool", "states": [{ "base": { "position": [1, 2] } }] }"#,
        "{ \"frame\": \"tool\",\n  \"states\": [{}",
        "",
        r#"{ "frame": "tol", "states": [{ "joints": { "a": {}, "b": {} },
            "base": { "attitude": { "w": 2, "x": 0, "y": 0, "z": 0 } } }] }"#,
    ];
    let all: Vec<String> =
        wrong.iter().map(|states| format!("{states}\n\n{}", refusal(states))).collect();
    assert_same(&all.join("\n----\n"), "eval_refusals.txt");
}

#[test]
fn files_and_vehicles_that_are_not_there_are_named() {
    let folder = Folder::new();
    folder.put("states.json", r#"{ "frame": "tool", "states": [] }"#);
    folder.put("broken.toml", "name = ");
    let asked = [
        ["atlas-class", "stats.json"],
        ["atlas-klass", "states.json"],
        ["broken.toml", "states.json"],
    ];
    let mut all = vec![];
    for [vehicle, states] in asked {
        let said = folder.wrasse(&["eval", vehicle, "--states", states]);
        assert_eq!((said.code, said.out.as_str()), (2, ""));
        all.push(format!("eval {vehicle} --states {states}\n\n{}", said.err));
    }
    assert_same(&all.join("\n----\n"), "eval_missing.txt");
    let said = folder.wrasse(&["eval", "atlas.toml", "--states", "states.json"]);
    assert_eq!((said.code, said.out.as_str()), (2, ""));
    assert!(
        said.err.starts_with("error: cannot read the vehicle file atlas.toml: "),
        "{}",
        said.err
    );
}

/// A text is what the file in `tests/data` holds.
#[track_caller]
fn assert_same(found: &str, file: &str) {
    let path = checkout("crates/cli/tests/data").join(file);
    let expected = fs::read_to_string(&path).unwrap_or_default();
    assert!(found == expected, "{file} says otherwise; found:\n{found}");
}

#[test]
fn numbers_that_overflow_are_named_and_not_answered_with_null() {
    let said = refusal(
        r#"{ "frame": "tool", "states": [{}, { "joints": { "joint1": { "velocity": 1e200 } } },
            { "base": { "position": [1e308, 1e308, 0] } }] }"#,
    );
    assert!(said.starts_with("error: state 1: "), "{said}");
    assert!(said.contains("error: state 1: kinetic_energy is not finite\n"), "{said}");
    assert!(said.contains("error: state 2: reaction is not finite\n"), "{said}");
    assert!(!said.contains("state 0") && said.contains("help: "), "{said}");
}

#[test]
fn no_state_no_result() {
    let found = eval("one_arm.urdf", &json!({ "frame": "a0_tool", "states": [] }));
    assert_eq!(found["results"], json!([]));
    assert_eq!(found["joint_names"].as_array().unwrap().len(), 7);
}

#[test]
fn an_empty_state_is_at_rest_at_the_origin() {
    let found = eval("one_arm.urdf", &json!({ "frame": "a0_tool", "states": [{}] }));
    let result = &found["results"][0];
    assert_eq!(result["kinetic_energy"], json!(0.0));
    assert!(flat(&result["bias_force"]).iter().all(|x| *x == 0.0));
}

/// Roll and then pitch by a right angle each: `(1 + j)(1 + i) / 2 = (1 + i + j - k) / 2`.
#[test]
fn a_base_turned_by_roll_pitch_yaw_is_turned_as_by_its_quaternion() {
    let pose = |attitude: Value| {
        let state = json!({ "base": { "attitude": attitude } });
        let found = eval("one_arm.urdf", &json!({ "frame": "a0_tool", "states": [state] }));
        flat(&found["results"][0]["pose"]["position"])
    };
    let parts = json!({ "w": 0.5, "x": 0.5, "y": 0.5, "z": -0.5 });
    let wanted = pose(parts.clone());
    for other in [json!({ "rpy_deg": [90, 90, 0] }), json!({ "quaternion": parts })] {
        let found = pose(other);
        let off = found.iter().zip(&wanted).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(off < 1e-14, "round-off of positions of a few metres: {off:e}");
    }
}
