//! Any text as the states of `wrasse eval`: questions or complaints, and complaints that can be drawn.
#![no_main]
#![allow(non_snake_case, dead_code, unused_imports)]

#[path = "../../crates/cli/src/eval_answer.rs"]
mod eval_answer;
#[path = "../../crates/cli/src/eval_question.rs"]
mod eval_question;

use libfuzzer_sys::fuzz_target;
use std::path::Path;
use std::sync::LazyLock;
use wrasse_document::render;
use wrasse_vehicle::{Vehicle, find_vehicle};

static VEHICLE: LazyLock<Vehicle> =
    LazyLock::new(|| find_vehicle("atlas-class", None).expect("it is in the catalogue"));

fuzz_target!(|text: &str| {
    match eval_question::questions(Path::new("fuzz.json"), text.to_owned(), &VEHICLE) {
        Ok((frame, questions)) => {
            eval_answer::answer(&VEHICLE, &frame, &questions);
        }
        Err(complaints) => {
            assert!(!complaints.is_empty(), "refused without a word");
            render(&complaints, false);
        }
    }
});
