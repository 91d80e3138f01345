//! Telemetry as a table: a row for each sample, a column for each channel.

use super::{Cells, Field, Kind, Table, Values, numbers};
use crate::error::RecordError;
use crate::wording::cases::case_name;
use std::borrow::Cow;
use std::collections::BTreeSet;
use wrasse_mission::Outcome;
use wrasse_rehearsal::{CaseOutcome, Channel};

/// The bytes of `telemetry.parquet`.
///
/// Columns: `case` and `phase` (text), `time_s`, then every channel under its own name, in the order in
/// which the cases bring them; null where a case has no such channel, or where there is no value. The first
/// row of a case is its start. One row group for each case. Each column carries its unit and meaning as
/// metadata of its own, the table `mission`, `version`, `seed`, `vehicle`. The same outcome gives the same
/// bytes.
///
/// # Errors
/// Channels that are not as long as their time base, or that share a name.
pub fn telemetry_parquet(outcome: &Outcome) -> Result<Vec<u8>, RecordError> {
    table(outcome)?.parquet()
}

/// The same as CSV, with the units in the head.
///
/// # Errors
/// Channels that are not as long as their time base, or that share a name.
pub fn telemetry_csv(outcome: &Outcome) -> Result<Vec<u8>, RecordError> {
    table(outcome)?.csv()
}

/// Columns in front of the channels.
const FIRST: usize = 3;

fn table(outcome: &Outcome) -> Result<Table<'_, &CaseOutcome>, RecordError> {
    outcome.cases.iter().try_for_each(check)?;
    let channels = channels(outcome);
    let mut fields = vec![
        Field::new("case", Kind::Text, "", "the case of a comparison").repeating(),
        Field::new("phase", Kind::Text, "", "the phase; empty once all are done").repeating(),
        Field::new("time_s", Kind::Number, "s", "mission time"),
    ];
    let of = |c: &&Channel| Field::new(&c.name, Kind::Number, &c.unit, &c.meaning).with_nulls();
    fields.extend(channels.iter().map(of));
    let flown = outcome.cases.iter().filter(|case| !case.telemetry.time.is_empty());
    Ok(Table {
        name: "telemetry",
        fields,
        metadata: metadata(outcome),
        groups: flown.collect(),
        cells: Box::new(move |case, field| match field {
            0 => Cells::all(Values::Text(vec![case_name(case); case.telemetry.time.len()])),
            1 => Cells::all(Values::Text(case.telemetry.phase.clone())),
            2 => Cells::all(Values::Numbers(Cow::Borrowed(&case.telemetry.time))),
            _ => samples(case, channels[field - FIRST]),
        }),
    })
}

/// The samples of a channel in a case; nulls where it has no such channel, or no value.
fn samples<'a>(case: &'a CaseOutcome, wanted: &Channel) -> Cells<'a> {
    let found = case.telemetry.channels.iter().find(|channel| channel.name == wanted.name);
    match found {
        None => Cells { there: numbers(vec![]), levels: Some(vec![0; case.telemetry.time.len()]) },
        Some(channel) => {
            let value = |x: &f64| (!x.is_nan()).then_some(*x);
            Cells::some(channel.values.iter().map(value), numbers)
        }
    }
}

/// Every channel has a value for each sample and a name of its own.
fn check(case: &CaseOutcome) -> Result<(), RecordError> {
    let mut names = BTreeSet::from(["case", "phase", "time_s"]);
    for channel in &case.telemetry.channels {
        let named = || (case_name(case), channel.name.clone());
        if !names.insert(&channel.name) {
            let (case, channel) = named();
            return Err(RecordError::ChannelTwice { case, channel });
        }
        let (found, expected) = (channel.values.len(), case.telemetry.time.len());
        if found != expected {
            let (case, channel) = named();
            return Err(RecordError::ChannelLength { case, channel, found, expected });
        }
    }
    Ok(())
}

/// The channels of all cases, each name once, in order of first appearance.
fn channels(outcome: &Outcome) -> Vec<&Channel> {
    let mut seen = BTreeSet::new();
    let channels = outcome.cases.iter().flat_map(|case| &case.telemetry.channels);
    channels.filter(|channel| seen.insert(channel.name.as_str())).collect()
}

fn metadata(outcome: &Outcome) -> Vec<(String, String)> {
    let pairs = [
        ("mission", outcome.mission.clone()),
        ("version", outcome.version.clone()),
        ("seed", outcome.seed.to_string()),
        ("vehicle", outcome.vehicle.name.clone()),
    ];
    pairs.map(|(key, value)| (key.to_owned(), value)).into()
}
