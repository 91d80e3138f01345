//! The choices that a mission makes: which laws, and what they may measure.

use wrasse_dynamics::BaseMode;

/// What an arm law takes the base for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ArmLaw {
    /// Bolted to the ground: the law of an Earth-bound arm.
    Terrestrial,
    /// Attitude held, translation free: the paper's law.
    AttitudeHeld,
    /// Free to turn and to translate.
    FreeFloating,
}

impl ArmLaw {
    /// The base that the law counts on.
    pub fn base(self) -> BaseMode {
        match self {
            Self::Terrestrial => BaseMode::Fixed,
            Self::AttitudeHeld => BaseMode::AttitudeHeld,
            Self::FreeFloating => BaseMode::Free,
        }
    }
}

/// Feedforward of the arm's motion to the attitude control, before its reaction is measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Feedforward {
    /// The exact torque.
    Exact,
    /// Eq. (3) as printed, reading `p*_cm` as the centre of mass of arm and payload.
    AsPrinted,
    /// Eq. (3) as printed, reading `p*_cm` as the centre of mass of the whole system.
    AsPrintedSystemCm,
    /// Nothing.
    None,
}

/// What the guidance takes from the sensors.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Measurement {
    /// Nothing after the start: the law integrates its own model.
    None,
    /// Pose and twist of the base, each period.
    Base,
}

/// Which part of the tool's motion the arm must follow.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Task {
    /// Position and orientation.
    Pose,
    /// Position only.
    Position,
}

/// Numbers of the laws.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tuning<T> {
    /// Control period (s).
    pub period: T,
    /// How fast the guidance takes back a tool error (1/s).
    pub tool_gain: T,
    /// Bandwidth of the joint loops (rad/s); zero: feedforward only.
    pub joint_bandwidth: T,
    /// Damping ratio of the joint loops (–).
    pub joint_damping: T,
    /// Bandwidth of the attitude loop (rad/s); zero: feedforward only.
    pub attitude_bandwidth: T,
    /// Damping ratio of the attitude loop (–).
    pub attitude_damping: T,
}
