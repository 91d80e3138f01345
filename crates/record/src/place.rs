//! Results in their place: all files of a set together, whatever ends the program.
//!
//! The set is written into a hidden folder beside the place, which then takes the name of the
//! place: whoever looks sees the former set, or the new one, and never a part or a mixture. What a
//! program that was killed left behind is put right by the next one.

use crate::error::RecordError;
use std::ffi::OsString;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// All names that results have.
const RESULTS: [&str; 6] = [
    "report.html",
    "telemetry.parquet",
    "telemetry.csv",
    "samples.parquet",
    "samples.csv",
    "summary.json",
];

/// Keeps others from taking the folder in which it lies for a leftover.
const LOCK: &str = "lock";

/// A folder without a lock that is older than this is a leftover.
const YOUNG: Duration = Duration::from_mins(1);

/// Sees to it that results can be put into `dir` later: for the time before a long flight. Leaves
/// no folder that was not there, and puts right what a killed program left.
///
/// # Errors
/// A place that cannot be written.
pub fn prepare_place(dir: &Path) -> Result<(), RecordError> {
    let missing: Vec<&Path> = dir.ancestors().take_while(|above| !above.exists()).collect();
    let missing: Vec<&Path> =
        missing.into_iter().filter(|above| !above.as_os_str().is_empty()).collect();
    let tried = try_place(dir);
    for made in missing {
        // What is not empty holds what was put right.
        let _ = fs::remove_dir(made);
    }
    tried
}

fn try_place(dir: &Path) -> Result<(), RecordError> {
    let place = Place::of(dir)?;
    place.put_right();
    fs::create_dir_all(dir).map_err(|e| refused("create the directory", dir, e))?;
    place.check_names()?;
    if place.moves_as_a_whole() {
        let staging = Staging::beside(&place)?;
        return staging.write("probe", b"1");
    }
    Staging::within(&place)?.write("probe", b"1")
}

/// Names and contents of files, put into `dir` together or not at all, the last one last.
pub(crate) fn put_files(files: &[(&str, Vec<u8>)], dir: &Path) -> Result<(), RecordError> {
    let place = Place::of(dir)?;
    place.put_right();
    place.check_names()?;
    if place.moves_as_a_whole() {
        let staging = Staging::beside(&place)?;
        for (name, content) in files {
            staging.write(name, content)?;
        }
        if staging.become_the_place(&place)? {
            return Ok(());
        }
    }
    let staging = Staging::within(&place)?;
    for (name, content) in files {
        staging.write(name, content)?;
    }
    let names: Vec<&str> = files.iter().map(|(name, _)| *name).collect();
    put_one_by_one(&names, &staging.folder, &place.dir)
}

fn refused(doing: &'static str, path: &Path, source: io::Error) -> RecordError {
    RecordError::File { doing, path: path.to_owned(), source }
}

/// A folder for results: its name, and the folder in which it lies.
struct Place {
    dir: PathBuf,
    above: PathBuf,
    name: OsString,
}

impl Place {
    /// The place itself need not be there; the folder above it is made.
    fn of(dir: &Path) -> Result<Self, RecordError> {
        let cannot = |e| refused("create the directory", dir, e);
        let dir = if dir.exists() {
            fs::canonicalize(dir).map_err(cannot)?
        } else {
            let name = dir.file_name().ok_or(io::ErrorKind::InvalidInput.into()).map_err(cannot)?;
            let above = dir.parent().filter(|above| !above.as_os_str().is_empty());
            let above = above.unwrap_or(Path::new("."));
            fs::create_dir_all(above).map_err(cannot)?;
            fs::canonicalize(above).map_err(cannot)?.join(name)
        };
        if dir.exists() && !dir.is_dir() {
            return Err(cannot(io::ErrorKind::NotADirectory.into()));
        }
        let above = dir.parent().unwrap_or(&dir).to_owned();
        let name = dir.file_name().unwrap_or_default().to_owned();
        Ok(Self { dir, above, name })
    }
    /// A hidden name beside the place.
    fn beside(&self, what: &str) -> PathBuf {
        let mut name = OsString::from(".");
        name.push(&self.name);
        name.push(format!(".wrasse-{what}"));
        self.above.join(name)
    }
    /// Where the former set waits while the new one takes its place.
    fn former(&self) -> PathBuf {
        self.beside("former")
    }
    /// A folder of the name of a result is not a former result, and is not replaced.
    fn check_names(&self) -> Result<(), RecordError> {
        let in_the_way = RESULTS.iter().map(|name| self.dir.join(name)).find(|path| path.is_dir());
        match in_the_way {
            Some(path) => Err(refused("replace", &path, io::ErrorKind::IsADirectory.into())),
            None => Ok(()),
        }
    }
    /// Whether the folder can be exchanged for another: not where somebody works in it, or where it
    /// is the root of a file system.
    fn moves_as_a_whole(&self) -> bool {
        let here = std::env::current_dir().and_then(fs::canonicalize);
        let works_in_it = here.is_ok_and(|here| here.starts_with(&self.dir));
        !self.name.is_empty() && !works_in_it && !is_root_of_file_system(&self.dir, &self.above)
    }
    /// Put right what a killed program left. Best effort: what cannot be put right harms nothing.
    fn put_right(&self) {
        let former = self.former();
        if former.is_dir() {
            if self.dir.exists() {
                take_over(&former, &self.dir);
            } else {
                let _ = fs::rename(&former, &self.dir);
            }
        }
        for (folder, prefix) in [(&self.above, self.beside("new-")), (&self.dir, within(&self.dir))]
        {
            let prefix = prefix.file_name().unwrap_or_default().to_string_lossy().into_owned();
            for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
                let is_staging = entry.file_name().to_string_lossy().starts_with(&prefix);
                if is_staging && is_leftover(&entry.path()) {
                    let _ = fs::remove_dir_all(entry.path());
                }
            }
        }
    }
}

