//! Control allocation over all groups: which part of the demanded torque and force each takes.

use crate::allocation::{
    CmgLaw, Desaturation, Modulation, Modulator, Selection, WheelLaw, WrenchAxes, cmg_rates,
    cmg_singularity, thruster_duties, wheel_torques,
};
use wrasse_hardware::{ActuatorCommand, ActuatorReadings, Actuators, CMGS, THRUSTERS, WHEELS};
use wrasse_spatial::{Scalar, SpatialForce, Vec3};

/// A unit of the equipment, by its number in its group.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unit {
    /// A reaction wheel.
    Wheel(usize),
    /// A control moment gyro.
    Cmg(usize),
    /// A thruster.
    Thruster(usize),
}

/// How torque and force are allocated to the actuators.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AllocationSetup<T> {
    /// What there is.
    pub actuators: Actuators<T>,
    /// How torque is shared among the wheels.
    pub wheels: WheelLaw<T>,
    /// How the gimbals are turned.
    pub cmgs: CmgLaw<T>,
    /// How thrusters are pulsed.
    pub modulation: Modulation<T>,
    /// Whether a force counts that thrusters cannot give, or cannot help giving; if not, the base goes
    /// where it is pushed.
    pub holds_position: bool,
    /// When the thrusters desaturate wheels and CMGs; `None`: never.
    pub desaturation: Option<Desaturation<T>>,
}

/// What is needed over the coming period.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Demand<T> {
    /// Torque (N·m) and force (N) on the bodies, about the system's centre of mass, base axes.
    pub wanted: SpatialForce<T>,
    /// Rate of the base, base axes (rad/s).
    pub w_NB_B: Vec3<T>,
    /// Centre of mass of the system, base frame (m).
    pub p_BScm_B: Vec3<T>,
    /// Control period (s).
    pub period: T,
}

/// What the actuators can give of the demand.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AllocationReport<T> {
    /// What was wanted of the actuators, base axes (N·m, N).
    pub wanted: SpatialForce<T>,
    /// What of it no actuator could give (N·m, N).
    pub missing: SpatialForce<T>,
    /// Momentum in wheels and CMGs, by their readings, base axes (N·m·s).
    pub stored_B: Vec3<T>,
    /// Distance of the CMGs from a singular setting, det(A Aᵀ) for unit momenta (–); one without
    /// CMGs.
    pub singularity: T,
    /// Whether the thrusters are desaturating wheels and CMGs.
    pub desaturation: bool,
}

/// Commands of the actuators, and what they leave open.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Allocation<T> {
    /// Commands of the actuators.
    pub command: ActuatorCommand<T>,
    /// What was wanted and what is missing.
    pub report: AllocationReport<T>,
    /// Torque that the bodies will feel on average over the period, with the servos as slow as they
    /// are, base axes (N·m).
    pub expected_B: Vec3<T>,
}

impl<T: Scalar> Allocation<T> {
    /// No demand and no command.
    pub fn nothing() -> Self {
        let none = SpatialForce::zero();
        Self {
            command: ActuatorCommand::default(),
            report: AllocationReport {
                wanted: none,
                missing: none,
                stored_B: Vec3::zero(),
                singularity: T::one(),
                desaturation: false,
            },
            expected_B: Vec3::zero(),
        }
    }
}

/// Steering, with what it remembers from period to period.
#[derive(Debug, Clone, Copy)]
pub struct Allocator<T> {
    setup: AllocationSetup<T>,
    usable_wheels: [bool; WHEELS],
    usable_cmgs: [bool; CMGS],
    usable_thrusters: [bool; THRUSTERS],
    modulators: [Modulator<T>; THRUSTERS],
    /// Clock of the waves by which some laws shake the gimbals (s).
    time: T,
    /// What wheels and CMGs stored when they were last read (N·m·s), and the change that was
    /// due over the period (N·m·s), base axes.
    before: Option<(Vec3<T>, Vec3<T>)>,
    /// Integral of the torque that was commanded and not given (N·m·s).
    momentum_error_B: Vec3<T>,
    /// Last valid speeds and angles: a unit whose reading is NaN may recover.
    last_valid: ActuatorReadings<T>,
}

