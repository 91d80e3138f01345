//! The schemas that editors get accept what is shipped, and refuse what is misspelt.
#![allow(clippy::unwrap_used, reason = "a test may stop where it finds nothing")]

mod binary;

use binary::{Folder, files};
use serde_json::Value;
use std::fs;
use std::path::Path;

fn schema(format: &str) -> Value {
    let said = Folder::new().wrasse(&["schema", format]);
    assert_eq!((said.code, said.err.as_str()), (0, ""));
    serde_json::from_str(&said.out).unwrap()
}

fn document(file: &Path) -> Value {
    let table: toml::Table = toml::from_str(&fs::read_to_string(file).unwrap()).unwrap();
    serde_json::to_value(table).unwrap()
}

/// Whether a value fits a schema, as far as types, keys, words and references go; `Err` says where
/// it does not.
fn fits(whole: &Value, schema: &Value, value: &Value, path: &str) -> Result<(), String> {
    if let Some(pointer) = schema["$ref"].as_str() {
        let target = whole.pointer(pointer.strip_prefix('#').unwrap()).unwrap();
        return fits(whole, target, value, path);
    }
    for choice in ["anyOf", "oneOf"] {
        if let Some(options) = schema[choice].as_array() {
            let tried = options.iter().map(|option| fits(whole, option, value, path));
            let mut why = vec![];
            for one in tried {
                match one {
                    Ok(()) => return Ok(()),
                    Err(because) => why.push(because),
                }
            }
            return Err(why.join("; "));
        }
    }
    let is = |kind: &str| match kind {
        "object" => value.is_object(),
        "array" => value.is_array(),
        "string" => value.is_string(),
        "number" => value.is_number(),
        "integer" => value.is_i64() || value.is_u64(),
        "boolean" => value.is_boolean(),
        "null" => value.is_null(),
        other => panic!("the type {other} is new to this test"),
    };
    let kinds: Vec<&str> = match &schema["type"] {
        Value::String(kind) => vec![kind],
        Value::Array(kinds) => kinds.iter().map(|kind| kind.as_str().unwrap()).collect(),
        _ => vec![],
    };
    if !kinds.is_empty() && !kinds.iter().any(|kind| is(kind)) {
        return Err(format!("{path}: {value} is not of type {kinds:?}"));
    }
    let words =
        schema["enum"].as_array().cloned().or_else(|| Some(vec![schema.get("const")?.clone()]));
    if words.is_some_and(|words| !words.contains(value)) {
        return Err(format!("{path}: {value} is not one of the words"));
    }
    match value {
        Value::Array(items) => items
            .iter()
            .enumerate()
            .filter_map(|(i, item)| Some((i, item, schema.get("items")?)))
            .try_for_each(|(i, item, of)| fits(whole, of, item, &format!("{path}[{i}]"))),
        Value::Object(_) => table_fits(whole, schema, value, path),
        _ => Ok(()),
    }
}

fn table_fits(whole: &Value, schema: &Value, value: &Value, path: &str) -> Result<(), String> {
    for key in schema["required"].as_array().into_iter().flatten() {
        if value.get(key.as_str().unwrap()).is_none() {
            return Err(format!("{path}: {key} is missing"));
        }
    }
    for (key, item) in value.as_object().unwrap() {
        let path = format!("{path}.{key}");
        match (schema["properties"].get(key), &schema["additionalProperties"]) {
            (Some(property), _) => fits(whole, property, item, &path)?,
            (None, Value::Bool(false)) => return Err(format!("{path} is not a key")),
            (None, any) => fits(whole, any, item, &path)?,
        }
    }
    Ok(())
}

#[test]
fn a_schema_says_what_draft_it_is_of_and_what_each_key_means() {
    for format in ["vehicle", "mission"] {
        let schema = schema(format);
        assert!(schema["$schema"].as_str().unwrap().contains("2020-12"), "{format}");
        for (key, property) in schema["properties"].as_object().unwrap() {
            let said = property["description"].as_str().unwrap_or_default();
            assert!(said.len() > 5, "{format}: nothing is said about {key}");
        }
    }
}

#[test]
fn the_schemas_accept_every_file_that_is_shipped() {
    for (format, folder) in [("vehicle", "vehicles"), ("mission", "missions")] {
        let schema = schema(format);
        for file in files(folder, &["toml"]) {
            if let Err(why) = fits(&schema, &schema, &document(&file), "") {
                panic!("{}: {why}", file.display());
            }
        }
    }
}

#[test]
fn the_schemas_refuse_a_misspelt_key_a_wrong_type_and_a_missing_name() {
    for (format, folder) in [("vehicle", "vehicles"), ("mission", "missions")] {
        let schema = schema(format);
        let good = document(&files(folder, &["toml"])[0]);
        let refuses = |change: &dyn Fn(&mut Value)| {
            let mut bad = good.clone();
            change(&mut bad);
            fits(&schema, &schema, &bad, "").is_err()
        };
        assert!(refuses(&|file| file["nmae"] = "x".into()), "{format}");
        assert!(refuses(&|file| file["name"] = 3.into()), "{format}");
        assert!(refuses(&|file| drop(file.as_object_mut().unwrap().remove("name"))), "{format}");
    }
    let schema = schema("mission");
    let mut bad = document(&files("missions", &["toml"])[0]);
    bad["control"]["arm_law"] = "terestrial".into();
    assert!(fits(&schema, &schema, &bad, "").is_err());
}

#[test]
fn the_keys_of_a_format_are_printed_with_unit_default_and_words() {
    let said = Folder::new().wrasse(&["schema", "mission", "--keys"]);
    assert_eq!((said.code, said.err.as_str()), (0, ""));
    let control = said.out.split("\n[control]\n").nth(1).unwrap().split("\n[").next().unwrap();
    assert!(control.contains("\n  rate_hz, Hz, default 100\n      Control periods per second\n"));
    assert!(
        control.contains("= \"terrestrial\": Bolted to the ground; \"attitude-held\""),
        "{control}"
    );
    assert!(said.out.contains("\n  mass_kg, kg, required\n"), "{}", said.out);
}
