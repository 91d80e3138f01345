//! The attitude law on a rigid body: the closed loop is the oscillator that its numbers name.

use std::f64::consts::PI;
use wrasse_flight::{Tuning, attitude_acceleration};
use wrasse_spatial::{Quat, Sym3, Vec3, turned_by, vec3};
use wrasse_testing::random_robot::Random;
use wrasse_testing::{Worst, larger};

const BANDWIDTH: f64 = 0.3;

fn tuning(attitude_damping: f64) -> Tuning<f64> {
    Tuning {
        period: 0.01,
        tool_gain: 0.0,
        joint_bandwidth: 0.0,
        joint_damping: 1.0,
        attitude_bandwidth: BANDWIDTH,
        attitude_damping,
    }
}

/// Inertia in general position (kg·m²).
fn inertia() -> Sym3<f64> {
    let R = Quat::exp(vec3(0.4, -0.9, 0.3)).to_matrix();
    R.congruence(Sym3::diagonal(640.0, 725.0, 980.0))
}

/// A rigid body under the law, towards the attitude `quat_ND`.
struct Body {
    quat_NB: Quat<f64>,
    w_NB_B: Vec3<f64>,
    quat_ND: Quat<f64>,
    tuning: Tuning<f64>,
}

impl Body {
    /// Turned by `r` (rad) from the attitude that is wanted, and at rest.
    fn turned(r: Vec3<f64>, damping: f64) -> Self {
        let quat_ND = Quat::exp(vec3(0.7, 1.1, -0.4));
        let quat_NB = quat_ND * Quat::exp(r);
        Self { quat_NB, w_NB_B: Vec3::zero(), quat_ND, tuning: tuning(damping) }
    }
    /// Rotation vector from the wanted attitude (rad).
    fn off(&self) -> Vec3<f64> {
        (self.quat_ND.conjugate() * self.quat_NB).log()
    }
    fn angular_acceleration(&self, quat_NB: &Quat<f64>, w: Vec3<f64>) -> Vec3<f64> {
        let I = inertia();
        let torque = I * attitude_acceleration(&self.tuning, quat_NB, w, &self.quat_ND);
        I.solve(torque - w.cross(I * w))
    }
    /// One step by the midpoint.
    fn step(&mut self, h: f64) {
        let half = 0.5 * h;
        let w = self.w_NB_B + self.angular_acceleration(&self.quat_NB, self.w_NB_B) * half;
        let quat = turned_by(self.quat_NB, self.w_NB_B * half);
        let wdot = self.angular_acceleration(&quat, w);
        self.quat_NB = turned_by(self.quat_NB, w * h);
        self.w_NB_B += wdot * h;
    }
}

/// `θ = θ₀ e^{-ζωt} (cos ω_d t + ζω/ω_d sin ω_d t)` about any axis, with the inertia divided out. The
/// gyroscopic torque is θ₀ of the others, and steps of the midpoint leave (ωh)²: measured 2.8e-6 of
/// θ₀.
#[test]
fn a_small_error_dies_out_as_the_damped_oscillator_of_its_bandwidth() {
    let mut worst = Worst::none();
    for zeta in [0.2, 0.7] {
        let r = vec3(1e-5, -2e-5, 0.5e-5);
        let (mut body, h) = (Body::turned(r, zeta), 0.01);
        for k in 1..=3000 {
            body.step(h);
            let t = h * f64::from(k);
            let damped = BANDWIDTH * (1.0 - zeta * zeta).sqrt();
            let (decay, phase) = ((-zeta * BANDWIDTH * t).exp(), damped * t);
            let left = decay * (phase.cos() + zeta * BANDWIDTH / damped * phase.sin());
            worst.see((body.off() - r * left).norm() / r.norm());
        }
    }
    worst.is_below(1e-5);
}

