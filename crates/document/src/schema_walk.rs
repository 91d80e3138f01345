//! A document beside its JSON Schema: all that is wrong with its shape, at once.

use crate::in_part::UNKNOWN;
use crate::positioned::{Positioned, Table, Value};
use crate::repairs::{Repairs, stand_in};
use crate::suggestion::{closest, differ_in_unit};
use crate::{Complaint, Source};
use serde_json::Value as Schema;
use std::ops::Range;
use std::sync::Arc;

/// The walk: where it is, and what it found.
pub(crate) struct Walk<'a> {
    source: &'a Arc<Source>,
    /// The whole schema, for references into it.
    whole: &'a Schema,
    pub(crate) complaints: Vec<Complaint>,
    /// What can stand in for what is wrong while the rest is checked.
    pub(crate) repairs: Repairs,
}

impl<'a> Walk<'a> {
    /// The walk over a whole document: all complaints, in the order of the file.
    pub(crate) fn over(source: &'a Arc<Source>, schema: &'a Schema, root: &Table) -> Self {
        let mut walk =
            Self { source, whole: schema, complaints: Vec::new(), repairs: Repairs::default() };
        walk.table(schema, "the file", None, root);
        walk.complaints.sort_by_key(|c| c.span.as_ref().map_or(usize::MAX, |s| s.start));
        walk
    }
    fn complain(&mut self, span: Range<usize>, message: String, label: &str) -> &mut Complaint {
        let last = self.complaints.len();
        self.complaints.push(Complaint::error(self.source, message).at(span, label));
        &mut self.complaints[last]
    }
    /// The schema that a reference stands for.
    fn resolved(&self, schema: &'a Schema) -> &'a Schema {
        let mut schema = schema;
        while let Some(pointer) = schema["$ref"].as_str().and_then(|r| r.strip_prefix('#')) {
            match self.whole.pointer(pointer) {
                Some(target) => schema = target,
                None => break,
            }
        }
        schema
    }
    /// The shapes that a schema allows, without the null of an optional key: TOML has none.
    fn choice(&self, schema: &'a Schema) -> Vec<&'a Schema> {
        let schema = self.resolved(schema);
        let listed = schema["oneOf"].as_array().or_else(|| schema["anyOf"].as_array());
        match listed {
            Some(options) => options.iter().flat_map(|o| self.choice(o)).collect(),
            None if schema["type"] == "null" => vec![],
            None => vec![schema],
        }
    }

    /// One value. `name` is how to speak of it.
    fn value(&mut self, schema: &'a Schema, name: &str, item: &Positioned) {
        let options = self.choice(schema);
        let fitting: Vec<_> =
            options.iter().copied().filter(|option| fits(option, &item.value)).collect();
        match (&item.value, &fitting[..]) {
            (_, []) => {
                let wanted = list_of(options.iter().map(|o| wanted(o)), "or");
                let message = format!("{name} must be {wanted}, found {}", item.value.kind());
                self.replace(&options, &item.span);
                let help = description(schema).or_else(|| description(self.resolved(schema)));
                self.complain(item.span.clone(), message, "wrong type").help = help;
            }
            (_, [only]) => self.shape(only, name, item),
            (Value::String(word), several) if several.iter().all(|o| words(o).is_some()) => {
                let words: Vec<_> = several.iter().flat_map(|o| words_of(o)).collect();
                self.word(&words, name, word, &item.span);
            }
            (Value::Table(table), several) => self.tables(several, name, table, item),
            (_, several) => self.best_of(several, name, item),
        }
    }
    /// One value of the right type.
    fn shape(&mut self, schema: &'a Schema, name: &str, item: &Positioned) {
        match &item.value {
            Value::Table(table) => self.table(schema, name, Some(&item.span), table),
            Value::Array(items) => self.list(schema, name, items, &item.span),
            Value::String(word) => {
                if words(schema).is_some() {
                    self.word(&words_of(schema), name, word, &item.span);
                }
                if word.is_empty() && schema["minLength"].as_u64() > Some(0) {
                    self.complain(item.span.clone(), format!("{name} must not be empty"), "empty");
                    self.repairs.replace(&item.span, Value::String(UNKNOWN.to_owned()));
                }
            }
            Value::Float(number) => self.number(schema, name, *number, &item.span),
            Value::Integer(number) => self.number(schema, name, *number as f64, &item.span),
            Value::Boolean(_) | Value::Datetime(_) => {}
        }
    }
    fn number(&mut self, schema: &'a Schema, name: &str, found: f64, span: &Range<usize>) {
        if !found.is_finite() {
            let message = format!("{name} is not a finite number, found {found}");
            self.complain(span.clone(), message, "not finite");
            self.replace(&[schema], span);
            return;
        }
        for (bound, words, broken) in [
            ("minimum", "at least", (|x, b| x < b) as fn(f64, f64) -> bool),
            ("maximum", "at most", |x, b| x > b),
            ("exclusiveMinimum", "more than", |x, b| x <= b),
            ("exclusiveMaximum", "less than", |x, b| x >= b),
        ] {
            if let Some(limit) = schema[bound].as_f64().filter(|limit| broken(found, *limit)) {
                let message = format!("{name} must be {words} {limit}, found {found}");
                self.complain(span.clone(), message, "out of range");
                self.replace(&[schema], span);
            }
        }
    }
    /// A word that must be one of these, each with its schema.
    fn word(
        &mut self,
        words: &[(&'a str, &'a Schema)],
        name: &str,
        found: &str,
        span: &Range<usize>,
    ) {
        if words.iter().any(|(word, _)| *word == found) {
            return;
        }
        let all = list_of(words.iter().map(|(w, _)| format!("\"{w}\"")), "or");
        let message = format!("{name} must be {all}, found \"{found}\"");
        let renamed = words.iter().find(|(_, schema)| was_called(schema, found)).map(|w| w.0);
        let close = renamed.or_else(|| closest(found, words.iter().map(|w| w.0)));
        if let Some(word) = close.or(words.first().map(|w| w.0)) {
            self.repairs.replace(span, Value::String(word.to_owned()));
        }
        let help = close.map(|w| match renamed {
            Some(_) => format!("\"{found}\" was renamed: write \"{w}\""),
            None => format!("did you mean \"{w}\"?"),
        });
        self.complain(span.clone(), message, "not one of these").help = help;
    }
    fn list(&mut self, schema: &'a Schema, name: &str, items: &[Positioned], span: &Range<usize>) {
        let (least, most) = (schema["minItems"].as_u64(), schema["maxItems"].as_u64());
        let found = items.len() as u64;
        if least.is_some_and(|n| found < n) || most.is_some_and(|n| found > n) {
            let wanted = match (least, most) {
                (Some(a), Some(b)) if a == b => format!("{a}"),
                (Some(a), Some(b)) => format!("{a} to {b}"),
                (Some(a), None) => format!("at least {a}"),
                (None, b) => format!("at most {}", b.unwrap_or_default()),
            };
            let message = format!("{name} must have {wanted} values, found {found}");
            self.complain(span.clone(), message, "wrong number of values");
            self.replace(&[schema], span);
        }
        for (i, item) in items.iter().enumerate() {
            let of_item = schema["prefixItems"].get(i).or_else(|| schema.get("items"));
            if let Some(of_item) = of_item {
                self.value(of_item, &name_of_item(name, i, item), item);
            }
        }
    }
    fn table(
        &mut self,
        schema: &'a Schema,
        name: &str,
        span: Option<&Range<usize>>,
        table: &Table,
    ) {
        let properties = schema["properties"].as_object();
        let others = schema.get("additionalProperties");
        let mut meant = Vec::new();
        for (key, entry) in table {
            let known = properties.and_then(|all| all.get(key));
            match known.or(others.filter(|o| o.is_object())) {
                Some(of_key) => {
                    let before = self.complaints.len();
                    self.value(of_key, &format!("`{key}`"), &entry.item);
                    if self.complaints.len() > before
                        && !is_required(schema, key)
                        && !holds_tables(&entry.item.value)
                    {
                        self.repairs.leave_out(&entry.item);
                    }
                }
                None if others == Some(&Schema::Bool(true)) || properties.is_none() => {}
                None => meant.extend(self.unknown_key(schema, name, table, key)),
            }
        }
        let required = schema["required"].as_array().into_iter().flatten();
        for key in required.filter_map(Schema::as_str) {
            if !table.contains_key(key) && !meant.contains(&key) {
                self.stand_in_for(schema, key, span);
                let mut complaint = Complaint::error(self.source, format!("{name} has no `{key}`"));
                if let Some(span) = span {
                    complaint = complaint.at(span.clone(), format!("`{key}` is missing"));
                }
                complaint.help =
                    description(&schema["properties"][key]).map(|text| format!("`{key}`: {text}"));
                self.complaints.push(complaint);
            }
        }
    }
    /// Find a value for a missing key.
    fn stand_in_for(&mut self, schema: &'a Schema, key: &str, span: Option<&Range<usize>>) {
        let options = self.choice(&schema["properties"][key]);
        if let Some(value) = stand_in(&options, &|schema| self.choice(schema)) {
            self.repairs.add(span, key, value);
        }
    }
    /// Let a value of one of some shapes stand where a wrong one does.
    fn replace(&mut self, options: &[&'a Schema], place: &Range<usize>) {
        if let Some(value) = stand_in(options, &|schema| self.choice(schema)) {
            self.repairs.replace(place, value);
        }
    }
    /// Says so, and answers with the key that was meant, if there is one like it.
    fn unknown_key(
        &mut self,
        schema: &'a Schema,
        name: &str,
        table: &Table,
        key: &str,
    ) -> Option<&'a str> {
        let properties = schema["properties"].as_object()?;
        let free = properties.keys().map(String::as_str).filter(|k| !table.contains_key(*k));
        let formerly = |k: &&str| was_called(&properties[*k], key);
        let renamed = free.clone().find(formerly);
        let meant = renamed.or_else(|| closest(key, free));
        let span = table[key].key_span.clone();
        // A value that is laid over a file mostly means a key that the file has.
        let all = properties.keys().map(String::as_str);
        let is_beside = span.start > self.source.text.len();
        let near = meant.or_else(|| closest(key, all).filter(|_| is_beside));
        let help = match near {
            Some(meant) if renamed.is_some() => {
                format!("`{key}` was renamed: write `{meant}`")
            }
            Some(meant) if differ_in_unit(key, meant) => {
                format!("write `{meant}`: a key says the unit of its value")
            }
            Some(meant) => format!("did you mean `{meant}`?"),
            None => format!(
                "keys here: {}",
                list_of(properties.keys().map(|k| format!("`{k}`")), "and")
            ),
        };
        let message = format!("unknown key `{key}` in {name}");
        if let Some(meant) = meant {
            self.repairs.rename(&span, meant);
        }
        self.complain(span, message, "unknown key").help = Some(help);
        meant
    }

    /// A table that may have one of several shapes: told apart by a key with a fixed word, or by
    /// the one key that each has; else the shape that fits best.
    fn tables(&mut self, shapes: &[&'a Schema], name: &str, table: &Table, item: &Positioned) {
        if let Some(tag) = tag_of(shapes) {
            return self.tagged(shapes, tag, name, table, item);
        }
        let Some(keys) = shapes.iter().map(|s| only_key(s)).collect::<Option<Vec<_>>>() else {
            return self.best_of(shapes, name, item);
        };
        let all = list_of(keys.iter().map(|k| format!("`{k}`")), "or");
        let known = keys.iter().position(|key| table.contains_key(*key));
        match (known, table.len()) {
            (Some(i), 1) => self.table(shapes[i], name, Some(&item.span), table),
            (None, 1) => {
                for (key, entry) in table {
                    let message = format!("unknown key `{key}` in {name}: must be {all}");
                    let help = closest(key, keys.iter().copied())
                        .map(|meant| format!("did you mean `{meant}`?"));
                    self.complain(entry.key_span.clone(), message, "unknown key").help = help;
                }
                self.replace(shapes, &item.span);
            }
            (_, found) => {
                let message = format!("{name} must have one key, {all}, found {found}");
                self.complain(item.span.clone(), message, "exactly one key");
                self.replace(shapes, &item.span);
            }
        }
    }
    fn tagged(
        &mut self,
        shapes: &[&'a Schema],
        tag: &str,
        name: &str,
        table: &Table,
        item: &Positioned,
    ) {
        let word_of = |shape: &'a Schema| shape["properties"][tag]["const"].as_str();
        let words: Vec<_> = shapes.iter().filter_map(|s| word_of(s)).collect();
        match table.get(tag).map(|entry| (&entry.item.value, &entry.item.span)) {
            None => {
                let all = list_of(words.iter().map(|w| format!("\"{w}\"")), "or");
                let message = format!("{name} has no `{tag}`");
                self.complain(item.span.clone(), message, "which kind?").help =
                    Some(format!("`{tag}` is {all}"));
                self.replace(shapes, &item.span);
            }
            Some((Value::String(word), span)) => {
                if let Some(shape) = shapes.iter().find(|s| word_of(s) == Some(word)) {
                    self.table(shape, name, Some(&item.span), table);
                } else {
                    let all: Vec<_> = words.iter().copied().zip(shapes.iter().copied()).collect();
                    self.word(&all, &format!("`{tag}`"), word, span);
                    self.replace(shapes, &item.span);
                }
            }
            Some((other, span)) => {
                let message = format!("`{tag}` must be a string, found {}", other.kind());
                self.complain(span.clone(), message, "wrong type");
                self.replace(shapes, &item.span);
            }
        }
    }
    /// Complaints of the shape that has the fewest.
    fn best_of(&mut self, shapes: &[&'a Schema], name: &str, item: &Positioned) {
        let attempts = shapes.iter().map(|shape| {
            let mut walk = Self {
                source: self.source,
                whole: self.whole,
                complaints: vec![],
                repairs: Repairs::default(),
            };
            walk.shape(shape, name, item);
            (walk.complaints, walk.repairs)
        });
        if let Some((complaints, repairs)) = attempts.min_by_key(|(found, _)| found.len()) {
            self.complaints.extend(complaints);
            self.repairs.take(repairs);
        }
    }
}

/// Whether a key or word has had this name in earlier versions of the format: its schema lists them
/// under `x-formerly`.
fn was_called(schema: &Schema, name: &str) -> bool {
    schema["x-formerly"].as_array().is_some_and(|names| names.iter().any(|n| n == name))
}

fn is_required(schema: &Schema, key: &str) -> bool {
    schema["required"].as_array().is_some_and(|all| all.iter().any(|name| name == key))
}

/// Whether a value is a table, or a list with tables in it.
fn holds_tables(value: &Value) -> bool {
    match value {
        Value::Table(_) => true,
        Value::Array(items) => items.iter().any(|item| holds_tables(&item.value)),
        _ => false,
    }
}

/// Whether the type of a value is the one that a schema asks for.
fn fits(schema: &Schema, value: &Value) -> bool {
    let wanted = |word: &str| match &schema["type"] {
        Schema::String(only) => only == word,
        Schema::Array(several) => several.iter().any(|t| t == word),
        // No type at all: anything fits; a word without a type is a string.
        _ => schema["const"].is_null() || word == "string",
    };
    match value {
        Value::String(_) => wanted("string"),
        Value::Integer(_) => wanted("integer") || wanted("number"),
        Value::Float(_) => wanted("number"),
        Value::Boolean(_) => wanted("boolean"),
        Value::Datetime(_) => schema["type"].is_null(),
        Value::Array(_) => wanted("array"),
        Value::Table(_) => wanted("object"),
    }
}

/// What a schema asks for, in words.
fn wanted(schema: &Schema) -> String {
    if let Some(words) = words(schema) {
        return list_of(words.iter().map(|w| format!("\"{w}\"")), "or");
    }
    if let Some(key) = only_key(schema) {
        return format!("{{ {key} = … }}");
    }
    let word = |t: &Schema| match t.as_str() {
        Some("string") => "a string",
        Some("integer") => "an integer",
        Some("number") => "a number",
        Some("boolean") => "true or false",
        Some("array") => "a list",
        Some("object") => "a table",
        _ => "nothing",
    };
    match &schema["type"] {
        Schema::Array(several) => {
            list_of(several.iter().filter(|t| *t != "null").map(|t| word(t).to_owned()), "or")
        }
        only => word(only).to_owned(),
    }
}

/// The words that a string may be, if they are given.
fn words(schema: &Schema) -> Option<Vec<&str>> {
    match (schema["const"].as_str(), schema["enum"].as_array()) {
        (Some(word), _) => Some(vec![word]),
        (_, Some(several)) => Some(several.iter().filter_map(Schema::as_str).collect()),
        _ => None,
    }
}

/// The words that a string may be, each with the schema that has it.
fn words_of(schema: &Schema) -> Vec<(&str, &Schema)> {
    words(schema).unwrap_or_default().into_iter().map(|word| (word, schema)).collect()
}

/// The key whose fixed word tells the shapes apart, if there is one.
fn tag_of<'s>(shapes: &[&'s Schema]) -> Option<&'s str> {
    let first = shapes.first()?["properties"].as_object()?;
    let fixed = |key: &&String| shapes.iter().all(|s| s["properties"][*key]["const"].is_string());
    first.keys().find(fixed).map(String::as_str)
}

/// The key of a shape that has exactly one, and needs it.
fn only_key(schema: &Schema) -> Option<&str> {
    let one = schema["properties"].as_object()?.len() == 1;
    let required = schema["required"].as_array().filter(|all| one && all.len() == 1)?;
    required[0].as_str()
}

fn name_of_item(list: &str, index: usize, item: &Positioned) -> String {
    let Value::Table(table) = &item.value else {
        return format!("value {} of {list}", index + 1);
    };
    match table.get("name").map(|entry| &entry.item.value) {
        Some(Value::String(name)) => format!("{list} \"{name}\""),
        _ => format!("{list} number {}", index + 1),
    }
}

/// First paragraph of a description, on one line, without its full stop.
fn description(schema: &Schema) -> Option<String> {
    let text = schema["description"].as_str()?.split("\n\n").next()?;
    Some(text.replace('\n', " ").trim_end_matches('.').to_owned())
}

/// "a, b or c".
fn list_of(words: impl Iterator<Item = String>, joint: &str) -> String {
    let mut words: Vec<_> = words.collect();
    words.dedup();
    match words.pop() {
        None => "nothing".to_owned(),
        Some(last) if words.is_empty() => last,
        Some(last) => format!("{} {joint} {last}", words.join(", ")),
    }
}
