//! A document with what a command line gives beside it.

use crate::document::{Document, Step};
use crate::positioned::{Entry, Positioned, Table, Value};
use crate::setting::{PathPart, PathStep, Setting};
use crate::suggestion::closest;
use crate::{Complaint, Source};
use std::ops::Range;

impl Document {
    /// The document with these values in their places, the later ones over the earlier. Tables above a
    /// value are made where there are none. What is complained of such a value points into its own text.
    ///
    /// # Errors
    /// Paths through what is no table and no list, and values of a list that are not there.
    pub fn with_settings(&self, settings: &[Setting]) -> Result<Self, Vec<Complaint>> {
        let texts = settings.iter().map(|setting| setting.source.clone()).collect();
        let mut source = Source::clone(self.source());
        source.beside = texts;
        let mut document = self.clone();
        document.set_source(source);
        let mut complaints = vec![];
        for (k, setting) in settings.iter().enumerate() {
            let begin = document.source().begin_beside(k);
            let laying = Laying { setting, begin };
            let mut value = setting.value.clone();
            value.shift(begin);
            if let Err(complaint) = laying.lay_into_table(document.root_mut(), &setting.path, value)
            {
                complaints.push(*complaint);
            }
        }
        if complaints.is_empty() { Ok(document) } else { Err(complaints) }
    }

    /// What was laid over the document, as it was given.
    pub fn settings(&self) -> Vec<String> {
        self.source().beside.iter().map(|source| source.text.clone()).collect()
    }

    /// Whether the value at a path, or a table above it, was laid over the document.
    pub fn is_set(&self, path: &[Step<'_>]) -> bool {
        self.span(path).is_some_and(|span| span.start > self.source().text.len())
    }

    /// Whether a table, laid over the document, replaces what is at a path.
    pub fn replaces(&self, overlay: &[Step<'_>], path: &[Step<'_>]) -> bool {
        self.exact(overlay).is_some_and(|over| replaces(&over.value, path))
    }

    /// The paths of values that were laid over the document, in the order of the document.
    pub fn set_paths(&self) -> Vec<Vec<Step<'_>>> {
        let mut found = vec![];
        let ours = |span: &Range<usize>| span.start > self.source().text.len();
        below_table(self.root(), &mut vec![], &ours, &mut found);
        found
    }
}

/// Tables merge, all else is replaced.
fn replaces(over: &Value, path: &[Step<'_>]) -> bool {
    match (over, path.split_first()) {
        (Value::Table(table), Some((Step::Key(key), rest))) => {
            table.get(*key).is_some_and(|entry| replaces(&entry.item.value, rest))
        }
        _ => true,
    }
}

fn below_table<'d>(
    table: &'d Table,
    path: &mut Vec<Step<'d>>,
    ours: &dyn Fn(&Range<usize>) -> bool,
    found: &mut Vec<Vec<Step<'d>>>,
) {
    for (key, entry) in table {
        path.push(Step::Key(key));
        below_item(&entry.item, path, ours, found);
        path.pop();
    }
}

fn below_item<'d>(
    item: &'d Positioned,
    path: &mut Vec<Step<'d>>,
    ours: &dyn Fn(&Range<usize>) -> bool,
    found: &mut Vec<Vec<Step<'d>>>,
) {
    match &item.value {
        Value::Table(table) if !table.is_empty() => below_table(table, path, ours, found),
        Value::Array(items) if !ours(&item.span) => {
            for (i, item) in items.iter().enumerate() {
                path.push(Step::Index(i));
                below_item(item, path, ours, found);
                path.pop();
            }
        }
        _ if ours(&item.span) => found.push(path.clone()),
        _ => {}
    }
}

/// What was refused: boxed, for it is rare and large.
type Laid = Result<(), Box<Complaint>>;

/// A setting on its way to its place.
struct Laying<'s> {
    setting: &'s Setting,
    /// Where its text begins behind that of the file.
    begin: usize,
}

impl Laying<'_> {
    fn place(&self, part: &PathPart) -> Range<usize> {
        part.span.start + self.begin..part.span.end + self.begin
    }
    fn refuse(&self, part: &PathPart, message: String, help: &str) -> Laid {
        Err(Box::new(self.setting.complaint(part, message, help)))
    }
    /// The path up to a part, as it was written.
    fn above(&self, part: &PathPart) -> &str {
        self.setting.text()[..part.span.start].trim_end_matches('.')
    }

    fn lay_into_table(&self, table: &mut Table, path: &[PathPart], value: Positioned) -> Laid {
        let Some((part, rest)) = path.split_first() else { return Ok(()) };
        let PathStep::Key(key) = &part.step else {
            let message = format!("`{}` is a table, not a list", self.above(part));
            return self.refuse(part, message, "put a point before the key of a table");
        };
        let key_span = self.place(part);
        if rest.is_empty() {
            table.insert(key.clone(), Entry { key_span, item: value });
            return Ok(());
        }
        if !table.contains_key(key) && !matches!(rest[0].step, PathStep::Key(_)) {
            let message = format!("the file has no list `{key}`");
            return self.refuse(part, message, "give the whole list as the value");
        }
        let made = || Positioned { span: key_span.clone(), value: Value::Table(Table::new()) };
        let entry = table
            .entry(key.clone())
            .or_insert_with(|| Entry { key_span: key_span.clone(), item: made() });
        self.lay_into_item(&mut entry.item, rest, value)
    }

    fn lay_into_item(&self, item: &mut Positioned, path: &[PathPart], value: Positioned) -> Laid {
        let Some((part, rest)) = path.split_first() else {
            *item = value;
            return Ok(());
        };
        let above = self.above(part);
        match &mut item.value {
            Value::Table(table) => self.lay_into_table(table, path, value),
            Value::Array(items) => match position(items, &part.step) {
                Ok(i) => self.lay_into_item(&mut items[i], rest, value),
                Err((what, help)) => {
                    self.refuse(part, format!("`{above}` {what}"), &help.replace("LIST", above))
                }
            },
            other => {
                let message = format!("`{above}` is {}: nothing lies below it", other.kind());
                self.refuse(part, message, "leave out what stands behind it")
            }
        }
    }
}

