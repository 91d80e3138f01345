//! `[study]`: what `wrasse size` makes of the variants.

use schemars::JsonSchema;
use serde::Deserialize;

/// What the claim of a study says, where verdicts can be held against it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ClaimIs {
    /// Wheels do not suffice, and CMGs do.
    #[schemars(extend("x-formerly" = ["gyros-needed"]))]
    CmgsNeeded,
}

/// What `wrasse size` makes of the cases.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct StudyFile {
    /// The claim that is examined, in a sentence.
    #[serde(default)]
    pub(crate) claim: String,
    /// What it says, if findings are to be held against it.
    #[serde(default)]
    pub(crate) claim_is: Option<ClaimIs>,
    /// Name of the compared axis whose rows are tasks; the mission is the one task if there is none.
    #[serde(default)]
    pub(crate) tasks: Option<String>,
    /// Name of the compared axis whose rows are sets of actuators.
    pub(crate) sets: String,
    /// The row of that axis that is ideal: every task is flown with it.
    pub(crate) reference: String,
    /// Tasks that are flown with every set; the others are judged on what the reference was asked.
    #[serde(default)]
    pub(crate) closed_loop: Vec<String>,
    /// Most mass that a set may have.
    #[serde(default)]
    pub(crate) mass_limit_kg: Option<f64>,
    /// Most power that a set may take.
    #[serde(default)]
    pub(crate) power_limit_w: Option<f64>,
}
