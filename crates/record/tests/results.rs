//! The three files: all or none, and the same bytes each time.
#![allow(clippy::unwrap_used, reason = "a test that finds nothing to unwrap has failed")]

mod sample;

use std::fs;
use std::path::Path;

use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;
use wrasse_mission::Outcome;
use wrasse_record::{RecordError, summary_json, telemetry_parquet, write_results};

fn names_in(dir: &Path) -> Vec<String> {
    let mut names: Vec<_> = fs::read_dir(dir)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

#[test]
fn the_three_files_are_there_and_nothing_else() {
    let place = tempfile::tempdir().unwrap();
    let dir = place.path().join("out/atlas-reach");
    let written = write_results(&sample::single(), &dir).unwrap();
    assert_eq!(names_in(&dir), ["report.html", "summary.json", "telemetry.parquet"]);
    let summary = fs::read_to_string(written.summary).unwrap();
    let summary: serde_json::Value = serde_json::from_str(&summary).unwrap();
    assert_eq!(summary["mission"], "atlas-reach");
}

#[test]
fn two_runs_of_one_outcome_write_the_same_bytes() {
    let [one, two] = [(); 2].map(|()| tempfile::tempdir().unwrap());
    write_results(&sample::compared(), one.path()).unwrap();
    write_results(&sample::compared(), two.path()).unwrap();
    for name in names_in(one.path()) {
        let [a, b] = [&one, &two].map(|dir| fs::read(dir.path().join(&name)).unwrap());
        assert!(a == b, "{name} differs");
    }
}

#[test]
fn a_new_result_replaces_the_old_one_and_leaves_other_files_alone() {
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join("notes.txt"), "mine").unwrap();
    write_results(&sample::single(), dir.path()).unwrap();
    let written = write_results(&sample::compared(), dir.path()).unwrap();
    assert!(fs::read_to_string(&written.summary).unwrap().contains("miss-distance"));
    assert_eq!(
        names_in(dir.path()),
        ["notes.txt", "report.html", "summary.json", "telemetry.parquet"]
    );
}

#[test]
fn a_result_that_cannot_be_encoded_leaves_the_old_one() {
    let dir = tempfile::tempdir().unwrap();
    let written = write_results(&sample::single(), dir.path()).unwrap();
    let before = fs::read(&written.telemetry).unwrap();
    let mut broken = sample::compared();
    broken.cases[0].telemetry.channels[0].values.pop();
    let error = write_results(&broken, dir.path()).unwrap_err();
    assert_eq!(
        error.to_string(),
        "channel tool.error.x of case \"law=terrestrial, load=unladen\" has 2400 values, \
         expected 2401: one for each sample time"
    );
    assert_eq!(fs::read(&written.telemetry).unwrap(), before);
    assert_eq!(names_in(dir.path()).len(), 3);
}

#[test]
fn a_result_that_cannot_be_put_in_place_leaves_what_was_there() {
    let dir = tempfile::tempdir().unwrap();
    let written = write_results(&sample::single(), dir.path()).unwrap();
    let before = fs::read(&written.summary).unwrap();
    fs::remove_file(&written.telemetry).unwrap();
    fs::create_dir(&written.telemetry).unwrap();
    let error = write_results(&sample::compared(), dir.path()).unwrap_err();
    assert!(error.to_string().contains("cannot replace"), "{error}");
    assert_eq!(fs::read(&written.summary).unwrap(), before);
    assert!(written.telemetry.is_dir());
    assert_eq!(names_in(dir.path()).len(), 3);
}

#[test]
fn a_place_that_is_a_file_is_named_in_the_error() {
    let place = tempfile::tempdir().unwrap();
    let file = place.path().join("out");
    fs::write(&file, "a file").unwrap();
    let error = write_results(&sample::single(), &file).unwrap_err();
    let told = error.to_string();
    assert!(matches!(error, RecordError::File { .. }));
    assert!(told.contains(file.to_str().unwrap()) && told.contains("--out"), "{told}");
    assert_eq!(fs::read_to_string(&file).unwrap(), "a file");
}

