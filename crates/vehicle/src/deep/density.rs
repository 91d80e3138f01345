//! The mass of a link against its volume: that of its outlines, else of its ellipsoid of inertia.

use super::finding::{Finding, FindingKind, FindingSeverity, Fine};
use super::parts::Part;
use crate::check::{OSMIUM, ellipsoid_density, principal_moments};
use crate::figures::figures;

/// Density below which nothing is built (kg/m³): the lightest rigid foams have about 10, and outlines
/// hold air. The emptiest outline of the catalogue has 35.
pub(super) const FOAM: f64 = 5.0;

/// Mass over volume of a part (kg/m³), and what the volume is of; `None` where nothing has a volume.
///
/// Where more is drawn than outlines, or stands on links that are fixed to it, the outlines of the whole
/// body decide above, and those of the link alone below.
pub(super) fn density(part: &Part<'_>) -> Option<(f64, &'static str)> {
    if part.own.is_empty() {
        let moments = principal_moments(part.matter.inertia);
        let even = ellipsoid_density(part.matter.mass, moments);
        return (even > 0.0 && even.is_finite()).then_some((even, "its ellipsoid of inertia"));
    }
    let own = part.matter.mass / part.own.volume;
    let body = part.body_mass / part.body.volume;
    let is_vague = own > OSMIUM && (!part.is_drawn_whole || body <= OSMIUM);
    (!is_vague && own.is_finite()).then_some((own, "what is drawn of it"))
}

/// Findings about densities, and the range of those that were compared.
pub(super) fn density_findings(parts: &[Part<'_>]) -> (Vec<Finding>, Fine) {
    let (mut found, mut compared) = (vec![], 0);
    let (mut least, mut most) = (f64::INFINITY, 0.0_f64);
    for part in parts {
        let Some((density, volume)) = density(part) else { continue };
        compared += 1;
        (least, most) = (least.min(density), most.max(density));
        let against = if density < FOAM {
            format!("lighter than foam ({FOAM} kg/m³)")
        } else if density > OSMIUM {
            format!("denser than osmium ({OSMIUM} kg/m³)")
        } else {
            continue;
        };
        let message = format!(
            "{} kg in the volume of {volume}: {} kg/m³, {against}",
            figures(part.matter.mass),
            figures(density)
        );
        let numbers = vec![("mass_kg", part.matter.mass), ("density_kg_m3", density)];
        let severity =
            if density < FOAM { FindingSeverity::Note } else { FindingSeverity::Warning };
        found.push(part.finding(FindingKind::Density, severity, message, numbers));
    }
    let message = if compared == 0 {
        "no link has a volume: not compared".to_owned()
    } else {
        format!("{} to {} kg/m³ (links: {compared})", figures(least), figures(most))
    };
    let numbers = vec![("links", f64::from(compared))];
    (found, Fine { kind: FindingKind::Density, message, numbers })
}
