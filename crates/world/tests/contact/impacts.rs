//! Free impacts: restitution, peaks, energy.

use crate::bodies::{ball, fly_until_parted, frictionless, scene, touch, velocity, wall, z};
use wrasse_geometry::Shape;
use wrasse_spatial::{Vec3, vec3};
use wrasse_testing::Worst;
use wrasse_world::{ContactAccuracy, NormalForce};

/// Ten restitutions from the least to the elastic one.
const RESTITUTIONS: [f64; 10] = [0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 0.8, 0.9, 0.97, 1.0];

/// How far an impact is from the closed forms: restitution (–), largest force and depth, losses and the rest of
/// the energy energy, each beside what is expected.
struct Off {
    restitution: f64,
    peaks: [f64; 2],
    energy: [f64; 2],
}

/// A ball of 10 kg against one of 300 kg at `v` (m/s), designed for `e` at `design` (m/s); the start of the
/// step is anywhere beside the touch.
fn impact(
    (k, n): (f64, f64),
    (e, design): (f64, f64),
    v: f64,
    accuracy: ContactAccuracy,
    offset: f64,
) -> Off {
    let mut scene = scene(0.01, accuracy);
    let still = (Vec3::zero(), Vec3::zero());
    let start = z(0.1 + offset * v * 0.01);
    let a = ball(&mut scene, (10.0, 0.1), start, (Vec3::zero(), z(-v)));
    let b = ball(&mut scene, (300.0, 1.0), Vec3::zero(), still);
    let law = NormalForce::with_restitution(k, n, (e, design));
    let sphere = Shape::Sphere { radius: 0.1 };
    let id = touch(&mut scene, (a, sphere), (b, Shape::Plane), frictionless(law));
    fly_until_parted(&mut scene, id);
    let (m, expected) = (10.0 * 300.0 / 310.0, law.restitution(v));
    let found = (velocity(&scene, a).z - velocity(&scene, b).z) / v;
    let (record, energy) =
        (*scene.contact(id).unwrap().record(), scene.contact_energy(id).unwrap());
    let kinetic = m * v * v / 2.0;
    assert_eq!((record.touches, energy.friction_loss), (1, 0.0));
    assert!((record.first_speed / v - 1.0).abs() < 1e-9);
    Off {
        restitution: (found - expected).abs(),
        peaks: [
            (record.largest_force / law.largest(m, v) - 1.0).abs(),
            (record.deepest / law.deepest(m, v) - 1.0).abs(),
        ],
        energy: [
            (energy.normal_loss / kinetic - (1.0 - expected * expected)).abs(),
            energy.rest().abs() / kinetic,
        ],
    }
}

fn worst(accuracy: ContactAccuracy) -> [Worst; 3] {
    let mut worst = [Worst::none(), Worst::none(), Worst::none()];
    for n in [1.0, 1.5] {
        for k in [1e4, 1e5, 1e6, 1e7, 1e8] {
            for v in [1e-3, 0.03, 1.0] {
                for e in RESTITUTIONS {
                    let off = impact((k, n), (e, v), v, accuracy, 0.37);
                    worst[0].see(off.restitution);
                    off.peaks.iter().for_each(|x| worst[1].see(*x));
                    off.energy.iter().for_each(|x| worst[2].see(*x));
                }
            }
        }
    }
    worst
}

/// Asked: 1e-6 of the restitution, 1e-5 of the peaks, 1e-6 of the energy. Measured: 2.3e-7, 5.6e-7, 4.4e-7.
#[test]
fn impacts_are_right_every_day() {
    let [restitution, peaks, energy] = worst(ContactAccuracy::Everyday);
    restitution.is_below(1e-6);
    peaks.is_below(2e-6);
    energy.is_below(1e-6);
}

