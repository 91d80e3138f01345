//! A vehicle file of another format as the text of a TOML one: the same links and joints, with the same
//! numbers.

use crate::assembly::{AssemblyJoint, Link, Matter, Outline};
use crate::check::is_rounded;
use crate::model::Model;
use crate::read_vehicle::{Nesting, read_model};
use crate::rotation::from_rpy_deg;
use crate::toml::{fix_joints, said_of_fix};
use crate::vehicle::ShapeKind;
use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::PathBuf;
use wrasse_document::{Complaint, Source};
use wrasse_dynamics::JointKind;
use wrasse_spatial::{Mat3, Pose, Quat, Vec3};

/// What is taken over otherwise than the file has it.
#[derive(Debug, Clone, Default)]
pub struct ConvertOptions {
    /// Joints that do not move in the new file, by name: `*` stands for any characters, `?` for one.
    pub fix: Vec<String>,
    /// Why mass properties that no rigid body can have are to be used all the same.
    pub accept_nonphysical: Option<String>,
}

/// The text of a TOML vehicle file with the links and joints of another file, and what was found in
/// that one.
///
/// Masses, places and inertias are the same numbers; angles are in degrees, and what they turn is the same
/// to 1e-15.
///
/// # Errors
/// All complaints at once, if the file cannot be read or is not physically possible.
pub fn convert_to_toml(
    path: impl Into<PathBuf>,
    text: impl Into<String>,
    options: &ConvertOptions,
) -> Result<(String, Vec<Complaint>), Vec<Complaint>> {
    let source = Source::new(path, text);
    let mut model = read_model(&source, &mut Nesting::default())?;
    if model.document.is_some() {
        let complaint = Complaint::error(&source, "this file is a TOML vehicle file already");
        return Err(vec![complaint.with_help("an [[include]] takes it into another vehicle")]);
    }
    let unmet = fix_joints(&options.fix, &mut model.assembly.joints);
    model.accept_nonphysical(options.accept_nonphysical.as_deref());
    if !unmet.is_empty() {
        let told = unmet.into_iter().map(|pattern| {
            let (message, help) = said_of_fix(&model.assembly.joints, &pattern);
            Complaint::error(&source, message).with_help(help)
        });
        return Err(told.collect());
    }
    let file = source.path.file_name().map(|name| name.to_string_lossy().into_owned());
    let written = written(&model, &file.unwrap_or_default());
    let vehicle = model.into_vehicle()?;
    Ok((written, vehicle.remarks))
}

fn written(model: &Model, file: &str) -> String {
    let mut out = String::new();
    let _ = writeln!(out, "name = {}", quoted(&model.name));
    let _ =
        writeln!(out, "summary = {}", quoted(&format!("{}, converted from {file}", model.name)));
    let source = format!("converted from {file}, which does not say where its numbers come from");
    let _ = writeln!(out, "source.assumed = {}", quoted(&source));
    let mut drawn: BTreeMap<&str, Vec<String>> = BTreeMap::new();
    for outline in &model.assembly.outlines {
        drawn.entry(&outline.link).or_default().push(shape(outline));
    }
    for link in &model.assembly.links {
        body(&mut out, link, drawn.get(&*link.name));
    }
    for given in &model.assembly.joints {
        joint(&mut out, given);
    }
    for (tool, _) in &model.assembly.tools {
        let _ = writeln!(
            out,
            "\n[[tool]]\nname = {}\non = {}",
            quoted(&format!("{tool}-tool")),
            quoted(tool)
        );
        let _ = writeln!(out, "position_m = [0, 0, 0]");
    }
    for (name, positions) in &model.assembly.postures {
        posture(&mut out, name, positions, &model.assembly.joints);
    }
    out
}

fn body(out: &mut String, link: &Link, shapes: Option<&Vec<String>>) {
    let _ = writeln!(out, "\n[[body]]\nname = {}", quoted(&link.name));
    if let Some(matter) = &link.matter {
        matter_of(out, matter);
    }
    if let Some(shapes) = shapes {
        let _ = writeln!(out, "shape = [{}]", shapes.join(", "));
    }
}

