//! Rigid bodies that touch.

use wrasse_dynamics::{BodyId, Frame, MassProperties};
use wrasse_geometry::Shape;
use wrasse_spatial::{Pose, SpatialVelocity, Sym3, Vec3, vec3};
use wrasse_world::{
    Contact, ContactAccuracy, ContactLaw, CouplingId, FreeBody, FrictionLaw, NormalForce, Scene,
    Stepper, SystemId,
};

pub(crate) type Bodies = Scene<1>;

pub(crate) fn scene(step: f64, accuracy: ContactAccuracy) -> Bodies {
    let mut scene = Scene::new(Stepper::Fixed { step });
    scene.set_contact_accuracy(accuracy);
    scene
}

/// An even ball of this mass (kg) and radius (m) at `p` with a twist about its middle, inertial axes.
pub(crate) fn ball(
    scene: &mut Bodies,
    (mass, radius): (f64, f64),
    p: Vec3<f64>,
    (w, v): (Vec3<f64>, Vec3<f64>),
) -> SystemId {
    let I = 0.4 * mass * radius * radius;
    body(scene, mass, Sym3::diagonal(I, I, I), p, (w, v))
}

pub(crate) fn body(
    scene: &mut Bodies,
    mass: f64,
    inertia: Sym3<f64>,
    p: Vec3<f64>,
    (w, v): (Vec3<f64>, Vec3<f64>),
) -> SystemId {
    let matter = MassProperties::from_central(mass, Vec3::zero(), inertia);
    let X = Pose { translation: p, ..Pose::identity() };
    scene.add_body(&FreeBody::new(matter, &X, &SpatialVelocity::new(w, v)))
}

/// What nothing moves: its mass is 1e18 kg.
pub(crate) fn wall(scene: &mut Bodies) -> SystemId {
    let still = (Vec3::zero(), Vec3::zero());
    body(scene, 1e18, Sym3::diagonal(1e18, 1e18, 1e18), Vec3::zero(), still)
}

pub(crate) fn origin() -> Frame<f64> {
    at(Pose::identity())
}

pub(crate) fn at(X_BF: Pose<f64>) -> Frame<f64> {
    Frame { body: BodyId::Base, X_BF }
}

pub(crate) fn frictionless(normal: NormalForce) -> ContactLaw {
    ContactLaw { normal, friction: FrictionLaw::None, given_by_A: 0.5 }
}

/// A ball of this radius (m) as A, at the origin of its body, and another or a plane as B.
pub(crate) fn touch(
    scene: &mut Bodies,
    (a, A): (SystemId, Shape),
    (b, B): (SystemId, Shape),
    law: ContactLaw,
) -> CouplingId {
    scene.couple((a, origin()), (b, origin()), Box::new(Contact::new(&A, &B, 16, law).unwrap()))
}

/// Flies until a contact has parted again; at most 60 s.
pub(crate) fn fly_until_parted(scene: &mut Bodies, id: CouplingId) {
    for _ in 0..6000 {
        scene.begin_period();
        scene.advance(0.01).unwrap();
        let contact = scene.contact(id).unwrap();
        if contact.record().touches > 0 && contact.touching() == 0 {
            return;
        }
    }
    panic!("they do not part");
}

pub(crate) fn velocity(scene: &Bodies, id: SystemId) -> Vec3<f64> {
    let body = scene.body(id);
    body.pose().rotation * body.twist().linear
}

pub(crate) fn z(x: f64) -> Vec3<f64> {
    vec3(0.0, 0.0, x)
}
