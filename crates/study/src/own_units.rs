//! What a mission asks of its own actuators, which sets that are laid over it do not have.

use crate::sets::put;
use toml::{Table, Value};

/// What only some units can do, as paths: a set that can asks for it itself.
const ONLY_SOME: [&[&str]; 3] = [
    &["control", "position_hold"],
    &["control", "steering", "unloading"],
    &["control", "steering", "preferred_for"],
];

/// The text of a mission without what only its own actuators can do, in its common part and in the rows
/// that it compares; and what was taken from the common part. A text that asks for nothing of the kind
/// stays as it is, so that complaints keep their lines; so does one that is no TOML.
pub(crate) fn without_own_units(text: &str) -> (String, Table) {
    let mut own = Table::new();
    let Ok(mut mission) = text.parse::<Table>() else { return (text.to_owned(), own) };
    let mut taken = clear(&mut mission, &mut own);
    for axis in tables(mission.get_mut("compare")) {
        for row in tables(axis.get_mut("row")) {
            if let Some(Value::Table(set)) = row.get_mut("set") {
                taken |= clear(set, &mut Table::new());
            }
        }
    }
    (if taken { mission.to_string() } else { text.to_owned() }, own)
}

/// The tables of a list of tables.
fn tables(list: Option<&mut Value>) -> impl Iterator<Item = &mut Table> {
    list.and_then(Value::as_array_mut).into_iter().flatten().filter_map(Value::as_table_mut)
}

/// Take away what only some units can do, into `own`; whether there was any.
fn clear(part: &mut Table, own: &mut Table) -> bool {
    let mut taken = false;
    for path in ONLY_SOME {
        let (last, way) = path.split_last().expect("no path is empty");
        let inner =
            way.iter().try_fold(&mut *part, |table, key| table.get_mut(*key)?.as_table_mut());
        if let Some(value) = inner.and_then(|table| table.remove(*last)) {
            taken = true;
            put(own, path, value);
        }
    }
    taken
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_only_some_units_can_do_is_taken_away_wherever_it_stands() {
        let text = "name = \"m\"\ncontrol = { position_hold = { bandwidth_rad_s = 1.0 }, law = \"x\" }\n\
                    [[compare]]\naxis = \"a\"\n[[compare.row]]\nname = \"r\"\n\
                    set.control.steering.preferred_for = [1.0, 0.0, 0.0]\nset.seed = 3\n";
        let (left, own) = without_own_units(text);
        assert!(!left.contains("position_hold") && !left.contains("preferred_for"), "{left}");
        assert!(own["control"]["position_hold"].is_table(), "{own}");
        assert!(left.contains("law = \"x\"") && left.contains("seed = 3"), "{left}");
    }

    #[test]
    fn a_text_that_asks_for_nothing_of_the_kind_stays_as_it_is() {
        let text = "# A comment.\nname   = \"m\"\n";
        assert_eq!(without_own_units(text).0, text);
        assert_eq!(without_own_units("no toml").0, "no toml");
    }
}
