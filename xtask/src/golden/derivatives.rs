//! Derivatives of inverse and forward dynamics: files `derivatives_…`.

use super::comparison::{Found, Tolerances};
use super::contract::TOLERANCES;
use super::file::{Case, Complaint};
use super::kind::Kind;
use super::product::vehicle;
use super::state::motion;
use serde_json::{Value, json};
use wrasse_dynamics::{
    BaseColumns, JointColumns, Outside, forward_dynamics_derivatives, inverse_dynamics_derivatives,
    kinematics,
};
use wrasse_spatial::{SpatialForce, SpatialVelocity};
use wrasse_vehicle::JOINTS;

/// By position, velocity, and acceleration or force.
pub(super) struct Derivatives;

impl Kind for Derivatives {
    fn takes(&self, kind: &str) -> bool {
        kind.starts_with("derivatives_")
    }

    fn tolerances(&self) -> &'static Tolerances {
        &TOLERANCES
    }

    fn found(&self, case: &Case) -> Result<Found, Complaint> {
        let vehicle = vehicle(case, case.text("vehicle")?)?;
        let names: Vec<String> = case.read("joint_names")?;
        let places: Option<Vec<usize>> = names.iter().map(|name| vehicle.joint(name)).collect();
        let places =
            places.filter(|all| all.len() == vehicle.joint_names.len()).ok_or_else(|| {
                let names = vehicle.joint_names.join(", ");
                case.complaint("joint_names", format!("the joints are {names}"))
            })?;
        let order: Vec<usize> = (0..6).chain(places.iter().map(|j| 6 + j)).collect();
        let motion = motion(case, "input", &vehicle)?;
        let k = kinematics(&vehicle.robot, &motion.state);

        let d = inverse_dynamics_derivatives(&k, &motion.nudot, Outside::nothing());
        let six = SpatialForce::to_array;
        let by_q = Whole::by_position(&d.by_position, SpatialForce::zero(), six);
        let by_nu = Whole { base: d.by_base_velocity, joints: &d.by_rate, six };
        let inverse = json!({
            "by_position": matrix(&order, |i, j| by_q.element(i, j)),
            "by_velocity": matrix(&order, |i, j| by_nu.element(i, j)),
            "by_acceleration": matrix(&order, |i, j| d.by_acceleration.element(i, j)),
        });

        let d = forward_dynamics_derivatives(&k, &motion.force, Outside::nothing());
        let six = SpatialVelocity::to_array;
        let by_q = Whole::by_position(&d.by_position, SpatialVelocity::zero(), six);
        let by_nu = Whole { base: d.by_base_velocity, joints: &d.by_rate, six };
        let forward = json!({
            "by_position": matrix(&order, |i, j| by_q.element(i, j)),
            "by_velocity": matrix(&order, |i, j| by_nu.element(i, j)),
            "by_force": matrix(&order, |i, j| d.by_force.element(i, j)),
        });
        let value = json!({ "joint_names": names, "inverse_dynamics": inverse, "forward_dynamics": forward });
        Ok(Found { value, left_out: vec![] })
    }
}

/// Rows of a matrix, joints in this order.
fn matrix(order: &[usize], element: impl Fn(usize, usize) -> f64) -> Value {
    order.iter().map(|&i| order.iter().map(|&j| element(i, j)).collect::<Value>()).collect()
}

/// A derivative of something that has six components for the base.
struct Whole<'a, B> {
    base: BaseColumns<B, f64, JOINTS>,
    joints: &'a JointColumns<B, f64, JOINTS>,
    six: fn(B) -> [f64; 6],
}

impl<'a, B: Copy> Whole<'a, B> {
    /// The base's columns are zero: they are those by its pose.
    fn by_position(
        joints: &'a JointColumns<B, f64, JOINTS>,
        zero: B,
        six: fn(B) -> [f64; 6],
    ) -> Self {
        Self { base: BaseColumns { base: [zero; 6], joints: [[0.0; 6]; JOINTS] }, joints, six }
    }
    fn element(&self, i: usize, j: usize) -> f64 {
        match (i.checked_sub(6), j.checked_sub(6)) {
            (None, None) => (self.six)(self.base.base[j])[i],
            (None, Some(j)) => (self.six)(self.joints.base[j])[i],
            (Some(i), None) => self.base.joints[i][j],
            (Some(i), Some(j)) => self.joints.joints[i][j],
        }
    }
}
