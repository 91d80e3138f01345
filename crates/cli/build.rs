//! Says which commit the program is built from, for the results that it writes.

use std::process::Command;

fn main() {
    // What the answer depends on: the commit, and whether files were changed since.
    for path in ["../../.git/HEAD", "../../.git/index", "../../crates"] {
        println!("cargo::rerun-if-changed={path}");
    }
    let words = ["describe", "--always", "--abbrev=40", "--exclude=*", "--dirty"];
    let told = Command::new("git").args(words).output();
    let commit = told.ok().filter(|told| told.status.success());
    let commit = commit.and_then(|told| String::from_utf8(told.stdout).ok());
    let commit = commit.map_or_else(|| "unknown".to_owned(), |text| text.trim().to_owned());
    println!("cargo::rustc-env=WRASSE_COMMIT={commit}");
}
