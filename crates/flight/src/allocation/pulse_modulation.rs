//! Pulse-width pulse-frequency modulation: from a share of full force to pulses of a thruster.

use wrasse_spatial::Scalar;

/// How pulses are made: a lag whose output opens and shuts the thruster.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Modulation<T> {
    /// Gain of the lag (–).
    pub gain: T,
    /// Time constant of the lag (s).
    pub lag: T,
    /// Level at which the thruster opens (–).
    pub on_level: T,
    /// Level at which it shuts, below the other (–).
    pub off_level: T,
}

impl<T: Scalar> Modulation<T> {
    /// The input (–) at which the average force is the wanted share of full force.
    ///
    /// The lag leaks: over whole pulses the average force is the input less the mean level over the
    /// gain. The mean level lies halfway between the two levels, nearly.
    pub fn input_for(&self, duty: T) -> T {
        let leak = (self.on_level + self.off_level) * T::from_f64(0.5) / self.gain;
        if duty > T::zero() { duty + leak } else { T::zero() }
    }
    /// The shortest pulse that the levels make (s), reached at small inputs. A thruster whose own
    /// shortest pulse is longer gives more than is wanted.
    pub fn shortest_pulse(&self) -> T {
        self.lag * (self.on_level - self.off_level) / self.gain
    }
}

/// The modulator of one thruster: its state from one control period to the next.
///
/// One for each thruster, not for each axis: a thruster only pushes, and has its own shortest pulse.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Modulator<T> {
    /// Output of the lag (–).
    level: T,
    /// How long the thruster has been open (s); `None` while it is shut.
    open_for: Option<T>,
}

impl<T: Scalar> Modulator<T> {
    /// How long the thruster should be open in the coming control period, from its start (s). All
    /// of it: it stays open into the next.
    ///
    /// It opens at the start of a period only: that which lies nearest to the instant at which the
    /// level rises to where it opens. It shuts within a period when the level has fallen, but not
    /// before a pulse is `minimum_on_time` long. The level follows the pulses as they are.
    ///
    /// # Arguments
    /// | name | meaning | unit |
    /// |---|---|---|
    /// | `minimum_on_time` | shortest pulse of the thruster | s |
    /// | `input` | see [`input_for`](Modulation::input_for); not a number: none | – |
    /// | `period` | the control period | s |
    ///
    /// # Source
    /// [`Wie2008`](wrasse_spatial::references::Wie2008), thruster control.
    #[doc(alias = "pwpf")]
    pub fn on_time(&mut self, law: &Modulation<T>, minimum_on_time: T, input: T, period: T) -> T {
        let input = if input.is_finite() { input } else { T::zero() };
        let halfway = self.level_after(law, input, period * T::from_f64(0.5));
        let opens = self.open_for.is_some() || halfway >= law.on_level;
        let mut on = T::zero();
        if opens {
            let so_far = self.open_for.unwrap_or(T::zero());
            let must = minimum_on_time - so_far;
            on = self.time_to_shut(law, input, period).max(must).max(T::zero()).min(period);
            self.level = self.level_after(law, input - T::one(), on);
            self.open_for = Some(so_far + on);
        }
        if on < period {
            self.open_for = None;
            self.level = self.level_after(law, input, period - on);
        }
        on
    }
    /// Time until the level of an open thruster has fallen to where it shuts, at most the period (s).
    fn time_to_shut(&self, law: &Modulation<T>, input: T, period: T) -> T {
        let end = law.gain * (input - T::one());
        let (above, least) = (self.level - end, law.off_level - end);
        if above <= least {
            T::zero()
        } else if least <= T::zero() {
            // It never falls so far: the input is too large.
            period
        } else {
            (law.lag * T::ln(above / least)).min(period)
        }
    }
    /// The level after some time (s) with a constant input of the lag: exact.
    fn level_after(&self, law: &Modulation<T>, input: T, time: T) -> T {
        let end = law.gain * input;
        end + (self.level - end) * T::exp(-time / law.lag)
    }
}
