//! What is written of a sweep: rows that hold every bit, a page that stands alone.
#![allow(clippy::unwrap_used, reason = "a test may stop where it finds nothing")]

use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;
use std::fs::File;
use std::io::Write;
use std::sync::LazyLock;
use wrasse_mission::{Mission, read_mission, run};
use wrasse_record::{
    Provenance, samples_parquet, sweep_html, sweep_json, sweep_table, write_sweep,
};
use wrasse_rehearsal::RunOptions;
use wrasse_sweep::{OwnedFolder, Sweep, SweepOutcome, sweep};

/// Two cases, the second with a payload that floats away too fast to be grasped.
const MISSION: &str = r#"
name = "quick"
summary = "Tells < from > & more."
vehicle = "atlas-class"
requirements = ["tool.position_error.max <= 0.1 mm", "base.rotation.final >= 0 deg during away"]

[initial]
posture = "forward_300mm"

[payload.module]
mass_kg = 200.0
centre_of_mass_m = [0.5, 0.0, 0.0]
uniform_box_m = [1.0, 1.0, 1.0]
free = { seen_from = "tool" }

[world]
joints = "torque"

[[phase]]
name = "grasp"
grasp = { payload = "module", largest_speed_m_s = 0.001, largest_turn_speed_deg_s = 0.05 }

[[phase]]
name = "away"
move_tool = { by_m = [0.0, 0.02, 0.0], duration_s = 1.0 }

[[disperse]]
quantity = "payload.module.mass_kg"
sigma = 10.0
within = 30.0

[[disperse]]
quantity = "payload.module.velocity_m_s.x"
between = [0.0, 0.0005]

[[compare]]
axis = "client"

[[compare.row]]
name = "still"

[[compare.row]]
name = "drifts"
set.payload.module.free = { seen_from = "tool", velocity_m_s = [0.0008, 0.0, 0.0] }
"#;

const SAMPLES: u64 = 12;
const SEED: u64 = 5;

static FLOWN: LazyLock<(Mission, SweepOutcome)> = LazyLock::new(|| {
    let mission = read_mission("quick.toml", MISSION).expect("a sound mission");
    let place = tempfile::tempdir().unwrap();
    let asked = Sweep { mission: &mission, samples: SAMPLES, seed: SEED, threads: 2 };
    let folder = OwnedFolder::take(place.path()).unwrap();
    let outcome = sweep(&asked, &folder, &mut |_, _| {}).unwrap();
    (mission, outcome)
});

fn reader(bytes: &[u8]) -> SerializedFileReader<File> {
    let mut file = tempfile::tempfile().unwrap();
    file.write_all(bytes).unwrap();
    SerializedFileReader::new(file).unwrap()
}

/// The rows of the file, each a list of (column, value).
fn rows(bytes: &[u8]) -> Vec<Vec<(String, Field)>> {
    let reader = reader(bytes);
    let rows = reader.get_row_iter(None).unwrap();
    let all = rows.map(|row| row.unwrap().into_columns());
    all.collect()
}

#[track_caller]
fn cell<'a>(row: &'a [(String, Field)], name: &str) -> &'a Field {
    &row.iter().find(|(column, _)| column == name).unwrap_or_else(|| panic!("no {name}")).1
}

#[test]
fn a_row_holds_the_bits_of_the_sample_run_alone() {
    let (mission, outcome) = &*FLOWN;
    let rows = rows(&samples_parquet(outcome).unwrap());
    assert_eq!(rows.len() as u64, 2 * SAMPLES);
    let (mut values, mut nulls) = (0, 0);
    for sample in [0, 3, SAMPLES - 1] {
        let alone = run(&mission.sampled(SEED, sample), RunOptions::default(), &mut |_| {});
        for (k, case) in alone.cases.iter().enumerate() {
            let row =
                &rows[k * usize::try_from(SAMPLES).unwrap() + usize::try_from(sample).unwrap()];
            assert_eq!(cell(row, "sample"), &Field::Long(i64::try_from(sample).unwrap()));
            assert_eq!(cell(row, "passed"), &Field::Bool(case.passed));
            for verdict in &case.verdicts {
                let name = &verdict.requirement;
                assert_eq!(cell(row, &format!("holds {name}")), &Field::Bool(verdict.pass));
                match (cell(row, &format!("value {name}")), verdict.value) {
                    (Field::Double(found), Some(value)) => {
                        assert_eq!(found.to_bits(), value.to_bits(), "{name} of sample {sample}");
                        values += 1;
                    }
                    (Field::Null, None) => nulls += 1,
                    (found, value) => panic!("{name} of sample {sample}: {found:?}, {value:?}"),
                }
            }
        }
    }
    assert!(values > 4 && nulls > 0, "{values} values, {nulls} nulls");
}

