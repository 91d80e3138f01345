//! What every reader hands over: named links and joints with the places they were read from. One
//! step behind all readers checks that they are a physically possible tree and builds the robot.

use crate::findings::SourceFiles;
use crate::provenance::Provenance;
use crate::vehicle::{GraspBounds, ShapeKind};
use std::collections::BTreeMap;
use std::ops::Range;
use wrasse_dynamics::JointKind;
use wrasse_hardware::JointLimits;
use wrasse_spatial::{Pose, Sym3, Vec3};

/// The links and joints of a vehicle, of one file or of several.
#[derive(Debug, Clone, Default)]
pub(crate) struct Assembly {
    /// The files that places are seen in.
    pub(crate) files: SourceFiles,
    pub(crate) links: Vec<Link>,
    pub(crate) joints: Vec<AssemblyJoint>,
    /// What is drawn of the links.
    pub(crate) outlines: Vec<Outline>,
    /// The links that are tools, with how well a grip must lie in them.
    pub(crate) tools: Vec<(String, GraspBounds)>,
    /// Named positions of joints, as far as they are given (rad or m).
    pub(crate) postures: Vec<(String, BTreeMap<String, f64>)>,
    /// Where the numbers come from.
    pub(crate) provenance: Vec<Provenance>,
}

/// The outline of a link, in link axes.
#[derive(Debug, Clone)]
pub(crate) struct Outline {
    pub(crate) link: String,
    pub(crate) X_LF: Pose<f64>,
    pub(crate) kind: ShapeKind,
}

/// A link as its file gives it.
#[derive(Debug, Clone)]
pub(crate) struct Link {
    /// Name, and where it stands in the file.
    pub(crate) name: String,
    pub(crate) at: Range<usize>,
    /// Mass properties; `None` for a massless frame.
    pub(crate) matter: Option<Matter>,
}

/// Mass properties of one link.
#[derive(Debug, Clone)]
pub(crate) struct Matter {
    /// Mass (kg), and where it stands.
    pub(crate) mass: f64,
    pub(crate) mass_at: Range<usize>,
    /// Centre of mass in link axes (m).
    pub(crate) p_cm: Vec3<f64>,
    /// Inertia about the centre of mass, in link axes (kg·m²), and where it stands.
    pub(crate) inertia: Sym3<f64>,
    pub(crate) inertia_at: Range<usize>,
    /// How far the inertia may be from what was meant, by the digits that are written.
    pub(crate) rounding: Rounding,
    /// The file's reason for mass properties that cannot be.
    pub(crate) accept_nonphysical: Option<Acceptance>,
}

/// Why mass properties that no rigid body has are used all the same.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Acceptance {
    /// In the words of the file.
    pub(crate) reason: String,
    /// Whether it was said of this link, and not of all links of a file.
    pub(crate) of_this: bool,
}

/// How far a tensor may be from the one that was meant: half a unit in the last digit of each element.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Rounding {
    /// Most that a principal moment can be off (kg·m²): the largest sum of a row of half units.
    pub(crate) moment: f64,
    /// Most that the sum of the principal moments can be off (kg·m²).
    pub(crate) trace: f64,
}

impl Rounding {
    /// Of a tensor whose elements are written with these half units (kg·m²), in any axes.
    ///
    /// # Source
    /// Weyl's inequality: no eigenvalue moves by more than the norm of the perturbation, and no norm
    /// exceeds the largest sum of a row.
    fn of(half: Sym3<f64>) -> Self {
        let rows =
            [half.xx + half.xy + half.xz, half.xy + half.yy + half.yz, half.xz + half.yz + half.zz];
        let moment = rows.into_iter().fold(0.0, f64::max);
        Self { moment, trace: half.xx + half.yy + half.zz }
    }
    /// Of a tensor whose elements xx, xy, xz, yy, yz, zz are written so.
    pub(crate) fn of_written(written: [&str; 6]) -> Self {
        let [xx, xy, xz, yy, yz, zz] = half_units(written);
        Self::of(Sym3 { xx, xy, xz, yy, yz, zz })
    }
    /// Of the sum of two tensors.
    pub(crate) fn and(self, other: Self) -> Self {
        Self { moment: self.moment + other.moment, trace: self.trace + other.trace }
    }
    /// Most that the largest principal moment less the two others can be off (kg·m²).
    pub(crate) fn of_triangle(self) -> f64 {
        2.0 * self.moment + self.trace
    }
}

