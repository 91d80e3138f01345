//! Elements of an XML file with their known attributes and children. What is not known is answered
//! by name; what is known and not used is counted.

use crate::findings::Findings;
use roxmltree::{Attribute, Node};
use std::collections::BTreeMap;
use std::ops::Range;
use wrasse_document::closest;

/// What is said of a format as a whole.
#[derive(Debug)]
pub(crate) struct Format {
    pub(crate) name: &'static str,
    /// What follows from a thing not being used, by the name that it is counted under.
    pub(crate) why_unused: &'static [(&'static str, &'static str)],
}

/// What an element may hold.
#[derive(Debug)]
pub(crate) struct Kind {
    pub(crate) tag: &'static str,
    pub(crate) attributes: &'static [&'static str],
    pub(crate) children: &'static [&'static str],
    /// Attributes and children that the format knows and wrasse has no use for.
    pub(crate) unused: &'static [&'static str],
}

/// An element, its attributes and children under the names that were meant.
#[derive(Debug)]
pub(crate) struct Element<'a, 'input> {
    pub(crate) tag: &'static str,
    /// Where the name of its tag stands.
    pub(crate) at: Range<usize>,
    attributes: Vec<(&'static str, Text<'a>)>,
    children: Vec<(&'static str, Node<'a, 'input>)>,
}

/// The value of an attribute, and where it stands.
#[derive(Debug, Clone)]
pub(crate) struct Text<'a> {
    pub(crate) text: &'a str,
    pub(crate) at: Range<usize>,
}

/// One reading of one file: complaints, and counts of what is not used.
#[derive(Debug)]
pub(crate) struct Reading<'t> {
    pub(crate) text: &'t str,
    pub(crate) found: Findings,
    format: &'static Format,
    /// What is not used, by its name.
    unused: BTreeMap<String, Unused>,
}

/// Things of one name that are not used.
#[derive(Debug)]
struct Unused {
    count: usize,
    first: Range<usize>,
}

/// Where the name of a start tag stands.
pub(crate) fn tag_at(node: Node<'_, '_>, text: &str) -> Range<usize> {
    let start = node.range().start + 1;
    let rest = text.get(start..).unwrap_or_default();
    let end = |c: char| c.is_whitespace() || c == '>' || c == '/';
    start..start + rest.find(end).unwrap_or(rest.len())
}

impl<'t> Reading<'t> {
    /// Of a file's text, with nothing found yet.
    pub(crate) fn new(text: &'t str, found: Findings, format: &'static Format) -> Self {
        Self { text, found, format, unused: BTreeMap::new() }
    }

    /// An element with all that it holds; complains of what it should not hold.
    pub(crate) fn open<'a, 'input>(
        &mut self,
        node: Node<'a, 'input>,
        kind: &Kind,
    ) -> Element<'a, 'input> {
        let mut element = Element {
            tag: kind.tag,
            at: tag_at(node, self.text),
            attributes: Vec::new(),
            children: Vec::new(),
        };
        for attribute in node.attributes() {
            if let Some(name) = self.attribute_meant(node, &attribute, kind) {
                let text = Text { text: attribute.value(), at: attribute.range_value() };
                element.attributes.push((name, text));
            }
        }
        for child in node.children() {
            if child.is_element() {
                element.children.extend(self.child_meant(child, kind).map(|name| (name, child)));
            } else if child.is_text() && child.text().is_some_and(|t| !t.trim().is_empty()) {
                let message = format!("text inside <{}> is not used", kind.tag);
                let help = format!("{} keeps values in attributes", self.format.name);
                self.found.warning(&trimmed(self.text, child.range()), message, "not used", &help);
            }
        }
        element
    }

