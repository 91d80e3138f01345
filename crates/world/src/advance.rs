//! The way through time: stretches between breakpoints, steps, compensated sums, and what is no longer a
//! number.

use crate::integrate::{Stepper, add_compensated, equal_steps};
use crate::scene::Scene;

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

impl<const J: usize> Scene<J> {
    /// Advance by `period` (s): the period that the commands were set for, at once or in parts. No heap
    /// is touched, but as places of a contact begin to touch, and once in each period while they do.
    ///
    /// # Errors
    /// If a number is no longer finite.
    pub fn advance(&mut self, period: f64) -> Result<(), NonFinite> {
        let (mut from, mut passed) = (0.0, f64::NEG_INFINITY);
        // In stretches in which nothing breaks: steps that do not reach over a breakpoint keep their
        // order.
        loop {
            let next = self.next_breakpoint(passed, period);
            let to = next.map_or(period, |at| at - self.clock.into_period);
            self.clock.within = self.clock.into_period + 0.5 * (from + to);
            match self.stepper {
                _ if self.has_contacts() => self.advance_with_contacts((from, to))?,
                Stepper::Fixed { step } => self.advance_evenly((from, to), step)?,
                Stepper::Adaptive { tolerance } => {
                    self.advance_adaptively((from, to), tolerance)?;
                }
            }
            self.burn(self.clock.into_period + from, self.clock.into_period + to);
            let Some(breakpoint) = next else { break };
            (from, passed) = (to, breakpoint);
        }
        self.clock.into_period += period;
        add_compensated(&mut self.clock.time, period, &mut self.clock.carry);
        self.expel_propellant();
        Ok(())
    }

    /// The first instant behind `after` in the coming `period` (s) at which what an effector does is not
    /// smooth (s into the set-points).
    fn next_breakpoint(&self, after: f64, period: f64) -> Option<f64> {
        let (now, near) = (self.clock.into_period, 1e-9 * period);
        let (between, mut first) = ((now, now + period), None);
        let effectors = self.systems.iter().flatten().flat_map(|s| &s.effectors);
        for effector in effectors {
            effector.breakpoints(self.clock.period_start, between, &mut |t| {
                if t - after >= near && first.is_none_or(|first| t < first) {
                    first = Some(t);
                }
            });
        }
        first
    }

