//! What is no file of a user, or too large for one.
#![cfg(unix)]

use std::path::Path;
use std::process::Command;
use wrasse_document::{Unreadable, read_text};

#[test]
fn what_is_no_file_is_refused_before_it_is_opened() {
    let folder = std::env::temp_dir().join(format!("wrasse-special-{}", std::process::id()));
    std::fs::create_dir(&folder).unwrap();
    let [pipe, socket, text] = ["pipe", "socket", "text"].map(|name| folder.join(name));
    assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    let _listener = std::os::unix::net::UnixListener::bind(&socket).unwrap();
    for path in [Path::new("/dev/zero"), &pipe, &socket] {
        assert!(matches!(read_text(path, 100), Err(Unreadable::NoFile)), "{path:?}");
    }
    assert!(matches!(read_text(&folder, 100), Err(Unreadable::Folder)));
    std::fs::write(&text, "four").unwrap();
    assert_eq!(read_text(&text, 4).unwrap(), "four");
    assert!(matches!(read_text(&text, 3), Err(Unreadable::Large { most: 3 })));
    // Says that it has no length, and has one.
    assert!(matches!(read_text(Path::new("/proc/self/maps"), 3), Err(Unreadable::Large { .. })));
    std::fs::write(&text, b"ab\xff").unwrap();
    assert!(matches!(read_text(&text, 4), Err(Unreadable::NotText { valid_up_to: 2 })));
    std::fs::remove_dir_all(&folder).unwrap();
}