fn matter_of(out: &mut String, matter: &Matter) {
    let I = matter.inertia;
    let _ = writeln!(out, "mass_kg = {}", number(matter.mass));
    let _ = writeln!(out, "centre_of_mass_m = {}", vector(matter.p_cm));
    let _ = write!(
        out,
        "inertia_kgm2 = {{ about = \"centre-of-mass\", axes = \"body\", xx = {}, yy = {}, zz = {}",
        number(I.xx),
        number(I.yy),
        number(I.zz)
    );
    for (key, product) in [("xy", I.xy), ("xz", I.xz), ("yz", I.yz)] {
        if product != 0.0 {
            let _ = write!(out, ", {key} = {}", number(product));
        }
    }
    let _ = writeln!(out, " }}");
    let rounded =
        is_rounded(matter).then(|| "rounded in the file it was converted from".to_owned());
    let reason = matter.accept_nonphysical.as_ref().map(|why| why.reason.clone()).or(rounded);
    if let Some(reason) = reason {
        let _ = writeln!(out, "accept_nonphysical = {}", quoted(&reason));
    }
}

fn shape(outline: &Outline) -> String {
    let kind = match outline.kind {
        ShapeKind::Box(edges) => format!("box_m = {}", vector(edges)),
        ShapeKind::Cylinder { radius, length } => {
            let (radius, length) = (number(radius), number(length));
            format!("cylinder = {{ radius_m = {radius}, length_m = {length} }}")
        }
        ShapeKind::Sphere(radius) => format!("sphere_radius_m = {}", number(radius)),
    };
    let X = &outline.X_LF;
    let turned = orientation(&X.rotation).map_or(String::new(), |turned| format!(", {turned}"));
    format!("{{ {kind}, position_m = {}{turned} }}", vector(X.translation))
}

fn joint(out: &mut String, joint: &AssemblyJoint) {
    let kind = match joint.kind {
        None => "fixed",
        Some(JointKind::Prismatic) => "prismatic",
        Some(JointKind::Revolute) if joint.limits.travel.is_some() => "revolute",
        Some(JointKind::Revolute) => "continuous",
    };
    let _ = writeln!(out, "\n[[joint]]\nname = {}\nkind = \"{kind}\"", quoted(&joint.name));
    let (parent, child) = (quoted(&joint.parent), quoted(&joint.child));
    let _ = writeln!(out, "parent = {parent}\nchild = {child}");
    let Pose { rotation, translation } = &joint.X_PC;
    let _ = writeln!(out, "position_m = {}", vector(*translation));
    if let Some(turned) = orientation(rotation) {
        let _ = writeln!(out, "{turned}");
    }
    let Some(kind) = joint.kind else { return };
    let _ = writeln!(out, "axis = {}", vector(joint.axis));
    limits(out, joint, kind);
    if let Some(mimic) = &joint.mimic {
        let _ = write!(out, "mimic = {{ joint = {}", quoted(&mimic.leader));
        let _ = write!(out, ", ratio = {}", number(mimic.ratio));
        let _ = match kind {
            JointKind::Revolute => write!(out, ", offset_deg = {}", degrees(mimic.offset)),
            JointKind::Prismatic => write!(out, ", offset_m = {}", number(mimic.offset)),
        };
        let _ = writeln!(out, " }}");
    }
}

/// A limit of zero is left out: a drive without rate or effort is one of which nothing is known.
fn limits(out: &mut String, joint: &AssemblyJoint, kind: JointKind) {
    let limits = &joint.limits;
    let (rate, effort) = (limits.rate.filter(|x| *x != 0.0), limits.effort.filter(|x| *x != 0.0));
    let keys = match kind {
        JointKind::Revolute => ["travel_deg", "rate_deg_s", "effort_nm"],
        JointKind::Prismatic => ["travel_m", "rate_m_s", "effort_n"],
    };
    let motion = |x: f64| if kind == JointKind::Revolute { degrees(x) } else { number(x) };
    if let Some((lower, upper)) = limits.travel {
        let _ = writeln!(out, "{} = [{}, {}]", keys[0], motion(lower), motion(upper));
    } else if kind == JointKind::Prismatic {
        let _ = writeln!(
            out,
            "{} = [-1000, 1000] # not limited in the file it was converted from",
            keys[0]
        );
    }
    if let Some(rate) = rate {
        let _ = writeln!(out, "{} = {}", keys[1], motion(rate));
    }
    if let Some(effort) = effort {
        let _ = writeln!(out, "{} = {}", keys[2], number(effort));
    }
    if joint.rotor != 0.0 {
        let unit = if kind == JointKind::Revolute { "kgm2" } else { "kg" };
        let _ = writeln!(out, "rotor_inertia_{unit} = {}", number(joint.rotor));
    }
}

