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

/// Print to standard output. A reader who has gone away is no error of ours.
pub(crate) fn say(text: &str) {
    let _ = writeln!(std::io::stdout(), "{}", text.trim_end());
}
