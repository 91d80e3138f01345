//! The tables `[[body]]`: mass properties about a named point in named axes, and outlines.

use super::uniform::{UniformFile, uniform_matter};
use crate::assembly::{Acceptance, Link, Matter, Rounding};
use crate::rotation::from_rpy_deg;
use crate::table::{OrientationFile, ProvenanceFile, QuaternionFile, Reading, under};
use crate::vehicle::ShapeKind;
use schemars::JsonSchema;
use serde::Deserialize;
use wrasse_document::Step;
use wrasse_spatial::{Pose, Sym3, Vec3};

/// A rigid body. Without `mass_kg` it is a mere frame.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct BodyFile {
    /// What it is called.
    #[schemars(length(min = 1))]
    pub(crate) name: String,
    /// Mass (kg).
    pub(crate) mass_kg: Option<f64>,
    /// Centre of mass, in the body's frame (m).
    pub(crate) centre_of_mass_m: Option<[f64; 3]>,
    /// Rotational inertia about a named point in named axes (kg·m²).
    pub(crate) inertia_kgm2: Option<InertiaFile>,
    /// A shape of even density, in place of centre of mass and inertia.
    pub(crate) uniform: Option<UniformFile>,
    /// Why mass properties that no rigid body can have are to be used all the same.
    #[schemars(length(min = 1))]
    pub(crate) accept_nonphysical: Option<String>,
    /// What to draw; that of `uniform` if not given. It has no effect on the motion; tool and loads
    /// must stay outside of the base's.
    #[serde(default)]
    pub(crate) shape: Vec<ShapeFile>,
    /// Where these numbers come from.
    #[serde(flatten)]
    pub(crate) provenance: ProvenanceFile,
}

/// Elements of an inertia tensor (kg·m²): off its diagonal they are −∫xy dm and so on.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct InertiaFile {
    /// The point about which it is taken.
    pub(crate) about: AboutFile,
    /// The axes in which its elements are.
    pub(crate) axes: AxesFile,
    /// ∫(y² + z²) dm (kg·m²).
    pub(crate) xx: f64,
    /// ∫(x² + z²) dm (kg·m²).
    pub(crate) yy: f64,
    /// ∫(x² + y²) dm (kg·m²).
    pub(crate) zz: f64,
    /// −∫xy dm (kg·m²), zero if not given.
    #[serde(default)]
    pub(crate) xy: f64,
    /// −∫xz dm (kg·m²), zero if not given.
    #[serde(default)]
    pub(crate) xz: f64,
    /// −∫yz dm (kg·m²), zero if not given.
    #[serde(default)]
    pub(crate) yz: f64,
}

/// The point about which an inertia is taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum AboutFile {
    /// The centre of mass.
    CentreOfMass,
    /// The origin of the body's frame.
    Origin,
}

/// The axes in which an inertia is given.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub(crate) enum AxesFile {
    /// Those of the body's frame.
    Body,
    /// Those turned from the body's frame by roll, pitch and yaw (deg).
    RpyDeg([f64; 3]),
    /// Those turned from the body's frame by this quaternion (–).
    Quaternion(QuaternionFile),
}

/// An outline for drawings: one of box, cylinder, sphere.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ShapeFile {
    /// Edge lengths along x, y, z (m).
    pub(crate) box_m: Option<[f64; 3]>,
    /// A cylinder along its z axis.
    pub(crate) cylinder: Option<CylinderFile>,
    /// Radius of a sphere (m).
    pub(crate) sphere_radius_m: Option<f64>,
    /// Its middle, in the body's frame (m); the centre of mass if not given.
    pub(crate) position_m: Option<[f64; 3]>,
    /// How it is turned from the body's frame.
    pub(crate) orientation: Option<OrientationFile>,
}

/// A cylinder along its z axis.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct CylinderFile {
    /// Radius (m).
    pub(crate) radius_m: f64,
    /// Length (m).
    pub(crate) length_m: f64,
}

/// A body's link.
pub(crate) fn link(reading: &mut Reading<'_>, path: &[Step<'_>], body: &BodyFile) -> Link {
    let matter = match &body.uniform {
        Some(uniform) => Some(uniform_matter(reading, path, body, uniform)),
        None => matter_by_numbers(reading, path, body),
    };
    Link { name: body.name.clone(), at: reading.below(path, "name"), matter }
}

