//! `wrasse completions` and `wrasse man`: made from the declarations of the command line.

use crate::input::{Failure, say};
use crate::{Wrasse, YES};
use clap::{Args, CommandFactory};
use clap_complete::Shell;
use std::path::PathBuf;
use std::process::ExitCode;

/// Print what lets a shell complete the commands and options of wrasse.
#[derive(Debug, Args)]
#[command(after_help = "Example:
  wrasse completions bash > ~/.local/share/bash-completion/completions/wrasse")]
pub(crate) struct Completions {
    /// The shell.
    shell: Shell,
}

impl Completions {
    pub(crate) fn go(&self) -> ExitCode {
        let mut text = vec![];
        clap_complete::generate(self.shell, &mut Wrasse::command(), "wrasse", &mut text);
        say(&String::from_utf8_lossy(&text));
        YES
    }
}

/// Print the manual page, or write one for each command.
#[derive(Debug, Args)]
#[command(after_help = "Example:\n  wrasse man --out ~/.local/share/man/man1 && man wrasse-run")]
pub(crate) struct Man {
    /// Write wrasse.1, wrasse-run.1 and so on into this folder, in place of those that are there.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

impl Man {
    pub(crate) fn go(&self) -> Result<ExitCode, Failure> {
        let command = Wrasse::command();
        let refused = |why: &std::io::Error, place: &str| {
            Failure::Sentence(format!("{place} cannot be written: {why}"))
        };
        let Some(folder) = &self.out else {
            let mut text = vec![];
            let page = clap_mangen::Man::new(command);
            page.render(&mut text).map_err(|why| refused(&why, "the page"))?;
            say(&String::from_utf8_lossy(&text));
            return Ok(YES);
        };
        let place = folder.display().to_string();
        let written = std::fs::create_dir_all(folder)
            .and_then(|()| clap_mangen::generate_to(command, folder));
        written.map_err(|why| refused(&why, &place))?;
        say(&format!("written: {place}"));
        Ok(YES)
    }
}
