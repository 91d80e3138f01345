//! What each sample of a sweep draws anew: which quantity, by which distribution.
//!
//! Sample k draws from stream k of the seed, one word for each quantity in the order of the file: its
//! numbers depend on seed and k alone.

use wrasse_dynamics::BodyId;
use wrasse_world::Noise;

/// A number of a case that can be otherwise than the files say. Axes are 0, 1, 2.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Target {
    /// Mass of a body (kg); its inertia about its centre of mass goes with it.
    BodyMass(BodyId),
    /// Centre of mass of a body along an axis of the body (m).
    BodyCentre(BodyId, usize),
    /// Inertia of a body about its centre of mass (–, a share of itself).
    BodyInertia(BodyId),
    /// Mass of a payload (kg); its inertia goes with it.
    PayloadMass(usize),
    /// Its centre of mass along an axis (m).
    PayloadCentre(usize, usize),
    /// Its inertia (–, a share of itself).
    PayloadInertia(usize),
    /// Where a free payload is (m, inertial axes).
    PayloadPosition(usize, usize),
    /// How it is turned (rad, a rotation vector in its own axes).
    PayloadRotation(usize, usize),
    /// Its velocity (m/s, inertial axes).
    PayloadVelocity(usize, usize),
    /// Its angular velocity (rad/s, inertial axes).
    PayloadTurn(usize, usize),
    /// Where the base is at the start (m, inertial axes).
    Position(usize),
    /// How it is turned (rad, a rotation vector in base axes).
    Rotation(usize),
    /// Its velocity (m/s, base axes).
    Velocity(usize),
    /// Its angular velocity (rad/s, base axes).
    Turn(usize),
    /// Position of a joint at the start (rad or m), and its rate.
    Joint(usize),
    /// Rate of a joint at the start (rad/s or m/s).
    JointRate(usize),
    /// Bias of the rate gyro (rad/s, base axes).
    GyroBias(usize),
    /// Noise of the rate gyro and of the star tracker, step of the encoders (–, shares of themselves).
    GyroNoise,
    /// Noise of the star tracker (–, a share of itself).
    TrackerNoise,
    /// Step of the encoders (–, a share of itself).
    EncoderStep,
}

impl Target {
    /// Whether it says what something is made of, or how a sensor errs: a flight computer may know it
    /// or not. All the rest it senses.
    pub fn can_be_known(self) -> bool {
        self.is_mass() || self.is_sensor()
    }
    /// Whether it is a mass property.
    pub fn is_mass(self) -> bool {
        matches!(
            self,
            Self::BodyMass(_)
                | Self::BodyCentre(..)
                | Self::BodyInertia(_)
                | Self::PayloadMass(_)
                | Self::PayloadCentre(..)
                | Self::PayloadInertia(_)
        )
    }
    fn is_sensor(self) -> bool {
        matches!(self, Self::GyroBias(_) | Self::GyroNoise | Self::TrackerNoise | Self::EncoderStep)
    }
}

/// How far from the value of the files a number is, in the unit of the quantity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Distribution {
    /// Normal, of this standard deviation.
    Normal(f64),
    /// Normal, of this standard deviation, less what is beyond ± the second number.
    Bounded(f64, f64),
    /// Uniform between two numbers.
    Uniform(f64, f64),
}

impl Distribution {
    /// One deviation, from one word of the stream.
    fn draw(self, noise: &mut Noise) -> f64 {
        match self {
            Self::Normal(sigma) => sigma * noise.normal(),
            Self::Bounded(sigma, within) => {
                (sigma * noise.bounded_normal(within / sigma)).clamp(-within, within)
            }
            Self::Uniform(from, to) => (from + (to - from) * noise.uniform()).clamp(from, to),
        }
    }
    /// Least and largest deviation that can be drawn.
    pub fn reach(self) -> (f64, f64) {
        match self {
            Self::Normal(sigma) => {
                (-sigma * Noise::FARTHEST_NORMAL, sigma * Noise::FARTHEST_NORMAL)
            }
            Self::Bounded(_, within) => (-within, within),
            Self::Uniform(from, to) => (from, to),
        }
    }
}

/// A number that each sample draws anew.
#[derive(Debug, Clone, PartialEq)]
pub struct Dispersion {
    /// Its name, with axis or joint and unit.
    pub name: String,
    /// What it changes.
    pub target: Target,
    /// How far it may be off.
    pub distribution: Distribution,
    /// The value of the files in the unit of the name, and that unit.
    pub nominal: f64,
    /// The unit of the name.
    pub unit: &'static str,
    /// What that unit is in SI.
    pub scale: f64,
    /// Whether the flight computer knows what was drawn.
    pub known: bool,
}

/// The seed of a sample's own noise, and its deviations in the units of their names.
pub(crate) fn draws(dispersions: &[Dispersion], seed: u64, sample: u64) -> (u64, Vec<f64>) {
    let mut noise = Noise::new(seed, sample);
    let own = noise.word();
    (own, dispersions.iter().map(|d| d.distribution.draw(&mut noise)).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn dispersions(distributions: &[Distribution]) -> Vec<Dispersion> {
        let one = |distribution: &Distribution| Dispersion {
            name: String::new(),
            target: Target::GyroNoise,
            distribution: *distribution,
            nominal: 100.0,
            unit: "%",
            scale: 1.0,
            known: false,
        };
        distributions.iter().map(one).collect()
    }

    const ALL: [Distribution; 3] = [
        Distribution::Normal(2.0),
        Distribution::Bounded(2.0, 1.0),
        Distribution::Uniform(3.0, 7.0),
    ];

    #[test]
    fn what_is_drawn_depends_on_the_quantities_before_it_and_on_none_behind_it() {
        let (own, all) = draws(&dispersions(&ALL), 11, 4711);
        for count in 0..ALL.len() {
            assert_eq!(draws(&dispersions(&ALL[..count]), 11, 4711), (own, all[..count].to_vec()));
        }
        assert_ne!(draws(&dispersions(&ALL), 11, 4712).1, all);
        assert_ne!(draws(&dispersions(&ALL), 12, 4711).1, all);
    }

    #[test]
    fn no_draw_is_beyond_the_reach_of_its_distribution() {
        for sample in 0..2000 {
            let (_, drawn) = draws(&dispersions(&ALL), 3, sample);
            for (x, distribution) in drawn.into_iter().zip(ALL) {
                let (low, high) = distribution.reach();
                assert!((low..=high).contains(&x), "sample {sample}: {x} of {distribution:?}");
            }
        }
    }
}
