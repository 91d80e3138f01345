//! Rigid bodies that touch each other or a wall, for golden files of contact.

use serde_json::Value;
use wrasse_dynamics::{BodyId, Frame, MassProperties};
use wrasse_geometry::Shape;
use wrasse_spatial::{Pose, Quat, SpatialVelocity, Sym3, Vec3, vec3};
use wrasse_world::{
    Contact, ContactAccuracy, ContactEnergy, ContactLaw, ContactRecord, CouplingId, FreeBody,
    Scene, Stepper, SystemId,
};

/// Mass of what nothing moves (kg): it takes a speed of 1e-18 m/s for each N·s.
const WALL: f64 = 1e18;

/// Longest step while nothing touches (s).
const STEP: f64 = 1e-3;

/// Longest flight (s).
const LONGEST: f64 = 100.0;

/// Bodies in a scene of their own.
pub(super) struct Bodies {
    pub(super) scene: Scene<1>,
    wall: SystemId,
}

impl Bodies {
    /// Finely integrated, with a wall, which is nowhere yet.
    pub(super) fn fine() -> Self {
        Self::new(Stepper::Fixed { step: STEP }, ContactAccuracy::Fine)
    }
    pub(super) fn new(stepper: Stepper, accuracy: ContactAccuracy) -> Self {
        let mut scene = Scene::new(stepper);
        scene.set_contact_accuracy(accuracy);
        let I = Sym3::diagonal(WALL, WALL, WALL);
        let matter = MassProperties::from_central(WALL, Vec3::zero(), I);
        let body = FreeBody::new(matter, &Pose::identity(), &SpatialVelocity::zero());
        let wall = scene.add_body(&body);
        Self { scene, wall }
    }
    /// Contact between a shape at a point of a body, in its axes (m), and a wall with this outward normal
    /// through a point.
    pub(super) fn touch_wall(
        &mut self,
        (id, shape, at): (SystemId, Shape, Vec3<f64>),
        (through, n): (Vec3<f64>, Vec3<f64>),
        law: ContactLaw,
    ) -> CouplingId {
        let frame = |p: Vec3<f64>| Pose { translation: p, ..Pose::identity() };
        let X_wall = Pose::from_quat(from_z_to(n), through);
        let on = |X_BF| Frame { body: BodyId::Base, X_BF };
        let contact = ball_contact(&shape, &Shape::Plane, law);
        self.scene.couple((id, on(frame(at))), (self.wall, on(X_wall)), contact)
    }
    /// Contact between balls about the origins of two bodies.
    pub(super) fn touch(
        &mut self,
        a: (SystemId, f64),
        b: (SystemId, f64),
        law: ContactLaw,
    ) -> CouplingId {
        let origin = Frame { body: BodyId::Base, X_BF: Pose::identity() };
        let ball = |radius| Shape::Sphere { radius };
        let contact = ball_contact(&ball(a.1), &ball(b.1), law);
        self.scene.couple((a.0, origin), (b.0, origin), contact)
    }
    /// Flies until a contact has touched and parted; the time when it parted (s), NaN if it does not.
    pub(super) fn fly_until_parted(&mut self, id: CouplingId) -> f64 {
        while self.scene.time() < LONGEST {
            self.scene.begin_period();
            if self.scene.advance(0.01).is_err() {
                return f64::NAN;
            }
            let Some(contact) = self.scene.contact(id) else { return f64::NAN };
            if contact.record().touches > 0 && contact.touching() == 0 {
                return contact.record().last_time;
            }
        }
        f64::NAN
    }
    /// Flies up to a time (s); whether it came there.
    pub(super) fn fly_to(&mut self, time: f64) -> bool {
        let ahead = time - self.scene.time();
        self.scene.begin_period();
        ahead >= 0.0 && self.scene.advance(ahead).is_ok()
    }
    /// What is seen at the times of rows; nothing where it cannot be flown to.
    pub(super) fn fly_rows(&mut self, rows: &[Value], seen: impl Fn(&Self) -> Value) -> Vec<Value> {
        let each = rows.iter().map(|row| {
            let flown = row["t"].as_f64().is_some_and(|t| self.fly_to(t));
            if flown { seen(self) } else { Value::Null }
        });
        each.collect()
    }
    pub(super) fn record(&self, id: CouplingId) -> ContactRecord {
        self.scene.contact(id).map(|contact| *contact.record()).unwrap_or_default()
    }
    pub(super) fn energy(&self, id: CouplingId) -> ContactEnergy {
        self.scene.contact_energy(id).unwrap_or_default()
    }
    /// Velocity of a body's origin, inertial axes (m/s).
    pub(super) fn velocity(&self, id: SystemId) -> Vec3<f64> {
        let body = self.scene.body(id);
        body.pose().rotation * body.twist().linear
    }
}

/// Contact of a ball with anything: there is a rule for it.
fn ball_contact(ball: &Shape, other: &Shape, law: ContactLaw) -> Box<Contact> {
    let contact = Contact::new(ball, other, 1, law);
    Box::new(contact.unwrap_or_else(|| unreachable!("a ball touches all shapes")))
}

/// Turns the z axis into a direction.
fn from_z_to(n: Vec3<f64>) -> Quat<f64> {
    let z = vec3(0.0, 0.0, 1.0);
    let (axis, cosine) = (z.cross(n), z.dot(n));
    let sine = axis.norm();
    if sine > 1e-12 {
        return Quat::exp(axis * (sine.atan2(cosine) / sine));
    }
    if cosine > 0.0 { Quat::identity() } else { Quat::exp(vec3(std::f64::consts::PI, 0.0, 0.0)) }
}
