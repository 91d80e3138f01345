//! Completions of shells and manual pages name every command.
#![allow(clippy::unwrap_used, reason = "a test may stop where it finds nothing")]

mod binary;

use binary::Folder;

/// The commands that the help lists.
fn commands(folder: &Folder) -> Vec<String> {
    let help = folder.wrasse(&["--help"]).out;
    let list = help.split("\nCommands:\n").nth(1).unwrap().split("\n\n").next().unwrap().to_owned();
    let begins = list.lines().filter(|line| line.starts_with("  ") && !line.starts_with("   "));
    let names: Vec<String> =
        begins.map(|line| line.split_whitespace().next().unwrap().to_owned()).collect();
    assert!(names.len() > 10, "{names:?}");
    names
}

#[test]
fn every_shell_is_told_every_command() {
    let folder = Folder::new();
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        let said = folder.wrasse(&["completions", shell]);
        assert_eq!((said.code, said.err.as_str()), (0, ""), "{shell}");
        for command in commands(&folder) {
            assert!(said.out.contains(&command), "{shell}: {command}");
        }
        assert!(said.out.contains("error-estimate"), "{shell}");
    }
    let said = folder.wrasse(&["completions", "csh"]);
    assert_eq!(said.code, 2);
    assert!(said.err.contains("bash"), "{}", said.err);
}

#[test]
fn bash_takes_what_is_printed_for_it() {
    let folder = Folder::new();
    folder.put("wrasse.bash", &folder.wrasse(&["completions", "bash"]).out);
    let asked = "source ./wrasse.bash; COMP_WORDS=(wrasse com); COMP_CWORD=1; _wrasse wrasse com; \
                 echo \"${COMPREPLY[@]}\"";
    let bash = std::process::Command::new("bash")
        .args(["--norc", "-c", asked])
        .current_dir(folder.path())
        .output();
    // Not every machine has that shell.
    let Ok(bash) = bash else { return };
    assert_eq!(String::from_utf8(bash.stdout).unwrap().trim(), "completions");
}

#[test]
fn there_is_a_manual_page_for_each_command() {
    let folder = Folder::new();
    let said = folder.wrasse(&["man"]);
    assert!(said.code == 0 && said.out.contains(".TH wrasse 1"), "{}", said.out);
    for _ in 0..2 {
        let said = folder.wrasse(&["man", "--out", "man/man1"]);
        assert_eq!((said.code, said.out.as_str()), (0, "written: man/man1\n"), "{}", said.err);
    }
    let pages = folder.names("man/man1");
    for command in commands(&folder).iter().filter(|command| *command != "help") {
        assert!(pages.contains(&format!("wrasse-{command}.1")), "{command}: {pages:?}");
    }
    folder.put("file", "");
    let said = folder.wrasse(&["man", "--out", "file"]);
    assert_eq!(said.code, 2);
    assert!(said.err.starts_with("error: file cannot be written"), "{}", said.err);
}
