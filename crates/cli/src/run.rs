//! `wrasse run`: a mission, from its file to its verdict.

use crate::input::{Failure, complain};
use crate::interrupt::{at_interrupt, nothing_kept};
use crate::progress::Bar;
use crate::results::{hand_over, provenance, results_folder};
use crate::settings::Settings;
use crate::{YES, bad, no};
use clap::Args;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use wrasse_mission::{Mission, run};
use wrasse_record::{summary_json, verdict_table, write_results};
use wrasse_rehearsal::{End, RunOptions};

/// Fly a mission, judge its requirements, write the report.
///
/// Writes report.html, telemetry.parquet and summary.json to out/NAME (what they hold: the book, Results). Exit code 0: all requirements
/// hold; 1: one does not, or the planning found that the path is infeasible; 2: bad input, or a
/// number broke down.
#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  wrasse run missions/atlas-reach.toml\n  wrasse run reach.toml --set control.feedforward=none --out out/without"
)]
pub(crate) struct Run {
    /// The mission file; `-` is standard input.
    mission: PathBuf,
    #[command(flatten)]
    settings: Settings,
    /// Folder for the results, in place of out/NAME.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Write the telemetry as CSV too.
    #[arg(long)]
    csv: bool,
    /// Print the summary as JSON in place of the table.
    #[arg(long)]
    json: bool,
    /// Fly this sample of a sweep: with what it draws of what the mission disperses. The results go to
    /// out/NAME-sample-K.
    #[arg(long, value_name = "K")]
    sample: Option<u64>,
    /// Seed of the sweep, if not the mission's.
    #[arg(long, value_name = "S", requires = "sample")]
    seed: Option<u64>,
    /// Fly once more at half the step, and report what that changes.
    #[arg(long)]
    error_estimate: bool,
}

impl Run {
    pub(crate) fn go(&self) -> Result<ExitCode, Failure> {
        let mut mission = mission_of(&self.mission, &self.settings)?;
        let mut name = mission.name.clone();
        if let Some(sample) = self.sample {
            name = format!("{name}-sample-{sample}");
            mission = mission.sampled(self.seed.unwrap_or(mission.seed), sample);
        }
        let folder = results_folder(self.out.as_deref(), &name)?;
        at_interrupt(nothing_kept);
        let bar = Bar::new();
        let options = RunOptions { error_estimate: self.error_estimate };
        let outcome = run(&mission, options, &mut |progress| bar.show(progress));
        bar.done();
        let whence = provenance(&mission);
        let report = write_results(&outcome, &whence, &folder, self.csv).map(|files| files.report);
        let summary = || summary_json(&outcome, &whence);
        hand_over(report, self.json, summary, || verdict_table(&outcome))?;
        if outcome.cases.iter().any(|case| matches!(case.end, End::Breakdown { .. })) {
            return Ok(bad());
        }
        Ok(if outcome.cases.iter().all(|case| case.passed) { YES } else { no() })
    }
}

/// The mission of a file and what is set, after its remarks.
pub(crate) fn mission_of(path: &Path, settings: &Settings) -> Result<Mission, Failure> {
    let mission = wrasse_mission::mission_of(&settings.document(path)?)?;
    if !mission.remarks.is_empty() {
        complain(&mission.remarks);
    }
    Ok(mission)
}
