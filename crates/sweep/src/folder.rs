//! The folder of a sweep, owned by one process at a time.

use crate::sweep_error::SweepError;
use std::fs::{self, File, TryLockError};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// The file whose lock is held. The system lets go of it when the process ends, however it does: a file
/// that is left behind holds nobody up.
const LOCK: &str = ".lock";

/// A folder that no other sweep uses as long as this lives.
#[derive(Debug)]
pub struct OwnedFolder {
    path: PathBuf,
    lock: File,
}

impl OwnedFolder {
    /// Take a folder, which is made if need be.
    ///
    /// # Errors
    /// A folder that cannot be used, or that another process uses.
    pub fn take(path: &Path) -> Result<Self, SweepError> {
        fs::create_dir_all(path).map_err(|e| refused("make the folder", path, e))?;
        let name = path.join(LOCK);
        let open = File::options().create(true).truncate(false).write(true).open(&name);
        let lock = open.map_err(|e| refused("write", &name, e))?;
        match lock.try_lock() {
            Ok(()) => Ok(Self { path: path.to_owned(), lock }),
            Err(TryLockError::WouldBlock) => Err(SweepError::InUse { folder: path.to_owned() }),
            Err(TryLockError::Error(e)) => Err(refused("lock", &name, e)),
        }
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// A file under its name once it is whole.
    pub(crate) fn put(&self, name: &str, text: &str) -> Result<(), SweepError> {
        let place = self.path.join(name);
        let staged = self.path.join(format!(".{name}.{}", std::process::id()));
        let write = || {
            let mut file = File::create(&staged)?;
            file.write_all(text.as_bytes())?;
            file.sync_all()?;
            fs::rename(&staged, &place)
        };
        write().map_err(|e| {
            // What is half written is of no use to anyone.
            let _ = fs::remove_file(&staged);
            refused("write", &place, e)
        })
    }

    /// Remove what writers that were killed left half written.
    pub(crate) fn clear_up(&self) {
        let Ok(entries) = fs::read_dir(&self.path) else { return };
        for path in entries.filter_map(|entry| Some(entry.ok()?.path())) {
            let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
            if name.starts_with('.') && name.contains(".json") {
                // It does no harm where it stays.
                let _ = fs::remove_file(&path);
            }
        }
    }
}

impl Drop for OwnedFolder {
    /// Closing the file is not enough: a process that is being started holds a copy of every open file
    /// until it begins, and with it the lock.
    fn drop(&mut self) {
        // What cannot be let go of is let go of when the process ends.
        let _ = self.lock.unlock();
    }
}

fn refused(doing: &'static str, path: &Path, source: io::Error) -> SweepError {
    SweepError::File { doing, path: path.to_owned(), source }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_copy_of_the_open_file_holds_nobody_up_once_the_folder_is_given_back() {
        let place = tempfile::tempdir().expect("a place");
        let owned = OwnedFolder::take(place.path()).expect("it is free");
        // What a process has that is being started while the folder is given back.
        let copy = owned.lock.try_clone().expect("a copy");
        drop(owned);
        OwnedFolder::take(place.path()).expect("it was given back");
        drop(copy);
    }
}
