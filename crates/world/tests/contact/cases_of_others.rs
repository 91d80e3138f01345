//! Cases that users of other programs reported.

use crate::bodies::{
    at, ball, body, fly_until_parted, frictionless, origin, scene, touch, velocity, wall,
};
use wrasse_geometry::Shape;
use wrasse_hardware::{Friction, Hardness, Surface};
use wrasse_spatial::{Pose, Quat, Sym3, Vec3, vec3};
use wrasse_world::{
    Bristle, BristleDamping, Contact, ContactAccuracy, ContactLaw, Curvature, FrictionLaw,
    NormalForce, law_of_pair, restitution_at,
};

fn x(x: f64) -> Vec3<f64> {
    vec3(x, 0.0, 0.0)
}

/// Projectchrono, utest_SMC_cor_normal: balls of 0.5 m and 1 kg at 1 m/s each, 2e5 Pa, 0.3. There 1e-3 is
/// asked; here 1e-6. Measured: 1.4e-7.
#[test]
fn two_balls_of_an_elastic_material_have_the_restitution_that_was_asked_for() {
    for restitution in [0.05, 0.25, 0.5, 0.75, 1.0] {
        let material = Surface {
            hardness: Hardness::Elastic { youngs_modulus: 2e5, poisson_ratio: 0.3 },
            restitution,
            restitution_speed: 2.0,
            friction: Friction::None,
        };
        let law = law_of_pair(&material, &material, Curvature::Radius(0.25)).unwrap();
        let mut scene = scene(0.01, ContactAccuracy::Everyday);
        let a = ball(&mut scene, (1.0, 0.5), x(-0.6), (Vec3::zero(), x(1.0)));
        let b = ball(&mut scene, (1.0, 0.5), x(0.6), (Vec3::zero(), x(-1.0)));
        let sphere = || Shape::Sphere { radius: 0.5 };
        let id = touch(&mut scene, (a, sphere()), (b, sphere()), law);
        fly_until_parted(&mut scene, id);
        let found = (velocity(&scene, b).x - velocity(&scene, a).x) / 2.0;
        assert!((found - restitution).abs() < 1e-6, "{restitution}: {found}");
    }
}

/// Mujoco, discussion 3404: 0.75 was asked for and 0.820 was had. Measured: off by 1.9e-7.
#[test]
fn a_restitution_of_three_quarters_is_three_quarters() {
    let mut scene = scene(0.002, ContactAccuracy::Everyday);
    let a = ball(&mut scene, (1.0, 0.1), x(-0.25), (Vec3::zero(), x(0.5)));
    let b = ball(&mut scene, (1.0, 0.1), Vec3::zero(), (Vec3::zero(), Vec3::zero()));
    let sphere = || Shape::Sphere { radius: 0.1 };
    let law = frictionless(NormalForce::with_restitution(1e5, 1.0, (0.75, 0.5)));
    let id = touch(&mut scene, (a, sphere()), (b, sphere()), law);
    fly_until_parted(&mut scene, id);
    let found = (velocity(&scene, b).x - velocity(&scene, a).x) / 0.5;
    assert!((found - 0.75).abs() < 1e-6, "{found}");
}

/// Newton, issue 3233: a ball hits two that touch. The answer of compliant balls is unique; what is expected
/// was integrated elsewhere, to the last digit that is given. Energy stays to 2e-7.
#[test]
fn a_ball_that_hits_two_that_touch_comes_back() {
    for (n, expected) in [(1.0, [-0.13026, 0.15023, 0.98003]), (1.5, [-0.07095, 0.07640, 0.99455])]
    {
        let mut scene = scene(0.01, ContactAccuracy::Everyday);
        let still = (Vec3::zero(), Vec3::zero());
        let balls = [
            ball(&mut scene, (1.0, 0.1), x(-0.25), (Vec3::zero(), x(1.0))),
            ball(&mut scene, (1.0, 0.1), Vec3::zero(), still),
            ball(&mut scene, (1.0, 0.1), x(0.2), still),
        ];
        let law = frictionless(NormalForce { stiffness: 1e6, exponent: n, damping: 0.0 });
        let sphere = || Shape::Sphere { radius: 0.1 };
        let first = touch(&mut scene, (balls[0], sphere()), (balls[1], sphere()), law);
        touch(&mut scene, (balls[1], sphere()), (balls[2], sphere()), law);
        fly_until_parted(&mut scene, first);
        for (id, wanted) in balls.iter().zip(expected) {
            let found = velocity(&scene, *id).x;
            assert!((found - wanted).abs() < 6e-6, "n {n}: {found}, not {wanted}");
        }
        let energy = balls.iter().map(|id| 0.5 * velocity(&scene, *id).x.powi(2)).sum::<f64>();
        assert!((energy / 0.5 - 1.0).abs() < 1e-6, "{energy}");
    }
}

