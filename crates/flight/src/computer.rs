//! The flight computer: phases, references, estimates and the commands of the actuators.

use crate::allocation::{Allocation, Unit};
use crate::base_control::BaseControl;
use crate::control_period::{ArmReference, PeriodMemory};
use crate::guidance::{Guidance, GuidanceContext};
use crate::interface::{Axes, Command, Sensed};
use crate::law::ArmLaw;
use crate::navigation::Navigation;
use crate::period_command::ControlOutput;
use crate::phase::Phase;
use crate::sequence::BadPhase;
use crate::setup::{Actuation, Setup};
use wrasse_dynamics::{Robot, State};
use wrasse_hardware::ActuatorReadings;
use wrasse_spatial::{Pose, Scalar, Vec3};

/// What flies: one call per control period.
///
/// It decides: phases, estimates, allocation. [`control_period`](crate::control_period)
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

    /// One control period: from the readings of the sensors to the commands of the actuators.
    ///
    /// # Errors
    /// If a phase begins whose numbers describe no motion.
    pub fn step(&mut self, sensed: &Sensed<T, J>) -> Result<Command<T, J>, BadPhase<T>> {
        let period = self.setup.tuning.period;
        let state = self.navigation.estimate(sensed, &self.memory.acceleration, period);
        self.memory.measurement_update(&self.robot, &self.setup, &state);
        let context =
            GuidanceContext { robot: &self.robot, setup: &self.setup, memory: &self.memory };
        let grip = self.guidance.begin(&context)?;
        let reference = self.guidance.next(&context, &sensed.tool_wrench_E.unwrap_or_default());
        let push = sensed.tool_wrench_E.as_ref();
        let output = self.memory.control_update(&self.robot, &self.setup, &state, &reference, push);
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
            no_posture_unloading: self.guidance.no_posture_unloading,
            grip,
            phase: self.guidance.phase(),
            reference: self.memory.reference,
            axes: self.memory.axes,
        })
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
        GuidanceContext { robot: &self.robot, setup: &self.setup, memory: &self.memory }
            .believed_tool(axes)
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
