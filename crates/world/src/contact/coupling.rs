//! A contact as a coupling: the force at each place that touches, and the energy books.

use super::account::{ContactEnergy, ContactRecord};
use super::friction::FrictionForce;
use super::law::ContactLaw;
use super::peak::Samples;
use crate::couplings::{Coupling, FrameMotion};
use crate::source::Source;
use std::cell::RefCell;
use wrasse_geometry::{Meeting, Patch, Shape};
use wrasse_spatial::{SpatialForce, SpatialVelocity, Vec3};

/// Where in its row the sums of a contact stand, before three numbers of the bristle of each place.
const NORMAL_LOSS: usize = 0;
const FRICTION_LOSS: usize = 1;
const WORK: usize = 2;
const SUMS: usize = 3;

/// A place of a contact.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Place {
    /// Whether it touches: changed only at a located instant.
    pub(crate) touches: bool,
    /// How it rubs, since it touches.
    pub(crate) friction: FrictionForce,
    /// Squared frequency of its spring and rate of its damper with the effective mass (1/s², 1/s).
    pub(crate) pace: (f64, f64),
    /// Inverse effective mass along the normal (1/kg).
    pub(crate) mobility: f64,
}

/// What is seen of a place at the end of a step.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Seen {
    /// (m)
    pub(crate) depth: f64,
    /// (m/s)
    pub(crate) rate: f64,
    /// How far rounding may put the depth off (m): the last bits of the positions.
    pub(crate) rounding: f64,
    /// How fast the surfaces slide (m/s).
    pub(crate) slip: f64,
    /// Of the pair's stiffness (–).
    pub(crate) share: f64,
}

impl Seen {
    /// How far beyond its touch or its parting a place is (m): above zero where it has passed it. Within the
    /// rounding of a depth the rate says which it is, so that no place touches and parts in turns.
    pub(crate) fn beyond(&self, touches: bool) -> f64 {
        let sign = if touches { -1.0 } else { 1.0 };
        let (beyond, rate) = (sign * self.depth, sign * self.rate);
        if rate > 0.0 { beyond } else { beyond - self.rounding }
    }
    /// Normal force (N).
    pub(crate) fn force(&self, law: &ContactLaw) -> f64 {
        self.share * law.normal.force(self.depth, self.rate)
    }
}

/// Contact between a shape on frame E (shape A) and a shape on frame F (shape B) of two systems.
///
/// A place that touches feels `f = n f_n + f_t` on A and `-f` on B at one point: momentum is passed on
/// whole, whatever the depth. Places begin and cease to touch at located instants; between them all is
/// smooth.
#[derive(Debug)]
pub struct Contact {
    pub(crate) patch: Patch,
    pub(crate) law: ContactLaw,
    pub(crate) places: Vec<Place>,
    pub(crate) now: Vec<Seen>,
    pub(crate) before: Vec<Seen>,
    pub(crate) record: ContactRecord,
    pub(crate) samples: Samples,
    meetings: RefCell<Vec<Meeting>>,
    pub(crate) touching: usize,
    /// Energy of what overlapped as it began to touch (J).
    pub(crate) given: f64,
}

/// What one place does.
struct Push {
    /// On A (N).
    force_A: Vec3<f64>,
    at: Vec3<f64>,
    zdot: Vec3<f64>,
    normal_loss: f64,
    friction_loss: f64,
    work: f64,
}

