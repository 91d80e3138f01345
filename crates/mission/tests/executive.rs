//! Steps with conditions, timeouts, faults and attempts; and arms that work at once.

use proptest::prelude::*;
use wrasse_document::render;
use wrasse_mission::{Mission, read_mission, run};
use wrasse_rehearsal::{CaseOutcome, End, EventKind, RunOptions};

const START: &str =
    "[initial]\nposture = \"forward_300mm\"\n[world]\nbase_attitude = \"controlled\"\n";

fn read(parts: &[&str]) -> Result<Mission, String> {
    let text = format!("name = \"x\"\nvehicle = \"atlas-class\"\n{}", parts.join("\n"));
    read_mission("x.toml", text).map_err(|complaints| render(&complaints, false))
}

#[track_caller]
fn fly(parts: &[&str]) -> CaseOutcome {
    let mission = read(parts).unwrap_or_else(|told| panic!("{told}"));
    run(&mission, RunOptions::default(), &mut |_| {}).cases.remove(0)
}

fn hold(name: &str, more: &str) -> String {
    format!("[[phase]]\nname = \"{name}\"\nhold = {{ duration_s = 1.0 }}\n{more}\n")
}

/// Names of the phases in the order in which they began, and when.
fn way(case: &CaseOutcome) -> Vec<(String, f64)> {
    let begun = case.events.iter().filter(|event| event.kind == EventKind::Phase);
    begun.map(|e| (e.text.trim_start_matches("phase ").to_owned(), e.time_s)).collect()
}

#[track_caller]
fn goes(case: &CaseOutcome, expected: &[(&str, f64)]) {
    let found = way(case);
    let names: Vec<_> = found.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names, expected.iter().map(|(name, _)| *name).collect::<Vec<_>>(), "{:?}", case.end);
    for ((_, found), (name, wanted)) in found.iter().zip(expected) {
        assert!((found - wanted).abs() < 1e-9, "{name} begins at {found} s, not {wanted} s");
    }
}

fn tells(case: &CaseOutcome, kind: EventKind, text: &str) -> bool {
    case.events.iter().any(|event| event.kind == kind && event.text.contains(text))
}

fn metric(case: &CaseOutcome, name: &str) -> f64 {
    let found = case.metrics.iter().find(|m| m.name == name);
    found.unwrap_or_else(|| panic!("no {name}; it ended with {:?}", case.end)).value
}

#[test]
fn a_phase_leads_where_it_says_and_the_end_may_be_anywhere() {
    let phases =
        [hold("a", "then = \"c\""), hold("b", "then = \"end\""), hold("c", "then = \"b\"")];
    let case = fly(&[START, &phases.join("")]);
    assert!(matches!(case.end, End::Completed));
    goes(&case, &[("a", 0.0), ("c", 1.0), ("b", 2.0)]);
}

#[test]
fn a_phase_ends_when_so_much_time_has_passed_whatever_its_motion_does() {
    let move_on = "[[phase]]\nname = \"move\"\nmove_tool = { by_m = [0.0, 0.2, 0.0], duration_s = 20.0 }\n\
                   until = { elapsed_s = 2.5 }\n";
    let case = fly(&[START, move_on, &hold("stop", "until = { elapsed_s = 1.5 }\n")]);
    goes(&case, &[("move", 0.0), ("stop", 2.5)]);
    assert!(tells(&case, EventKind::Condition, "step move"));
    // The joints were moving when the hold began: they come to rest, and throw nothing off.
    assert!(case.ledger.closes && metric(&case, "joints.effort_use.max") < 0.1);
}

const PUSH: &str = "[[world.applied_wrench]]\non = \"tool\"\nforce_n = [0.0, 10.0, 0.0]\nfrom_s = 1.0\n\
                    duration_s = 60.0\nramp_s = 1.0\n";

