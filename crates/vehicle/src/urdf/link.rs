//! A `<link>`: its mass properties, and its visual boxes, cylinders and balls for drawings.

use crate::assembly::{Link, Matter, Outline, Rounding};
use crate::vehicle::ShapeKind;
use crate::xml::{Element, Kind, Reading, tag_at};
use roxmltree::Node;
use std::ops::Range;
use wrasse_spatial::{Pose, Sym3};

const LINK: Kind = Kind {
    tag: "link",
    attributes: &["name"],
    children: &["inertial", "visual"],
    unused: &["type", "collision", "contact", "self_collision_checking", "material", "sensor"],
};
const INERTIAL: Kind = Kind {
    tag: "inertial",
    attributes: &[],
    children: &["origin", "mass", "inertia"],
    unused: &["name"],
};
const MASS: Kind = Kind { tag: "mass", attributes: &["value"], children: &[], unused: &[] };
const INERTIA: Kind = Kind {
    tag: "inertia",
    attributes: &["ixx", "ixy", "ixz", "iyy", "iyz", "izz"],
    children: &[],
    unused: &[],
};
const VISUAL: Kind = Kind {
    tag: "visual",
    attributes: &[],
    children: &["origin", "geometry"],
    unused: &["name", "material", "material_group", "visual_properties"],
};
const GEOMETRY: Kind = Kind {
    tag: "geometry",
    attributes: &[],
    children: &["box", "cylinder", "sphere"],
    unused: &["mesh", "capsule", "ellipsoid"],
};
const BOX: Kind = Kind { tag: "box", attributes: &["size"], children: &[], unused: &[] };
const CYLINDER: Kind =
    Kind { tag: "cylinder", attributes: &["radius", "length"], children: &[], unused: &[] };
const SPHERE: Kind = Kind { tag: "sphere", attributes: &["radius"], children: &[], unused: &[] };

impl Reading<'_> {
    /// A link, its outlines, and whether it is drawn by more than these; nothing if it has no name.
    pub(crate) fn link(&mut self, node: Node<'_, '_>) -> Option<(Link, Vec<Outline>, bool)> {
        let element = self.open(node, &LINK);
        let matter = element.only("inertial", self).and_then(|inertial| self.matter(inertial));
        let outlines: Vec<_> =
            element.children("visual").filter_map(|visual| self.outline(visual)).collect();
        let is_partly_drawn = element.children("visual").count() > outlines.len();
        let name = element.required("name", self)?;
        let outline = |(X_LF, kind)| Outline { link: name.text.to_owned(), X_LF, kind };
        let link = Link { name: name.text.to_owned(), at: name.at.clone(), matter };
        Some((link, outlines.into_iter().map(outline).collect(), is_partly_drawn))
    }

    /// Mass properties; nothing if all are zero. After a complaint, neutral values stand in: the rest
    /// is still checked.
    fn matter(&mut self, node: Node<'_, '_>) -> Option<Matter> {
        let element = self.open(node, &INERTIAL);
        let origin = element.only("origin", self);
        let X_LC = self.pose(origin);
        let (mass, mass_at) = match self.child_that_must_be(&element, "mass", &MASS) {
            Some(child) => {
                let at = child.attribute("value").map_or(&child.at, |value| &value.at).clone();
                (self.required_number(&child, "value"), at)
            }
            None => (None, element.at.clone()),
        };
        let (given, inertia_at) = match self.child_that_must_be(&element, "inertia", &INERTIA) {
            Some(child) => (self.inertia(&child), child.at.clone()),
            None => (None, element.at.clone()),
        };
        let (inertia, rounding) = given.unzip();
        if mass == Some(0.0) && inertia == Some(Sym3::zero()) {
            let message = "mass and inertia are zero: read as a mere frame".to_owned();
            self.found.warning(&mass_at, message, "no mass", "a frame has no <inertial>");
            return None;
        }
        Some(Matter {
            mass: mass.unwrap_or(1.0),
            mass_at,
            p_cm: X_LC.translation,
            rounding: rounding.unwrap_or_default(),
            // URDF gives it about the centre of mass, in the axes of the inertial origin.
            inertia: X_LC.rotation.congruence(inertia.unwrap_or(Sym3::diagonal(1.0, 1.0, 1.0))),
            inertia_at,
            accept_nonphysical: None,
        })
    }

    fn inertia(&mut self, element: &Element<'_, '_>) -> Option<(Sym3<f64>, Rounding)> {
        // All six are read before any is missed: each complaint is told.
        let names = ["ixx", "ixy", "ixz", "iyy", "iyz", "izz"];
        let elements = names.map(|name| self.required_number(element, name));
        let [Some(xx), Some(xy), Some(xz), Some(yy), Some(yz), Some(zz)] = elements else {
            return None;
        };
        let written = names.map(|name| element.attribute(name).map_or("", |text| text.text.trim()));
        Some((Sym3 { xx, xy, xz, yy, yz, zz }, Rounding::of_written(written)))
    }

    fn child_that_must_be<'a, 'input>(
        &mut self,
        element: &Element<'a, 'input>,
        name: &str,
        kind: &Kind,
    ) -> Option<Element<'a, 'input>> {
        let Some(child) = element.only(name, self) else {
            let message = format!("<{}> has no <{name}>", element.tag);
            let help = "a link with <inertial> gives mass and inertia; a frame has no <inertial>";
            self.found.error(&element.at, message, "here", help);
            return None;
        };
        Some(self.open(child, kind))
    }

    fn outline(&mut self, node: Node<'_, '_>) -> Option<(Pose<f64>, ShapeKind)> {
        let visual = self.open(node, &VISUAL);
        let origin = visual.only("origin", self);
        let X_LF = self.pose(origin);
        let geometry = visual.only("geometry", self)?;
        let geometry = self.open(geometry, &GEOMETRY);
        let outline_box = geometry.only("box", self);
        let cylinder = geometry.only("cylinder", self);
        let sphere = geometry.only("sphere", self);
        let drawn = outline_box.or(cylinder).or(sphere)?;
        let kind = if let Some(node) = outline_box {
            let element = self.open(node, &BOX);
            element.required("size", self)?;
            self.vector(&element, "size").map(ShapeKind::Box)
        } else if let Some(node) = cylinder {
            let element = self.open(node, &CYLINDER);
            let radius = self.required_number(&element, "radius");
            let length = self.required_number(&element, "length");
            radius.zip(length).map(|(radius, length)| ShapeKind::Cylinder { radius, length })
        } else {
            let element = self.open(sphere?, &SPHERE);
            self.required_number(&element, "radius").map(ShapeKind::Sphere)
        }?;
        self.has_extent(&tag_at(drawn, self.text), kind).then_some((X_LF, kind))
    }

    /// Whether a shape can be drawn: complains of negative sizes, and warns of sizes that are zero.
    fn has_extent(&mut self, at: &Range<usize>, kind: ShapeKind) -> bool {
        let least = kind.sizes().into_iter().fold(f64::INFINITY, f64::min);
        if least < 0.0 {
            let message = format!("a shape has a size of {least} m: sizes are positive");
            self.found.error(at, message, "this shape", "leave out the sign");
        } else if least == 0.0 {
            let message = "a shape has a size of 0 m: it is not drawn".to_owned();
            self.found.warning(at, message, "this shape", "give it an extent, or leave it out");
        }
        least > 0.0
    }
}
