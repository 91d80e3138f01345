//! The pyramid of four, random arrays beside it, and a steady push.

use proptest::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI};
use wrasse_flight::allocation::{CmgLaw, CmgSharing, Damping, Waves, cmg_rates};
use wrasse_hardware::{CMGS, ControlMomentGyro};
use wrasse_spatial::{Vec3, vec3};

/// Sine and cosine of the skew angle of 53.13°.
pub(super) const S: f64 = 0.8;
pub(super) const C: f64 = 0.6;
pub(super) const ALL: [bool; CMGS] = [true; CMGS];
pub(super) const PAGE: &str = "book/src/theory/cmg_steering.md";

/// The pyramid of momentum `h0`: faces across x, y, -x, -y, gimbal axes tilted by the skew angle.
pub(super) fn pyramid(h0: f64) -> [ControlMomentGyro<f64>; 4] {
    let cmg = |gimbal: Vec3<f64>, spin: Vec3<f64>| ControlMomentGyro {
        gimbal_axis_B: gimbal,
        spin_axis_B: spin,
        momentum: h0,
        rate_limit: 1.0,
        ..Default::default()
    };
    [
        cmg(vec3(S, 0.0, C), vec3(0.0, 1.0, 0.0)),
        cmg(vec3(0.0, S, C), vec3(-1.0, 0.0, 0.0)),
        cmg(vec3(-S, 0.0, C), vec3(0.0, -1.0, 0.0)),
        cmg(vec3(0.0, -S, C), vec3(1.0, 0.0, 0.0)),
    ]
}
pub(super) fn angles(of: [f64; 4]) -> [f64; CMGS] {
    [of[0], of[1], of[2], of[3], 0.0, 0.0, 0.0, 0.0]
}

pub(super) fn momentum(cmgs: &[ControlMomentGyro<f64>], angles: &[f64; CMGS]) -> Vec3<f64> {
    let each = cmgs.iter().zip(angles);
    each.fold(Vec3::zero(), |h, (cmg, &angle)| h + cmg.spin_axis(angle) * cmg.momentum)
}
/// k0 0.01 and μ 10.
pub(super) fn damping() -> Damping<f64> {
    Damping { k0: 0.01, fading: 10.0 }
}

pub(super) fn law(sharing: CmgSharing<f64>) -> CmgLaw<f64> {
    CmgLaw { sharing, null_gain: 0.0 }
}

/// Waves of 0.01 at a quarter of a hertz, a quarter of a turn apart.
pub(super) fn waves() -> Waves<f64> {
    Waves { height: 0.01, frequency: FRAC_PI_2, phases: [0.0, FRAC_PI_2, PI] }
}

/// What a steady command does.
pub(super) struct Push {
    pub(super) angles: [f64; CMGS],
    pub(super) law: CmgLaw<f64>,
    pub(super) time: f64,
    /// h0/s.
    pub(super) wanted: Vec3<f64>,
}

impl Push {
    pub(super) const STEP: f64 = 0.01;

    /// 0.1 h0 a second along +x.
    pub(super) fn from(start: [f64; 4], sharing: CmgSharing<f64>) -> Self {
        Self { angles: angles(start), law: law(sharing), time: 0.0, wanted: vec3(0.1, 0.0, 0.0) }
    }
    /// Momentum along x (h0).
    pub(super) fn hx(&self) -> f64 {
        momentum(&pyramid(1.0), &self.angles).x
    }
    /// One step by the midpoint.
    pub(super) fn step(&mut self) {
        let rates = |angles: &[f64; CMGS], time: f64| {
            cmg_rates(&pyramid(1.0), &ALL, &self.law, self.wanted, angles, time).values
        };
        let first = rates(&self.angles, self.time);
        let middle = std::array::from_fn(|k| self.angles[k] + 0.5 * Self::STEP * first[k]);
        let second = rates(&middle, self.time + 0.5 * Self::STEP);
        self.angles = std::array::from_fn(|k| self.angles[k] + Self::STEP * second[k]);
        self.time += Self::STEP;
    }
    /// Time (s) at which the momentum along x passes a height, within a duration.
    pub(super) fn passes(&mut self, hx: f64, duration: f64) -> Option<f64> {
        while self.time < duration {
            self.step();
            if self.hx() > hx {
                return Some(self.time);
            }
        }
        None
    }
}

/// Sines and cosines of four angles.
pub(super) fn sines(a: &[f64; CMGS]) -> ([f64; 4], [f64; 4]) {
    (std::array::from_fn(|k| a[k].sin()), std::array::from_fn(|k| a[k].cos()))
}

/// Columns of A over h0 as the product's CMGs give them.
pub(super) fn columns(a: &[f64; CMGS]) -> [Vec3<f64>; 4] {
    let cmgs = pyramid(1.0);
    std::array::from_fn(|k| cmgs[k].torque_axis(a[k]))
}

/// The null vector of four columns: each element the determinant of the other three, in turn.
pub(super) fn null_vector(a: &[f64; CMGS]) -> [f64; 4] {
    let [p, q, r, s] = columns(a);
    let det = |a: Vec3<f64>, b: Vec3<f64>, c: Vec3<f64>| a.dot(b.cross(c));
    [det(q, r, s), -det(p, r, s), det(p, q, s), -det(p, q, r)]
}

pub(super) fn any_angles() -> impl Strategy<Value = [f64; CMGS]> {
    prop::array::uniform8(-3.2..3.2)
}

pub(super) fn vector(size: f64) -> impl Strategy<Value = Vec3<f64>> {
    [-size..size, -size..size, -size..size].prop_map(Vec3::from_array)
}

/// One to eight CMGs of different sizes in general position.
pub(super) fn array() -> impl Strategy<Value = Vec<ControlMomentGyro<f64>>> {
    let long = |v: &Vec3<f64>| v.norm() > 0.2;
    let one =
        (vector(1.0).prop_filter("an axis has a length", long), vector(1.0), 5.0..50.0, 0.2..2.0);
    let one = one.prop_filter_map("the axes differ", |(gimbal, other, momentum, rate_limit)| {
        let across = gimbal.cross(other);
        (across.norm() > 0.05).then(|| ControlMomentGyro {
            gimbal_axis_B: gimbal * (1.0 / gimbal.norm()),
            spin_axis_B: across * (1.0 / across.norm()),
            momentum,
            rate_limit,
            ..Default::default()
        })
    });
    prop::collection::vec(one, 1..=CMGS)
}

pub(super) fn every_sharing() -> [CmgSharing<f64>; 3] {
    [
        CmgSharing::PseudoInverse,
        CmgSharing::SingularityRobust(damping()),
        CmgSharing::GeneralizedSingularityRobust(damping(), waves()),
    ]
}

/// Change of momentum that rates give.
pub(super) fn given(
    cmgs: &[ControlMomentGyro<f64>],
    angles: &[f64; CMGS],
    rates: &[f64; CMGS],
) -> Vec3<f64> {
    let each = cmgs.iter().zip(angles).zip(rates);
    each.fold(Vec3::zero(), |sum, ((cmg, &angle), &rate)| {
        sum + cmg.torque_axis(angle) * (cmg.momentum * rate)
    })
}
