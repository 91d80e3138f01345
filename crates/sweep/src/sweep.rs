//! Samples flown by several threads: the same bits for any number of them.

use crate::outcome::SweepOutcome;
use crate::parts::{Parts, SweepError};
use crate::row::Row;
use crate::summing_up::sum_up;
use std::collections::BTreeMap;
use std::ops::Range;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Sender, channel};
use wrasse_mission::{Mission, SamplePlan, fly_sample, plan_samples};

/// What a sweep is asked to do.
#[derive(Debug, Clone, Copy)]
pub struct Sweep<'m> {
    /// The mission.
    pub mission: &'m Mission,
    /// Samples of each case.
    pub samples: u64,
    /// Seed of all draws.
    pub seed: u64,
    /// Samples flown at a time.
    pub threads: usize,
}

/// Some samples of a case that are not done yet.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Chunk {
    case: usize,
    samples: Range<u64>,
}

/// Least and most samples in a chunk. What is interrupted in one is flown again; fewer than these in a
/// file make many files.
const CHUNK: (u64, u64) = (8, 64);

/// Chunks for each thread, if there are samples enough: what an interruption costs is at most one of them.
const CHUNKS: u64 = 64;

/// Fly what is not yet done of a sweep, keeping in `folder` what is; `progress` is told how many flights
/// are done, of how many.
///
/// # Errors
/// A folder that cannot be used, that holds samples of another sweep, or damaged ones.
pub fn sweep(
    asked: &Sweep<'_>,
    folder: &Path,
    progress: &mut dyn FnMut(u64, u64),
) -> Result<SweepOutcome, SweepError> {
    let parts = Parts::open(folder, asked)?;
    let mut rows = parts.rows(asked)?;
    rows.retain(|(_, sample), _| *sample < asked.samples);
    let all = asked.samples * asked.mission.case_count() as u64;
    progress(rows.len() as u64, all);
    let chunks = asked.chunks(&rows);
    let needed = |case: usize| chunks.iter().any(|chunk| chunk.case == case);
    let cases = 0..asked.mission.case_count();
    let plans: Vec<Option<SamplePlan<'_>>> =
        cases.map(|case| needed(case).then(|| plan_samples(asked.mission, case))).collect();
    let next = AtomicUsize::new(0);
    std::thread::scope(|scope| {
        let (tell, told) = channel();
        for _ in 0..asked.threads.clamp(1, chunks.len().max(1)) {
            let (tell, plans, chunks, next) = (tell.clone(), &plans, &chunks, &next);
            scope.spawn(move || asked.fly(plans, chunks, next, &tell));
        }
        drop(tell);
        for done in told {
            parts.keep(&done)?;
            rows.extend(done.into_iter().map(|row| ((row.case, row.sample), row)));
            progress(rows.len() as u64, all);
        }
        Ok(())
    })?;
    Ok(sum_up(asked, rows.into_values().collect()))
}

impl Sweep<'_> {
    /// Fly chunks as long as there are any and somebody listens.
    fn fly(
        &self,
        plans: &[Option<SamplePlan<'_>>],
        chunks: &[Chunk],
        next: &AtomicUsize,
        tell: &Sender<Vec<Row>>,
    ) {
        while let Some(chunk) = chunks.get(next.fetch_add(1, Ordering::Relaxed)) {
            let Some(plan) = &plans[chunk.case] else { break };
            let flown = chunk.samples.clone().map(|sample| fly_sample(plan, self.seed, sample));
            let rows = flown.map(|outcome| Row::of(chunk.case, outcome)).collect();
            if tell.send(rows).is_err() {
                break;
            }
        }
    }

    /// What is not done, in pieces of which there are enough for all threads.
    fn chunks(&self, done: &BTreeMap<(usize, u64), Row>) -> Vec<Chunk> {
        let share = self.samples / (CHUNKS * self.threads.max(1) as u64);
        let size = (share / CHUNK.0 * CHUNK.0).clamp(CHUNK.0, CHUNK.1);
        let mut chunks: Vec<Chunk> = vec![];
        for case in 0..self.mission.case_count() {
            for sample in (0..self.samples).filter(|sample| !done.contains_key(&(case, *sample))) {
                match chunks.last_mut() {
                    Some(chunk)
                        if chunk.case == case
                            && chunk.samples.end == sample
                            && sample - chunk.samples.start < size =>
                    {
                        chunk.samples.end = sample + 1;
                    }
                    _ => chunks.push(Chunk { case, samples: sample..sample + 1 }),
                }
            }
        }
        chunks
    }

    /// What flies one sample again, with a full report.
    pub(crate) fn command(&self, sample: u64) -> String {
        let file = &self.mission.file;
        let plain = |c: char| c.is_ascii_alphanumeric() || "/._-+".contains(c);
        let file = if !file.is_empty() && file.chars().all(plain) {
            file.clone()
        } else {
            format!("'{}'", file.replace('\'', "'\\''"))
        };
        format!("wrasse run {file} --sample {sample} --seed {}", self.seed)
    }
}