/// Mass properties by their numbers; none of a mere frame.
fn matter_by_numbers(
    reading: &mut Reading<'_>,
    path: &[Step<'_>],
    body: &BodyFile,
) -> Option<Matter> {
    match (body.mass_kg, body.centre_of_mass_m, &body.inertia_kgm2) {
        (Some(mass), Some(p_cm), Some(inertia)) => {
            let p_cm = Vec3::from_array(p_cm);
            let inertia = central(reading, path, mass, p_cm, inertia);
            Some(matter(reading, path, body, mass, p_cm, inertia))
        }
        (None, None, None) if body.accept_nonphysical.is_none() => None,
        _ => {
            complain_of_parts(reading, path, body);
            // Stands in for what is missing, so that the rest of the file is checked as well.
            let mass = body.mass_kg.unwrap_or(1.0);
            let p_cm = body.centre_of_mass_m.map_or(Vec3::zero(), Vec3::from_array);
            let about_p_cm = body.inertia_kgm2.as_ref();
            let inertia = match about_p_cm.filter(|i| i.about == AboutFile::CentreOfMass) {
                Some(inertia) => central(reading, path, mass, p_cm, inertia),
                None => Sym3::diagonal(1.0, 1.0, 1.0).scaled(0.1 * mass.abs().max(1.0)),
            };
            Some(matter(reading, path, body, mass, p_cm, inertia))
        }
    }
}

fn matter(
    reading: &Reading<'_>,
    path: &[Step<'_>],
    body: &BodyFile,
    mass: f64,
    p_cm: Vec3<f64>,
    inertia: Sym3<f64>,
) -> Matter {
    Matter {
        mass,
        mass_at: reading.below(path, "mass_kg"),
        p_cm,
        inertia,
        inertia_at: reading.below(path, "inertia_kgm2"),
        rounding: rounding(reading, &under(path, "inertia_kgm2")),
        accept_nonphysical: acceptance(body),
    }
}

/// The reason of a body for mass properties that cannot be.
pub(super) fn acceptance(body: &BodyFile) -> Option<Acceptance> {
    body.accept_nonphysical.clone().map(|reason| Acceptance { reason, of_this: true })
}

/// How far the tensor at a path may be from what was meant, by the digits of its elements.
fn rounding(reading: &Reading<'_>, path: &[Step<'_>]) -> Rounding {
    let text = &reading.document.source().text;
    let written = |key: &str| {
        // A key that is left out stands nowhere of its own.
        reading.document.exact_span(&under(path, key)).and_then(|at| text.get(at)).unwrap_or("0")
    };
    Rounding::of_written(["xx", "xy", "xz", "yy", "yz", "zz"].map(written))
}

/// Mass, centre of mass and inertia come together or not at all.
fn complain_of_parts(reading: &mut Reading<'_>, path: &[Step<'_>], body: &BodyFile) {
    let parts = [
        ("mass_kg", body.mass_kg.is_some()),
        ("centre_of_mass_m", body.centre_of_mass_m.is_some()),
        ("inertia_kgm2", body.inertia_kgm2.is_some()),
    ];
    let named = |there: bool| {
        let keys = parts.iter().filter(|(_, is)| *is == there).map(|(key, _)| format!("`{key}`"));
        keys.collect::<Vec<_>>().join(" and ")
    };
    let has = if parts.iter().any(|(_, is)| *is) { named(true) } else { "no mass".into() };
    let message = format!("body '{}' has {has}, but not {}", body.name, named(false));
    let help =
        "a body has all three, or a mass and `uniform`; a mere frame has none, and accepts nothing";
    reading.error(path, message, "mass properties are not complete", help);
}

