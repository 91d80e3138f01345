//! Who changes momentum and energy, and by how much.

use std::ops::{Index, IndexMut};
use wrasse_spatial::{SpatialForce, Vec3};

/// Who changes the momentum or the energy of the bodies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Source {
    /// The motors of the joints.
    JointDrives,
    /// Springs and dampers of joints: work alone.
    JointSprings,
    /// The ideal attitude actuator, and what holds an attitude exactly.
    AttitudeActuator,
    /// Reaction wheels: work on the bodies alone, for what they store is counted as it is.
    Wheels,
    /// Control moment gyros: work on the bodies alone, likewise.
    Cmgs,
    /// Thrusters.
    Thrusters,
    /// Propellant: what it took along as it left the tank, negative.
    Propellant,
    /// The liquid that swings in a tank: what damps and restores its swing, work alone.
    Slosh,
    /// Wrenches that are applied from outside.
    Applied,
    /// Gravity.
    Gravity,
    /// Couplings between systems: work alone, for a wrench and its opposite cancel.
    Couplings,
    /// Contacts between shapes: work alone, likewise.
    Contacts,
    /// Grasps and releases: energy alone, for the momentum of both sides continues.
    Grasps,
}

impl Source {
    /// How many there are.
    pub const COUNT: usize = 13;
    /// All of them, in the order in which they are shown.
    pub const ALL: [Self; Self::COUNT] = [
        Self::JointDrives,
        Self::JointSprings,
        Self::AttitudeActuator,
        Self::Wheels,
        Self::Cmgs,
        Self::Thrusters,
        Self::Propellant,
        Self::Slosh,
        Self::Applied,
        Self::Gravity,
        Self::Couplings,
        Self::Contacts,
        Self::Grasps,
    ];
    /// Its name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::JointDrives => "joint drives",
            Self::JointSprings => "joint springs",
            Self::AttitudeActuator => "attitude actuator",
            Self::Wheels => "wheels",
            Self::Cmgs => "CMGs",
            Self::Thrusters => "thrusters",
            Self::Propellant => "propellant",
            Self::Slosh => "slosh",
            Self::Applied => "applied wrenches",
            Self::Gravity => "gravity",
            Self::Couplings => "couplings",
            Self::Contacts => "contacts",
            Self::Grasps => "grasps",
        }
    }
}

/// What one source has given the bodies since the start.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Booking {
    /// Angular impulse about the origin of N, inertial axes (N·m·s).
    pub angular: Vec3<f64>,
    /// Impulse, inertial axes (N·s).
    pub linear: Vec3<f64>,
    /// Work on the bodies (J).
    pub work: f64,
}

impl Booking {
    /// How many numbers it is.
    pub(crate) const NUMBERS: usize = 7;
    /// Work alone (J, or W as a rate).
    pub(crate) fn of_work(work: f64) -> Self {
        Self { work, ..Self::default() }
    }
    /// An angular impulse alone, and its work.
    pub(crate) fn of_turn(angular: Vec3<f64>, work: f64) -> Self {
        Self { angular, work, ..Self::default() }
    }
    /// A wrench about the origin of N, inertial axes, and its power (or impulse and work).
    pub(crate) fn of_wrench(F_N: &SpatialForce<f64>, work: f64) -> Self {
        Self { angular: F_N.torque, linear: F_N.force, work }
    }
    fn add_to(&self, numbers: &mut [f64]) {
        let (a, l) = (self.angular.to_array(), self.linear.to_array());
        let all = [a[0], a[1], a[2], l[0], l[1], l[2], self.work];
        numbers.iter_mut().zip(all).for_each(|(x, y)| *x += y);
    }
    fn from_numbers(numbers: &[f64]) -> Self {
        let mut seven = [0.0; Self::NUMBERS];
        seven.iter_mut().zip(numbers).for_each(|(x, y)| *x = *y);
        let [a, b, c, d, e, f, work] = seven;
        Self { angular: Vec3::from_array([a, b, c]), linear: Vec3::from_array([d, e, f]), work }
    }
}

/// Bookings of all sources.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Bookings([Booking; Source::COUNT]);

impl Index<Source> for Bookings {
    type Output = Booking;
    fn index(&self, source: Source) -> &Booking {
        &self.0[source as usize]
    }
}

impl IndexMut<Source> for Bookings {
    fn index_mut(&mut self, source: Source) -> &mut Booking {
        &mut self.0[source as usize]
    }
}

impl Bookings {
    /// How many numbers they are.
    pub(crate) const NUMBERS: usize = Source::COUNT * Booking::NUMBERS;
    /// From numbers in a row.
    pub(crate) fn from_row(row: &[f64]) -> Self {
        let mut all = Self::default();
        for (booking, numbers) in all.0.iter_mut().zip(row.chunks(Booking::NUMBERS)) {
            *booking = Booking::from_numbers(numbers);
        }
        all
    }
    /// Add to numbers in a row what a source gives.
    pub(crate) fn book(row: &mut [f64], source: Source, given: &Booking) {
        let first = source as usize * Booking::NUMBERS;
        given.add_to(row.get_mut(first..first + Booking::NUMBERS).unwrap_or_default());
    }
    /// All together.
    pub fn total(&self) -> Booking {
        self.0.iter().fold(Booking::default(), |sum, one| Booking {
            angular: sum.angular + one.angular,
            linear: sum.linear + one.linear,
            work: sum.work + one.work,
        })
    }
}
