//! Every requirement can fail: each quantity in a mission in which it does for a reason of physics, beside one
//! in which all is well. And what a run shows of a quantity a sweep shows, too.
#![allow(clippy::print_stdout, reason = "prints what was measured, under --nocapture")]

mod missions;
mod table;

use missions::{Pair, pairs};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use table::ROWS;
use wrasse_mission::{Mission, read_mission};
use wrasse_rehearsal::{CaseOutcome, RunOptions, Verdict, fly_sample, plan_samples, run_case};
use wrasse_testing::largest;

/// A mission of this text with these requirements; vehicles lie beside it.
fn read(text: &str, requirements: &[String]) -> Mission {
    let folder: PathBuf = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/requirements_can_fail");
    let text = text.replace("requirements = []", &format!("requirements = {requirements:?}"));
    read_mission(folder.join("flown.toml"), text)
        .unwrap_or_else(|complaints| panic!("{}", wrasse_document::render(&complaints, false)))
}

fn fly(text: &str, requirements: &[String]) -> CaseOutcome {
    run_case(&read(text, requirements).cases[0], RunOptions::default(), &mut |_, _| {})
}

/// What is judged of each metric of a pair, in both directions.
fn both_ways(pair: &Pair) -> Vec<String> {
    let of_pair = ROWS.iter().filter(|row| row.0 == pair.name);
    of_pair
        .flat_map(|(_, metric, limit, _)| ["<=", ">="].map(|way| format!("{metric} {way} {limit}")))
        .collect()
}

#[test]
fn every_metric_has_a_mission_that_fails_it_and_one_that_meets_it_in_both_directions() {
    for pair in pairs() {
        let wanted = both_ways(&pair);
        let [good, bad] = [&pair.good, &pair.bad].map(|text| fly(text, &wanted).verdicts);
        for (good, bad) in good.iter().zip(&bad) {
            let text = &good.requirement;
            let values = format!("{}: {text}: {:?} and {:?}", pair.name, good.value, bad.value);
            println!("{values}");
            assert!(good.value.is_some() && bad.value.is_some(), "{values}");
            assert!(good.pass != bad.pass, "one meets it, the other does not: {values}");
        }
    }
}

#[test]
fn the_table_names_every_metric_that_there_is() {
    let listed: BTreeSet<&str> = ROWS.iter().map(|row| row.1).collect();
    let none = [String::from("xyzzy.plugh <= 1 m")];
    let pair = &pairs()[0];
    let text = pair.good.replace("requirements = []", &format!("requirements = {none:?}"));
    let complaints = read_mission("flown.toml", text).expect_err("there is no such metric");
    let told = wrasse_document::render(&complaints, false);
    let all = told.split("the metrics are ").nth(1).expect("all are listed");
    let mut count = 0;
    for entry in all.split(|c: char| c == ';' || c.is_control()) {
        let mut words = entry.split_whitespace();
        let Some(first) = words.next().filter(|word| word.contains('.')) else { continue };
        let Some((quantity, statistic)) = first.rsplit_once('.') else { continue };
        let others = words.filter_map(|word| word.strip_prefix('.'));
        for statistic in std::iter::once(statistic).chain(others) {
            let name = format!("{quantity}.{statistic}").replace("NAME", "joint4");
            assert!(listed.contains(name.as_str()), "{name} is not in the table");
            count += 1;
        }
    }
    // Measured: 52.
    assert!(count >= 50, "{count} in {all}");
}

/// A sample looks at what is required and at nothing else.
#[test]
fn whatever_a_run_shows_of_a_quantity_a_sample_shows_to_the_bit() {
    for pair in pairs() {
        let shown = fly(&pair.bad, &[]).metrics;
        let required = |m: &wrasse_rehearsal::Metric| {
            let unit = m.unit.replace('–', "-");
            format!("{} >= -1e300 {unit}", m.name)
        };
        let (seed, number) = (5, 17);
        for metric in shown.iter().filter(|m| ROWS.iter().any(|row| row.1 == m.name)) {
            let mission = read(&pair.bad, &[required(metric)]);
            let sampled = mission.sampled(seed, number);
            let run = run_case(&sampled.cases[0], RunOptions::default(), &mut |_, _| {});
            let sample = fly_sample(&plan_samples(&mission.cases[0]), seed, number);
            let bits = |v: &Verdict| v.value.map(f64::to_bits);
            assert!(run.verdicts[0].value.is_some(), "{}: {}", pair.name, metric.name);
            let found = (bits(&sample.verdicts[0]), sample.verdicts[0].pass);
            let name = (&pair.name, &metric.name);
            assert_eq!(found, (bits(&run.verdicts[0]), run.verdicts[0].pass), "{name:?}");
        }
    }
}

/// A saturated drive gives no more than it has, however much is asked.
#[test]
fn a_drive_that_is_asked_for_more_than_it_has_fails_its_effort_use() {
    let pair = pairs().remove(0);
    let flown = fly(&pair.bad, &[String::from("joints.effort_use.max <= 100 %")]);
    assert!(!flown.verdicts[0].pass, "{:?}", flown.verdicts[0]);
    // What is given stays within: 230 N·m.
    let given = flown.telemetry.channels.iter().find(|c| c.name == "joint.joint4.effort");
    let given = largest(given.expect("it is drawn").values.iter().map(|x| x.abs()));
    assert!(given <= 230.0, "{given}");
}

#[test]
fn while_nothing_is_driven_the_tool_has_no_error_that_could_meet_a_requirement() {
    let coast = pairs().into_iter().find(|pair| pair.name == "coast").expect("there is one");
    for metric in ["tool.position_error.max <= 1 m", "tool.attitude_error.final <= 1 deg"] {
        let verdict = fly(&coast.good, &[metric.into()]).verdicts.remove(0);
        assert_eq!((verdict.value, verdict.pass), (None, false), "{metric}");
    }
}
