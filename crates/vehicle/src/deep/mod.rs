//! A second look at a vehicle that can be used: what hardly any vehicle is, whether its numbers agree
//! with each other, and how well its equations are conditioned. One file for each check.

mod condition;
mod density;
mod finding;
mod parts;
mod shape;
mod sides;
mod size;
mod symmetry;
mod units;

pub use finding::{DeepCheck, Finding, FindingKind, FindingSeverity, Fine, Place};

use crate::vehicle::Vehicle;

impl Vehicle {
    /// What its numbers say of each other: units, shapes, sizes, densities, mirrored arms, and the
    /// condition of the mass matrix. The file can be used whatever is found.
    pub fn deep_check(&self) -> DeepCheck {
        let parts = parts::parts(self);
        let (of_units, units_fine) = units::unit_findings(self, &parts);
        let slipped: Vec<String> = of_units.iter().map(|found| found.subject.clone()).collect();
        let mut check = DeepCheck::default();
        check.take(of_units, units_fine);
        for (found, fine) in [
            shape::shape_findings(&parts),
            size::size_findings(&parts),
            density::density_findings(&parts),
        ] {
            // A wrong unit is the cause of what follows from it: it is told once.
            let other = found.into_iter().filter(|found| !slipped.contains(&found.subject));
            check.take(other.collect(), fine);
        }
        let (found, fine) = symmetry::symmetry_findings(self);
        check.take(found, fine);
        let (found, fine) = condition::condition_findings(self);
        check.take(found, fine);
        check
    }
}
