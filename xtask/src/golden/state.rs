//! States, poses and bodies as golden files write them: `validation/golden/README.md`, "Input".

use super::file::{Case, Complaint};
use serde::Deserialize;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use wrasse_dynamics::{Generalized, GeneralizedForce, GeneralizedVelocity, State};
use wrasse_spatial::{Pose, Quat, SpatialForce, SpatialVelocity, Vec3};
use wrasse_vehicle::{JOINTS, Vehicle};

/// A state, and what acts in it.
pub(super) struct Motion {
    pub(super) state: State<f64, JOINTS>,
    pub(super) nudot: GeneralizedVelocity<f64, JOINTS>,
    pub(super) force: GeneralizedForce<f64, JOINTS>,
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct StateFile {
    base: PoseFile,
    base_velocity: TwistFile,
    base_acceleration: TwistFile,
    base_wrench: WrenchFile,
    joints: BTreeMap<String, JointFile>,
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct PoseFile {
    position: [f64; 3],
    attitude: Option<AttitudeFile>,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
struct AttitudeFile {
    w: f64,
    x: f64,
    y: f64,
    z: f64,
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct TwistFile {
    angular: [f64; 3],
    linear: [f64; 3],
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct WrenchFile {
    torque: [f64; 3],
    force: [f64; 3],
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct JointFile {
    position: f64,
    velocity: f64,
    acceleration: f64,
    torque: f64,
}

impl TwistFile {
    fn twist(&self) -> SpatialVelocity<f64> {
        SpatialVelocity::new(Vec3::from_array(self.angular), Vec3::from_array(self.linear))
    }
}

/// The state at a path of a case, joints by name.
pub(super) fn motion(case: &Case, path: &str, vehicle: &Vehicle) -> Result<Motion, Complaint> {
    let file: StateFile = case.read(path)?;
    let wrench = &file.base_wrench;
    let mut motion = Motion {
        state: State {
            X_NB: pose_of(case, &format!("{path}.base"), &file.base)?,
            V_NB_B: file.base_velocity.twist(),
            ..State::default()
        },
        nudot: Generalized { base: file.base_acceleration.twist(), ..Generalized::default() },
        force: Generalized::default(),
    };
    let (torque, force) = (Vec3::from_array(wrench.torque), Vec3::from_array(wrench.force));
    motion.force.base = SpatialForce::new(torque, force);
    for (name, joint) in &file.joints {
        let unknown = || {
            let names = vehicle.joint_names.join(", ");
            case.complaint(&format!("{path}.joints.{name}"), format!("the joints are {names}"))
        };
        let j = vehicle.joint(name).ok_or_else(unknown)?;
        (motion.state.q[j], motion.state.v[j]) = (joint.position, joint.velocity);
        (motion.nudot.joints[j], motion.force.joints[j]) = (joint.acceleration, joint.torque);
    }
    Ok(motion)
}

/// The pose at a path of a case: `position` and `attitude`.
pub(super) fn pose(case: &Case, path: &str) -> Result<Pose<f64>, Complaint> {
    pose_of(case, path, &case.read(path)?)
}

/// The twist at a path of a case: `angular` and `linear`.
pub(super) fn twist(case: &Case, path: &str) -> Result<SpatialVelocity<f64>, Complaint> {
    Ok(case.read::<TwistFile>(path)?.twist())
}

fn pose_of(case: &Case, path: &str, file: &PoseFile) -> Result<Pose<f64>, Complaint> {
    let mut quat = Quat::identity();
    if let Some(AttitudeFile { w, x, y, z }) = file.attitude {
        quat = Quat { w, x, y, z };
        let length = quat.norm();
        // Printed digits leave a length that is off by some 1e-16; 1e-6 is another attitude.
        if (length - 1.0).abs() > 1e-6 {
            let what = format!("an attitude is a unit quaternion, found one of length {length}");
            return Err(case.complaint(&format!("{path}.attitude"), what));
        }
    }
    Ok(Pose::from_quat(quat.normalized(), Vec3::from_array(file.position)))
}

/// A vector as a list.
pub(super) fn xyz(v: Vec3<f64>) -> Value {
    json!(v.to_array())
}

/// A twist, or an impulse, by its parts.
pub(super) fn parts(angular: Vec3<f64>, linear: Vec3<f64>) -> Value {
    json!({ "angular": xyz(angular), "linear": xyz(linear) })
}

/// A pose by its parts.
pub(super) fn pose_value(X: &Pose<f64>) -> Value {
    let q = Quat::from_matrix(&X.rotation);
    let attitude = json!({ "w": q.w, "x": q.x, "y": q.y, "z": q.z });
    json!({ "position": xyz(X.translation), "attitude": attitude })
}