/// How the hidden folders in a place begin.
fn within(dir: &Path) -> PathBuf {
    dir.join(".wrasse-")
}

#[cfg(unix)]
fn is_root_of_file_system(dir: &Path, above: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let device = |path: &Path| fs::metadata(path).map(|known| known.dev()).ok();
    dir.exists() && device(dir) != device(above)
}
#[cfg(not(unix))]
fn is_root_of_file_system(_dir: &Path, _above: &Path) -> bool {
    false
}

/// Whether nobody writes into a hidden folder any more.
fn is_leftover(folder: &Path) -> bool {
    if let Ok(lock) = File::open(folder.join(LOCK)) {
        return lock.try_lock().is_ok();
    }
    let age = folder.metadata().and_then(|known| known.modified()).map(|at| at.elapsed());
    let is_young = matches!(age, Ok(Ok(age)) if age < YOUNG);
    folder.is_dir() && (!is_young || has_ended(folder))
}

/// Whether the program whose number ends the folder's name is known to have ended.
fn has_ended(folder: &Path) -> bool {
    let name = folder.to_string_lossy();
    let program = name.rsplit('-').next().and_then(|number| number.parse::<u32>().ok());
    let running = Path::new("/proc");
    running.join("self").exists()
        && program.is_some_and(|number| !running.join(number.to_string()).exists())
}

/// What else lay beside the former set goes to the new one; the former set goes away.
fn take_over(former: &Path, dir: &Path) {
    for entry in fs::read_dir(former).into_iter().flatten().flatten() {
        let name = entry.file_name();
        if RESULTS.iter().any(|result| name == *result) && entry.path().is_file() {
            let _ = fs::remove_file(entry.path());
        } else if dir.join(&name).symlink_metadata().is_err() {
            let _ = fs::rename(entry.path(), dir.join(&name));
        }
    }
    // What has found no place stays, and with it the folder.
    let _ = fs::remove_dir(former);
}

/// A hidden folder for a set that is being written; it goes away with its value.
struct Staging {
    folder: PathBuf,
    lock: Option<File>,
}

impl Staging {
    fn beside(place: &Place) -> Result<Self, RecordError> {
        Self::make(place.beside(&format!("new-{}", std::process::id())))
    }
    fn within(place: &Place) -> Result<Self, RecordError> {
        let dir = &place.dir;
        fs::create_dir_all(dir).map_err(|e| refused("create the directory", dir, e))?;
        Self::make(dir.join(format!(".wrasse-{}", std::process::id())))
    }
    fn make(folder: PathBuf) -> Result<Self, RecordError> {
        fs::create_dir(&folder).map_err(|e| refused("write", &folder, e))?;
        // From here on it goes away with its value.
        let mut staging = Self { folder, lock: None };
        let path = staging.folder.join(LOCK);
        let lock = File::create(&path).map_err(|e| refused("write", &path, e))?;
        // Where files cannot be locked the age of the folder must do.
        staging.lock = lock.try_lock().is_ok().then_some(lock);
        Ok(staging)
    }
    /// Writes a file and waits until the disk has it: a rename never outruns its contents.
    fn write(&self, name: &str, content: &[u8]) -> Result<(), RecordError> {
        let path = self.folder.join(name);
        let write = || {
            let mut file = File::create(&path)?;
            file.write_all(content)?;
            file.sync_all()
        };
        write().map_err(|e| refused("write", &path, e))
    }
    /// Take the name of the place; false if the folder there cannot be moved.
    fn become_the_place(mut self, place: &Place) -> Result<bool, RecordError> {
        let cannot = |e| refused("write", &place.dir, e);
        self.lock = None;
        fs::remove_file(self.folder.join(LOCK)).map_err(cannot)?;
        if !place.dir.exists() {
            fs::rename(&self.folder, &place.dir).map_err(cannot)?;
            return Ok(true);
        }
        if let Ok(known) = place.dir.metadata() {
            let _ = fs::set_permissions(&self.folder, known.permissions());
        }
        let former = place.former();
        if fs::rename(&place.dir, &former).is_err() {
            return Ok(false);
        }
        if let Err(error) = fs::rename(&self.folder, &place.dir) {
            let _ = fs::rename(&former, &place.dir);
            return Err(cannot(error));
        }
        take_over(&former, &place.dir);
        Ok(true)
    }
}

