//! Files in, complaints and answers out. No character of a file is obeyed by the terminal.

use crate::bad;
use serde_json::Value;
use std::io::{IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use wrasse_document::{
    Complaint, MOST_BYTES, Unreadable, read_stream, read_text, render, visible_json, visible_lines,
};

/// Why a command cannot go on.
#[derive(Debug)]
pub(crate) enum Failure {
    /// A plain sentence, perhaps with a remedy on a line below.
    Sentence(String),
    /// What is wrong with a file.
    Complaints(Vec<Complaint>),
}

impl Failure {
    /// Print it. The exit code: bad input, or a breakdown.
    pub(crate) fn tell(&self) -> ExitCode {
        match self {
            Self::Sentence(sentence) => tell(&format!("error: {sentence}")),
            Self::Complaints(complaints) => complain(complaints),
        }
        bad()
    }
}

impl From<Vec<Complaint>> for Failure {
    fn from(complaints: Vec<Complaint>) -> Self {
        Self::Complaints(complaints)
    }
}

/// A vehicle or mission file, and its text. What comes from standard input, `-`, has a name that says its
/// format: XML begins with a pointed bracket. Its folder is the one that the user is in.
pub(crate) fn file_of(path: &Path) -> Result<(PathBuf, String), Failure> {
    let text = text_up_to(path, MOST_BYTES)?;
    if path != Path::new(STDIN) {
        return Ok((path.to_owned(), text));
    }
    let is_xml = text.trim_start_matches(['\u{feff}', ' ', '\t', '\r', '\n']).starts_with('<');
    let name = if is_xml { "stdin.xml" } else { "stdin.toml" };
    Ok((name.into(), text))
}

/// Stands for standard input.
pub(crate) const STDIN: &str = "-";

/// The text of a file of at most so many bytes, or of standard input.
pub(crate) fn text_up_to(path: &Path, most: u64) -> Result<String, Failure> {
    let name = if path == Path::new(STDIN) { Path::new("standard input") } else { path };
    let sentence = |why| match why {
        Unreadable::System(error) if error.kind() == std::io::ErrorKind::NotFound => {
            format!("there is no file {}", name.display())
        }
        Unreadable::NotText { .. } => format!(
            "{} is not UTF-8 text; XML in another encoding says so: <?xml version=\"1.0\" \
             encoding=\"ISO-8859-1\"?>",
            name.display()
        ),
        why => format!("{} cannot be read: {why}", name.display()),
    };
    let read = if path == Path::new(STDIN) {
        read_stream(std::io::stdin().lock(), most)
    } else {
        read_text(path, most)
    };
    read.map_err(|why| Failure::Sentence(sentence(why)))
}

/// Print complaints to standard error, in colour on a terminal.
pub(crate) fn complain(complaints: &[Complaint]) {
    let colour = std::io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none();
    // Their colours are ours; what they show of a file is made visible as they are drawn.
    tell_as_it_is(&render(complaints, colour));
}

/// Print to standard error.
pub(crate) fn tell(text: &str) {
    tell_as_it_is(&visible_lines(text));
}

/// A closed pipe is not an error.
fn tell_as_it_is(text: &str) {
    let _ = writeln!(std::io::stderr(), "{}", text.trim_end());
}

/// Print to standard output. A closed pipe is not an error; a full disk ends the program, for an answer
/// that is cut short must not pass for a whole one.
pub(crate) fn say(text: &str) {
    say_as_it_is(&visible_lines(text));
}

/// Print JSON to standard output.
pub(crate) fn say_json(value: &Value) {
    say_as_it_is(&visible_json(&value.to_string()));
}

fn say_as_it_is(text: &str) {
    let mut out = std::io::stdout();
    let printed = writeln!(out, "{}", text.trim_end()).and_then(|()| out.flush());
    if let Err(error) = printed
        && error.kind() != std::io::ErrorKind::BrokenPipe
    {
        tell(&format!("error: standard output cannot be written: {error}"));
        std::process::exit(2);
    }
}
