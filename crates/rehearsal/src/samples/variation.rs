//! What tells the samples of a case from each other.

use crate::case::{AttitudeActuation, Case};
use crate::samples::dispersion::{Dispersion, Target};
use wrasse_dynamics::{BodyId, MassProperties};
use wrasse_spatial::Sym3;
use wrasse_vehicle::VehicleRobot;

impl Case {
    /// Whether the samples of a case differ from each other: by what they draw, by noise of the sensors
    /// that are used, or by noise of the thrusters. A draw of a sensor that the case does without, of a
    /// percentage of nothing, or too small to make another number, changes nothing.
    pub fn varies(&self) -> bool {
        self.dispersions.iter().any(|d| changes(d) && acts(d.target, self)) || has_noise(self)
    }
}

/// Whether the farthest draw is another number than what the files say.
fn changes(dispersion: &Dispersion) -> bool {
    let (low, high) = dispersion.distribution.reach();
    let nominal = dispersion.nominal;
    nominal + low != nominal || nominal + high != nominal
}

/// Whether a draw of this changes anything in a case.
fn acts(target: Target, case: &Case) -> bool {
    let attitude = || case.sensors.and_then(|sensors| sensors.attitude);
    let robot = &case.vehicle.robot;
    match target {
        Target::GyroBias(_) => attitude().is_some(),
        Target::GyroNoise => attitude()
            .is_some_and(|(gyro, _)| gyro.angle_random_walk > 0.0 || gyro.bias_random_walk > 0.0),
        Target::TrackerNoise => attitude()
            .is_some_and(|(_, tracker)| tracker.noise_across > 0.0 || tracker.noise_about > 0.0),
        Target::EncoderStep => case.sensors.is_some_and(|sensors| sensors.encoder_step > 0.0),
        Target::BodyInertia(body) => has_inertia(&matter_of(robot, body)),
        Target::PayloadInertia(i) => has_inertia(&case.payloads[i].matter),
        _ => true,
    }
}

fn matter_of(robot: &VehicleRobot, body: BodyId) -> MassProperties<f64> {
    MassProperties { M_F_F: *robot.inertia(body), I_parts_F: *robot.inertia_of_parts(body) }
}

/// Whether there is inertia about the centre of mass: a point mass has none.
fn has_inertia(matter: &MassProperties<f64>) -> bool {
    matter.M_F_F.central() != Sym3::zero()
}

/// Whether sensors or thrusters are noisy: no two samples have the same noise.
fn has_noise(case: &Case) -> bool {
    let attitude = case.sensors.and_then(|sensors| sensors.attitude);
    let sensed =
        attitude.is_some() && (acts(Target::GyroNoise, case) || acts(Target::TrackerNoise, case));
    let thrusters = &case.equipment.actuators.thrusters;
    let fires = case.actuation == AttitudeActuation::Fitted;
    sensed || fires && thrusters.iter().any(|thruster| thruster.impulse_noise > 0.0)
}