impl Drop for Staging {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.folder);
    }
}

/// For a folder that cannot be moved: sets the former files aside, last first, then puts the new
/// ones in their places, so that the two are never side by side.
fn put_one_by_one(names: &[&str], staging: &Path, dir: &Path) -> Result<(), RecordError> {
    let mut aside = Vec::new();
    for name in names.iter().rev() {
        let place = dir.join(name);
        if place.symlink_metadata().is_err() {
            continue;
        }
        if let Err(source) = fs::rename(&place, staging.join(format!("former-{name}"))) {
            put_back(&aside, staging, dir);
            return Err(refused("replace", &place, source));
        }
        aside.push(*name);
    }
    for name in names {
        if let Err(source) = fs::rename(staging.join(name), dir.join(name)) {
            // The new ones that are in place already are not to stay without the others.
            for new in names.iter().take_while(|new| *new != name) {
                let _ = fs::remove_file(dir.join(new));
            }
            put_back(&aside, staging, dir);
            return Err(refused("write", &dir.join(name), source));
        }
    }
    Ok(())
}

/// Best effort after a failure: what cannot be put back has no better place to go.
fn put_back(aside: &[&str], staging: &Path, dir: &Path) {
    for name in aside.iter().rev() {
        let _ = fs::rename(staging.join(format!("former-{name}")), dir.join(name));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn set(mark: &str) -> Vec<(&'static str, Vec<u8>)> {
        ["report.html", "summary.json"].map(|name| (name, mark.as_bytes().to_vec())).into()
    }
    fn names(dir: &Path) -> Vec<String> {
        let mut names: Vec<_> = fs::read_dir(dir)
            .into_iter()
            .flatten()
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }

    #[test]
    fn what_a_kill_between_the_two_renames_left_is_put_right() {
        let root = tempfile::tempdir().unwrap();
        let dir = root.path().join("flown");
        put_files(&set("old"), &dir).unwrap();
        fs::create_dir(dir.join("parts")).unwrap();
        // As after the first rename: the former set whole, the new one whole, nothing in place.
        fs::rename(&dir, root.path().join(".flown.wrasse-former")).unwrap();
        let dead = root.path().join(".flown.wrasse-new-1");
        fs::create_dir(&dead).unwrap();
        fs::write(dead.join(LOCK), "").unwrap();
        prepare_place(&dir).unwrap();
        assert_eq!(names(root.path()), ["flown"]);
        assert_eq!(names(&dir), ["parts", "report.html", "summary.json"]);
        assert_eq!(fs::read(dir.join("report.html")).unwrap(), b"old");
    }

    #[test]
    fn what_a_kill_after_the_second_rename_left_is_put_right() {
        let root = tempfile::tempdir().unwrap();
        let (dir, former) = (root.path().join("flown"), root.path().join(".flown.wrasse-former"));
        put_files(&set("old"), &former).unwrap();
        fs::create_dir(former.join("parts")).unwrap();
        fs::write(former.join("parts/one"), "1").unwrap();
        put_files(&set("new"), &dir).unwrap();
        assert_eq!(names(root.path()), ["flown"]);
        assert_eq!(names(&dir), ["parts", "report.html", "summary.json"]);
        assert_eq!(fs::read(dir.join("summary.json")).unwrap(), b"new");
        assert_eq!(names(&dir.join("parts")), ["one"]);
    }

    #[test]
    fn a_folder_that_somebody_is_writing_is_no_leftover() {
        let root = tempfile::tempdir().unwrap();
        let place = Place::of(&root.path().join("flown")).unwrap();
        let staging = Staging::beside(&place).unwrap();
        place.put_right();
        assert!(staging.folder.is_dir());
        let folder = staging.folder.clone();
        drop(staging);
        assert!(!folder.exists());
    }

    #[test]
    fn a_folder_that_cannot_be_moved_gets_its_files_one_by_one() {
        let root = tempfile::tempdir().unwrap();
        let place = Place::of(root.path()).unwrap();
        for mark in ["old", "new"] {
            let staging = Staging::within(&place).unwrap();
            for (name, content) in set(mark) {
                staging.write(name, &content).unwrap();
            }
            put_one_by_one(&["report.html", "summary.json"], &staging.folder, root.path()).unwrap();
        }
        assert_eq!(names(root.path()), ["report.html", "summary.json"]);
        assert_eq!(fs::read(root.path().join("report.html")).unwrap(), b"new");
    }

    #[test]
    fn trying_a_place_leaves_nothing_there() {
        let root = tempfile::tempdir().unwrap();
        prepare_place(&root.path().join("a/b/c")).unwrap();
        assert!(names(root.path()).is_empty());
        let long = root.path().join("x".repeat(300));
        assert!(prepare_place(&long).is_err() && prepare_place(Path::new("")).is_err());
        fs::write(root.path().join("file"), "").unwrap();
        for dir in ["file", "file/deeper"] {
            let told = prepare_place(&root.path().join(dir)).unwrap_err().to_string();
            assert!(told.contains(dir) && told.contains("--out"), "{told}");
        }
        assert_eq!(names(root.path()), ["file"]);
    }
}
