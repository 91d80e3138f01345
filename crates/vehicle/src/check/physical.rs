//! Whether the mass properties and joints of a file can be.

use crate::assembly::{AssemblyJoint, Link, Matter};
use crate::figures::figures;
use crate::findings::Findings;
use nalgebra::{Matrix3, SymmetricEigen};
use wrasse_document::Severity;
use wrasse_spatial::{Sym3, Vec3};

/// Complains of mass properties that no rigid body has.
pub(crate) fn check_matter(link: &Link, found: &mut Findings) {
    let Some(matter) = &link.matter else { return };
    if !check_finite(link, matter, found) {
        return;
    }
    let name = &link.name;
    let mut possible = matter.mass > 0.0;
    if !possible {
        let message = format!("mass of '{name}' must be positive, found {} kg", matter.mass);
        let help = "leave out the mass properties of a link that is only a frame";
        found.error(&matter.mass_at, message, "this mass", help);
    }
    if let Some(Wrong { message, help, flies }) = wrong_with_inertia(name, matter.inertia) {
        possible = false;
        match matter.accept_nonphysical.as_ref().filter(|_| flies) {
            None => found.error(&matter.inertia_at, message, "this inertia", help),
            Some(reason) => {
                let help = format!("used as it stands, because the file says: {reason}");
                found.add(Severity::Warning, &matter.inertia_at, message, "this inertia", &help);
            }
        }
    }
    if possible && matter.accept_nonphysical.is_some() {
        let message =
            format!("'{name}' accepts non-physical mass properties, but its are possible");
        found.warning(&link.at, message, "this link", "leave out `accept_nonphysical`");
    }
}

/// Complains of numbers that are not finite.
fn check_finite(link: &Link, matter: &Matter, found: &mut Findings) -> bool {
    let help = "write a finite number";
    let I = matter.inertia;
    let inertia = [I.xx, I.xy, I.xz, I.yy, I.yz, I.zz];
    let checks = [
        ("mass", &matter.mass_at, matter.mass.is_finite()),
        ("centre of mass", &link.at, is_finite(matter.p_cm)),
        ("inertia", &matter.inertia_at, inertia.iter().all(|x| x.is_finite())),
    ];
    for (what, at, _) in checks.iter().filter(|(_, _, finite)| !finite) {
        found.error(at, format!("{what} of '{}' is not finite", link.name), "not finite", help);
    }
    checks.iter().all(|&(_, _, finite)| finite)
}

/// What the triangle inequality may be broken by, as a part of the largest moment (–): a thin rod
/// meets it with equality, and its file rounds each number on its own.
const ROUND_OFF: f64 = 1e-9;

/// What to do about it.
const IMPOSSIBLE: &str = "no rigid body is like this: is it about the centre of mass? A TOML file can \
                          say `accept_nonphysical = \"reason\"` where published data are so";

/// What a central inertia breaks, and how to mend it.
struct Wrong {
    message: String,
    help: &'static str,
    /// Whether equations of motion can be solved with it all the same.
    flies: bool,
}

fn wrong_with_inertia(name: &str, inertia: Sym3<f64>) -> Option<Wrong> {
    let moments = principal_moments(inertia);
    let [a, b, c] = moments;
    let shown = moments.map(figures).join(", ");
    if a <= 0.0 {
        let message = format!(
            "inertia of '{name}' is not positive definite: its principal moments are \
             {shown} kg·m²"
        );
        let help = "give a small part the inertia of a ball, 0.4 m r²; \
                    check the signs of the products of inertia";
        return Some(Wrong { message, help, flies: false });
    }
    (c > (a + b) * (1.0 + ROUND_OFF)).then(|| {
        let message = format!(
            "inertia of '{name}' breaks the triangle inequality: of its principal moments {shown} \
             kg·m² the largest exceeds the sum of the others by {} kg·m²",
            figures(c - a - b)
        );
        Wrong { message, help: IMPOSSIBLE, flies: true }
    })
}

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
    if !X.rotation.rows.iter().chain([&X.translation]).all(|&row| is_finite(row)) {
        let message = format!("the pose of joint '{name}' on its parent is not finite");
        found.error(&joint.at, message, "not finite", "write finite numbers");
    }
    if joint.kind.is_none() {
        return;
    }
    if !is_finite(joint.axis) {
        let message = format!("the axis of joint '{name}' is not finite");
        found.error(&joint.axis_at, message, "not finite", "write finite numbers");
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
    if !travel.iter().chain(&capacity).all(|x| x.is_finite()) {
        let message = format!("a limit of joint '{name}' is not finite");
        let help = "leave out what is not limited";
        found.error(at, message, "not finite", help);
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

fn is_finite(a: Vec3<f64>) -> bool {
    a.to_array().iter().all(|x| x.is_finite())
}
