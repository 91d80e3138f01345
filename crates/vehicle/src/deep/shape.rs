//! The tensor of a link against the shape that is drawn of it.

use super::finding::{Finding, FindingKind, FindingSeverity, Fine};
use super::parts::Part;
use crate::check::{PrincipalAxis, angle_between, axis_in_words, long_axis};
use crate::figures::figures;

/// A tensor and a shape have a long axis where matter lies this many times as far along it (–): below,
/// its direction is more noise than statement.
const LONG: f64 = 2.0;
/// Largest angle between the long axes that is believed (deg). The widest of the catalogue is 2.6 deg.
const LONG_AXES_APART: f64 = 30.0;
/// Round-off and roughness of outlines that is allowed to the spread (–).
const ROUGH: f64 = 1.05;
/// Least radius of gyration, as a part of that of an even solid, that is believed (–): a mass in the
/// middle quarter of its shape. The least of the catalogue is 0.69.
const LEAST_GYRATION: f64 = 0.25;

/// Findings about tensors and shapes, and how many links were compared.
pub(super) fn shape_findings(parts: &[Part<'_>]) -> (Vec<Finding>, Fine) {
    let compared: Vec<_> =
        parts.iter().filter(|part| part.is_drawn_whole && !part.own.is_empty()).collect();
    let found = compared.iter().filter_map(|part| across(part).or(beyond(part)).or(below(part)));
    let message = match compared.len() {
        0 => "no link is drawn by simple shapes alone: not compared".to_owned(),
        count => format!("agrees with what is drawn (links: {count})"),
    };
    let numbers = vec![("links", compared.len() as f64)];
    (found.collect(), Fine { kind: FindingKind::InertiaBeyondShape, message, numbers })
}

/// Matter between two ends with its mean at `c` has at most the mean square distance
/// `(c − lower)(upper − c)` from the mean: all of it is then at the ends.
fn most_spread(part: &Part<'_>, axis: &PrincipalAxis) -> f64 {
    let (lower, upper) = part.body.ends_along(axis.along);
    let c = axis.along.dot(part.matter.p_cm);
    // A centre of mass outside is another matter: the spread is then held against the whole length.
    if c < lower || c > upper { 0.25 * (upper - lower).powi(2) } else { (c - lower) * (upper - c) }
}

fn beyond(part: &Part<'_>) -> Option<Finding> {
    let (axis, most) = part.axes.iter().find_map(|axis| {
        let most = most_spread(part, axis);
        (axis.spread > ROUGH * ROUGH * most).then_some((axis, most))
    })?;
    let (spread, most) = (axis.spread.sqrt(), most.sqrt());
    let message = format!(
        "matter lies {} m (r.m.s.) from its centre of mass along {}; within what is drawn it can be at \
         most {} m: the inertia is wrong, or not all of the part is drawn",
        figures(spread),
        axis_in_words(axis.along),
        figures(most)
    );
    let numbers = vec![("spread_m", spread), ("most_spread_m", most)];
    Some(part.finding(FindingKind::InertiaBeyondShape, FindingSeverity::Warning, message, numbers))
}

fn across(part: &Part<'_>) -> Option<Finding> {
    let of_matter = long_axis(&part.axes, LONG)?;
    let of_shape = [&part.own, &part.body].map(|drawn| long_axis(&drawn.solid_axes()?, LONG));
    let [Some(own), Some(body)] = of_shape else { return None };
    let [own_angle, angle] = [own, body].map(|axis| angle_between(axis, of_matter).to_degrees());
    if own_angle <= LONG_AXES_APART || angle <= LONG_AXES_APART {
        return None;
    }
    let message = format!(
        "its least moment is about {}, and what is drawn is long along {}: {} deg apart",
        axis_in_words(of_matter),
        axis_in_words(own),
        figures(own_angle)
    );
    let numbers = vec![("angle_deg", own_angle)];
    Some(part.finding(FindingKind::InertiaAcrossShape, FindingSeverity::Warning, message, numbers))
}

fn below(part: &Part<'_>) -> Option<Finding> {
    let solid = part.own.solid_axes()?;
    let even = solid.iter().map(|axis| axis.gyration).fold(0.0, f64::max);
    let gyration = part.gyration();
    if gyration >= LEAST_GYRATION * even {
        return None;
    }
    let message = format!(
        "its largest radius of gyration is {} m; an even solid of the drawn shape has {} m",
        figures(gyration),
        figures(even)
    );
    let numbers = vec![("gyration_m", gyration), ("solid_gyration_m", even)];
    Some(part.finding(FindingKind::InertiaBelowShape, FindingSeverity::Warning, message, numbers))
}
