//! Outcomes as a mission would leave them, for the tests: a servicer that moves a load sideways.
//! The figures are made up, smooth and of the right size; no dynamics is behind them.
#![allow(dead_code, reason = "each test file uses its own part")]

use wrasse_mission::{Outcome, ProvenanceRow, VehicleCard};
use wrasse_rehearsal::{
    Account, Booking, Bookings, CaseOutcome, Channel, End, Event, EventKind, Ledger, Metric,
    PlanLine, Setting, Snapshot, SnapshotBox, Source, Telemetry, Verdict,
};
use wrasse_spatial::vec3;

const DURATION: f64 = 24.0;

/// One case, all requirements hold.
pub(crate) fn single() -> Outcome {
    outcome("atlas-reach", vec![case(vec![], 0.0, 2401)])
}

/// Three laws with three loads; one path is infeasible.
pub(crate) fn compared() -> Outcome {
    let mut cases = Vec::new();
    for (k, law) in ["terrestrial", "attitude-held", "free-floating"].iter().enumerate() {
        for (m, load) in ["unladen", "200 kg", "500 kg"].iter().enumerate() {
            let labels = [("law", law), ("load", load)];
            let labels = labels.map(|(axis, row)| (axis.to_string(), row.to_string())).to_vec();
            let miss = if k == 0 { -15.6e-3 * (1.0 + 3.5 * m as f64) } else { 0.0 };
            let mut case = case(labels, miss, 2401);
            if (k, m) == (2, 2) {
                case.end = End::Infeasible {
                    phase: "reach".into(),
                    time_s: 13.28,
                    reason: "the wrist is 0.8731 m from the shoulder, the arm reaches 0.8500 m: \
                             the base recoils away from the target"
                        .into(),
                };
                case.telemetry = Telemetry::default();
                case.snapshots.truncate(1);
                case.metrics.clear();
                case.verdicts.iter_mut().for_each(|v| (v.value, v.pass) = (None, false));
                case.passed = false;
            }
            cases.push(case);
        }
    }
    outcome("miss-distance", cases)
}

/// A single case whose every name tries to break the page.
pub(crate) fn hostile() -> Outcome {
    let bad = "</script><script>alert(1)</script><b onclick='x' title=\"y\">&amp;\u{1b}[2J";
    let mut outcome = single();
    for text in [
        &mut outcome.mission,
        &mut outcome.summary,
        &mut outcome.mission_file,
        &mut outcome.mission_text,
        &mut outcome.version,
        &mut outcome.environment,
        &mut outcome.vehicle.name,
        &mut outcome.vehicle.summary,
        &mut outcome.vehicle.file,
    ] {
        *text = bad.into();
    }
    outcome.vehicle.remarks = vec![bad.to_owned()];
    outcome.settings = vec![bad.to_owned()];
    for row in &mut outcome.vehicle.provenance {
        *row = ProvenanceRow { of: bad.into(), grade: bad.into(), source: bad.into() };
    }
    let case = &mut outcome.cases[0];
    case.end = End::Stopped { phase: bad.into(), time_s: 3.0, reason: bad.into() };
    case.plan.iter_mut().for_each(|p| *p = PlanLine { phase: bad.into(), text: bad.into() });
    case.events.iter_mut().for_each(|e| e.text = bad.into());
    for verdict in &mut case.verdicts {
        verdict.requirement = bad.into();
        verdict.comparison = "<=".into();
        verdict.unit = bad.into();
    }
    case.metrics.iter_mut().for_each(|m| (m.name, m.unit) = (bad.into(), bad.into()));
    case.snapshots.iter_mut().for_each(|s| s.boxes[0].name = bad.into());
    for (k, channel) in case.telemetry.channels.iter_mut().enumerate() {
        channel.name = format!("{bad}{k}");
        channel.unit = bad.into();
        channel.plot = bad.into();
        channel.label = bad.into();
    }
    let mut second = case.clone();
    case.labels = vec![(bad.to_owned(), bad.to_owned())];
    second.labels = vec![(bad.to_owned(), "other".to_owned())];
    outcome.cases.push(second);
    outcome
}