/// Gain on the momentum error (1/s): slower than the servos answer. Periods longer than its time
/// constant take the whole error in one: with more the loop would be unstable.
const INTEGRAL_GAIN: f64 = 10.0;

impl<T: Scalar> Allocator<T> {
    /// Steering that has all units.
    pub fn new(setup: &AllocationSetup<T>) -> Self {
        Self {
            setup: *setup,
            usable_wheels: [true; WHEELS],
            usable_cmgs: [true; CMGS],
            usable_thrusters: [true; THRUSTERS],
            modulators: [Modulator::default(); THRUSTERS],
            time: T::zero(),
            before: None,
            momentum_error_B: Vec3::zero(),
            last_valid: ActuatorReadings::default(),
        }
    }

    /// Nothing is allocated until the next call: the integral is cleared, and no pulse goes on.
    pub fn reset(&mut self) {
        self.before = None;
        self.momentum_error_B = Vec3::zero();
        self.modulators = [Modulator::default(); THRUSTERS];
    }

    /// The tank is empty: no pulse goes on, and desaturation ends.
    fn stop_thrusters(&mut self) {
        self.modulators = [Modulator::default(); THRUSTERS];
        if let Some(desaturation) = &mut self.setup.desaturation {
            desaturation.active = false;
        }
    }

    /// Disable a unit from now on: its commands are zero.
    pub fn disable(&mut self, unit: Unit) {
        let (flags, i): (&mut [bool], usize) = match unit {
            Unit::Wheel(i) => (&mut self.usable_wheels, i),
            Unit::Cmg(i) => (&mut self.usable_cmgs, i),
            Unit::Thruster(i) => (&mut self.usable_thrusters, i),
        };
        if let Some(usable) = flags.get_mut(i) {
            *usable = false;
        }
    }

    /// Commands of the actuators for the coming period.
    ///
    /// CMGs come first, then wheels. Thrusters give the force, what of the torque those cannot give,
    /// and the desaturation torque. They are pulsed: the mean torque that the pulses give over the period
    /// is taken off before CMGs and wheels get their part, so these smooth the pulses.
    ///
    /// If a reading is NaN its unit gets a zero command, and its last valid reading is used.
    pub fn allocate(
        &mut self,
        demand: &Demand<T>,
        readings: &ActuatorReadings<T>,
    ) -> Allocation<T> {
        let actuators = self.setup.actuators;
        let mut allocation = Allocation::nothing();
        let stored_B = self.stored(readings);
        self.update_integral(stored_B);
        let mut missing = demand.wanted;
        let mut rest_B = demand.wanted.torque;
        let dry = actuators.tank.is_some() && readings.propellant <= T::zero();
        if dry {
            self.stop_thrusters();
        } else if !actuators.thrusters.is_empty() {
            let mut ask = demand.wanted;
            if self.stores_momentum() {
                // No more than what turns inside can hold against: the bodies should not feel it.
                let desaturation_B = self.desaturation_torque(stored_B);
                let (_, _, missing_B) =
                    self.internal_torque(rest_B - desaturation_B, demand, stored_B, readings);
                ask.torque = desaturation_B + missing_B;
            }
            let (p_BScm_B, thrusters) = (demand.p_BScm_B, &actuators.thrusters);
            // Couples, as far as there are any, even where nobody asks for force: a base that is
            // pushed away takes the arm with it.
            let (holds, controlled) = (self.setup.holds_position, WrenchAxes::ALL);
            let selection =
                thruster_duties(thrusters, &self.usable_thrusters, p_BScm_B, &ask, controlled);
            missing.torque = selection.missing.torque;
            missing.force = if holds { selection.missing.force } else { Vec3::zero() };
            allocation.expected_B = self.pulse(&selection, demand, &mut allocation.command).torque;
            rest_B -= allocation.expected_B;
        }
        if self.stores_momentum() {
            let (wheels, cmgs, missing_B) =
                self.internal_torque(rest_B, demand, stored_B, readings);
            // Anti-windup: torque reported as missing is not integrated.
            let due_B = required_momentum_rate(rest_B, demand, stored_B) + missing_B;
            self.before = Some((stored_B, due_B * demand.period));
            allocation.command.wheel_torque = wheels;
            allocation.command.gimbal_rate = cmgs;
            let change_B =
                self.internal_momentum_rate(&allocation.command, demand.period, readings);
            allocation.expected_B += required_momentum_rate(change_B, demand, stored_B);
            missing.torque = self.missing_of_demand(missing_B, demand.period);
        }
        allocation.report = AllocationReport {
            wanted: demand.wanted,
            missing,
            stored_B,
            singularity: if actuators.cmgs.is_empty() {
                T::one()
            } else {
                cmg_singularity(&actuators.cmgs, &self.usable_cmgs, &readings.gimbal_angle)
            },
            desaturation: self.setup.desaturation.is_some_and(|u| u.active),
        };
        self.time = self.setup.cmgs.within_a_wave(self.time + demand.period);
        allocation
    }

