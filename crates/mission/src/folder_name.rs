//! Whether a name can be that of a folder, on every file system.

use wrasse_document::UNKNOWN;

/// Most characters: with what is put behind it, a folder's name stays within the 255 bytes that file
/// systems take, and a path within the 260 of Windows.
const LONGEST: usize = 100;

/// Names that Windows keeps for devices, with any ending and in any case.
const DEVICES: [&str; 4] = ["con", "prn", "aux", "nul"];

/// What keeps a name from being that of a folder, and how to mend it.
pub(crate) fn wrong_with_folder_name(name: &str) -> Option<(String, &'static str)> {
    let plain = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
    let help = "use letters, digits, dashes and underscores";
    if name == UNKNOWN {
        None
    } else if name.is_empty() {
        Some(("it is empty".into(), help))
    } else if let Some(odd) = name.chars().find(|c| !plain(*c)) {
        Some((format!("found {odd:?} in {name:?}"), help))
    } else if name.len() > LONGEST {
        let message = format!("it has {} characters, at most {LONGEST} fit", name.len());
        Some((message, "shorten it, and say the rest in `summary`"))
    } else if is_device(&name.to_ascii_lowercase()) {
        let message = format!("Windows keeps {name:?} for a device");
        Some((message, "add a word to it"))
    } else {
        None
    }
}

/// Whether a name in small letters is that of a device: `nul`, or a port such as `com1`.
fn is_device(name: &str) -> bool {
    let port = ["com", "lpt"].iter().find_map(|port| name.strip_prefix(port));
    DEVICES.contains(&name)
        || port.is_some_and(|n| n.len() == 1 && n.as_bytes()[0].is_ascii_digit())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_that_some_file_system_does_not_take_is_refused() {
        let long = "a".repeat(101);
        for name in [
            "", "CON", "nul", "Aux", "PRN", "com1", "LPT9", "a.", "..", "a/b", "a\\b", "a b",
            "a\0", "ä", "a:", &long,
        ] {
            assert!(wrong_with_folder_name(name).is_some(), "{name:?}");
        }
        for name in ["a", "CON-1", "console", "com10", "lpt", "-", "a_b-C9", &long[1..]] {
            assert_eq!(wrong_with_folder_name(name), None, "{name:?}");
        }
    }
}
