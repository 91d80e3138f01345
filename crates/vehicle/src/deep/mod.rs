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

#[cfg(test)]
mod tests {
    use super::parts::parts;
    use crate::catalogue;
    use crate::check::{angle_between, long_axis};

    /// What the bounds on shapes are stated with: the extremes of the catalogue.
    #[test]
    fn bounds_on_shapes_are_clear_of_the_catalogue() {
        let (mut least, mut farthest, mut widest) = (f64::INFINITY, 0.0_f64, 0.0_f64);
        for entry in catalogue() {
            let vehicle = entry.read().expect("the catalogue reads");
            for part in parts(&vehicle).iter().filter(|part| !part.own.is_empty()) {
                let solid = part.own.solid_axes().expect("a solid");
                let even = solid.iter().map(|axis| axis.gyration).fold(0.0, f64::max);
                least = least.min(part.gyration() / even);
                let reach = part.own.farthest_from(part.matter.p_cm);
                farthest = farthest.max(part.gyration() / reach);
                let long = long_axis(&solid, 2.0).zip(long_axis(&part.axes, 2.0));
                if let Some((shape, matter)) = long {
                    let angle = angle_between(shape, matter).to_degrees();
                    widest = widest.max(angle);
                }
            }
        }
        assert!(least > 0.6, "measured 0.69: {least}");
        assert!(farthest < 1.25, "measured 1.19: {farthest}");
        assert!(widest < 5.0, "measured 2.6 deg: {widest}");
    }
}
