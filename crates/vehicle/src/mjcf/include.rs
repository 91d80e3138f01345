//! `<include file="…"/>`: the text of a model with that of its included files in place of the
//! elements, and the way back from a place in it to a place in the file where it stands.

use crate::findings::{Findings, SourceFiles};
use crate::xml::{check_attributes, not_xml, tag_at};
use roxmltree::{Document, Node};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use wrasse_document::{Complaint, MOST_BYTES, Source, read_text};

/// Files within files.
const DEEPEST: usize = 10;

/// A model as one text.
#[derive(Debug)]
pub(super) struct Whole {
    /// The text of all its files.
    pub(super) text: String,
    /// Where each part of it stands.
    pub(super) files: SourceFiles,
}

/// A model whose files are being read.
struct Splicing {
    main: PathBuf,
    text: String,
    pieces: Vec<(Arc<Source>, Range<usize>)>,
    seen: Vec<PathBuf>,
}

impl Whole {
    /// The text of a model with all that it includes.
    ///
    /// # Errors
    /// A file that cannot be read, is no XML, or is included twice.
    pub(super) fn of(source: &Arc<Source>) -> Result<Self, Vec<Complaint>> {
        let main = source.path.parent().map(Path::to_owned).unwrap_or_default();
        let mut all = Splicing { main, text: String::new(), pieces: Vec::new(), seen: Vec::new() };
        all.add(source, 0)?;
        Ok(Self { text: all.text, files: SourceFiles::spliced(all.pieces) })
    }
}

impl Splicing {
    /// Adds a file; of an included one, what its root holds.
    fn add(&mut self, source: &Arc<Source>, depth: usize) -> Result<(), Vec<Complaint>> {
        let found = Findings::new(source);
        let document = Document::parse(&source.text).map_err(|why| {
            not_xml(&why, "the file must be well-formed XML with one <mujoco>", &source.text, found)
        })?;
        let root = document.root_element();
        let all = if depth == 0 { 0..source.text.len() } else { inside(root) };
        let mut from = all.start;
        for include in root.descendants().filter(|node| node.tag_name().name() == "include") {
            self.piece(source, from..include.range().start);
            let included = self.included(include, source, depth)?;
            self.add(&included, depth + 1)?;
            from = include.range().end;
        }
        self.piece(source, from..all.end);
        Ok(())
    }

    fn piece(&mut self, of: &Arc<Source>, at: Range<usize>) {
        self.text += of.text.get(at.clone()).unwrap_or_default();
        self.pieces.push((Arc::clone(of), at));
    }

    /// The file that an `<include>` names.
    fn included(
        &mut self,
        include: Node<'_, '_>,
        source: &Arc<Source>,
        depth: usize,
    ) -> Result<Arc<Source>, Vec<Complaint>> {
        let refuse = |at: Range<usize>, message: String, label: &str, help: &str| {
            let mut found = Findings::new(source);
            found.error(&at, message, label, help);
            Err(found.into_complaints())
        };
        let tag = tag_at(include, &source.text);
        let Some(file) = include.attribute_node("file") else {
            return refuse(tag, "<include> names no file".into(), "here", "write file=\"…\"");
        };
        let at = file.range_value();
        if include.has_children() {
            let help = "what it includes stands in its file";
            return refuse(tag, "<include> holds something".into(), "here", help);
        }
        let name = Path::new(file.value());
        if name.has_root() || depth + 1 > DEEPEST {
            let help = "a path is relative to the model, and files are at most ten deep";
            return refuse(at, format!("'{}' is not included", file.value()), "here", help);
        }
        // MuJoCo looks beside the model first, then beside the file that includes.
        let beside = source.path.parent().map(Path::to_owned).unwrap_or_default();
        let path = [self.main.join(name), beside.join(name)];
        let path = path.iter().find(|path| path.exists()).unwrap_or(&path[0]).clone();
        if self.seen.contains(&path) || path == source.path {
            let help = "MuJoCo includes a file once; leave out one of them";
            return refuse(at, format!("'{}' is included twice", file.value()), "again", help);
        }
        let room = MOST_BYTES.saturating_sub(self.text.len() as u64);
        match read_text(&path, room) {
            Ok(text) => {
                self.seen.push(path.clone());
                let source = Source::new(path, text);
                check_attributes(&source)?;
                Ok(source)
            }
            Err(why) => {
                let message = format!("cannot read the included '{}': {why}", path.display());
                refuse(at, message, "this file", "a path is relative to the model")
            }
        }
    }
}

/// Where the content of an element stands.
fn inside(node: Node<'_, '_>) -> Range<usize> {
    match (node.first_child(), node.last_child()) {
        (Some(first), Some(last)) => first.range().start..last.range().end,
        _ => 0..0,
    }
}
