//! Words that the field's terms replaced, so that none of them comes back as a name.

use super::{files_below, text_of};
use std::path::Path;

/// Retired names, and those in their place. Whole identifiers count: in strings the former names of keys
/// live on, for the complaint that says the new one.
const RETIRED: [(&str, &str); 32] = [
    ("gyros", "cmgs"),
    ("Gyros", "Cmgs"),
    ("GYROS", "CMGS"),
    ("gyro_array", "cmg_array"),
    ("gyro_steering", "cmg_steering"),
    ("Asked", "ArmReference, or what it is"),
    ("Told", "ControlOutput, or what it is"),
    ("WrasseAsked", "WrasseArmReference"),
    ("WrasseTold", "WrasseControlOutput"),
    ("effort_asked", "effort_commanded"),
    ("nothing_told", "safe_output"),
    ("wrench_felt", "wrench_measured"),
    ("swing_B", "joint_momentum_B"),
    ("surprise", "innovation"),
    ("answered_motion", "believed_base_response"),
    ("answered_twist", "base_twist_response"),
    ("Guided", "GuidanceContext"),
    ("owed_B", "momentum_error_B"),
    ("catch_up", "integral_gain"),
    ("heard", "last_valid"),
    ("Steering", "Allocator"),
    ("SteeringSetup", "AllocationSetup"),
    ("Steered", "Allocation"),
    ("isolate", "disable"),
    ("run_dry", "stop_thrusters"),
    ("relieve", "unload_by_posture"),
    ("posture_relief", "unload_by_posture"),
    ("PostureRelief", "PostureUnloading"),
    ("NoRelief", "NoPostureUnloading"),
    ("Unloading", "Desaturation"),
    ("told_after_s", "reported_after_s"),
    ("feel_tool_wrench", "measure_tool_wrench"),
];

/// No source of Rust or C has a retired name.
pub(super) fn retired(root: &Path) -> Vec<String> {
    let folders = ["crates", "xtask", "embedded", "fuzz/fuzz_targets", "include"];
    let mut findings = Vec::new();
    for (folder, ending) in folders.iter().flat_map(|f| [".rs", ".c", ".h"].map(|e| (f, e))) {
        for path in files_below(root, folder, ending) {
            for (number, line) in (1..).zip(text_of(root, &path).lines()) {
                let found = retired_in(line);
                findings.extend(found.map(|(word, term)| {
                    format!("{path}:{number}: `{word}` was retired: write `{term}`")
                }));
            }
        }
    }
    findings
}

/// Retired names in the code of a line, comments and strings left out.
fn retired_in(line: &str) -> impl Iterator<Item = (&'static str, &'static str)> {
    let code = line.split("//").next().unwrap_or_default().replace("\\\"", "");
    RETIRED.into_iter().filter(move |(word, _)| {
        let names = |part: &str| {
            part.split(|c: char| !(c.is_alphanumeric() || c == '_')).any(|n| n == *word)
        };
        code.split('"').step_by(2).any(names)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(line: &str) -> Vec<&str> {
        retired_in(line).map(|(word, _)| word).collect()
    }

    #[test]
    fn a_retired_name_is_found_where_it_is_an_identifier() {
        assert_eq!(words("pub struct Asked<T> {"), ["Asked"]);
        assert_eq!(words("    told.effort_asked[j] -= swing_B.x;"), ["effort_asked", "swing_B"]);
    }

    #[test]
    fn part_of_a_name_a_string_and_a_comment_are_no_identifiers() {
        assert!(words("fn the_asked_for(rate_gyro: RateGyro<f64>) {").is_empty());
        assert!(words("#[schemars(extend(\"x-formerly\" = [\"gyro_array\"]))]").is_empty());
        assert!(words("let x = 1; // as was Asked").is_empty());
    }
}
