//! `<keyframe>`: positions of all joints, as postures.

use crate::xml::{Kind, Reading};
use roxmltree::Node;
use std::collections::BTreeMap;

const KEYFRAME: Kind = Kind { tag: "keyframe", attributes: &[], children: &["key"], unused: &[] };
const KEY: Kind = Kind {
    tag: "key",
    attributes: &["name", "qpos"],
    children: &[],
    unused: &["act", "ctrl", "mpos", "mquat", "plastic", "qvel", "time"],
};

impl Reading<'_> {
    /// The postures of the keys that give `qpos`: positions of these joints in their order, after the
    /// seven numbers of a base that floats in the file.
    pub(super) fn postures(
        &mut self,
        section: Node<'_, '_>,
        joints: &[&str],
        base: usize,
    ) -> Vec<(String, BTreeMap<String, f64>)> {
        let element = self.open(section, &KEYFRAME);
        let mut postures: Vec<(String, BTreeMap<String, f64>)> = Vec::new();
        for (number, node) in element.children("key").enumerate() {
            let key = self.open(node, &KEY);
            let written = key.name();
            let name = written.map_or(format!("key{number}"), |name| name.text.to_owned());
            let at = written.map_or(&key.at, |name| &name.at);
            if postures.iter().any(|(other, _)| *other == name) {
                let help = "give one of them another name";
                let message = format!("two keys are called '{name}'");
                self.found.error(at, message, "the second", help);
            }
            if key.attribute("qpos").is_none() {
                continue;
            }
            if let Some(qpos) = self.numbers(&key, "qpos", base + joints.len()) {
                let names = joints.iter().map(|joint| (*joint).to_owned());
                postures.push((name, names.zip(qpos.into_iter().skip(base)).collect()));
            }
        }
        postures
    }
}
