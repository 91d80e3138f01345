//! What drives the joints and turns the base in a control period, within its limits.

use crate::effectors::PeriodCommand;
use crate::scene::{Scene, SystemId};
use crate::setup::{BaseAttitude, Drive};
use crate::system::System;
use wrasse_hardware::{ActuatorCommand, AttitudeActuatorLimit};
use wrasse_spatial::Vec3;

/// A limit that cut a command.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Saturation {
    /// The drive of this joint.
    JointEffort(usize),
    /// The actuator's torque about this base axis (0, 1, 2).
    ActuatorTorque(usize),
    /// The actuator's stored momentum about this base axis.
    ActuatorMomentum(usize),
    /// The torque of this wheel's motor.
    WheelTorque(usize),
    /// The speed of this wheel.
    WheelSpeed(usize),
    /// The rate of this gimbal.
    GimbalRate(usize),
    /// The motor of this gimbal: it cannot turn the gimbal as it should beside what the turning base
    /// asks of it, as the period begins.
    GimbalMotor(usize),
    /// This thruster was told to open for less than it can: it stayed shut, or, open already, stays
    /// so for its shortest time.
    PulseTooShort(usize),
    /// Thrusters were told to open, and there is nothing to feed them.
    TankEmpty,
}

impl<const J: usize> Scene<J> {
    /// A control period begins: set-points, pulses and applied wrenches count from here. A system that
    /// was commanded once is commanded anew in each period.
    pub fn begin_period(&mut self) {
        let clock = &mut self.clock;
        clock.gone = clock.into_period;
        (clock.period_start, clock.into_period) = (clock.time, 0.0);
    }

    /// Set what drives the joints of a system and turns its base for the period of `period` (s) that has
    /// begun, each within its limits. What the limits cut is put into `cut` in place of what is there:
    /// no heap is touched once it is large enough.
    ///
    /// # Panics
    /// If the system is part of another now.
    pub fn command(
        &mut self,
        id: SystemId,
        (drives, torque_B): (&[Drive], Vec3<f64>),
        actuators: &ActuatorCommand<f64>,
        period: f64,
        cut: &mut Vec<Saturation>,
    ) {
        cut.clear();
        let gone = self.clock.gone;
        let w_NB_B = self.state(id).V_NB_B.angular;
        let system = self.system_mut(id);
        system.command_joints(drives, cut);
        system.actuator_torque_B = match system.base {
            BaseAttitude::Controlled => system.within_limits(torque_B, w_NB_B, period, cut),
            BaseAttitude::Held | BaseAttitude::Free => Vec3::zero(),
        };
        // On a base that is held they do not act, whatever they are told.
        if system.base != BaseAttitude::Held {
            let is_fed = system.is_fed();
            system
                .command_effectors(&PeriodCommand { actuators, w_NB_B, gone, period, is_fed }, cut);
        }
    }
}

impl<const J: usize> System<J> {
    fn command_joints(&mut self, drives: &[Drive], cut: &mut Vec<Saturation>) {
        // Nothing drives the propellant.
        for (j, drive) in drives.iter().enumerate().take(self.dry.joint_count()) {
            self.drives[j] = match (*drive, self.limits[j].effort) {
                (Drive::Effort(tau), Some(limit)) if tau.abs() > limit => {
                    cut.push(Saturation::JointEffort(j));
                    Drive::Effort(tau.clamp(-limit, limit))
                }
                (drive, _) => drive,
            };
        }
        // A follower has no drive.
        for follower in &self.followers {
            self.drives[follower.joint] = Drive::Effort(0.0);
        }
    }

    fn command_effectors(&mut self, told: &PeriodCommand<'_>, cut: &mut Vec<Saturation>) {
        for (i, effector) in self.effectors.iter_mut().enumerate() {
            effector.command(told, &self.row[self.variables.effector(i)], cut);
        }
    }

    /// Whether there is propellant for its thrusters; without a tank they never run dry.
    fn is_fed(&mut self) -> bool {
        let mut tanks = self.effectors.iter_mut().filter_map(|e| e.tank());
        tanks.next().is_none_or(|tank| tank.mass > 0.0)
    }

    /// The torque that the ideal actuator gives: within its torque, and within what it can store.
    fn within_limits(
        &self,
        wanted_B: Vec3<f64>,
        w_NB_B: Vec3<f64>,
        period: f64,
        cut: &mut Vec<Saturation>,
    ) -> Vec3<f64> {
        let Some(limits) = self.actuator else { return wanted_B };
        let h_B = self.actuator_momentum_B();
        limits.given(wanted_B, (h_B, w_NB_B.cross(h_B)), period, |limit, axis| {
            cut.push(match limit {
                AttitudeActuatorLimit::Torque => Saturation::ActuatorTorque(axis),
                AttitudeActuatorLimit::Momentum => Saturation::ActuatorMomentum(axis),
            });
        })
    }
}
