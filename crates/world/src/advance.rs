//! The way through time: steps, sums with care, and what is no longer a number.

use crate::flow::Flow;
use crate::free_flight::{add_vector, add_with_care};
use crate::stepper::{Judged, Stepper, dormand_prince, equal_steps, runge_kutta_4};
use crate::world::World;
use wrasse_hardware::{CMGS, WHEELS};
use wrasse_spatial::Vec3;

/// A number that is no longer finite.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{quantity} is no longer finite at t = {time} s")]
pub struct NonFinite {
    /// What.
    pub quantity: String,
    /// The joint that it belongs to, if it belongs to one.
    pub joint: Option<usize>,
    /// When (s).
    pub time: f64,
}

impl<const J: usize> World<J> {
    /// Advance by `period` (s): the period that the commands were set for, at once or in parts. No heap
    /// is touched.
    ///
    /// # Errors
    /// If a number is no longer finite.
    pub fn advance(&mut self, period: f64) -> Result<(), NonFinite> {
        let (mut propellant, mut from, mut bend) = (0.0, 0.0, f64::NEG_INFINITY);
        // In stretches in which nothing bends: steps that do not reach over a bend keep their order.
        loop {
            let next = self.next_bend(bend, period);
            let to = next.map_or(period, |bend| bend - self.into_period);
            self.stretch_middle = self.into_period + 0.5 * (from + to);
            match self.stepper {
                Stepper::Fixed { step } => self.advance_evenly(from, to, step)?,
                Stepper::Adaptive { tolerance } => self.advance_adaptively(from, to, tolerance)?,
            }
            let (begins, ends) = (self.into_period + from, self.into_period + to);
            propellant += self.thrusters.propellant(begins, ends);
            let Some(passed) = next else { break };
            (from, bend) = (to, passed);
        }
        self.into_period += period;
        add_with_care(&mut self.time, period, &mut self.time_carry);
        for body in &mut self.free {
            body.advance(period, self.stepper);
        }
        self.let_go_of_propellant(propellant);
        self.check_free_bodies()
    }

    /// The first instant behind `after` in the coming `period` (s) at which a thruster's force or an
    /// outside wrench bends (s into the set-points).
    fn next_bend(&self, after: f64, period: f64) -> Option<f64> {
        let now = self.into_period;
        // A bend at an end of the period, but for the rounding of sums of periods, is no bend in it.
        let near = 1e-9 * period;
        let outside = self.outside_bends.iter().map(|bend| bend - self.period_start);
        let outside = outside.filter(|t| *t > now + near && *t < now + period - near);
        let all = self.thrusters.bends(now, now + period).chain(outside);
        all.filter(|t| *t - after >= near).min_by(f64::total_cmp)
    }

    fn advance_evenly(&mut self, from: f64, to: f64, step: f64) -> Result<(), NonFinite> {
        let (count, h) = equal_steps(to - from, step);
        let (mut done, mut places) = (0.0, self.places.take().unwrap_or_default());
        while done < count {
            let t0 = self.into_period + (from + done * h);
            let d = runge_kutta_4(h, |t, d| self.rates(&mut places, t0, t, d));
            done += 1.0;
            // The last step ends where the stretch does, to the bit.
            let gone = if done < count { from + done * h } else { to };
            self.accept(&d, self.into_period + gone)?;
        }
        self.places.set(Some(places));
        Ok(())
    }

    fn advance_adaptively(&mut self, from: f64, to: f64, tolerance: f64) -> Result<(), NonFinite> {
        let mut t0 = self.into_period + from;
        let end = self.into_period + to;
        let mut h = self.last_step.min(to - from);
        let mut places = self.places.take().unwrap_or_default();
        while t0 < end {
            let rest = end - t0;
            let last = h >= rest * (1.0 - 1e-12);
            let trial = if last { rest } else { h };
            let (d, error) = dormand_prince(trial, |t, d| self.rates(&mut places, t0, t, d));
            let size = error.error_norm(tolerance).max(1e-10);
            // Order 5 in the step asks for the fifth root. The fourth finds the step as well, and
            // square roots are the same bits on every machine.
            let factor = (0.9 / size.sqrt().sqrt()).clamp(0.2, 5.0);
            if size <= 1.0 || !size.is_finite() {
                t0 = if last { end } else { t0 + trial };
                self.accept(&d, t0)?;
                if !last || factor < 1.0 {
                    self.last_step = trial * factor;
                }
                h = if last { h } else { trial * factor };
            } else {
                h = trial * factor;
            }
        }
        self.places.set(Some(places));
        Ok(())
    }

    /// Add a displacement to the state, giving back what earlier sums lost; `t` (s) is where the
    /// set-points are then.
    fn accept(&mut self, d: &Flow<J>, t: f64) -> Result<(), NonFinite> {
        let (mut s, mut carry, mut b) = (self.system, self.carry, self.booked);
        self.vehicle().move_on((&mut s, &mut carry, &mut b), d, t);
        let (add, add3) = (add_with_care, add_vector);
        for i in 0..WHEELS {
            add(&mut s.wheel_momentum[i], d.wheel_momentum[i], &mut carry.wheel_momentum[i]);
        }
        for i in 0..CMGS {
            add(&mut s.gimbal_angle[i], d.gimbal_angle[i], &mut carry.gimbal_angle[i]);
            add(&mut s.gimbal_rate[i], d.gimbal_rate[i], &mut carry.gimbal_rate[i]);
        }
        add3(&mut b.outside_impulse, d.outside_impulse, &mut carry.outside_impulse);
        add3(&mut b.from_outside, d.from_outside, &mut carry.from_outside);
        add3(&mut b.from_thrusters, d.from_thrusters, &mut carry.from_thrusters);
        add3(&mut b.thruster_impulse, d.thruster_impulse, &mut carry.thruster_impulse);
        (self.system, self.carry, self.booked) = (s, carry, b);
        self.check_finite(t)
    }

    fn check_finite(&self, t: f64) -> Result<(), NonFinite> {
        let time = self.period_start + t;
        let fail = |quantity: String, joint| Err(NonFinite { quantity, joint, time });
        let s = &self.system;
        for j in self.robot.joints() {
            if !(s.q[j].is_finite() && s.v[j].is_finite()) {
                return fail(format!("position or rate of joint {j}"), Some(j));
            }
        }
        for (name, v) in [
            ("attitude of the base", s.quat_NB.vector()),
            ("centre of mass", s.p_NScm_N),
            ("linear momentum", s.linear),
            ("angular momentum", s.angular),
        ] {
            if !is_finite(v) {
                return fail(name.into(), None);
            }
        }
        for (name, numbers) in [
            ("momentum of wheel", &s.wheel_momentum[..]),
            ("angle of gimbal", &s.gimbal_angle),
            ("rate of gimbal", &s.gimbal_rate),
        ] {
            if let Some(i) = numbers.iter().position(|x| !x.is_finite()) {
                return fail(format!("{name} {i}"), None);
            }
        }
        Ok(())
    }

    fn check_free_bodies(&self) -> Result<(), NonFinite> {
        for (i, body) in self.free.iter().enumerate() {
            for (name, v) in
                [("attitude", body.quat_NT.vector()), ("centre of mass", body.p_NTcm_N)]
            {
                if !is_finite(v) {
                    let quantity = format!("{name} of free body {i}");
                    return Err(NonFinite { quantity, joint: None, time: self.time });
                }
            }
        }
        Ok(())
    }
}

fn is_finite(v: Vec3<f64>) -> bool {
    v.to_array().iter().all(|x| x.is_finite())
}
