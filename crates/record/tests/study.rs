//! The tables and the report of a study.

use std::fs;
use wrasse_hardware::ControlMomentGyro;
use wrasse_record::{Provenance, study_html, study_json, study_table, write_study};
use wrasse_spatial::{Vec3, vec3};
use wrasse_study::{
    Answer, Bounds, Demand, Finding, Flown, HandCheck, SetCard, SetKind, SetVerdict, StudyOutcome,
    TaskOutcome, singular_surfaces,
};

fn cmgs() -> Vec<ControlMomentGyro<f64>> {
    let sides = [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)];
    let cmg = |(x, y): (f64, f64)| ControlMomentGyro {
        gimbal_axis_B: vec3(0.8 * x, 0.8 * y, 0.6),
        spin_axis_B: vec3(-y, x, 0.0),
        momentum: 75.0,
        ..Default::default()
    };
    sides.into_iter().map(cmg).collect()
}

fn some(plain: f64, best: f64) -> Bounds<Option<f64>> {
    Bounds { plain: Some(plain), best: Some(best) }
}

fn cards() -> Vec<SetCard> {
    let card = |name: &str, kind, reach: Option<Bounds<f64>>| SetCard {
        name: name.into(),
        kind,
        mass_kg: Some(48.0),
        power_w: None,
        within_mass_limit: None,
        within_power_limit: None,
        propellant_kg: None,
        torque_nm: [reach; 3],
        momentum_nms: [reach; 3],
        momentum_everywhere_nms: reach.map(|r| r.best),
        provenance: vec![],
        surfaces: vec![],
    };
    let wheels = Bounds { plain: 0.3, best: 0.3 };
    let mut all = vec![
        card("ideal", SetKind::Ideal, None),
        card("4 <wheels>", SetKind::Wheels, Some(wheels)),
        card("4 CMGs 75 N·m·s", SetKind::Cmgs, Some(Bounds { plain: 86.6, best: 236.6 })),
    ];
    all[2].surfaces = singular_surfaces(&cmgs(), 6);
    all
}

fn verdict(set: &str, torque: Answer, momentum: Answer) -> SetVerdict {
    SetVerdict {
        set: set.into(),
        suffices: torque.max(momentum),
        torque,
        momentum,
        propellant: Answer::Yes,
        torque_load: some(1.1, 0.4),
        torque_nm: some(84.0, 230.0),
        momentum_nms: some(90.0, 237.0),
        saturates_s: Bounds { plain: Some(0.5), best: None },
        slower: some(4.05, 1.0),
        fuel_kg: None,
        fuel_in_place_kg: None,
        flown: None,
    }
}

/// A push of `force` (N) at 1.75 m that lasts.
fn task(name: &str, force: f64) -> TaskOutcome {
    let mut ideal = verdict("ideal", Answer::Yes, Answer::Yes);
    ideal.torque_nm = Bounds { plain: None, best: None };
    ideal.momentum_nms = ideal.torque_nm;
    let mut cmgs = verdict("4 CMGs 75 N·m·s", Answer::Yes, Answer::WithSteering);
    cmgs.saturates_s = some(0.5, 237.0 / (1.75 * force));
    cmgs.torque_nm = some(84.0, 700.0);
    cmgs.flown = Some(Flown {
        tool_error_mm: 0.41,
        tool_error_at_end_mm: 0.1,
        attitude_error_deg: 0.012,
        propellant_kg: None,
        requirements_hold: false,
        ended: None,
        limit: Some("CMG 1 turns at its limit".into()),
        closes: true,
    });
    let time: Vec<f64> = (0..=20).map(|k| 0.05 * f64::from(k)).collect();
    TaskOutcome {
        name: name.into(),
        labels: vec![("task".into(), name.into())],
        unflown: None,
        own_motion: false,
        duration_s: 1.0,
        peak_torque_nm: 1.75 * force,
        peak_torque_by_axis_nm: [0.0, 0.0, 1.75 * force],
        peak_momentum_nms: 1.75 * force,
        gathered_nm: Some(1.75 * force),
        by_hand: Some(HandCheck { momentum: 350.0, torque: 350.0, how: "200 N at 1.75 m".into() }),
        tool_error_mm: 0.02,
        verdicts: vec![ideal, verdict("4 <wheels>", Answer::No, Answer::Yes), cmgs],
        demand: Demand {
            torque_B: vec![vec3(0.0, 0.0, 1.75 * force); 21],
            momentum_B: time.iter().map(|t| vec3(0.0, 0.0, -1.75 * force * t)).collect(),
            force_B: vec![vec3(0.0, force, 0.0); 21],
            time,
        },
    }
}

