//! Momentum and energy through many impacts with friction.

use crate::bodies::{at, ball, body, scene};
use wrasse_geometry::Shape;
use wrasse_spatial::{Pose, Quat, Sym3, Vec3, vec3};
use wrasse_world::{
    Bristle, BristleDamping, Contact, ContactAccuracy, ContactLaw, FrictionLaw, NormalForce,
};

/// A ball that rattles between two plates of one body, spinning and rubbing, for 1e5 steps and more.
/// Measured: 9e-16 of the linear and 2.4e-15 of the angular momentum that the ball had gained or lost, where
/// 1e-13 is asked; the books of the contacts explain what energy is gone to 4e-9 of the whole.
#[test]
fn momentum_stays_to_the_last_bits_over_a_hundred_thousand_steps() {
    let mut scene = scene(4e-4, ContactAccuracy::Everyday);
    let inner = ball(
        &mut scene,
        (2.0, 0.1),
        vec3(0.02, 0.01, 0.03),
        (vec3(3.0, -2.0, 5.0), vec3(0.03, 0.02, 0.4)),
    );
    let plates = body(
        &mut scene,
        5.0,
        Sym3::diagonal(0.4, 0.5, 0.6),
        Vec3::zero(),
        (vec3(0.02, 0.01, 0.03), vec3(-0.01, 0.02, 0.0)),
    );
    let law = ContactLaw {
        normal: NormalForce { stiffness: 1e6, exponent: 1.0, damping: 0.0 },
        friction: FrictionLaw::ElastoPlastic(Bristle {
            mu: 0.2,
            stiffness: 8e5,
            damping: BristleDamping::Ratio(1.0),
        }),
        given_by_A: 0.3,
    };
    let upside_down = Quat::exp(vec3(core::f64::consts::PI, 0.0, 0.0));
    let ids = [
        Pose { translation: vec3(0.0, 0.0, -0.15), ..Pose::identity() },
        Pose::from_quat(upside_down, vec3(0.0, 0.0, 0.15)),
    ]
    .map(|X| {
        let contact = Contact::new(&Shape::Sphere { radius: 0.1 }, &Shape::Plane, 1, law).unwrap();
        scene.couple((inner, at(Pose::identity())), (plates, at(X)), Box::new(contact))
    });
    let start = scene.account();
    let (mut worst, mut passed) = ([0.0_f64; 2], [0.0_f64; 2]);
    let own = |scene: &crate::bodies::Bodies| scene.momentum(inner);
    let before = own(&scene);
    for _ in 0..4000 {
        scene.begin_period();
        scene.advance(0.01).unwrap();
        let (now, ball) = (scene.account(), own(&scene));
        let off = [(now.linear - start.linear).norm(), (now.angular - start.angular).norm()];
        let moved = [(ball.0 - before.0).norm(), (ball.1 - before.1).norm()];
        for i in 0..2 {
            worst[i] = worst[i].max(off[i]);
            passed[i] = passed[i].max(moved[i]);
        }
    }
    let energy = ids.map(|id| scene.contact_energy(id).unwrap());
    let touches = ids.map(|id| scene.contact(id).unwrap().record().touches);
    let lost = start.energy - scene.account().energy;
    let booked: f64 = energy.iter().map(|e| e.stored + e.normal_loss + e.friction_loss).sum();
    assert!(touches.iter().all(|n| *n > 50), "{touches:?}");
    for i in 0..2 {
        assert!(worst[i] < 1e-13 * passed[i], "{worst:?} of {passed:?}");
    }
    assert!(lost > 0.05 * start.energy);
    assert!((lost - booked).abs() < 1e-7 * start.energy, "{lost} J lost, {booked} J booked");
}
