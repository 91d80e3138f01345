//! What the terminal and the report say alike: numbers, names and sentences, as plain text.

pub(crate) mod cases;
pub(crate) mod comparison;
pub(crate) mod ledger;
pub(crate) mod numbers;
pub(crate) mod sweep;