fn sample() -> StudyOutcome {
    let unflown = TaskOutcome {
        unflown: Some("out of reach".into()),
        verdicts: vec![],
        demand: Demand::default(),
        ..task("far", 1.0)
    };
    StudyOutcome {
        study: "sample".into(),
        summary: "A study <for> a test.".into(),
        file: "sample.toml".into(),
        text: "name = \"sample\"".into(),
        settings: vec![],
        version: "0.0.0".into(),
        seed: 1,
        claim: "CMGs are needed.".into(),
        mass_limit_kg: None,
        power_limit_w: None,
        flights: 4,
        closes: true,
        sets: cards(),
        tasks: vec![task("200 N lateral", 200.0), task("20 N lateral", 20.0), unflown],
        findings: vec![Finding {
            about: "where the claim holds".into(),
            text: "In 1 of 2 tasks.".into(),
            tasks: vec!["200 N lateral".into()],
        }],
    }
}

#[test]
fn the_terminal_shows_demands_a_matrix_of_verdicts_flights_and_findings() {
    let table = study_table(&sample());
    let lines: Vec<&str> = table.lines().collect();
    let demand = lines.iter().find(|l| l.starts_with("200 N lateral")).unwrap();
    let cells: Vec<&str> = demand.split_whitespace().collect();
    assert_eq!(cells, ["200", "N", "lateral", "1", "350", "350", "350", "350", "350", "0.02"]);
    assert!(table.contains("not flown: out of reach"));
    let verdicts: Vec<_> = lines.iter().filter(|l| l.contains("steer x4.1")).collect();
    assert_eq!(verdicts.len(), 2, "{table}");
    assert!(verdicts[0].contains("yes") && verdicts[0].contains("no T x4.1"));
    assert!(table.contains("CMG 1 turns at its limit") && table.contains("FAIL"));
    assert!(table.contains("where the claim holds: In 1 of 2 tasks."));
    assert!(table.ends_with("4 flights; their ledgers close\n"), "{table}");
}

#[test]
fn the_terminal_always_shows_what_the_sets_can_give_and_what_they_weigh() {
    let mut outcome = sample();
    for tasks in [3, 1] {
        outcome.tasks.truncate(tasks);
        let table = study_table(&outcome);
        let row = |name: &str| {
            let line = table.lines().find(|line| line.starts_with(name)).unwrap_or_default();
            line[name.len()..].split_whitespace().map(String::from).collect::<Vec<_>>()
        };
        let cmgs = ["86.6", "86.6", "86.6", "86.6", "86.6", "86.6", "237", "48", "-", "-"];
        assert_eq!(row("4 CMGs 75 N·m·s"), cmgs, "{table}");
        assert_eq!(row("ideal")[..2], ["any", "any"]);
    }
}

#[test]
fn a_ledger_that_stays_open_is_told_with_its_task_and_set_and_a_hint() {
    let mut outcome = sample();
    outcome.closes = false;
    if let Some(flown) = &mut outcome.tasks[0].verdicts[2].flown {
        flown.closes = false;
    }
    let table = study_table(&outcome);
    let told = "4 flights; LEDGER OPEN:\n  200 N lateral with 4 CMGs 75 N·m·s\n";
    assert!(table.contains(told) && table.contains("a smaller world.step_s"), "{table}");
    assert_eq!(study_html(&outcome).matches("ledger open").count(), 1);
    // None of those flown in closed loop.
    for task in &mut outcome.tasks {
        task.verdicts.iter_mut().for_each(|verdict| verdict.flown = None);
    }
    let table = study_table(&outcome);
    assert!(table.contains("LEDGER OPEN: of a task that is not flown"), "{table}");
}

