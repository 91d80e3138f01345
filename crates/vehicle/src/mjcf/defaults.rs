//! `<default>`: classes of what elements say where they are silent themselves.

use crate::xml::{Element, Kind, Reading, Text};
use roxmltree::Node;
use std::collections::BTreeMap;

const DEFAULT: Kind = Kind {
    tag: "default",
    attributes: &["class"],
    children: &["default", "joint", "geom", "site", "equality"],
    unused: &[
        "mesh",
        "material",
        "camera",
        "light",
        "pair",
        "tendon",
        "general",
        "motor",
        "position",
        "velocity",
        "intvelocity",
        "damper",
        "cylinder",
        "muscle",
        "adhesion",
        "dcmotor",
        "plugin",
    ],
};

/// A class, and what it says of the elements that wrasse reads.
#[derive(Debug)]
struct Class<'d, 't> {
    /// Place of the class that it is made from; the first has none.
    parent: Option<usize>,
    elements: Vec<Element<'d, 't>>,
}

/// All classes of a file, the one that holds for all first.
#[derive(Debug)]
pub(super) struct Classes<'d, 't> {
    all: Vec<Class<'d, 't>>,
    /// Place of the first class of each name.
    places: BTreeMap<&'d str, usize>,
}

/// An element, and what its class says where it is silent, the nearest first.
#[derive(Debug)]
pub(super) struct Styled<'c, 'd, 't> {
    pub(super) own: Element<'d, 't>,
    defaults: Vec<&'c Element<'d, 't>>,
}

impl<'d> Element<'d, '_> {
    /// Its name; names may be left out in MJCF, and an empty one is none.
    pub(super) fn name(&self) -> Option<&Text<'d>> {
        self.attribute("name").filter(|name| !name.text.trim().is_empty())
    }
}

impl<'d, 't> Styled<'_, 'd, 't> {
    /// An element that has no class.
    pub(super) fn plain(own: Element<'d, 't>) -> Self {
        Self { own, defaults: Vec::new() }
    }
    /// The element that gives an attribute: the nearest of those that have it, else the own.
    pub(super) fn giver(&self, name: &str) -> &Element<'d, 't> {
        let has = |element: &&Element<'d, 't>| element.attribute(name).is_some();
        self.levels().find(has).unwrap_or(&self.own)
    }
    /// An attribute, its own or that of its class.
    pub(super) fn attribute(&self, name: &str) -> Option<&Text<'d>> {
        self.giver(name).attribute(name)
    }
    /// The element and those of its class, the nearest first.
    pub(super) fn levels(&self) -> impl Iterator<Item = &Element<'d, 't>> {
        std::iter::once(&self.own).chain(self.defaults.iter().copied())
    }
}

impl<'d, 't> Classes<'d, 't> {
    /// The classes that the sections `<default>` of a file describe.
    pub(super) fn read(
        sections: impl Iterator<Item = Node<'d, 't>>,
        kinds: &[&Kind],
        reading: &mut Reading<'_>,
    ) -> Self {
        let main = Class { parent: None, elements: Vec::new() };
        let mut classes = Self { all: vec![main], places: BTreeMap::new() };
        // Sections at the top all speak of the class that holds for all.
        let mut waiting: Vec<_> = sections.map(|node| (node, None)).collect();
        waiting.reverse();
        while let Some((node, parent)) = waiting.pop() {
            let element = reading.open(node, &DEFAULT);
            let place = classes.place_of(&element, parent, reading);
            for kind in kinds {
                let of_kind = element.children(kind.tag);
                let opened: Vec<_> = of_kind.map(|node| reading.open(node, kind)).collect();
                classes.all[place].elements.extend(opened);
            }
            let mut nested: Vec<_> =
                element.children("default").map(|node| (node, Some(place))).collect();
            nested.reverse();
            waiting.extend(nested);
        }
        if !classes.places.values().any(|place| *place == 0) {
            classes.places.entry("main").or_insert(0);
        }
        classes
    }

    /// The place of the class that an element describes.
    fn place_of(
        &mut self,
        element: &Element<'d, 't>,
        parent: Option<usize>,
        reading: &mut Reading<'_>,
    ) -> usize {
        if parent.is_none() {
            if let Some(named) = element.attribute("class") {
                self.places.retain(|_, place| *place != 0);
                self.places.insert(named.text, 0);
            }
            return 0;
        }
        let Some(named) = element.required("class", reading) else { return 0 };
        let place = self.all.len();
        if *self.places.entry(named.text).or_insert(place) != place {
            let message = format!("two default classes are called '{}'", named.text);
            reading.found.error(&named.at, message, "the second", "give one of them another name");
        }
        self.all.push(Class { parent, elements: Vec::new() });
        place
    }

    /// The class of this name; nothing after a complaint.
    pub(super) fn find(&self, named: &Text<'_>, reading: &mut Reading<'_>) -> Option<usize> {
        let place = self.places.get(named.text).copied();
        if place.is_none() {
            let message = format!("there is no default class '{}'", named.text);
            let names = || self.places.keys().copied();
            let help = match reading.found.meant(named.text, names()) {
                Some(meant) => format!("did you mean '{meant}'?"),
                None => format!("classes are {}", names().take(10).collect::<Vec<_>>().join(", ")),
            };
            reading.found.error(&named.at, message, "no such class", &help);
        }
        place
    }

    /// Whether a class switches its equality constraints on: MuJoCo does, unless told.
    pub(super) fn activity(&self, class: Option<&str>) -> bool {
        let place = class.and_then(|name| self.places.get(name).copied());
        let said = self.chain("equality", place).find_map(|element| element.attribute("active"));
        said.is_none_or(|text| text.text.trim() != "false")
    }

    /// What a class says of elements of a name, the nearest first.
    fn chain(&self, tag: &str, class: Option<usize>) -> impl Iterator<Item = &Element<'d, 't>> {
        let first = self.all.get(class.unwrap_or(0));
        let up = |class: &&Class<'d, 't>| class.parent.and_then(|place| self.all.get(place));
        // What is said later holds.
        let all = std::iter::successors(first, up).flat_map(|class| class.elements.iter().rev());
        all.filter(move |element| element.tag == tag)
    }

    /// An element with what its class says: its own, or that of what surrounds it.
    pub(super) fn styled<'c>(
        &'c self,
        own: Element<'d, 't>,
        around: Option<usize>,
        reading: &mut Reading<'_>,
    ) -> Styled<'c, 'd, 't> {
        let class = own
            .attribute("class")
            .filter(|named| !named.text.is_empty())
            .and_then(|named| self.find(named, reading));
        let defaults = self.chain(own.tag, class.or(around)).collect();
        Styled { own, defaults }
    }
}
