//! The flight computer: which phase, where the tool should be, what the actuators are told.

use crate::base_control::{Actuation, BaseControl, BaseControlSetup};
use crate::control_period::{Asked, PeriodMemory};
use crate::door::{Axes, Command, Sensed};
use crate::guidance::{Guidance, Guided};
use crate::law::{ArmLaw, Measurement, Tuning};
use crate::navigation::{Navigation, NavigationSetup};
use crate::period_command::Told;
use crate::phase::Phase;
use crate::resolved_motion::{Assignment, JointUse};
use crate::sequence::BadPhase;
use crate::steering::{Steered, Unit};
use wrasse_dynamics::{Frame, Robot, State};
use wrasse_hardware::{ActuatorReadings, JointLimits};
use wrasse_spatial::{Pose, Quat, Real, Scalar, Vec3};

/// How a flight computer is set up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Setup<T, const J: usize> {
    /// What is asked of the arm; its axes are those of the current phase.
    pub assignment: Assignment<T>,
    /// How the joints may be used.
    pub joints: JointUse<T, J>,
    /// How the base is controlled.
    pub base: BaseControlSetup<T>,
    /// What the sensors are.
    pub navigation: NavigationSetup<T>,
    /// What the guidance measures.
    pub measurement: Measurement,
    /// Numbers of the laws.
    pub tuning: Tuning<T>,
    /// Limits of the joints.
    pub limits: [JointLimits<T>; J],
    /// Joints whose drives follow their set-points whatever it takes: no loop is closed over them here.
    pub position_driven: [bool; J],
}

impl<const J: usize> Setup<f64, J> {
    /// The same setup over another scalar, without estimators, steering and position hold: those decide.
    pub fn bare<T: Real>(&self) -> Setup<T, J> {
        let c = T::from_f64;
        let Assignment { tool, axes, task, law, damped_below } = self.assignment;
        let tool = Frame { body: tool.body, X_BF: Pose::from_f64(&tool.X_BF) };
        let quat = self.base.quat_ND;
        let quat_ND = Quat::new(c(quat.w), c(quat.x), c(quat.y), c(quat.z));
        let (use_, tuning) = (&self.joints, &self.tuning);
        Setup {
            assignment: Assignment { tool, axes, task, law, damped_below: c(damped_below) },
            joints: JointUse {
                gain: c(use_.gain),
                gain_rate: c(use_.gain_rate),
                posture: use_.posture.map(c),
                rate_limit: use_.rate_limit.map(c),
            },
            base: BaseControlSetup::ideal(self.base.feedforward, quat_ND),
            navigation: NavigationSetup::perfect(),
            measurement: self.measurement,
            tuning: Tuning {
                period: c(tuning.period),
                tool_gain: c(tuning.tool_gain),
                joint_bandwidth: c(tuning.joint_bandwidth),
                joint_damping: c(tuning.joint_damping),
                attitude_bandwidth: c(tuning.attitude_bandwidth),
                attitude_damping: c(tuning.attitude_damping),
            },
            position_driven: self.position_driven,
            limits: self.limits.map(|l| JointLimits {
                travel: l.travel.map(|(lower, upper)| (c(lower), c(upper))),
                rate: l.rate.map(c),
                effort: l.effort.map(c),
            }),
        }
    }
}

/// What flies: one call per control period.
///
/// It decides what is asked: phases, estimates, steering. [`control_period`](crate::control_period)
/// turns that into set-points and torques.
#[derive(Debug, Clone)]
pub struct FlightComputer<T, const J: usize> {
    pub(crate) setup: Setup<T, J>,
    pub(crate) robot: Robot<T, J>,
    pub(crate) navigation: Navigation<T, J>,
    base_control: BaseControl<T>,
    pub(crate) guidance: Guidance<T, J>,
    pub(crate) memory: PeriodMemory<T, J>,
}

impl<T: Scalar, const J: usize> FlightComputer<T, J> {
    /// A computer for this robot (with what it holds at the start) and these phases; those beyond
    /// [`PHASES`](crate::PHASES) are left out.
    pub fn new(setup: Setup<T, J>, robot: &Robot<f64, J>, phases: &[Phase<T, J>]) -> Self {
        Self {
            setup,
            robot: robot.cast(),
            navigation: Navigation::new(&setup.navigation),
            base_control: BaseControl::new(setup.base),
            guidance: Guidance::new(phases),
            memory: PeriodMemory::new(),
        }
    }

    /// One control period: from what the sensors say to what the actuators are told.
    ///
    /// # Errors
    /// If a phase begins whose numbers describe no motion.
    pub fn step(&mut self, sensed: &Sensed<T, J>) -> Result<Command<T, J>, BadPhase<T>> {
        let period = self.setup.tuning.period;
        let state = self.navigation.estimate(sensed, &self.memory.acceleration, period);
        self.memory.look(&self.robot, &self.setup, &state);
        let of = Guided { robot: &self.robot, setup: &self.setup, memory: &self.memory };
        let grip = self.guidance.begin(&of)?;
        let asked = self.guidance.next(&of, &sensed.tool_wrench_E.unwrap_or_default());
        let push = sensed.tool_wrench_E.as_ref();
        let told = self.memory.act(&self.robot, &self.setup, &state, &asked, push);
        let (told, steered) = match asked {
            Asked::Coast => (told, self.base_control.rest()),
            _ => self.turn_base(told, &state, &sensed.actuators),
        };
        Ok(Command {
            set_points: told.set_points,
            effort: told.effort,
            effort_asked: told.effort_asked,
            rate_share: told.rate_share,
            attitude_torque_B: told.attitude_torque_B,
            actuators: steered.command,
            steering: steered.report,
            no_relief: self.guidance.no_relief,
            grip,
            phase: self.guidance.phase(),
            reference: self.memory.reference,
            axes: self.memory.axes,
        })
    }

    /// What the actuators of the base are told, and the joints with what those will really give.
    fn turn_base(
        &mut self,
        told: Told<T, J>,
        state: &State<T, J>,
        readings: &ActuatorReadings<T>,
    ) -> (Told<T, J>, Steered<T>) {
        let (robot, setup) = (&self.robot, &self.setup);
        let (steered, lack_B) =
            self.base_control.command(robot, &setup.tuning, &told, state, readings);
        let counts = lack_B != Vec3::zero()
            && setup.assignment.law != ArmLaw::Terrestrial
            && setup.base.actuation != Actuation::None;
        let told = if counts { told.without_base_torque(robot, setup, lack_B) } else { told };
        (told, steered)
    }

    /// Pose of the tool as it is believed to be.
    pub(crate) fn believed_tool(&self, axes: Axes) -> Pose<T> {
        Guided { robot: &self.robot, setup: &self.setup, memory: &self.memory }.believed_tool(axes)
    }

    /// Do without a unit of the base's equipment from now on.
    pub fn isolate(&mut self, unit: Unit) {
        self.base_control.isolate(unit);
    }

    /// The robot has taken hold of something, or let go: what it is from now on.
    pub fn robot_changed(&mut self, robot: &Robot<f64, J>) {
        self.robot = robot.cast();
        self.memory.robot_changed(&self.robot, self.setup.assignment.law);
    }
}
