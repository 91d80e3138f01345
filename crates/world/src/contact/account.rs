//! What a contact has done: its energy, and what is to be told of it.

/// Energy of a contact since the start (J).
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct ContactEnergy {
    /// Stored now, along the normal and in the bristles.
    pub stored: f64,
    /// Dissipated along the normal.
    pub normal_loss: f64,
    /// Dissipated by friction.
    pub friction_loss: f64,
    /// Work on the bodies: what is stored and dissipated, taken from them.
    pub work: f64,
    /// Stored as it began to touch: nothing but rounding, unless shapes overlapped then.
    pub given: f64,
}

impl ContactEnergy {
    /// What its own books do not explain (J).
    pub fn rest(&self) -> f64 {
        self.work + self.stored + self.normal_loss + self.friction_loss - self.given
    }
}

/// What was seen of a contact since the start.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct ContactRecord {
    /// How often the pair began to touch.
    pub touches: u32,
    /// How long it touched, all together (s).
    pub duration: f64,
    /// Largest normal force of all places together (N).
    pub largest_force: f64,
    /// Largest depth of a place (m).
    pub deepest: f64,
    /// Speed at which it touched first, along the normal (m/s).
    pub first_speed: f64,
    /// When it touched first (s).
    pub first_time: f64,
    /// When it was last let go (s).
    pub last_time: f64,
    /// Shortest step while it touched (s).
    pub shortest_step: f64,
}

/// A touch or a parting of a pair.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactEvent {
    /// When (s).
    pub time: f64,
    /// Number of the coupling.
    pub coupling: usize,
    /// Whether they touch from now on.
    pub touches: bool,
    /// Approach along the normal (m/s); negative as they part.
    pub speed: f64,
}
