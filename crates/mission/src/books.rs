//! The books of a flight in the form that is reported.

use crate::outcome::Ledger;
use wrasse_world::{BaseAttitude, Source};

/// The books in the form that is reported.
pub(crate) fn ledger(books: &wrasse_world::Ledger, base: BaseAttitude) -> Ledger {
    // Momentum is exact where it is the state; where the attitude is held its torque is a quadrature
    // of the same order as the integration, and so is all work.
    let bounds = match base {
        BaseAttitude::Held => [1e-6, 1e-11, 1e-6],
        BaseAttitude::Controlled | BaseAttitude::Free => [1e-11, 1e-11, 1e-6],
    };
    let holds = |i: usize| books.worst[i] <= bounds[i] * books.scale[i] + f64::MIN_POSITIVE;
    let given = |source: Source| books.sources[source];
    let turned = [Source::AttitudeActuator, Source::Wheels, Source::Cmgs, Source::Thrusters];
    let stored = |source: Source| {
        [books.start, books.now].map(|account| account.stored[source as usize].to_array())
    };
    let propellant = given(Source::Propellant);
    Ledger {
        angular_start: books.start.angular.to_array(),
        angular_end: books.now.angular.to_array(),
        angular_from_actuator: given(Source::AttitudeActuator).angular.to_array(),
        angular_from_outside: given(Source::Applied).angular.to_array(),
        angular_in_wheels: stored(Source::Wheels),
        angular_in_cmgs: stored(Source::Cmgs),
        angular_from_thrusters: given(Source::Thrusters).angular.to_array(),
        angular_with_propellant: (-propellant.angular).to_array(),
        linear_from_thrusters: given(Source::Thrusters).linear.to_array(),
        linear_with_propellant: (-propellant.linear).to_array(),
        propellant: books.propellant,
        energy_with_propellant: -propellant.work,
        angular_rest: books.worst[0],
        angular_scale: books.scale[0],
        linear_start: books.start.linear.to_array(),
        linear_end: books.now.linear.to_array(),
        linear_from_outside: given(Source::Applied).linear.to_array(),
        linear_rest: books.worst[1],
        linear_scale: books.scale[1],
        energy_start: books.start.energy,
        energy_end: books.now.energy,
        work_of_joints: given(Source::JointDrives).work,
        work_of_actuator: turned.iter().map(|source| given(*source).work).sum(),
        work_from_outside: given(Source::Applied).work,
        energy_at_grasps: given(Source::Grasps).work,
        energy_rest: books.worst[2],
        energy_scale: books.scale[2],
        closes: (0..3).all(holds),
        bounds,
    }
}
