//! A `<geom>`: what it is made of, and what is drawn of it.

use super::compiler::Compiler;
use super::defaults::Styled;
use super::orientation::{from_z, unit};
use super::solid::{Form, Solid};
use crate::vehicle::ShapeKind;
use crate::xml::{Kind, Reading, tag_at};
use roxmltree::Node;
use std::ops::Range;
use wrasse_spatial::{Mat3, Pose, Vec3};

pub(super) const GEOM: Kind = Kind {
    tag: "geom",
    attributes: &[
        "name",
        "class",
        "type",
        "size",
        "fromto",
        "pos",
        "quat",
        "axisangle",
        "xyaxes",
        "zaxis",
        "euler",
        "mass",
        "density",
        "group",
        "mesh",
        "shellinertia",
    ],
    children: &[],
    unused: &[
        "adhesion",
        "castshadow",
        "conaffinity",
        "condim",
        "contype",
        "fitscale",
        "fluidcoef",
        "fluidshape",
        "friction",
        "gap",
        "hfield",
        "margin",
        "material",
        "priority",
        "rgba",
        "solimp",
        "solmix",
        "solref",
        "surfacevel",
        "user",
        "plugin",
    ],
};

/// Types of geoms; those after the first five have no mass that could be computed here.
const TYPES: [&str; 9] =
    ["sphere", "capsule", "cylinder", "ellipsoid", "box", "plane", "hfield", "mesh", "sdf"];

/// Density of what says neither mass nor density (kg/m³): water's, as MuJoCo has it.
const DENSITY: f64 = 1000.0;

/// What a geom is to the body that it is on.
#[derive(Debug)]
pub(super) struct Geom {
    pub(super) at: Range<usize>,
    /// Its mass properties, if its group counts and it has any.
    pub(super) solid: Option<Solid>,
    /// It has mass, and what that is cannot be known here.
    pub(super) unknown: Option<&'static str>,
    /// What is drawn, in body axes.
    pub(super) outlines: Vec<(Pose<f64>, ShapeKind)>,
    /// It has a form that no outline stands for: a mesh, an ellipsoid.
    pub(super) is_undrawn: bool,
}

impl Compiler {
    /// A geom in a frame of its body.
    pub(super) fn geom(
        &self,
        node: Node<'_, '_>,
        geom: &Styled<'_, '_, '_>,
        X_BF: &Pose<f64>,
        reading: &mut Reading<'_>,
    ) -> Geom {
        let of_type = match geom.attribute("type") {
            Some(_) => reading.word(geom.giver("type"), "type", &TYPES),
            None => Some("sphere"),
        };
        let nothing = Geom {
            at: tag_at(node, reading.text),
            solid: None,
            unknown: None,
            outlines: Vec::new(),
            is_undrawn: false,
        };
        let mass = reading.number(geom.giver("mass"), "mass");
        let density = reading.number(geom.giver("density"), "density");
        let shell = reading.truth(geom.giver("shellinertia"), "shellinertia") == Some(true);
        let group = reading.number(geom.giver("group"), "group").unwrap_or(0.0);
        let (lowest, highest) = self.groups;
        let in_groups = (lowest..=highest).contains(&group);
        let has_mass = in_groups && mass.or(density) != Some(0.0);
        let fitted = geom.attribute("mesh").is_some();
        let Some(of_type) = of_type else {
            return Geom { solid: Some(Solid::stand_in()), ..nothing };
        };
        if matches!(of_type, "plane" | "hfield") {
            return nothing;
        }
        if fitted || matches!(of_type, "mesh" | "sdf") {
            return Geom { unknown: has_mass.then_some("a mesh"), is_undrawn: true, ..nothing };
        }
        let Some((form, X_FG)) = self.form(of_type, geom, reading) else {
            return Geom { solid: Some(Solid::stand_in()), ..nothing };
        };
        let X_BG = *X_BF * X_FG;
        let outlines: Vec<_> =
            outlines(form).into_iter().map(|(X_GS, kind)| (X_BG * X_GS, kind)).collect();
        let nothing = Geom { is_undrawn: outlines.is_empty(), ..nothing };
        let (extent, moments) = if shell {
            (form.surface(), form.moments_of_shell())
        } else {
            (Some(form.volume()), Some(form.moments()))
        };
        let Some((extent, moments)) = extent.zip(moments) else {
            let unknown = has_mass.then_some("the shell of an ellipsoid");
            return Geom { unknown, outlines, ..nothing };
        };
        let mass = mass.unwrap_or_else(|| density.unwrap_or(DENSITY) * extent);
        if mass < 0.0 {
            complain_of_mass(mass, geom, reading);
            return Geom { solid: Some(Solid::stand_in()), outlines, ..nothing };
        }
        // What is lighter counts as nothing in MuJoCo too.
        let solid = (in_groups && mass > 1e-14).then(|| Solid::new(mass, moments, &X_BG));
        Geom { solid, outlines, ..nothing }
    }

