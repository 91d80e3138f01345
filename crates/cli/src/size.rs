//! `wrasse size`: what a task asks of the base, and which actuators can give it.

use crate::input::Failure;
use crate::interrupt::{at_interrupt, nothing_kept};
use crate::progress::Bar;
use crate::results::{hand_over, provenance, results_folder};
use crate::settings::Settings;
use crate::{YES, bad, threads};
use clap::{Args, ValueEnum};
use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::process::ExitCode;
use wrasse_record::{study_json, study_table, write_study};
use wrasse_study::{Catalogue, size, study_in};

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
#[command(after_help = "Example:\n  wrasse size missions/atlas-reach.toml --catalogue wheels,cmgs")]
pub(crate) struct Size {
    /// The study, or a mission; `-` is standard input.
    study: PathBuf,
    #[command(flatten)]
    settings: Settings,
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
    pub(crate) fn go(&self) -> Result<ExitCode, Failure> {
        let mut catalogue: Vec<Catalogue> = vec![];
        for kind in self.catalogue.iter().map(|kind| Catalogue::from(*kind)) {
            if !catalogue.contains(&kind) {
                catalogue.push(kind);
            }
        }
        let study = study_in(&self.settings.document(&self.study)?, &catalogue)?;
        // The report of a run of the same file stays what it is.
        let folder = results_folder(self.out.as_deref(), &format!("{}-size", study.name()))?;
        at_interrupt(nothing_kept);
        let bar = Bar::new();
        let outcome = size(&study, threads(self.threads), &mut |p| bar.show(p));
        bar.done();
        let whence = provenance(study.mission());
        let report = write_study(&outcome, &whence, &folder).map(|written| written.report);
        let summary = || study_json(&outcome, &whence);
        hand_over(report, self.json, summary, || study_table(&outcome))?;
        Ok(if outcome.closes { YES } else { bad() })
    }
}
