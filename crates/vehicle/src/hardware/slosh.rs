//! The table `[actuators.tank.slosh]`.

use super::numbers::{Figure, check_figures};
use super::unit::direction;
use crate::figures::figures;
use crate::table::{ProvenanceFile, Reading, under};
use schemars::JsonSchema;
use serde::Deserialize;
use wrasse_document::Step;
use wrasse_hardware::{Slosh, Tank, TankShape};

/// What the tank is called in complaints.
const OF: &str = "the slosh of the tank";

/// Propellant that swings in the tank, as a pendulum whose mass and length follow from the shape of the
/// tank and how full it is. It has a `cylinder` or a `sphere`.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SloshFile {
    /// Inside of an upright cylinder with a flat bottom.
    pub(crate) cylinder: Option<CylinderFile>,
    /// Inside of a sphere.
    pub(crate) sphere: Option<SphereFile>,
    /// From bottom to top of the tank, in the base's frame (–), of any length: the way in which the base
    /// accelerates when the liquid lies at the bottom.
    pub(crate) axis: [f64; 3],
    /// Density of the propellant (kg/m³).
    pub(crate) density_kg_m3: f64,
    /// Damping ratio of the swing (–).
    pub(crate) damping_ratio: f64,
    /// Acceleration along the axis for which the damping ratio holds (m/s²); zero if not given.
    #[serde(default)]
    pub(crate) acceleration_m_s2: f64,
    /// What brings the liquid back to the axis without any acceleration (N·m/rad), surface tension or a
    /// device in the tank; nothing if not given.
    #[serde(default)]
    pub(crate) stiffness_nm_rad: f64,
    /// Where these numbers come from.
    #[serde(flatten)]
    pub(crate) provenance: ProvenanceFile,
}

/// The inside of an upright cylinder.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct CylinderFile {
    /// Radius (m).
    pub(crate) radius_m: f64,
    /// From the flat bottom to the lid (m).
    pub(crate) height_m: f64,
}

/// The inside of a sphere.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SphereFile {
    /// Radius (m).
    pub(crate) radius_m: f64,
}

/// How the propellant swings; `None` after a complaint if it cannot be.
pub(crate) fn slosh(
    reading: &mut Reading<'_>,
    path: &[Step<'_>],
    file: &SloshFile,
    tank: &Tank<f64>,
) -> Option<Slosh> {
    let axis_B = direction(reading, path, OF, "axis", file.axis);
    let shape = shape(reading, path, file);
    let numbers = [
        Figure::positive("density_kg_m3", file.density_kg_m3, (50.0, 4000.0)),
        Figure::not_negative("damping_ratio", file.damping_ratio, 0.3),
        Figure::not_negative("acceleration_m_s2", file.acceleration_m_s2, 100.0),
        Figure::not_negative("stiffness_nm_rad", file.stiffness_nm_rad, 1e4),
    ];
    let possible = check_figures(reading, path, OF, &numbers);
    check_damping(reading, path, file);
    let slosh = Slosh {
        axis_B: axis_B?,
        shape: shape?,
        density: file.density_kg_m3,
        damping_ratio: file.damping_ratio,
        acceleration: file.acceleration_m_s2,
        stiffness: file.stiffness_nm_rad,
    };
    if !possible || tank.propellant < 0.0 {
        return None;
    }
    check_fill(reading, path, &slosh, tank.propellant);
    Some(slosh)
}

/// The inside of the tank; `None` after a complaint if there is none, or more than one.
fn shape(reading: &mut Reading<'_>, path: &[Step<'_>], file: &SloshFile) -> Option<TankShape> {
    let (shape, key, numbers) = match (&file.cylinder, &file.sphere) {
        (Some(inside), None) => {
            let (radius, height) = (inside.radius_m, inside.height_m);
            let numbers = vec![
                Figure::positive("radius_m", radius, (0.02, 5.0)),
                Figure::positive("height_m", height, (0.02, 20.0)),
            ];
            (TankShape::UprightCylinder { radius, height }, "cylinder", numbers)
        }
        (None, Some(inside)) => {
            let radius = inside.radius_m;
            let numbers = vec![Figure::positive("radius_m", radius, (0.02, 5.0))];
            (TankShape::Sphere { radius }, "sphere", numbers)
        }
        (cylinder, _) => {
            let found = if cylinder.is_some() { "two" } else { "none" };
            let message = format!("{OF} takes one shape of the tank, found {found}");
            let help =
                "write cylinder = { radius_m = …, height_m = … } or sphere = { radius_m = … }";
            reading.error(path, message, "one shape", help);
            return None;
        }
    };
    check_figures(reading, &under(path, key), OF, &numbers).then_some(shape)
}

/// A damping ratio is one of a swing that something restores.
fn check_damping(reading: &mut Reading<'_>, path: &[Step<'_>], file: &SloshFile) {
    let place = under(path, "damping_ratio");
    if file.damping_ratio >= 1.0 {
        let found = figures(file.damping_ratio);
        let message = format!("`damping_ratio` of {OF} must be less than 1, found {found}");
        reading.error(&place, message, "this number", "2 % is a damping ratio of 0.02");
    }
    let restored = file.acceleration_m_s2 != 0.0 || file.stiffness_nm_rad != 0.0;
    if file.damping_ratio > 0.0 && !restored {
        let message = format!("`damping_ratio` of {OF} is that of a swing which nothing restores");
        let help = "say the acceleration for which it holds, the thrust over the mass, as \
                    `acceleration_m_s2`; or `stiffness_nm_rad`; or leave it zero";
        reading.error(&place, message, "of what", help);
    }
}

/// The propellant must fit, and should swing.
fn check_fill(reading: &mut Reading<'_>, path: &[Step<'_>], slosh: &Slosh, propellant: f64) {
    let most = slosh.shape.capacity() * slosh.density;
    if propellant > most {
        let (_, above) = path.split_last().unwrap_or((&Step::Index(0), path));
        let message = format!(
            "`propellant_kg` of the tank is {} kg, and its inside holds {} kg of {} kg/m³",
            figures(propellant),
            figures(most),
            figures(slosh.density)
        );
        let help = "a larger tank, or less propellant; lengths are in metres";
        reading.error(&under(above, "propellant_kg"), message, "does not fit", help);
    } else if !slosh.swings(propellant) {
        let message = format!(
            "the propellant does not swing: it fills {} % of the tank, {} m deep",
            figures(100.0 * propellant / most),
            figures(slosh.depth(propellant))
        );
        let help = "less than a tenth of the radius deep, or up to the top, it is a mass at rest";
        reading.warning(path, message, "no slosh", help);
    }
}
