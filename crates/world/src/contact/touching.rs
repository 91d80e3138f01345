//! When contacts begin and cease: looking at gaps, locating the instant, and what changes then.

use super::account::ContactEvent;
use super::coupling::Contact;
use crate::advance::NonFinite;
use crate::couplings::FrameMotion;
use crate::scene::{CouplingId, Scene, SystemId};
use wrasse_dynamics::Frame;
use wrasse_spatial::{Mat3, Vec3, vec3};

/// How finely contacts are integrated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ContactAccuracy {
    /// Restitution to 1e-6, forces to 1e-5.
    #[default]
    Everyday,
    /// Shorter steps, graded near touch and parting.
    Fine,
}

impl ContactAccuracy {
    /// Steps per radian of the fastest contact's oscillation.
    pub(crate) fn share_of_radian(self) -> f64 {
        match self {
            Self::Everyday => 0.1,
            Self::Fine => 0.00625,
        }
    }
    /// How long a step may be beside the time since touch or until parting, and how short at most beside one
    /// in the midst of contact (–).
    pub(crate) fn grading(self) -> (f64, f64) {
        match self {
            Self::Everyday => (0.5, 0.02),
            Self::Fine => (0.125, 1e-5),
        }
    }
}

/// What becomes of contacts in a scene.
#[derive(Debug, Default)]
pub(crate) struct Touching {
    pub(crate) accuracy: ContactAccuracy,
    pub(crate) events: Vec<ContactEvent>,
    /// Whether any coupling is a contact.
    pub(crate) any: bool,
    /// Longest step while anything touches (s): none where nothing does.
    pub(crate) longest: Option<f64>,
    /// When the last touch began (s).
    pub(crate) since: f64,
}

/// An instant is located to this share of a step.
const INSTANT: f64 = 1e-9;

impl<const J: usize> Scene<J> {
    pub(crate) fn has_contacts(&self) -> bool {
        self.touching.any
    }
    /// How finely contacts are integrated from now on.
    pub fn set_contact_accuracy(&mut self, accuracy: ContactAccuracy) {
        self.touching.accuracy = accuracy;
    }
    /// A contact.
    pub fn contact(&self, id: CouplingId) -> Option<&Contact> {
        self.couplings.get(id.0)?.as_ref()?.by.contact()
    }
    /// Energy of a contact (J).
    pub fn contact_energy(&self, id: CouplingId) -> Option<super::ContactEnergy> {
        let coupled = self.couplings.get(id.0)?.as_ref()?;
        let contact = coupled.by.contact()?;
        let [E, F] = [coupled.E, coupled.F].map(|side| self.motion_of(side.system, &side.frame));
        Some(contact.energy(&E, &F, &coupled.row))
    }
    /// The bristle of a place of a contact, in the axes of its second frame (m).
    pub fn bristle(&self, id: CouplingId, place: usize) -> Option<Vec3<f64>> {
        let coupled = self.couplings.get(id.0)?.as_ref()?;
        let contact = coupled.by.contact()?;
        (place < contact.places.len()).then(|| super::coupling::bristle(&coupled.row, place))
    }
    /// Touches and partings since they were last asked for, in order.
    pub fn take_contact_events(&mut self) -> Vec<ContactEvent> {
        std::mem::take(&mut self.touching.events)
    }
    /// The longest step that contacts allow now (s), where anything touches.
    pub fn contact_step(&self) -> Option<f64> {
        self.touching.longest
    }
    /// How a frame stands and moves now.
    fn motion_of(&self, id: SystemId, frame: &Frame<f64>) -> FrameMotion {
        self.with_kinematics(id, |k| FrameMotion { X_NF: k.pose(frame), V_NF_N: k.velocity(frame) })
    }

    /// Depths and rates of all contacts, `t` (s) into the set-points.
    pub(crate) fn look_at_contacts(&mut self, t: f64) {
        let mut places = self.places.take().unwrap_or_default();
        let mut couplings = std::mem::take(&mut self.couplings);
        let zeros = std::mem::take(&mut places.zeros);
        for (i, system) in self.systems.iter().enumerate() {
            if let Some(system) = system {
                system.stand(&zeros[..system.variables.len()], t, places.of(i));
            }
        }
        places.zeros = zeros;
        for coupled in couplings.iter_mut().flatten() {
            let (E, F, within) = (coupled.E, coupled.F, coupled.is_within_a_body());
            let Some(contact) = coupled.by.contact_mut() else { continue };
            if within {
                contact.look_away();
                continue;
            }
            let [E, F] =
                [E, F].map(|side| self.frame_motion(&mut places, side.system, &side.frame));
            contact.look(&E, &F);
        }
        self.couplings = couplings;
        self.places.set(Some(places));
    }

    /// Whether a place has passed its touch or parting, as last looked at.
    pub(crate) fn contacts_passed(&self) -> bool {
        self.passed() > 0.0
    }

