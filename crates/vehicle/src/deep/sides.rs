//! Names of the left and of the right.

/// Words and letters that say a side.
const SIDES: [(&str, &str); 6] = [
    ("left", "right"),
    ("Left", "Right"),
    ("LEFT", "RIGHT"),
    ("l", "r"),
    ("L", "R"),
    ("lft", "rgt"),
];

/// The name of the right one that a name of the left one has; `None` of a name without a side.
///
/// `left` and `right` count within a word; a single letter counts between the ends of the name and
/// marks that are no letters: `l_elbow`, `wrist_l`, `arm-L1`.
pub(super) fn right_of(name: &str) -> Option<String> {
    SIDES.iter().find_map(|(left, right)| {
        let is_word = left.len() == 4;
        let (at, _) = name.match_indices(left).find(|(at, _)| {
            let is_letter = |c: Option<char>| c.is_some_and(char::is_alphabetic);
            let alone = !is_letter(name[..*at].chars().next_back())
                && !is_letter(name[at + left.len()..].chars().next());
            is_word || alone
        })?;
        Some(format!("{}{right}{}", &name[..at], &name[at + left.len()..]))
    })
}

#[cfg(test)]
mod tests {
    use super::right_of;

    #[test]
    fn a_side_is_a_word_or_a_letter_that_stands_alone() {
        for (left, right) in [
            ("left_arm", "right_arm"),
            ("armLeft2", "armRight2"),
            ("l_elbow", "r_elbow"),
            ("wrist-L", "wrist-R"),
            ("l1", "r1"),
        ] {
            assert_eq!(right_of(left).as_deref(), Some(right));
        }
        for name in ["elbow", "right_arm", "tool", "Ll", ""] {
            assert_eq!(right_of(name), None, "{name}");
        }
    }
}