#[test]
fn two_channels_of_one_name_are_refused_by_name() {
    let mut outcome = sample::single();
    outcome.cases[0].telemetry.channels[1].name = "time_s".into();
    let told = telemetry_parquet(&outcome).unwrap_err().to_string();
    assert!(told.contains("time_s"), "{told}");
}

/// What a telemetry file holds.
struct ReadBack {
    names: Vec<String>,
    metadata: Vec<(String, String)>,
    rows: Vec<Vec<Field>>,
}

fn read_back(outcome: &Outcome) -> ReadBack {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("telemetry.parquet");
    fs::write(&path, telemetry_parquet(outcome).unwrap()).unwrap();
    let reader = SerializedFileReader::new(fs::File::open(&path).unwrap()).unwrap();
    let file = reader.metadata().file_metadata();
    let names = file.schema_descr().columns().iter().map(|c| c.name().to_owned()).collect();
    let pairs = file.key_value_metadata().unwrap();
    let metadata = pairs.iter().map(|kv| (kv.key.clone(), kv.value.clone().unwrap())).collect();
    let rows = reader
        .get_row_iter(None)
        .unwrap()
        .map(|row| row.unwrap().get_column_iter().map(|(_, field)| field.clone()).collect())
        .collect();
    ReadBack { names, metadata, rows }
}

#[test]
fn telemetry_reads_back_bit_for_bit_with_its_units() {
    let mut outcome = sample::single();
    outcome.cases[0].telemetry.channels[0].values[5] = f64::NAN;
    let telemetry = &outcome.cases[0].telemetry;
    let ReadBack { names, metadata, rows } = read_back(&outcome);
    assert_eq!(names[..3], ["case", "time_s", "tool.error.x"]);
    assert_eq!(names.len(), 2 + telemetry.channels.len());
    for pair in [("mission", "atlas-reach"), ("seed", "7"), ("unit:energy.power", "W")] {
        assert!(metadata.contains(&(pair.0.to_owned(), pair.1.to_owned())), "{pair:?}");
    }
    assert_eq!(rows.len(), telemetry.time.len());
    for (sample, row) in rows.iter().enumerate() {
        assert_eq!(row[0], Field::Str("run".into()));
        let mut wanted = vec![telemetry.time[sample]];
        wanted.extend(telemetry.channels.iter().map(|channel| channel.values[sample]));
        for (field, wanted) in row[1..].iter().zip(wanted) {
            let Field::Double(value) = field else { panic!("{field} is no number") };
            assert_eq!(value.to_bits(), wanted.to_bits());
        }
    }
}

#[test]
fn a_case_without_a_channel_has_nulls_there_and_one_without_samples_no_rows() {
    let mut outcome = sample::compared();
    outcome.cases[1].telemetry.channels.remove(0);
    let ReadBack { names, rows, .. } = read_back(&outcome);
    assert_eq!(names.iter().position(|name| name == "tool.error.x"), Some(2));
    // Nine cases, one of which never flew.
    assert_eq!(rows.len(), 8 * 2401);
    let of_case = |name: &str| {
        rows.iter().filter(|row| row[0] == Field::Str(name.into())).collect::<Vec<_>>()
    };
    assert!(of_case("law=terrestrial, load=200 kg").iter().all(|row| row[2] == Field::Null));
    assert!(of_case("law=terrestrial, load=unladen").iter().all(|row| row[2] != Field::Null));
}

#[test]
fn the_summary_says_null_where_a_number_is_not_finite_and_keeps_its_order() {
    let summary = summary_json(&sample::single());
    let keys: Vec<_> = summary.as_object().unwrap().keys().map(String::as_str).collect();
    assert_eq!(keys[..5], ["format", "passed", "mission", "summary", "mission_file"]);
    let case = &summary["cases"][0];
    assert_eq!(case["end"]["kind"], "completed");
    let metrics = case["metrics"].as_array().unwrap();
    assert!(metrics.iter().any(|m| m["name"] == "broken" && m["value"].is_null()));
    assert_eq!(summary["passed"], true);
    assert_eq!(summary_json(&sample::compared())["passed"], false);
}
