//! Events that depend on the state: found to the last bits of time, once, in any stepper.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]
#![allow(clippy::unwrap_used, reason = "a test may stop where it finds nothing")]

use std::sync::{Arc, Mutex};
use wrasse_dynamics::{BodyId, Frame, MassProperties};
use wrasse_spatial::{Pose, SpatialVelocity, Sym3, Vec3, vec3};
use wrasse_world::{Bushing, Crossing, Event, FreeBody, Scene, Stepper, SystemId};

const STEPPERS: [Stepper; 2] =
    [Stepper::Fixed { step: 0.07 }, Stepper::Adaptive { tolerance: 1e-10 }];

fn ball(x: f64, v: f64) -> FreeBody {
    let matter = MassProperties::from_central(2.0, Vec3::zero(), Sym3::diagonal(0.1, 0.1, 0.1));
    let X = Pose { translation: vec3(x, 0.0, 0.0), ..Pose::identity() };
    FreeBody::new(matter, &X, &SpatialVelocity::new(Vec3::zero(), vec3(v, 0.0, 0.0)))
}

/// Times (s) at which the ball passes 1 m.
fn passes(stepper: Stepper, crossing: Crossing, v: f64) -> Vec<f64> {
    let mut scene: Scene<1> = Scene::new(stepper);
    let id = scene.add_body(&ball(0.0, v));
    let times = Arc::new(Mutex::new(vec![]));
    let noted = times.clone();
    scene.add_event(Event {
        value: Box::new(move |scene| scene.centre_of_mass(id).x - 1.0),
        crossing,
        then: Box::new(move |scene| noted.lock().unwrap().push(scene.time_within_period())),
    });
    for _ in 0..30 {
        scene.begin_period();
        scene.advance(0.1).unwrap();
    }
    std::mem::take(&mut times.lock().unwrap())
}

/// At 0.7 m/s: 1/0.7 s. Measured 2e-16 s off.
#[test]
fn a_crossing_is_found_to_the_last_bits_of_time_and_once() {
    for stepper in STEPPERS {
        let found = passes(stepper, Crossing::Rising, 0.7);
        assert_eq!(found.len(), 1, "{found:?}");
        assert!((found[0] - 1.0 / 0.7).abs() < 1e-15, "{:e} off", found[0] - 1.0 / 0.7);
        assert_eq!(passes(stepper, Crossing::Any, 0.7), found);
        assert_eq!(passes(stepper, Crossing::Falling, 0.7), [0.0; 0]);
        assert_eq!(passes(stepper, Crossing::Rising, 0.2), [0.0; 0], "it does not get there");
    }
}

/// Balls that are coupled as they meet, and let go where the bushing pulls no more: momentum stays.
#[test]
fn what_happens_may_couple_and_uncouple_systems() {
    for stepper in STEPPERS {
        let mut scene: Scene<1> = Scene::new(stepper);
        let [a, b] = [ball(0.0, 0.5), ball(1.0, -0.3)].map(|body| scene.add_body(&body));
        let origin = Frame { body: BodyId::Base, X_BF: Pose::identity() };
        let gap =
            move |scene: &Scene<1>| scene.centre_of_mass(b).x - scene.centre_of_mass(a).x - 0.2;
        let spring = Bushing {
            stiffness: vec3(40.0, 40.0, 40.0),
            damping: Vec3::zero(),
            turning_stiffness: vec3(1.0, 1.0, 1.0),
            turning_damping: Vec3::zero(),
        };
        // The spring is at rest at 0.2 m.
        let hook =
            Frame { X_BF: Pose { translation: vec3(0.2, 0.0, 0.0), ..Pose::identity() }, ..origin };
        let held = Arc::new(Mutex::new(None));
        let (met, parted) = (held.clone(), held.clone());
        scene.add_event(Event {
            value: Box::new(gap),
            crossing: Crossing::Falling,
            then: Box::new(move |scene| {
                *met.lock().unwrap() = Some(scene.couple((a, hook), (b, origin), Box::new(spring)));
            }),
        });
        scene.add_event(Event {
            value: Box::new(gap),
            crossing: Crossing::Rising,
            then: Box::new(move |scene| {
                scene.uncouple(parted.lock().unwrap().take().expect("they have met"));
            }),
        });
        let mut ledger = scene.open_ledger();
        let speeds = |scene: &Scene<1>| [a, b].map(|id| speed(scene, id));
        for _ in 0..40 {
            scene.begin_period();
            scene.advance(0.1).unwrap();
            scene.update_ledger(&mut ledger);
        }
        assert!(held.lock().unwrap().is_none(), "they are still together");
        // Equal balls exchange their speeds: an elastic impact. To the order of the stepper.
        let [va, vb] = speeds(&scene);
        assert!((va + 0.3).abs() < 1e-4 && (vb - 0.5).abs() < 1e-4, "{va} {vb}");
        assert!(ledger.worst[1] < 1e-14, "{:e} N·s", ledger.worst[1]);
    }
}

/// An event may look at states and forces, and add a system: it flies on from there.
#[test]
fn what_happens_may_add_a_system() {
    for stepper in STEPPERS {
        let mut scene: Scene<1> = Scene::new(stepper);
        let parent = scene.add_body(&ball(0.0, 0.7));
        scene.add_event(Event {
            value: Box::new(move |scene| {
                let still = scene.dynamics(parent).nudot.base.linear.norm();
                scene.state(parent).X_NB.translation.x + still - 1.0
            }),
            crossing: Crossing::Rising,
            then: Box::new(|scene| {
                scene.add_body(&ball(1.0, 0.2));
            }),
        });
        for _ in 0..30 {
            scene.begin_period();
            scene.advance(0.1).unwrap();
        }
        let child = scene.systems().last().unwrap();
        assert_ne!(child, parent);
        // From 1 m at 0.2 m/s, since 1/0.7 s.
        let expected = 1.0 + 0.2 * (3.0 - 1.0 / 0.7);
        let off = scene.state(child).X_NB.translation.x - expected;
        assert!(off.abs() < 1e-14, "{off:e}");
        assert_eq!(scene.dynamics(child).nudot.base.linear.norm(), 0.0);
    }
}

fn speed(scene: &Scene<1>, id: SystemId) -> f64 {
    scene.momentum(id).0.x / 2.0
}
