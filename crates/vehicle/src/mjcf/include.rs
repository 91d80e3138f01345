//! `<include file="…"/>`: the text of a model with that of its included files in place of the
//! elements, and the way back from a place in it to a place in the file where it stands.

use crate::findings::Findings;
use crate::xml::{not_xml, tag_at};
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
    /// The model's path, and the text of all its files.
    pub(super) source: Arc<Source>,
    /// Parts of the text in their order, and where each stands.
    pieces: Vec<Piece>,
}

/// A part of the text, as it stands in a file.
#[derive(Debug)]
struct Piece {
    start: usize,
    of: Arc<Source>,
    at: Range<usize>,
}

/// A model whose files are being read.
struct Splicing {
    main: PathBuf,
    text: String,
    pieces: Vec<Piece>,
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
        let whole = Source::new(source.path.clone(), all.text);
        // Without includes it is the file itself.
        let source = if all.seen.is_empty() { Arc::clone(source) } else { whole };
        Ok(Self { source, pieces: all.pieces })
    }

    /// Complaints about the whole text as complaints about the files that it is made of.
    pub(super) fn traced(&self, complaints: Vec<Complaint>) -> Vec<Complaint> {
        complaints.into_iter().map(|complaint| self.trace(complaint)).collect()
    }

    fn trace(&self, mut complaint: Complaint) -> Complaint {
        let Some(span) = &complaint.span else { return complaint };
        let next = self.pieces.partition_point(|piece| piece.start <= span.start);
        let Some(piece) = next.checked_sub(1).and_then(|place| self.pieces.get(place)) else {
            return complaint;
        };
        let in_file = |byte: usize| (piece.at.start + (byte - piece.start)).min(piece.at.end);
        complaint.span = Some(in_file(span.start)..in_file(span.end.max(span.start)));
        complaint.source = Arc::clone(&piece.of);
        complaint
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
        self.pieces.push(Piece { start: self.text.len(), of: Arc::clone(of), at: at.clone() });
        self.text += of.text.get(at).unwrap_or_default();
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
                Ok(Source::new(path, text))
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