    /// The known name of an attribute, if it is of use.
    fn attribute_meant(
        &mut self,
        node: Node<'_, '_>,
        attribute: &Attribute<'_, '_>,
        kind: &Kind,
    ) -> Option<&'static str> {
        let (name, at) = (attribute.name(), attribute.range_qname());
        if attribute.namespace().is_some() || kind.unused.contains(&name) {
            self.not_used(format!("attribute `{name}` of <{}>", kind.tag), at);
            return None;
        }
        let known = |n: &&'static str| *n == name;
        if let Some(name) = kind.attributes.iter().copied().find(known) {
            return Some(name);
        }
        // What is missing is more likely to be meant than what is already there.
        let all = || kind.attributes.iter().copied();
        let meant = self.found.meant(name, all()).map(|any| {
            let missing = all().filter(|n| node.attribute(*n).is_none());
            closest(name, missing).unwrap_or(any)
        });
        let message = format!("<{}> has no attribute `{name}`", kind.tag);
        if let Some(meant) = meant {
            let help = format!("did you mean `{meant}`?");
            self.found.error(&at, message, "unknown attribute", &help);
            return kind.attributes.iter().copied().find(|n| *n == meant);
        }
        self.found.warning(&at, message + ": not used", "not used", &known_names(kind.attributes));
        None
    }

    /// The known name of a child, if it is of use.
    fn child_meant(&mut self, child: Node<'_, '_>, kind: &Kind) -> Option<&'static str> {
        let at = tag_at(child, self.text);
        let name = child.tag_name().name();
        if child.tag_name().namespace().is_some() || kind.unused.contains(&name) {
            let written = self.text.get(at.clone()).unwrap_or(name).to_owned();
            self.not_used(format!("<{written}>"), at);
            return None;
        }
        if let Some(known) = kind.children.iter().copied().find(|n| *n == name) {
            return Some(known);
        }
        let message = format!("<{}> holds no <{name}>", kind.tag);
        let all: Vec<_> = kind.children.iter().chain(kind.unused).copied().collect();
        if let Some(meant) = self.found.meant(name, all.into_iter()) {
            let help = format!("did you mean <{meant}>?");
            self.found.error(&at, message, "unknown tag", &help);
            return kind.children.iter().copied().find(|n| *n == meant);
        }
        self.found.warning(&at, message + ": not used", "not used", &known_names(kind.children));
        None
    }

    /// Counts a thing that is known and not used.
    pub(crate) fn not_used(&mut self, name: String, at: Range<usize>) {
        self.unused.entry(name).or_insert(Unused { count: 0, first: at }).count += 1;
    }

    /// All that was found, with one note for each name that was not used.
    pub(crate) fn into_findings(mut self) -> Findings {
        for (name, Unused { count, first }) in self.unused {
            let times = if count == 1 { String::new() } else { format!(" ({count} times)") };
            let why = self.format.why_unused.iter().find(|(of, _)| *of == name);
            let help = why.map_or("", |(_, why)| why);
            self.found.note(&first, format!("{name} is not used{times}"), "not used", help);
        }
        self.found
    }
}

impl<'a, 'input> Element<'a, 'input> {
    /// An attribute; where it is written twice, once misspelt, the one that is right.
    pub(crate) fn attribute(&self, name: &str) -> Option<&Text<'a>> {
        self.attributes.iter().find(|(n, _)| *n == name).map(|(_, text)| text)
    }
    /// An attribute that must be there; complains if it is not, or is empty.
    pub(crate) fn required(&self, name: &str, reading: &mut Reading<'_>) -> Option<Text<'a>> {
        let text = self.attribute(name);
        let problem = match text {
            Some(text) if !text.text.trim().is_empty() => return Some(text.clone()),
            Some(_) => "an empty",
            None => "no",
        };
        let at = text.map_or(&self.at, |t| &t.at);
        let message = format!("<{}> has {problem} attribute `{name}`", self.tag);
        let help = format!("write {name}=\"…\"");
        reading.found.error(at, message, "here", &help);
        None
    }
    /// What stands in for a text that is missing, after its complaint.
    pub(crate) fn no_text(&self) -> Text<'a> {
        Text { text: "", at: self.at.clone() }
    }
    /// The children of this name.
    pub(crate) fn children(&self, name: &str) -> impl Iterator<Item = Node<'a, 'input>> {
        let of_name = move |(n, _): &&(&str, _)| *n == name;
        self.children.iter().filter(of_name).map(|(_, node)| *node)
    }
    /// The child of this name; complains of a second one.
    pub(crate) fn only(&self, name: &str, reading: &mut Reading<'_>) -> Option<Node<'a, 'input>> {
        let mut all = self.children(name);
        let first = all.next();
        for more in all {
            let message = format!("<{}> holds a second <{name}>", self.tag);
            let at = tag_at(more, reading.text);
            reading.found.error(&at, message, "the second", "leave out one of them");
        }
        first
    }
}

fn known_names(names: &[&str]) -> String {
    if names.is_empty() { String::new() } else { format!("known here: {}", names.join(", ")) }
}

/// The range without the white space around it.
fn trimmed(text: &str, range: Range<usize>) -> Range<usize> {
    let inside = text.get(range.clone()).unwrap_or_default();
    let start = range.start + (inside.len() - inside.trim_start().len());
    start..start + inside.trim().len()
}
