//! Whether the mass properties and joints of a file can be.

use crate::assembly::{AssemblyJoint, Link, Matter, Rounding};
use crate::figures::figures;
use crate::findings::Findings;
use nalgebra::{Matrix3, SymmetricEigen};
use std::collections::BTreeSet;
use std::ops::Range;
use wrasse_spatial::{SpatialInertia, Sym3};

/// What can be said of the mass properties of one link, before it is known what it is fixed to:
/// complains of numbers that are not finite, and of a mass below zero. Whether they can be taken.
pub(crate) fn check_numbers(link: &Link, found: &mut Findings) -> bool {
    let Some(matter) = &link.matter else { return true };
    if !check_finite(link, matter, found) {
        return false;
    }
    if matter.mass < 0.0 {
        let message = format!("mass of '{}' must be positive, found {} kg", link.name, matter.mass);
        let help = "leave out the mass properties of a link that is only a frame";
        found.error(&matter.mass_at, message, "this mass", help);
    }
    matter.mass >= 0.0
}

/// Complains of the inertia of links that are surely a body of their own, where the links are no tree:
/// those that no joint fixes to another.
pub(crate) fn check_single_links(links: &[Link], joints: &[AssemblyJoint], found: &mut Findings) {
    let fixed = joints.iter().filter(|joint| joint.kind.is_none());
    let touched: BTreeSet<&str> = fixed.flat_map(|j| [&*j.parent, &*j.child]).collect();
    for link in links.iter().filter(|link| !touched.contains(&*link.name)) {
        let Some(matter) = &link.matter else { continue };
        let numbers = [&[matter.mass][..], &matter.p_cm.to_array(), &elements(matter.inertia)];
        if numbers.into_iter().all(|numbers| wrong_size(numbers).is_none()) {
            let M = SpatialInertia::from_central(matter.mass, matter.p_cm, matter.inertia);
            check_body(&[(link, matter)], &M, found);
        }
    }
}

/// The largest number of a model, in SI: products of six such numbers stay finite. The Sun has 2e30 kg.
const LARGEST: f64 = 1e40;

/// What is wrong with the size of numbers, and how to mend it.
fn wrong_size(numbers: &[f64]) -> Option<(&'static str, &'static str)> {
    if !numbers.iter().all(|x| x.is_finite()) {
        return Some(("not finite", "write a finite number"));
    }
    let is_large = numbers.iter().any(|x| x.abs() > LARGEST);
    is_large.then_some(("beyond 1e40", "no vehicle is so large: SI units are meant"))
}

/// Complains of numbers that are not finite, or so large that what is computed of them is not.
fn check_finite(link: &Link, matter: &Matter, found: &mut Findings) -> bool {
    let checks: [(&str, &Range<usize>, &[f64]); 3] = [
        ("mass", &matter.mass_at, &[matter.mass]),
        ("centre of mass", &link.at, &matter.p_cm.to_array()),
        ("inertia", &matter.inertia_at, &elements(matter.inertia)),
    ];
    let mut fine = true;
    for (what, at, numbers) in checks {
        let Some((wrong, help)) = wrong_size(numbers) else { continue };
        found.error(at, format!("{what} of '{}' is {wrong}", link.name), wrong, help);
        fine = false;
    }
    fine
}

/// Complains of a body that no matter makes: links that are fixed to each other, and their inertia
/// together, about the origin of the body.
pub(crate) fn check_body(
    parts: &[(&Link, &Matter)],
    M_B: &SpatialInertia<f64>,
    found: &mut Findings,
) {
    let mut alone: Vec<_> = parts.iter().map(|(_, matter)| wrong_alone(matter)).collect();
    for ((link, matter), wrong) in parts.iter().zip(&alone) {
        if wrong.is_none() && matter.accept_nonphysical.as_ref().is_some_and(|why| why.of_this) {
            let message = format!(
                "'{}' accepts non-physical mass properties, but its are possible",
                link.name
            );
            found.warning(&link.at, message, "this link", "leave out `accept_nonphysical`");
        }
    }
    if let [_] = parts {
        let wrong = alone.pop().flatten();
        return tell(parts, wrong, found);
    }
    let about_origin = M_B.rotational;
    let whole = Body {
        mass: M_B.mass,
        inertia: if M_B.mass > 0.0 { M_B.central() } else { about_origin },
        rounding: parts.iter().fold(Rounding::default(), |sum, (_, m)| sum.and(m.rounding)),
        size: about_origin.xx + about_origin.yy + about_origin.zz,
    };
    let together = whole.wrong();
    if together.is_none() {
        for (part, wrong) in parts.iter().zip(&alone) {
            tell_of_part(*part, wrong.as_ref(), found);
        }
    }
    tell(parts, together, found);
}

/// A body, or a link on its own.
struct Body {
    mass: f64,
    /// About its centre of mass (kg·m²).
    inertia: Sym3<f64>,
    rounding: Rounding,
    /// How large the numbers are that its inertia was computed from (kg·m²): what round-off is of.
    size: f64,
}