/// Drake, issue 18241: two stiff boxes in free space had thirty times their energy afterwards. With
/// `d v = 0.125` the restitution is 0.923031 at the speed at which they meet; the energy is never above that
/// of the start, at any step. Measured: speeds within 2e-7 of those of the law.
#[test]
fn two_stiff_boxes_do_not_gain_energy_at_any_step() {
    let inertia = Sym3::diagonal(0.1, 0.1, 0.1);
    for step in [1e-3, 1e-2, 0.1] {
        let mut scene = scene(step, ContactAccuracy::Everyday);
        let still = (Vec3::zero(), Vec3::zero());
        let y = |y: f64| vec3(0.0, y, 0.0);
        let a = body(&mut scene, 1.0, inertia, y(-0.18), (Vec3::zero(), y(0.1)));
        let b = body(&mut scene, 1.0, inertia, Vec3::zero(), still);
        let shapes = [
            Shape::Box { edges: vec3(0.075, 0.075, 0.05), rounding: 0.0 },
            Shape::Box { edges: vec3(0.05, 0.02, 0.01), rounding: 0.0 },
        ];
        // The long side of the small box looks at the other one; its middle is 80 mm from its body's.
        let turned = Quat::exp(vec3(0.0, 0.0, core::f64::consts::FRAC_PI_2));
        let law = ContactLaw {
            normal: NormalForce { stiffness: 1e8, exponent: 1.0, damping: 1.25 },
            friction: FrictionLaw::ElastoPlastic(Bristle {
                mu: 0.5,
                stiffness: 8e7,
                damping: BristleDamping::Ratio(1.0),
            }),
            given_by_A: 0.5,
        };
        let contact = Contact::new(&shapes[0], &shapes[1], 16, law).unwrap();
        let on_b = at(Pose::from_quat(turned, y(-0.08)));
        let id = scene.couple((a, origin()), (b, on_b), Box::new(contact));
        let start = scene.account().energy;
        for _ in 0..2000 {
            scene.begin_period();
            scene.advance(0.01).unwrap();
            let now = scene.account().energy;
            let stored = scene.contact_energy(id).unwrap().stored;
            assert!(now + stored <= start * (1.0 + 1e-12), "step {step}: {now} J + {stored} J");
        }
        let (va, vb) = (velocity(&scene, a).y, velocity(&scene, b).y);
        let e = restitution_at(1.25 * 0.1);
        assert!((e - 0.923_031).abs() < 5e-7);
        assert!(((vb - va) / 0.1 - e).abs() < 1e-6, "{va} {vb}");
        assert!((va - 0.003_848_4).abs() < 1e-7 && (vb - 0.096_151_6).abs() < 1e-7, "{va} {vb}");
    }
}

/// Mujoco, issue 2630: four points of a box did not share what a pair has. Cubes of 0.1 m and 1 to 3 kg pressed
/// in by 2 to 10 mm at up to 1 m/s feel `k d (1 + c v)`, however many points.
#[test]
fn the_force_of_a_cube_does_not_depend_on_the_number_of_points() {
    let cube = || Shape::Box { edges: vec3(0.1, 0.1, 0.1), rounding: 0.0 };
    for places in [4, 16, 64, 256] {
        for (mass, depth, v) in [(1.0, 0.002, 0.0), (2.0, 0.005, 0.4), (3.0, 0.01, 1.0)] {
            let mut scene = scene(0.01, ContactAccuracy::Everyday);
            let inertia = Sym3::diagonal(1.0, 1.0, 1.0);
            let start = vec3(0.0, 0.0, 0.05 - depth);
            let a = body(&mut scene, mass, inertia, start, (Vec3::zero(), vec3(0.0, 0.0, -v)));
            let b = wall(&mut scene);
            let law = frictionless(NormalForce { stiffness: 1e5, exponent: 1.0, damping: 0.5 });
            let contact = Contact::new(&cube(), &Shape::Plane, places, law).unwrap();
            scene.couple((a, origin()), (b, origin()), Box::new(contact));
            scene.begin_period();
            // What overlaps at the start touches from the first step on.
            scene.advance(1e-9).unwrap();
            let push = scene.dynamics(a).nudot.base.linear.z * mass;
            let expected = 1e5 * depth * (1.0 + 0.5 * v);
            assert!((push / expected - 1.0).abs() < 1e-5, "{places}: {push} N, {expected} N");
        }
    }
}