#[test]
fn a_force_at_the_tool_ends_a_phase_in_the_period_behind_the_one_that_felt_it() {
    let measured = "[control]\nmeasure_tool_wrench = true\narm_law = \"attitude-held\"\n";
    let wait = hold("wait", "until = { signal = \"tool.force > 4 N\" }\ntimeout_s = 9.0\n");
    let case = fly(&[START, PUSH, measured, &wait, &hold("behind", "")]);
    // The force comes from 1 s on within a second: 4 N of 10 N are passed where (1 - cos π s)/2 = 0.4,
    // s = 0.4359. It is felt at the first reading behind that.
    goes(&case, &[("wait", 0.0), ("behind", 1.44)]);
    assert!(tells(&case, EventKind::Condition, "step wait: its condition holds"));
    // Nothing measures it: the condition could never hold, and that is said before.
    let told = read(&[START, PUSH, &wait, &hold("behind", "")]).expect_err("nothing measures it");
    assert!(told.contains("nothing measures tool.force"), "{told}");
}

#[test]
fn a_timeout_is_a_fault_and_leads_where_faults_lead() {
    let never = "until = { signal = \"base.turn_speed > 5 deg/s\" }\ntimeout_s = 1.5\n";
    let phases = [hold("wait", &format!("{never}on_fault = \"c\"")), hold("b", ""), hold("c", "")];
    let case = fly(&[START, &phases.join("")]);
    goes(&case, &[("wait", 0.0), ("c", 1.5)]);
    assert!(tells(&case, EventKind::Fault, "step wait: timeout after 1.5 s"));
    // Without a way out it goes on as it would have.
    let phases = [hold("wait", never), hold("b", "")];
    goes(&fly(&[START, &phases.join("")]), &[("wait", 0.0), ("b", 1.5)]);
}

#[test]
fn a_tool_has_reached_its_end_when_the_sensors_have_it_there() {
    let reached = |near: &str| {
        let phase = format!(
            "[[phase]]\nname = \"go\"\nmove_tool = {{ by_m = [0.0, 0.1, 0.0], duration_s = 10.0 }}\n\
             until = {{ reached = {{ distance_mm = {near}, angle_deg = 1.0 }} }}\ntimeout_s = 12.0\n"
        );
        let case =
            fly(&[START, "[control]\narm_law = \"attitude-held\"\n", &phase, &hold("b", "")]);
        way(&case)[1].1
    };
    // A quintic is within 10 mm of 100 mm where 10 s³ - 15 s⁴ + 6 s⁵ = 0.9: s = 0.7534. The tool is
    // seen there at the next reading.
    let near = reached("10.0");
    assert!((near - 7.54).abs() < 0.011, "{near}");
    assert!(reached("0.5") > near);
    // Nobody comes within a picometre.
    assert!((reached("1e-12") - 12.0).abs() < 1e-9);
}

fn module(speed: f64) -> String {
    format!(
        "[payload.module]\nmass_kg = 200.0\nuniform_box_m = [1.0, 1.0, 1.0]\n\
         free = {{ seen_from = \"tool\", position_m = [0.02, 0.0, 0.0], velocity_m_s = [{speed:?}, 0.0, 0.0] }}\n"
    )
}

const GRASP: &str = "[[phase]]\nname = \"grasp\"\ngrasp = { payload = \"module\", largest_speed_m_s = 0.01, \
                     largest_turn_speed_deg_s = 0.1 }\n";

#[test]
fn a_refused_grasp_is_tried_again_as_often_as_attempts_allow() {
    let tries = format!(
        "{GRASP}on_fault = \"wait\"\nattempts = 3\nthen = \"end\"\non_exhausted = \"give up\"\n{}{}",
        hold("wait", "then = \"grasp\""),
        hold("give up", "")
    );
    // 20 mm away and standing there: refused three times.
    let case = fly(&[START, &module(0.0), &tries]);
    let grips = [("grasp", 0.0), ("wait", 0.01), ("grasp", 1.01), ("wait", 1.02), ("grasp", 2.02)];
    goes(&case, &[&grips[..], &[("wait", 2.03), ("give up", 3.03)]].concat());
    assert_eq!(case.events.iter().filter(|e| e.text.contains("refused: ")).count(), 3);
    assert!(tells(&case, EventKind::Fault, "grasp does not begin again: 3 attempts are used up"));
    // It comes nearer by 9 mm a second: the third try has it.
    let case = fly(&[START, &module(-0.009), &tries]);
    goes(&case, &grips);
    assert!(tells(&case, EventKind::Grip, "grasped module") && case.ledger.closes);
}

