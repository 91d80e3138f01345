//! "Did you mean": the nearest of the words that would have been right.

use strsim::damerau_levenshtein;

/// Unit endings of keys: a key without its unit, or with another one, still finds its match.
const UNITS: [&str; 24] = [
    "kg", "g", "m", "mm", "cm", "km", "deg", "rad", "s", "ms", "n", "nm", "nms", "kgm2", "hz", "j",
    "w", "mps", "m2", "m3", "s2", "s3", "min", "h",
];

/// The word nearest to `word`, if one is near enough to be what was meant.
///
/// Case and the kind of dash do not count, and a key without its unit finds the key with it: `mass`
/// is near to `mass_kg`.
pub fn closest<'a>(word: &str, among: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let word = plain(word);
    let near = |candidate: &'a str| {
        let other = plain(candidate);
        let letters = damerau_levenshtein(&word, &other);
        let stems = damerau_levenshtein(stem(&word), stem(&other));
        // A slip of the pen, or the right name with no unit or another one.
        let distance = letters.min(stems + usize::from(letters > stems));
        let allowed = if stem(&word).chars().count() < 4 { 1 } else { 2 };
        (distance <= allowed).then_some((distance, letters, candidate))
    };
    among.into_iter().filter_map(near).min().map(|(_, _, candidate)| candidate)
}

/// Small letters and one kind of dash.
fn plain(word: &str) -> String {
    word.to_lowercase().replace(['-', ' '], "_")
}

/// The key without its unit: `rate` of `rate_deg_s`.
fn stem(key: &str) -> &str {
    match key.rsplit_once('_') {
        Some((front, unit)) if !front.is_empty() && UNITS.contains(&unit) => stem(front),
        _ => key,
    }
}

/// Whether two keys differ in their unit only.
pub(crate) fn differ_in_unit(key: &str, other: &str) -> bool {
    let (key, other) = (plain(key), plain(other));
    key != other && stem(&key) == stem(&other)
}

#[cfg(test)]
mod tests {
    use super::*;

    const KEYS: [&str; 5] = ["mass_kg", "position_m", "rate_deg_s", "travel_deg", "name"];

    #[test]
    fn a_slip_of_the_pen_finds_its_word() {
        assert_eq!(closest("naem", KEYS), Some("name"));
        assert_eq!(closest("postion_m", KEYS), Some("position_m"));
        assert_eq!(closest("Mass-kg", KEYS), Some("mass_kg"));
    }
    #[test]
    fn a_key_without_its_unit_or_with_another_finds_the_key_with_it() {
        assert_eq!(closest("mass", KEYS), Some("mass_kg"));
        assert_eq!(closest("rate", KEYS), Some("rate_deg_s"));
        assert_eq!(closest("travel_rad", KEYS), Some("travel_deg"));
        assert_eq!(closest("position_mm", KEYS), Some("position_m"));
        assert!(differ_in_unit("mass", "mass_kg") && !differ_in_unit("naem", "name"));
    }
    #[test]
    fn a_foreign_word_finds_nothing() {
        assert_eq!(closest("colour", KEYS), None);
        assert_eq!(closest("", KEYS), None);
        assert_eq!(closest("x", ["w", "ab"]), Some("w"));
    }
}
