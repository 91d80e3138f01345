//! What a deep check says of a vehicle: findings, and the figures of what is fine.

use std::fmt;
use std::ops::Range;
use std::sync::Arc;
use wrasse_document::{Complaint, Source};

/// What a finding is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum FindingKind {
    /// A unit that slipped: mm for m, g for kg, degrees for radians.
    UnitSlip,
    /// More inertia than any matter within what is drawn can have.
    InertiaBeyondShape,
    /// The long axis of the inertia is not the long axis of what is drawn.
    InertiaAcrossShape,
    /// Far less inertia than an even solid that fills what is drawn.
    InertiaBelowShape,
    /// A radius of gyration out of proportion to where joints and frames are.
    GyrationAgainstSize,
    /// Lighter than foam, or denser than osmium.
    Density,
    /// Two arms or links that mirror each other and differ.
    Asymmetry,
    /// A mass matrix that is near singular in some posture.
    MassMatrixCondition,
    /// A coast whose energy or momentum drifts.
    CoastDrift,
}

impl FindingKind {
    /// All kinds, in the order in which they are told: a cause before what follows from it.
    pub const ALL: [Self; 9] = [
        Self::UnitSlip,
        Self::InertiaBeyondShape,
        Self::InertiaAcrossShape,
        Self::InertiaBelowShape,
        Self::GyrationAgainstSize,
        Self::Density,
        Self::Asymmetry,
        Self::MassMatrixCondition,
        Self::CoastDrift,
    ];
    /// Its name in JSON.
    pub fn word(self) -> &'static str {
        match self {
            Self::UnitSlip => "unit_slip",
            Self::InertiaBeyondShape => "inertia_beyond_shape",
            Self::InertiaAcrossShape => "inertia_across_shape",
            Self::InertiaBelowShape => "inertia_below_shape",
            Self::GyrationAgainstSize => "gyration_against_size",
            Self::Density => "density",
            Self::Asymmetry => "asymmetry",
            Self::MassMatrixCondition => "mass_matrix_condition",
            Self::CoastDrift => "coast_drift",
        }
    }
    /// Its name for people.
    pub fn title(self) -> &'static str {
        match self {
            Self::UnitSlip => "units",
            Self::InertiaBeyondShape => "inertia against shape",
            Self::InertiaAcrossShape => "inertia across the shape",
            Self::InertiaBelowShape => "inertia far below the shape's",
            Self::GyrationAgainstSize => "radius of gyration against size",
            Self::Density => "density",
            Self::Asymmetry => "left and right",
            Self::MassMatrixCondition => "condition of the mass matrix",
            Self::CoastDrift => "energy and momentum of a coast",
        }
    }
    /// Why it matters, in one sentence.
    pub fn why(self) -> &'static str {
        match self {
            Self::UnitSlip => {
                "A wrong unit scales every torque, rate and limit of this part by the same factor."
            }
            Self::InertiaBeyondShape => {
                "The joint and the base would be sized for inertia that the part cannot have."
            }
            Self::InertiaAcrossShape => {
                "The part then resists turning about the wrong axis, and the base turns wrongly with it."
            }
            Self::InertiaBelowShape => {
                "Too little inertia makes the arm look easier to drive than it is, and its loops too \
                 fast."
            }
            Self::GyrationAgainstSize => {
                "Inertia grows with the square of this radius: an error here is squared in every torque."
            }
            Self::Density => {
                "A mass that its volume contradicts moves the centre of mass, and the base's motion with \
                 it."
            }
            Self::Asymmetry => {
                "A mirrored motion of both then turns the base, and a controller tuned on one does not \
                 fit the other."
            }
            Self::MassMatrixCondition => {
                "Accelerations lose as many digits as this number has, and small errors of force become \
                 large motions."
            }
            Self::CoastDrift => {
                "Nothing acts on a coasting vehicle: what drifts is error of the integration, and a run \
                 would carry it too."
            }
        }
    }
}

/// How much a finding counts. None of them keeps a file from being used.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FindingSeverity {
    /// Hardly any vehicle is so.
    Warning,
    /// Some are, by design.
    Note,
}

impl FindingSeverity {
    /// Its name.
    pub fn word(self) -> &'static str {
        match self {
            Self::Warning => "warning",
            Self::Note => "note",
        }
    }
}

/// A place in a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Place {
    /// The file.
    pub source: Arc<Source>,
    /// Bytes of its text.
    pub span: Range<usize>,
}

impl Place {
    /// Line and column, both from 1.
    pub fn line_and_column(&self) -> (usize, usize) {
        let here = Complaint::note(&self.source, "").at(self.span.clone(), "");
        here.placed().line_and_column().unwrap_or((1, 1))
    }
}

impl fmt::Display for Place {
    /// `path:line`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}", self.source.path.display(), self.line_and_column().0)
    }
}

/// One thing worth a second look.
#[derive(Debug, Clone, PartialEq)]
pub struct Finding {
    /// What it is about.
    pub kind: FindingKind,
    /// How much it counts.
    pub severity: FindingSeverity,
    /// Names of the links or joints, or of the vehicle.
    pub subject: String,
    /// Where the subject stands; `None` where it is the whole vehicle.
    pub place: Option<Place>,
    /// What is found and what is expected, with units.
    pub message: String,
    /// The numbers of the message; their names end in the unit.
    pub numbers: Vec<(&'static str, f64)>,
}

/// What a check looked at and found fine, in one line.
#[derive(Debug, Clone, PartialEq)]
pub struct Fine {
    /// What was checked.
    pub kind: FindingKind,
    /// What was looked at, and the figure.
    pub message: String,
    /// The numbers of the message; their names end in the unit.
    pub numbers: Vec<(&'static str, f64)>,
}

/// What a deep check says.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct DeepCheck {
    /// Worth a second look, by kind.
    pub findings: Vec<Finding>,
    /// What is fine, by kind.
    pub fine: Vec<Fine>,
}

impl DeepCheck {
    /// Takes the findings of one check; what it looked at is told where there are none.
    pub fn take(&mut self, found: Vec<Finding>, fine: Fine) {
        if found.is_empty() {
            self.fine.push(fine);
        }
        self.findings.extend(found);
    }
}
