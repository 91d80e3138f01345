//! The `<origin>` of a URDF.

use crate::rotation::from_roll_pitch_yaw;
use crate::xml::{Kind, Reading};
use core::f64::consts::TAU;
use roxmltree::Node;
use wrasse_spatial::Pose;

const ORIGIN: Kind =
    Kind { tag: "origin", attributes: &["xyz", "rpy"], children: &[], unused: &[] };

impl Reading<'_> {
    /// The pose that an `<origin>` gives; the identity where there is none.
    pub(crate) fn pose(&mut self, origin: Option<Node<'_, '_>>) -> Pose<f64> {
        let Some(node) = origin else { return Pose::identity() };
        let element = self.open(node, &ORIGIN);
        let p = self.vector(&element, "xyz").unwrap_or_default();
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
}
