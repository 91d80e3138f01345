//! What is seen of the truth after each control period.

use crate::case::{AttitudeActuation, Case};
use crate::signals::actuator_demand::ActuatorDemand;
use crate::signals::arm_shape::{reach_margin, smallest_singular_value};
use crate::signals::tool_signals::{TOOLS, ToolError, watched_tools};
use crate::signals::{MOST, Needs, Seen, values};
use crate::simulation::Simulation;
use crate::true_plant::TruePlant;
use wrasse_dynamics::{
    BodyId, Configuration, Dynamics, Generalized, Kinematics, Outside, State, inverse_dynamics,
    kinematics, kinetic_energy, mount_reaction,
};
use wrasse_flight::{Axes, Command, FlightComputer};
use wrasse_hardware::ActuatorReadings;
use wrasse_spatial::{Mat3, Pose, Quat, SpatialForce, SpatialVelocity, Vec3};
use wrasse_vehicle::JOINTS;
use wrasse_world::MotorTorques;

/// The truth at one instant.
#[derive(Debug, Clone)]
pub(crate) struct Observation {
    pub(crate) state: State<f64, JOINTS>,
    pub(crate) dynamics: Dynamics<f64, JOINTS>,
    /// Torque that turned the base (N·m, base axes).
    pub(crate) torque_B: Vec3<f64>,
    /// Torque that would have kept the base from feeling the arms (N·m, base axes).
    pub(crate) reaction_B: Vec3<f64>,
    /// Momentum that the actuator stores (N·m·s, base axes).
    pub(crate) stored_B: Vec3<f64>,
    /// Tool less reference: position (m) and rotation vector (rad), in the reference's axes.
    pub(crate) tool_error: ToolError,
    /// Tool in inertial axes.
    pub(crate) X_NE: Pose<f64>,
    pub(crate) V_NE: SpatialVelocity<f64>,
    /// Rotation vector of the base since the start, with its whole turns (rad), and its translation (m).
    pub(crate) base_turn: Vec3<f64>,
    pub(crate) base_shift: Vec3<f64>,
    /// Torques of the motors of wheels and gimbals; zero where they are not needed.
    pub(crate) motor_torques: MotorTorques,
    /// What wheels, CMGs and thrusters say.
    pub(crate) readings: ActuatorReadings<f64>,
    /// Values of the signals, in the order of the quantities; NaN behind the last.
    pub(crate) values: [f64; MOST],
}

/// The line that the tool follows, for errors along and across it.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Track {
    phase: Option<usize>,
    start: Vec3<f64>,
    last: Vec3<f64>,
    direction: Option<Vec3<f64>>,
    /// Nothing is driven: there is nowhere that the tool should be, and nothing is steered.
    pub(crate) coasting: bool,
    /// Attitude of the base, and the sum of its small turns, inertial axes (rad).
    attitude: Option<Quat<f64>>,
    turns_N: Vec3<f64>,
}

impl Track {
    /// Before anything is driven.
    pub(crate) fn before_the_start() -> Self {
        Self { coasting: true, ..Self::default() }
    }
    /// Follow the reference of a command that this computer gave, and the base with its attitude
    /// `quat_NB`.
    pub(crate) fn follow(
        &mut self,
        command: &Command<f64, JOINTS>,
        computer: &FlightComputer<f64, JOINTS>,
        quat_NB: &Quat<f64>,
    ) {
        let moves_tool = computer.follows_tool();
        self.coasting = computer.coasts();
        let before = self.attitude.replace(*quat_NB).unwrap_or(*quat_NB);
        self.turns_N += (*quat_NB * before.conjugate()).log();
        let at = command.reference.X_NE.translation;
        if command.begins || self.phase != Some(command.phase) {
            if moves_tool || self.phase.is_none() {
                self.start = if self.phase.is_none() { at } else { self.last };
                self.direction = None;
            }
            self.phase = Some(command.phase);
        }
        let way = at - self.start;
        if moves_tool && way.norm() > 1e-6 {
            self.direction = Some(way * (1.0 / way.norm()));
        }
        self.last = at;
    }
    /// The rotation vector of a rotation `R_S` from the start's axes (inertial axes by `R_NS`), whose
    /// angle counts whole turns: of all that are the same rotation, the one that the small turns
    /// summed up to.
    fn counted_turn(&self, R_S: &Mat3<f64>, R_NS: &Mat3<f64>) -> Vec3<f64> {
        let shortest = Quat::from_matrix(R_S).log();
        let (angle, summed) = (shortest.norm(), R_NS.transpose_mul(self.turns_N));
        if angle < 1e-9 {
            return shortest;
        }
        let axis = shortest * (1.0 / angle);
        let turns = ((summed.dot(axis) - angle) / std::f64::consts::TAU).round();
        if turns == 0.0 { shortest } else { axis * (angle + turns * std::f64::consts::TAU) }
    }
    /// Signed error along the line and error across it (m); NaN where there is no line.
    pub(crate) fn split(&self, error: Vec3<f64>) -> (f64, f64) {
        let direction = self.direction.filter(|_| !self.coasting);
        direction.map_or((f64::NAN, f64::NAN), |direction| {
            let along = error.dot(direction);
            (along, (error - direction * along).norm())
        })
    }
}

