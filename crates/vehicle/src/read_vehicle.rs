//! A vehicle file to a vehicle, whatever its format.

use crate::toml::read_toml;
use crate::urdf::read_urdf;
use crate::vehicle::Vehicle;
use std::path::PathBuf;
use wrasse_document::{Complaint, Source};

/// The vehicle that a file describes; its ending says the format (`.toml`, `.urdf` or
/// `.xml`).
///
/// Warnings and notes are in [`Vehicle::remarks`].
///
/// # Errors
/// All complaints at once, if the file cannot be read or is not physically possible.
pub fn read_vehicle(
    path: impl Into<PathBuf>,
    text: impl Into<String>,
) -> Result<Vehicle, Vec<Complaint>> {
    let source = Source::new(path, text);
    let ending = source.path.extension().and_then(|e| e.to_str()).map(str::to_lowercase);
    let read = match ending.as_deref() {
        Some("toml") => read_toml(&source),
        Some("urdf" | "xml") => read_urdf(&source),
        other => {
            let found =
                other.map_or("no ending".into(), |ending| format!("the ending '.{ending}'"));
            let message = format!("the ending of a vehicle file says its format, found {found}");
            let complaint = Complaint::error(&source, message);
            Err(vec![complaint.with_help("vehicle files end in .toml, .urdf or .xml")])
        }
    };
    read.map(|vehicle| Vehicle { text: source.text.clone(), ..vehicle })
}
