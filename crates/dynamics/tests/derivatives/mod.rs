//! The derivatives of inverse and forward dynamics against Pinocchio 4.1.

use crate::urdf_robot::{self, JOINTS};
use crate::{case, golden, json};
use serde_json::Value;
use wrasse_dynamics::{
    BaseColumns, JointColumns, PerBody, forward_dynamics_derivatives, inverse_dynamics_derivatives,
    kinematics,
};
use wrasse_spatial::{SpatialForce, SpatialVelocity};
use wrasse_testing::larger;

/// Asked of every matrix, relative to its largest element: the numbers carry 17 digits, and a
/// matrix of condition 1e4 is inverted. Measured 1e-13 at most (accelerations by velocities).
const RELATIVE: f64 = 1e-11;

/// A whole matrix by its elements, against the rows of the file.
#[track_caller]
fn agree(what: &str, element: impl Fn(usize, usize) -> f64, expected: &Value) {
    let rows = expected.as_array().unwrap();
    let (mut largest, mut worst) = (0.0_f64, 0.0_f64);
    for (i, row) in rows.iter().enumerate() {
        let row = row.as_array().unwrap();
        assert_eq!(row.len(), rows.len(), "{what} is square");
        for (j, x) in row.iter().enumerate() {
            let (found, x) = (element(i, j), x.as_f64().unwrap());
            assert!(found.is_finite(), "{what}: {found} in row {i}, column {j}");
            largest = larger(largest, x.abs());
            worst = larger(worst, (found - x).abs());
        }
    }
    println!("{what}: {:.1e} of the largest element", worst / largest);
    assert!(worst <= RELATIVE * largest, "{what}: off by {worst:e} of {largest:e}");
}

/// A derivative of something with six components for the base.
struct Whole<B> {
    base: BaseColumns<B, f64, JOINTS>,
    joints: JointColumns<B, f64, JOINTS>,
    six: fn(B) -> [f64; 6],
}

impl<B: Copy> Whole<B> {
    /// The base's columns are zero: they are those by its pose.
    fn by_position(joints: JointColumns<B, f64, JOINTS>, zero: B, six: fn(B) -> [f64; 6]) -> Self {
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

fn check_vehicle(name: &str) {
    let file = json(&format!("derivatives_{name}.json"));
    let vehicle = urdf_robot::read(&golden(file["vehicle"].as_str().unwrap()));
    let names = file["joint_names"].as_array().unwrap();
    let number_of = |n: &Value| vehicle.joint_names.iter().position(|m| *m == *n).unwrap();
    let order: Vec<usize> = names.iter().map(number_of).collect();
    let place = |i: usize| if i < 6 { i } else { 6 + order[i - 6] };
    let case = case(&vehicle, &file["input"]);
    let k = kinematics(&vehicle.robot, &case.state);
    let nothing = PerBody::filled(SpatialForce::zero());

    let (d, expect) =
        (inverse_dynamics_derivatives(&k, &case.nudot, &nothing), &file["inverse_dynamics"]);
    let six = SpatialForce::to_array;
    let by_q = Whole::by_position(d.by_position, SpatialForce::zero(), six);
    let by_nu = Whole { base: d.by_base_velocity, joints: d.by_rate, six };
    agree("τ by q", |i, j| by_q.element(place(i), place(j)), &expect["by_position"]);
    agree("τ by ν", |i, j| by_nu.element(place(i), place(j)), &expect["by_velocity"]);
    let M = |i, j| d.by_acceleration.element(place(i), place(j));
    agree("τ by ν̇", M, &expect["by_acceleration"]);

    let (d, expect) =
        (forward_dynamics_derivatives(&k, &case.force, &nothing), &file["forward_dynamics"]);
    let six = SpatialVelocity::to_array;
    let by_q = Whole::by_position(d.by_position, SpatialVelocity::zero(), six);
    let by_nu = Whole { base: d.by_base_velocity, joints: d.by_rate, six };
    agree("ν̇ by q", |i, j| by_q.element(place(i), place(j)), &expect["by_position"]);
    agree("ν̇ by ν", |i, j| by_nu.element(place(i), place(j)), &expect["by_velocity"]);
    agree("ν̇ by τ", |i, j| d.by_force.element(place(i), place(j)), &expect["by_force"]);
}

#[test]
fn derivatives_of_one_arm_agree_with_pinocchio() {
    check_vehicle("one_arm");
}

#[test]
fn derivatives_of_two_arms_with_prismatic_joints_agree_with_pinocchio() {
    check_vehicle("two_arms");
}
