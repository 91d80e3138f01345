//! Time histories: what is sampled, under which name, in which plot.

use crate::case::{AttitudeActuation, Case};
use crate::outcome::{Channel, Telemetry};
use crate::signals::observe::Observation;
use crate::signals::{SIGNALS, quantity::Kind, tool_values};
use crate::simulation::Simulation;
use crate::true_plant::TruePlant;
use wrasse_dynamics::JointKind;
use wrasse_flight::Command;
use wrasse_spatial::{Pose, Quat, Vec3};
use wrasse_vehicle::JOINTS;
use wrasse_world::{Ledger, Source};

/// Collects samples into channels; the channels are made by the first sample.
#[derive(Debug, Default)]
pub(crate) struct Recorder {
    telemetry: Telemetry,
    /// Number of the next channel of the sample that is being taken.
    next: usize,
}

/// A channel's name, in parts, its unit and meaning, and where it is drawn. Names are joined for the first
/// sample alone.
#[derive(Clone, Copy)]
struct Head<'a> {
    plot: &'a str,
    label: &'a str,
    path: [&'a str; 3],
    unit: &'a str,
    meaning: &'a str,
}

impl<'a> Head<'a> {
    /// A channel that is not drawn.
    fn new(name: &'a str, unit: &'a str, meaning: &'a str) -> Self {
        Self::of([name, "", ""], unit, meaning)
    }
    /// The same of a name in parts: `joint`, its name, `rate`.
    fn of(path: [&'a str; 3], unit: &'a str, meaning: &'a str) -> Self {
        Self { plot: "", label: "", path, unit, meaning }
    }
    fn drawn(self, plot: &'a str, label: &'a str) -> Self {
        Self { plot, label, ..self }
    }
    /// Its name with a component behind it, if there is one.
    fn name(&self, component: &str) -> String {
        let parts = self.path.iter().copied().chain([component]);
        parts.filter(|part| !part.is_empty()).collect::<Vec<_>>().join(".")
    }
}

/// A joint's name and what it is told or does, in units of records.
struct JointUnits {
    position: &'static str,
    rate: &'static str,
    effort: &'static str,
    /// How many of the first two are one in SI.
    per_si: f64,
    plots: [&'static str; 3],
}

const TURNING: JointUnits = JointUnits {
    position: "deg",
    rate: "deg/s",
    effort: "N·m",
    per_si: 180.0 / std::f64::consts::PI,
    plots: ["Joint positions", "Joint rates", "Joint torques"],
};

const SLIDING: JointUnits = JointUnits {
    position: "mm",
    rate: "mm/s",
    effort: "N",
    per_si: 1e3,
    plots: ["Joint travel", "Joint speeds", "Joint forces"],
};

impl Recorder {
    pub(crate) fn finish(self) -> Telemetry {
        self.telemetry
    }

    fn put(&mut self, head: Head<'_>, value: f64) {
        self.put_component(head, "", value);
    }

    fn put_component(&mut self, head: Head<'_>, component: &str, value: f64) {
        if self.next == self.telemetry.channels.len() {
            let label = [head.label, component];
            let label: Vec<_> = label.into_iter().filter(|word| !word.is_empty()).collect();
            self.telemetry.channels.push(Channel {
                name: head.name(component),
                unit: head.unit.into(),
                meaning: head.meaning.into(),
                plot: head.plot.into(),
                label: label.join(" "),
                values: vec![],
            });
        }
        self.telemetry.channels[self.next].values.push(value);
        self.next += 1;
    }

    fn put_vector(&mut self, head: Head<'_>, v: Vec3<f64>) {
        for (axis, x) in ["x", "y", "z"].into_iter().zip(v.to_array()) {
            self.put_component(head, axis, x);
        }
    }

    fn put_quaternion(&mut self, head: Head<'_>, quat: &Quat<f64>) {
        for (part, x) in [("w", quat.w), ("x", quat.x), ("y", quat.y), ("z", quat.z)] {
            self.put_component(head, part, x);
        }
    }

    /// Take one sample, of what is seen after the last period or before the first, and of the commands of
    /// that period.
    pub(crate) fn sample(
        &mut self,
        flight: &Simulation<'_, TruePlant<'_>>,
        command: &Command<f64, JOINTS>,
        seen: &Observation,
    ) {
        let case = flight.case();
        self.telemetry.time.push(flight.time());
        let phase = case.phases.get(command.phase);
        self.telemetry.phase.push(phase.map_or(String::new(), |phase| phase.name.clone()));
        self.next = 0;
        self.signals(case, seen);
        self.tool_and_base(flight, seen);
        self.joints(case, command, seen);
        self.attitude(case, command, seen);
        self.equipment(case, command, seen);
        self.payloads(flight);
        self.books(flight.plant().ledger());
    }

