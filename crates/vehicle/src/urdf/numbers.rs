//! Numbers in the attributes of a URDF, each with its place.

use super::element::{Element, Kind, Reading, Text};
use crate::rotation::from_roll_pitch_yaw;
use core::f64::consts::TAU;
use roxmltree::Node;
use std::ops::Range;
use wrasse_spatial::{Mat3, Pose, Quat, Vec3};

const ORIGIN: Kind =
    Kind { tag: "origin", attributes: &["xyz", "rpy", "quat_xyzw"], children: &[], unused: &[] };

/// How far the length of a quaternion may be from 1: six decimals of each part are enough.
const QUATERNION_ROUND_OFF: f64 = 1e-5;

impl Reading<'_> {
    /// A number that must be there; nothing after a complaint.
    pub(crate) fn required_number(&mut self, element: &Element<'_, '_>, name: &str) -> Option<f64> {
        element.required(name, self)?;
        self.number(element, name)
    }

    /// A number, if it is there; nothing after a complaint.
    pub(crate) fn number(&mut self, element: &Element<'_, '_>, name: &str) -> Option<f64> {
        match self.numbers(element, name, 1)?[..] {
            [x] => Some(x),
            _ => None,
        }
    }

    /// Three numbers, if they are there; nothing after a complaint.
    pub(crate) fn vector(&mut self, element: &Element<'_, '_>, name: &str) -> Option<Vec3<f64>> {
        match self.numbers(element, name, 3)?[..] {
            [x, y, z] => Some(Vec3 { x, y, z }),
            _ => None,
        }
    }

    fn numbers(
        &mut self,
        element: &Element<'_, '_>,
        name: &str,
        expected: usize,
    ) -> Option<Vec<f64>> {
        let value = element.attribute(name)?;
        let words = words(value, self.text);
        if words.len() != expected {
            let wanted = match expected {
                1 => "one number",
                3 => "three numbers",
                _ => "four numbers",
            };
            let what = format!("`{name}` of <{}>", element.tag);
            let message = format!("{what} must be {wanted}, found {}", words.len());
            let help = "separate numbers by spaces; the decimal sign is a point";
            self.found.error(&value.at, message, wanted, help);
            return None;
        }
        let numbers: Vec<_> = words
            .into_iter()
            .map(|(word, at)| {
                let number = finite(word);
                if let Err((problem, help)) = number {
                    let message = format!("`{name}` of <{}>: '{word}' is {problem}", element.tag);
                    self.found.error(&at, message, problem, help);
                }
                number.ok()
            })
            .collect();
        numbers.into_iter().collect()
    }

    /// The pose that an `<origin>` gives; the identity where there is none.
    pub(crate) fn pose(&mut self, origin: Option<Node<'_, '_>>) -> Pose<f64> {
        let Some(node) = origin else { return Pose::identity() };
        let element = self.open(node, &ORIGIN);
        let p = self.vector(&element, "xyz").unwrap_or_default();
        if let Some(rotation) = self.quaternion(&element) {
            return Pose::new(rotation, p);
        }
        let rpy = self.vector(&element, "rpy").unwrap_or_default();
        if let Some(written) = element.attribute("rpy")
            && rpy.to_array().iter().any(|angle| angle.abs() > TAU)
        {
            let message =
                format!("`rpy` of <origin> turns by more than a full turn: {}", written.text);
            self.found.warning(&written.at, message, "in degrees?", "angles are in radians");
        }
        Pose::new(from_roll_pitch_yaw(rpy), p)
    }

    /// The rotation of `quat_xyzw` (URDF 1.1 and later), if it is there; complains of one that is no
    /// rotation, and of `rpy` beside it.
    fn quaternion(&mut self, element: &Element<'_, '_>) -> Option<Mat3<f64>> {
        let written = element.attribute("quat_xyzw")?.clone();
        let [x, y, z, w] = self.numbers(element, "quat_xyzw", 4)?[..] else { return None };
        if let Some(rpy) = element.attribute("rpy") {
            let message = "<origin> has both `rpy` and `quat_xyzw`".to_owned();
            let help = "leave out one of them: they say the same thing";
            self.found.error(&rpy.at.clone(), message, "and this", help);
        }
        let quat = Quat::new(w, x, y, z);
        let length = quat.norm();
        if (length - 1.0).abs() > QUATERNION_ROUND_OFF {
            let message = format!("`quat_xyzw` must have length 1, found {length}");
            let help = "its order is x y z w: no rotation is \"0 0 0 1\"";
            self.found.error(&written.at, message, "not a rotation", help);
            return Some(Mat3::identity());
        }
        Some(quat.normalized().to_matrix())
    }
}

/// The words of a value and their places. A value written with entities has one place for all.
fn words<'a>(value: &Text<'a>, text: &'a str) -> Vec<(&'a str, Range<usize>)> {
    match text.get(value.at.clone()) {
        Some(written) if !written.contains('&') => {
            let mut from = 0;
            let place = |word: &'a str| {
                let start = from + written[from..].find(word).unwrap_or(0);
                from = start + word.len();
                (word, value.at.start + start..value.at.start + from)
            };
            written.split_whitespace().map(place).collect()
        }
        _ => value.text.split_whitespace().map(|word| (word, value.at.clone())).collect(),
    }
}

/// A finite number, or what is wrong with it and how to mend it.
fn finite(word: &str) -> Result<f64, (&'static str, &'static str)> {
    match word.parse::<f64>() {
        Ok(x) if x.is_finite() => Ok(x),
        Ok(_) => Err(("not finite", "write a finite number")),
        Err(_) if word.contains(',') => {
            Err(("not a number", "the decimal sign is a point; separate numbers by spaces"))
        }
        Err(_) => Err(("not a number", "write a number such as 0.25 or 1e-3")),
    }
}
