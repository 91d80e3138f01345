//! A vehicle file to a vehicle, whatever its format.

use crate::mjcf::{is_mjcf, read_mjcf};
use crate::model::Model;
use crate::toml::read_toml;
use crate::urdf::{EXPAND_XACRO, read_urdf};
use crate::vehicle::Vehicle;
use crate::xml::check_attributes;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use wrasse_document::{Complaint, Source};

/// The vehicle that a file describes; its ending says the format (`.toml`, `.urdf`, `.mjcf`, or `.xml`,
/// whose root then says which of the two it is). Files that it includes are read from where it says, seen
/// from its own folder.
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
    read_model(&source, &mut Nesting::default())?.into_vehicle()
}

/// What a file says, with what it includes.
///
/// # Errors
/// All complaints at once, if nothing can be made of it.
pub(crate) fn read_model(
    source: &Arc<Source>,
    nesting: &mut Nesting,
) -> Result<Model, Vec<Complaint>> {
    let ending = source.path.extension().and_then(|e| e.to_str()).map(str::to_lowercase);
    if matches!(ending.as_deref(), Some("mjcf" | "xml" | "urdf")) {
        check_attributes(source)?;
    }
    nesting.open.push(source.path.clone());
    let read = match ending.as_deref() {
        Some("toml") => read_toml(source, nesting),
        Some("mjcf") => read_mjcf(source),
        Some("xml") if is_mjcf(&source.text) => read_mjcf(source),
        Some("urdf" | "xml") => read_urdf(source),
        other => {
            let found =
                other.map_or("no ending".into(), |ending| format!("the ending '.{ending}'"));
            let message = format!("the ending of a vehicle file says its format, found {found}");
            let complaint = Complaint::error(source, message);
            Err(vec![complaint.with_help(match ending.as_deref() {
                Some("xacro") => EXPAND_XACRO,
                Some("sdf" | "world") => "convert SDF to URDF",
                _ => "vehicle files end in .toml, .urdf, .mjcf or .xml",
            })])
        }
    };
    nesting.open.pop();
    read
}

/// Most files that a vehicle is made of: a vehicle of that many parts is a mistake, or a trap.
const MOST_FILES: usize = 64;
/// Most files that include one another.
const MOST_DEEP: usize = 8;

/// Files that are being read, each included by the one before.
#[derive(Debug, Default)]
pub(crate) struct Nesting {
    open: Vec<PathBuf>,
    /// Files that were included so far.
    included: usize,
}

impl Nesting {
    /// Counts one more file; why it cannot be included, if so.
    pub(crate) fn include(&mut self, path: &Path) -> Result<(), String> {
        self.included += 1;
        if self.open.iter().any(|open| same_file(open, path)) {
            return Err("it includes itself, over others or at once".into());
        }
        if self.open.len() >= MOST_DEEP {
            return Err(format!("more than {MOST_DEEP} files include one another"));
        }
        if self.included > MOST_FILES {
            return Err(format!("the vehicle is made of more than {MOST_FILES} files"));
        }
        Ok(())
    }
}

/// Whether two paths lead to one file, as far as the system can tell.
fn same_file(a: &Path, b: &Path) -> bool {
    let place = |path: &Path| path.canonicalize().unwrap_or_else(|_| path.to_owned());
    a == b || place(a) == place(b)
}