/// What the triangle inequality may be broken by, as a part of the largest moment (–): a thin rod
/// meets it with equality, and its file rounds each number on its own.
const ROUND_OFF: f64 = 1e-9;

/// Round-off of sums that bring an inertia to another point, as a part of what is summed (–).
const OF_SUMS: f64 = 1e-12;

/// What mass properties break.
enum Wrong {
    /// Inertia without mass.
    NoMass,
    /// The least moment is below zero.
    Indefinite([f64; 3]),
    /// The largest moment exceeds the sum of the others.
    Triangle([f64; 3]),
    /// The same, by no more than the digits that are written.
    Rounded([f64; 3], f64),
}

fn wrong_alone(matter: &Matter) -> Option<Wrong> {
    let &Matter { mass, inertia, rounding, p_cm, .. } = matter;
    // A tensor is often computed from one about the frame, by taking away what the lever makes.
    let size = inertia.xx + inertia.yy + inertia.zz + 2.0 * mass * p_cm.dot(p_cm);
    Body { mass, inertia, rounding, size: size.abs() }.wrong()
}

/// Whether a tensor is no rigid body's, and could be one's by the digits that it is written with.
pub(crate) fn is_rounded(matter: &Matter) -> bool {
    matches!(wrong_alone(matter), Some(Wrong::Rounded(..)))
}

impl Body {
    fn wrong(&self) -> Option<Wrong> {
        let moments = principal_moments(self.inertia);
        let [a, b, c] = moments;
        let by_sums = OF_SUMS * self.size;
        if self.mass == 0.0 && self.inertia != Sym3::zero() {
            return Some(Wrong::NoMass);
        }
        let excess = c - a - b;
        let rounded =
            a >= -self.rounding.moment - by_sums && excess <= self.rounding.of_triangle() + by_sums;
        if a >= -by_sums && excess <= ROUND_OFF * c.abs() + 3.0 * by_sums {
            None
        } else if rounded {
            Some(Wrong::Rounded(moments, excess.max(-a)))
        } else if a < -self.rounding.moment - by_sums {
            Some(Wrong::Indefinite(moments))
        } else {
            Some(Wrong::Triangle(moments))
        }
    }
}

/// The names of the links of a body, for a complaint about its inertia.
fn names(parts: &[(&Link, &Matter)]) -> String {
    let all: Vec<_> = parts.iter().map(|(link, _)| format!("'{}'", link.name)).collect();
    match &all[..] {
        [one] => one.clone(),
        [first, others @ ..] if others.len() <= 3 => {
            format!("{first} with what is fixed to it ({})", others.join(", "))
        }
        [first, others @ ..] => format!("{first} with {} links fixed to it", others.len()),
        [] => "nothing".into(),
    }
}

/// One complaint about a body.
fn tell(parts: &[(&Link, &Matter)], wrong: Option<Wrong>, found: &mut Findings) {
    let Some(wrong) = wrong else { return };
    // The part that is wrong by itself is where to look.
    let guilty = parts.iter().find(|(_, matter)| wrong_alone(matter).is_some());
    let Some((_, matter)) = guilty.or(parts.first()) else { return };
    let (at, name) = (&matter.inertia_at, names(parts));
    match wrong {
        Wrong::NoMass => {
            let message = format!("mass of {name} must be positive, found 0 kg");
            let help = "leave out the mass properties of a link that is only a frame";
            refuse_or_accept(parts, (&matter.mass_at, message, "this mass", help), found);
        }
        Wrong::Indefinite(moments) => {
            let message = format!(
                "inertia of {name} is not positive definite: its principal moments are {} kg·m²",
                listed(moments)
            );
            let help = "give a small part the inertia of a ball, 0.4 m r²; \
                        check the signs of the products of inertia";
            found.error(at, message, "this inertia", help);
        }
        Wrong::Triangle(moments) => {
            let message = triangle(&name, moments);
            refuse_or_accept(parts, (at, message, "this inertia", IMPOSSIBLE), found);
        }
        Wrong::Rounded(moments, by) => {
            let message = format!(
                "inertia of {name} is no rigid body's by {} kg·m², which is within the digits that \
                 are written: its principal moments are {} kg·m²",
                figures(by),
                listed(moments)
            );
            let help = "used as it stands; one digit more would settle it";
            found.warning(at, message, "rounded", help);
        }
    }
}

/// An error, or a warning where the file gives its reason.
fn refuse_or_accept(
    parts: &[(&Link, &Matter)],
    (at, message, label, help): (&Range<usize>, String, &str, &str),
    found: &mut Findings,
) {
    match parts.iter().find_map(|(_, matter)| matter.accept_nonphysical.as_ref()) {
        None => found.error(at, message, label, help),
        Some(why) => {
            let help = format!("used as it stands, because the file says: {}", why.reason);
            found.warning(at, message, label, &help);
        }
    }
}

