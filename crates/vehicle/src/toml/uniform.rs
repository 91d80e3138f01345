//! `uniform` of a `[[body]]`: centre of mass and inertia of a body of even density, solid or with a wall
//! of even thickness.

use super::body::acceptance;
use super::body::{BodyFile, CylinderFile, one_kind};
use crate::assembly::{Matter, Rounding};
use crate::table::{OrientationFile, Reading, under};
use crate::vehicle::ShapeKind;
use schemars::JsonSchema;
use serde::Deserialize;
use wrasse_document::Step;
use wrasse_spatial::{Pose, Sym3};

/// A body of even density: one of box, cylinder, sphere, solid or hollow. Its outline is the body's
/// shape, unless the body has a `shape` of its own.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct UniformFile {
    /// Edge lengths along x, y, z (m), outside.
    pub(crate) box_m: Option<[f64; 3]>,
    /// A cylinder along its z axis, outside.
    pub(crate) cylinder: Option<CylinderFile>,
    /// Radius of a sphere (m), outside.
    pub(crate) sphere_radius_m: Option<f64>,
    /// Thickness of its wall (m), the same on every side; a box and a cylinder are closed. Solid if not
    /// given.
    pub(crate) wall_m: Option<f64>,
    /// Its middle, in the body's frame (m); the origin if not given.
    pub(crate) position_m: Option<[f64; 3]>,
    /// How it is turned from the body's frame; not at all if not given.
    pub(crate) orientation: Option<OrientationFile>,
}