/// The place of a step in a list; else what is wrong with it, and how to mend it.
fn position(items: &[Positioned], step: &PathStep) -> Result<usize, (String, String)> {
    let names: Vec<&str> = items.iter().filter_map(name_of).collect();
    let all = match (&names[..], items.len()) {
        ([], 0) => "it is empty: give the whole list as the value".to_owned(),
        ([], n) => format!("LIST[0] is its first value, LIST[{}] its last", n - 1),
        (names, _) => {
            let each: Vec<_> = names.iter().map(|name| format!("LIST[{name}]")).collect();
            format!("there is {}; LIST[0] is the first", each.join(", "))
        }
    };
    match step {
        PathStep::Index(i) if *i < items.len() => Ok(*i),
        PathStep::Index(_) => {
            Err((format!("has {} value(s), counted from zero", items.len()), all))
        }
        PathStep::Key(_) => Err(("is a list: say which of its values".into(), all)),
        PathStep::Name(name) => {
            let found = items.iter().position(|item| name_of(item) == Some(name));
            found.ok_or_else(|| {
                let help = closest(name, names.iter().copied())
                    .map(|near| format!("did you mean LIST[{near}]?"));
                (format!("has nothing called {name:?}"), help.unwrap_or(all))
            })
        }
    }
}

/// The name of a value that is a table with one.
fn name_of(item: &Positioned) -> Option<&str> {
    let Value::Table(table) = &item.value else { return None };
    match &table.get("name")?.item.value {
        Value::String(name) => Some(name),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{at, render};

    const TEXT: &str = "name = \"m\"\n[world]\nstep_s = 0.01\n[[phase]]\nname = \"reach\"\nt_s = 3\n\
                        [[phase]]\nname = \"settle\"\nt_s = 4\nby_m = [1.0, 2.0]\n";

    fn laid(texts: &[&str]) -> Result<Document, Vec<Complaint>> {
        let document = Document::parse("m.toml", TEXT).unwrap_or_else(|found| panic!("{found:?}"));
        let settings = texts.iter().map(|text| Setting::parse(text).expect(text));
        document.with_settings(&settings.collect::<Vec<_>>())
    }

    #[test]
    fn values_go_to_their_places_the_later_over_the_earlier() {
        let texts = ["phase[settle].t_s=7", "phase[1].by_m[0]=5.5", "a.b=1", "a.b=x", "name=n"];
        let found = laid(&texts).unwrap_or_else(|found| panic!("{found:?}"));
        let value = |path: &[Step<'_>]| found.value(path);
        assert_eq!(value(at!["phase", 1, "t_s"]), Some(7.into()));
        assert_eq!(value(at!["phase", 1, "by_m", 0]), Some(5.5.into()));
        assert_eq!(value(at!["phase", 1, "by_m", 1]), Some(2.0.into()));
        assert_eq!(value(at!["phase", 0, "t_s"]), Some(3.into()));
        assert_eq!(value(at!["a", "b"]), Some("x".into()));
        assert_eq!(value(at!["name"]), Some("n".into()));
        assert_eq!(found.settings(), texts);
        assert_eq!(found.source().text, TEXT);
        assert!(found.is_set(at!["a", "b"]) && !found.is_set(at!["world", "step_s"]));
        let paths = found.set_paths();
        let wanted: [&[Step<'_>]; 4] =
            [at!["a", "b"], at!["name"], at!["phase", 1, "by_m", 0], at!["phase", 1, "t_s"]];
        assert_eq!(paths, wanted);
    }

    #[test]
    fn a_complaint_about_a_value_shows_the_text_that_gave_it() {
        let found =
            laid(&["a.b=1", "world.step_s=fast"]).unwrap_or_else(|found| panic!("{found:?}"));
        let drawn = render(&[found.error(at!["world", "step_s"], "no number", "here")], false);
        assert!(drawn.contains("--> --set:1:14\n"), "{drawn}");
        assert!(drawn.contains("1 | world.step_s=fast\n  |              ^^^^ here"), "{drawn}");
        let drawn = render(&[found.error(at!["phase", 0], "odd", "here")], false);
        assert!(drawn.contains("--> m.toml:4:1\n"), "{drawn}");
    }

    #[test]
    fn a_path_that_leads_nowhere_is_refused_with_what_there_is() {
        for (text, message, help) in [
            (
                "phase.t_s=1",
                "`phase` is a list",
                "phase[reach], phase[settle]; phase[0] is the first",
            ),
            ("phase[2].t_s=1", "`phase` has 2 value(s)", "phase[reach]"),
            ("phase[setle].t_s=1", "nothing called \"setle\"", "did you mean phase[settle]?"),
            ("phase[1].by_m[2]=1", "`phase[1].by_m` has 2 value(s)", "phase[1].by_m[1] its last"),
            ("world[0]=1", "`world` is a table", "point"),
            ("world.step_s.x=1", "`world.step_s` is a number", "leave out"),
            ("failure[0].unit=w", "no list `failure`", "whole list"),
        ] {
            let found = laid(&[text]).expect_err(text);
            let [found] = &found[..] else { panic!("{text}: {found:?}") };
            assert!(found.message.contains(message), "{text}: {}", found.message);
            let said = found.help.as_deref().unwrap_or_default();
            assert!(said.contains(help), "{text}: {said}");
        }
    }
}
