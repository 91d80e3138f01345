//! A vehicle file to a vehicle, whatever its format.

use crate::mjcf::{is_mjcf, read_mjcf};
use crate::toml::read_toml;
use crate::urdf::read_urdf;
use crate::vehicle::Vehicle;
use std::path::PathBuf;
use wrasse_document::{Complaint, Source};

/// The vehicle that a file describes; its ending says the format (`.toml`, `.urdf`, `.mjcf`, or `.xml`,
/// whose root then says which of the two it is).
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
        Some("mjcf") => read_mjcf(&source),
        Some("xml") if is_mjcf(&source.text) => read_mjcf(&source),
        Some("urdf" | "xml") => read_urdf(&source),
        other => {
            let found =
                other.map_or("no ending".into(), |ending| format!("the ending '.{ending}'"));
            let message = format!("the ending of a vehicle file says its format, found {found}");
            let complaint = Complaint::error(&source, message);
            Err(vec![complaint.with_help(
                "vehicle files end in .toml, .urdf, .mjcf or .xml; convert SDF to URDF",
            )])
        }
    };
    // A reader of several files has said what all of them hold.
    let whole = |text: String| if text.is_empty() { source.text.clone() } else { text };
    read.map(|vehicle| Vehicle { text: whole(vehicle.text.clone()), ..vehicle })
}