    /// The signals that the table draws.
    fn signals(&mut self, case: &Case, seen: &Observation) {
        for (signal, value) in SIGNALS.iter().zip(seen.values) {
            let Some(plot) = signal.plot.as_ref().filter(|plot| (plot.shown)(case)) else {
                continue;
            };
            let head = Head::new(signal.name, plot.unit, signal.meaning);
            self.put(head.drawn(plot.title, plot.label), value * plot.per_si);
        }
        let (mm, deg) = (1e3, 1.0_f64.to_degrees());
        for (tool, [off, turned]) in tool_values(case, &seen.values) {
            let head = |what, unit| Head::of(["tool", tool, what], unit, "error of this tool");
            let plot = "Error of each tool";
            self.put(head("position_error", "mm").drawn(plot, tool), off * mm);
            let plot = "Orientation error of each tool";
            self.put(head("attitude_error", "deg").drawn(plot, tool), turned * deg);
        }
    }

    fn tool_and_base(&mut self, flight: &Simulation<'_, TruePlant<'_>>, seen: &Observation) {
        let meaning = "position of the tool, inertial axes";
        let head = Head::new("tool.position", "m", meaning).drawn("Tool position", "");
        self.put_vector(head, seen.X_NE.translation);
        let meaning =
            "rotation vector of the base since the start, with whole turns, axes of the start";
        let head = Head::new("base.rotation", "deg", meaning);
        let turn = seen.base_turn.map(f64::to_degrees);
        self.put_vector(head.drawn("Base rotation since the start", ""), turn);
        let meaning = "way of the base's origin since the start, inertial axes";
        let head = Head::new("base.translation", "mm", meaning);
        self.put_vector(head.drawn("Base translation since the start", ""), seen.base_shift * 1e3);
        let head = Head::new(
            "base.quaternion",
            "–",
            "attitude of the base, from its axes to inertial ones",
        );
        self.put_quaternion(head, &flight.plant().world.quat_NB());
        let head = Head::new("base.position", "m", "position of the base's origin, inertial axes");
        self.put_vector(head, seen.state.X_NB.translation);
        let V = seen.state.V_NB_B;
        let head = Head::new("base.turn_rate", "deg/s", "angular velocity of the base, its axes");
        self.put_vector(head, V.angular.map(f64::to_degrees));
        let head = Head::new("base.velocity", "m/s", "velocity of the base's origin, its axes");
        self.put_vector(head, V.linear);
    }

    fn joints(&mut self, case: &Case, command: &Command<f64, JOINTS>, seen: &Observation) {
        // Turning and sliding joints do not share a unit, so they do not share a plot.
        for (kind, units) in [(JointKind::Revolute, TURNING), (JointKind::Prismatic, SLIDING)] {
            let of_kind = |j: &usize| case.vehicle.robot.joint(*j).kind == kind;
            let joints = || (0..case.vehicle.joint_names.len()).filter(of_kind);
            let (q, v) = (&seen.state.q, &seen.state.v);
            let (told, effort) = (&command.set_points, &seen.dynamics.force.joints);
            let JointUnits { position, rate, effort: torque, per_si, plots } = units;
            let mut put = |name: &str, unit, meaning, plot, value: &dyn Fn(usize) -> f64| {
                for j in joints() {
                    let joint = &case.vehicle.joint_names[j];
                    let head = Head::of(["joint", joint, name], unit, meaning);
                    self.put(head.drawn(plot, joint), value(j));
                }
            };
            put("position", position, "position of the joint", plots[0], &|j| q[j] * per_si);
            put("rate", rate, "rate of the joint", plots[1], &|j| v[j] * per_si);
            put("effort", torque, "what drives the joint", plots[2], &|j| effort[j]);
            let meaning = "set-point of the position at the end of the period";
            put("commanded_position", position, meaning, "", &|j| told[j].position * per_si);
            let meaning = "set-point of the rate at the end of the period";
            put("commanded_rate", rate, meaning, "", &|j| told[j].rate * per_si);
            let meaning = "what the drive is told over the period, within its limit";
            put("commanded_effort", torque, meaning, "", &|j| command.effort[j]);
        }
    }

    fn attitude(&mut self, case: &Case, command: &Command<f64, JOINTS>, seen: &Observation) {
        let plot = "Torque on the base: what the arms take, what was given";
        let meaning =
            "torque by which the base carries the arms, about its centre of mass, its axes";
        let head = Head::new("attitude.reaction", "N·m", meaning).drawn(plot, "arms");
        self.put_vector(head, seen.reaction_B);
        let meaning = "torque that turns the base, its axes";
        let head = Head::new("attitude.torque", "N·m", meaning).drawn(plot, "given");
        self.put_vector(head, seen.torque_B);
        let meaning = "momentum stored by the attitude control, base axes";
        let head = Head::new("attitude.momentum", "N·m·s", meaning);
        self.put_vector(head.drawn("Momentum stored by the attitude control", ""), seen.stored_B);
        if let AttitudeActuation::Ideal(Some(actuator)) = case.actuation {
            let (limit, plot) =
                (actuator.momentum_limit, "Momentum stored by the attitude control");
            let meaning = "most that the ideal actuator stores";
            let head = Head::new("attitude.momentum_limit", "N·m·s", meaning);
            self.put(head.drawn(plot, "limit"), limit);
            let head = Head::new("attitude.momentum_limit_below", "N·m·s", meaning);
            self.put(head.drawn(plot, "-limit"), -limit);
        }
        let meaning = "torque that the base should feel over the period, its axes";
        let head = Head::new("attitude.commanded_torque", "N·m", meaning);
        self.put_vector(head, command.attitude_torque_B);
    }