impl Contact {
    /// Of two shapes under a law, with about so many places where a flat lies on a flat; none where there is no
    /// rule for how they touch.
    pub fn new(A: &Shape, B: &Shape, places: usize, law: ContactLaw) -> Option<Self> {
        let patch = Patch::new(A, B, places)?;
        let count = patch.len();
        let (friction, pace) = (FrictionForce::None, (0.0, 0.0));
        let place = Place { touches: false, friction, pace, mobility: 0.0 };
        Some(Self {
            places: vec![place; count],
            now: vec![Seen::default(); count],
            before: vec![Seen::default(); count],
            record: ContactRecord::default(),
            samples: Samples::default(),
            meetings: RefCell::new(vec![]),
            touching: 0,
            given: 0.0,
            patch,
            law,
        })
    }
    /// The law.
    pub fn law(&self) -> &ContactLaw {
        &self.law
    }
    /// What was seen of it since the start.
    pub fn record(&self) -> &ContactRecord {
        &self.record
    }
    /// How many of its places touch.
    pub fn touching(&self) -> usize {
        self.touching
    }
    /// All places at these poses, one after the other.
    pub(crate) fn with_meetings<R>(
        &self,
        E: &FrameMotion,
        F: &FrameMotion,
        of: impl FnOnce(&[Meeting]) -> R,
    ) -> R {
        let mut all = self.meetings.borrow_mut();
        all.resize(self.places.len(), Meeting::default());
        self.patch.meet(&E.X_NF, &F.X_NF, &mut all);
        of(&all)
    }
    /// The point at which a place pushes: where the surfaces are, as far as each gives way.
    pub(crate) fn point(&self, m: &Meeting) -> Vec3<f64> {
        m.on_A + m.normal * (self.law.given_by_A * m.depth)
    }
    /// Depth and its rate of each place, as the frames stand and move.
    pub(crate) fn look(&mut self, E: &FrameMotion, F: &FrameMotion) {
        let mut now = std::mem::take(&mut self.now);
        self.with_meetings(E, F, |all| {
            for (seen, m) in now.iter_mut().zip(all) {
                let x = self.point(m);
                let v_rel = velocity_at(E, x) - velocity_at(F, x);
                let rate = -m.normal.dot(v_rel);
                let slip = (v_rel + m.normal * rate).norm();
                let rounding = 8.0 * f64::EPSILON * (x.norm() + m.depth.abs());
                *seen = Seen { depth: m.depth, rate, rounding, slip, share: m.share };
            }
        });
        self.now = now;
    }
    /// Both shapes are on one body now: they are as far apart as anything.
    pub(crate) fn look_away(&mut self) {
        self.now.fill(Seen { depth: f64::NEG_INFINITY, ..Seen::default() });
    }
    /// Normal force of all places together, as they were last looked at (N).
    pub(crate) fn normal_force(&self) -> f64 {
        let touching = self.places.iter().zip(&self.now).filter(|(place, _)| place.touches);
        touching.map(|(_, seen)| seen.force(&self.law)).sum()
    }
    fn push(
        &self,
        m: &Meeting,
        place: &Place,
        (E, F): (&FrameMotion, &FrameMotion),
        z: Vec3<f64>,
    ) -> Push {
        let at = self.point(m);
        let v_rel = velocity_at(E, at) - velocity_at(F, at);
        let rate = -m.normal.dot(v_rel);
        let slip = v_rel + m.normal * rate;
        let spring = m.share * self.law.normal.spring(m.depth);
        let f_n = spring * (1.0 + self.law.normal.damping * rate).max(0.0);
        let z = in_plane(z, m.normal);
        let (f_t, zdot) = place.friction.act(f_n.max(0.0), slip, z);
        let bristle = match place.friction {
            FrictionForce::ElastoPlastic { stiffness, .. }
            | FrictionForce::LuGre { stiffness, .. } => stiffness * z.dot(zdot),
            FrictionForce::None | FrictionForce::Tanh { .. } => 0.0,
        };
        Push {
            force_A: m.normal * f_n + f_t,
            at,
            zdot,
            normal_loss: (f_n - spring) * rate,
            friction_loss: -f_t.dot(slip) - bristle,
            work: f_t.dot(slip) - f_n * rate,
        }
    }
    /// Its energy.
    pub(crate) fn energy(&self, E: &FrameMotion, F: &FrameMotion, own: &[f64]) -> ContactEnergy {
        ContactEnergy {
            stored: self.stored_energy(E, F, own),
            normal_loss: own[NORMAL_LOSS],
            friction_loss: own[FRICTION_LOSS],
            work: own[WORK],
            given: self.given,
        }
    }
    /// A place ceases to touch: its bristle springs back, and what it stored is gone.
    pub(crate) fn let_go(&mut self, i: usize, row: &mut [f64]) {
        let z = bristle(row, i);
        row[FRICTION_LOSS] += self.places[i].friction.stored(z);
        row[SUMS + 3 * i..SUMS + 3 * i + 3].fill(0.0);
        self.places[i].touches = false;
        self.places[i].pace = (0.0, 0.0);
    }
}