    /// Its form, and where that is in the frame that the geom is in; nothing after a complaint.
    fn form(
        &self,
        of_type: &str,
        geom: &Styled<'_, '_, '_>,
        reading: &mut Reading<'_>,
    ) -> Option<(Form, Pose<f64>)> {
        if geom.attribute("fromto").is_some() {
            return from_to(of_type, geom, reading);
        }
        let wanted = match of_type {
            "sphere" => 1,
            "capsule" | "cylinder" => 2,
            _ => 3,
        };
        let sizes = sizes(of_type, wanted, geom, reading);
        let X_FG = self.pose(geom, reading);
        let form = match (of_type, sizes?[..].get(..wanted)?) {
            ("sphere", &[r]) => Form::Sphere(r),
            ("capsule", &[r, half]) => Form::Capsule(r, half),
            ("cylinder", &[r, half]) => Form::Cylinder(r, half),
            ("ellipsoid", &[a, b, c]) => Form::Ellipsoid([a, b, c]),
            (_, &[a, b, c]) => Form::Box([a, b, c]),
            _ => return None,
        };
        Some((form, X_FG))
    }
}

fn complain_of_mass(mass: f64, geom: &Styled<'_, '_, '_>, reading: &mut Reading<'_>) {
    let message = format!("the mass of a geom must not be negative, found {mass} kg");
    let written = geom.attribute("mass").or(geom.attribute("density"));
    let at = written.map_or(&geom.own.at, |written| &written.at);
    reading.found.error(at, message, "this mass", "leave out the sign");
}

/// The first sizes of a geom, all of them positive; nothing after a complaint.
fn sizes(
    of_type: &str,
    wanted: usize,
    geom: &Styled<'_, '_, '_>,
    reading: &mut Reading<'_>,
) -> Option<Vec<f64>> {
    let giver = geom.giver("size");
    let sizes =
        if giver.attribute("size").is_some() { reading.list(giver, "size")? } else { Vec::new() };
    let at = giver.attribute("size").map_or(&geom.own.at, |written| &written.at);
    let help = "sizes are radii and half lengths: a sphere has 1, capsule and cylinder have 2 (1 with \
                `fromto`), ellipsoid and box have 3 (1 with `fromto`)";
    if sizes.len() < wanted {
        let message = format!("a {of_type} has {wanted} in `size`, found {}", sizes.len());
        reading.found.error(at, message, "too few sizes", help);
        return None;
    }
    if let Some(wrong) = sizes.iter().take(wanted).find(|size| **size <= 0.0) {
        let message = format!("a {of_type} has a size of {wrong} m: sizes are positive");
        reading.found.error(at, message, "this size", help);
        return None;
    }
    Some(sizes)
}

/// A form whose axis goes from one point to another.
fn from_to(
    of_type: &str,
    geom: &Styled<'_, '_, '_>,
    reading: &mut Reading<'_>,
) -> Option<(Form, Pose<f64>)> {
    let giver = geom.giver("fromto");
    let at = giver.attribute("fromto").map_or(giver.at.clone(), |written| written.at.clone());
    if of_type == "sphere" {
        let message = "a sphere has no ends: `fromto` is for capsule, cylinder, ellipsoid and box";
        reading.found.error(&at, message.into(), "here", "write its `type`, or `pos` instead");
        return None;
    }
    if geom.attribute("pos").is_some()
        && reading.vector(geom.giver("pos"), "pos").is_some_and(|p| p != Vec3::default())
    {
        let message = "a geom has both `pos` and `fromto`".to_owned();
        reading.found.error(&at, message, "and `pos`", "leave out one of them");
    }
    let radius = sizes(of_type, 1, geom, reading).and_then(|sizes| sizes.first().copied());
    let [a, b, c, d, e, f] = reading.numbers(giver, "fromto", 6)?[..] else { return None };
    let (from, to) = (Vec3 { x: a, y: b, z: c }, Vec3 { x: d, y: e, z: f });
    let Some(z) = unit(from - to) else {
        let message = "the two ends of `fromto` are the same point".to_owned();
        reading.found.error(&at, message, "no length", "write two points, six numbers");
        return None;
    };
    let (r, half) = (radius?, (from - to).norm() / 2.0);
    let form = match of_type {
        "capsule" => Form::Capsule(r, half),
        "cylinder" => Form::Cylinder(r, half),
        "ellipsoid" => Form::Ellipsoid([r, r, half]),
        _ => Form::Box([r, r, half]),
    };
    Some((form, Pose::new(from_z(z), (from + to) * 0.5)))
}

/// What is drawn of a form, in its frame. A capsule is a cylinder and two spheres; an ellipsoid is not
/// drawn unless it is one.
fn outlines(form: Form) -> Vec<(Pose<f64>, ShapeKind)> {
    let at = |z: f64| Pose::new(Mat3::identity(), Vec3 { x: 0.0, y: 0.0, z });
    match form {
        Form::Sphere(r) => vec![(at(0.0), ShapeKind::Sphere(r))],
        Form::Capsule(r, half) => vec![
            (at(0.0), ShapeKind::Cylinder { radius: r, length: 2.0 * half }),
            (at(half), ShapeKind::Sphere(r)),
            (at(-half), ShapeKind::Sphere(r)),
        ],
        Form::Cylinder(r, half) => {
            vec![(at(0.0), ShapeKind::Cylinder { radius: r, length: 2.0 * half })]
        }
        Form::Ellipsoid([a, b, c]) if a == b && b == c => vec![(at(0.0), ShapeKind::Sphere(a))],
        Form::Ellipsoid(_) => vec![],
        Form::Box(half) => {
            let [x, y, z] = half.map(|half| 2.0 * half);
            vec![(at(0.0), ShapeKind::Box(Vec3 { x, y, z }))]
        }
    }
}
