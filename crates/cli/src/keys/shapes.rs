//! What a schema allows for one value, in words.

use serde_json::Value as Schema;

/// A format's schema, with the definitions that it refers to.
#[derive(Clone, Copy)]
pub(super) struct Format<'s>(pub(super) &'s Schema);

impl<'s> Format<'s> {
    /// The name of the definition that a schema refers to, if it does, and the schema that is meant.
    pub(super) fn resolved(self, schema: &'s Schema) -> (Option<&'s str>, &'s Schema) {
        let (mut name, mut schema) = (None, schema);
        while let Some(pointer) = schema["$ref"].as_str().and_then(|r| r.strip_prefix('#')) {
            let Some(target) = self.0.pointer(pointer) else { break };
            name = pointer.rsplit('/').next();
            schema = target;
        }
        (name, schema)
    }

    /// The shapes that a schema allows, without the null of an optional key.
    pub(super) fn options(self, schema: &'s Schema) -> Vec<&'s Schema> {
        let (_, schema) = self.resolved(schema);
        match schema["oneOf"].as_array().or_else(|| schema["anyOf"].as_array()) {
            Some(options) => options.iter().flat_map(|option| self.options(option)).collect(),
            None if schema["type"] == "null" => vec![],
            None => vec![schema],
        }
    }

    /// What a value may be: a type, its range, its words with their meaning.
    pub(super) fn value(self, schema: &'s Schema) -> String {
        let options = self.options(schema);
        let all: Vec<String> = options.iter().map(|option| self.option(option)).collect();
        let words = options.iter().all(|option| word(option).is_some());
        all.join(if words { "; " } else { " or " })
    }

    fn option(self, schema: &'s Schema) -> String {
        if let Some(word) = word(schema) {
            let meaning = meaning(schema);
            let about = if meaning.is_empty() { String::new() } else { format!(": {meaning}") };
            return format!("`\"{word}\"`{about}");
        }
        if let Some(words) = schema["enum"].as_array() {
            return words.iter().map(|word| format!("`{word}`")).collect::<Vec<_>>().join("; ");
        }
        match kind(schema) {
            "array" => self.list(schema),
            "object" => self.table(schema),
            "number" | "integer" => format!("{}{}", kind(schema), range(schema)),
            "boolean" => "`true` or `false`".into(),
            other => other.to_owned(),
        }
    }

    fn list(self, schema: &'s Schema) -> String {
        let (least, most) = (schema["minItems"].as_u64(), schema["maxItems"].as_u64());
        let of = self.value(&schema["items"]);
        match (least, most) {
            (Some(a), Some(b)) if a == b => format!("{a} × {of}"),
            _ => format!("list of {of}"),
        }
    }

    fn table(self, schema: &'s Schema) -> String {
        if let Some(of) = schema.get("additionalProperties").filter(|of| of.is_object()) {
            return format!("{} for each NAME", self.value(of));
        }
        match only_key(schema) {
            Some((key, of)) => {
                let value = self.value(of);
                let of =
                    if value.contains('`') || value.contains("for each") { "…" } else { &value };
                format!("`{{ {key} = {of} }}`")
            }
            None => "table".into(),
        }
    }
}

/// The word that a string must be.
fn word(schema: &Schema) -> Option<&str> {
    schema["const"].as_str()
}

/// The key of a table that has one only, and needs it.
pub(super) fn only_key(schema: &Schema) -> Option<(&str, &Schema)> {
    let properties = schema["properties"].as_object().filter(|all| all.len() == 1)?;
    let required = schema["required"].as_array().is_some_and(|all| all.len() == 1);
    properties.iter().next().filter(|_| required).map(|(key, of)| (key.as_str(), of))
}

/// The type, without the null of an optional key.
pub(super) fn kind(schema: &Schema) -> &str {
    match &schema["type"] {
        Schema::Array(several) => {
            several.iter().filter_map(Schema::as_str).find(|t| *t != "null").unwrap_or("any")
        }
        only => only.as_str().unwrap_or("any"),
    }
}

/// The range of a number, behind its type.
fn range(schema: &Schema) -> String {
    let bounds =
        [("minimum", "≥"), ("exclusiveMinimum", ">"), ("maximum", "≤"), ("exclusiveMaximum", "<")];
    // That a count is not negative needs no word.
    let counts = |key: &str| {
        key == "minimum" && schema["format"].as_str().is_some_and(|f| f.starts_with("uint"))
    };
    let told = bounds.iter().filter_map(|(key, sign)| {
        let bound = schema[*key].as_f64()?;
        (!counts(key) || bound > 0.0).then(|| format!("{sign} {bound}"))
    });
    let told: Vec<String> = told.collect();
    if told.is_empty() { String::new() } else { format!(" {}", told.join(", ")) }
}

/// A description on one line, without its last full stop.
pub(super) fn meaning(schema: &Schema) -> String {
    let text = schema["description"].as_str().unwrap_or_default();
    let first = text.split("\n\n").next().unwrap_or_default();
    first.split_whitespace().collect::<Vec<_>>().join(" ").trim_end_matches('.').to_owned()
}
