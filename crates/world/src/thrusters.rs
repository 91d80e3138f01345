//! Thrusters as they behave: pulses that rise and fall evenly, none shorter than can be, each a
//! little different.

use crate::command::Saturation;
use crate::noise::Noise;
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
pub(crate) enum Jammed {
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
    /// A valve moves no more, from the next command on.
    pub(crate) fn jam(&mut self, i: usize, jammed: Jammed) {
        if i < self.list.len() {
            self.jammed[i] = Some(jammed);
        }
    }
    /// Set the pulses for a period (s), `gone` (s) after the last began.
    pub(crate) fn command(
        &mut self,
        on: &[f64; THRUSTERS],
        (gone, period): (f64, f64),
        is_fed: bool,
        cut: &mut Vec<Saturation>,
    ) {
        let mut is_missed = false;
        for (i, thruster) in self.list.iter().enumerate() {
            let before = self.pulses[i];
            let is_open = before.shuts > gone;
            let open_for = if is_open { before.open_for + gone } else { 0.0 };
            let least = (thruster.minimum_on_time - open_for) * (1.0 - 1e-9);
            let mut shuts = match self.jammed[i] {
                Some(Jammed::Shut) => 0.0,
                Some(Jammed::Open) => f64::INFINITY,
                None => {
                    let (shuts, is_as_told) = shutting_time(on[i], period, least, is_open);
                    if is_fed && !is_as_told {
                        cut.push(Saturation::PulseTooShort(i));
                    }
                    shuts
                }
            };
            if !is_fed {
                is_missed |= shuts > 0.0 || on[i] > 0.0;
                shuts = 0.0;
            }
            let mut gain = before.gain;
            if !is_open && shuts > 0.0 {
                gain = (1.0 + thruster.impulse_noise * self.noise[i].normal()).max(0.0);
            }
            let level = before.level(thruster, gone, gone);
            self.pulses[i] = Pulse { level, shuts, open_for, gain };
        }
        if is_missed {
            cut.push(Saturation::TankEmpty);
        }
    }
    /// The instants between `from` and `to` (s into the period) at which a force bends, in no order.
    pub(crate) fn bends(&self, from: f64, to: f64) -> impl Iterator<Item = f64> {
        let near = 1e-12 * to;
        let each = self.list.iter().zip(&self.pulses);
        let all = each.flat_map(|(thruster, pulse)| pulse.bends(thruster));
        all.filter(move |t| *t > from + near && *t < to - near)
    }
    /// Force of each thruster (N) at `t`, as in the stretch without a bend that holds `within` (s).
    fn forces(&self, t: f64, within: f64) -> impl Iterator<Item = (&Thruster<f64>, f64)> {
        self.list.iter().zip(&self.pulses).map(move |(thruster, pulse)| {
            (thruster, thruster.force * pulse.gain * pulse.level(thruster, t, within))
        })
    }
    /// All together on the base, at its origin, in base axes (N·m, N).
    pub(crate) fn wrench(&self, t: f64, within: f64) -> SpatialForce<f64> {
        let (mut torque, mut force) = (Vec3::zero(), Vec3::zero());
        for (thruster, size) in self.forces(t, within) {
            let one = thruster.direction_B * size;
            force += one;
            torque += thruster.position_B.cross(one);
        }
        SpatialForce::new(torque, force)
    }
    /// Propellant (kg) that leaves in a stretch without a bend, from `from` to `to` (s).
    pub(crate) fn propellant(&self, from: f64, to: f64) -> f64 {
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
    fn bends(&self, thruster: &Thruster<f64>) -> [f64; 3] {
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
