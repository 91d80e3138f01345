//! All groups together: who takes which part of the wanted torque and force.

use crate::steering::{
    CmgLaw, Modulation, Modulator, Selection, Unloading, WheelLaw, WrenchAxes, cmg_rates,
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

/// How the actuators are steered.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SteeringSetup<T> {
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
    /// When the thrusters empty wheels and CMGs; `None`: never.
    pub unloading: Option<Unloading<T>>,
}

/// What is needed over the coming period.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Needs<T> {
    /// Torque (N·m) and force (N) on the bodies, about the system's centre of mass, base axes.
    pub wanted: SpatialForce<T>,
    /// Rate of the base, base axes (rad/s).
    pub w_NB_B: Vec3<T>,
    /// Centre of mass of the system, base frame (m).
    pub p_BScm_B: Vec3<T>,
    /// Control period (s).
    pub period: T,
}

/// What the steering could do of what was wanted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SteeringReport<T> {
    /// What was wanted of the actuators, base axes (N·m, N).
    pub wanted: SpatialForce<T>,
    /// What of it no actuator could give (N·m, N).
    pub missing: SpatialForce<T>,
    /// Momentum in wheels and CMGs, by their readings, base axes (N·m·s).
    pub stored_B: Vec3<T>,
    /// Distance of the CMGs from a singular setting, det(A Aᵀ) for unit momenta (–); one without
    /// CMGs.
    pub singularity: T,
    /// Whether the thrusters are emptying wheels and CMGs.
    pub unloading: bool,
}

/// What the actuators are told, and what that leaves open.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Steered<T> {
    /// What the actuators are told.
    pub command: ActuatorCommand<T>,
    /// What was wanted and what is missing.
    pub report: SteeringReport<T>,
    /// Torque that the bodies will feel on average over the period, with the servos as slow as they
    /// are, base axes (N·m).
    pub expected_B: Vec3<T>,
}

impl<T: Scalar> Steered<T> {
    /// Nothing is asked and nothing is told.
    pub fn nothing() -> Self {
        let none = SpatialForce::zero();
        Self {
            command: ActuatorCommand::default(),
            report: SteeringReport {
                wanted: none,
                missing: none,
                stored_B: Vec3::zero(),
                singularity: T::one(),
                unloading: false,
            },
            expected_B: Vec3::zero(),
        }
    }
}

/// Steering, with what it remembers from period to period.
#[derive(Debug, Clone, Copy)]
pub struct Steering<T> {
    setup: SteeringSetup<T>,
    usable_wheels: [bool; WHEELS],
    usable_cmgs: [bool; CMGS],
    usable_thrusters: [bool; THRUSTERS],
    modulators: [Modulator<T>; THRUSTERS],
    /// Clock of the waves by which some laws shake the gimbals (s).
    time: T,
    /// What wheels and CMGs stored when they were last read (N·m·s), and the change that was
    /// due over the period (N·m·s), base axes.
    before: Option<(Vec3<T>, Vec3<T>)>,
    /// What they were asked for and have not yet given (N·m·s).
    owed_B: Vec3<T>,
    /// Speeds and angles as they were last heard: a unit that says no number may be heard again.
    heard: ActuatorReadings<T>,
}

/// How fast wheels and CMGs are asked for what they owe (1/s): slower than their servos answer. In
/// periods that are longer than this takes: all of it in one, for more would come back larger.
const CATCH_UP: f64 = 10.0;

impl<T: Scalar> Steering<T> {
    /// Steering that has all units.
    pub fn new(setup: &SteeringSetup<T>) -> Self {
        Self {
            setup: *setup,
            usable_wheels: [true; WHEELS],
            usable_cmgs: [true; CMGS],
            usable_thrusters: [true; THRUSTERS],
            modulators: [Modulator::default(); THRUSTERS],
            time: T::zero(),
            before: None,
            owed_B: Vec3::zero(),
            heard: ActuatorReadings::default(),
        }
    }

    /// Nothing is steered until the next call: what happens meanwhile is owed by nobody, and no pulse
    /// goes on.
    pub fn rest(&mut self) {
        self.before = None;
        self.owed_B = Vec3::zero();
        self.modulators = [Modulator::default(); THRUSTERS];
    }

    /// Nothing feeds the thrusters any more: no pulse goes on, and nothing is emptied.
    fn run_dry(&mut self) {
        self.modulators = [Modulator::default(); THRUSTERS];
        if let Some(unloading) = &mut self.setup.unloading {
            unloading.active = false;
        }
    }

