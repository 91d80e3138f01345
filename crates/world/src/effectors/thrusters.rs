//! Thrusters as they behave: pulses that rise and fall evenly, none shorter than can be, each a
//! little different.

use super::{Effector, Load, PeriodCommand, Stage};
use crate::command::Saturation;
use crate::failure::Failure;
use crate::noise::Noise;
use crate::source::Source;
use wrasse_hardware::{List, STANDARD_GRAVITY, THRUSTERS, Thruster};
use wrasse_spatial::{SpatialForce, Vec3};

/// Streams of noise below this one are for others.
const FIRST_STREAM: u64 = 0x1_0000;

/// What a thruster does in a control period: its valve opens at the start, or is open already.
#[derive(Debug, Clone, Copy, Default)]
struct Pulse {
    /// Share of the full force at the start (–), which an earlier pulse has left.
    level: f64,
    /// When the valve shuts (s); infinite where it stays open.
    shuts: f64,
    /// How long the valve was open before the period (s).
    open_for: f64,
    /// Share of its nominal impulse that this pulse gives (–).
    gain: f64,
}

/// What breaks a valve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Jammed {
    Shut,
    Open,
}

/// The thrusters of the base.
#[derive(Debug, Clone)]
pub(crate) struct Thrusters {
    list: List<Thruster<f64>, THRUSTERS>,
    pulses: [Pulse; THRUSTERS],
    jammed: [Option<Jammed>; THRUSTERS],
    /// One stream for each, so that what one does changes nothing of another.
    noise: Vec<Noise>,
}

impl Thrusters {
    pub(crate) fn new(list: &List<Thruster<f64>, THRUSTERS>, seed: u64) -> Self {
        let streams = FIRST_STREAM..FIRST_STREAM + list.len() as u64;
        Self {
            list: *list,
            pulses: [Pulse::default(); THRUSTERS],
            jammed: [None; THRUSTERS],
            noise: streams.map(|stream| Noise::new(seed, stream)).collect(),
        }
    }
    /// Force of each thruster (N) at `t`, as in the stretch without a bend that holds `within` (s).
    fn forces(&self, t: f64, within: f64) -> impl Iterator<Item = (&Thruster<f64>, f64)> {
        self.list.iter().zip(&self.pulses).map(move |(thruster, pulse)| {
            (thruster, thruster.force * pulse.gain * pulse.level(thruster, t, within))
        })
    }
    /// What a thruster does in a period, of its valve told to be open for `on` (s); whether that is as it
    /// was told, and whether it missed its propellant.
    fn pulse(&mut self, i: usize, on: f64, told: &PeriodCommand<'_>) -> (Pulse, bool, bool) {
        let (thruster, before) = (&self.list[i], self.pulses[i]);
        let is_open = before.shuts > told.gone;
        let open_for = if is_open { before.open_for + told.gone } else { 0.0 };
        let least = (thruster.minimum_on_time - open_for) * (1.0 - 1e-9);
        let (mut shuts, is_as_told) = match self.jammed[i] {
            Some(Jammed::Shut) => (0.0, true),
            Some(Jammed::Open) => (f64::INFINITY, true),
            None => shutting_time(on, told.period, least, is_open),
        };
        let is_missed = !told.is_fed && (shuts > 0.0 || on > 0.0);
        if !told.is_fed {
            shuts = 0.0;
        }
        let mut gain = before.gain;
        if !is_open && shuts > 0.0 {
            gain = (1.0 + thruster.impulse_noise * self.noise[i].normal()).max(0.0);
        }
        let level = before.level(thruster, told.gone, told.gone);
        (Pulse { level, shuts, open_for, gain }, is_as_told, is_missed)
    }
}

