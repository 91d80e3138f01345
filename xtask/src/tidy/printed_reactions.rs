//! The book's table of what eq. (3), as printed, is off by: computed from the outside data.

use super::text_of;
use serde_json::Value;
use std::path::Path;

const DATA: &str = "validation/golden/paper_equations.json";
const PAGE: &str = "book/src/paper_equation_by_equation.md";

/// The page holds each row of the table that the data give.
pub(super) fn table(root: &Path) -> Vec<String> {
    let page = text_of(root, PAGE);
    match rows(&text_of(root, DATA)) {
        Some(rows) => rows
            .into_iter()
            .filter(|row| !page.lines().any(|line| line == row))
            .map(|row| format!("{PAGE}: missing row {row}"))
            .collect(),
        None => vec![format!("{DATA}: not a list of cases with reaction, printed and torque")],
    }
}

/// A row for each case: moment at the mount, torque of the attitude control, and what share of them
/// each shortened form is off by.
fn rows(data: &str) -> Option<Vec<String>> {
    let cases: Value = serde_json::from_str(data).ok()?;
    cases.as_array()?.iter().enumerate().map(|(i, case)| row(i + 1, case)).collect()
}

fn row(number: usize, case: &Value) -> Option<String> {
    let vehicle = case["vehicle"].as_str()?.trim_end_matches(".urdf");
    let expect = &case["expect"];
    let moment = vector(&expect["reaction"]["moment"])?;
    let torque = vector(&expect["attitude_torque"])?;
    let arm = vector(&expect["printed"]["N_r_arm_cm"])?;
    let system = vector(&expect["printed"]["N_r_system_cm"])?;
    Some(format!(
        "| {number} | {vehicle} | {:.1} | {:.1} | {:.0} % | {:.0} % | {:.0} % |",
        norm(moment),
        norm(torque),
        share(arm, moment),
        share(system, moment),
        share(moment, torque),
    ))
}

fn vector(value: &Value) -> Option<[f64; 3]> {
    let list = value.as_array()?;
    Some([list.first()?.as_f64()?, list.get(1)?.as_f64()?, list.get(2)?.as_f64()?])
}

fn norm(v: [f64; 3]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// Distance of `a` from `b`, in per cent of `b`.
fn share(a: [f64; 3], b: [f64; 3]) -> f64 {
    100.0 * norm([a[0] - b[0], a[1] - b[1], a[2] - b[2]]) / norm(b)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_case_becomes_a_row_of_shares() {
        let data = r#"[{"vehicle": "v.urdf", "expect": {
            "reaction": {"moment": [0, 0, 4]}, "attitude_torque": [0, 0, 5],
            "printed": {"N_r_arm_cm": [0, 0, 3], "N_r_system_cm": [4, 0, 4]}}}]"#;
        let rows = rows(data).expect("complete data");
        assert_eq!(rows, ["| 1 | v | 4.0 | 5.0 | 25 % | 100 % | 20 % |"]);
        assert!(super::rows("[{}]").is_none());
    }
}