    /// Do without a unit from now on.
    pub fn isolate(&mut self, unit: Unit) {
        let (flags, i): (&mut [bool], usize) = match unit {
            Unit::Wheel(i) => (&mut self.usable_wheels, i),
            Unit::Cmg(i) => (&mut self.usable_cmgs, i),
            Unit::Thruster(i) => (&mut self.usable_thrusters, i),
        };
        if let Some(usable) = flags.get_mut(i) {
            *usable = false;
        }
    }

    /// What the actuators are told for the coming period.
    ///
    /// CMGs come first, then wheels. Thrusters give the force, what of the torque those cannot give,
    /// and what empties them. They are pulsed: what they will really give over the period is taken off
    /// before CMGs and wheels are told, so these smooth the pulses.
    ///
    /// A unit whose reading is no number is told nothing; its momentum counts as it was last heard.
    pub fn steer(&mut self, needs: &Needs<T>, readings: &ActuatorReadings<T>) -> Steered<T> {
        let actuators = self.setup.actuators;
        let mut steered = Steered::nothing();
        let stored_B = self.stored(readings);
        self.settle(stored_B);
        let mut missing = needs.wanted;
        let mut rest_B = needs.wanted.torque;
        let dry = actuators.tank.is_some() && readings.propellant <= T::zero();
        if dry {
            self.run_dry();
        } else if !actuators.thrusters.is_empty() {
            let mut ask = needs.wanted;
            if self.stores_momentum() {
                // No more than what turns inside can hold against: the bodies should not feel it.
                let emptying_B = self.unloading_torque(stored_B);
                let (_, _, missing_B) = self.inside(rest_B - emptying_B, needs, stored_B, readings);
                ask.torque = emptying_B + missing_B;
            }
            let (p_BScm_B, thrusters) = (needs.p_BScm_B, &actuators.thrusters);
            // Couples, as far as there are any, even where nobody asks for force: a base that is
            // pushed away takes the arm with it.
            let (holds, controlled) = (self.setup.holds_position, WrenchAxes::ALL);
            let selection =
                thruster_duties(thrusters, &self.usable_thrusters, p_BScm_B, &ask, controlled);
            missing.torque = selection.missing.torque;
            missing.force = if holds { selection.missing.force } else { Vec3::zero() };
            steered.expected_B = self.pulse(&selection, needs, &mut steered.command).torque;
            rest_B -= steered.expected_B;
        }
        if self.stores_momentum() {
            let (wheels, cmgs, missing_B) = self.inside(rest_B, needs, stored_B, readings);
            // What is missing is not owed: it was told.
            let due_B = due(rest_B, needs, stored_B) + missing_B;
            self.before = Some((stored_B, due_B * needs.period));
            steered.command.wheel_torque = wheels;
            steered.command.gimbal_rate = cmgs;
            let change_B = self.change_inside(&steered.command, needs.period, readings);
            steered.expected_B += due(change_B, needs, stored_B);
            missing.torque = self.of_what_is_wanted(missing_B, needs.period);
        }
        steered.report = SteeringReport {
            wanted: needs.wanted,
            missing,
            stored_B,
            singularity: if actuators.cmgs.is_empty() {
                T::one()
            } else {
                cmg_singularity(&actuators.cmgs, &self.usable_cmgs, &readings.gimbal_angle)
            },
            unloading: self.setup.unloading.is_some_and(|u| u.active),
        };
        self.time = self.setup.cmgs.within_a_wave(self.time + needs.period);
        steered
    }

    /// Whether anything can take up momentum.
    fn stores_momentum(&self) -> bool {
        let actuators = &self.setup.actuators;
        !(actuators.wheels.is_empty() && actuators.cmgs.is_empty())
    }

    /// Momentum in wheels and CMGs by what was last heard of each, base axes (N·m·s).
    fn stored(&mut self, readings: &ActuatorReadings<T>) -> Vec3<T> {
        let heard = &mut self.heard;
        keep_numbers(&mut heard.wheel_speed, &readings.wheel_speed);
        keep_numbers(&mut heard.gimbal_angle, &readings.gimbal_angle);
        let actuators = &self.setup.actuators;
        actuators.cmg_momentum(&heard.gimbal_angle) + actuators.wheel_momentum(&heard.wheel_speed)
    }