impl<const J: usize> Effector<J> for Thrusters {
    fn source(&self) -> Source {
        Source::Thrusters
    }
    fn act(&self, at: &Stage<'_, J>, _own: &[f64], load: &mut Load<'_, J>, _rates: &mut [f64]) {
        for (thruster, size) in self.forces(at.t, at.within) {
            let force = thruster.direction_B * size;
            load.on_base += SpatialForce::new(thruster.position_B.cross(force), force);
        }
    }
    /// Where a force bends.
    fn breakpoints(&self, _start: f64, (from, to): (f64, f64), each: &mut dyn FnMut(f64)) {
        let near = 1e-12 * to;
        let all = self.list.iter().zip(&self.pulses).flat_map(|(t, pulse)| pulse.breakpoints(t));
        all.filter(|t| *t > from + near && *t < to - near).for_each(each);
    }
    fn command(&mut self, told: &PeriodCommand<'_>, _own: &[f64], cut: &mut Vec<Saturation>) {
        let mut is_empty = false;
        for i in 0..self.list.len() {
            let (pulse, is_as_told, is_missed) = self.pulse(i, told.actuators.thruster_on[i], told);
            if told.is_fed && !is_as_told {
                cut.push(Saturation::PulseTooShort(i));
            }
            is_empty |= is_missed;
            self.pulses[i] = pulse;
        }
        if is_empty {
            cut.push(Saturation::TankEmpty);
        }
    }
    /// A valve moves no more, from the next command on.
    fn fail(&mut self, failure: Failure, _own: &mut [f64]) -> Option<Vec3<f64>> {
        let (i, jammed) = match failure {
            Failure::ThrusterShut(i) => (i, Jammed::Shut),
            Failure::ThrusterOpen(i) => (i, Jammed::Open),
            Failure::Wheel(_) | Failure::Gimbal(_) => return None,
        };
        if i < self.list.len() {
            self.jammed[i] = Some(jammed);
        }
        None
    }
    fn propellant(&self, from: f64, to: f64) -> f64 {
        let middle = 0.5 * (from + to);
        let each = self.forces(middle, middle).filter(|(t, _)| t.specific_impulse > 0.0);
        each.fold(0.0, |mass, (thruster, force)| {
            mass + force * (to - from) / (thruster.specific_impulse * STANDARD_GRAVITY)
        })
    }
}

/// When a valve shuts that is told to be open for `on` in a period and, once it is open, stays so for
/// `least` (s); and whether that is as it was told.
fn shutting_time(on: f64, period: f64, least: f64, is_open: bool) -> (f64, bool) {
    if on >= period * (1.0 - 1e-12) {
        return (f64::INFINITY, true);
    }
    // What is not a number opens nothing.
    let on = on.max(0.0);
    if on >= least || (on == 0.0 && !is_open) {
        return (on, true);
    }
    match is_open {
        true if least < period => (least, false),
        true => (f64::INFINITY, false),
        false => (0.0, false),
    }
}

impl Pulse {
    /// When the force is full, if the valve stays open (s).
    fn full_at(&self, thruster: &Thruster<f64>) -> f64 {
        (1.0 - self.level) * thruster.rise_time
    }
    /// Share of the full force when the valve shuts (–).
    fn level_at_shutting(&self, thruster: &Thruster<f64>) -> f64 {
        match self.shuts < self.full_at(thruster) {
            true => self.level + self.shuts / thruster.rise_time,
            false if self.shuts > 0.0 => 1.0,
            false => self.level,
        }
    }
    fn gone_at(&self, thruster: &Thruster<f64>) -> f64 {
        self.shuts + self.level_at_shutting(thruster) * thruster.fall_time
    }
    /// Where rising ends, falling begins and ends (s).
    fn breakpoints(&self, thruster: &Thruster<f64>) -> [f64; 3] {
        [self.full_at(thruster).min(self.shuts), self.shuts, self.gone_at(thruster)]
    }
    /// Share of the full force at `t`, by the line that holds at `within` (s).
    fn level(&self, thruster: &Thruster<f64>, t: f64, within: f64) -> f64 {
        if within < self.shuts {
            let is_rising = within < self.full_at(thruster);
            return if is_rising { self.level + t / thruster.rise_time } else { 1.0 };
        }
        if within < self.gone_at(thruster) {
            return self.level_at_shutting(thruster) - (t - self.shuts) / thruster.fall_time;
        }
        0.0
    }
}