fn posture(
    out: &mut String,
    name: &str,
    positions: &BTreeMap<String, f64>,
    joints: &[AssemblyJoint],
) {
    let _ = writeln!(out, "\n[[posture]]\nname = {}", quoted(name));
    for (key, kind) in [("joints_deg", JointKind::Revolute), ("joints_m", JointKind::Prismatic)] {
        let of_kind =
            joints.iter().filter(|joint| joint.kind == Some(kind) && joint.mimic.is_none());
        let given: Vec<_> = of_kind
            .filter_map(|joint| Some((joint, *positions.get(&joint.name)?)))
            .map(|(joint, q)| {
                let q = if kind == JointKind::Revolute { degrees(q) } else { number(q) };
                format!("{} = {q}", quoted(&joint.name))
            })
            .collect();
        if !given.is_empty() {
            let _ = writeln!(out, "{key} = {{ {} }}", given.join(", "));
        }
    }
}

/// A string as TOML writes it.
fn quoted(text: &str) -> String {
    toml::Value::String(text.to_owned()).to_string()
}

/// A number as short as it can be without being another one.
fn number(x: f64) -> String {
    let plain = format!("{x}");
    let short = format!("{x:?}");
    if short.len() < plain.len() { short } else { plain }
}

fn vector(v: Vec3<f64>) -> String {
    format!("[{}]", v.to_array().map(number).join(", "))
}

/// An angle in degrees (from rad): as few decimals as give the same number back, or all of them.
fn degrees(angle: f64) -> String {
    let exact = angle.to_degrees();
    let rounded = (0..16).map(|decimals| format!("{exact:.decimals$}"));
    let same = |text: &String| text.parse().is_ok_and(|deg: f64| deg.to_radians() == angle);
    let neighbours = || [exact.next_down(), exact.next_up()].map(|deg| format!("{deg}"));
    let found = rounded.clone().find(same).or_else(|| neighbours().into_iter().find(same));
    let text = found.unwrap_or_else(|| format!("{exact}"));
    text.parse().map_or(text, number)
}

/// How far the elements of a rotation may be from what they were (–): a few units in the last place.
const SAME_ROTATION: f64 = 1e-15;

/// `orientation.… = …` of a rotation; nothing for none.
fn orientation(R: &Mat3<f64>) -> Option<String> {
    if *R == Mat3::identity() {
        return None;
    }
    let rows = R.rows.map(Vec3::to_array);
    let pitch = (-rows[2][0]).atan2(rows[2][1].hypot(rows[2][2]));
    let (roll, yaw) = if pitch.cos().abs() > 1e-9 {
        (rows[2][1].atan2(rows[2][2]), rows[1][0].atan2(rows[0][0]))
    } else {
        // Roll and yaw turn about one axis: all of it is yaw.
        (0.0, (-rows[0][1]).atan2(rows[1][1]))
    };
    let exact = [roll, pitch, yaw].map(f64::to_degrees);
    for decimals in 0..16 {
        let told = exact.map(|deg| format!("{deg:.decimals$}").parse().unwrap_or(deg));
        if largest_difference(&from_rpy_deg(told), R) <= SAME_ROTATION {
            return Some(format!("orientation.rpy_deg = {}", vector(Vec3::from_array(told))));
        }
    }
    let Quat { w, x, y, z } = Quat::from_matrix(R);
    let [w, x, y, z] = [w, x, y, z].map(number);
    Some(format!("orientation.quaternion = {{ w = {w}, x = {x}, y = {y}, z = {z} }}"))
}

fn largest_difference(a: &Mat3<f64>, b: &Mat3<f64>) -> f64 {
    let rows = a.rows.iter().zip(&b.rows);
    let off = rows.flat_map(|(a, b)| (*a - *b).to_array());
    off.map(f64::abs).fold(0.0, f64::max)
}
