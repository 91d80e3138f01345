//! What drives the joints and turns the base in a control period, within its limits.

use crate::setup::{BaseAttitude, Drive};
use crate::world::World;
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

impl<const J: usize> World<J> {
    /// Set what drives the joints and turns the base for the coming period of `period` (s), each
    /// within its limits; what the limits cut is returned.
    pub fn command(
        &mut self,
        drives: &[Drive],
        torque_B: Vec3<f64>,
        actuators: &ActuatorCommand<f64>,
        period: f64,
    ) -> Vec<Saturation> {
        let mut cut = Vec::new();
        self.command_noting(drives, torque_B, actuators, period, &mut cut);
        cut
    }

    /// The same, and what the limits cut is put into `cut` in place of what is there: no heap is touched
    /// once it is large enough.
    pub fn command_noting(
        &mut self,
        drives: &[Drive],
        torque_B: Vec3<f64>,
        actuators: &ActuatorCommand<f64>,
        period: f64,
        cut: &mut Vec<Saturation>,
    ) {
        cut.clear();
        let gone = self.into_period;
        (self.period_start, self.into_period) = (self.time, 0.0);
        for (j, drive) in drives.iter().enumerate().take(J) {
            self.drives[j] = match (*drive, self.limits[j].effort) {
                (Drive::Effort(tau), Some(limit)) if tau.abs() > limit => {
                    cut.push(Saturation::JointEffort(j));
                    Drive::Effort(tau.clamp(-limit, limit))
                }
                (drive, _) => drive,
            };
        }
        self.actuator_torque_B = Vec3::zero();
        if self.base == BaseAttitude::Controlled {
            self.actuator_torque_B = self.within_actuator_limits(torque_B, period, cut);
        }
        self.command_equipment(actuators, (gone, period), cut);
    }

    /// Set wheels, CMGs and thrusters for a period (s), `gone` (s) after the last began. On a base that
    /// is held they do not act, whatever they are told.
    fn command_equipment(
        &mut self,
        told: &ActuatorCommand<f64>,
        (gone, period): (f64, f64),
        cut: &mut Vec<Saturation>,
    ) {
        if self.base == BaseAttitude::Held {
            return;
        }
        if !(self.wheels.is_empty() && self.cmgs.count() == 0) {
            let w_NB_B = self.state().V_NB_B.angular;
            let s = &self.system;
            let speed = self.wheels.speeds(&s.wheel_momentum, w_NB_B);
            self.wheels.command(&told.wheel_torque, &speed, period, cut);
            let (angle, rate) = (&s.gimbal_angle, &s.gimbal_rate);
            self.cmgs.command(&told.gimbal_rate, angle, rate, w_NB_B, cut);
        }
        let is_fed = self.tank.is_none_or(|tank| tank.mass > 0.0);
        self.thrusters.command(&told.thruster_on, (gone, period), is_fed, cut);
    }

    /// The torque that the ideal actuator gives: within its torque, and within what it can store.
    fn within_actuator_limits(
        &self,
        wanted_B: Vec3<f64>,
        period: f64,
        cut: &mut Vec<Saturation>,
    ) -> Vec3<f64> {
        let Some(limits) = self.actuator else { return wanted_B };
        let h_B = self.stored_momentum_B();
        let h = (h_B, self.state().V_NB_B.angular.cross(h_B));
        limits.given(wanted_B, h, period, |limit, axis| {
            cut.push(match limit {
                AttitudeActuatorLimit::Torque => Saturation::ActuatorTorque(axis),
                AttitudeActuatorLimit::Momentum => Saturation::ActuatorMomentum(axis),
            });
        })
    }
}