/// Mass properties of a uniform body; complains of what contradicts.
pub(crate) fn uniform_matter(
    reading: &mut Reading<'_>,
    path: &[Step<'_>],
    body: &BodyFile,
    file: &UniformFile,
) -> Matter {
    complain_of_contradictions(reading, path, body);
    let at_uniform = under(path, "uniform");
    let mass = body.mass_kg.unwrap_or(1.0);
    let shape = outline_of_uniform(reading, path, body, file);
    // Stands in for a shape that cannot be, so that the rest of the file is checked as well.
    let (X_BU, kind) = shape.unwrap_or((Pose::identity(), ShapeKind::Sphere(1.0)));
    let wall = file.wall_m.filter(|wall| wall_fits(reading, &at_uniform, body, kind, *wall));
    let inertia = X_BU.rotation.congruence(inertia_per_mass(kind, wall).scaled(mass));
    Matter {
        mass,
        mass_at: reading.below(path, "mass_kg"),
        p_cm: X_BU.translation,
        inertia,
        inertia_at: reading.at(&at_uniform),
        rounding: Rounding::default(),
        accept_nonphysical: acceptance(body),
    }
}

/// The outline and its place in the body's frame, if it is one.
pub(crate) fn outline_of_uniform(
    reading: &mut Reading<'_>,
    path: &[Step<'_>],
    body: &BodyFile,
    file: &UniformFile,
) -> Option<(Pose<f64>, ShapeKind)> {
    let path = under(path, "uniform");
    let of = format!("`uniform` of '{}'", body.name);
    let kind = one_kind(reading, &path, &of, (file.box_m, file.cylinder, file.sphere_radius_m))?;
    let middle = file.position_m.unwrap_or_default();
    Some((reading.pose(&path, middle, file.orientation.as_ref()), kind))
}

/// What `uniform` says must not be said again, and the mass is due.
fn complain_of_contradictions(reading: &mut Reading<'_>, path: &[Step<'_>], body: &BodyFile) {
    for (key, there) in [
        ("centre_of_mass_m", body.centre_of_mass_m.is_some()),
        ("inertia_kgm2", body.inertia_kgm2.is_some()),
    ] {
        if there {
            let message = format!("body '{}' has `uniform` and `{key}`", body.name);
            let help = "the one follows from the other: leave one of them out";
            reading.wrong_key(&under(path, key), message, "said twice", help);
        }
    }
    if body.mass_kg.is_none() {
        let message = format!("body '{}' has `uniform`, but not `mass_kg`", body.name);
        let help = "a shape says where the mass is, not how much it is";
        reading.wrong_key(&under(path, "uniform"), message, "of what mass?", help);
    }
}

/// Complains of a wall that is not inside its outline.
fn wall_fits(
    reading: &mut Reading<'_>,
    path: &[Step<'_>],
    body: &BodyFile,
    kind: ShapeKind,
    wall: f64,
) -> bool {
    let thickest = match kind {
        ShapeKind::Box(edges) => edges.to_array().into_iter().fold(f64::INFINITY, f64::min) / 2.0,
        ShapeKind::Cylinder { radius, length } => radius.min(length / 2.0),
        ShapeKind::Sphere(radius) => radius,
    };
    let fits = wall > 0.0 && wall <= thickest;
    if !fits {
        let message = format!(
            "`wall_m` of '{}' must be more than 0 and at most half of its smallest size, {thickest} m, \
             found {wall}",
            body.name
        );
        let help = "a solid body has no `wall_m`";
        reading.error(&under(path, "wall_m"), message, "this wall", help);
    }
    fits
}

/// Inertia about the middle for a mass of 1 (m²), in the axes of the shape.
///
/// A hollow body is the outer one less the inner one. Powers of the outer sizes less those of the inner
/// ones are written as sums of positive terms, over the thickness that they have in common: a thin wall
/// loses no digits.
fn inertia_per_mass(kind: ShapeKind, wall: Option<f64>) -> Sym3<f64> {
    let [x, y, z] = match (kind, wall) {
        (ShapeKind::Box(edges), None) => edges.to_array().map(|edge| edge * edge / 12.0),
        (ShapeKind::Box(edges), Some(wall)) => hollow_box(edges.to_array(), wall),
        (ShapeKind::Cylinder { radius: r, length: l }, None) => {
            [r * r / 4.0, r * r / 4.0, l * l / 12.0]
        }
        (ShapeKind::Cylinder { radius, length }, Some(wall)) => {
            hollow_cylinder(radius, length, wall)
        }
        (ShapeKind::Sphere(radius), None) => [radius * radius / 5.0; 3],
        (ShapeKind::Sphere(radius), Some(wall)) => [hollow_sphere(radius, wall); 3],
    };
    Sym3::diagonal(y + z, x + z, x + y)
}

/// Mean squares of x, y, z (m²) over the wall of a closed box with these outer edges.
fn hollow_box(outer: [f64; 3], wall: f64) -> [f64; 3] {
    let inner = outer.map(|edge| edge - 2.0 * wall);
    // Over the edge i and the two others: a bc − a' b'c' = (a − a') bc + a' (b − b') c + a' b' (c − c').
    let of_edge = |i: usize, power: i32, rise: f64| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        let inside = inner[i].powi(power);
        rise * outer[j] * outer[k] + inside * outer[k] + inside * inner[j]
    };
    let volume = of_edge(0, 1, 1.0);
    [0, 1, 2].map(|i| {
        let (a, b) = (outer[i], inner[i]);
        of_edge(i, 3, a * a + a * b + b * b) / (12.0 * volume)
    })
}

/// Mean squares of x, y, z (m²) over the wall of a closed cylinder along z.
fn hollow_cylinder(R: f64, L: f64, wall: f64) -> [f64; 3] {
    let (r, l) = (R - wall, L - 2.0 * wall);
    let (rr, RR) = (r * r, R * R);
    let volume = (R + r) * L + 2.0 * rr;
    let across = ((R + r) * (RR + rr) * L + 2.0 * rr * rr) / (4.0 * volume);
    let along = ((R + r) * L * L * L + 2.0 * rr * (L * L + L * l + l * l)) / (12.0 * volume);
    [across, across, along]
}

/// Mean square of each of x, y, z (m²) over the wall of a hollow sphere.
fn hollow_sphere(R: f64, wall: f64) -> f64 {
    let r = R - wall;
    let fourth = R * R * R * R + R * R * R * r + R * R * r * r + R * r * r * r + r * r * r * r;
    fourth / (5.0 * (R * R + R * r + r * r))
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::f64::consts::PI;
    use wrasse_spatial::vec3;
    use wrasse_testing::{larger, largest};

    const BOX: ShapeKind = ShapeKind::Box(vec3(1.0, 2.0, 3.0));
    const CYLINDER: ShapeKind = ShapeKind::Cylinder { radius: 0.5, length: 3.0 };
    const SPHERE: ShapeKind = ShapeKind::Sphere(0.3);

    /// Largest difference of two diagonals, relative to the largest moment.
    fn off(found: Sym3<f64>, expected: [f64; 3]) -> f64 {
        let of = [found.xx, found.yy, found.zz];
        let most = largest(expected);
        largest((0..3).map(|i| (of[i] - expected[i]).abs() / most))
    }

    /// Moments of the sides of a closed surface, each a plate of area A in a plane at a distance from
    /// the middle: with mean squares of its two directions and of the distance, weighted by area.
    fn moments_of_plates(plates: &[(f64, [f64; 3])]) -> [f64; 3] {
        let area: f64 = plates.iter().map(|(a, _)| a).sum();
        let mean = |i: usize| plates.iter().map(|(a, squares)| a * squares[i]).sum::<f64>() / area;
        let [x, y, z] = [0, 1, 2].map(mean);
        [y + z, x + z, x + y]
    }

    #[test]
    fn solids_have_the_moments_of_the_tables() {
        assert!(off(inertia_per_mass(BOX, None), [13.0 / 12.0, 10.0 / 12.0, 5.0 / 12.0]) < 1e-15);
        let across = (3.0 * 0.25 + 9.0) / 12.0;
        assert!(off(inertia_per_mass(CYLINDER, None), [across, across, 0.125]) < 1e-15);
        assert!(off(inertia_per_mass(SPHERE, None), [0.4 * 0.09; 3]) < 1e-15);
    }

    /// A wall of a nanometre is a surface; its moments are integrals over surfaces. What is left is
    /// the thickness itself, over the radius: measured 3.3e-9, 9e-10 for box and cylinder.
    #[test]
    fn a_thin_wall_has_the_moments_of_a_surface() {
        let wall = Some(1e-9);
        let [a, b, c] = [1.0_f64, 2.0, 3.0];
        let side = |i: usize, edges: [f64; 3]| {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            let squares = [0, 1, 2].map(|n| edges[n] * edges[n] / if n == i { 4.0 } else { 12.0 });
            (2.0 * edges[j] * edges[k], squares)
        };
        let sides = [0, 1, 2].map(|i| side(i, [a, b, c]));
        let of_box = off(inertia_per_mass(BOX, wall), moments_of_plates(&sides));
        let (r, l) = (0.5_f64, 3.0_f64);
        let tube = (2.0 * PI * r * l, [r * r / 2.0, r * r / 2.0, l * l / 12.0]);
        let lids = (2.0 * PI * r * r, [r * r / 4.0, r * r / 4.0, l * l / 4.0]);
        let of_tube = off(inertia_per_mass(CYLINDER, wall), moments_of_plates(&[tube, lids]));
        let of_sphere = off(inertia_per_mass(SPHERE, wall), [2.0 / 3.0 * 0.09; 3]);
        let worst = larger(of_box, larger(of_tube, of_sphere));
        assert!(worst < 4e-9, "{of_box:e} {of_tube:e} {of_sphere:e}");
    }

    /// Outer less inner, each solid, at a thickness where the difference keeps its digits.
    #[test]
    fn a_hollow_body_is_the_outer_one_less_the_inner_one() {
        let volume = |kind| match kind {
            ShapeKind::Box(e) => e.x * e.y * e.z,
            ShapeKind::Cylinder { radius, length } => PI * radius * radius * length,
            ShapeKind::Sphere(radius) => 4.0 / 3.0 * PI * radius * radius * radius,
        };
        for (outer, inner, wall) in [
            (BOX, ShapeKind::Box(vec3(0.6, 1.6, 2.6)), 0.2),
            (CYLINDER, ShapeKind::Cylinder { radius: 0.3, length: 2.6 }, 0.2),
            (SPHERE, ShapeKind::Sphere(0.1), 0.2),
        ] {
            let [out, hole] = [outer, inner].map(|kind| {
                let I = inertia_per_mass(kind, None).scaled(volume(kind));
                [I.xx, I.yy, I.zz]
            });
            let rest = volume(outer) - volume(inner);
            let expected = [0, 1, 2].map(|i| (out[i] - hole[i]) / rest);
            let off = off(inertia_per_mass(outer, Some(wall)), expected);
            assert!(off < 1e-14, "{outer:?}: {off:e}");
        }
    }

    #[test]
    fn a_wall_of_half_the_smallest_size_leaves_nothing_hollow() {
        for (kind, half) in [(BOX, 0.5), (CYLINDER, 0.5), (SPHERE, 0.3)] {
            let solid = inertia_per_mass(kind, None);
            let off = off(inertia_per_mass(kind, Some(half)), [solid.xx, solid.yy, solid.zz]);
            assert!(off < 1e-15, "{kind:?}: {off:e}");
        }
    }
}
