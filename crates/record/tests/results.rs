//! The three files: all or none, and the same bytes each time.
#![allow(clippy::unwrap_used, reason = "a test that finds nothing to unwrap has failed")]

mod sample;

use std::fs;
use std::path::Path;

use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;
use wrasse_mission::Outcome;
use wrasse_record::{
    Provenance, RecordError, summary_json, telemetry_csv, telemetry_parquet, write_results,
};

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
    let written = write_results(&sample::single(), &Provenance::default(), &dir, false).unwrap();
    assert_eq!(names_in(&dir), ["report.html", "summary.json", "telemetry.parquet"]);
    let summary = fs::read_to_string(written.summary).unwrap();
    let summary: serde_json::Value = serde_json::from_str(&summary).unwrap();
    assert_eq!(summary["mission"], "atlas-reach");
}

#[test]
fn two_runs_of_one_outcome_write_the_same_bytes() {
    let [one, two] = [(); 2].map(|()| tempfile::tempdir().unwrap());
    write_results(&sample::compared(), &Provenance::default(), one.path(), false).unwrap();
    write_results(&sample::compared(), &Provenance::default(), two.path(), false).unwrap();
    for name in names_in(one.path()) {
        let [a, b] = [&one, &two].map(|dir| fs::read(dir.path().join(&name)).unwrap());
        assert!(a == b, "{name} differs");
    }
}

#[test]
fn a_new_result_replaces_the_old_one_and_leaves_other_files_alone() {
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join("notes.txt"), "mine").unwrap();
    write_results(&sample::single(), &Provenance::default(), dir.path(), false).unwrap();
    let written =
        write_results(&sample::compared(), &Provenance::default(), dir.path(), false).unwrap();
    assert!(fs::read_to_string(&written.summary).unwrap().contains("miss-distance"));
    assert_eq!(
        names_in(dir.path()),
        ["notes.txt", "report.html", "summary.json", "telemetry.parquet"]
    );
}

#[test]
fn a_result_that_cannot_be_encoded_leaves_the_old_one() {
    let dir = tempfile::tempdir().unwrap();
    let written =
        write_results(&sample::single(), &Provenance::default(), dir.path(), false).unwrap();
    let before = fs::read(&written.telemetry).unwrap();
    let mut broken = sample::compared();
    broken.cases[0].telemetry.channels[0].values.pop();
    let error = write_results(&broken, &Provenance::default(), dir.path(), false).unwrap_err();
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
    let written =
        write_results(&sample::single(), &Provenance::default(), dir.path(), false).unwrap();
    let before = fs::read(&written.summary).unwrap();
    fs::remove_file(&written.telemetry).unwrap();
    fs::create_dir(&written.telemetry).unwrap();
    let error =
        write_results(&sample::compared(), &Provenance::default(), dir.path(), false).unwrap_err();
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
    let error = write_results(&sample::single(), &Provenance::default(), &file, false).unwrap_err();
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
    assert_eq!(names[..4], ["case", "phase", "time_s", "tool.error.x"]);
    assert_eq!(names.len(), 3 + telemetry.channels.len());
    for pair in [("mission", "atlas-reach"), ("seed", "7")] {
        assert!(metadata.contains(&(pair.0.to_owned(), pair.1.to_owned())), "{pair:?}");
    }
    assert_eq!(rows.len(), telemetry.time.len());
    for (sample, row) in rows.iter().enumerate() {
        assert_eq!(row[..2], [Field::Str("run".into()), Field::Str("move".into())]);
        let mut wanted = vec![telemetry.time[sample]];
        wanted.extend(telemetry.channels.iter().map(|channel| channel.values[sample]));
        for (field, wanted) in row[2..].iter().zip(wanted) {
            // What is not there is null.
            let value = match field {
                Field::Double(value) => *value,
                Field::Null => f64::NAN,
                other => panic!("{other} is no number"),
            };
            assert_eq!(value.to_bits(), wanted.to_bits());
        }
    }
}

/// A table of a flat buffer, read as its format says: its fields by an index behind it.
#[derive(Clone, Copy)]
struct Flat<'b> {
    bytes: &'b [u8],
    at: usize,
}

