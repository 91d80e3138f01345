//! Time histories: what is sampled, under which name, in which plot.

use crate::case::AttitudeActuation;
use crate::case::Case;
use crate::outcome::{Channel, Telemetry};
use crate::signals::SIGNALS;
use crate::signals::observe::Observation;
use wrasse_dynamics::JointKind;
use wrasse_spatial::Vec3;
use wrasse_world::{Ledger, Source};

/// Collects samples into channels; the channels are made by the first sample.
#[derive(Debug, Default)]
pub(crate) struct Recorder {
    telemetry: Telemetry,
    /// Number of the next channel of the sample that is being taken.
    next: usize,
}

impl Recorder {
    pub(crate) fn finish(self) -> Telemetry {
        self.telemetry
    }

    fn put(&mut self, plot: &str, label: &str, name: &str, unit: &str, value: f64) {
        if self.next == self.telemetry.channels.len() {
            self.telemetry.channels.push(Channel {
                name: name.into(),
                unit: unit.into(),
                plot: plot.into(),
                label: label.into(),
                values: vec![],
            });
        }
        self.telemetry.channels[self.next].values.push(value);
        self.next += 1;
    }

    fn put_vector(&mut self, plot: &str, label: &str, name: &str, unit: &str, v: Vec3<f64>) {
        for (axis, x) in ["x", "y", "z"].into_iter().zip(v.to_array()) {
            let label = if label.is_empty() { axis.into() } else { format!("{label} {axis}") };
            self.put(plot, &label, &format!("{name}.{axis}"), unit, x);
        }
    }

    /// Take one sample.
    pub(crate) fn sample(&mut self, time: f64, case: &Case, seen: &Observation, ledger: &Ledger) {
        self.telemetry.time.push(time);
        self.next = 0;
        self.signals(case, seen);
        self.tool_and_base(seen);
        self.joints(case, seen);
        self.attitude(case, seen);
        self.equipment(case, seen);
        self.books(ledger);
    }

    /// The signals that the table draws.
    fn signals(&mut self, case: &Case, seen: &Observation) {
        for (signal, value) in SIGNALS.iter().zip(seen.values) {
            let Some(plot) = signal.plot.as_ref().filter(|plot| (plot.shown)(case)) else {
                continue;
            };
            self.put(plot.title, plot.label, signal.name, plot.unit, value * plot.per_si);
        }
    }

    fn tool_and_base(&mut self, seen: &Observation) {
        self.put_vector("Tool position", "", "tool.position", "m", seen.X_NE.translation);
        let turn = seen.base_turn.map(f64::to_degrees);
        self.put_vector("Base rotation since the start", "", "base.rotation", "deg", turn);
        let shift = seen.base_shift * 1e3;
        self.put_vector("Base translation since the start", "", "base.translation", "mm", shift);
    }

    fn joints(&mut self, case: &Case, seen: &Observation) {
        let joints = || {
            case.vehicle.joint_names.iter().enumerate().map(|(j, name)| {
                (j, name.clone(), case.vehicle.robot.joint(j).kind == JointKind::Revolute)
            })
        };
        // Turning and sliding joints do not share a unit, so they do not share a plot.
        for turns in [true, false] {
            let pick = |turning: &'static str, sliding: &'static str| {
                if turns { turning } else { sliding }
            };
            let scale = if turns { 1.0_f64.to_degrees() } else { 1e3 };
            for (j, name, _) in joints().filter(|joint| joint.2 == turns) {
                let path = format!("joint.{name}.position");
                let plot = pick("Joint positions", "Joint travel");
                self.put(plot, &name, &path, pick("deg", "mm"), seen.state.q[j] * scale);
            }
            for (j, name, _) in joints().filter(|joint| joint.2 == turns) {
                let path = format!("joint.{name}.rate");
                let plot = pick("Joint rates", "Joint speeds");
                self.put(plot, &name, &path, pick("deg/s", "mm/s"), seen.state.v[j] * scale);
            }
            for (j, name, _) in joints().filter(|joint| joint.2 == turns) {
                let path = format!("joint.{name}.effort");
                let plot = pick("Joint torques", "Joint forces");
                self.put(plot, &name, &path, pick("N·m", "N"), seen.dynamics.force.joints[j]);
            }
        }
    }

    fn attitude(&mut self, case: &Case, seen: &Observation) {
        let plot = "Torque on the base: what the arms take, what was given";
        self.put_vector(plot, "arms", "attitude.reaction", "N·m", seen.reaction_B);
        self.put_vector(plot, "given", "attitude.torque", "N·m", seen.torque_B);
        let plot = "Momentum stored by the attitude control";
        self.put_vector(plot, "", "attitude.momentum", "N·m·s", seen.stored_B);
        if let AttitudeActuation::Ideal(Some(actuator)) = case.actuation {
            let limit = actuator.momentum_limit;
            self.put(plot, "limit", "attitude.momentum_limit", "N·m·s", limit);
            self.put(plot, "-limit", "attitude.momentum_limit_below", "N·m·s", -limit);
        }
    }

    fn equipment(&mut self, case: &Case, seen: &Observation) {
        let (equipment, read) = (&case.equipment, &seen.readings);
        for (i, name) in equipment.wheel_names.iter().enumerate() {
            let per_minute = read.wheel_speed[i] * 30.0 / std::f64::consts::PI;
            self.put("Wheel speeds", name, &format!("wheel.{name}.speed"), "rpm", per_minute);
        }
        for (i, name) in equipment.cmg_names.iter().enumerate() {
            let degrees = read.gimbal_angle[i].to_degrees();
            self.put("Gimbal angles", name, &format!("cmg.{name}.angle"), "deg", degrees);
        }
        for (i, name) in equipment.cmg_names.iter().enumerate() {
            let degrees = read.gimbal_rate[i].to_degrees();
            self.put("Gimbal rates", name, &format!("cmg.{name}.rate"), "deg/s", degrees);
        }
    }

    fn books(&mut self, ledger: &Ledger) {
        let [angular, linear, energy] = ledger.residuals();
        let plot = "Ledger: what nobody booked, relative to what is there";
        let relative = |rest: f64, scale: f64| if scale > 0.0 { rest / scale } else { 0.0 };
        self.put(plot, "angular", "ledger.angular_rest", "–", relative(angular, ledger.scale[0]));
        self.put(plot, "linear", "ledger.linear_rest", "–", relative(linear, ledger.scale[1]));
        self.put(plot, "energy", "ledger.energy_rest", "–", relative(energy, ledger.scale[2]));
        let plot = "Energy";
        self.put(plot, "kinetic", "energy.kinetic", "J", ledger.now.energy);
        let work = |source: Source| ledger.sources[source].work;
        let turned = [Source::AttitudeActuator, Source::Wheels, Source::Cmgs, Source::Thrusters];
        let (joints, actuator) = (work(Source::JointDrives), turned.map(work).iter().sum());
        self.put(plot, "from the joints", "energy.from_joints", "J", joints);
        self.put(plot, "from the attitude control", "energy.from_attitude", "J", actuator);
    }
}
