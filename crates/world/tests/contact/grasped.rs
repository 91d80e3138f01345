//! Contacts of a payload while it is held, and after it is let go.

use crate::bodies::{
    at, ball, fly_until_parted, frictionless, origin, scene, touch, velocity, wall, z,
};
use wrasse_geometry::Shape;
use wrasse_spatial::{Pose, Vec3};
use wrasse_world::{Contact, ContactAccuracy, GripOffset, NormalForce};

const ANY: GripOffset = GripOffset {
    distance: f64::INFINITY,
    angle: f64::INFINITY,
    angular_speed: f64::INFINITY,
    linear_speed: f64::INFINITY,
};

/// A ball of 1 kg in the grip of a body of 10 kg hits a wall as 11 kg do; let go, it goes on as they do, and its
/// contacts are its own again: it hits as 1 kg does. Its contact with the body that holds it is none meanwhile.
#[test]
fn a_payload_takes_its_contacts_along() {
    let mut scene = scene(0.01, ContactAccuracy::Everyday);
    let moves = (Vec3::zero(), z(-0.1));
    let holder = ball(&mut scene, (10.0, 0.2), z(0.3), moves);
    let payload = ball(&mut scene, (1.0, 0.1), z(0.11), moves);
    let still = wall(&mut scene);
    let normal = NormalForce::with_restitution(1e5, 1.0, (1.0, 0.1));
    let small = || Shape::Sphere { radius: 0.1 };
    let id = touch(&mut scene, (payload, small()), (still, Shape::Plane), frictionless(normal));
    // They overlap by 10 mm where they are.
    let large = Shape::Sphere { radius: 0.1 };
    let between = Contact::new(&large, &small(), 1, frictionless(normal)).unwrap();
    let between = scene.couple((holder, origin()), (payload, origin()), Box::new(between));
    let grip = at(Pose { translation: z(-0.19), ..Pose::identity() });
    let (held, _) = scene.grasp(holder, &grip, payload, &ANY).unwrap();
    fly_until_parted(&mut scene, id);
    let largest = scene.contact(id).unwrap().record().largest_force;
    assert!((largest / normal.largest(11.0, 0.1) - 1.0).abs() < 1e-5, "{largest} N");
    assert_eq!(scene.contact(between).unwrap().record().touches, 0);
    assert!((velocity(&scene, holder).z - 0.1).abs() < 1e-6);
    scene.uncouple(between);
    let payload = scene.release(holder, held);
    assert!((velocity(&scene, payload) - z(0.1)).norm() < 1e-6);
    let second = wall(&mut scene);
    let facing_down = at(Pose::from_quat(
        wrasse_spatial::Quat::exp(wrasse_spatial::vec3(core::f64::consts::PI, 0.0, 0.0)),
        z(scene.body(payload).pose().translation.z + 0.11),
    ));
    let law = frictionless(normal);
    let contact = Contact::new(&small(), &Shape::Plane, 1, law).unwrap();
    let other = scene.couple((payload, origin()), (second, facing_down), Box::new(contact));
    fly_until_parted(&mut scene, other);
    let largest = scene.contact(other).unwrap().record().largest_force;
    assert!((largest / normal.largest(1.0, 0.1) - 1.0).abs() < 1e-5, "{largest} N");
    // Thrown back, it hits the first wall again, as one kilogram.
    let touches = scene.contact(id).unwrap().record().touches;
    for _ in 0..200 {
        scene.begin_period();
        scene.advance(0.01).unwrap();
    }
    assert!(scene.contact(id).unwrap().record().touches > touches);
    assert!(velocity(&scene, payload).z > 0.0);
}