/// Zero crossings are π/ω_d apart, and from one swing to the next the other way it shrinks by
/// `e^{-πζ/√(1-ζ²)}`. Measured 3.0e-7 and 2.9e-6 of them.
#[test]
fn frequency_and_decay_are_the_named_ones() {
    let (zeta, h) = (0.2_f64, 0.001);
    let mut body = Body::turned(vec3(1e-3, 0.0, 0.0), zeta);
    let (mut crossings, mut swings) = (vec![], vec![0.0_f64]);
    for k in 0..40_000 {
        let before = body.off().x;
        body.step(h);
        let after = body.off().x;
        if before * after < 0.0 {
            crossings.push(h * (f64::from(k) + before / (before - after)));
            swings.push(0.0);
        }
        let swing = swings.last_mut().unwrap();
        *swing = larger(*swing, after.abs());
    }
    let root = (1.0 - zeta * zeta).sqrt();
    let (mut period, mut ratio) = (Worst::none(), Worst::none());
    for pair in crossings.windows(2) {
        period.see(((pair[1] - pair[0]) * BANDWIDTH * root / PI - 1.0).abs());
    }
    // The last swing is cut off.
    for pair in swings[..swings.len() - 1].windows(2) {
        ratio.see((pair[1] / pair[0] / (-PI * zeta / root).exp() - 1.0).abs());
    }
    assert!(crossings.len() >= 3, "measured 3: {}", crossings.len());
    period.is_below(1e-5);
    ratio.is_below(1e-5);
}

/// The first push is back, against the turn: measured 5.1e-17 rad/s² off. After 60 s, of 3.3 s each,
/// 5.6e-7 of the error is left.
#[test]
fn any_error_is_pushed_back_and_settles() {
    let (mut first, mut last, mut random) = (Worst::none(), Worst::none(), Random(12));
    for _ in 0..20 {
        let r = random.vector(1.7);
        let mut body = Body::turned(r, 1.0);
        let push = body.angular_acceleration(&body.quat_NB, body.w_NB_B);
        let expected = r * (-2.0 * BANDWIDTH * BANDWIDTH * (0.5 * r.norm()).sin() / r.norm());
        first.see((push - expected).norm());
        let mut farthest = 0.0_f64;
        for _ in 0..6000 {
            body.step(0.01);
            farthest = larger(farthest, body.off().norm());
        }
        assert!(farthest <= r.norm(), "it goes the long way: {farthest} of {}", r.norm());
        last.see(body.off().norm() / r.norm());
    }
    first.is_below(1e-15);
    last.is_below(1e-5);
}

/// A rate alone is braked by `2ζω` of it. Measured 4.4e-16 N·m.
#[test]
fn a_turning_body_is_braked() {
    let (quat, w) = (Quat::exp(vec3(0.3, 0.2, -0.1)), vec3(0.02, -0.01, 0.03));
    let torque = inertia() * attitude_acceleration(&tuning(0.7), &quat, w, &quat);
    let expected = inertia() * w * (-2.0 * 0.7 * BANDWIDTH);
    let mut worst = Worst::none();
    worst.see((torque - expected).norm());
    worst.is_below(1e-14);
}

/// A quaternion and its negative are the same attitude, wherever they come from.
#[test]
fn the_sign_of_a_quaternion_does_not_matter() {
    let minus = |q: Quat<f64>| Quat::new(-q.w, -q.x, -q.y, -q.z);
    let mut random = Random(13);
    for _ in 0..50 {
        let (a, b) = (Quat::exp(random.vector(1.8)), Quat::exp(random.vector(1.8)));
        let w = random.vector(0.1);
        let torque = |a, b| attitude_acceleration(&tuning(1.0), &a, w, &b);
        assert_eq!(torque(a, b), torque(minus(a), b));
        assert_eq!(torque(a, b), torque(a, minus(b)));
    }
}

/// Turned by 200° one way it is 160° the other way. Measured 2.8e-17 N·m.
#[test]
fn it_turns_the_shorter_way() {
    let axis = vec3(0.6, 0.0, 0.8);
    let push = |degrees: f64| {
        let quat_ND = Quat::exp(axis * degrees.to_radians());
        attitude_acceleration(&tuning(1.0), &Quat::identity(), Vec3::zero(), &quat_ND).dot(axis)
    };
    assert!(push(160.0) > 0.0 && push(200.0) < 0.0, "{} {}", push(160.0), push(200.0));
    let mut worst = Worst::none();
    worst.see((push(160.0) + push(200.0)).abs());
    worst.is_below(1e-15);
}
