//! Times as the benchmarks and the peers left them.

use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// Time of a call (ns).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Timing {
    pub(crate) minimum: f64,
    pub(crate) median: f64,
}

/// By vehicle and quantity, then by the way it was worked out.
type Timings = BTreeMap<(String, String), BTreeMap<String, Timing>>;

/// What lies in criterion's folder: `VEHICLE/QUANTITY.WAY/new/sample.json`.
pub(crate) fn of_criterion(folder: &Path) -> Result<Timings, String> {
    let mut timings = Timings::new();
    for vehicle in folders(folder)? {
        for each in folders(&vehicle)? {
            let sample = each.join("new/sample.json");
            let Ok(text) = fs::read_to_string(&sample) else { continue };
            let timing = of_sample(&text).ok_or(format!("{}: no samples", sample.display()))?;
            let name = name(&each);
            let (quantity, way) = name.split_once('.').unwrap_or((&name, "single"));
            let key = (self::name(&vehicle), quantity.to_owned());
            timings.entry(key).or_default().insert(way.to_owned(), timing);
        }
    }
    Ok(timings)
}

/// A sample is a list of times (ns) and a list of how many calls each of them took.
fn of_sample(text: &str) -> Option<Timing> {
    let sample: Value = serde_json::from_str(text).ok()?;
    let list = |name: &str| -> Option<Vec<f64>> {
        sample.get(name)?.as_array()?.iter().map(Value::as_f64).collect()
    };
    let (times, calls) = (list("times")?, list("iters")?);
    let mut each: Vec<f64> = times.iter().zip(calls).map(|(time, calls)| time / calls).collect();
    each.sort_by(f64::total_cmp);
    Some(Timing { minimum: *each.first()?, median: *each.get(each.len() / 2)? })
}

/// Lines of JSON; where a peer has several conventions the faster one counts.
pub(crate) fn of_peers(text: &str, timings: &mut Timings) -> Result<(), String> {
    for line in text.lines() {
        let row: Value = serde_json::from_str(line).map_err(|why| format!("{line}: {why}"))?;
        let word = |name: &str| row[name].as_str().map(str::to_owned);
        let number = |name: &str| row[name].as_f64();
        let read = || {
            let timing = Timing { minimum: number("minimum_ns")?, median: number("median_ns")? };
            Some((word("peer")?, (word("vehicle")?, word("quantity")?), timing))
        };
        let (peer, key, timing) = read().ok_or(format!("{line}: not a timing"))?;
        let ways = timings.entry(key).or_default();
        let slower = ways.get(&peer).is_some_and(|known| known.minimum <= timing.minimum);
        if !slower {
            ways.insert(peer, timing);
        }
    }
    Ok(())
}

fn folders(of: &Path) -> Result<Vec<PathBuf>, String> {
    let entries = fs::read_dir(of).map_err(|why| format!("{}: {why}", of.display()))?;
    let mut all: Vec<PathBuf> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
    all.retain(|path| path.is_dir() && !path.ends_with("report"));
    all.sort();
    Ok(all)
}

fn name(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sample_is_times_over_calls() {
        let found = of_sample(r#"{"times": [20.0, 90.0, 40.0], "iters": [2.0, 3.0, 2.0]}"#);
        assert_eq!(found, Some(Timing { minimum: 10.0, median: 20.0 }));
        assert_eq!(of_sample(r#"{"times": []}"#), None);
    }

    #[test]
    fn of_two_conventions_the_faster_one_counts() {
        let line = |ns: f64| {
            format!(
                "{{\"peer\":\"P\",\"vehicle\":\"v\",\"quantity\":\"q\",\"minimum_ns\":{ns},\"median_ns\":{ns}}}\n"
            )
        };
        let mut timings = Timings::new();
        of_peers(&(line(3.0) + &line(2.0) + &line(4.0)), &mut timings).expect("three timings");
        assert_eq!(timings[&("v".to_owned(), "q".to_owned())]["P"].minimum, 2.0);
    }
}