/// See the truth after a period with this command; `place` is for what a posture gives.
pub(crate) fn observe(
    flight: &Simulation<'_, TruePlant<'_>>,
    command: &Command<f64, JOINTS>,
    track: &Track,
    needs: Needs,
    place: &mut Configuration<f64, JOINTS>,
) -> Observation {
    let (case, computer, world) = (flight.case(), flight.computer(), &flight.plant().world);
    let state = world.state();
    let dynamics = if needs.dynamics { world.dynamics() } else { not_looked_at() };
    let k = kinematics(world.robot(), &state);
    let tool = *computer.tool();
    let X_NE = k.pose(&tool);
    let start = &case.start.X_NB;
    let turned = start.rotation.transpose() * state.X_NB.rotation;
    let nan = f64::NAN;
    let nothing = Vec3::from_array([nan; 3]);
    let (mounts, reaction_B) =
        if needs.mounts { mounts(case, &k, &dynamics) } else { ((nan, nan), nothing) };
    let readings =
        if needs.readings { world.actuator_readings() } else { ActuatorReadings::default() };
    // They cost the motion of all bodies.
    let motors = needs.motors && case.stores_momentum();
    let motor_torques = if motors { world.motor_torques() } else { MotorTorques::default() };
    let seen = Observation {
        dynamics,
        torque_B: match case.actuation {
            _ if !needs.dynamics => nothing,
            AttitudeActuation::Fitted if case.stores_momentum() => world.internal_torque_B(),
            // Thrusters come in pulses: there is no torque at an instant that says anything.
            AttitudeActuation::Fitted => nothing,
            AttitudeActuation::Ideal(_) => world.actuator_torque_B() + dynamics.force.base.torque,
        },
        reaction_B,
        stored_B: match case.actuation {
            AttitudeActuation::Fitted => stored(case, &readings),
            AttitudeActuation::Ideal(_) => world.stored_momentum_B(),
        },
        readings,
        motor_torques,
        tool_error: tool_error(&k, &X_NE, (command.reference.X_NE, command.axes)),
        X_NE,
        V_NE: k.velocity(&tool),
        base_turn: track.counted_turn(&turned, &start.rotation),
        base_shift: state.X_NB.translation - start.translation,
        values: [nan; MOST],
        state,
    };
    let asked = ActuatorDemand::of(case, command, world, &seen);
    let values = values(&Seen {
        case,
        command,
        track,
        truth: &seen,
        asked: &asked,
        estimate_error: flight.estimate_error(),
        mounts,
        shape: if needs.shape { shape(computer, &k, place) } else { (nan, nan) },
        energy: if needs.energy { there(kinetic_energy(&k)) } else { nan },
        slosh_angle: world.slosh_angle().map_or(nan, there),
        motors: if needs.motors { gimbal_torque(case, &motor_torques) } else { nan },
        tools: tool_errors(case, computer, &k),
    });
    Observation { values, ..seen }
}

/// A tool at `X_NE` less where it should be, in the axes of that.
pub(crate) fn tool_error(
    k: &Kinematics<'_, f64, JOINTS>,
    X_NE: &Pose<f64>,
    (wanted, axes): (Pose<f64>, Axes),
) -> ToolError {
    let seen = match axes {
        Axes::Inertial => *X_NE,
        Axes::Base => k.X_NB(BodyId::Base).inverse() * *X_NE,
    };
    let rotation = Quat::from_matrix(&(seen.rotation * wanted.rotation.transpose())).log();
    (seen.translation - wanted.translation, rotation)
}

