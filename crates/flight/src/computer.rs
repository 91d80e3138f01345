//! The flight computer: steps, references, estimates and the commands of the actuators.

use crate::allocation::{Allocation, Unit};
use crate::base_control::BaseControl;
use crate::clock::BadPhase;
use crate::condition::Known;
use crate::control_period::{ArmReference, PeriodMemory};
use crate::executive::{Decision, Executive};
use crate::interface::{Axes, Command, Sensed};
use crate::law::ArmLaw;
use crate::navigation::Navigation;
use crate::period_command::ControlOutput;
use crate::setup::{Actuation, Setup};
use crate::step::Step;
use wrasse_dynamics::{Robot, State};
use wrasse_hardware::ActuatorReadings;
use wrasse_spatial::{Pose, Scalar, Vec3};

/// What flies: one call per control period.
///
/// It decides: steps, estimates, allocation. [`control_period`](crate::control_period)
/// turns that into set-points and torques.
#[derive(Debug, Clone)]
pub struct FlightComputer<T, const J: usize> {
    pub(crate) setup: Setup<T, J>,
    pub(crate) robot: Robot<T, J>,
    pub(crate) navigation: Navigation<T, J>,
    base_control: BaseControl<T>,
    pub(crate) executive: Executive<T, J>,
    pub(crate) memory: PeriodMemory<T, J>,
}

impl<T: Scalar, const J: usize> FlightComputer<T, J> {
    /// A computer for this robot (with what it holds at the start) and these steps; those beyond
    /// [`STEPS`](crate::STEPS) are left out.
    pub fn new<S: Copy + Into<Step<T, J>>>(
        setup: Setup<T, J>,
        robot: &Robot<f64, J>,
        steps: &[S],
    ) -> Self {
        Self {
            setup,
            robot: robot.cast(),
            navigation: Navigation::new(&setup.navigation),
            base_control: BaseControl::new(setup.base),
            executive: Executive::new(steps.iter().map(|step| (*step).into()), setup.assignment),
            memory: PeriodMemory::new(),
        }
    }

    /// The same for planning: a condition on what the laws cannot foresee holds at the step's timeout.
    #[must_use]
    pub fn planning(mut self) -> Self {
        self.executive.plans = true;
        self
    }

    /// One control period: from the readings of the sensors to the commands of the actuators.
    ///
    /// # Errors
    /// If a step begins whose numbers describe no motion, and it says nothing for that.
    pub fn step(&mut self, sensed: &Sensed<T, J>) -> Result<Command<T, J>, BadPhase<T>> {
        let period = self.setup.tuning.period;
        let state = self.navigation.estimate(sensed, &self.memory.acceleration, period);
        self.memory.measurement_update(&self.robot, &self.setup, &state);
        let Decision { ended, begins, grip, exhausted } = self.decide(sensed, &state)?;
        let (robot, setup) = (&self.robot, &self.setup);
        let F_E = sensed.tool_wrench_E.unwrap_or_default();
        let (reference, share) = self.executive.next(robot, setup, &self.memory, &F_E);
        let push = sensed.tool_wrench_E.as_ref();
        let output = self.memory.control_update(robot, setup, &state, &reference, push);
        let output = match share {
            None => output,
            Some(rate_share) => ControlOutput { rate_share, ..output },
        };
        self.keep_reference();
        let (output, allocation) = match reference {
            ArmReference::Coast => (output, self.base_control.reset()),
            _ => self.turn_base(output, &state, &sensed.actuators),
        };
        Ok(Command {
            set_points: output.set_points,
            effort: output.effort,
            effort_commanded: output.effort_commanded,
            rate_share: output.rate_share,
            attitude_torque_B: output.attitude_torque_B,
            actuators: allocation.command,
            allocation: allocation.report,
            no_posture_unloading: self.executive.arms[0].guidance.no_posture_unloading,
            grip,
            phase: self.executive.number(),
            begins,
            ended,
            exhausted,
            reference: self.memory.reference,
            axes: self.memory.axes,
        })
    }

    /// Which step is under way, from what the sensors say.
    fn decide(
        &mut self,
        sensed: &Sensed<T, J>,
        state: &State<T, J>,
    ) -> Result<Decision<T>, BadPhase<T>> {
        let (motion, axes) = (self.memory.reference, self.memory.axes);
        if !self.executive.has_several_arms() {
            self.executive.arms[0].reference = Some((motion, axes));
        }
        let tool = self.setup.assignment.tool;
        let known = Known {
            robot: &self.robot,
            state,
            tool: &tool,
            reference: (motion.X_NE, axes),
            tool_wrench_E: sensed.tool_wrench_E,
            quat_ND: self.setup.base.quat_ND,
            actuators: self.setup.base.actuation.allocation().map(|setup| setup.actuators),
            readings: &sensed.actuators,
        };
        let at = (&self.robot, &mut self.setup);
        self.executive.begin(at, &mut self.memory, &known, sensed.grip)
    }

    /// The period's reference is that of the first arm's tool, however many arms there are.
    fn keep_reference(&mut self) {
        let several = self.executive.has_several_arms();
        let first = &mut self.executive.arms[0];
        match first.reference {
            Some((motion, axes)) if several => {
                (self.memory.reference, self.memory.axes) = (motion, axes);
            }
            _ if several => {}
            _ => first.reference = Some((self.memory.reference, self.memory.axes)),
        }
    }

    /// Commands of the base's actuators, and of the joints given what those will really give.
    fn turn_base(
        &mut self,
        output: ControlOutput<T, J>,
        state: &State<T, J>,
        readings: &ActuatorReadings<T>,
    ) -> (ControlOutput<T, J>, Allocation<T>) {
        let (robot, setup) = (&self.robot, &self.setup);
        let (allocation, lack_B) =
            self.base_control.command(robot, &setup.tuning, &output, state, readings);
        let counts = lack_B != Vec3::zero()
            && setup.assignment.law != ArmLaw::Terrestrial
            && setup.base.actuation != Actuation::None;
        let output = if counts { output.without_base_torque(robot, setup, lack_B) } else { output };
        (output, allocation)
    }

    /// Pose of the tool as it is believed to be.
    pub(crate) fn believed_tool(&self, axes: Axes) -> Pose<T> {
        let arm = &self.executive.arms[0];
        arm.context(&self.robot, &self.setup, &self.memory).believed_tool(axes)
    }

    /// Disable a unit of the base's equipment from now on.
    pub fn disable(&mut self, unit: Unit) {
        self.base_control.disable(unit);
    }

    /// The robot has taken hold of something, or let go: what it is from now on.
    pub fn robot_changed(&mut self, robot: &Robot<f64, J>) {
        self.robot = robot.cast();
        self.memory.robot_changed(&self.robot, self.setup.assignment.law);
    }
}
