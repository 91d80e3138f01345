//! Warns of inertia that contradicts what the same file draws. Only the blatant is warned of in every
//! reading: outlines are often rough.

use super::drawn::Drawn;
use super::principal::{angle_between, axis_in_words, long_axis, principal_axes};
use crate::assembly::{Assembly, Link, Matter, Outline};
use crate::figures::figures;
use crate::findings::Findings;
use std::collections::BTreeMap;
use wrasse_dynamics::Frame;

/// An outline or a tensor is clearly elongated where matter lies this many times as far along its long
/// axis as across (–).
const CLEARLY_LONG: f64 = 3.0;
/// Two axes are at right angles within this many degrees.
const RIGHT_ANGLE: f64 = 30.0;
/// What a radius of gyration may exceed the farthest corner by (–). Outlines are often shorter and thinner
/// than the part: the most of the catalogue is 1.19, a station that is drawn without its trusses.
const ROUGH: f64 = 1.5;

/// Warns of each link with outlines whose inertia no matter within them can have, or lies across them.
///
/// What is fixed to a link counts as drawn of it: many files put the mass of a whole assembly on one
/// link. A body that is drawn by more than outlines (a mesh) is left alone.
pub(crate) fn doubt_against_shape(
    assembly: &Assembly,
    frames: &[Frame<f64>],
    found: &mut Findings,
) {
    let placed = || assembly.links.iter().zip(frames);
    let frame_of: BTreeMap<&str, &Frame<f64>> =
        placed().map(|(link, frame)| (&*link.name, frame)).collect();
    let mut outlines_of: BTreeMap<&str, Vec<&Outline>> = BTreeMap::new();
    for outline in &assembly.outlines {
        outlines_of.entry(&outline.link).or_default().push(outline);
    }
    for (link, frame) in placed() {
        let Some(matter) = link.matter.as_ref().filter(|matter| matter.mass > 0.0) else {
            continue;
        };
        let Some(own) = outlines_of.get(&*link.name) else { continue };
        let own = Drawn::of(own.iter().map(|outline| (outline.X_LF, outline.kind)));
        // The whole is looked at only where the link's own outlines are contradicted.
        let whole = || {
            let on_body = frame_of.iter().filter(|(_, other)| other.body == frame.body);
            let mut drawn = vec![];
            for (name, other) in on_body {
                if assembly.partly_drawn.contains(*name) {
                    return None;
                }
                let X_LO = frame.X_BF.inverse() * other.X_BF;
                let outlines = outlines_of.get(name).into_iter().flatten();
                drawn.extend(outlines.map(|outline| (X_LO * outline.X_LF, outline.kind)));
            }
            Some(Drawn::of(drawn))
        };
        let complaint = |drawn: &Drawn| beyond(link, matter, drawn).or(across(link, matter, drawn));
        let Some(message) = complaint(&own) else { continue };
        if whole().is_some_and(|whole| complaint(&whole).is_some()) {
            found.warning(&matter.inertia_at, message, "this inertia", HELP);
        }
    }
}

/// How to mend either.
const HELP: &str = "inertia is in kg·m², about the centre of mass, in the axes that the file says; \
                    sizes are in metres";

/// What is wrong where a radius of gyration is beyond the farthest corner: the mean square of distances
/// from an axis through the centre of mass is at most the square of the largest distance from that centre.
fn beyond(link: &Link, matter: &Matter, drawn: &Drawn) -> Option<String> {
    let axes = principal_axes(matter.mass, matter.inertia)?;
    let farthest = drawn.farthest_from(matter.p_cm);
    let axis = axes.into_iter().find(|axis| axis.gyration > ROUGH * farthest)?;
    Some(format!(
        "the inertia of '{}' is beyond its shape: about {} its radius of gyration is {} m, and no \
         part of what is drawn is more than {} m from its centre of mass",
        link.name,
        axis_in_words(axis.along),
        figures(axis.gyration),
        figures(farthest)
    ))
}

/// What is wrong where a long tensor lies across a long outline.
fn across(link: &Link, matter: &Matter, drawn: &Drawn) -> Option<String> {
    let of_shape = long_axis(&drawn.solid_axes()?, CLEARLY_LONG)?;
    let of_matter = long_axis(&principal_axes(matter.mass, matter.inertia)?, CLEARLY_LONG)?;
    let angle = angle_between(of_shape, of_matter).to_degrees();
    (angle > 90.0 - RIGHT_ANGLE).then(|| {
        format!(
            "the inertia of '{}' lies across its shape: its least moment is about {}, and what is \
             drawn is long along {}",
            link.name,
            axis_in_words(of_matter),
            axis_in_words(of_shape)
        )
    })
}
