//! The radius of gyration of a link against how far its joints are apart: for links of which no shape
//! is drawn.

use super::finding::{Finding, FindingKind, FindingSeverity, Fine};
use super::parts::Part;
use crate::figures::figures;

/// Radius of gyration as a part of the distance from the centre of mass to the farthest joint (–).
/// A rod between two joints has 0.58. Wrists with joints close together have much more than 1.
const MOST: f64 = 5.0;
/// Matter in a small lump on a long link has little: a rod's is 0.58, a motor's at one end about 0.1.
const LEAST: f64 = 0.03;

/// Findings about radii of gyration, and how many links were compared.
pub(super) fn size_findings(parts: &[Part<'_>]) -> (Vec<Finding>, Fine) {
    let (mut found, mut compared) = (vec![], 0);
    let (mut least, mut most) = (f64::INFINITY, 0.0_f64);
    for part in parts.iter().filter(|part| part.own.is_empty() || !part.is_drawn_whole) {
        let Some((size, ..)) = part.size() else { continue };
        let share = part.gyration() / size;
        compared += 1;
        (least, most) = (least.min(share), most.max(share));
        if (LEAST..=MOST).contains(&share) {
            continue;
        }
        let message = format!(
            "its largest radius of gyration is {} m, its farthest joint {} m from its centre of mass: \
             {} times that, usual is {LEAST} to {MOST}",
            figures(part.gyration()),
            figures(size),
            figures(share)
        );
        let numbers = vec![("gyration_m", part.gyration()), ("joint_distance_m", size)];
        let kind = FindingKind::GyrationAgainstSize;
        found.push(part.finding(kind, FindingSeverity::Note, message, numbers));
    }
    let message = if compared == 0 {
        "no link without a drawn shape lies between two joints: not compared".to_owned()
    } else {
        format!(
            "{} to {} of the distance to the farthest joint (links: {compared})",
            figures(least),
            figures(most)
        )
    };
    let numbers = vec![("links", f64::from(compared))];
    (found, Fine { kind: FindingKind::GyrationAgainstSize, message, numbers })
}
