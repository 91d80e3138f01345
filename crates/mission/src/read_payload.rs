//! Payloads out of a mission file.

use crate::format::{FreeFile, MissionFile, PayloadFile};
use crate::mission::{PayloadCase, PayloadStart};
use crate::read_mission::Reading;
use crate::read_setup::{attitude, radians, tool, vector};
use wrasse_document::{Step, at};
use wrasse_dynamics::{Payload, State, kinematics};
use wrasse_spatial::{Pose, SpatialVelocity, Sym3};
use wrasse_vehicle::JOINTS;

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

fn matter(r: &mut Reading<'_>, name: &str, p: &PayloadFile) -> Payload<f64> {
    let path = |key| [Step::Key("payload"), Step::Key(name), Step::Key(key)];
    let mass = r.positive(&path("mass_kg"), p.mass_kg);
    let [xy, xz, yz] = p.products_kgm2;
    let I = match (p.uniform_box_m, p.inertia_kgm2) {
        (Some(edges), None) => {
            let [a, b, c] = edges.map(|x| x * x * mass / 12.0);
            Sym3 { xx: b + c, yy: a + c, zz: a + b, xy: 0.0, xz: 0.0, yz: 0.0 }
        }
        (None, Some([xx, yy, zz])) => Sym3 { xx, yy, zz, xy, xz, yz },
        _ => {
            let message = format!("payload {name} needs exactly one way to its inertia");
            r.error(at!["payload", name], message, "give uniform_box_m, or inertia_kgm2");
            Sym3::diagonal(1.0, 1.0, 1.0)
        }
    };
    let mut moments = principal_moments(I);
    moments.sort_by(f64::total_cmp);
    let [a, b, c] = moments;
    if a <= 0.0 || a + b < c * (1.0 - 1e-9) {
        let message = format!(
            "an inertia with principal moments {a:.6}, {b:.6}, {c:.6} kg·m² is not physical: each \
             must be above zero, and no larger than the sum of the others"
        );
        r.error(&path("inertia_kgm2"), message, "");
    }
    Payload::from_central(mass, vector(p.centre_of_mass_m), I)
}

fn principal_moments(I: Sym3<f64>) -> [f64; 3] {
    let rows = I.to_mat3().rows.map(wrasse_spatial::Vec3::to_array);
    let matrix = nalgebra::Matrix3::from_fn(|i, k| rows[i][k]);
    let found = matrix.symmetric_eigenvalues();
    [found[0], found[1], found[2]]
}

fn beginning(
    r: &mut Reading<'_>,
    name: &str,
    p: &PayloadFile,
    start: &State<f64, JOINTS>,
) -> PayloadStart {
    match (&p.held_by, &p.free) {
        (Some(holder), None) => {
            PayloadStart::Held(tool(r, at!["payload", name, "held_by"], Some(holder)))
        }
        (None, Some(free)) => free_start(r, name, free, start),
        _ => {
            let message = format!("payload {name} is either held or free at the start");
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
    let quat = attitude(r, at!["payload", name, "free", "attitude"], free.attitude);
    let seen = Pose::from_quat(quat, vector(free.position_m));
    let X_NT = match &free.seen_from {
        None => seen,
        Some(frame) => {
            let frame = tool(r, at!["payload", name, "free", "seen_from"], Some(frame));
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