#[test]
fn two_tasks_are_shown_with_a_line_for_each_set() {
    let mut outcome = sample();
    outcome.tasks.pop();
    let table = study_table(&outcome);
    let cmgs: Vec<_> = table.lines().filter(|l| l.starts_with("4 CMGs")).collect();
    // One more in the table of the sets.
    assert_eq!(cmgs.len(), 3, "{table}");
    assert!(cmgs[1].contains("steer") && cmgs[1].contains("4.1") && cmgs[1].contains("0.5"));
}

#[test]
fn the_report_loads_nothing_is_well_formed_and_draws_everything() {
    let html = study_html(&sample());
    assert!(
        html.contains("default-src 'none'")
            && !html.contains("http://")
            && !html.contains("https://")
    );
    assert!(html.contains("4 &lt;wheels&gt;") && html.contains("A study &lt;for&gt; a test."));
    assert!(!html.contains("NaN") && !html.contains(">inf<"));
    // Three looks at the envelope, the saturation, torque and momentum of two tasks.
    assert_eq!(html.matches("<svg").count(), 3 + 1 + 4);
    let markup = html.replace("<!DOCTYPE html>\n", "");
    roxmltree::Document::parse(&markup).unwrap();
}

/// Time to saturation falls with the force: points lie on the curve of their set.
#[test]
fn the_curve_of_saturation_passes_through_its_points() {
    let html = study_html(&sample());
    let figure = html.split("aria-label=\"Time to saturation").nth(1).unwrap();
    let figure = figure.split("</svg>").next().unwrap();
    let curve = figure.split("<polyline class=\"trace line-4\" points=\"").nth(1).unwrap();
    let curve: Vec<[f64; 2]> = curve.split('"').next().unwrap().split(' ').map(pair).collect();
    let points: Vec<[f64; 2]> = figure
        .split("<circle class=\"point line-4\" cx=\"")
        .skip(1)
        .map(|rest| {
            let parts: Vec<&str> = rest.split('"').collect();
            [parts[0].parse().unwrap(), parts[2].parse().unwrap()]
        })
        .collect();
    assert_eq!(points.len(), 2);
    for [x, y] in points {
        let (a, b) = curve.windows(2).map(|w| (w[0], w[1])).find(|(_, b)| b[0] >= x - 0.1).unwrap();
        let line = a[1] + (b[1] - a[1]) * (x - a[0]) / (b[0] - a[0]);
        // A straight line on this paper; figures have one decimal. Measured 0.04.
        assert!((line - y).abs() < 0.2, "{line} {y}");
    }
}

fn pair(text: &str) -> [f64; 2] {
    let (x, y) = text.split_once(',').expect("a pair");
    [x, y].map(|number| number.parse().expect("a number"))
}

#[test]
fn results_are_written_together_and_the_summary_reads_back() {
    let folder = tempfile::tempdir().unwrap();
    let written = write_study(&sample(), &Provenance::default(), folder.path()).unwrap();
    let summary: serde_json::Value =
        serde_json::from_str(&fs::read_to_string(&written.summary).unwrap()).unwrap();
    assert_eq!(summary, study_json(&sample(), &Provenance::default()));
    assert_eq!(summary["tasks"][0]["verdicts"][2]["suffices"], "with-steering");
    assert_eq!(summary["tasks"][0]["gathered_nm"], 350.0);
    assert!(fs::read_to_string(&written.report).unwrap().starts_with("<!DOCTYPE html>"));
    let left: Vec<_> = fs::read_dir(folder.path()).unwrap().collect();
    assert_eq!(left.len(), 2);
}

#[test]
fn a_study_without_tasks_is_shown_without_them() {
    let outcome = StudyOutcome { tasks: vec![], findings: vec![], flights: 0, ..sample() };
    assert!(study_table(&outcome).contains("0 flights"));
    assert!(study_html(&outcome).contains("The sets of actuators"));
    let nothing = Demand { time: vec![0.0], torque_B: vec![Vec3::zero()], ..Demand::default() };
    assert_eq!(nothing.duration(), 0.0);
}
