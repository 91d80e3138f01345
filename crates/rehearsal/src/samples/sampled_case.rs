//! A case as a sample of a sweep has it: what was drawn, put into the truth.

use crate::case::{Believed, Case, PayloadStart};
use crate::samples::dispersion::{Dispersion, Target, draws};
use std::sync::Arc;
use wrasse_dynamics::{BodyId, MassProperties};
use wrasse_hardware::Sensors;
use wrasse_spatial::{Pose, Quat, SpatialVelocity, Vec3};
use wrasse_vehicle::{Vehicle, VehicleRobot, follow, follow_rates};

/// A deviation in SI.
#[derive(Debug, Clone, Copy)]
struct Deviation {
    target: Target,
    size: f64,
    known: bool,
}

/// How what a body is made of deviates.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
struct MassChange {
    /// (kg)
    mass: f64,
    /// (m)
    centre: [f64; 3],
    /// A share of itself (–).
    inertia: f64,
}

impl Case {
    /// The case that a sample of a seed flies.
    #[must_use]
    pub fn sampled(&self, seed: u64, sample: u64) -> Self {
        let (own_seed, sizes) = draws(&self.dispersions, seed, sample);
        let in_si = |(d, size): (&Dispersion, f64)| Deviation {
            target: d.target,
            size: size * d.scale,
            known: d.known,
        };
        let all: Vec<Deviation> = self.dispersions.iter().zip(sizes).map(in_si).collect();
        let known: Vec<Deviation> = all.iter().filter(|d| d.known).copied().collect();
        let mut sampled = self.clone();
        sampled.seed = own_seed;
        sampled.move_start(&all);
        sampled.move_payloads(&all);
        sampled.sensors = self.sensors.map(|sensors| off(sensors, &all));
        if let (Some(to), Some(sensors)) = (&mut sampled.setup.navigation.attitude, self.sensors)
            && let Some((gyro, tracker)) = off(sensors, &known).attitude
        {
            (to.gyro, to.tracker) = (gyro, tracker);
        }
        let is_mass = |d: &Deviation| d.target.is_mass();
        if all.iter().any(is_mass) {
            let (robot, matters) = self.matter(&all);
            sampled.vehicle = Arc::new(Vehicle { robot, ..(*self.vehicle).clone() });
            sampled.payloads.iter_mut().zip(matters).for_each(|(p, matter)| p.matter = matter);
        }
        if all.iter().any(|d| is_mass(d) && !d.known) {
            let (robot, matters) = self.matter(&known);
            sampled.believed = Some(Box::new(Believed { robot, matters }));
        }
        sampled
    }

    /// Robot and payloads after these deviations.
    fn matter(&self, all: &[Deviation]) -> (VehicleRobot, Vec<MassProperties<f64>>) {
        let robot = &self.vehicle.robot;
        let payload = |body: BodyId| {
            let as_it_is = MassProperties {
                M_F_F: *robot.inertia(body),
                I_parts_F: *robot.inertia_of_parts(body),
            };
            changed(&as_it_is, mass_change(all, Some(body), None))
        };
        let links: Vec<_> =
            robot.joints().map(|j| (*robot.joint(j), payload(BodyId::Link(j)))).collect();
        let new = VehicleRobot::new(payload(BodyId::Base), &links).unwrap_or(*robot);
        let payloads = self.payloads.iter().enumerate();
        let matters = payloads.map(|(i, p)| changed(&p.matter, mass_change(all, None, Some(i))));
        (new, matters.collect())
    }

    fn move_start(&mut self, all: &[Deviation]) {
        let along = |of: fn(usize) -> Target| vector(all, of);
        let start = &mut self.start;
        let (turn, shift) = (along(Target::Rotation), along(Target::Position));
        start.X_NB = turned_and_shifted(&start.X_NB, turn, shift);
        start.V_NB_B.angular += along(Target::Turn);
        start.V_NB_B.linear += along(Target::Velocity);
        for deviation in all {
            match deviation.target {
                Target::Joint(j) => start.q[j] += deviation.size,
                Target::JointRate(j) => start.v[j] += deviation.size,
                _ => {}
            }
        }
        follow(&self.vehicle.followers, &mut self.start.q);
        follow_rates(&self.vehicle.followers, &mut self.start.v);
    }