impl Coupling for Contact {
    fn source(&self) -> Source {
        Source::Contacts
    }
    fn variables(&self) -> usize {
        SUMS + 3 * self.places.len()
    }
    fn is_idle(&self) -> bool {
        self.touching == 0
    }
    fn act(
        &self,
        E: &FrameMotion,
        F: &FrameMotion,
        own: &[f64],
        rates: &mut [f64],
    ) -> SpatialForce<f64> {
        let (R_NF, Fo) = (F.X_NF.rotation, F.X_NF.translation);
        self.with_meetings(E, F, |all| {
            let mut on_F = SpatialForce::zero();
            let touching = all.iter().zip(&self.places).enumerate().filter(|(_, (_, p))| p.touches);
            for (i, (m, place)) in touching {
                let push = self.push(m, place, (E, F), R_NF * bristle(own, i));
                on_F.force += -push.force_A;
                on_F.torque += -(push.at - Fo).cross(push.force_A);
                rates[NORMAL_LOSS] += push.normal_loss;
                rates[FRICTION_LOSS] += push.friction_loss;
                rates[WORK] += push.work;
                if place.friction.has_bristle() {
                    let zdot_F = R_NF.transpose_mul(push.zdot);
                    rates[SUMS + 3 * i..SUMS + 3 * i + 3].copy_from_slice(&zdot_F.to_array());
                }
            }
            on_F
        })
    }
    fn stored_energy(&self, E: &FrameMotion, F: &FrameMotion, own: &[f64]) -> f64 {
        if self.touching == 0 {
            return 0.0;
        }
        self.with_meetings(E, F, |all| {
            let touching = all.iter().zip(&self.places).enumerate().filter(|(_, (_, p))| p.touches);
            touching.fold(0.0, |sum, (i, (m, place))| {
                let normal = m.share * self.law.normal.stored(m.depth);
                sum + normal + place.friction.stored(bristle(own, i))
            })
        })
    }
    fn contact(&self) -> Option<&Contact> {
        Some(self)
    }
    fn contact_mut(&mut self) -> Option<&mut Contact> {
        Some(self)
    }
}

/// Velocity of the point of a frame's body that is at `x` (m/s, inertial axes).
fn velocity_at(frame: &FrameMotion, x: Vec3<f64>) -> Vec3<f64> {
    let SpatialVelocity { angular, linear } = frame.V_NF_N;
    linear + angular.cross(x - frame.X_NF.translation)
}

/// Bristle of a place in the axes of F (m).
pub(super) fn bristle(own: &[f64], i: usize) -> Vec3<f64> {
    crate::variables::vector(own, SUMS + 3 * i)
}

/// A bristle in the plane of contact, as long as it is: as the normal turns it turns along, and loses none
/// of its energy.
fn in_plane(z: Vec3<f64>, normal: Vec3<f64>) -> Vec3<f64> {
    let (length, flat) = (z.norm(), z - normal * normal.dot(z));
    let shrunk = flat.norm();
    if shrunk > 0.0 { flat * (length / shrunk) } else { flat }
}

#[cfg(test)]
mod tests {
    use super::*;
    use wrasse_spatial::vec3;

    /// Rounding puts a depth off by some 1e-16 m: a place that has parted and recedes does not touch again for
    /// that, nor does one part that has touched and goes on.
    #[test]
    fn within_rounding_the_rate_says_whether_a_place_has_passed() {
        let seen = |depth: f64, rate: f64| Seen { depth, rate, rounding: 1e-15, ..Seen::default() };
        assert!(seen(1e-16, 0.1).beyond(false) > 0.0 && seen(-1e-16, -0.1).beyond(true) > 0.0);
        assert!(seen(1e-16, -0.1).beyond(false) <= 0.0 && seen(-1e-16, 0.1).beyond(true) <= 0.0);
        assert!(seen(1e-6, -0.1).beyond(false) > 0.0 && seen(-1e-6, 0.1).beyond(true) > 0.0);
    }

    #[test]
    fn a_bristle_that_turns_along_keeps_its_length() {
        let turned = in_plane(vec3(3.0, 0.0, 4.0), vec3(0.0, 0.6, 0.8));
        assert!(
            (turned.norm() - 5.0).abs() < 1e-15 && turned.dot(vec3(0.0, 0.6, 0.8)).abs() < 1e-15
        );
        assert_eq!(in_plane(vec3(0.0, 0.0, 2.0), vec3(0.0, 0.0, 1.0)), Vec3::zero());
    }
}
