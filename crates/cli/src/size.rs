//! `wrasse size`: what a task asks of the base, and which actuators can give it.

use crate::input::{complain, say, say_json, tell, text_of};
use crate::interrupt::at_interrupt;
use crate::progress::Bar;
use crate::{YES, bad};
use clap::{Args, ValueEnum};
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use wrasse_record::{prepare_place, study_json, study_table, write_study};
use wrasse_study::{Catalogue, StudyOutcome, read_study_with, size};

/// Size the actuators of a base: what a task asks, which sets can give it, how much slower it must be.
///
/// Takes a study (a mission file with a study table, such as studies/section-4.toml) or any mission,
/// which is then weighed with its own units, as fitted, and with the sets of studies/sets.toml; or with
/// all units of a kind that the hardware catalogue has. Every task is flown with the reference;
/// those that the study names are flown in closed loop with every set.
/// Writes report.html and summary.json to out/NAME-size, beside what `wrasse run` leaves in out/NAME.
/// Exit code 0: the study ran and its ledgers close (a study of which no set suffices is a result, not
/// an error); 2: bad input, a ledger that stays open, or a number that broke down.
#[derive(Debug, Args)]
pub(crate) struct Size {
    /// The study, or a mission.
    study: PathBuf,
    /// Weigh every unit of this kind that `wrasse hardware` lists, in a standard arrangement: four
    /// wheels, four CMGs in a pyramid, 24 thrusters at the corners of the bus.
    #[arg(long, value_name = "KIND", value_delimiter = ',')]
    catalogue: Vec<Kind>,
    /// Folder for the results, in place of out/NAME-size.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Print the summary as JSON in place of the tables.
    #[arg(long)]
    json: bool,
    /// Cases flown at a time; as many as the machine has processors if not given. The results are the
    /// same for any number.
    #[arg(long, value_name = "N")]
    threads: Option<NonZeroUsize>,
}

/// A kind of unit, as the command line has it.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum Kind {
    /// Reaction wheels.
    Wheels,
    /// Control moment gyros.
    Cmgs,
    /// Thrusters.
    Thrusters,
}

impl From<Kind> for Catalogue {
    fn from(kind: Kind) -> Self {
        match kind {
            Kind::Wheels => Self::Wheels,
            Kind::Cmgs => Self::Cmgs,
            Kind::Thrusters => Self::Thrusters,
        }
    }
}

impl Size {
    pub(crate) fn go(&self) -> ExitCode {
        let text = match text_of(&self.study) {
            Ok(text) => text,
            Err(sentence) => {
                tell(&format!("error: {sentence}"));
                return bad();
            }
        };
        let mut catalogue: Vec<Catalogue> = vec![];
        for kind in self.catalogue.iter().map(|kind| Catalogue::from(*kind)) {
            if !catalogue.contains(&kind) {
                catalogue.push(kind);
            }
        }
        let study = match read_study_with(&self.study, &text, &catalogue) {
            Ok(study) => study,
            Err(complaints) => {
                complain(&complaints);
                return bad();
            }
        };
        // The report of a run of the same file stays what it is.
        let usual = || PathBuf::from("out").join(format!("{}-size", study.name()));
        let folder = self.out.clone().unwrap_or_else(usual);
        if let Err(error) = prepare_place(&folder) {
            tell(&format!("error: the results cannot be written: {error}"));
            return bad();
        }
        at_interrupt(|| "nothing is kept; former results are as they were".into());
        let threads = self.threads.or_else(|| std::thread::available_parallelism().ok());
        let bar = Bar::new();
        let outcome = size(&study, threads.map_or(1, NonZeroUsize::get), &mut |p| bar.show(p));
        bar.done();
        self.hand_over(&outcome, &folder)
    }

    /// Write the results, print what was asked for, say how it went.
    fn hand_over(&self, outcome: &StudyOutcome, folder: &Path) -> ExitCode {
        let written = match write_study(outcome, folder) {
            Ok(written) => written,
            Err(error) => {
                tell(&format!("error: the results cannot be written: {error}"));
                return bad();
            }
        };
        if self.json {
            say_json(&study_json(outcome));
        } else {
            say(&study_table(outcome));
            say(&format!("report: {}", written.report.display()));
        }
        if outcome.closes { YES } else { bad() }
    }
}