#[test]
fn attempts_without_a_way_out_end_the_mission_and_say_so() {
    let tries =
        format!("{GRASP}on_fault = \"wait\"\nattempts = 2\n{}", hold("wait", "then = \"grasp\""));
    let case = fly(&[START, &module(0.0), &tries]);
    let End::Infeasible { reason, phase, .. } = &case.end else { panic!("{:?}", case.end) };
    assert!(
        phase == "grasp" && reason.contains("begun 2 times, as often as its attempts"),
        "{reason}"
    );
    assert!(!case.passed);
    // A grasp that says nothing of faults ends the mission as ever.
    let case = fly(&[START, &module(0.0), GRASP]);
    assert!(matches!(&case.end, End::Infeasible { reason, .. } if reason.contains("refused")));
}

#[test]
fn a_motion_that_cannot_begin_is_a_fault_that_may_lead_on() {
    let beyond = "[[phase]]\nname = \"beyond\"\nmove_joints = { to_tool = { position_m = [9.0, 0.0, 0.0], \
                  attitude = { rpy_deg = [0.0, 0.0, 0.0] }, axes = \"base\" }, duration_s = 5.0 }\n";
    let parts = [START, "[control]\narm_law = \"attitude-held\"\n"];
    let lost = fly(&[parts[0], parts[1], beyond, &hold("b", "")]);
    assert!(matches!(lost.end, End::Infeasible { .. }), "{:?}", lost.end);
    let led = format!("{beyond}on_fault = \"c\"\n{}{}", hold("b", ""), hold("c", ""));
    let case = fly(&[parts[0], parts[1], &led]);
    assert!(matches!(case.end, End::Completed));
    goes(&case, &[("beyond", 0.0), ("c", 0.01)]);
    assert!(tells(&case, EventKind::Fault, "step beyond cannot begin: no joint positions"));
}

#[test]
fn what_a_phase_says_of_its_end_is_checked() {
    let told = |more: &str| read(&[START, &hold("a", more), &hold("b", "")]).expect_err(more);
    for (more, what) in [
        ("then = \"d\"", "there is no phase called \"d\""),
        ("then = \"a\"", "the phases a can go round for ever"),
        ("until = { signal = \"base.turn_speed > 1 deg/s\" }", "may never end"),
        ("until = { reached = { distance_mm = 1.0, angle_deg = 1.0 } }", "may never end"),
        (
            "until = { elapsed_s = 1.0, signal = \"propellant < 1 kg\" }",
            "until says exactly one thing",
        ),
        ("until = { }", "until says exactly one thing"),
        (
            "timeout_s = 1.0\nuntil = { signal = \"base.turnspeed > 1 deg/s\" }",
            "did you mean base.turn_speed?",
        ),
        ("timeout_s = 1.0\nuntil = { signal = \"base.turn_speed > 1 N\" }", "N does not measure"),
        ("timeout_s = 1.0\nuntil = { signal = \"base.turn_speed >= 1 N\" }", "is no condition"),
        (
            "timeout_s = 1.0\nuntil = { signal = \"base.turn_speed > one deg/s\" }",
            "one is not a number",
        ),
        ("timeout_s = -1.0", "`timeout_s` must be above zero"),
        ("attempts = 0", "attempts must be above zero"),
        ("on_exhausted = \"b\"", "attempts are never used up"),
        ("attempts = 2\nthen = \"a\"\non_exhausted = \"a\"", "the phases a can go round for ever"),
        ("arm_law = \"held\"", "`arm_law` must be"),
        ("tool = \"hand\"", "there is no tool or frame called \"hand\""),
    ] {
        let told = told(more);
        assert!(told.contains(what), "{more}:\n{told}");
    }
    let told = read(&[START, "[[phase]]\nname = \"a\"\nhold = { }\n"]).expect_err("no end");
    assert!(told.contains("a hold without an end"), "{told}");
    // What is begun a limited number of times may come round.
    read(&[START, &hold("a", "attempts = 2\nthen = \"a\"\non_exhausted = \"b\""), &hold("b", "")])
        .unwrap_or_else(|told| panic!("{told}"));
}

