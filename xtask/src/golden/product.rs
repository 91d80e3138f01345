//! The product's doors: vehicle files, and the answers of `wrasse eval`.

use super::file::{Case, Complaint};
use crate::embedded::toolchain::{cargo, output_of};
use crate::tidy::{files_below, repository_root};
use serde_json::Value;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;
use wrasse_vehicle::{Vehicle, read_vehicle};

/// The file of a vehicle: beside the golden file, one folder up, then in the repository.
pub(super) fn vehicle_file(case: &Case, name: &str) -> Result<PathBuf, Complaint> {
    let folders = case.file.ancestors().skip(1).take(2);
    let beside = folders.map(|folder| folder.join(name)).find(|path| path.is_file());
    let root = repository_root();
    let in_repository = || {
        let ending = format!("/{name}");
        let mut all = ["validation", "vehicles"].iter();
        all.find_map(|folder| files_below(&root, folder, &ending).pop()).map(|path| root.join(path))
    };
    let nowhere = || {
        let places =
            "beside the file, one folder up, or in the repository's validation/ or vehicles/";
        case.complaint("", format!("the vehicle {name} is neither {places}"))
    };
    beside.or_else(in_repository).ok_or_else(nowhere)
}

/// A vehicle, read and checked.
pub(super) fn vehicle(case: &Case, name: &str) -> Result<Vehicle, Complaint> {
    let path = vehicle_file(case, name)?;
    let shown = path.display().to_string();
    let unreadable =
        |why: std::io::Error| case.complaint("", format!("the vehicle {shown}: {why}"));
    let text = fs::read_to_string(&path).map_err(unreadable)?;
    read_vehicle(&path, text).map_err(|complaints| {
        let told = wrasse_document::render(&complaints, false);
        case.complaint("", format!("the vehicle {shown} cannot be used:\n{told}"))
    })
}

/// What `wrasse eval` answers about a vehicle and states.
pub(super) fn eval(case: &Case, vehicle: &Path, states: &Value) -> Result<Value, Complaint> {
    static BINARY: OnceLock<Result<PathBuf, String>> = OnceLock::new();
    let said = BINARY.get_or_init(binary).clone().and_then(|binary| {
        let mut file = tempfile::NamedTempFile::new().map_err(|why| why.to_string())?;
        file.write_all(states.to_string().as_bytes()).map_err(|why| why.to_string())?;
        let mut command = Command::new(binary);
        output_of(command.arg("eval").arg(vehicle).arg("--states").arg(file.path()))
    });
    let answer = said.and_then(|text| serde_json::from_str(&text).map_err(|why| why.to_string()));
    answer.map_err(|why| case.complaint("input", format!("`wrasse eval` refuses it:\n{why}")))
}

/// Build the product; its file. The whole workspace is named so that its crates are built once for all
/// chores, with the same features.
fn binary() -> Result<PathBuf, String> {
    let mut command = Command::new(cargo());
    command
        .args(["build", "--quiet", "--workspace", "--bin", "wrasse"])
        .args(["--message-format", "json-render-diagnostics"])
        .current_dir(repository_root());
    let messages = output_of(&mut command)?;
    let messages = messages.lines().filter_map(|line| serde_json::from_str::<Value>(line).ok());
    let mut built = messages.filter_map(|m| m["executable"].as_str().map(PathBuf::from));
    built.next_back().ok_or_else(|| "cargo names no program that it built".to_owned())
}
