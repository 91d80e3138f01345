//! Telemetry as Parquet: a row for each sample, a column for each channel.

use std::borrow::Cow;
use std::collections::BTreeSet;

use parquet::basic::Type as Physical;
use wrasse_mission::Outcome;
use wrasse_rehearsal::{CaseOutcome, Channel};

use super::{Cells, Field, Values, file, texts};
use crate::error::RecordError;
use crate::wording::cases::case_name;

/// The bytes of `telemetry.parquet`.
///
/// Columns: `case` (text), `time_s` (s), then every channel under its own name, in the order in
/// which the cases bring them; a case without a channel has nulls there. One row group for each
/// case. Key-value metadata: `mission`, `version`, `seed`, `vehicle`, and `unit:NAME` for each
/// column of numbers. The same outcome gives the same bytes.
///
/// # Errors
/// Channels that are not as long as their time base, or that share a name.
pub fn telemetry_parquet(outcome: &Outcome) -> Result<Vec<u8>, RecordError> {
    for case in &outcome.cases {
        check(case)?;
    }
    let channels = channels(outcome);
    let mut fields = vec![
        Field::new("case", Physical::BYTE_ARRAY).repeating(),
        Field::new("time_s", Physical::DOUBLE),
    ];
    let of = |channel: &&Channel| Field::new(&channel.name, Physical::DOUBLE).with_nulls();
    fields.extend(channels.iter().map(of));
    let flown = outcome.cases.iter().filter(|case| !case.telemetry.time.is_empty());
    file("telemetry", &fields, metadata(outcome, &channels), flown, |case, field| match field {
        0 => Cells::all(texts(vec![case_name(case); case.telemetry.time.len()])),
        1 => Cells::all(Values::Numbers(Cow::Borrowed(&case.telemetry.time))),
        _ => samples(case, channels[field - 2]),
    })
}

/// The samples of a channel in a case; nulls where it has no such channel.
fn samples<'a>(case: &'a CaseOutcome, wanted: &Channel) -> Cells<'a> {
    let found = case.telemetry.channels.iter().find(|channel| channel.name == wanted.name);
    Cells {
        there: Values::Numbers(Cow::Borrowed(found.map_or(&[], |channel| &channel.values))),
        levels: Some(vec![i16::from(found.is_some()); case.telemetry.time.len()]),
    }
}

/// Every channel has a value for each sample and a name of its own.
fn check(case: &CaseOutcome) -> Result<(), RecordError> {
    let mut names = BTreeSet::from(["case", "time_s"]);
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

fn metadata(outcome: &Outcome, channels: &[&Channel]) -> Vec<(String, String)> {
    let mut pairs = vec![
        ("mission".to_owned(), outcome.mission.clone()),
        ("version".to_owned(), outcome.version.clone()),
        ("seed".to_owned(), outcome.seed.to_string()),
        ("vehicle".to_owned(), outcome.vehicle.name.clone()),
        ("unit:time_s".to_owned(), "s".to_owned()),
    ];
    pairs.extend(channels.iter().map(|c| (format!("unit:{}", c.name), c.unit.clone())));
    pairs
}
