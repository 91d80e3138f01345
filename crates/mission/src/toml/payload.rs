//! `[payload.NAME]`: rigid bodies that can be held.

use crate::reading::Reading;
use crate::toml::MissionFile;
use crate::toml::pose::{attitude, radians, tool, vector};
use schemars::JsonSchema;
use serde::Deserialize;
use wrasse_document::{Step, at};
use wrasse_dynamics::{MassProperties, State, kinematics};
use wrasse_rehearsal::{PayloadCase, PayloadStart};
use wrasse_spatial::{Pose, SpatialVelocity, Sym3};
use wrasse_vehicle::{AttitudeFile, JOINTS};

/// A rigid body that can be held. Its frame is the grip: the frame that coincides with the tool's
/// while it is held from the start.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct PayloadFile {
    /// Mass.
    pub(crate) mass_kg: f64,
    /// Centre of mass from the grip, payload axes.
    #[serde(default)]
    pub(crate) centre_of_mass_m: [f64; 3],
    /// Edges of a uniform box, from which the inertia follows.
    #[serde(default)]
    pub(crate) uniform_box_m: Option<[f64; 3]>,
    /// Inertia about the centre of mass: xx, yy, zz.
    #[serde(default)]
    pub(crate) inertia_kgm2: Option<[f64; 3]>,
    /// Products of inertia: xy, xz, yz (the off-diagonal elements of the matrix).
    #[serde(default)]
    pub(crate) products_kgm2: [f64; 3],
    /// Held by the tool of this name from the start.
    #[serde(default)]
    pub(crate) held_by: Option<String>,
    /// Floating freely at the start.
    #[serde(default)]
    pub(crate) free: Option<FreeFile>,
}

/// Where a free payload is at the start.
#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct FreeFile {
    /// Name of the frame that the pose is seen from; inertial space if there is none.
    pub(crate) seen_from: Option<String>,
    /// Origin of the grip.
    pub(crate) position_m: [f64; 3],
    /// Attitude of the grip.
    pub(crate) attitude: Option<AttitudeFile>,
    /// Velocity of the grip, inertial axes.
    pub(crate) velocity_m_s: [f64; 3],
    /// Angular velocity, inertial axes.
    pub(crate) angular_velocity_deg_s: [f64; 3],
}

/// All payloads, in alphabetical order.
pub(crate) fn payloads(
    r: &mut Reading<'_>,
    file: &MissionFile,
    start: &State<f64, JOINTS>,
) -> Vec<PayloadCase> {
    let each = file.payload.iter();
    each.map(|(name, payload)| PayloadCase {
        name: name.clone(),
        matter: matter(r, name, payload),
        start: beginning(r, name, payload, start),
        box_m: payload.uniform_box_m,
    })
    .collect()
}

fn matter(r: &mut Reading<'_>, name: &str, p: &PayloadFile) -> MassProperties<f64> {
    let path = |key| [Step::Key("payload"), Step::Key(name), Step::Key(key)];
    let mass = r.positive(&path("mass_kg"), p.mass_kg);
    let I = match (p.uniform_box_m, p.inertia_kgm2) {
        (Some(edges), None) => box_inertia(r, name, mass, edges, p.products_kgm2),
        (None, Some(moments)) => given_inertia(r, &path("inertia_kgm2"), moments, p.products_kgm2),
        (both, _) => {
            let found = if both.is_some() { "says its inertia twice" } else { "has no inertia" };
            let help = "give uniform_box_m, from which it follows, or inertia_kgm2";
            r.error(at!["payload", name], format!("payload {name} {found}"), help);
            Sym3::diagonal(1.0, 1.0, 1.0)
        }
    };
    MassProperties::from_central(mass, vector(p.centre_of_mass_m), I)
}

/// Inertia of a uniform box.
fn box_inertia(
    r: &mut Reading<'_>,
    name: &str,
    mass: f64,
    mut edges: [f64; 3],
    products: [f64; 3],
) -> Sym3<f64> {
    for (i, edge) in edges.iter_mut().enumerate() {
        *edge = r.positive(at!["payload", name, "uniform_box_m", i], *edge);
    }
    if products != [0.0; 3] {
        let message = format!("payload {name} is a uniform box: its products of inertia are zero");
        let help = "leave products_kgm2 out, or give inertia_kgm2 in place of uniform_box_m";
        r.error(at!["payload", name, "products_kgm2"], message, help);
    }
    let [a, b, c] = edges.map(|x| x * x * mass / 12.0);
    Sym3 { xx: b + c, yy: a + c, zz: a + b, xy: 0.0, xz: 0.0, yz: 0.0 }
}

/// Inertia as it is given; an error with the numbers if no body can have it.
fn given_inertia(
    r: &mut Reading<'_>,
    path: &[Step<'_>],
    [xx, yy, zz]: [f64; 3],
    [xy, xz, yz]: [f64; 3],
) -> Sym3<f64> {
    let I = Sym3 { xx, yy, zz, xy, xz, yz };
    let [a, b, c] = principal_moments(I);
    if a <= 0.0 || a + b < c * (1.0 - 1e-9) {
        let message = format!(
            "an inertia with principal moments {a:.6}, {b:.6}, {c:.6} kg·m² is not physical: each \
             must be above zero, and no larger than the sum of the others"
        );
        let help = "is it about the centre of mass, xx yy zz first, and in kg·m²?";
        r.error(path, message, help);
    }
    I
}

/// Principal moments, smallest first.
fn principal_moments(I: Sym3<f64>) -> [f64; 3] {
    let rows = I.to_mat3().rows.map(wrasse_spatial::Vec3::to_array);
    let matrix = nalgebra::Matrix3::from_fn(|i, k| rows[i][k]);
    let found = matrix.symmetric_eigenvalues();
    let mut moments = [found[0], found[1], found[2]];
    moments.sort_by(f64::total_cmp);
    moments
}

fn beginning(
    r: &mut Reading<'_>,
    name: &str,
    p: &PayloadFile,
    start: &State<f64, JOINTS>,
) -> PayloadStart {
    match (&p.held_by, &p.free) {
        (Some(holder), None) => {
            PayloadStart::Held(tool(r, at!["payload", name, "held_by"], holder))
        }
        (None, Some(free)) => free_start(r, name, free, start),
        (both, _) => {
            let found = if both.is_some() { "both" } else { "neither" };
            let message =
                format!("payload {name} is either held or free at the start, found {found}");
            let help = "write held_by = \"tool\", or a table free = { … }";
            r.error(at!["payload", name], message, help);
            PayloadStart::Free(Pose::identity(), SpatialVelocity::zero())
        }
    }
}

fn free_start(
    r: &mut Reading<'_>,
    name: &str,
    free: &FreeFile,
    start: &State<f64, JOINTS>,
) -> PayloadStart {
    let R = attitude(r, at!["payload", name, "free", "attitude"], free.attitude);
    let seen = Pose::new(R, vector(free.position_m));
    let X_NT = match &free.seen_from {
        None => seen,
        Some(frame) => {
            let frame = tool(r, at!["payload", name, "free", "seen_from"], frame);
            kinematics(&r.vehicle.robot, start).pose(&frame) * seen
        }
    };
    let R_NT = X_NT.rotation;
    let V_NT_T = SpatialVelocity::new(
        R_NT.transpose_mul(radians(free.angular_velocity_deg_s)),
        R_NT.transpose_mul(vector(free.velocity_m_s)),
    );
    PayloadStart::Free(X_NT, V_NT_T)
}