/// Inertia about the centre of mass in the body's axes, from that about the named point in the
/// named axes (kg·m²).
fn central(
    reading: &mut Reading<'_>,
    path: &[Step<'_>],
    mass: f64,
    p_cm: Vec3<f64>,
    file: &InertiaFile,
) -> Sym3<f64> {
    let given =
        Sym3 { xx: file.xx, yy: file.yy, zz: file.zz, xy: file.xy, xz: file.xz, yz: file.yz };
    let in_body_axes = match &file.axes {
        AxesFile::Body => given,
        AxesFile::RpyDeg(angles) => from_rpy_deg(*angles).congruence(given),
        AxesFile::Quaternion(parts) => {
            let path = under(&under(path, "inertia_kgm2"), "axes");
            reading.quaternion(&path, *parts).congruence(given)
        }
    };
    match file.about {
        AboutFile::CentreOfMass => in_body_axes,
        AboutFile::Origin => in_body_axes - Sym3::of_point(mass, p_cm),
    }
}

/// An outline and its place in the body's frame, if it is one.
pub(crate) fn outline(
    reading: &mut Reading<'_>,
    path: &[Step<'_>],
    body: &BodyFile,
    shape: &ShapeFile,
) -> Option<(Pose<f64>, ShapeKind)> {
    let of = format!("a shape of '{}'", body.name);
    let kind = one_kind(reading, path, &of, (shape.box_m, shape.cylinder, shape.sphere_radius_m))?;
    let of_uniform = || body.uniform.as_ref()?.position_m;
    let middle = shape.position_m.or(body.centre_of_mass_m).or_else(of_uniform).unwrap_or_default();
    let X_LS: Pose<f64> = reading.pose(path, middle, shape.orientation.as_ref());
    Some((X_LS, kind))
}

/// The one outline that a table gives; complains if it is none or several, or has no size.
pub(crate) fn one_kind(
    reading: &mut Reading<'_>,
    path: &[Step<'_>],
    of: &str,
    (edges, cylinder, radius): (Option<[f64; 3]>, Option<CylinderFile>, Option<f64>),
) -> Option<ShapeKind> {
    let kinds: Vec<_> = [
        edges.map(|edges| ShapeKind::Box(Vec3::from_array(edges))),
        cylinder.map(|c| ShapeKind::Cylinder { radius: c.radius_m, length: c.length_m }),
        radius.map(ShapeKind::Sphere),
    ]
    .into_iter()
    .flatten()
    .collect();
    let [kind] = kinds[..] else {
        let message = format!("{of} has {} outlines, must have one", kinds.len());
        let help = "give it `box_m`, `cylinder` or `sphere_radius_m`";
        reading.error(path, message, "this shape", help);
        return None;
    };
    if let Some(size) = kind.sizes().iter().find(|size| **size <= 0.0) {
        let message = format!("{of} has a size of {size} m");
        reading.error(path, message, "this shape", "sizes are positive");
        return None;
    }
    Some(kind)
}

#[cfg(test)]
mod tests {
    use super::*;
    use wrasse_document::{Document, at};

    /// Central inertia in body axes of a file's body.
    fn inertia_of(text: &str, mass: f64, p_cm: Vec3<f64>) -> Sym3<f64> {
        let document = Document::parse("body.toml", text).unwrap();
        let file: InertiaFile = document.read().unwrap();
        central(&mut Reading::new(&document), at![], mass, p_cm, &file)
    }

    #[test]
    fn a_rod_about_its_end_is_four_times_the_rod_about_its_middle() {
        let about_end = "about = 'origin'\naxes = 'body'\nxx = 0\nyy = 4\nzz = 4\n";
        let about_middle = "about = 'centre-of-mass'\naxes = 'body'\nxx = 0\nyy = 1\nzz = 1\n";
        // 3 kg, 2 m: m l²/12 = 1 kg·m² about the middle, m l²/3 = 4 kg·m² about the end.
        let (mass, p_cm) = (3.0, Vec3::from_array([1.0, 0.0, 0.0]));
        assert_eq!(inertia_of(about_end, mass, p_cm), inertia_of(about_middle, mass, p_cm));
    }

    #[test]
    fn axes_turned_a_quarter_about_z_exchange_x_and_y() {
        let turned = "about = 'centre-of-mass'\naxes = { rpy_deg = [0, 0, 90] }\n\
                      xx = 1\nyy = 2\nzz = 2.5\nxz = 0.25\n";
        let I = inertia_of(turned, 1.0, Vec3::zero());
        // The product between the turned x (body y) and z is that of body y and z.
        let expected = Sym3 { xx: 2.0, yy: 1.0, zz: 2.5, xy: 0.0, xz: 0.0, yz: 0.25 };
        assert_eq!(I, expected);
        let by_quaternion = turned.replace(
            "{ rpy_deg = [0, 0, 90] }",
            "{ quaternion = { w = 0.707106781, x = 0, y = 0, z = 0.707106781 } }",
        );
        let off = inertia_of(&by_quaternion, 1.0, Vec3::zero()) - expected;
        let off = wrasse_testing::largest(off.to_mat3().rows.map(Vec3::norm));
        assert!(off < 4e-15, "the turned tensor is of size 2.5; measured 9.2e-16: {off:e}");
    }
}