#[test]
fn the_same_sweep_gives_the_same_bytes_and_says_what_it_is() {
    let (_, outcome) = &*FLOWN;
    let bytes = samples_parquet(outcome).unwrap();
    assert_eq!(bytes, samples_parquet(outcome).unwrap());
    let reader = reader(&bytes);
    let metadata = reader.metadata().file_metadata().key_value_metadata().unwrap().clone();
    let value = |key: &str| metadata.iter().find(|pair| pair.key == key).unwrap().value.clone();
    assert_eq!(value("seed").as_deref(), Some("5"));
    assert_eq!(value("samples").as_deref(), Some("12"));
    let drawn = rows(&samples_parquet(outcome).unwrap());
    let Field::Double(kg) = cell(&drawn[0], "drawn payload.module.mass_kg") else { panic!() };
    assert_eq!(*kg, outcome.cases[0].rows[0].deviations[0]);
    let Field::Double(flown) = cell(&drawn[0], "flown payload.module.mass_kg [kg]") else {
        panic!()
    };
    assert_eq!(*flown, 200.0 + kg);
}

#[test]
fn the_page_needs_nothing_from_elsewhere_and_draws_each_requirement() {
    let (_, outcome) = &*FLOWN;
    let html = sweep_html(outcome);
    for from_elsewhere in ["http://", "https://", "src=", "@import", "url("] {
        assert!(!html.contains(from_elsewhere), "{from_elsewhere}");
    }
    assert!(html.contains("default-src 'none'") && !html.contains("NaN"));
    assert!(html.contains("Tells &lt; from &gt; &amp; more."));
    // A case of which nobody comes to a value has nothing to draw.
    let with_values = outcome.cases.iter().flat_map(|c| &c.requirements);
    let drawn = with_values.filter(|r| r.values.is_some()).count();
    assert_eq!(html.matches("class=\"histogram\"").count(), drawn);
    assert!(html.contains("wrasse run quick.toml --sample"));
    let started = html.find("<main>").unwrap();
    let ended = html.find("</main>").unwrap() + "</main>".len();
    roxmltree::Document::parse(&html[started..ended]).expect("every tag is closed");
}

#[test]
fn tables_and_summary_say_how_many_pass_and_how_sure_that_is() {
    let (_, outcome) = &*FLOWN;
    let table = sweep_table(outcome);
    let still = &outcome.cases[0];
    assert!(table.contains(&format!("{} of 12 (", still.passed.passed)), "{table}");
    assert!(table.contains("with 95 % confidence") && table.contains("seed 5"), "{table}");
    assert!(table.contains("(infeasible); the first, sample"), "{table}");
    assert!(table.contains("payload.module.mass_kg") && table.contains("flown from"), "{table}");
    let html = sweep_html(outcome);
    assert!(html.contains("Flown from") && html.contains("Flown with"));
    let json = sweep_json(outcome, &Provenance::default());
    assert_eq!(json["cases"][0]["drawn"][0]["nominal"], 200.0);
    assert!(json["cases"][0]["requirements"][0]["worst"][0]["drawn"][0]["flown"].is_f64());
    assert_eq!(json["cases"][0]["passed"]["passed"], still.passed.passed);
    assert!(json["cases"][0]["requirements"][0]["values"]["p95"].is_f64());
    let place = tempfile::tempdir().unwrap();
    let written = write_sweep(outcome, &Provenance::default(), place.path(), true).unwrap();
    for file in [written.report, written.samples, written.summary] {
        assert!(std::fs::metadata(file).unwrap().len() > 1000);
    }
}
