//! Cases that users of other programs reported.

use crate::bodies::{ball, fly_until_parted, frictionless, scene, touch, velocity};
use wrasse_geometry::Shape;
use wrasse_hardware::{Friction, Hardness, Surface};
use wrasse_spatial::{Vec3, vec3};
use wrasse_world::{ContactAccuracy, Curvature, NormalForce, law_of_pair};

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
    for (n, expected) in
        [(1.0, [-0.13026, 0.15023, 0.98003]), (1.5, [-0.07095, 0.07640, 0.99455])]
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
