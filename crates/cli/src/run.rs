//! `wrasse run`: a mission, from its file to its verdict.

use crate::input::{complain, say, say_json, tell, text_of};
use crate::interrupt::at_interrupt;
use crate::progress::Bar;
use crate::{YES, bad, no};
use clap::Args;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use wrasse_mission::{End, Outcome, RunOptions, read_mission, run};
use wrasse_record::{prepare_place, summary_json, verdict_table, write_results};

/// Fly a mission, judge its requirements, write the report.
///
/// Writes report.html, telemetry.parquet and summary.json to out/NAME. Exit code 0: all requirements
/// hold; 1: one does not, or the planning found that the path is infeasible; 2: bad input, or a
/// number broke down.
#[derive(Debug, Args)]
pub(crate) struct Run {
    /// The mission file.
    mission: PathBuf,
    /// Folder for the results, in place of out/NAME.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
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
    pub(crate) fn go(&self) -> ExitCode {
        let text = match text_of(&self.mission) {
            Ok(text) => text,
            Err(sentence) => {
                tell(&format!("error: {sentence}"));
                return bad();
            }
        };
        let mut mission = match read_mission(&self.mission, text) {
            Ok(mission) => mission,
            Err(complaints) => {
                complain(&complaints);
                return bad();
            }
        };
        if !mission.remarks.is_empty() {
            complain(&mission.remarks);
        }
        let mut usual = PathBuf::from("out").join(&mission.name);
        if let Some(sample) = self.sample {
            usual = PathBuf::from("out").join(format!("{}-sample-{sample}", mission.name));
            mission = mission.sampled(self.seed.unwrap_or(mission.seed), sample);
        }
        let folder = self.out.clone().unwrap_or(usual);
        if let Err(error) = prepare_place(&folder) {
            tell(&format!("error: the results cannot be written: {error}"));
            return bad();
        }
        at_interrupt(|| "nothing is kept; former results are as they were".into());
        let bar = Bar::new();
        let options = RunOptions { error_estimate: self.error_estimate };
        let outcome = run(&mission, options, &mut |progress| bar.show(progress));
        bar.done();
        self.hand_over(&outcome, &folder)
    }

    /// Write the results, print what was asked for, say how it went.
    fn hand_over(&self, outcome: &Outcome, folder: &Path) -> ExitCode {
        let written = match write_results(outcome, folder) {
            Ok(written) => written,
            Err(error) => {
                tell(&format!("error: the results cannot be written: {error}"));
                return bad();
            }
        };
        if self.json {
            say_json(&summary_json(outcome));
        } else {
            say(&verdict_table(outcome));
            say(&format!("report: {}", written.report.display()));
        }
        if outcome.cases.iter().any(|case| matches!(case.end, End::Breakdown { .. })) {
            return bad();
        }
        if outcome.cases.iter().all(|case| case.passed) { YES } else { no() }
    }
}
