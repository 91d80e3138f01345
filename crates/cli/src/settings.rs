//! `--set`: values that are laid over a mission file.

use crate::input::{Failure, file_of};
use clap::Args;
use std::path::Path;
use wrasse_document::{Complaint, Document, Setting};

/// What the commands that read a mission have in common.
#[derive(Debug, Args)]
#[allow(
    rustdoc::broken_intra_doc_links,
    reason = "a key of a list, in the help of the command line"
)]
pub(crate) struct Settings {
    /// Give one value of the mission file another value; repeatable. The key is written as
    /// control.rate_hz, in a list with the name or the number (from 0) of the value:
    /// phase[reach].timeout_s, requirements[0]. The value is TOML; a word needs no quotes.
    #[arg(long, value_name = "KEY=VALUE")]
    set: Vec<String>,
}

impl Settings {
    pub(crate) fn is_empty(&self) -> bool {
        self.set.is_empty()
    }

    /// The document of a mission file, or of standard input, with what is set.
    pub(crate) fn document(&self, path: &Path) -> Result<Document, Failure> {
        let (path, text) = file_of(path)?;
        Ok(self.over(Document::parse(path, text)?)?)
    }

    /// A document with what is set.
    pub(crate) fn over(&self, document: Document) -> Result<Document, Vec<Complaint>> {
        let (mut settings, mut complaints) = (vec![], vec![]);
        for text in &self.set {
            match Setting::parse(text) {
                Ok(setting) => settings.push(setting),
                Err(complaint) => complaints.push(*complaint),
            }
        }
        if !complaints.is_empty() {
            return Err(complaints);
        }
        if settings.is_empty() { Ok(document) } else { document.with_settings(&settings) }
    }
}
