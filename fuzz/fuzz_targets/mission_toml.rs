//! Any text as a mission file, its `[study]` and its `[[disperse]]` included: a mission or complaints,
//! and complaints that can be drawn.
#![no_main]

use libfuzzer_sys::fuzz_target;
use wrasse_document::render;
use wrasse_mission::read_mission;

fuzz_target!(|text: &str| {
    if let Err(complaints) = read_mission("fuzz.toml", text) {
        assert!(!complaints.is_empty(), "refused without a word");
        render(&complaints, false);
    }
});
