//! The variables of a system, listed once: increments, error norms, checks and names follow from the
//! list.

use std::ops::Range;
use wrasse_spatial::Vec3;

/// Where the variables of a system stand in its row of numbers.
///
/// The first three are the rotation vector of the base since the start of a step (rad): in the state
/// itself the attitude is a quaternion, and they are zero.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Variables {
    joints: usize,
    /// How many of the joints are the robot's own.
    own: usize,
    /// Those of each effector.
    effectors: Vec<Range<usize>>,
    names: Vec<String>,
}

impl Variables {
    /// Of a system with so many joints, the first of them its `own`, and with effectors whose variables
    /// have these names.
    pub(crate) fn new(joints: usize, own: usize, effectors: &[Vec<String>]) -> Self {
        let mut all = Self { joints, own, effectors: vec![], names: vec![] };
        let three = |name: &str| vec![name.to_owned(); 3];
        all.names.extend(three("attitude of the base"));
        for _ in ["position", "rate"] {
            all.names.extend((0..own).map(|j| format!("position or rate of joint {j}")));
            all.names.extend((own..joints).map(|_| "swing of the propellant".to_owned()));
        }
        for name in
            ["centre of mass", "linear momentum", "angular momentum", "impulse of the actuator"]
        {
            all.names.extend(three(name));
        }
        for names in effectors {
            let first = all.names.len();
            all.names.extend(names.iter().cloned());
            all.effectors.push(first..all.names.len());
        }
        all
    }
    /// How many numbers they are.
    pub(crate) fn len(&self) -> usize {
        self.names.len()
    }
    /// Joint positions.
    pub(crate) fn q(&self) -> Range<usize> {
        3..3 + self.joints
    }
    /// Joint rates.
    pub(crate) fn v(&self) -> Range<usize> {
        3 + self.joints..3 + 2 * self.joints
    }
    /// Positions and rates.
    pub(crate) fn joints(&self) -> Range<usize> {
        self.q().start..self.v().end
    }
    fn vector(&self, number: usize) -> usize {
        3 + 2 * self.joints + 3 * number
    }
    /// Centre of mass, inertial axes (m).
    pub(crate) fn centre_of_mass(&self) -> usize {
        self.vector(0)
    }
    /// Linear momentum, inertial axes (N·s).
    pub(crate) fn linear(&self) -> usize {
        self.vector(1)
    }
    /// Angular momentum about the origin of N, inertial axes (N·m·s).
    pub(crate) fn angular(&self) -> usize {
        self.vector(2)
    }
    /// Angular impulse that the ideal attitude actuator gave, inertial axes (N·m·s).
    pub(crate) fn given(&self) -> usize {
        self.vector(3)
    }
    /// Those of an effector.
    pub(crate) fn effector(&self, number: usize) -> Range<usize> {
        self.effectors[number].clone()
    }
    /// What the number at a place is, and of which of its own joints.
    pub(crate) fn name(&self, place: usize) -> (&str, Option<usize>) {
        let joint = self.q().chain(self.v()).position(|at| at == place);
        let joint = joint.map(|j| j % self.joints.max(1)).filter(|j| *j < self.own);
        (&self.names[place], joint)
    }
}

/// The vector that begins at a place of a row.
pub(crate) fn vector(row: &[f64], at: usize) -> Vec3<f64> {
    Vec3::from_array([row[at], row[at + 1], row[at + 2]])
}

/// Put a vector at a place of a row.
pub(crate) fn put_vector(row: &mut [f64], at: usize, v: Vec3<f64>) {
    row[at..at + 3].copy_from_slice(&v.to_array());
}
