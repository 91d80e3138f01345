//! The books of a flight in the form that is reported.

use crate::outcome::Ledger;
use wrasse_spatial::Vec3;
use wrasse_world::BaseAttitude;

/// The books in the form that is reported.
pub(crate) fn ledger(books: &wrasse_world::Ledger, base: BaseAttitude) -> Ledger {
    // Momentum is exact where it is the state; where the attitude is held its torque is a quadrature
    // of the same order as the integration, and so is all work.
    let bounds = match base {
        BaseAttitude::Held => [1e-6, 1e-11, 1e-6],
        BaseAttitude::Controlled | BaseAttitude::Free => [1e-11, 1e-11, 1e-6],
    };
    let holds = |i: usize| books.worst[i] <= bounds[i] * books.scale[i] + f64::MIN_POSITIVE;
    let [work_of_joints, work_of_actuator, work_from_outside] = books.work.to_array();
    Ledger {
        angular_start: books.start.angular.to_array(),
        angular_end: books.now.angular.to_array(),
        angular_from_actuator: books.angular_from_actuator.to_array(),
        angular_from_outside: books.angular_from_outside.to_array(),
        angular_in_wheels: [books.start.in_wheels, books.now.in_wheels].map(Vec3::to_array),
        angular_in_cmgs: [books.start.in_cmgs, books.now.in_cmgs].map(Vec3::to_array),
        angular_from_thrusters: books.angular_from_thrusters.to_array(),
        angular_with_propellant: books.propellant.angular.to_array(),
        linear_from_thrusters: books.linear_from_thrusters.to_array(),
        linear_with_propellant: books.propellant.linear.to_array(),
        propellant: books.propellant.mass,
        energy_with_propellant: books.propellant.energy,
        angular_rest: books.worst[0],
        angular_scale: books.scale[0],
        linear_start: books.start.linear.to_array(),
        linear_end: books.now.linear.to_array(),
        linear_from_outside: books.linear_from_outside.to_array(),
        linear_rest: books.worst[1],
        linear_scale: books.scale[1],
        energy_start: books.start.energy,
        energy_end: books.now.energy,
        work_of_joints,
        work_of_actuator,
        work_from_outside,
        energy_at_grasps: books.energy_at_grasps,
        energy_rest: books.worst[2],
        energy_scale: books.scale[2],
        closes: (0..3).all(holds),
        bounds,
    }
}
