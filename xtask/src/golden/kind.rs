//! What a kind of golden case is, and the kinds that the product can compute.

use super::capture::Capture;
use super::comparison::{Found, Tolerances};
use super::contract::Contract;
use super::derivatives::Derivatives;
use super::file::{Case, Complaint};
use super::friction::Friction;
use super::normal_contact::NormalContact;
use super::paper_equations::PaperEquations;
use super::peg::Peg;
use super::two_bodies::TwoBodies;

/// A kind of golden case. It hands a case to the product and gives back what that finds; every number
/// that is expected and not found is told as not compared.
pub(super) trait Kind {
    /// Whether cases of this name are of the kind: the file's, then the case's own after a stroke.
    fn takes(&self, kind: &str) -> bool;
    /// What its files ask.
    fn tolerances(&self) -> &'static Tolerances;
    /// What the product finds, in the shape of what is expected.
    ///
    /// # Errors
    /// If something is missing in the case, or the product refuses it.
    fn found(&self, case: &Case) -> Result<Found, Complaint>;
}

/// All that are built.
const KINDS: [&dyn Kind; 8] = [
    &Contract,
    &PaperEquations,
    &Derivatives,
    &Capture,
    &TwoBodies,
    &NormalContact,
    &Friction,
    &Peg,
];

/// The kind of this name, if it is built.
pub(super) fn named(kind: &str) -> Option<&'static dyn Kind> {
    KINDS.into_iter().find(|built| built.takes(kind))
}