fn outcome(mission: &str, cases: Vec<CaseOutcome>) -> Outcome {
    let row = |of: &str, grade: &str, source: &str| ProvenanceRow {
        of: of.into(),
        grade: grade.into(),
        source: source.into(),
    };
    Outcome {
        mission: mission.into(),
        summary: "The arm carries a load 0.3 m sideways while the base is held.".into(),
        mission_file: format!("missions/{mission}.toml"),
        mission_text:
            "vehicle = \"atlas-class\"\n\n[[phases]]\nname = \"reach\"\n# <20 s & calm>\n".into(),
        settings: vec![],
        version: "0.1.0".into(),
        seed: 7,
        vehicle: VehicleCard {
            name: "ATLAS-class servicer, one arm".into(),
            summary: "A 1500 kg bus with one seven-joint arm.".into(),
            file: "vehicles/atlas-class.toml".into(),
            mass_kg: 1500.0,
            joints: 7,
            provenance: vec![
                row("body.bus.mass_kg", "published", "Ellery 2004, section 2: \"1.5 tonne\""),
                row("body.bus.inertia", "derived", "uniform box of 1.8 m × 1.6 m × 1.6 m"),
                row("joint.*.limits", "assumed", "as for other space arms of this size"),
            ],
            remarks: vec!["atlas-class.toml:12: joint7 has no travel limits".into()],
        },
        environment: "Free space: nothing acts but the actuators.".into(),
        cases,
    }
}

fn case(labels: Vec<(String, String)>, miss: f64, samples: usize) -> CaseOutcome {
    let telemetry = telemetry(samples, miss);
    let verdict = |quantity: &str, limit: f64, value: f64, unit: &str| Verdict {
        requirement: format!("{quantity} <= {limit} {unit}"),
        comparison: "<=".into(),
        limit,
        value: Some(value),
        unit: unit.into(),
        pass: value <= limit,
    };
    let mut verdicts = vec![
        verdict("tool.position_error.max", 0.3, 0.012_34 + 1e3 * miss.abs(), "mm"),
        verdict("base.attitude_error.max", 0.5, 0.083_1, "deg"),
        verdict("joint.rate.max", 5.0, 4.327, "deg/s"),
        verdict("actuator.momentum.max", 25.0, 23.45, "N·m·s"),
    ];
    let mut settled = verdict("tool.position_error.final", 0.02, 0.001_7, "mm");
    settled.requirement += " during hold";
    verdicts.push(settled);
    let metric =
        |name: &str, value: f64, unit: &str| Metric { name: name.into(), value, unit: unit.into() };
    CaseOutcome {
        as_flown: vec![Setting {
            key: "control.arm_law".into(),
            value: "attitude-held".into(),
            origin: "default",
        }],
        labels,
        end: End::Completed,
        passed: verdicts.iter().all(|verdict| verdict.pass),
        verdicts,
        metrics: vec![
            metric("tool.position_error.max", 1.234e-5 + miss.abs(), "m"),
            metric("tool.along_track_error.final", miss + 2.1e-6, "m"),
            metric("tool.lateral_error.final", 0.3 * miss.abs() + 1.7e-6, "m"),
            metric("base.rotation.final", 0.083_1, "deg"),
            metric("broken", f64::NAN, "m"),
        ],
        ledger: ledger(),
        plan: vec![PlanLine {
            phase: "reach".into(),
            text: "feasible: 0.300 m in 20 s, largest joint rate 4.33 deg/s (joint2)".into(),
        }],
        events: [
            (0.0, "phase settle begins"),
            (2.0, "phase reach begins"),
            (12.4, "actuator holds 23.45 of 25 N·m·s"),
            (22.0, "phase hold begins"),
        ]
        .map(|(time_s, text)| Event { time_s, kind: EventKind::Phase, text: text.into() })
        .to_vec(),
        error_estimate: vec![metric("base.attitude", 3.1e-12, "rad")],
        telemetry,
        demand: vec![],
        snapshots: (0..25).map(|k| snapshot(f64::from(k), miss)).collect(),
    }
}

fn ledger() -> Ledger {
    let angular = vec3(0.12, -0.034, 21.9);
    let mut sources = Bookings::default();
    sources[Source::JointDrives].work = 0.0123;
    sources[Source::AttitudeActuator] = Booking { angular, work: -0.0123, ..Booking::default() };
    Ledger {
        end: Account { angular, energy: 1.3e-9, ..Account::default() },
        sources,
        residual: [3.1e-14, 1.2e-14, 2.4e-12],
        scale: [48.2, 14.6, 0.391],
        closes: true,
        bounds: [1e-12, 1e-12, 1e-8],
        ..Ledger::default()
    }
}