    /// Whether anything can take up momentum.
    fn stores_momentum(&self) -> bool {
        let actuators = &self.setup.actuators;
        !(actuators.wheels.is_empty() && actuators.cmgs.is_empty())
    }

    /// Momentum in wheels and CMGs by the last valid reading of each, base axes (N·m·s).
    fn stored(&mut self, readings: &ActuatorReadings<T>) -> Vec3<T> {
        let last_valid = &mut self.last_valid;
        keep_finite(&mut last_valid.wheel_speed, &readings.wheel_speed);
        keep_finite(&mut last_valid.gimbal_angle, &readings.gimbal_angle);
        let actuators = &self.setup.actuators;
        actuators.cmg_momentum(&last_valid.gimbal_angle)
            + actuators.wheel_momentum(&last_valid.wheel_speed)
    }

    /// Integrate the difference between the momentum change that was commanded and the one that the
    /// readings show: friction, slow servos and motors, and stuck gimbals cause one.
    fn update_integral(&mut self, stored_B: Vec3<T>) {
        let Some((before_B, due_B)) = self.before.take() else { return };
        let momentum_error_B = self.momentum_error_B + (due_B - (stored_B - before_B));
        // The command may have been NaN: such a period is not integrated.
        if momentum_error_B.to_array().iter().all(|x| x.is_finite()) {
            self.momentum_error_B = momentum_error_B;
        }
    }

    /// Gain on the momentum error (1/s).
    fn integral_gain(period: T) -> T {
        T::from_f64(INTEGRAL_GAIN).min(T::one() / period)
    }

    /// What is missing of the present demand (N·m): the momentum error comes after that.
    fn missing_of_demand(&self, missing_B: Vec3<T>, period: T) -> Vec3<T> {
        let without_error_B = missing_B + self.momentum_error_B * Self::integral_gain(period);
        if without_error_B.dot(missing_B) <= T::zero() {
            Vec3::zero()
        } else if without_error_B.norm() < missing_B.norm() {
            without_error_B
        } else {
            missing_B
        }
    }