/// Errors of the tools that have signals of their own, while an arm guides them.
fn tool_errors(
    case: &Case,
    computer: &FlightComputer<f64, JOINTS>,
    k: &Kinematics<'_, f64, JOINTS>,
) -> [Option<ToolError>; TOOLS] {
    let mut errors = [None; TOOLS];
    for (error, name) in errors.iter_mut().zip(watched_tools(&case.vehicle)) {
        let tool = case.vehicle.frame(name);
        let arm = computer.arms().find(|arm| Some(arm.tool) == tool);
        let at = arm.and_then(|arm| Some((arm.tool, arm.reference?)));
        *error = at
            .filter(|_| !computer.coasts())
            .map(|(tool, reference)| tool_error(k, &k.pose(&tool), reference));
    }
    errors
}

/// How much farther the tool could reach (m), and how far the arm is from a singular posture (–).
fn shape(
    computer: &FlightComputer<f64, JOINTS>,
    k: &Kinematics<'_, f64, JOINTS>,
    place: &mut Configuration<f64, JOINTS>,
) -> (f64, f64) {
    let reach = reach_margin(k, computer.tool()).map_or(f64::NAN, there);
    let J = computer.task_jacobian(place);
    (reach, there(smallest_singular_value(&J, computer.task())))
}

/// Accelerations and forces that nobody asked for.
fn not_looked_at() -> Dynamics<f64, JOINTS> {
    let nan = f64::NAN;
    let nothing = Vec3::from_array([nan; 3]);
    Dynamics {
        nudot: Generalized { base: SpatialVelocity::new(nothing, nothing), joints: [nan; JOINTS] },
        force: Generalized { base: SpatialForce::new(nothing, nothing), joints: [nan; JOINTS] },
    }
}

/// Largest torque of a gimbal's motor (N·m), the one that it gives now, or the one that it would have needed
/// to do as it was told; NaN without CMGs.
fn gimbal_torque(case: &Case, motors: &MotorTorques) -> f64 {
    if case.equipment.actuators.cmgs.is_empty() {
        return f64::NAN;
    }
    largest(motors.gimbal.iter().chain(&motors.gimbal_needed).map(|torque| torque.abs()))
}

/// Momentum in wheels and CMGs beside the base (N·m·s, base axes).
fn stored(case: &Case, readings: &ActuatorReadings<f64>) -> Vec3<f64> {
    let actuators = &case.equipment.actuators;
    actuators.cmg_momentum(&readings.gimbal_angle) + actuators.wheel_momentum(&readings.wheel_speed)
}

/// Largest force (N) and moment (N·m) at a mount, and the torque about the base's centre of mass by
/// which the base carries all arms (base axes). Propellant that swings is no arm.
fn mounts(
    case: &Case,
    k: &Kinematics<'_, f64, JOINTS>,
    dynamics: &Dynamics<f64, JOINTS>,
) -> ((f64, f64), Vec3<f64>) {
    let (X_NB, mut nudot) = (&k.X_NB(BodyId::Base), dynamics.nudot);
    if let Some(g_N) = case.environment.gravity_N() {
        // Weights are as a base that accelerates upwards: a mount bears no more than keeps its arm from
        // falling as the base does.
        nudot.base.linear -= X_NB.rotation.transpose_mul(g_N);
    }
    let forces = inverse_dynamics(k, &nudot, Outside::nothing());
    let p_NBcm = X_NB.point(k.robot.inertia(BodyId::Base).centre_of_mass());
    let (mut largest, mut total) = ((0.0_f64, 0.0_f64), Vec3::zero());
    let own = case.vehicle.robot.joints();
    for j in own.filter(|&j| k.robot.joint(j).parent == BodyId::Base) {
        let F = mount_reaction(k, &forces, j);
        largest = (largest.0.max(F.force.norm()), largest.1.max(F.torque.norm()));
        total += F.torque + (k.joint_origin(j) - p_NBcm).cross(F.force);
    }
    (largest, X_NB.rotation.transpose_mul(total))
}

/// The value of a quantity that is there: one that is no number is beyond every limit.
pub(crate) fn there(x: f64) -> f64 {
    if x.is_nan() { f64::INFINITY } else { x }
}

/// The largest of some values; infinite if one is no number, NaN of none.
pub(crate) fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().map(there).fold(f64::NAN, f64::max)
}
