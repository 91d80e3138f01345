//! Samples flown by several threads: the same bits for any number of them.

use crate::folder::OwnedFolder;
use crate::outcome::SweepOutcome;
use crate::parts::Parts;
use crate::row::Row;
use crate::summing_up::sum_up;
use crate::sweep_error::SweepError;
use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::channel;
use wrasse_mission::Mission;
use wrasse_rehearsal::{SamplePlan, fly_sample, plan_samples};

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

/// Stack of a thread that flies (bytes): that of the main thread on most systems, so a sample finds the same
/// room wherever it is flown. The system keeps it as addresses only until it is used.
const STACK: usize = 8 * 1024 * 1024;

/// Fly what is not yet done of a sweep, keeping in `folder` what is; `progress` is told how many flights
/// are done, of how many.
///
/// Where the system refuses a thread, those that there are fly all; where it refuses every one, this one
/// does.
///
/// # Errors
/// A mission that draws nothing; a folder that holds samples of another sweep, or damaged ones; a disk
/// that takes no more.
pub fn sweep(
    asked: &Sweep<'_>,
    folder: &OwnedFolder,
    progress: &mut dyn FnMut(u64, u64),
) -> Result<SweepOutcome, SweepError> {
    let count = asked.mission.cases.len();
    asked.check()?;
    folder.clear_up();
    let parts = Parts::open(folder, asked)?;
    let mut rows = parts.rows(asked)?;
    rows.retain(|(_, sample), _| *sample < asked.samples);
    let all = asked.samples * count as u64;
    progress(rows.len() as u64, all);
    let chunks = asked.chunks(&rows);
    let needed = |case: usize| chunks.iter().any(|chunk| chunk.case == case);
    let plans = (0..count)
        .map(|case| needed(case).then(|| plan_samples(&asked.mission.cases[case])))
        .collect();
    let work = Work { asked, plans, chunks, next: AtomicUsize::new(0), stack: STACK };
    work.fly_all(&mut |done| {
        parts.keep(&done)?;
        rows.extend(done.into_iter().map(|row| ((row.case, row.sample), row)));
        progress(rows.len() as u64, all);
        Ok(())
    })?;
    Ok(sum_up(asked, rows.into_values().collect()))
}

/// What is to be flown, and how far it is.
struct Work<'m> {
    asked: &'m Sweep<'m>,
    plans: Vec<Option<SamplePlan<'m>>>,
    chunks: Vec<Chunk>,
    /// Number of the next chunk that nobody has begun.
    next: AtomicUsize,
    /// Stack of each thread (bytes).
    stack: usize,
}

impl Work<'_> {
    /// Fly all chunks; `keep` is told of each as it is done.
    fn fly_all(
        &self,
        keep: &mut dyn FnMut(Vec<Row>) -> Result<(), SweepError>,
    ) -> Result<(), SweepError> {
        std::thread::scope(|scope| {
            let (tell, told) = channel();
            for _ in 0..self.asked.threads.clamp(1, self.chunks.len().max(1)) {
                let tell = tell.clone();
                let thread = std::thread::Builder::new().stack_size(self.stack);
                let begun = thread.spawn_scoped(scope, move || {
                    // Nobody listens any more once a part could not be kept.
                    while self.chunk().is_some_and(|rows| tell.send(rows).is_ok()) {}
                });
                if begun.is_err() {
                    break;
                }
            }
            drop(tell);
            for done in told {
                keep(done)?;
            }
            // Only where no thread could be begun is there anything left.
            while let Some(done) = self.chunk() {
                keep(done)?;
            }
            Ok(())
        })
    }

    /// Fly the next chunk, if there is one.
    fn chunk(&self) -> Option<Vec<Row>> {
        let chunk = self.chunks.get(self.next.fetch_add(1, Ordering::Relaxed))?;
        let plan = self.plans[chunk.case].as_ref()?;
        let flown = chunk.samples.clone().map(|sample| fly_sample(plan, self.asked.seed, sample));
        Some(flown.map(|outcome| Row::of(chunk.case, outcome)).collect())
    }
}

impl Sweep<'_> {
    /// Whether it makes sense at all, before anything is written.
    ///
    /// # Errors
    /// A mission that draws nothing in any of its cases.
    pub fn check(&self) -> Result<(), SweepError> {
        if (0..self.mission.cases.len()).any(|case| self.mission.cases[case].varies()) {
            return Ok(());
        }
        let (file, samples) = (self.mission.file.clone(), self.samples);
        Err(SweepError::NothingDrawn { file, samples })
    }

    /// What is not done, in pieces of which there are enough for all threads.
    fn chunks(&self, done: &BTreeMap<(usize, u64), Row>) -> Vec<Chunk> {
        let share = self.samples / (CHUNKS * self.threads.max(1) as u64);
        let size = (share / CHUNK.0 * CHUNK.0).clamp(CHUNK.0, CHUNK.1);
        let mut chunks: Vec<Chunk> = vec![];
        for case in 0..self.mission.cases.len() {
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

#[cfg(test)]
mod tests {
    use super::*;
    use wrasse_mission::read_mission;

    /// A thread whose stack is larger than all memory is refused by any system.
    #[cfg(target_pointer_width = "64")]
    #[test]
    fn where_every_thread_is_refused_this_one_flies_all_and_no_bit_is_different() {
        let text = "name = \"q\"\nvehicle = \"atlas-class\"\nrequirements = [\"energy.max <= 1 J\"]\n\
                    [initial]\nposture = \"sideways_300mm\"\n[world]\nbase_attitude = \"free\"\njoints = \
                    \"torque\"\n[[phase]]\nname = \"coast\"\nhold = { duration_s = 0.1, keep = \"nothing\" }\n\
                    [[disperse]]\nquantity = \"initial.joint_rates_deg_s\"\nsigma = 1.0\n";
        let mission = read_mission("q.toml", text).expect("a sound mission");
        let asked = Sweep { mission: &mission, samples: 20, seed: 5, threads: 4 };
        let flown = |stack| {
            let (plans, next) = (vec![Some(plan_samples(&mission.cases[0]))], AtomicUsize::new(0));
            let chunks = asked.chunks(&BTreeMap::new());
            let work = Work { asked: &asked, plans, chunks, next, stack };
            let mut rows = vec![];
            let kept = work.fly_all(&mut |done| {
                rows.extend(done);
                Ok(())
            });
            kept.expect("nothing is in the way");
            rows.sort_by_key(|row| row.sample);
            rows
        };
        let (with, without) = (flown(STACK), flown(1 << 60));
        assert_eq!(with.len(), 20);
        assert_eq!(with, without);
    }
}