    fn contacts(&self) -> impl Iterator<Item = &Contact> {
        self.couplings.iter().flatten().filter_map(|coupled| coupled.by.contact())
    }
    fn contacts_mut(&mut self) -> impl Iterator<Item = &mut Contact> {
        self.couplings.iter_mut().flatten().filter_map(|coupled| coupled.by.contact_mut())
    }

    /// Keep what is seen now as what was seen before the coming step.
    pub(crate) fn keep_contacts(&mut self) {
        self.contacts_mut().for_each(|contact| contact.before.clone_from(&contact.now));
    }

    /// How far beyond its touch or its parting the farthest place is, as last looked at (m): above zero
    /// where one has passed it.
    fn passed(&self) -> f64 {
        let each = self.contacts().flat_map(|contact| contact.places.iter().zip(&contact.now));
        each.fold(f64::NEG_INFINITY, |most, (place, seen)| most.max(seen.beyond(place.touches)))
    }

    /// After a step of `h` (s) from `t0` that was accepted and looked at: go back to the first touch or
    /// parting in it, if there is any. How long the step has become is returned, and whether anything
    /// changes at its end.
    pub(crate) fn stop_at_contacts(
        &mut self,
        (t0, h): (f64, f64),
        step: &dyn Fn(&mut Self, f64, f64) -> Result<(), NonFinite>,
    ) -> Result<(f64, bool), NonFinite> {
        let (mut low, mut high) = (0.0, h);
        let mut above = self.passed();
        if above <= 0.0 {
            return Ok((h, false));
        }
        let mut guess = self.first_crossing(high);
        let mut below: Option<f64> = None;
        for turn in 0..100 {
            if high - low <= INSTANT * h {
                break;
            }
            let inside = guess.clamp(low + 0.01 * (high - low), high - 1e-3 * (high - low));
            self.step_and_look(t0, inside, step)?;
            let found = self.passed();
            if found > 0.0 {
                (high, above) = (inside, found);
            } else {
                (low, below) = (inside, Some(found));
            }
            // By the chord, with its point a little beyond the crossing; every third time by halves.
            guess = match below {
                Some(below) if turn % 3 != 2 && above > below => {
                    let chord = low - below * (high - low) / (above - below);
                    chord + (0.05 * (high - low)).min(INSTANT * h)
                }
                _ => 0.5 * (low + high),
            };
        }
        self.step_and_look(t0, high, step)?;
        Ok((high, true))
    }

    fn step_and_look(
        &mut self,
        t0: f64,
        h: f64,
        step: &dyn Fn(&mut Self, f64, f64) -> Result<(), NonFinite>,
    ) -> Result<(), NonFinite> {
        self.return_to_start_of_step();
        step(self, t0, h)?;
        self.look_at_contacts(t0 + h);
        Ok(())
    }

    /// A first guess at the first crossing, by the rates at both ends (s into the step).
    fn first_crossing(&self, high: f64) -> f64 {
        let mut first = high;
        for contact in self.contacts() {
            for (place, (from, to)) in
                contact.places.iter().zip(contact.before.iter().zip(&contact.now))
            {
                let sign = if place.touches { -1.0 } else { 1.0 };
                let (beyond, rate) = (sign * to.depth, sign * to.rate);
                if beyond > 0.0 && rate > 0.0 && sign * from.depth <= 0.0 {
                    first = first.min((high - beyond / rate).max(0.0));
                }
            }
        }
        first
    }

    /// Places that have passed their touch or parting begin or cease to touch, at `t` (s into the
    /// set-points).
    pub(crate) fn switch_contacts(&mut self, t: f64) {
        let time = self.clock.period_start + t;
        let mut touched = false;
        for number in 0..self.couplings.len() {
            let Some(coupled) = self.couplings[number].as_mut() else { continue };
            let Some(contact) = coupled.by.contact_mut() else { continue };
            let (was, speed) = (contact.touching, contact.fastest());
            for i in 0..contact.places.len() {
                let touches = contact.places[i].touches;
                if contact.now[i].beyond(touches) <= 0.0 {
                    continue;
                }
                if touches {
                    contact.let_go(i, &mut coupled.row);
                } else {
                    contact.places[i].touches = true;
                    let seen = contact.now[i];
                    contact.given += seen.share * contact.law.normal.stored(seen.depth);
                    touched = true;
                }
            }
            contact.touching = contact.places.iter().filter(|place| place.touches).count();
            let touches = contact.touching > 0;
            if touches == (was > 0) {
                continue;
            }
            contact.record.changed(touches, time, speed);
            contact.samples.clear();
            self.touching.events.push(ContactEvent { time, coupling: number, touches, speed });
        }
        if touched {
            self.touching.since = time;
        }
        self.pace_contacts();
    }

