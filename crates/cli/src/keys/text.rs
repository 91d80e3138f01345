//! The tables of a format as text: for a terminal, and as a page of the book.

use super::tables::tables;
#[cfg(test)]
use super::{KeyRow, KeyTable};
use serde_json::Value as Schema;

/// The columns of a terminal.
const WIDTH: usize = 80;

/// All keys of a format, for a terminal of 80 columns.
pub(crate) fn terminal(schema: &Schema) -> String {
    let plain = |text: &str| text.replace('`', "");
    let mut lines = vec![];
    for table in tables(schema) {
        let head = if table.path.is_empty() { "At the top of the file" } else { &table.path };
        lines.push(head.to_owned());
        push_wrapped(&mut lines, 2, &plain(&table.meaning));
        for row in &table.rows {
            let unit = if row.unit.is_empty() { String::new() } else { format!(", {}", row.unit) };
            let left_out = match row.default.shown() {
                "-" => String::new(),
                "required" => ", required".to_owned(),
                value => format!(", default {value}"),
            };
            lines.push(String::new());
            push_wrapped(&mut lines, 2, &format!("{}{unit}{left_out}", row.key));
            push_wrapped(&mut lines, 6, &plain(&row.meaning));
            push_wrapped(&mut lines, 6, &format!("= {}", plain(&row.value)));
        }
        lines.push(String::new());
    }
    lines.join("\n")
}

/// A text cut into lines that begin with so many spaces.
fn push_wrapped(lines: &mut Vec<String>, indent: usize, text: &str) {
    let mut line = " ".repeat(indent);
    for word in text.split(' ') {
        if line.chars().count() + word.chars().count() >= WIDTH && line.len() > indent {
            lines.push(line.trim_end().to_owned());
            line = " ".repeat(indent);
        }
        line.push_str(word);
        line.push(' ');
    }
    if line.len() > indent {
        lines.push(line.trim_end().to_owned());
    }
}

/// A page of the book: a head for each table.
#[cfg(test)]
fn page(format: &str, schema: &Schema) -> String {
    let mut page = format!(
        "# All keys of {format} files\n\nMade from what reads the file; `wrasse schema {format} --keys` \
         prints the same. [The guide]({format}_files.md) tells what the tables are for.\n\
         The end of a key says the unit of its numbers; – is a number without one. `NAME` stands for names \
         of your own.\n"
    );
    for table in tables(schema) {
        page.push_str(&section(&table));
    }
    page
}

#[cfg(test)]
fn section(table: &KeyTable) -> String {
    let head = match &*table.path {
        "" => "The top of the file".into(),
        path => format!("`{path}`"),
    };
    let rows: String = table.rows.iter().map(row_of).collect();
    let about = &table.meaning;
    let columns = "| key | meaning | unit | value | default |\n|---|---|---|---|---|\n";
    format!("\n## {head}\n\n{about}.\n\n{columns}{rows}")
}

#[cfg(test)]
fn row_of(row: &KeyRow) -> String {
    let default = match row.default.shown() {
        "-" => String::new(),
        "required" => "**required**".to_owned(),
        value => format!("`{value}`"),
    };
    let [meaning, value] = [&row.meaning, &row.value].map(|text| text.replace('|', "\\|"));
    format!("| `{}` | {meaning} | {} | {value} | {default} |\n", row.key, row.unit)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    /// The pages are those of the schemas. `WRASSE_WRITE_FIGURES=1` writes them.
    #[test]
    fn the_reference_pages_have_every_key_of_the_formats() {
        let guide = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../book/src/guide");
        for (format, schema) in [
            ("vehicle", wrasse_vehicle::vehicle_schema()),
            ("mission", wrasse_mission::mission_schema()),
        ] {
            let made = page(format, &schema);
            let path = guide.join(format!("reference_{format}.md"));
            if std::env::var_os("WRASSE_WRITE_FIGURES").is_some() {
                std::fs::write(&path, &made).expect("room for the page");
            }
            let there = std::fs::read_to_string(&path).unwrap_or_default();
            assert!(there == made, "{} is not what the schema says", path.display());
        }
    }

    #[test]
    fn a_terminal_of_80_columns_shows_every_line_whole() {
        for schema in [wrasse_vehicle::vehicle_schema(), wrasse_mission::mission_schema()] {
            let text = terminal(&schema);
            let long = text.lines().find(|line| line.chars().count() > WIDTH);
            assert_eq!(long, None);
            assert!(text.contains("\n  name, required\n"));
        }
    }

    /// Nothing in a schema is left out: each property of each definition that can be reached is a row.
    #[test]
    fn every_property_of_the_schemas_is_a_row() {
        for schema in [wrasse_vehicle::vehicle_schema(), wrasse_mission::mission_schema()] {
            let found = tables(&schema);
            let text = terminal(&schema);
            let definitions = schema["$defs"].as_object().expect("definitions").values();
            for definition in definitions.chain([&schema]) {
                for key in
                    definition["properties"].as_object().into_iter().flat_map(|all| all.keys())
                {
                    let has = |table: &KeyTable| table.rows.iter().any(|row| row.key == *key);
                    let inline = text.contains(&format!("{{ {key} ="));
                    assert!(found.iter().any(has) || inline, "no row for {key}");
                }
            }
        }
    }
}
