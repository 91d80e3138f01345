//! Values that can be, but are worth a second look: most are a wrong unit.

use super::physical::principal_moments;
use crate::assembly::{AssemblyJoint, Link};
use crate::figures::figures;
use crate::findings::Findings;
use wrasse_dynamics::{BodyId, JointKind};

/// Longest half-length of a link of an arm that is believed (m): the longest arm flown has booms of
/// 7 m.
const LINK_SIZE: f64 = 10.0;
/// The same for the base (m): the International Space Station is 109 m wide.
pub(crate) const BASE_SIZE: f64 = 55.0;
/// Smallest radius of gyration that is believed (m).
const SMALLEST_GYRATION: f64 = 1e-3;
/// Density of osmium, the densest of the metals (kg/m³).
pub(crate) const OSMIUM: f64 = 22_590.0;
/// Smallest mass of a moving body that is believed, as a part of the whole (–).
const SMALLEST_MASS: f64 = 1e-6;
/// What is thinner than this (m) is an idealisation, not a mistake.
const THIN: f64 = 1e-4;
/// Two turns (rad): what lies beyond was meant in degrees, or is no limit.
pub(crate) const TWO_TURNS: f64 = 4.0 * core::f64::consts::PI;

/// Warns of mass properties that hardly any link has.
pub(crate) fn doubt_matter(link: &Link, body: BodyId, found: &mut Findings) {
    let Some(matter) = &link.matter else { return };
    let moments = principal_moments(matter.inertia);
    if matter.mass <= 0.0 || moments[0] <= 0.0 {
        return;
    }
    let (name, at) = (&link.name, &matter.inertia_at);
    let size = if body == BodyId::Base { BASE_SIZE } else { LINK_SIZE };
    let gyration = (moments[2] / matter.mass).sqrt();
    if gyration > size || gyration < SMALLEST_GYRATION {
        let message = format!(
            "the radius of gyration of '{name}' is {} m: {} kg·m² on {} kg",
            figures(gyration),
            figures(moments[2]),
            matter.mass
        );
        found.warning(at, message, "this inertia", "inertia is in kg·m²");
    } else if ellipsoid_density(matter.mass, moments) > OSMIUM {
        let message = format!(
            "'{name}' is denser than osmium: an even ellipsoid with its mass and inertia has \
             {} kg/m³",
            figures(ellipsoid_density(matter.mass, moments))
        );
        found.warning(at, message, "this inertia", "is the inertia about the centre of mass?");
    }
    if matter.p_cm.norm() > size {
        let away = figures(matter.p_cm.norm());
        let message = format!("the centre of mass of '{name}' is {away} m from its frame");
        found.warning(&link.at, message, "this link", "positions are in metres");
    }
}

/// Density of the even ellipsoid with this mass and these principal moments (kg/m³); zero for a
/// shape without volume (an ideal rod), which says nothing.
pub(crate) fn ellipsoid_density(mass: f64, [a, b, c]: [f64; 3]) -> f64 {
    // Semi-axes from I_x = m (y² + z²)/5.
    let square = |sum: f64| (2.5 * sum / mass).max(0.0);
    let product = square(b + c - a) * square(c + a - b) * square(a + b - c);
    if square(a + b - c).sqrt() < THIN {
        return 0.0;
    }
    mass / (4.0 / 3.0 * core::f64::consts::PI * product.sqrt())
}

/// Warns of limits that hardly any joint has.
pub(crate) fn doubt_joint(joint: &AssemblyJoint, found: &mut Findings) {
    let Some(kind) = joint.kind else { return };
    let (name, at, limits) = (&joint.name, &joint.limits_at, &joint.limits);
    for (what, value) in [("rate", limits.rate), ("effort", limits.effort)] {
        if value == Some(0.0) {
            let message = format!("the {what} limit of joint '{name}' is 0: it cannot be driven");
            found.warning(at, message, "this limit", "leave out what is not limited or not known");
        }
    }
    let Some((lower, upper)) = limits.travel else { return };
    if lower == upper {
        let message = format!("joint '{name}' has no travel: both limits are {lower}");
        found.warning(at, message, "no travel", "is it a fixed joint?");
    }
    if kind == JointKind::Revolute && lower.abs().max(upper.abs()) > TWO_TURNS {
        let message =
            format!("joint '{name}' turns more than twice round: from {lower} to {upper} rad");
        found.warning(at, message, "these limits", "are the limits in degrees?");
    }
}

/// Warns of a moving body that is next to nothing: its equations lose the digits that it lacks.
pub(crate) fn doubt_mass(joint: &AssemblyJoint, mass: f64, whole: f64, found: &mut Findings) {
    if mass > 0.0 && mass < SMALLEST_MASS * whole {
        let message = format!(
            "joint '{}' carries {} kg of {} kg: less than a millionth",
            joint.name,
            figures(mass),
            figures(whole)
        );
        found.warning(&joint.child_at, message, "this body", "is its mass in tonnes?");
    }
}