/// Quintic from 0 to 1 between 2 s and 22 s.
fn progress(time: f64) -> f64 {
    let s = ((time - 2.0) / 20.0).clamp(0.0, 1.0);
    s * s * s * (10.0 + s * (6.0 * s - 15.0))
}

fn telemetry(samples: usize, miss: f64) -> Telemetry {
    let time: Vec<f64> = (0..samples).map(|k| DURATION * k as f64 / (samples - 1) as f64).collect();
    let channel =
        |name: &str, unit: &str, plot: &str, label: &str, f: &dyn Fn(f64) -> f64| Channel {
            name: name.into(),
            unit: unit.into(),
            meaning: format!("what {name} is"),
            plot: plot.into(),
            label: label.into(),
            values: time.iter().map(|t| f(*t)).collect(),
        };
    let rate = |t: f64| (progress(t + 0.01) - progress(t - 0.01)) / 0.02;
    let mut channels = Vec::new();
    for (k, axis) in ["x", "y", "z"].iter().enumerate() {
        let size = [0.2, 1.0, 0.05][k];
        let mut three = |name: &str, unit: &str, plot: &str, f: &dyn Fn(f64) -> f64| {
            channels.push(channel(&format!("{name}.{axis}"), unit, plot, axis, f));
        };
        three("tool.error", "m", "Tool error", &|t| {
            size * (miss * progress(t) + 1e-5 * (3.0 * t).sin() * rate(t))
        });
        three("base.rotation", "deg", "Base attitude", &|t| 0.08 * size * progress(t));
        three("base.position", "m", "Base translation", &|t| -0.06 * size * progress(t));
        three("reaction.torque", "N·m", "Reaction torque", &|t| 80.0 * size * rate(t));
        three("actuator.torque", "N·m", "Reaction torque", &|t| -79.0 * size * rate(t));
        three("ledger.linear", "N·s", "Momentum left over", &|t| 1e-14 * size * (9.0 * t).sin());
    }
    for joint in 1..=7 {
        let phase = f64::from(joint);
        let (name, label) = (format!("joint.joint{joint}"), format!("joint{joint}"));
        channels.push(channel(&format!("{name}.rate"), "deg/s", "Joint rates", &label, &|t| {
            46.0 * rate(t) * (phase + 0.1 * t).sin()
        }));
        channels.push(channel(&format!("{name}.torque"), "N·m", "Joint torques", &label, &|t| {
            30.0 * rate(t) * (2.0 * phase + 0.3 * t).cos()
        }));
    }
    channels
        .push(channel("energy.kinetic", "J", "Energy and power", "kinetic", &|t| 40.0 * rate(t)));
    channels
        .push(channel("energy.power", "W", "Energy and power", "power", &|t| (t - 12.0) * rate(t)));
    let phase = vec!["move".to_owned(); time.len()];
    Telemetry { time, phase, channels }
}

fn snapshot(time: f64, miss: f64) -> Snapshot {
    let s = progress(time);
    let turn = -0.14 * s;
    let base = [-0.01 * s, -0.03 * s, 0.0];
    let place = |p: [f64; 3]| {
        let (sin, cos) = turn.sin_cos();
        [base[0] + cos * p[0] - sin * p[1], base[1] + sin * p[0] + cos * p[1], base[2] + p[2]]
    };
    let tool = [1.6, 0.1 + 0.9 * s, -0.1];
    let solid = |name: &str, at: [f64; 3], half: [f64; 3]| SnapshotBox {
        name: name.into(),
        corners: std::array::from_fn(|k| {
            place(std::array::from_fn(|i| {
                if k >> i & 1 == 1 { at[i] + half[i] } else { at[i] - half[i] }
            }))
        }),
    };
    let elbow = [1.25, 0.4 + 0.3 * s, 0.28 - 0.1 * s];
    let wrist = [tool[0] - 0.2, tool[1], tool[2]];
    let arm = [[0.9, 0.5, 0.0], elbow, wrist, tool].map(place).to_vec();
    Snapshot {
        time,
        boxes: vec![
            solid("bus", [0.0, 0.0, 0.0], [0.9, 0.8, 0.8]),
            solid("payload", [tool[0] + 0.25, tool[1], tool[2]], [0.25, 0.3, 0.3]),
        ],
        arms: vec![arm],
        tool: place(tool),
        reference: place([tool[0], tool[1] - miss * s, tool[2]]),
        guided: "tool".into(),
    }
}