/// The bound that the planning tells, in s.
fn bound(case: &CaseOutcome) -> f64 {
    let line = case.plan.iter().find(|line| line.phase == "duration").expect("a bound");
    let (_, rest) = line.text.split_once("at most ").expect("a number");
    rest.split(' ').next().and_then(|x| x.parse().ok()).expect("a number")
}

#[test]
fn the_planning_says_what_it_could_not_foresee() {
    let wait = hold(
        "wait",
        "until = { signal = \"base.turn_speed > 5 deg/s\" }\ntimeout_s = 4.0\non_fault = \"c\"",
    );
    let case = fly(&[START, &[wait, hold("b", "then = \"end\""), hold("c", "")].join("")]);
    let line = case.plan.iter().find(|line| line.phase == "duration").expect("a bound");
    // Planned: the condition holds at 4 s, then b for 1 s; c may come instead.
    assert!((bound(&case) - 5.01).abs() < 1e-9, "{}", line.text);
    assert!(line.text.contains("conditions were taken to hold at their timeouts: wait"));
    assert!(
        line.text.contains("not gone through, for they come after faults or other conditions: c")
    );
    // Phases one after the other have no bound: their time is the plan's.
    let plain = fly(&[START, &hold("a", ""), &hold("b", "")]);
    assert!(plain.plan.iter().all(|line| line.phase != "duration"));
}

/// Three times a for 1 s; and before, between and behind these beginnings the longest way that uses up no
/// attempts, b for 1 s, four times; a period for the last look. It is flown in 4 s: a bound, not a forecast.
#[test]
fn attempts_count_in_the_bound_as_often_as_they_are() {
    let again = hold("a", "attempts = 3\nthen = \"a\"\non_exhausted = \"b\"");
    let case = fly(&[START, &again, &hold("b", "")]);
    goes(&case, &[("a", 0.0), ("a", 1.0), ("a", 2.0), ("b", 3.0)]);
    assert!((bound(&case) - 7.01).abs() < 1e-9, "{}", bound(&case));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 40, failure_persistence: None, ..ProptestConfig::default() })]
    /// Whatever leads where, no flight takes longer than its bound; a mission that could go round for ever
    /// is refused.
    #[test]
    fn no_flight_takes_longer_than_the_bound(
        steps in prop::collection::vec((0..6_usize, 0..6_usize, 0..4_u32, 1..4_u32, any::<bool>()), 1..6),
    ) {
        let name = |i: usize| if i < steps.len() { format!("s{i}") } else { "end".into() };
        let phases = steps.iter().enumerate().map(|(i, &(then, fault, attempts, tenths, waits))| {
            let wait = "until = { signal = \"base.turn_speed > 5 deg/s\" }\ntimeout_s = 0.2\n";
            let limit = format!("attempts = {attempts}\non_exhausted = \"end\"\n");
            let (then, fault) = (name(then), name(fault));
            [
                format!("[[phase]]\nname = \"s{i}\"\nhold = {{ duration_s = 0.{tenths} }}\n"),
                format!("then = \"{then}\"\non_fault = \"{fault}\"\n"),
                if waits { wait.to_owned() } else { String::new() },
                if attempts > 0 { limit } else { String::new() },
            ]
            .concat()
        });
        let text = phases.collect::<String>();
        let Ok(mission) = read(&[START, &text]) else { return Ok(()) };
        let case = run(&mission, RunOptions::default(), &mut |_| {}).cases.remove(0);
        prop_assert!(matches!(case.end, End::Completed), "{:?}\n{text}", case.end);
        let flown = case.telemetry.time.last().copied().unwrap_or_default();
        prop_assert!(flown <= bound(&case) + 1e-9, "{flown} s, bound {} s\n{text}", bound(&case));
    }
}
