//! Files in, complaints and answers out. No character of a file is obeyed by the terminal.

use serde_json::Value;
use std::io::{IsTerminal, Write};
use std::path::Path;
use wrasse_document::{
    Complaint, MOST_BYTES, Unreadable, read_text, render, visible_json, visible_lines,
};

/// The text of a vehicle or mission file; a plain sentence if it cannot be read.
pub(crate) fn text_of(path: &Path) -> Result<String, String> {
    text_up_to(path, MOST_BYTES)
}

/// The same, of a file of at most so many bytes.
pub(crate) fn text_up_to(path: &Path, most: u64) -> Result<String, String> {
    read_text(path, most).map_err(|why| match why {
        Unreadable::System(error) if error.kind() == std::io::ErrorKind::NotFound => {
            format!("there is no file {}", path.display())
        }
        Unreadable::NotText { .. } => format!("{} is not UTF-8 text", path.display()),
        why => format!("{} cannot be read: {why}", path.display()),
    })
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

/// Print to standard error. A closed pipe is ignored.
fn tell_as_it_is(text: &str) {
    let _ = writeln!(std::io::stderr(), "{}", text.trim_end());
}

/// Print to standard output. A closed pipe is ignored; a full disk ends the
/// program, for an answer that is cut short must not pass for a whole one.
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
