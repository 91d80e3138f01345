//! What a mission asks of its own actuators, which sets that are laid over it do not have.

use crate::sets::put;
use toml::Table;
use wrasse_document::{Document, Step, at};

/// What only some units can do, as paths: a set that can asks for it itself.
const ONLY_SOME: [&[&str]; 3] = [
    &["control", "position_hold"],
    &["control", "steering", "unloading"],
    &["control", "steering", "preferred_for"],
];

/// A mission without what only its own actuators can do, in its common part and in the rows that it
/// compares; and what was taken from the common part.
pub(crate) fn without_own_units(mission: &Document) -> (Document, Table) {
    let (mut left, mut own) = (mission.clone(), Table::new());
    for path in ONLY_SOME {
        let keys: Vec<Step<'_>> = path.iter().map(|key| Step::Key(key)).collect();
        if let Some(value) = mission.value(&keys) {
            put(&mut own, path, value);
        }
        left = left.without(&keys);
        for axis in 0..mission.len(at!["compare"]) {
            for row in 0..mission.len(at!["compare", axis, "row"]) {
                let set: &[Step<'_>] = at!["compare", axis, "row", row, "set"];
                left = left.without(&[set, &keys].concat());
            }
        }
    }
    (left, own)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn document(text: &str) -> Document {
        Document::parse("m.toml", text).unwrap_or_else(|found| panic!("{found:?}"))
    }

    #[test]
    fn what_only_some_units_can_do_is_taken_away_wherever_it_stands() {
        let text = "name = \"m\"\ncontrol = { position_hold = { bandwidth_rad_s = 1.0 }, law = \"x\" }\n\
                    [[compare]]\naxis = \"a\"\n[[compare.row]]\nname = \"r\"\n\
                    set.control.steering.preferred_for = [1.0, 0.0, 0.0]\nset.seed = 3\n";
        let (left, own) = without_own_units(&document(text));
        let row = at!["compare", 0, "row", 0, "set", "control", "steering", "preferred_for"];
        assert_eq!(left.value(at!["control", "position_hold"]), None);
        assert_eq!(left.value(row), None);
        assert!(own["control"]["position_hold"].is_table(), "{own}");
        assert_eq!(left.value(at!["control", "law"]), Some("x".into()));
        assert_eq!(left.value(at!["compare", 0, "row", 0, "set", "seed"]), Some(3.into()));
    }

    #[test]
    fn a_mission_that_asks_for_nothing_of_the_kind_stays_as_it_is() {
        let mission = document("# A comment.\nname   = \"m\"\n");
        let (left, own) = without_own_units(&mission);
        assert!(own.is_empty() && left.canonical(&[]) == mission.canonical(&[]));
    }
}
