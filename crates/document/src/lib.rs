//! A user's file, its positions, and complaints that point at them.

mod complaint;

pub use complaint::{Complaint, Severity, Source};