/// Half a unit in the last digit of each of six elements of a tensor, as they are written.
///
/// A file that writes 0.42 beside 0.5 means 0.50: decimals that are zero are often left out. So the
/// elements of one tensor have as many decimals as that one of them which has most; those with an
/// exponent among themselves. What is zero, and a tensor without any decimals, is taken to be exact.
fn half_units(written: [&str; 6]) -> [f64; 6] {
    let parts = written.map(|number| {
        let (mantissa, exponent) = match number.split_once(['e', 'E']) {
            Some((mantissa, exponent)) => (mantissa, exponent.parse::<i32>().ok()),
            None => (number, None),
        };
        let decimals = mantissa.split_once('.').map_or("", |(_, decimals)| decimals);
        let digits = decimals.chars().filter(char::is_ascii_digit).count();
        (
            i32::try_from(digits).unwrap_or(0),
            exponent,
            mantissa.contains(|c| ('1'..='9').contains(&c)),
        )
    });
    let most = |scientific: bool| {
        let alike = parts.iter().filter(|(_, exponent, _)| exponent.is_some() == scientific);
        alike.map(|(digits, ..)| *digits).max().unwrap_or(0)
    };
    parts.map(|(_, exponent, is_not_zero)| match most(exponent.is_some()) {
        digits if digits > 0 && is_not_zero => {
            0.5 * 10f64.powi(exponent.unwrap_or(0).saturating_sub(digits))
        }
        _ => 0.0,
    })
}

/// A joint as its file gives it.
#[derive(Debug, Clone)]
pub(crate) struct AssemblyJoint {
    pub(crate) name: String,
    pub(crate) at: Range<usize>,
    /// Names of parent and child link, and where they stand.
    pub(crate) parent: String,
    pub(crate) parent_at: Range<usize>,
    pub(crate) child: String,
    pub(crate) child_at: Range<usize>,
    /// `None` for a fixed joint.
    pub(crate) kind: Option<JointKind>,
    /// `X_PC` at zero travel.
    pub(crate) X_PC: Pose<f64>,
    /// Axis in child axes; any length but zero.
    pub(crate) axis: Vec3<f64>,
    pub(crate) axis_at: Range<usize>,
    pub(crate) limits: JointLimits<f64>,
    pub(crate) limits_at: Range<usize>,
    /// The joint that it follows, if it has no drive of its own.
    pub(crate) mimic: Option<Mimic>,
}

/// A joint that follows another one: `q = ratio × q of the leader + offset`.
#[derive(Debug, Clone)]
pub(crate) struct Mimic {
    /// Name of the joint that is followed, and where it stands.
    pub(crate) leader: String,
    pub(crate) at: Range<usize>,
    /// Travel per travel of the leader (–, rad/m or m/rad).
    pub(crate) ratio: f64,
    /// Travel when the leader is at zero (rad or m).
    pub(crate) offset: f64,
}

impl Assembly {
    /// Puts all of another assembly behind this one; its places move with its files.
    pub(crate) fn append(&mut self, mut other: Self) {
        let by = self.files.append(&other.files);
        other.links.iter_mut().for_each(|link| link.move_by(by));
        other.joints.iter_mut().for_each(|joint| joint.move_by(by));
        self.links.append(&mut other.links);
        self.joints.append(&mut other.joints);
        self.outlines.append(&mut other.outlines);
        self.tools.append(&mut other.tools);
        self.postures.append(&mut other.postures);
        self.provenance.append(&mut other.provenance);
    }
}