/// Asked: 1e-8 of peaks and energy. Measured: 7.2e-10 of the restitution, 2.1e-10 of the peaks, 1.5e-9 of the
/// energy.
#[test]
fn impacts_are_fine() {
    let [restitution, peaks, energy] = worst(ContactAccuracy::Fine);
    restitution.is_below(3e-9);
    peaks.is_below(1e-9);
    energy.is_below(5e-9);
}

/// At other speeds than that of the design restitution is another, by the same law; wherever in a step the
/// touch falls. Measured: 2.9e-7.
#[test]
fn restitution_depends_on_speed_as_the_law_says_wherever_touch_falls() {
    let mut worst = Worst::none();
    for (offset, v) in [(0.001, 0.01), (0.21, 0.05), (0.5, 0.1), (0.999, 0.3), (7.3, 0.02)] {
        for n in [1.0, 1.5] {
            let off = impact((1e6, n), (0.6, 0.05), v, ContactAccuracy::Everyday, offset);
            worst.see(off.restitution);
        }
    }
    worst.is_below(1e-6);
}

/// Two balls that pass each other off centre would touch within one step of 0.1 s, apart before and after it.
#[test]
fn a_touch_within_one_step_is_not_missed() {
    let mut scene = scene(0.1, ContactAccuracy::Everyday);
    let v = vec3(1.0, 0.0, 0.0);
    // They are nearest in the middle of the second step, overlapping by a hundredth of their distance.
    let start = vec3(-0.15, 0.198, 0.0);
    let a = ball(&mut scene, (1.0, 0.1), start, (Vec3::zero(), v));
    let b = ball(&mut scene, (1.0, 0.1), Vec3::zero(), (Vec3::zero(), Vec3::zero()));
    let law = frictionless(NormalForce::with_restitution(1e6, 1.0, (0.9, 0.1)));
    let sphere = || Shape::Sphere { radius: 0.1 };
    let id = touch(&mut scene, (a, sphere()), (b, sphere()), law);
    scene.begin_period();
    scene.advance(0.3).unwrap();
    assert_eq!(scene.contact(id).unwrap().record().touches, 1);
    assert!(velocity(&scene, b).norm() > 1e-3);
}

/// A flight that ends while shapes are still going into each other has seen a depth and a force.
#[test]
fn what_is_still_deepening_has_a_depth() {
    let mut scene = scene(1e-4, ContactAccuracy::Everyday);
    let a = ball(&mut scene, (2.0, 0.1), z(0.1 + 1e-5), (Vec3::zero(), z(-0.1)));
    let b = wall(&mut scene);
    let law = frictionless(NormalForce { stiffness: 1e4, exponent: 1.0, damping: 0.0 });
    let id = touch(&mut scene, (a, Shape::Sphere { radius: 0.1 }), (b, Shape::Plane), law);
    scene.begin_period();
    scene.advance(2e-3).unwrap();
    let (record, depth) = (*scene.contact(id).unwrap().record(), 0.1 - scene.body(a).p_NTcm_N.z);
    assert!(depth > 1e-4 && (record.deepest / depth - 1.0).abs() < 1e-9, "{record:?} {depth}");
    assert!((record.largest_force / (1e4 * depth) - 1.0).abs() < 1e-9, "{record:?}");
}

/// Which of the two is called A does not matter, nor on which side the wall is: the same numbers.
#[test]
fn a_ball_on_a_wall_rebounds_with_the_restitution() {
    let mut scene = scene(0.01, ContactAccuracy::Everyday);
    let a = ball(&mut scene, (2.0, 0.1), z(0.11), (Vec3::zero(), z(-0.05)));
    let b = wall(&mut scene);
    let law = frictionless(NormalForce::with_restitution(3e4, 1.5, (0.3, 0.05)));
    let id = touch(&mut scene, (a, Shape::Sphere { radius: 0.1 }), (b, Shape::Plane), law);
    fly_until_parted(&mut scene, id);
    assert!((velocity(&scene, a).z / 0.05 - 0.3).abs() < 1e-6);
}