    /// Torque on the bodies by what turns inside them: motor torques of the wheels (N·m), gimbal rates
    /// (rad/s), and what of the torque they cannot give.
    fn internal_torque(
        &self,
        torque_B: Vec3<T>,
        demand: &Demand<T>,
        stored_B: Vec3<T>,
        readings: &ActuatorReadings<T>,
    ) -> ([T; WHEELS], [T; CMGS], Vec3<T>) {
        let setup = &self.setup;
        let Actuators { wheels, cmgs, .. } = &setup.actuators;
        let mut left_B = required_momentum_rate(torque_B, demand, stored_B)
            + self.momentum_error_B * Self::integral_gain(demand.period);
        let mut rates = [T::zero(); CMGS];
        let mut torques = [T::zero(); WHEELS];
        if !cmgs.is_empty() {
            let (usable, angles) = (&self.usable_cmgs, &readings.gimbal_angle);
            let found = cmg_rates(cmgs, usable, &setup.cmgs, left_B, angles, self.time);
            (rates, left_B) = (found.values, found.missing_B);
        }
        if !wheels.is_empty() {
            let (usable, speeds) = (&self.usable_wheels, &readings.wheel_speed);
            let (law, period) = (&setup.wheels, demand.period);
            let found = wheel_torques(wheels, usable, law, left_B, speeds, period);
            (torques, left_B) = (found.values, found.missing_B);
        }
        (torques, rates, -left_B)
    }

    /// Mean change over a period (s) of the momentum inside that a command causes, with each gimbal as
    /// its servo turns it (N·m, base axes).
    fn internal_momentum_rate(
        &self,
        command: &ActuatorCommand<T>,
        period: T,
        readings: &ActuatorReadings<T>,
    ) -> Vec3<T> {
        let Actuators { wheels, cmgs, .. } = &self.setup.actuators;
        let mut change_B = Vec3::zero();
        for (i, wheel) in wheels.iter().enumerate() {
            change_B += wheel.axis_B * command.wheel_torque[i];
        }
        for (i, cmg) in cmgs.iter().enumerate() {
            let rate = cmg.mean_rate(readings.gimbal_rate[i], command.gimbal_rate[i], period);
            if rate.is_finite() {
                let axis_B = cmg.torque_axis(self.last_valid.gimbal_angle[i]);
                change_B += axis_B * (cmg.momentum * rate);
            }
        }
        change_B
    }

    /// Torque by which the thrusters desaturate wheels and CMGs (N·m, base axes).
    fn desaturation_torque(&mut self, stored_B: Vec3<T>) -> Vec3<T> {
        match &mut self.setup.desaturation {
            None => Vec3::zero(),
            Some(desaturation) => desaturation.torque(stored_B),
        }
    }

    /// Turn shares of full force into pulses; what these give on average over the period, about the
    /// system's centre of mass.
    fn pulse(
        &mut self,
        selection: &Selection<T>,
        demand: &Demand<T>,
        command: &mut ActuatorCommand<T>,
    ) -> SpatialForce<T> {
        let mut given = SpatialForce::zero();
        let thrusters = self.setup.actuators.thrusters;
        for (i, thruster) in thrusters.iter().enumerate() {
            let modulator = &mut self.modulators[i];
            if !self.usable_thrusters[i] {
                // What it still had to give is given up: a pulse does not outlast its thruster.
                *modulator = Modulator::default();
                continue;
            }
            let shortest = thruster.minimum_on_time;
            let law = &self.setup.modulation;
            let input = law.input_for(selection.duty[i]);
            let on = modulator.on_time(law, shortest, input, demand.period);
            command.thruster_on[i] = on;
            let force = thruster.direction_B * (thruster.force * on / demand.period);
            given += SpatialForce::new((thruster.position_B - demand.p_BScm_B).cross(force), force);
        }
        given
    }
}

/// Take over what is a number.
fn keep_finite<T: Scalar>(last: &mut [T], now: &[T]) {
    for (last, &now) in last.iter_mut().zip(now).filter(|(_, now)| now.is_finite()) {
        *last = now;
    }
}

/// Change of the momentum inside by which the bodies feel a torque (N·m, base axes). They feel
/// `-ḣ - w × h` of the momentum h inside, so it is `ḣ = -τ - w × h`.
fn required_momentum_rate<T: Scalar>(
    torque_B: Vec3<T>,
    demand: &Demand<T>,
    stored_B: Vec3<T>,
) -> Vec3<T> {
    -torque_B - demand.w_NB_B.cross(stored_B)
}
