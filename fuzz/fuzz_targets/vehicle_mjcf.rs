//! Any text as a vehicle file in MJCF: a vehicle or complaints, and complaints that can be drawn.
#![no_main]

use libfuzzer_sys::fuzz_target;
use wrasse_document::render;
use wrasse_vehicle::read_vehicle;

fuzz_target!(|text: &str| {
    if let Err(complaints) = read_vehicle("fuzz.mjcf", text) {
        assert!(!complaints.is_empty(), "refused without a word");
        render(&complaints, false);
    }
});
