//! Steps of a scene with contacts: as long as the integrator's where nothing is near, shorter where
//! something touches or is about to.

use crate::advance::NonFinite;
use crate::integrate::{Stepper, equal_steps};
use crate::scene::Scene;

/// How far a step may reach beyond the expected touch (–): then the touch is within it.
const BEYOND: f64 = 1.25;

impl<const J: usize> Scene<J> {
    /// Advance over a stretch in which nothing else breaks.
    pub(crate) fn advance_with_contacts(
        &mut self,
        (from, to): (f64, f64),
    ) -> Result<(), NonFinite> {
        let into_period = self.clock.into_period;
        let (mut t, end) = (into_period + from, into_period + to);
        self.look_at_contacts(t);
        self.touch_at_start(t);
        while t < end {
            self.recentre_slosh();
            let rest = end - t;
            let h = self.coming_step(t, rest);
            let last = h >= rest * (1.0 - 1e-12);
            let h = if last { rest } else { h };
            self.keep_contacts();
            self.note_before_step(t);
            let gone = self.step_to_contact(t, h)?;
            t = if last && gone >= h { end } else { t + gone };
        }
        self.follow_set_points_at(end);
        Ok(())
    }

    /// One step of at most `h` (s), up to the first touch, parting or other event; how long it was.
    fn step_to_contact(&mut self, t: f64, h: f64) -> Result<f64, NonFinite> {
        let step: &dyn Fn(&mut Self, f64, f64) -> Result<(), NonFinite> = &Self::step_once;
        let h = self.step_as_far_as_it_is_good(t, h)?;
        self.look_at_contacts(t + h);
        let (mut gone, mut switches) = self.stop_at_contacts((t, h), step)?;
        if self.has_events() {
            let until = self.stop_at_events((t, gone), Self::step_once)?;
            if until < gone {
                (gone, switches) = (until, false);
                self.look_at_contacts(t + gone);
            }
        }
        self.note_contacts(t + gone, gone);
        if switches {
            self.switch_contacts(t + gone);
        }
        Ok(gone)
    }

    /// A step of the scene's integrator, accepted whatever its error.
    fn step_once(&mut self, t: f64, h: f64) -> Result<(), NonFinite> {
        match self.stepper {
            Stepper::Fixed { .. } => self.step_evenly(t, h),
            Stepper::Adaptive { .. } => {
                self.try_step(t, h);
                self.accept_tried(t + h)
            }
        }
    }

    /// A step of `h` (s), or shorter where the tolerance asks for that; how long it was.
    fn step_as_far_as_it_is_good(&mut self, t: f64, h: f64) -> Result<f64, NonFinite> {
        let Stepper::Adaptive { tolerance } = self.stepper else {
            self.step_evenly(t, h)?;
            return Ok(h);
        };
        let mut trial = h;
        loop {
            let size = (self.try_step(t, trial) / tolerance).max(1e-10);
            let factor = (0.9 / size.sqrt().sqrt()).clamp(0.2, 5.0);
            if size <= 1.0 || !size.is_finite() {
                self.accept_tried(t + trial)?;
                if self.touching.longest.is_none() {
                    self.last_step = trial * factor;
                }
                return Ok(trial);
            }
            trial *= factor;
        }
    }

    /// How long the coming step may be (s).
    fn coming_step(&self, t: f64, rest: f64) -> f64 {
        let usual = match self.stepper {
            Stepper::Fixed { step } => equal_steps(rest, step).1,
            Stepper::Adaptive { .. } => self.last_step.min(rest),
        };
        let mut h = usual;
        if let Some(longest) = self.touching.longest {
            h = h.min(longest);
        }
        let time = self.clock.period_start + t;
        let (grading, least) = self.touching.accuracy.grading();
        for contact in self.couplings.iter().flatten().filter_map(|c| c.by.contact()) {
            let graded = contact.law.normal.exponent != 1.0;
            for (place, seen) in contact.places.iter().zip(&contact.now) {
                let until = seen.depth.abs() / seen.rate.abs();
                if !place.touches && seen.depth < 0.0 && seen.rate > 0.0 {
                    h = h.min((BEYOND * until).max(1e-6 * usual));
                }
                // A spring of exponent 1 is smooth from touch to parting.
                if let (true, Some(longest)) = (place.touches && graded, self.touching.longest) {
                    let since = grading * (time - self.touching.since);
                    let near = if seen.rate < 0.0 { since.min(grading * until) } else { since };
                    h = h.min(near.max(least * longest));
                }
            }
        }
        h
    }

    /// What overlaps as the run begins touches from the start.
    fn touch_at_start(&mut self, t: f64) {
        if self.contacts_passed() {
            self.switch_contacts(t);
        } else if self.touching.longest.is_some() {
            self.pace_contacts();
        }
    }

    /// Note what is seen at the end of a step of `h` (s).
    fn note_contacts(&mut self, t: f64, h: f64) {
        let time = self.clock.period_start + t;
        for coupled in self.couplings.iter_mut().flatten() {
            let Some(contact) = coupled.by.contact_mut() else { continue };
            if contact.touching == 0 {
                continue;
            }
            let force = contact.normal_force();
            let record = &mut contact.record;
            contact.samples.note((time, force), &contact.now, &contact.law, record);
            record.shortest_step =
                if record.shortest_step == 0.0 { h } else { record.shortest_step.min(h) };
        }
    }
}