impl Assembly {
    /// Puts a prefix before every name.
    pub(crate) fn put_before_names(&mut self, prefix: &str) {
        let put = |name: &mut String| {
            // A name that is missing has had its complaint.
            if !name.is_empty() {
                name.insert_str(0, prefix);
            }
        };
        self.links.iter_mut().for_each(|link| put(&mut link.name));
        for joint in &mut self.joints {
            [&mut joint.name, &mut joint.parent, &mut joint.child].into_iter().for_each(put);
            joint.mimic.iter_mut().for_each(|mimic| put(&mut mimic.leader));
        }
        self.outlines.iter_mut().for_each(|outline| put(&mut outline.link));
        self.tools.iter_mut().for_each(|(name, _)| put(name));
        for (name, positions) in &mut self.postures {
            put(name);
            let prefixed = |(joint, q): (String, f64)| (format!("{prefix}{joint}"), q);
            *positions = std::mem::take(positions).into_iter().map(prefixed).collect();
        }
        self.provenance.iter_mut().for_each(|row| row.of.insert_str(0, prefix));
    }
}

fn moved(range: &mut Range<usize>, by: usize) {
    *range = range.start + by..range.end + by;
}

impl Link {
    fn move_by(&mut self, by: usize) {
        moved(&mut self.at, by);
        if let Some(matter) = &mut self.matter {
            moved(&mut matter.mass_at, by);
            moved(&mut matter.inertia_at, by);
        }
    }
}

impl AssemblyJoint {
    fn move_by(&mut self, by: usize) {
        let places = [
            &mut self.at,
            &mut self.parent_at,
            &mut self.child_at,
            &mut self.axis_at,
            &mut self.limits_at,
        ];
        for place in places {
            moved(place, by);
        }
        if let Some(mimic) = &mut self.mimic {
            moved(&mut mimic.at, by);
        }
    }
    /// Where it is when it does not move, if it is fixed at this travel (rad or m).
    pub(crate) fn fixed_at(&mut self, q: f64) {
        // An axis of no length has its complaint; at zero it is not asked for.
        if let Some(kind) = self.kind.take().filter(|_| q != 0.0) {
            let zero = wrasse_dynamics::BodyId::Base;
            let joint = wrasse_dynamics::Joint::new(zero, kind, self.X_PC, self.axis);
            self.X_PC = joint.X_PB(q);
        }
        self.limits = JointLimits::default();
        self.mimic = None;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_a_unit_is_of_the_last_decimal_that_a_tensor_is_written_with() {
        for (written, expected) in [
            // Decimals that are left out are zero.
            (["0.8333", "0", "0.0", "3.33", "0", "4"], [5e-5, 0.0, 0.0, 5e-5, 0.0, 5e-5]),
            (["10", "0", "0", "11", "0", "12"], [0.0; 6]),
            (["1.50e-3", "0", "0", "2.5E2", "0", "7e0"], [5e-6, 0.0, 0.0, 0.5, 0.0, 5e-3]),
        ] {
            for (found, expected) in half_units(written).into_iter().zip(expected) {
                assert!((found - expected).abs() <= 1e-12 * expected, "{written:?}: {found}");
            }
        }
    }

    #[test]
    fn no_moment_of_a_rounded_tensor_is_further_off_than_its_rounding() {
        let half = Sym3 { xx: 0.05, yy: 0.05, zz: 0.05, xy: 0.05, xz: 0.05, yz: 0.05 };
        // All elements off by half a unit: the largest moment of that is 3 × 0.05.
        let rounding = Rounding::of(half);
        assert!((rounding.moment - 0.15).abs() < 1e-15 && (rounding.trace - 0.15).abs() < 1e-15);
    }
}