    fn move_payloads(&mut self, all: &[Deviation]) {
        for (i, payload) in self.payloads.iter_mut().enumerate() {
            let PayloadStart::Free(X_NT, V_NT_T) = payload.start else { continue };
            let [shift, turn, velocity, turning] = [
                Target::PayloadPosition,
                Target::PayloadRotation,
                Target::PayloadVelocity,
                Target::PayloadTurn,
            ]
            .map(|of| vector(all, |axis| of(i, axis)));
            if [shift, turn, velocity, turning].iter().all(|v| *v == Vec3::zero()) {
                continue;
            }
            let moved = turned_and_shifted(&X_NT, turn, shift);
            // However it is turned, it goes on in the direction that it went.
            let (was, is) = (X_NT.rotation, moved.rotation);
            let angular = is.transpose_mul(was * V_NT_T.angular + turning);
            let linear = is.transpose_mul(was * V_NT_T.linear + velocity);
            payload.start = PayloadStart::Free(moved, SpatialVelocity::new(angular, linear));
        }
    }
}

/// The deviations along three axes.
fn vector(all: &[Deviation], of: impl Fn(usize) -> Target) -> Vec3<f64> {
    let along = |axis| all.iter().find(|d| d.target == of(axis)).map_or(0.0, |d| d.size);
    Vec3::from_array([along(0), along(1), along(2)])
}

/// A pose after a turn (rotation vector in its own axes, rad) and a shift (outer axes, m).
fn turned_and_shifted(X: &Pose<f64>, turn: Vec3<f64>, shift: Vec3<f64>) -> Pose<f64> {
    let mut moved = Pose::new(X.rotation, X.translation + shift);
    if turn != Vec3::zero() {
        moved.rotation = X.rotation * Quat::exp(turn).to_matrix();
    }
    moved
}

/// How a body or a payload deviates.
fn mass_change(all: &[Deviation], body: Option<BodyId>, payload: Option<usize>) -> MassChange {
    let mut change = MassChange::default();
    for Deviation { target, size, .. } in all {
        match *target {
            Target::BodyMass(of) if Some(of) == body => change.mass += size,
            Target::BodyCentre(of, axis) if Some(of) == body => change.centre[axis] += size,
            Target::BodyInertia(of) if Some(of) == body => change.inertia += size,
            Target::PayloadMass(of) if Some(of) == payload => change.mass += size,
            Target::PayloadCentre(of, axis) if Some(of) == payload => change.centre[axis] += size,
            Target::PayloadInertia(of) if Some(of) == payload => change.inertia += size,
            _ => {}
        }
    }
    change
}

/// Matter after a change. Its inertia about its centre of mass goes with its mass: the same shape,
/// denser.
fn changed(matter: &MassProperties<f64>, change: MassChange) -> MassProperties<f64> {
    if change == MassChange::default() {
        return *matter;
    }
    let M = &matter.M_F_F;
    let mass = M.mass + change.mass;
    let factor = mass / M.mass * (1.0 + change.inertia);
    let centre = M.centre_of_mass() + Vec3::from_array(change.centre);
    MassProperties {
        I_parts_F: matter.I_parts_F.scaled(factor),
        ..MassProperties::from_central(mass, centre, M.central().scaled(factor))
    }
}

/// Sensors after these deviations.
fn off(mut sensors: Sensors<f64>, all: &[Deviation]) -> Sensors<f64> {
    for Deviation { target, size, .. } in all {
        let share = 1.0 + size;
        match (*target, &mut sensors.attitude) {
            (Target::EncoderStep, _) => sensors.encoder_step *= share,
            (Target::GyroNoise, Some((gyro, _))) => {
                gyro.angle_random_walk *= share;
                gyro.bias_random_walk *= share;
            }
            (Target::TrackerNoise, Some((_, tracker))) => {
                tracker.noise_across *= share;
                tracker.noise_about *= share;
            }
            _ => {}
        }
    }
    if let Some((gyro, _)) = &mut sensors.attitude {
        gyro.bias_B += vector(all, Target::GyroBias);
    }
    sensors
}
