//! Where joints start and where they are sent: by amounts, along with a leader, within their travel.

use std::path::Path;
use wrasse_document::{Complaint, Severity, render};
use wrasse_mission::{Mission, read_mission};
use wrasse_rehearsal::{End, RunOptions, run_case};
use wrasse_testing::largest;

/// A mission with the vehicle of the data folder, whose joints are elbow (10 to 150 deg), slide (0.1 to
/// 0.6 m), `left_finger` (0 to 40 deg) and `right_finger`, which is at 5 deg less the left one's angle.
fn text(initial: &str, motion: &str) -> String {
    format!(
        "name = \"fingers\"\nvehicle = \"two-fingers.toml\"\n{initial}\n[world]\n\
         base_attitude = \"held\"\n[control]\nrate_hz = 20\n[[phase]]\nname = \"go\"\n\
         move_joints = {{ {motion}, duration_s = 10 }}\n"
    )
}

fn read(text: &str) -> Result<Mission, Vec<Complaint>> {
    read_mission(Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/fingers.toml"), text)
}

fn sound(text: &str) -> Mission {
    read(text).unwrap_or_else(|complaints| panic!("{}", render(&complaints, false)))
}

/// One error that says all these words, at a place that reads so.
#[track_caller]
fn refused(text: &str, words: &[&str], place: &str) {
    let Err(complaints) = read(text) else { panic!("{text} is read") };
    let errors: Vec<_> = complaints.iter().filter(|c| c.severity == Severity::Error).collect();
    let said = render(&complaints, false);
    let [error] = errors[..] else { panic!("not one error:\n{said}") };
    for word in words {
        assert!(said.contains(word), "no `{word}` in\n{said}");
    }
    assert_eq!(error.span.clone().and_then(|span| text.get(span)), Some(place), "{said}");
}

/// Positions at the start and at the end (deg, m, deg, deg).
fn flown(text: &str) -> [[f64; 4]; 2] {
    let mut case = sound(text).cases.remove(0);
    let shown = |q: &[f64]| [q[0].to_degrees(), q[1], q[2].to_degrees(), q[3].to_degrees()];
    let start = shown(&case.start.q);
    case.output_rate = 20.0;
    let outcome = run_case(&case, RunOptions::default(), &mut |_, _| {});
    assert_eq!(outcome.end, End::Completed);
    let end = case.vehicle.joint_names.iter().map(|name| {
        let name = format!("joint.{name}.position");
        let channel =
            outcome.telemetry.channels.iter().find(|c| c.name == name).expect("a joint's channel");
        let last = *channel.values.last().expect("a sample");
        if channel.unit == "mm" { last * 1e-3 } else { last }
    });
    let end: Vec<f64> = end.collect();
    [start, [end[0], end[1], end[2], end[3]]]
}

const BENT: &str = "[initial]\nposture = \"bent\"\njoints_m.slide = 0.3";

#[test]
fn joints_move_by_amounts_from_where_they_are() {
    let [start, end] = flown(&text(BENT, "joints_by_deg.elbow = -30, joints_by_m.slide = 0.2"));
    for (found, wanted) in start.iter().zip([90.0, 0.3, 20.0, -15.0]) {
        assert!((found - wanted).abs() < 1e-9, "{start:?}");
    }
    for (found, wanted) in end.iter().zip([60.0, 0.5, 20.0, -15.0]) {
        assert!((found - wanted).abs() < 1e-6, "{end:?}");
    }
}

#[test]
fn amounts_are_checked_as_positions_are() {
    let by = |motion| text(BENT, motion);
    refused(
        &by("joints_by_deg.elbwo = 1"),
        &["there is no moving joint called \"elbwo\"", "did you mean \"elbow\"?"],
        "1",
    );
    let unit = ["joint slide slides, found a value in deg", "write it in `joints_by_m`"];
    refused(&by("joints_by_deg.slide = 1"), &unit, "1");
    let unit = ["joint elbow turns, found a value in m", "write it in `joints_by_deg`"];
    refused(&by("joints_by_m.elbow = 2"), &unit, "2");
    let travel = ["shall move by 140.5 deg, farther than its whole travel from 10 deg to 150 deg"];
    refused(&by("joints_by_deg.elbow = 140.5"), &travel, "140.5");
    let travel = ["shall move by -0.51 m", "at most 0.5 m"];
    refused(&by("joints_by_m.slide = -0.51"), &travel, "-0.51");
    for both in [
        "to_deg.left_finger = 3, joints_by_deg.elbow = 1",
        "to_posture = \"bent\", joints_by_m.slide = 0.1",
    ] {
        let Err(complaints) = read(&by(both)) else { panic!("{both} is read") };
        let said = render(&complaints, false);
        assert!(said.contains("to positions, by amounts or to a pose of the tool"), "{said}");
    }
}

/// Where a joint is as its phase begins is known to the planning.
#[test]
fn an_amount_that_leads_beyond_the_travel_is_found_before_anything_moves() {
    let case = sound(&text(BENT, "joints_by_deg.elbow = 61")).cases.remove(0);
    let End::Infeasible { reason, .. } = run_case(&case, RunOptions::default(), &mut |_, _| {}).end
    else {
        panic!("the elbow goes beyond its travel")
    };
    assert!(reason.contains("joint elbow would leave its travel"), "{reason}");
}

#[test]
fn a_joint_that_follows_starts_and_is_sent_where_its_leader_has_it() {
    let rates = "[initial]\nposture = \"bent\"\njoints_m.slide = 0.3\njoints_deg.left_finger = 30\n\
                 joint_rates_deg_s.left_finger = 0.5";
    let case = sound(&text(rates, "to_deg.left_finger = 10")).cases.remove(0);
    assert!((case.start.q[3].to_degrees() + 25.0).abs() < 1e-12, "{:?}", case.start.q);
    assert!((case.start.v[3].to_degrees() + 0.5).abs() < 1e-12, "{:?}", case.start.v);
    let target = |motion: &str| {
        let case = sound(&text(BENT, motion)).cases.remove(0);
        format!("{:?}", case.phases[0].step)
    };
    // -5 deg and +10 deg in radians.
    let to = target("to_deg.left_finger = 10");
    assert!(to.contains("Some(-0.08726646259971647)"), "{to}");
    let by = target("joints_by_deg.left_finger = -10");
    assert!(
        by.contains("By([None, None, Some(-0.17453292519943295), Some(0.17453292519943295)"),
        "{by}"
    );
}

#[test]
fn a_joint_that_follows_is_not_named() {
    let words = ["joint 'right_finger' follows 'left_finger'", "name 'left_finger' in its place"];
    let initial = format!("{BENT}\njoints_deg.right_finger = 1");
    refused(&text(&initial, "to_deg.elbow = 30"), &words, "right_finger");
    let initial = format!("{BENT}\njoint_rates_deg_s.right_finger = 1");
    refused(&text(&initial, "to_deg.elbow = 30"), &words, "right_finger");
    refused(&text(BENT, "to_deg.right_finger = 3"), &words, "right_finger");
    refused(&text(BENT, "joints_by_deg.right_finger = 3"), &words, "right_finger");
}

#[test]
fn a_start_that_is_not_given_is_within_the_travel_and_told() {
    let remarks = |text: &str| -> Vec<String> {
        sound(text).remarks.iter().map(|c| render(std::slice::from_ref(c), false)).collect()
    };
    let nothing_given = text("", "to_deg.elbow = 30");
    let case = sound(&nothing_given).cases.remove(0);
    assert!((case.start.q[0].to_degrees() - 10.0).abs() < 1e-12, "{:?}", case.start.q);
    assert!((case.start.q[1] - 0.1).abs() < 1e-15, "{:?}", case.start.q);
    assert!((case.start.q[3].to_degrees() - 5.0).abs() < 1e-12, "{:?}", case.start.q);
    let all = remarks(&nothing_given);
    let told = "they start at its nearest end, elbow at 10 deg, slide at 0.1 m";
    assert!(all.iter().any(|r| r.starts_with("warning") && r.contains(told)), "{all:?}");
    let part = remarks(&text("[initial]\njoints_m.slide = 0.2", "to_deg.elbow = 30"));
    assert!(part.iter().any(|r| r.contains("nearest end, elbow at 10 deg\n")), "{part:?}");
    let whole = text("[initial]\njoints_m.slide = 0.2\njoints_deg.elbow = 12", "to_deg.elbow = 30");
    assert!(remarks(&whole).iter().all(|r| !r.contains("nearest end")));
}

/// Driven by torque: the leader's drive bears what its follower takes, and the follower's gives nothing.
#[test]
fn a_follower_is_driven_through_its_leader() {
    let text = text(BENT, "to_deg.left_finger = 35, to_deg.elbow = 60")
        .replace("base_attitude = \"held\"", "base_attitude = \"controlled\"\njoints = \"torque\"")
        .replace("rate_hz = 20", "rate_hz = 100\nactuators = \"unlimited\"");
    let mut case = sound(&text).cases.remove(0);
    case.output_rate = 100.0;
    let outcome = run_case(&case, RunOptions::default(), &mut |_, _| {});
    assert_eq!(outcome.end, End::Completed);
    let channel = |name: &str| {
        let found = outcome.telemetry.channels.iter().find(|c| c.name == name);
        found.unwrap_or_else(|| panic!("no {name}")).values.clone()
    };
    let off = |joint: &str| {
        let [is, wanted] = ["position", "commanded_position"]
            .map(|what| channel(&format!("joint.{joint}.{what}")));
        largest(is.iter().zip(&wanted).map(|(a, b)| a - b))
    };
    let (leads, follows) = (off("left_finger"), off("right_finger"));
    assert!(leads < 4e-6 && follows < 4e-6, "measured 6.2e-7 deg: {leads:e} {follows:e}");
    assert_eq!(largest(channel("joint.right_finger.effort")), 0.0);
    assert_eq!(largest(channel("joint.right_finger.commanded_effort")), 0.0);
    assert!(largest(channel("joint.left_finger.effort")) > 1e-6);
}
