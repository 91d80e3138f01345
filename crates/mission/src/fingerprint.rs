//! What tells one mission from another, as far as it decides what comes of a flight.

use crate::mission::Mission;
use sha2::{Digest, Sha256};
use std::fmt::Write;
use wrasse_document::Document;
use wrasse_vehicle::{Vehicle, hardware_texts};

/// Keys of a file that change nothing of what is flown.
pub(crate) const WORDS: [&str; 3] = ["name", "summary", "output"];

impl Mission {
    /// SHA-256 of the canonical documents of mission, vehicles and hardware catalogue, in hexadecimal. Names,
    /// words, comments and the places of files do not count.
    pub fn fingerprint(&self) -> String {
        let mut all = Sha256::new();
        let mut add = |text: &str| {
            all.update(text.as_bytes());
            all.update([0]);
        };
        add(&self.canonical);
        let mut seen: Vec<&str> = vec![];
        let vehicles = self.cases.iter().map(|case| -> &Vehicle { &case.vehicle });
        for (_, text) in vehicles.flat_map(Vehicle::files) {
            if !seen.contains(&text) {
                seen.push(text);
                add(&canonical(text));
            }
        }
        hardware_texts().for_each(|text| add(&canonical(text)));
        hexadecimal(&all.finalize())
    }
}

/// SHA-256 of a text, in hexadecimal: what `sha256sum` says of its file.
pub fn sha256(text: &str) -> String {
    hexadecimal(&Sha256::digest(text.as_bytes()))
}

fn hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().fold(String::new(), |mut text, byte| {
        // Writing into a string cannot fail.
        let _ = write!(text, "{byte:02x}");
        text
    })
}

/// A TOML text in its one form; any other, a URDF or MJCF, as it is.
fn canonical(text: &str) -> String {
    Document::parse("", text).map_or_else(|_| text.to_owned(), |found| found.canonical(&WORDS))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// FIPS 180-4, the example of the one-block message.
    #[test]
    fn the_hash_is_sha256() {
        let of_abc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
        assert_eq!(sha256("abc"), of_abc);
    }
}