    fn advance_evenly(&mut self, (mut from, to): (f64, f64), step: f64) -> Result<(), NonFinite> {
        let into_period = self.clock.into_period;
        // An event ends a step before its time: what is left is divided anew.
        'restart: loop {
            let (count, h) = equal_steps(to - from, step);
            let mut done = 0.0;
            while done < count {
                let t0 = into_period + (from + done * h);
                self.recentre_slosh();
                if self.has_events() {
                    self.note_before_step(t0);
                }
                self.step_evenly(t0, h)?;
                done += 1.0;
                if self.has_events() {
                    let gone = self.stop_at_events((t0, h), Self::step_evenly)?;
                    if gone < h {
                        from = t0 + gone - into_period;
                        continue 'restart;
                    }
                }
            }
            // The last step ends where the stretch does, to the bit.
            self.follow_set_points_at(into_period + to);
            return Ok(());
        }
    }

    /// One step of fixed length from where the scene stands.
    pub(crate) fn step_evenly(&mut self, t0: f64, h: f64) -> Result<(), NonFinite> {
        let (mut method, clock) = (std::mem::take(&mut self.runge_kutta), self.clock);
        let mut places = self.places.take().unwrap_or_default();
        let d = method.step(h, |t, d, rates| self.rates(&mut places, (&clock, t0 + t), d, rates));
        self.places.set(Some(places));
        let accepted = self.accept(d, t0 + h);
        self.runge_kutta = method;
        accepted
    }

    fn advance_adaptively(
        &mut self,
        (from, to): (f64, f64),
        tolerance: f64,
    ) -> Result<(), NonFinite> {
        let into_period = self.clock.into_period;
        let (mut t0, end) = (into_period + from, into_period + to);
        let mut h = self.last_step.min(to - from);
        while t0 < end {
            self.recentre_slosh();
            let rest = end - t0;
            let last = h >= rest * (1.0 - 1e-12);
            let trial = if last { rest } else { h };
            let size = (self.try_step(t0, trial) / tolerance).max(1e-10);
            // Order 5 in the step asks for the fifth root. The fourth finds the step as well, and
            // square roots are the same bits on every machine.
            let factor = (0.9 / size.sqrt().sqrt()).clamp(0.2, 5.0);
            if size <= 1.0 || !size.is_finite() {
                if self.has_events() {
                    self.note_before_step(t0);
                }
                let ends = if last { end } else { t0 + trial };
                self.accept_tried(ends)?;
                let mut gone = trial;
                if self.has_events() {
                    gone = self.stop_at_events((t0, trial), |scene, t0, h| {
                        scene.try_step(t0, h);
                        scene.accept_tried(t0 + h)
                    })?;
                }
                t0 = if gone < trial { t0 + gone } else { ends };
                if !last || factor < 1.0 {
                    self.last_step = trial * factor;
                }
                h = if last { h } else { trial * factor };
            } else {
                h = trial * factor;
            }
        }
        Ok(())
    }

    /// Try a step from where the scene stands; its estimated error.
    pub(crate) fn try_step(&mut self, t0: f64, h: f64) -> f64 {
        let (mut method, clock) = (std::mem::take(&mut self.dormand_prince), self.clock);
        let mut places = self.places.take().unwrap_or_default();
        method.step(h, |t, d, rates| self.rates(&mut places, (&clock, t0 + t), d, rates));
        self.places.set(Some(places));
        let error = method.largest_error();
        self.dormand_prince = method;
        error
    }

    /// Accept the step that was tried last; it ends at `t` (s) into the set-points.
    pub(crate) fn accept_tried(&mut self, t: f64) -> Result<(), NonFinite> {
        let method = std::mem::take(&mut self.dormand_prince);
        let accepted = self.accept(method.displacement(), t);
        self.dormand_prince = method;
        accepted
    }

    /// Joints that follow set-points are where these are at `t` (s), to the bit.
    pub(crate) fn follow_set_points_at(&mut self, t: f64) {
        for system in self.systems.iter_mut().flatten() {
            system.follow_set_points(t);
        }
    }

    /// Add a displacement to all systems and to the bookings; `t` (s) is where the set-points are then.
    fn accept(&mut self, d: &[f64], t: f64) -> Result<(), NonFinite> {
        let mut at = 0;
        for system in self.systems.iter_mut().flatten() {
            let length = system.variables.len();
            system.accept(&d[at..at + length], t);
            at += length;
        }
        for coupled in self.couplings.iter_mut().flatten() {
            let length = coupled.row.len();
            coupled.accept(&d[at..at + length]);
            at += length;
        }
        let booked = self.booked.iter_mut().zip(&d[at..]).zip(&mut self.booked_carry);
        booked.for_each(|((x, d), carry)| add_compensated(x, *d, carry));
        self.check_finite(t)
    }

    fn check_finite(&self, t: f64) -> Result<(), NonFinite> {
        let several = self.systems.iter().flatten().nth(1).is_some();
        for (i, system) in self.systems.iter().enumerate() {
            let Some(system) = system else { continue };
            let attitude = system.quat_NB.vector().to_array();
            let turned = attitude.iter().all(|x| x.is_finite());
            let joints = system.variables.joints().filter(|at| !system.row[*at].is_finite());
            let rest = system.row.iter().position(|x| !x.is_finite());
            let Some(place) = joints.min().or((!turned).then_some(0)).or(rest) else { continue };
            let (name, joint) = system.variables.name(place);
            let quantity = if several { format!("{name} of system {i}") } else { name.to_owned() };
            return Err(NonFinite { quantity, joint, time: self.clock.period_start + t });
        }
        Ok(())
    }
}
