//! Time histories for the page's plots, with the limits on them: thinned so that the page stays
//! small, as JSON.

use data_encoding::BASE64;
use serde_json::{Value, json};
use wrasse_rehearsal::{CaseOutcome, Channel, Telemetry};

use super::case::EVENTS;
use super::limits::limits;
use crate::wording::cases::case_name;

/// Numbers that one page carries. Each takes 16/3 characters, so this is about 2.2 MB.
pub(super) const NUMBERS: usize = 420_000;
/// Most samples of one line: more than a screen has columns.
const MOST_SAMPLES: usize = 3000;
/// With fewer samples than this a line says little; rather fewer cases are drawn then.
pub(super) const FEWEST_SAMPLES: usize = 100;

/// How many numbers a sample of this case's plots holds: its channels, and a time for each plot.
pub(super) fn numbers_per_sample(case: &CaseOutcome) -> usize {
    let drawn = case.telemetry.channels.iter().filter(|channel| !channel.plot.is_empty());
    drawn.count() + plot_names(&case.telemetry).len()
}

/// What the page's script draws: for each case its events and plots, values in base64.
pub(super) fn histories(cases: &[CaseOutcome]) -> Value {
    let per_sample: usize = cases.iter().map(numbers_per_sample).sum();
    let most = (NUMBERS / per_sample.max(1)).clamp(2, MOST_SAMPLES);
    Value::Array(cases.iter().map(|case| case_data(case, most)).collect())
}

fn case_data(case: &CaseOutcome, most: usize) -> Value {
    let events: Vec<_> = case.events.iter().take(EVENTS).map(|event| event.time_s).collect();
    let names = plot_names(&case.telemetry);
    let plots: Vec<_> = names.iter().map(|name| plot(case, name, most)).collect();
    json!({ "name": case_name(case), "events": events, "plots": plots })
}

/// The plots in the order in which the channels name them.
fn plot_names(telemetry: &Telemetry) -> Vec<&str> {
    let mut names: Vec<&str> = Vec::new();
    for channel in &telemetry.channels {
        if !channel.plot.is_empty() && !names.contains(&channel.plot.as_str()) {
            names.push(&channel.plot);
        }
    }
    names
}

fn plot(case: &CaseOutcome, name: &str, most: usize) -> Value {
    let telemetry = &case.telemetry;
    let channels: Vec<&Channel> = telemetry.channels.iter().filter(|c| c.plot == name).collect();
    let kept = kept_samples(telemetry.time.len(), &channels, most);
    let lines: Vec<_> = channels
        .iter()
        .map(|channel| {
            json!({
                "name": channel.name,
                "label": channel.label,
                "unit": channel.unit,
                "values": singles(&kept, &channel.values),
            })
        })
        .collect();
    json!({
        "title": name,
        "samples": telemetry.time.len(),
        "drawn": kept.len(),
        "time": singles(&kept, &telemetry.time),
        "lines": lines,
        "limits": limits(case, &channels),
    })
}

/// Which of `count` samples are drawn: all, or the first, the last, and of each of the equal
/// stretches between them the one that stands out most, so that a short peak is not lost.
fn kept_samples(count: usize, channels: &[&Channel], most: usize) -> Vec<usize> {
    if count <= most {
        return (0..count).collect();
    }
    let spans: Vec<f64> = channels.iter().map(|channel| span(&channel.values)).collect();
    let (inner, stretches) = (count - 2, most - 2);
    let mut kept = vec![0];
    for k in 0..stretches {
        let start = 1 + k * inner / stretches;
        let end = 1 + (k + 1) * inner / stretches;
        let mut best = (start, 0.0);
        for sample in start..end {
            let out = standing_out(channels, &spans, [start - 1, sample, end]);
            if out > best.1 {
                best = (sample, out);
            }
        }
        kept.push(best.0);
    }
    kept.push(count - 1);
    kept
}

/// How far the middle sample is from the line through the outer ones, in shares of each span.
fn standing_out(channels: &[&Channel], spans: &[f64], [from, at, to]: [usize; 3]) -> f64 {
    let share = (at - from) as f64 / (to - from) as f64;
    let deviation = |(channel, span): (&&Channel, &f64)| {
        let value = |sample: usize| channel.values.get(sample).copied().unwrap_or(f64::NAN);
        let line = value(from) + share * (value(to) - value(from));
        ((value(at) - line) / span).abs()
    };
    channels.iter().zip(spans).map(deviation).filter(|d| d.is_finite()).fold(0.0, f64::max)
}

fn span(values: &[f64]) -> f64 {
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    high - low
}

/// The kept values as 32-bit floats, little-endian, in base64: half the size of decimal text.
fn singles(kept: &[usize], values: &[f64]) -> String {
    #[allow(clippy::cast_possible_truncation, reason = "a plot needs no more than 7 digits")]
    let single = |sample: &usize| values.get(*sample).map_or(f32::NAN, |value| *value as f32);
    let bytes: Vec<u8> = kept.iter().flat_map(|sample| single(sample).to_le_bytes()).collect();
    BASE64.encode(&bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thinning_keeps_the_ends_and_a_peak_one_sample_long() {
        let mut values: Vec<f64> = (0..10_000).map(|k| 0.01 * f64::from(k)).collect();
        values[7_777] = 500.0;
        let channel = Channel {
            name: "peak".into(),
            unit: "N·m".into(),
            meaning: "torque".into(),
            plot: "plot".into(),
            label: "peak".into(),
            values,
        };
        let kept = kept_samples(10_000, &[&channel], 200);
        assert_eq!(kept.len(), 200);
        assert!(kept.is_sorted() && kept.windows(2).all(|pair| pair[0] < pair[1]));
        assert_eq!((kept[0], kept[199]), (0, 9_999));
        assert!(kept.contains(&7_777));
    }
}
