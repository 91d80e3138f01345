//! Whatever is given beside a file is laid over it, or is a complaint that can be drawn.
#![allow(clippy::unwrap_used, reason = "a test may stop where it finds nothing")]

use proptest::prelude::*;
use wrasse_document::{Document, Setting, render};

const TEXT: &str =
    "name = \"m\"\nlist = [1, 2]\n[[phase]]\nname = \"reach\"\nt_s = 3\n[table]\nx = 1\n";

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn any_text_is_laid_over_a_document_or_complained_of(
        path in prop_oneof![
            ".{0,12}",
            "(name|list|phase|table|[a-zä]{1,3})(\\[(0|1|2|reach|\"r\")\\]|\\.(x|t_s|\"q\")){0,3}",
        ],
        value in prop_oneof![".{0,12}", "[0-9.e+\\-]{1,5}", "[\\[\\]{}=,a1\"' ]{0,8}"],
    ) {
        let document = Document::parse("m.toml", TEXT).unwrap();
        match Setting::parse(&format!("{path}={value}")) {
            Err(complaint) => prop_assert!(render(&[*complaint], false).contains("--set")),
            Ok(setting) => match document.with_settings(&[setting]) {
                Err(complaints) => prop_assert!(render(&complaints, false).contains("--set")),
                Ok(laid) => {
                    let paths = laid.set_paths();
                    let complaints = paths.iter().map(|path| laid.error(path, "odd", "here"));
                    let complaints: Vec<_> = complaints.collect();
                    prop_assert!(render(&complaints, false).contains("--set"));
                }
            },
        }
    }
}