    fn equipment(&mut self, case: &Case, command: &Command<f64, JOINTS>, seen: &Observation) {
        let (equipment, read, told) = (&case.equipment, &seen.readings, &command.actuators);
        let per_degree = 1.0_f64.to_degrees();
        let mut each =
            |names: &[String], (kind, name, unit), meaning, plot, values: &[f64], per| {
                for (of, value) in names.iter().zip(values) {
                    let name = format!("{kind}.{of}.{name}");
                    self.put(Head::new(&name, unit, meaning).drawn(plot, of), value * per);
                }
            };
        let (wheels, cmgs) = (&equipment.wheel_names, &equipment.cmg_names);
        let per_minute = 30.0 / std::f64::consts::PI;
        let meaning = "speed of the wheel in the base";
        each(
            wheels,
            ("wheel", "speed", "rpm"),
            meaning,
            "Wheel speeds",
            &read.wheel_speed,
            per_minute,
        );
        let motors = &seen.motor_torques;
        let meaning = "torque of the wheel's motor";
        each(wheels, ("wheel", "torque", "N·m"), meaning, "", &motors.wheel, 1.0);
        let meaning = "torque that the wheel is told";
        each(wheels, ("wheel", "commanded_torque", "N·m"), meaning, "", &told.wheel_torque, 1.0);
        let meaning = "angle of the gimbal";
        each(
            cmgs,
            ("cmg", "angle", "deg"),
            meaning,
            "Gimbal angles",
            &read.gimbal_angle,
            per_degree,
        );
        let meaning = "rate of the gimbal";
        each(
            cmgs,
            ("cmg", "rate", "deg/s"),
            meaning,
            "Gimbal rates",
            &read.gimbal_rate,
            per_degree,
        );
        let meaning = "torque of the gimbal's motor";
        each(cmgs, ("cmg", "torque", "N·m"), meaning, "", &motors.gimbal, 1.0);
        let meaning = "rate that the gimbal is told";
        each(cmgs, ("cmg", "commanded_rate", "deg/s"), meaning, "", &told.gimbal_rate, per_degree);
        let meaning = "time for which the thruster is told to be open in the period";
        let thrusters = &equipment.thruster_names;
        each(thrusters, ("thruster", "on_time", "ms"), meaning, "", &told.thruster_on, 1e3);
    }

    /// Payloads, in the grips or free: at their centres of mass.
    fn payloads(&mut self, flight: &Simulation<'_, TruePlant<'_>>) {
        for (i, X, V) in flight.plant().world.payload_motions() {
            let name = &flight.case().payloads[i].name;
            let head = |what, unit, meaning| Head::of(["payload", name, what], unit, meaning);
            let Pose { rotation, translation } = X;
            let meaning = "position of its centre of mass, inertial axes";
            self.put_vector(head("position", "m", meaning), translation);
            let meaning = "attitude of the payload, from its axes to inertial ones";
            self.put_quaternion(head("quaternion", "–", meaning), &Quat::from_matrix(&rotation));
            let meaning = "velocity of its centre of mass, inertial axes";
            self.put_vector(head("velocity", "m/s", meaning), V.linear);
            let meaning = "angular velocity of the payload, inertial axes";
            let turn = V.angular.map(f64::to_degrees);
            self.put_vector(head("turn_rate", "deg/s", meaning), turn);
        }
    }

    fn books(&mut self, ledger: &Ledger) {
        let [angular, linear, energy] = ledger.residuals();
        let plot = "Ledger: what nobody booked, relative to what is there";
        let relative = |rest: f64, scale: f64| if scale > 0.0 { rest / scale } else { 0.0 };
        let meaning = "what no source explains, relative to the largest that was exchanged";
        for (k, (label, name, rest)) in [
            ("angular", "ledger.angular_rest", angular),
            ("linear", "ledger.linear_rest", linear),
            ("energy", "ledger.energy_rest", energy),
        ]
        .into_iter()
        .enumerate()
        {
            let head = Head::new(name, "–", meaning).drawn(plot, label);
            self.put(head, relative(rest, ledger.scale[k]));
        }
        let unit = Kind::Energy.si();
        let head = Head::new("energy.kinetic", unit, "kinetic energy of all that moves");
        self.put(head.drawn("Energy", "kinetic"), ledger.now.energy);
        let work = |source: Source| ledger.sources[source].work;
        let turned = [Source::AttitudeActuator, Source::Wheels, Source::Cmgs, Source::Thrusters];
        let (joints, actuator) = (work(Source::JointDrives), turned.map(work).iter().sum());
        let head = Head::new("energy.from_joints", unit, "work of the joint drives so far");
        self.put(head.drawn("Energy", "from the joints"), joints);
        let head = Head::new("energy.from_attitude", unit, "work of the attitude control so far");
        self.put(head.drawn("Energy", "from the attitude control"), actuator);
    }
}
