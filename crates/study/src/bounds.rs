//! A figure between two ways of steering.

use serde::Serialize;

/// A figure with pseudo-inverse steering, and with the best there is: with steering that avoids or
/// escapes singularities. The two differ for CMGs only.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Bounds<T> {
    /// With steering by the pseudo-inverse from the angles at the start.
    pub plain: T,
    /// With the best steering: what no law can better.
    pub best: T,
}

impl<T: Copy> Bounds<T> {
    /// The same for both.
    pub const fn equal(value: T) -> Self {
        Self { plain: value, best: value }
    }
    /// Both, by the same rule.
    pub fn map<U>(self, rule: impl Fn(T) -> U) -> Bounds<U> {
        Bounds { plain: rule(self.plain), best: rule(self.best) }
    }
}
