//! A document in one form, whatever its author's spaces, comments, order of keys and way to write a number:
//! two texts that say the same have the same one.

use crate::document::Document;
use crate::positioned::{Table, Value};
use std::fmt::Write;

impl Document {
    /// The document as JSON without spaces, keys in alphabetical order, every number as the shortest
    /// decimal that gives its `f64` again (whole numbers beyond 2⁵³ digit by digit); without these keys of
    /// its uppermost table.
    pub fn canonical(&self, without: &[&str]) -> String {
        let mut text = String::new();
        let told = |key: &&str| without.contains(key);
        write_table(&mut text, self.root(), &|key| told(&key));
        text
    }
}

fn write_table(text: &mut String, table: &Table, leaves_out: &dyn Fn(&str) -> bool) {
    text.push('{');
    let mut first = true;
    for (key, entry) in table.iter().filter(|(key, _)| !leaves_out(key)) {
        if !std::mem::take(&mut first) {
            text.push(',');
        }
        write_string(text, key);
        text.push(':');
        write_value(text, &entry.item.value);
    }
    text.push('}');
}

fn write_value(text: &mut String, value: &Value) {
    // Writing into a string cannot fail.
    let _ = match value {
        Value::String(word) => {
            write_string(text, word);
            Ok(())
        }
        #[allow(clippy::cast_possible_truncation, reason = "it is compared with what it was")]
        Value::Integer(i) if (*i as f64) as i64 == *i => write!(text, "{:?}", *i as f64),
        Value::Integer(i) => write!(text, "{i}"),
        Value::Float(x) => write!(text, "{x:?}"),
        Value::Boolean(yes) => write!(text, "{yes}"),
        Value::Datetime(date) => write!(text, "\"{date}\""),
        Value::Array(items) => {
            text.push('[');
            for (i, item) in items.iter().enumerate() {
                if i > 0 {
                    text.push(',');
                }
                write_value(text, &item.value);
            }
            text.push(']');
            Ok(())
        }
        Value::Table(table) => {
            write_table(text, table, &|_| false);
            Ok(())
        }
    };
}

fn write_string(text: &mut String, word: &str) {
    text.push_str(&serde_json::Value::from(word).to_string());
}

#[cfg(test)]
mod tests {
    use super::*;

    fn canonical(text: &str) -> String {
        Document::parse("a.toml", text).expect("it is TOML").canonical(&["name"])
    }

    #[test]
    fn what_says_the_same_has_one_form() {
        let plain = "name = \"a\"\nx = 1\n[t]\nb = [1.0, 2.5e0]\na = \"\\u0041\\\"\"\n";
        let other = "# told anew\nname=\"b\"\nt = { a = 'A\"', b = [ 1, 2.50 ] }\nx = 1.0\n";
        assert_eq!(canonical(plain), "{\"t\":{\"a\":\"A\\\"\",\"b\":[1.0,2.5]},\"x\":1.0}");
        assert_eq!(canonical(other), canonical(plain));
    }

    #[test]
    fn what_says_something_else_has_another_form() {
        let forms = [
            "x = 1",
            "x = 2",
            "y = 1",
            "x = \"1\"",
            "x = [1]",
            "x = true",
            "x = 1.0000000000000002",
            "x = -0.0",
            "x = 0.0",
            "x = 9007199254740993",
            "x = 9007199254740992",
            "x = [[1], 2]",
            "x = [[1, 2]]",
            "x = {}",
            "",
        ]
        .map(canonical);
        for (i, form) in forms.iter().enumerate() {
            assert!(!forms[..i].contains(form), "{form}");
        }
    }
}
