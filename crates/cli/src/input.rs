//! Files in, complaints out.

use std::io::{IsTerminal, Write};
use std::path::Path;
use wrasse_document::{Complaint, render};

/// The text of a file; a plain sentence if it cannot be read.
pub(crate) fn text_of(path: &Path) -> Result<String, String> {
    std::fs::read_to_string(path).map_err(|error| match error.kind() {
        std::io::ErrorKind::NotFound => format!("there is no file {}", path.display()),
        std::io::ErrorKind::InvalidData => format!("{} is not UTF-8 text", path.display()),
        _ => format!("{} cannot be read: {error}", path.display()),
    })
}

/// Print complaints to standard error, in colour on a terminal.
pub(crate) fn complain(complaints: &[Complaint]) {
    let colour = std::io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none();
    tell(&render(complaints, colour));
}

/// Print to standard error. A reader who has gone away is no error of ours.
pub(crate) fn tell(text: &str) {
    let _ = writeln!(std::io::stderr(), "{}", text.trim_end());
}

/// Print to standard output. A reader who has gone away is no error of ours; a full disk ends the
/// program, for an answer that is cut short must not pass for a whole one.
pub(crate) fn say(text: &str) {
    let mut out = std::io::stdout();
    let printed = writeln!(out, "{}", text.trim_end()).and_then(|()| out.flush());
    if let Err(error) = printed
        && error.kind() != std::io::ErrorKind::BrokenPipe
    {
        tell(&format!("error: standard output cannot be written: {error}"));
        std::process::exit(2);
    }
}
