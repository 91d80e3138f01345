//! Which crate may know which: the arrows of `ARCHITECTURE.md` against `cargo metadata`.

use super::text_of;
use serde_json::Value;
use std::collections::BTreeSet;
use std::path::Path;
use std::process::Command;
use std::{env, fs};

/// Crates that fly or compute for what flies: no heap, no `std`.
pub(super) const CORE: [&str; 4] = ["spatial", "dynamics", "hardware", "flight"];

/// A crate of the workspace and what it reads.
#[derive(Debug)]
pub(super) struct Crate {
    /// Short name: the last part of its folder.
    pub(super) name: String,
    /// Folder below the root.
    pub(super) folder: String,
    /// Short names of the workspace crates it depends on, tests left out.
    own: BTreeSet<String>,
    /// Names of outside crates, its tests' included.
    pub(super) external: BTreeSet<String>,
    /// Names of outside crates, tests left out.
    external_in_product: BTreeSet<String>,
}

/// All crates of the workspace, from `cargo metadata`.
pub(super) fn workspace(root: &Path) -> Result<Vec<Crate>, String> {
    let program = env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let arguments = ["metadata", "--format-version", "1", "--no-deps", "--offline"];
    let run = Command::new(program).args(arguments).current_dir(root).output();
    let output = run.map_err(|why| format!("cargo metadata could not be started: {why}"))?;
    if !output.status.success() {
        return Err(format!("cargo metadata: {}", String::from_utf8_lossy(&output.stderr)));
    }
    let metadata: Value =
        serde_json::from_slice(&output.stdout).map_err(|why| format!("cargo metadata: {why}"))?;
    let packages = metadata["packages"].as_array().ok_or("cargo metadata: no packages")?;
    packages.iter().map(|package| read_crate(root, package)).collect()
}

/// One package of `cargo metadata`.
fn read_crate(root: &Path, package: &Value) -> Result<Crate, String> {
    let manifest = package["manifest_path"].as_str().ok_or("cargo metadata: no manifest_path")?;
    let folder = Path::new(manifest).parent().ok_or("cargo metadata: no folder")?;
    let root = fs::canonicalize(root).map_err(|why| format!("{}: {why}", root.display()))?;
    let below = folder.strip_prefix(&root).map_err(|why| format!("{manifest}: {why}"))?;
    let mut found = Crate {
        name: below.file_name().unwrap_or_default().to_string_lossy().into_owned(),
        folder: below.to_string_lossy().replace('\\', "/"),
        own: BTreeSet::new(),
        external: BTreeSet::new(),
        external_in_product: BTreeSet::new(),
    };
    for dependency in package["dependencies"].as_array().into_iter().flatten() {
        let name = dependency["name"].as_str().unwrap_or_default();
        let of_tests = dependency["kind"] == "dev";
        if let Some(path) = dependency["path"].as_str() {
            let short = Path::new(path).file_name().unwrap_or_default().to_string_lossy();
            if !of_tests {
                found.own.insert(short.into_owned());
            }
        } else {
            found.external.insert(name.to_owned());
            if !of_tests {
                found.external_in_product.insert(name.to_owned());
            }
        }
    }
    Ok(found)
}

/// The arrows drawn in the map: lines `name -> other other` of the fence `arrows`.
fn drawn(map: &str) -> Option<Vec<(String, BTreeSet<String>)>> {
    let block = map.split_once("```arrows\n")?.1.split_once("```")?.0;
    let arrow = |line: &str| {
        let (name, others) = line.split_once("->")?;
        let others = others.split_whitespace().map(str::to_owned).collect();
        Some((name.trim().to_owned(), others))
    };
    block.lines().map(arrow).collect()
}

/// The arrows of the map and those of the manifests are the same.
pub(super) fn arrows(root: &Path) -> Vec<String> {
    let crates = match workspace(root) {
        Ok(crates) => crates,
        Err(why) => return vec![why],
    };
    let Some(drawn) = drawn(&text_of(root, "ARCHITECTURE.md")) else {
        return vec!["ARCHITECTURE.md: no fence `arrows` of lines `name -> names`".to_owned()];
    };
    let mut findings = Vec::new();
    for Crate { name, own, .. } in &crates {
        match drawn.iter().find(|(n, _)| n == name) {
            None => findings.push(format!("{name}: not drawn in ARCHITECTURE.md")),
            Some((_, others)) => {
                let undrawn = own.difference(others).map(|o| format!("{name} -> {o}: not drawn"));
                let unused =
                    others.difference(own).map(|o| format!("{name} -> {o}: drawn, not there"));
                findings.extend(undrawn.chain(unused));
            }
        }
    }
    let unknown = drawn.iter().filter(|(n, _)| crates.iter().all(|c| c.name != *n));
    findings.extend(unknown.map(|(n, _)| format!("{n}: drawn, but no crate")));
    findings
}

/// Core crates depend on core crates and libm, and say that they do without `std`.
pub(super) fn core_alone(root: &Path) -> Vec<String> {
    let crates = match workspace(root) {
        Ok(crates) => crates,
        Err(why) => return vec![why],
    };
    let mut findings = Vec::new();
    for c in crates.iter().filter(|c| CORE.contains(&c.name.as_str())) {
        let strangers = c.own.iter().filter(|other| !CORE.contains(&other.as_str()));
        let outside = c
            .external_in_product
            .iter()
            .filter(|other| !["libm", "cpufeatures"].contains(&other.as_str()));
        let unwanted = strangers.chain(outside);
        findings.extend(unwanted.map(|other| format!("{}: depends on {other}", c.name)));
        let path = format!("{}/src/lib.rs", c.folder);
        if !text_of(root, &path).lines().any(|line| line == "#![no_std]") {
            findings.push(format!("{path}: no line `#![no_std]`"));
        }
    }
    let missing = CORE.iter().filter(|name| crates.iter().all(|c| c.name != **name));
    findings.extend(missing.map(|name| format!("{name}: core crate not found")));
    findings
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arrows_are_read_from_their_fence_only() {
        let map = "x -> y\n```arrows\nb -> a c\na ->\n```\nz -> w\n";
        let arrows = drawn(map).expect("a fence");
        let names: Vec<_> = arrows.iter().map(|(n, o)| (n.as_str(), o.len())).collect();
        assert_eq!(names, [("b", 2), ("a", 0)]);
        assert!(drawn("no fence").is_none());
        assert!(drawn("```arrows\nno arrow\n```").is_none());
    }

    #[test]
    fn the_workspace_knows_that_dynamics_reads_spatial() {
        let crates = workspace(&super::super::repository_root()).expect("cargo metadata");
        let dynamics = crates.iter().find(|c| c.name == "dynamics").expect("dynamics");
        assert_eq!(dynamics.folder, "crates/dynamics");
        assert!(dynamics.own.contains("spatial") && dynamics.external_in_product.is_empty());
    }
}