/// What is wrong with a link alone, when the body that it is part of can be.
fn tell_of_part((link, matter): (&Link, &Matter), wrong: Option<&Wrong>, found: &mut Findings) {
    let what = match wrong {
        None | Some(Wrong::Rounded(..)) => return,
        Some(Wrong::NoMass) => format!("'{}' has an inertia and no mass", link.name),
        Some(Wrong::Indefinite(moments)) => {
            format!("principal moments of '{}' are {} kg·m²", link.name, listed(*moments))
        }
        Some(Wrong::Triangle(moments)) => triangle(&format!("'{}'", link.name), *moments),
    };
    let help = "it is fixed to others, and together they are a body that can be: used as it stands";
    found.warning(&matter.inertia_at, what, "no rigid body alone", help);
}

fn listed(moments: [f64; 3]) -> String {
    moments.map(figures).join(", ")
}

fn triangle(name: &str, moments: [f64; 3]) -> String {
    let [a, b, c] = moments;
    format!(
        "inertia of {name} breaks the triangle inequality: of its principal moments {} kg·m² the \
         largest exceeds the sum of the others by {} kg·m²",
        listed(moments),
        figures(c - a - b)
    )
}

/// What to do about it.
const IMPOSSIBLE: &str = "no rigid body is like this: is it about the centre of mass? A TOML file can \
                          say `accept_nonphysical = \"reason\"`, of a body or of an [[include]], where \
                          published data are so";

/// When to give up on eigenvalues: nalgebra goes on until it converges unless told; a 3×3 takes
/// about ten steps.
const MOST_ITERATIONS: usize = 100;

/// Principal moments of a symmetric, finite matrix, smallest first.
pub(crate) fn principal_moments(I: Sym3<f64>) -> [f64; 3] {
    let diagonal = [I.xx, I.yy, I.zz];
    let is_diagonal = [I.xy, I.xz, I.yz].iter().all(|&x| x == 0.0);
    // Diagonal ones stay as they were written: no rounding in the complaint.
    let mut moments = if is_diagonal { diagonal } else { eigenvalues(I).unwrap_or(diagonal) };
    moments.sort_by(f64::total_cmp);
    moments
}

fn eigenvalues(I: Sym3<f64>) -> Option<[f64; 3]> {
    let matrix = Matrix3::new(I.xx, I.xy, I.xz, I.xy, I.yy, I.yz, I.xz, I.yz, I.zz);
    let eigen = SymmetricEigen::try_new(matrix, f64::EPSILON, MOST_ITERATIONS)?;
    Some(eigen.eigenvalues.into())
}

/// Complains of axes and limits that cannot be.
pub(crate) fn check_joint(joint: &AssemblyJoint, found: &mut Findings) {
    let name = &joint.name;
    let X = &joint.X_PC;
    let mut rows = X.rotation.rows.iter().chain([&X.translation]);
    if let Some((wrong, help)) = rows.find_map(|row| wrong_size(&row.to_array())) {
        let message = format!("the pose of joint '{name}' on its parent is {wrong}");
        found.error(&joint.at, message, wrong, help);
    }
    let followed = joint.mimic.as_ref().map_or([0.0; 2], |mimic| [mimic.ratio, mimic.offset]);
    if let Some((wrong, help)) = wrong_size(&followed) {
        let message = format!("what joint '{name}' does as it follows is {wrong}");
        found.error(&joint.at, message, wrong, help);
    }
    if joint.kind.is_none() {
        return;
    }
    if let Some((wrong, help)) = wrong_size(&joint.axis.to_array()) {
        let message = format!("the axis of joint '{name}' is {wrong}");
        found.error(&joint.axis_at, message, wrong, help);
    } else if joint.axis.norm() < f64::MIN_POSITIVE {
        let message = format!("the axis of joint '{name}' is zero: it has no direction");
        found.error(&joint.axis_at, message, "this axis", "write a direction, such as 0 0 1");
    }
    check_limits(joint, found);
}

fn check_limits(joint: &AssemblyJoint, found: &mut Findings) {
    let (name, at, limits) = (&joint.name, &joint.limits_at, &joint.limits);
    let travel = limits.travel.map_or([0.0; 2], |(lower, upper)| [lower, upper]);
    let capacity = [limits.rate, limits.effort].map(Option::unwrap_or_default);
    // Some files say 1.8e308 of what is not limited.
    if !travel.iter().chain(&capacity).all(|x| x.is_finite()) {
        let message = format!("a limit of joint '{name}' is not finite");
        found.error(at, message, "not finite", "leave out what is not limited");
        return;
    }
    let [lower, upper] = travel;
    if lower > upper {
        let message =
            format!("the limits of joint '{name}' are reversed: lower {lower}, upper {upper}");
        found.error(at, message, "lower is above upper", "exchange them");
    }
    for (what, value) in ["rate", "effort"].into_iter().zip(capacity) {
        if value < 0.0 {
            let message = format!("the {what} limit of joint '{name}' is negative: {value}");
            found.error(at, message, "this limit", "limits are magnitudes: leave out the sign");
        }
    }
}

fn elements(I: Sym3<f64>) -> [f64; 6] {
    [I.xx, I.xy, I.xz, I.yy, I.yz, I.zz]
}
