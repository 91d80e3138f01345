//! `[initial]`: where everything is at the start.

use crate::reading::Reading;
use crate::toml::MissionFile;
use crate::toml::pose::{
    AttitudeFile, attitude, by_joint, place_of_position, posture, radians, vector,
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use wrasse_document::{Step, at};
use wrasse_dynamics::{JointKind, State};
use wrasse_spatial::{Pose, SpatialVelocity};
use wrasse_vehicle::JOINTS;

/// Where everything is at the start.
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
    if let Some(q) = i.posture.as_ref().and_then(|p| posture(r, at!["initial", "posture"], p)) {
        (state.q, known) = (q, [true; JOINTS]);
    }
    let (turning, sliding) = (JointKind::Revolute, JointKind::Prismatic);
    let path = |key| [Step::Key("initial"), Step::Key(key)];
    let (q, v) = (&mut state.q, &mut state.v);
    let mut put = |j, x| (q[j], known[j]) = (x, true);
    by_joint(r, &path("joints_deg"), &i.joints_deg, turning, &mut put);
    by_joint(r, &path("joints_m"), &i.joints_m, sliding, &mut put);
    by_joint(r, &path("joint_rates_deg_s"), &i.joint_rates_deg_s, turning, |j, x| v[j] = x);
    by_joint(r, &path("joint_rates_m_s"), &i.joint_rates_m_s, sliding, |j, x| v[j] = x);
    let quat_NB = attitude(r, &path("attitude"), i.attitude);
    state.X_NB = Pose::from_quat(quat_NB, vector(i.position_m));
    state.V_NB_B = SpatialVelocity::new(radians(i.angular_velocity_deg_s), vector(i.velocity_m_s));
    // A joint whose posture is not known is not said to be anywhere.
    for j in r.vehicle.robot.joints().filter(|&j| known[j]) {
        check_start(r, j, state.q[j]);
    }
    state
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
    let place = place_of_position(r, at!["initial"], ["joints_deg", "joints_m", "posture"], name);
    let help = "give it a position within the travel in initial.joints_deg or initial.joints_m";
    r.error(&place, message, help);
}
