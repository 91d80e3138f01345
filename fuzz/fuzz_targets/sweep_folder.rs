//! Any text as the manifest and as a part of a sweep that is resumed: the sweep goes on or is refused.
#![no_main]

use libfuzzer_sys::fuzz_target;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;
use std::{env, fs, process};
use wrasse_mission::{Mission, read_mission};
use wrasse_sweep::{OwnedFolder, Sweep, SweepError};

/// A flight of one control period with something that varies.
const MISSION: &str = include_str!("../seeds/sweep_folder_mission.toml");

static ASKED: LazyLock<(Mission, PathBuf)> = LazyLock::new(|| {
    let mission = read_mission("fuzz.toml", MISSION).expect("the mission is a mission");
    (mission, env::temp_dir().join(format!("wrasse-fuzz-{}", process::id())))
});

/// The sweep in a folder that is taken for it.
fn sweep(asked: &Sweep<'_>, folder: &Path) -> Result<(), SweepError> {
    wrasse_sweep::sweep(asked, &OwnedFolder::take(folder)?, &mut |_, _| {}).map(drop)
}

fuzz_target!(|text: &str| {
    let (mission, folder) = &*ASKED;
    let _ = fs::remove_dir_all(folder);
    let asked = Sweep { mission, samples: 1, seed: 7, threads: 1 };
    // A folder as the sweep makes it, or one with any manifest.
    let part = match text.split_once("\n---\n") {
        Some((manifest, part)) => {
            fs::create_dir_all(folder).expect("there is a temporary folder");
            fs::write(folder.join("manifest.json"), manifest).expect("it takes a file");
            part
        }
        None => {
            // Without samples it leaves its manifest.
            fs::create_dir_all(folder).expect("there is a temporary folder");
            let _ = sweep(&Sweep { samples: 0, ..asked }, folder);
            text
        }
    };
    fs::write(folder.join("case-0-000000000-000000007.jsonl"), part).expect("it takes a file");
    if let Err(refused) = sweep(&asked, folder) {
        assert!(!refused.to_string().is_empty(), "refused without a word");
    }
});
