//! Largest force and depth of a contact, located between steps.
//!
//! Depth and its rate are known at the ends of steps: a polynomial of degree five runs through three of
//! them, one of degree four through the rates of five. The force follows from both. No step is repeated for
//! a peak. (The slope of the first would do for the rate, but for rounding: a depth is known to the last
//! bits of a position, and those are divided by a step.)

use super::account::ContactRecord;
use super::coupling::Seen;
use super::law::ContactLaw;

/// A contact at the end of a step.
#[derive(Debug, Clone, Default)]
struct Sample {
    time: f64,
    force: f64,
    seen: Vec<Seen>,
}

/// A contact at the ends of the last steps, the oldest first.
#[derive(Debug, Clone, Default)]
pub(crate) struct Samples {
    last: [Sample; KEPT],
    count: usize,
}

/// How many steps are kept; the last three of them bracket a peak.
const KEPT: usize = 5;
const FIRST: usize = KEPT - 3;

/// A polynomial through value and rate at three times, in Newton's form.
struct Quintic {
    nodes: [f64; 6],
    factors: [f64; 6],
}

impl Quintic {
    fn through(times: [f64; 3], values: [f64; 3], rates: [f64; 3]) -> Self {
        let nodes = [times[0], times[0], times[1], times[1], times[2], times[2]];
        let mut column: Vec<f64> = (0..6).map(|i| values[i / 2]).collect();
        let mut factors = [column[0], 0.0, 0.0, 0.0, 0.0, 0.0];
        for order in 1..6 {
            for i in 0..6 - order {
                let span = nodes[i + order] - nodes[i];
                column[i] =
                    if span == 0.0 { rates[i / 2] } else { (column[i + 1] - column[i]) / span };
            }
            factors[order] = column[0];
        }
        Self { nodes, factors }
    }
    /// Value and rate at a time.
    fn at(&self, t: f64) -> (f64, f64) {
        let (mut value, mut rate) = (self.factors[5], 0.0);
        for i in (0..5).rev() {
            let x = t - self.nodes[i];
            rate = rate * x + value;
            value = value * x + self.factors[i];
        }
        (value, rate)
    }
}

impl Samples {
    /// Nothing has been seen yet: a touch begins.
    pub(crate) fn clear(&mut self) {
        self.count = 0;
    }
    /// Note the end of a step, and what was largest so far.
    pub(crate) fn note(
        &mut self,
        (time, force): (f64, f64),
        seen: &[Seen],
        law: &ContactLaw,
        record: &mut ContactRecord,
    ) {
        self.last.rotate_left(1);
        let newest = &mut self.last[KEPT - 1];
        (newest.time, newest.force) = (time, force);
        newest.seen.clear();
        newest.seen.extend_from_slice(seen);
        self.count += 1;
        record.largest_force = record.largest_force.max(force);
        record.deepest = seen.iter().fold(record.deepest, |most, seen| most.max(seen.depth));
        if self.count < 3 {
            return;
        }
        let [_, _, first, middle, last] = &self.last;
        if middle.force >= first.force && middle.force > last.force {
            record.largest_force = record.largest_force.max(self.largest_force(law));
        }
        for i in 0..seen.len() {
            let rates = (middle.seen[i].rate, last.seen[i].rate);
            if rates.0 > 0.0 && rates.1 <= 0.0 && last.seen[i].depth > 0.0 {
                record.deepest = record.deepest.max(self.deepest(i));
            }
        }
    }
    fn quintic(&self, i: usize) -> Quintic {
        let of = |f: &dyn Fn(&Sample) -> f64| [0, 1, 2].map(|k| f(&self.last[FIRST + k]));
        Quintic::through(of(&|s| s.time), of(&|s| s.seen[i].depth), of(&|s| s.seen[i].rate))
    }
    fn largest_force(&self, law: &ContactLaw) -> f64 {
        let seen = &self.last[KEPT - 1].seen;
        let depths: Vec<_> = (0..seen.len()).map(|i| self.quintic(i)).collect();
        let force = |t: f64| {
            depths.iter().enumerate().fold(0.0, |sum, (i, depth)| {
                let at_t = Seen { depth: depth.at(t).0, rate: self.rate(i, t), ..seen[i] };
                sum + at_t.force(law)
            })
        };
        let (mut low, mut high) = (self.last[FIRST].time, self.last[KEPT - 1].time);
        // A third of the span is left out each time: 80 of them are 1e-14 of it.
        for _ in 0..80 {
            let third = (high - low) / 3.0;
            if force(low + third) < force(high - third) { low += third } else { high -= third }
        }
        force(0.5 * (low + high))
    }
    /// Rate of a place at a time, by the polynomial through all rates that are kept.
    fn rate(&self, i: usize, t: f64) -> f64 {
        let known = &self.last[KEPT - self.count.min(KEPT)..];
        known.iter().fold(0.0, |sum, at| {
            let others = known.iter().filter(|other| other.time != at.time);
            let weight = others.fold(1.0, |w, o| w * (t - o.time) / (at.time - o.time));
            sum + weight * at.seen[i].rate
        })
    }
    fn deepest(&self, i: usize) -> f64 {
        let quintic = self.quintic(i);
        let (mut low, mut high) = (self.last[KEPT - 2].time, self.last[KEPT - 1].time);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if quintic.at(middle).1 > 0.0 { low = middle } else { high = middle }
        }
        quintic.at(0.5 * (low + high)).0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A polynomial of degree five comes back. Measured 4e-15 of values up to 9.
    #[test]
    fn a_quintic_is_found_from_three_values_and_rates() {
        let f = |t: f64| 1.0 + t * (2.0 + t * (-3.0 + t * (0.5 + t * (1.0 - 0.25 * t))));
        let g = |t: f64| 2.0 + t * (-6.0 + t * (1.5 + t * (4.0 - 1.25 * t)));
        let times = [0.1, 0.5, 1.3];
        let quintic = Quintic::through(times, times.map(f), times.map(g));
        for t in [0.0, 0.2, 0.9, 1.5] {
            let (value, rate) = quintic.at(t);
            assert!((value - f(t)).abs() < 1e-13 && (rate - g(t)).abs() < 1e-12, "{t}");
        }
    }
}
