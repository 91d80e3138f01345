//! Friction in a scene: what slides stops, what is below the limit is held, and the books close.

use crate::bodies::{Bodies, ball, body, scene, touch, velocity, wall};
use wrasse_dynamics::{BodyId, PerBody};
use wrasse_geometry::Shape;
use wrasse_spatial::{SpatialForce, Sym3, Vec3, vec3};
use wrasse_world::{
    AppliedWrench, Bristle, BristleDamping, ContactAccuracy, ContactLaw, CouplingId, FrictionLaw,
    NormalForce, SystemId,
};

const MU: f64 = 0.3;
const MASS: f64 = 2.0;
const PRESSED: f64 = 10.0;
const STIFFNESS: f64 = 1e4;

/// A point of 2 kg that 10 N press on a wall, at a speed along x and under a load there (N).
fn block(speed: f64, load: f64) -> (Bodies, SystemId, CouplingId) {
    let mut scene = scene(0.01, ContactAccuracy::Everyday);
    let start = vec3(0.0, 0.0, -PRESSED / STIFFNESS);
    let inertia = Sym3::diagonal(1.0, 1.0, 1.0);
    let moves = (Vec3::zero(), vec3(speed, 0.0, 0.0));
    let a = body(&mut scene, MASS, inertia, start, moves);
    let b = wall(&mut scene);
    let course = move |_, k: &wrasse_dynamics::Kinematics<'_, f64, 1>| {
        let mut on = PerBody::filled(SpatialForce::zero());
        let R_NB = k.X_NB(BodyId::Base).rotation;
        let force = R_NB.transpose_mul(vec3(load, 0.0, -PRESSED));
        on.base = SpatialForce::new(Vec3::zero(), force);
        on
    };
    scene.apply(a, AppliedWrench::new(Box::new(course), &[]));
    let law = ContactLaw {
        normal: NormalForce { stiffness: STIFFNESS, exponent: 1.0, damping: 0.0 },
        friction: FrictionLaw::ElastoPlastic(Bristle {
            mu: MU,
            stiffness: 8e3,
            damping: BristleDamping::Ratio(1.0),
        }),
        given_by_A: 0.0,
    };
    let id = touch(&mut scene, (a, Shape::Sphere { radius: 0.0 }), (b, Shape::Plane), law);
    (scene, a, id)
}

fn fly(scene: &mut Bodies, seconds: u32) {
    for _ in 0..100 * seconds {
        scene.begin_period();
        scene.advance(0.01).unwrap();
    }
}

/// `m v²/(2 μ f_n)`, but for the bristle: it gives way by up to `μ f_n/σ₀` = 0.4 mm. What is gone from the
/// motion is booked as the loss of friction. Measured: 5e-8 of it.
#[test]
fn a_block_slides_as_far_as_coulomb_says_and_its_energy_is_booked() {
    let (mut scene, a, id) = block(0.2, 0.0);
    fly(&mut scene, 3);
    let (x, kinetic) = (scene.body(a).pose().translation.x, 0.5 * MASS * 0.2 * 0.2);
    let coulomb = MASS * 0.2 * 0.2 / (2.0 * MU * PRESSED);
    assert!((x - coulomb).abs() < 4e-4, "{x} {coulomb}");
    assert!(velocity(&scene, a).norm() < 1e-9);
    let energy = scene.contact_energy(id).unwrap();
    assert!((energy.friction_loss / kinetic - 1.0).abs() < 1e-6, "{energy:?}");
    assert!(energy.rest().abs() < 1e-6 * kinetic, "{energy:?}");
}

/// Below the limit of 3 N a load is held where `F/σ₀` puts it (2.5 N: put on at once, the damper bears some
/// of it before the spring does); above it the block goes on as Coulomb says.
#[test]
fn what_is_below_the_limit_is_held_and_what_is_above_is_not() {
    let (mut scene, a, id) = block(0.0, 2.5);
    fly(&mut scene, 60);
    // What rests has a depth and a force as well, though neither ever falls.
    let record = *scene.contact(id).unwrap().record();
    assert!((record.deepest / (PRESSED / STIFFNESS) - 1.0).abs() < 1e-9, "{record:?}");
    assert!((record.largest_force / PRESSED - 1.0).abs() < 1e-9, "{record:?}");
    let x = scene.body(a).pose().translation.x;
    assert!((x / (2.5 / 8e3) - 1.0).abs() < 1e-6, "{x}");
    let (mut scene, a, _) = block(0.0, 3.1);
    fly(&mut scene, 10);
    let v = velocity(&scene, a).x;
    assert!((v - 0.1 / MASS * 10.0).abs() < 0.01, "{v}");
}

/// A ball of 0.1 m pressed in by 10 mm rolls on a radius of 90 mm where it is the ball that gives way, of 100 mm
/// where it is the wall: it loses `1/(1 + m r²/I)` of its speed until it rolls. Measured: 2e-7 of the speed.
#[test]
fn a_ball_rolls_on_the_radius_that_is_left_of_it() {
    for (given_by_A, radius) in [(1.0, 0.09), (0.5, 0.095), (0.0, 0.1)] {
        let mut scene = scene(0.01, ContactAccuracy::Everyday);
        let moves = (Vec3::zero(), vec3(0.1, 0.0, 0.0));
        let a = ball(&mut scene, (1.0, 0.1), vec3(0.0, 0.0, 0.09), moves);
        let b = wall(&mut scene);
        let course = |_, k: &wrasse_dynamics::Kinematics<'_, f64, 1>| {
            let mut on = PerBody::filled(SpatialForce::zero());
            let R_NB = k.X_NB(BodyId::Base).rotation;
            let force = R_NB.transpose_mul(vec3(0.0, 0.0, -10.0));
            on.base = SpatialForce::new(Vec3::zero(), force);
            on
        };
        scene.apply(a, AppliedWrench::new(Box::new(course), &[]));
        let bristle = Bristle { mu: 0.3, stiffness: 1e4, damping: BristleDamping::Ratio(1.0) };
        let law = ContactLaw {
            normal: NormalForce { stiffness: 1e3, exponent: 1.0, damping: 0.0 },
            friction: FrictionLaw::ElastoPlastic(bristle),
            given_by_A,
        };
        touch(&mut scene, (a, Shape::Sphere { radius: 0.1 }), (b, Shape::Plane), law);
        fly(&mut scene, 5);
        let lost = 1.0 / (1.0 + radius * radius / (0.4 * 0.1 * 0.1));
        let v = velocity(&scene, a).x;
        assert!((v - 0.1 * (1.0 - lost)).abs() < 1e-6, "{given_by_A}: {v}");
        let spin = scene.body(a).twist().angular.norm();
        assert!((v / radius - spin).abs() < 1e-5, "{given_by_A}: {v} {spin}");
    }
}
