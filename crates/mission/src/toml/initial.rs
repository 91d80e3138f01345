//! `[initial]`: where everything is at the start.

use crate::reading::Reading;
use crate::toml::MissionFile;
use crate::toml::pose::{attitude, by_joint, leader, place_of_position, posture, radians, vector};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use wrasse_document::{Step, at};
use wrasse_dynamics::{JointKind, State};
use wrasse_spatial::{Pose, SpatialVelocity};
use wrasse_vehicle::{AttitudeFile, JOINTS, follow, follow_rates};

/// Where everything is at the start. A joint whose position is not given is at zero, or at the end of its
/// travel that is nearest to it; one that follows another is where that one has it.
#[derive(Debug, Clone, Default, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct InitialFile {
    /// A posture that the vehicle file names.
    pub(crate) posture: Option<String>,
    /// Positions of turning joints by name; they replace the posture's.
    pub(crate) joints_deg: BTreeMap<String, f64>,
    /// Positions of sliding joints by name.
    pub(crate) joints_m: BTreeMap<String, f64>,
    /// Rates of turning joints by name.
    pub(crate) joint_rates_deg_s: BTreeMap<String, f64>,
    /// Rates of sliding joints by name.
    pub(crate) joint_rates_m_s: BTreeMap<String, f64>,
    /// Origin of the base, inertial axes.
    pub(crate) position_m: [f64; 3],
    /// Attitude of the base.
    pub(crate) attitude: Option<AttitudeFile>,
    /// Rate of the base, base axes.
    pub(crate) angular_velocity_deg_s: [f64; 3],
    /// Velocity of the base's origin, base axes.
    pub(crate) velocity_m_s: [f64; 3],
}

/// State at the start.
pub(crate) fn start(r: &mut Reading<'_>, file: &MissionFile) -> State<f64, JOINTS> {
    let i = &file.initial;
    let mut state = State::default();
    let mut known = [i.posture.is_none(); JOINTS];
    for (q, limits) in state.q.iter_mut().zip(&r.vehicle.limits) {
        *q = limits.nearest_to_zero();
    }
    let mut given = [i.posture.is_some(); JOINTS];
    if let Some(q) = i.posture.as_ref().and_then(|p| posture(r, at!["initial", "posture"], p)) {
        (state.q, known) = (q, [true; JOINTS]);
    }
    let (turning, sliding) = (JointKind::Revolute, JointKind::Prismatic);
    let path = |key| [Step::Key("initial"), Step::Key(key)];
    let (q, v) = (&mut state.q, &mut state.v);
    let mut put = |j, x| (q[j], known[j], given[j]) = (x, true, true);
    by_joint(r, &path("joints_deg"), &i.joints_deg, turning, &mut put);
    by_joint(r, &path("joints_m"), &i.joints_m, sliding, &mut put);
    by_joint(r, &path("joint_rates_deg_s"), &i.joint_rates_deg_s, turning, |j, x| v[j] = x);
    by_joint(r, &path("joint_rates_m_s"), &i.joint_rates_m_s, sliding, |j, x| v[j] = x);
    follow(&r.vehicle.followers, q);
    follow_rates(&r.vehicle.followers, v);
    remark_on_ends(r, &given);
    let R_NB = attitude(r, &path("attitude"), i.attitude);
    state.X_NB = Pose::new(R_NB, vector(i.position_m));
    state.V_NB_B = SpatialVelocity::new(radians(i.angular_velocity_deg_s), vector(i.velocity_m_s));
    // A joint whose posture is not known is not said to be anywhere.
    for j in r.vehicle.robot.joints().filter(|&j| known[j]) {
        check_start(r, j, state.q[j]);
    }
    state
}

/// Joints that are nowhere said to be elsewhere than at zero, and cannot be there.
fn remark_on_ends(r: &mut Reading<'_>, given: &[bool; JOINTS]) {
    let at_end = |j: &usize| !given[*j] && r.vehicle.limits[*j].nearest_to_zero() != 0.0;
    let own = r.vehicle.robot.joints().filter(|j| leader(r.vehicle, *j).is_none()).filter(at_end);
    let told: Vec<String> = own
        .map(|j| {
            let q = r.shown(j, r.vehicle.limits[j].nearest_to_zero());
            format!("{} at {q}", r.vehicle.joint_names[j])
        })
        .collect();
    if told.is_empty() {
        return;
    }
    let message = format!(
        "zero is outside the travel of joints whose start is not given: they start at its nearest \
         end, {}",
        told.join(", ")
    );
    let place: &[Step<'_>] =
        if r.is_there(at!["initial"]) { at!["initial"] } else { at!["vehicle"] };
    r.warning(place, message, "give their positions in initial.joints_deg or initial.joints_m");
}

/// A joint starts within its travel.
fn check_start(r: &mut Reading<'_>, j: usize, q: f64) {
    let Some((lower, upper)) = r.vehicle.limits[j].travel else { return };
    if (lower..=upper).contains(&q) {
        return;
    }
    let name = &r.vehicle.joint_names[j];
    let [q, lower, upper] = [q, lower, upper].map(|x| r.shown(j, x));
    let message = format!("joint {name} starts at {q}, outside its travel from {lower} to {upper}");
    let place = place_of_position(r, at!["initial"], ["joints_deg", "joints_m", "posture"], j);
    let help = "give it a position within the travel in initial.joints_deg or initial.joints_m";
    r.error(&place, message, help);
}
