//! The vehicles that come with wrasse, and how a vehicle is found by its name or its file.

use crate::read_vehicle::read_vehicle;
use crate::vehicle::Vehicle;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use wrasse_document::{Complaint, MOST_BYTES, Source, closest, read_text};

/// A vehicle of the catalogue. Its file is part of the program.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct CatalogueEntry {
    /// What it is called.
    pub name: &'static str,
    /// Its file in `vehicles/`.
    pub file_name: &'static str,
    /// The whole text of the file.
    pub text: &'static str,
}

macro_rules! entry {
    ($name:literal, $ending:literal) => {
        CatalogueEntry {
            name: $name,
            file_name: concat!($name, ".", $ending),
            text: include_str!(concat!("../../../vehicles/", $name, ".", $ending)),
        }
    };
}

/// Servicers with arms, free-flyers without, clients.
static CATALOGUE: [CatalogueEntry; 23] = [
    entry!("atlas-class", "toml"),
    entry!("atlas-class-two-arms", "toml"),
    entry!("caesar-class", "toml"),
    entry!("etsvii", "toml"),
    entry!("etsvii-repaired", "toml"),
    entry!("fts-class", "toml"),
    entry!("orbital-express-class", "toml"),
    entry!("ranger-class", "toml"),
    entry!("shuttle-rms", "toml"),
    entry!("ssrms", "toml"),
    entry!("dextre-class", "toml"),
    entry!("era-class", "toml"),
    entry!("jemrms-class", "toml"),
    entry!("planar-two-link", "toml"),
    entry!("example-arm", "urdf"),
    entry!("aercam-sprint-class", "toml"),
    entry!("omv-class", "toml"),
    entry!("envisat-class", "toml"),
    entry!("etsvii-target", "toml"),
    entry!("hubble-class", "toml"),
    entry!("nextsat-class", "toml"),
    entry!("oru-module", "toml"),
    entry!("solar-max-class", "toml"),
];

/// All vehicles of the catalogue.
pub fn catalogue() -> &'static [CatalogueEntry] {
    &CATALOGUE
}

impl CatalogueEntry {
    /// The vehicle.
    ///
    /// # Errors
    /// All complaints about its file; the catalogue's own tests see to it that there are none.
    pub fn read(&self) -> Result<Vehicle, Vec<Complaint>> {
        read_vehicle(Path::new("vehicles").join(self.file_name), self.text)
    }
}

/// Why there is no vehicle.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum NoVehicle {
    /// No catalogue entry and no file has this name: for a complaint at the place that asked for it.
    NotFound {
        /// What was found.
        message: String,
        /// What to write instead.
        help: String,
        /// The entry of the catalogue that is meant, as far as the name tells.
        meant: Option<&'static CatalogueEntry>,
    },
    /// Its file has errors.
    Faulty(Vec<Complaint>),
}

/// The vehicle of a catalogue name, or of a file.
///
/// A name with a slash or a file ending is a file; its place is seen from the folder `relative_to`.
///
/// # Errors
/// If there is no such vehicle, or its file has errors.
pub fn find_vehicle(name_or_path: &str, relative_to: Option<&Path>) -> Result<Vehicle, NoVehicle> {
    let source = source_of(name_or_path, relative_to)?;
    read_vehicle(source.path.clone(), source.text.clone()).map_err(NoVehicle::Faulty)
}

/// The file of a catalogue name or of a path, or what was found in its place and what to write.
pub(crate) fn vehicle_source(
    name_or_path: &str,
    relative_to: Option<&Path>,
) -> Result<Arc<Source>, (String, String)> {
    source_of(name_or_path, relative_to).map_err(|why| match why {
        NoVehicle::NotFound { message, help, .. } => (message, help),
        // No file has been read yet.
        NoVehicle::Faulty(_) => (format!("'{name_or_path}' has errors"), String::new()),
    })
}

fn source_of(name_or_path: &str, relative_to: Option<&Path>) -> Result<Arc<Source>, NoVehicle> {
    if let Some(entry) = catalogue().iter().find(|entry| entry.name == name_or_path) {
        return Ok(Source::new(Path::new("vehicles").join(entry.file_name), entry.text));
    }
    let names = || catalogue().iter().map(|entry| entry.name);
    let is_file =
        name_or_path.contains(['/', '\\']) || Path::new(name_or_path).extension().is_some();
    if !is_file {
        let message = format!("no vehicle of the catalogue is called \"{name_or_path}\"");
        let close = closest(name_or_path, names());
        let help = match close {
            Some(meant) => format!("did you mean \"{meant}\"?"),
            None => format!(
                "the catalogue has {}; a file is named with its ending",
                names().collect::<Vec<_>>().join(", ")
            ),
        };
        let meant = close.and_then(|close| catalogue().iter().find(|entry| entry.name == close));
        return Err(NoVehicle::NotFound { message, help, meant });
    }
    let path =
        relative_to.map_or_else(|| PathBuf::from(name_or_path), |from| from.join(name_or_path));
    let text = read_text(&path, MOST_BYTES).map_err(|why| NoVehicle::NotFound {
        message: format!("cannot read the vehicle file {}: {why}", path.display()),
        help: match relative_to {
            Some(_) => "the path is seen from the folder of the file that names it".into(),
            None => "is the path right?".into(),
        },
        meant: None,
    })?;
    Ok(Source::new(path, text))
}