    /// Book what wheels and CMGs gave of what they were last asked for: friction, servos and motors
    /// that are slower than the period, a gimbal that is stuck all leave something owing.
    fn settle(&mut self, stored_B: Vec3<T>) {
        let Some((before_B, due_B)) = self.before.take() else { return };
        let owed_B = self.owed_B + (due_B - (stored_B - before_B));
        // What was asked for may have been no number: such a period is not booked.
        if owed_B.to_array().iter().all(|x| x.is_finite()) {
            self.owed_B = owed_B;
        }
    }

    /// How fast what is owed is asked for (1/s).
    fn catch_up(period: T) -> T {
        T::from_f64(CATCH_UP).min(T::one() / period)
    }

    /// What is missing of what is wanted now (N·m): what is owed comes after that.
    fn of_what_is_wanted(&self, missing_B: Vec3<T>, period: T) -> Vec3<T> {
        let without_debt_B = missing_B + self.owed_B * Self::catch_up(period);
        if without_debt_B.dot(missing_B) <= T::zero() {
            Vec3::zero()
        } else if without_debt_B.norm() < missing_B.norm() {
            without_debt_B
        } else {
            missing_B
        }
    }

    /// Torque on the bodies by what turns inside them: motor torques of the wheels (N·m), gimbal rates
    /// (rad/s), and what of the torque they cannot give.
    fn inside(
        &self,
        torque_B: Vec3<T>,
        needs: &Needs<T>,
        stored_B: Vec3<T>,
        readings: &ActuatorReadings<T>,
    ) -> ([T; WHEELS], [T; CMGS], Vec3<T>) {
        let setup = &self.setup;
        let Actuators { wheels, cmgs, .. } = &setup.actuators;
        let mut left_B =
            due(torque_B, needs, stored_B) + self.owed_B * Self::catch_up(needs.period);
        let mut rates = [T::zero(); CMGS];
        let mut torques = [T::zero(); WHEELS];
        if !cmgs.is_empty() {
            let (usable, angles) = (&self.usable_cmgs, &readings.gimbal_angle);
            let found = cmg_rates(cmgs, usable, &setup.cmgs, left_B, angles, self.time);
            (rates, left_B) = (found.values, found.missing_B);
        }
        if !wheels.is_empty() {
            let (usable, speeds) = (&self.usable_wheels, &readings.wheel_speed);
            let (law, period) = (&setup.wheels, needs.period);
            let found = wheel_torques(wheels, usable, law, left_B, speeds, period);
            (torques, left_B) = (found.values, found.missing_B);
        }
        (torques, rates, -left_B)
    }

    /// Mean change over a period (s) of the momentum inside that a command causes, with each gimbal as
    /// its servo turns it (N·m, base axes).
    fn change_inside(
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
                let axis_B = cmg.torque_axis(self.heard.gimbal_angle[i]);
                change_B += axis_B * (cmg.momentum * rate);
            }
        }
        change_B
    }

    /// Torque by which the thrusters empty what is stored (N·m, base axes).
    fn unloading_torque(&mut self, stored_B: Vec3<T>) -> Vec3<T> {
        match &mut self.setup.unloading {
            None => Vec3::zero(),
            Some(unloading) => unloading.torque(stored_B),
        }
    }

    /// Turn shares of full force into pulses; what these give on average over the period, about the
    /// system's centre of mass.
    fn pulse(
        &mut self,
        selection: &Selection<T>,
        needs: &Needs<T>,
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
            let on = modulator.on_time(law, shortest, input, needs.period);
            command.thruster_on[i] = on;
            let force = thruster.direction_B * (thruster.force * on / needs.period);
            given += SpatialForce::new((thruster.position_B - needs.p_BScm_B).cross(force), force);
        }
        given
    }
}

/// Take over what is a number.
fn keep_numbers<T: Scalar>(last: &mut [T], now: &[T]) {
    for (last, &now) in last.iter_mut().zip(now).filter(|(_, now)| now.is_finite()) {
        *last = now;
    }
}

/// Change of the momentum inside by which the bodies feel a torque (N·m, base axes). They feel
/// `-ḣ - w × h` of the momentum h inside, so it is `ḣ = -τ - w × h`.
fn due<T: Scalar>(torque_B: Vec3<T>, needs: &Needs<T>, stored_B: Vec3<T>) -> Vec3<T> {
    -torque_B - needs.w_NB_B.cross(stored_B)
}
