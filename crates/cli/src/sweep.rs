//! `wrasse sweep`: many samples of a mission of which not everything is known exactly.

use crate::input::Failure;
use crate::interrupt::at_interrupt;
use crate::progress::Bar;
use crate::results::{hand_over, provenance, results_folder};
use crate::run::mission_of;
use crate::settings::Settings;
use crate::{YES, no, threads};
use clap::{Args, value_parser};
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use wrasse_record::{sweep_json, sweep_table, write_sweep};
use wrasse_sweep::{OwnedFolder, SweepError, SweepOutcome, sweep};

/// Fly many samples of a mission: how often it succeeds, how its values spread, which samples are worst.
///
/// What each sample draws stands in the mission file, in tables named disperse; see missions/sweeps. Writes
/// report.html, samples.parquet and summary.json to out/NAME-sweep, and keeps what is flown in its folder
/// `parts` on the way: interrupted, the same command goes on from there; with more samples it begins with
/// those. `wrasse run MISSION --sample K` flies one of them again, to the same bits, with a full report.
/// Exit code 0: the sweep was flown, and --pass-rate is reached if it was asked for; 1: it is not; 2: bad
/// input.
#[derive(Debug, Args)]
#[command(
    after_help = "Example:\n  wrasse sweep missions/sweeps/module-reach.toml --samples 200 --pass-rate 0.95"
)]
pub(crate) struct Sweep {
    /// The mission file; `-` is standard input.
    mission: PathBuf,
    #[command(flatten)]
    settings: Settings,
    /// Samples of each case.
    #[arg(long, value_name = "N", default_value = "1000", value_parser = value_parser!(u64).range(1..=MOST))]
    samples: u64,
    /// Seed of all draws, in place of the mission's.
    #[arg(long, value_name = "S")]
    seed: Option<u64>,
    /// Samples flown at a time; as many as the machine has processors if not given. The results are the
    /// same for any number.
    #[arg(long, value_name = "T")]
    threads: Option<NonZeroUsize>,
    /// Share of passing samples (0 to 1) that the lower end of the confidence interval must reach in each
    /// case; else the exit code is 1.
    #[arg(long, value_name = "SHARE", value_parser = share)]
    pass_rate: Option<f64>,
    /// Folder for the results, in place of out/NAME-sweep.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Write the samples as CSV too.
    #[arg(long)]
    csv: bool,
    /// Print the summary as JSON in place of the tables.
    #[arg(long)]
    json: bool,
}

/// Most samples: their rows are kept in memory.
const MOST: u64 = 10_000_000;

/// A share from 0 to 1.
fn share(text: &str) -> Result<f64, String> {
    let found = text.parse::<f64>().ok().filter(|x| (0.0..=1.0).contains(x));
    found.ok_or_else(|| "a share is a number from 0 to 1, such as 0.99".into())
}

impl Sweep {
    pub(crate) fn go(&self) -> Result<ExitCode, Failure> {
        let mission = mission_of(&self.mission, &self.settings)?;
        let folder = results_folder(self.out.as_deref(), &format!("{}-sweep", mission.name))?;
        let asked = wrasse_sweep::Sweep {
            mission: &mission,
            samples: self.samples,
            seed: self.seed.unwrap_or(mission.seed),
            threads: threads(self.threads),
        };
        asked.check()?;
        let parts = folder.join("parts");
        // It stays owned until the results are written: nobody else's come between.
        let owned = OwnedFolder::take(&parts)?;
        let outcome = fly(&asked, &owned, &parts)?;
        let whence = provenance(&mission);
        let report = write_sweep(&outcome, &whence, &folder, self.csv).map(|files| files.report);
        let summary = || sweep_json(&outcome, &whence);
        hand_over(report, self.json, summary, || sweep_table(&outcome))?;
        let wanted = self.pass_rate.unwrap_or(0.0);
        let reached = outcome.cases.iter().all(|case| case.passed.sure >= wanted);
        Ok(if reached { YES } else { no() })
    }
}

/// The flights, with a bar, and a word at Ctrl-C on how many are kept.
fn fly(
    asked: &wrasse_sweep::Sweep<'_>,
    owned: &OwnedFolder,
    parts: &Path,
) -> Result<SweepOutcome, SweepError> {
    let bar = Bar::new();
    let kept = Arc::new(AtomicU64::new(0));
    let (counted, place) = (Arc::clone(&kept), parts.display().to_string());
    at_interrupt(move || {
        let flights = counted.load(Ordering::Relaxed);
        format!("{flights} flights are kept in {place}; the same command goes on from there")
    });
    let outcome = sweep(asked, owned, &mut |done, of| {
        kept.store(done, Ordering::Relaxed);
        bar.count(done, of);
    });
    bar.done();
    outcome
}

impl From<SweepError> for Failure {
    fn from(error: SweepError) -> Self {
        Self::Sentence(error.to_string())
    }
}
