//! Files that a command makes: whole or not at all, and never in place of another.

use crate::input::Failure;
use std::io::{ErrorKind, Write};
use std::path::Path;
use tempfile::Builder;

/// Put a text into a file that is not there yet. Its folder must be there.
pub(crate) fn put_new(file: &Path, text: &str) -> Result<(), Failure> {
    let refused = |why: &std::io::Error| {
        let file = file.display();
        Failure::Sentence(match why.kind() {
            ErrorKind::AlreadyExists => {
                format!(
                    "{file} is there already and stays as it is: give another name, or remove it"
                )
            }
            _ => format!("{file} cannot be written: {why}"),
        })
    };
    // Whatever is there, a broken link too, is not to be replaced.
    if file.symlink_metadata().is_ok() {
        return Err(refused(&ErrorKind::AlreadyExists.into()));
    }
    let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty());
    let written = || -> std::io::Result<()> {
        let mut beside = like_any_file(Builder::new().prefix(".wrasse-"))
            .tempfile_in(folder.unwrap_or(Path::new(".")))?;
        beside.write_all(text.as_bytes())?;
        beside.as_file().sync_all()?;
        beside.persist_noclobber(file).map_err(|error| error.error)?;
        Ok(())
    };
    written().map_err(|why| refused(&why))
}

/// With the rights that any new file has, within what the user's mask leaves.
#[cfg(unix)]
fn like_any_file<'a, 'b, 'c>(builder: &'c mut Builder<'a, 'b>) -> &'c mut Builder<'a, 'b> {
    use std::os::unix::fs::PermissionsExt;
    builder.permissions(std::fs::Permissions::from_mode(0o666))
}
#[cfg(not(unix))]
fn like_any_file<'a, 'b, 'c>(builder: &'c mut Builder<'a, 'b>) -> &'c mut Builder<'a, 'b> {
    builder
}