impl<'b> Flat<'b> {
    fn number(self, at: usize) -> usize {
        u32::from_le_bytes(self.bytes[at..at + 4].try_into().unwrap()) as usize
    }
    /// Place of a field.
    fn field(self, number: usize) -> usize {
        let back = i32::from_le_bytes(self.bytes[self.at..self.at + 4].try_into().unwrap());
        let index = self.at.checked_add_signed(-back as isize).unwrap() + 4 + 2 * number;
        self.at + usize::from(u16::from_le_bytes(self.bytes[index..index + 2].try_into().unwrap()))
    }
    fn follow(self, at: usize) -> Self {
        Self { at: at + self.number(at), ..self }
    }
    fn text(self, number: usize) -> &'b str {
        let text = self.follow(self.field(number));
        let from = text.at + 4;
        std::str::from_utf8(&self.bytes[from..from + text.number(text.at)]).unwrap()
    }
    fn tables(self, number: usize) -> Vec<Self> {
        let list = self.follow(self.field(number));
        (0..list.number(list.at)).map(|k| list.follow(list.at + 4 + 4 * k)).collect()
    }
}

/// Read by hand as the format says; pyarrow 26, polars and `DuckDB` read the same.
#[test]
fn each_column_carries_its_unit_and_meaning() {
    let outcome = sample::single();
    let ReadBack { names, metadata, .. } = read_back(&outcome);
    let (_, text) = metadata.iter().find(|(key, _)| key == "ARROW:schema").expect("a schema");
    let message = data_encoding::BASE64.decode(text.as_bytes()).unwrap();
    assert_eq!(message[..4], [0xff; 4]);
    let body = Flat { bytes: &message[8..], at: 0 };
    assert_eq!(u32::from_le_bytes(message[4..8].try_into().unwrap()) as usize, body.bytes.len());
    let message = body.follow(0);
    let version = message.field(0);
    assert_eq!(body.bytes[version..version + 2], [4, 0]);
    let fields = message.follow(message.field(2)).tables(1);
    let named: Vec<_> = fields.iter().map(|field| field.text(0)).collect();
    assert_eq!(named, names);
    let channel = outcome.cases[0].telemetry.channels.last().unwrap();
    let told: Vec<_> =
        fields.last().unwrap().tables(6).iter().map(|pair| (pair.text(0), pair.text(1))).collect();
    assert_eq!(told, [("unit", &*channel.unit), ("meaning", &*channel.meaning)]);
}

#[test]
fn telemetry_as_csv_has_the_same_numbers() {
    let mut outcome = sample::compared();
    outcome.cases[1].telemetry.channels.remove(0);
    outcome.cases[0].telemetry.channels[0].values[1] = f64::NAN;
    let text = String::from_utf8(telemetry_csv(&outcome).unwrap()).unwrap();
    let mut lines = text.lines();
    let head = lines.next().unwrap();
    assert!(head.starts_with("case,phase,time_s [s],tool.error.x [m],"), "{head}");
    assert_eq!(lines.clone().count(), read_back(&outcome).rows.len());
    let telemetry = &outcome.cases[0].telemetry;
    let first = lines.next().unwrap().rsplit(',').next().unwrap();
    let value: f64 = first.parse().unwrap();
    assert_eq!(value.to_bits(), telemetry.channels.last().unwrap().values[0].to_bits());
    let second = lines.next().unwrap();
    assert!(second.contains(&format!("move,{},,", telemetry.time[1])), "{second}");
}

#[test]
fn a_case_without_a_channel_has_nulls_there_and_one_without_samples_no_rows() {
    let mut outcome = sample::compared();
    outcome.cases[1].telemetry.channels.remove(0);
    let ReadBack { names, rows, .. } = read_back(&outcome);
    assert_eq!(names.iter().position(|name| name == "tool.error.x"), Some(3));
    // Nine cases, one of which never flew.
    assert_eq!(rows.len(), 8 * 2401);
    let of_case = |name: &str| {
        rows.iter().filter(|row| row[0] == Field::Str(name.into())).collect::<Vec<_>>()
    };
    assert!(of_case("law=terrestrial, load=200 kg").iter().all(|row| row[3] == Field::Null));
    assert!(of_case("law=terrestrial, load=unladen").iter().all(|row| row[3] != Field::Null));
}

#[test]
fn the_summary_says_null_where_a_number_is_not_finite_and_keeps_its_order() {
    let summary = summary_json(&sample::single(), &Provenance::default());
    let keys: Vec<_> = summary.as_object().unwrap().keys().map(String::as_str).collect();
    assert_eq!(keys[..5], ["format", "passed", "mission", "summary", "mission_file"]);
    let case = &summary["cases"][0];
    assert_eq!(case["end"]["kind"], "completed");
    let metrics = case["metrics"].as_array().unwrap();
    assert!(metrics.iter().any(|m| m["name"] == "broken" && m["value"].is_null()));
    assert_eq!(summary["passed"], true);
    assert_eq!(summary_json(&sample::compared(), &Provenance::default())["passed"], false);
}
