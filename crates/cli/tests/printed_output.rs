//! What README and guide show of the first run is what it prints.

use std::path::Path;
use std::process::Command;

#[test]
fn the_readme_and_the_guide_show_what_the_first_run_prints() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let out = std::env::temp_dir().join(format!("wrasse-printed-{}", std::process::id()));
    let run = Command::new(env!("CARGO_BIN_EXE_wrasse"))
        .current_dir(&root)
        .args(["run", "missions/atlas-reach.toml", "--out"])
        .arg(&out)
        .output()
        .expect("the binary runs");
    let printed = String::from_utf8(run.stdout).expect("UTF-8");
    let printed = printed.replace(&*out.to_string_lossy(), "out/atlas-reach");
    std::fs::remove_dir_all(&out).expect("the results are there");
    for page in ["README.md", "book/src/guide/first_run.md"] {
        let text = std::fs::read_to_string(root.join(page)).expect("the page is there");
        let shown = text.split("```text\n").nth(1).and_then(|rest| rest.split("```").next());
        assert_eq!(shown, Some(printed.as_str()), "{page}");
    }
}
