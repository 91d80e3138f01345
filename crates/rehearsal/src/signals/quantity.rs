//! The quantities that are watched: their names, units and statistics.

use crate::outcome::Metric;

/// Kind of a quantity: what it is measured in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// In m.
    Length,
    /// In rad.
    Angle,
    /// In m/s.
    Speed,
    /// In rad/s.
    AngularSpeed,
    /// In N.
    Force,
    /// In N·m.
    Torque,
    /// In N·m·s.
    AngularMomentum,
    /// In J.
    Energy,
    /// In kg.
    Mass,
    /// In –.
    Number,
}

/// Units that a requirement may be written in, with what they are in SI.
const UNITS: &[(&str, Kind, f64)] = &[
    ("m", Kind::Length, 1.0),
    ("cm", Kind::Length, 1e-2),
    ("mm", Kind::Length, 1e-3),
    ("um", Kind::Length, 1e-6),
    ("rad", Kind::Angle, 1.0),
    ("mrad", Kind::Angle, 1e-3),
    ("deg", Kind::Angle, std::f64::consts::PI / 180.0),
    ("arcmin", Kind::Angle, std::f64::consts::PI / 10_800.0),
    ("arcsec", Kind::Angle, std::f64::consts::PI / 648_000.0),
    ("m/s", Kind::Speed, 1.0),
    ("mm/s", Kind::Speed, 1e-3),
    ("rad/s", Kind::AngularSpeed, 1.0),
    ("deg/s", Kind::AngularSpeed, std::f64::consts::PI / 180.0),
    ("N", Kind::Force, 1.0),
    ("kN", Kind::Force, 1e3),
    ("N.m", Kind::Torque, 1.0),
    ("Nm", Kind::Torque, 1.0),
    ("mNm", Kind::Torque, 1e-3),
    ("N.m.s", Kind::AngularMomentum, 1.0),
    ("Nms", Kind::AngularMomentum, 1.0),
    ("J", Kind::Energy, 1.0),
    ("mJ", Kind::Energy, 1e-3),
    ("kg", Kind::Mass, 1.0),
    ("g", Kind::Mass, 1e-3),
    ("-", Kind::Number, 1.0),
    ("%", Kind::Number, 1e-2),
];

impl Kind {
    /// Its unit in SI.
    pub fn si(self) -> &'static str {
        match self {
            Self::Torque => "N·m",
            Self::AngularMomentum => "N·m·s",
            Self::Number => "–",
            _ => UNITS.iter().find(|u| u.1 == self).map_or("–", |u| u.0),
        }
    }
    /// What a unit of this kind is in SI.
    pub fn scale_of(self, unit: &str) -> Option<f64> {
        let plain = unit.replace('·', ".");
        UNITS.iter().find(|u| u.0 == plain && u.1 == self).map(|u| u.2)
    }
    /// The units it may be written in.
    pub fn units(self) -> Vec<&'static str> {
        UNITS.iter().filter(|u| u.1 == self).map(|u| u.0).collect()
    }
}

/// What a unit of requirements and channels measures, and what it is in SI.
pub fn measured_in(unit: &str) -> Option<(Kind, f64)> {
    let plain = unit.replace('·', ".").replace('–', "-");
    UNITS.iter().find(|u| u.0 == plain).map(|u| (u.1, u.2))
}

/// What is made of the values of a quantity over time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Statistic {
    /// Largest value, without its sign.
    Max,
    /// Smallest value.
    Min,
    /// Last value.
    Final,
    /// Root of the mean square.
    Rms,
}

impl Statistic {
    /// Its word in requirements.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Max => "max",
            Self::Min => "min",
            Self::Final => "final",
            Self::Rms => "rms",
        }
    }
}

/// A quantity that is watched.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Quantity {
    /// Its name: `tool.position_error`.
    pub name: String,
    /// What it is, in words.
    pub meaning: String,
    /// What it is measured in.
    pub kind: Kind,
    /// What is made of its values.
    pub statistics: &'static [Statistic],
}

/// RunningStatistic statistics of one quantity. Where it is absent (NaN) it does not count; after a value that is
/// not finite none of its statistics has a value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct RunningStatistic {
    largest: f64,
    smallest: f64,
    last: f64,
    squares: f64,
    count: f64,
    broken: bool,
}

impl Default for RunningStatistic {
    fn default() -> Self {
        Self {
            largest: 0.0,
            smallest: f64::INFINITY,
            last: f64::NAN,
            squares: 0.0,
            count: 0.0,
            broken: false,
        }
    }
}

impl RunningStatistic {
    pub(crate) fn add(&mut self, x: f64) {
        if x.is_nan() {
            return;
        }
        self.last = x;
        self.broken |= x.is_infinite();
        self.largest = self.largest.max(x.abs());
        self.smallest = self.smallest.min(x);
        self.squares += x * x;
        self.count += 1.0;
    }
    /// The statistic; `None` where there is none: before the first value, and after one that is not finite.
    pub(crate) fn get(&self, statistic: Statistic) -> Option<f64> {
        let value = match statistic {
            _ if self.count == 0.0 || self.broken => return None,
            Statistic::Max => self.largest,
            Statistic::Min => self.smallest,
            Statistic::Final => self.last,
            Statistic::Rms => (self.squares / self.count).sqrt(),
        };
        value.is_finite().then_some(value)
    }
}

/// Statistics over the whole run, and over each phase.
#[derive(Debug, Clone)]
pub struct Statistics {
    pub(crate) quantities: Vec<Quantity>,
    whole: Vec<RunningStatistic>,
    phases: Vec<Vec<RunningStatistic>>,
}

impl Statistics {
    /// Nothing was seen yet.
    pub fn new(quantities: Vec<Quantity>, phases: usize) -> Self {
        let empty = vec![RunningStatistic::default(); quantities.len()];
        Self { quantities, whole: empty.clone(), phases: vec![empty; phases] }
    }
    /// Values of all quantities at one instant of a phase.
    pub fn add(&mut self, phase: usize, values: &[f64]) {
        self.whole.iter_mut().zip(values).for_each(|(r, &x)| r.add(x));
        if let Some(running) = self.phases.get_mut(phase) {
            running.iter_mut().zip(values).for_each(|(r, &x)| r.add(x));
        }
    }
    /// A statistic of a quantity, over the whole run or one phase.
    pub fn value(
        &self,
        quantity: usize,
        statistic: Statistic,
        phase: Option<usize>,
    ) -> Option<f64> {
        match phase {
            None => self.whole.get(quantity)?.get(statistic),
            Some(phase) => self.phases.get(phase)?.get(quantity)?.get(statistic),
        }
    }
    /// Values of these quantities at one instant of a phase; of all others nothing is kept.
    pub(crate) fn add_only(&mut self, only: &[usize], phase: usize, values: &[f64]) {
        for &i in only {
            let Some(&x) = values.get(i) else { continue };
            self.whole[i].add(x);
            if let Some(running) = self.phases.get_mut(phase) {
                running[i].add(x);
            }
        }
    }
    /// Every metric that has a value, over the whole run.
    pub fn metrics(&self) -> Vec<Metric> {
        let mut metrics = vec![];
        for (i, quantity) in self.quantities.iter().enumerate() {
            for &statistic in quantity.statistics {
                let Some(value) = self.value(i, statistic, None) else { continue };
                let name = format!("{}.{}", quantity.name, statistic.name());
                metrics.push(Metric { name, value, unit: quantity.kind.si().into() });
            }
        }
        metrics
    }
}