    /// Contacts whose shapes are on one body since a grasp let go of all places.
    pub(crate) fn part_within_bodies(&mut self) {
        let time = self.time_within_period();
        for coupled in self.couplings.iter_mut().flatten().filter(|c| c.is_within_a_body()) {
            let Some(contact) = coupled.by.contact_mut() else { continue };
            for i in 0..contact.places.len() {
                if contact.places[i].touches {
                    contact.let_go(i, &mut coupled.row);
                }
            }
            if std::mem::take(&mut contact.touching) > 0 {
                contact.record.changed(false, time, 0.0);
            }
        }
    }

    /// Effective masses at all places that touch, and the longest step that they allow.
    pub(crate) fn pace_contacts(&mut self) {
        let mut sum = (0.0, 0.0);
        for number in 0..self.couplings.len() {
            let touching = self.couplings[number].as_ref().and_then(|c| c.by.contact());
            if touching.is_none_or(|contact| contact.touching == 0) {
                continue;
            }
            let found = self.mobilities(number);
            let Some(coupled) = self.couplings[number].as_mut() else { continue };
            let Some(contact) = coupled.by.contact_mut() else { continue };
            for (i, normal, W) in found {
                contact.pace(i, normal, &W);
            }
            let paces = contact.places.iter().filter(|p| p.touches).map(|p| p.pace);
            sum = paces.fold(sum, |sum, pace| (sum.0 + pace.0, sum.1 + pace.1));
        }
        let fastest = sum.0.sqrt() + sum.1;
        let share = self.touching.accuracy.share_of_radian();
        self.touching.longest = (fastest > 0.0).then(|| share / fastest);
    }

    /// Of the places of a contact that touch: number, normal, and the inverse effective mass (1/kg) at their
    /// point.
    fn mobilities(&self, number: usize) -> Vec<(usize, Vec3<f64>, Mat3<f64>)> {
        let Some(coupled) = &self.couplings[number] else { return vec![] };
        let Some(contact) = coupled.by.contact() else { return vec![] };
        let [E, F] = [coupled.E, coupled.F].map(|side| self.motion_of(side.system, &side.frame));
        let points = contact.with_meetings(&E, &F, |all| {
            let touching = contact.places.iter().zip(all).enumerate();
            let touching = touching.filter(|(_, (place, _))| place.touches);
            touching.map(|(i, (_, m))| (i, m.normal, contact.point(m))).collect::<Vec<_>>()
        });
        let each = points.into_iter().map(|(i, normal, x)| {
            let sides = [coupled.E, coupled.F];
            let W = sides.map(|side| self.mobility(side.system, side.frame.body, x));
            (i, normal, W[0] + W[1])
        });
        each.collect()
    }
}

impl super::account::ContactRecord {
    fn changed(&mut self, touches: bool, time: f64, speed: f64) {
        if touches {
            if self.touches == 0 {
                (self.first_time, self.first_speed) = (time, speed);
            }
            self.touches += 1;
            self.last_time = time;
        } else {
            self.duration += time - self.last_time;
            self.last_time = time;
        }
    }
}

impl Contact {
    /// Fastest approach of its places that are about to touch or part (m/s).
    fn fastest(&self) -> f64 {
        let each = self.places.iter().zip(&self.now);
        let passed = each.filter(|(place, seen)| seen.beyond(place.touches) > 0.0);
        passed.fold(
            0.0,
            |most: f64, (_, seen)| {
                if seen.rate.abs() > most.abs() { seen.rate } else { most }
            },
        )
    }

    /// How fast a place is: of its spring and its damper with the effective mass there.
    fn pace(&mut self, i: usize, normal: Vec3<f64>, W: &Mat3<f64>) {
        let seen = self.now[i];
        let along = normal.dot(*W * normal);
        let across = most_mobile_across(normal, W);
        let law = self.law.normal;
        let mass = 1.0 / (along * seen.share);
        let begins = self.places[i].pace == (0.0, 0.0);
        let depth = seen.depth.max(law.deepest(mass, seen.rate.max(0.0)));
        let tangent = seen.share * law.tangent(depth);
        let damper = law.damping * seen.share * law.spring(depth) * along;
        let place = &mut self.places[i];
        place.mobility = along;
        if begins {
            place.friction = self.law.friction.at_place(seen.share, 1.0 / across);
        }
        let normal = seen.force(&self.law).max(seen.share * law.spring(depth));
        let (bristle, creep) = place.friction.pace(across, normal, seen.slip);
        place.pace = (tangent * along + bristle, damper + creep);
    }
}

/// The largest inverse effective mass (1/kg) of all directions along a surface.
fn most_mobile_across(normal: Vec3<f64>, W: &Mat3<f64>) -> f64 {
    let other = if normal.x.abs() < 0.5 { vec3(1.0, 0.0, 0.0) } else { vec3(0.0, 1.0, 0.0) };
    let s = normal.cross(other);
    let s = s * (1.0 / s.norm());
    let t = normal.cross(s);
    let (a, b, c) = (s.dot(*W * s), t.dot(*W * t), s.dot(*W * t));
    0.5 * (a + b) + (0.25 * (a - b) * (a - b) + c * c).sqrt()
}
