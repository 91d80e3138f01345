//! The progress bar of a run.

use indicatif::{ProgressBar, ProgressStyle};
use wrasse_mission::Progress;

/// A bar on standard error; nothing where that is no terminal.
#[derive(Debug)]
pub(crate) struct Bar(ProgressBar);

/// Ticks of a case.
const TICKS: f64 = 1000.0;

impl Bar {
    pub(crate) fn new(cases: usize) -> Self {
        let bar = ProgressBar::new(cases as u64 * 1000);
        let style = ProgressStyle::with_template("{bar:32} {percent:>3} %  {msg}  {eta} left");
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        Self(bar)
    }
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a share of 1000")]
    pub(crate) fn show(&self, progress: Progress<'_>) {
        let before = progress.case as u64 * 1000;
        self.0.set_position(before + (progress.share * TICKS) as u64);
        let message = match progress.cases {
            1 => progress.doing.to_owned(),
            cases => format!("{} {} of {cases}", progress.doing, progress.case + 1),
        };
        if self.0.message() != message {
            self.0.set_message(message);
        }
    }
    /// A bar that counts flights.
    pub(crate) fn counting() -> Self {
        let bar = ProgressBar::new(1);
        let style = ProgressStyle::with_template("{bar:32} {pos} of {len} flights  {eta} left");
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        Self(bar)
    }
    /// How many flights are done, of how many.
    pub(crate) fn count(&self, done: u64, of: u64) {
        // What was done before does not count for how long the rest takes.
        if self.0.length() != Some(of) {
            self.0.set_length(of);
            self.0.set_position(done);
            self.0.reset_eta();
        }
        self.0.set_position(done);
    }
    pub(crate) fn done(self) {
        self.0.finish_and_clear();
    }
}
