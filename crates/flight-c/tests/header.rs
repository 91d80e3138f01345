//! The header is that of the library.
#![allow(clippy::unwrap_used, reason = "a test may stop where it finds nothing")]

use cbindgen::{Builder, Config, DocumentationStyle, Language, Style};
use std::path::Path;
use std::{env, fs};

const PREAMBLE: &str = "\
/* The control period of wrasse for flight software in C. Made from crates/flight-c by its tests; edit
   that, then: WRASSE_WRITE=1 cargo test -p wrasse-flight-c

   SI units and radians. Angular part first, in every vector of six. Inertial axes are those of the
   navigation; base axes are fixed to the spacecraft's base, whose origin is that of its body.
   Quaternions are w, x, y, z and turn components in base (or tool) axes into those of the motion.

   No function takes memory from a heap or keeps a pointer. */
";

/// The header, made anew.
fn header() -> String {
    let crate_folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let config = Config {
        language: Language::C,
        style: Style::Both,
        include_guard: Some("WRASSE_FLIGHT_H".to_owned()),
        header: Some(PREAMBLE.trim_end().to_owned()),
        cpp_compat: true,
        documentation_style: DocumentationStyle::C99,
        usize_is_size_t: true,
        line_length: 100,
        ..Config::default()
    };
    let mut builder = Builder::new().with_config(config);
    for file in ["complaint", "robot_table", "laws_table", "period_data", "boundary"] {
        builder = builder.with_src(crate_folder.join("src").join(format!("{file}.rs")));
    }
    let mut text = Vec::new();
    builder.generate().unwrap().write(&mut text);
    String::from_utf8(text).unwrap()
}

#[test]
fn the_committed_header_is_that_of_the_library() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../include/wrasse_flight.h");
    let text = header();
    if env::var_os("WRASSE_WRITE").is_some() {
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(&path, &text).unwrap();
    }
    let found = fs::read_to_string(&path).unwrap_or_default();
    assert!(
        found == text,
        "include/wrasse_flight.h is out of date: WRASSE_WRITE=1 cargo test -p wrasse-flight-c"
    );
}

/// Units are said: each field and constant has its comment.
#[test]
fn every_declaration_of_the_header_is_explained() {
    let text = header();
    let mut explained = false;
    for line in text.lines().map(str::trim) {
        let declares = line.starts_with("#define WRASSE_") && !line.ends_with("WRASSE_FLIGHT_H")
            || (line.ends_with(';') && !line.starts_with('}') && !line.starts_with("typedef"));
        let continued = line.contains(')') && !line.contains('(');
        assert!(!declares || explained || continued, "no comment before `{line}`");
        explained = line.starts_with("//") || line.starts_with('*') || line.ends_with("*/");
    }
}
