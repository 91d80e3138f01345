//! The pyramid of four, random arrays, and what torques of wheels are in sum.

use proptest::prelude::*;
use wrasse_flight::allocation::{WheelLaw, WheelSharing};
use wrasse_hardware::{ReactionWheel, WHEELS};
use wrasse_spatial::{Sym3, Vec3, vec3};
use wrasse_testing::largest;

/// Control period (s).
pub(super) const PERIOD: f64 = 0.01;
pub(super) const ALL: [bool; WHEELS] = [true; WHEELS];
pub(super) const STILL: [f64; WHEELS] = [0.0; WHEELS];
pub(super) const BOTH: [WheelSharing; 2] = [WheelSharing::PseudoInverse, WheelSharing::MinimumPeak];

pub(super) fn law(sharing: WheelSharing) -> WheelLaw<f64> {
    WheelLaw { sharing, null_gain: 0.0 }
}

pub(super) fn wheel(axis: Vec3<f64>, torque_limit: f64, inertia: f64) -> ReactionWheel<f64> {
    let axis_B = axis * (1.0 / axis.norm());
    ReactionWheel { axis_B, inertia, torque_limit, speed_limit: 600.0, ..Default::default() }
}

/// Four equal wheels of 0.2 N·m, each axis tilted alike out of the y-z plane.
pub(super) fn pyramid() -> [ReactionWheel<f64>; 4] {
    let tilted = |y: f64, z: f64| wheel(vec3(1.0, y, z), 0.2, 0.1);
    [tilted(1.0, 1.0), tilted(-1.0, 1.0), tilted(-1.0, -1.0), tilted(1.0, -1.0)]
}

/// Torque on the wheels in sum.
pub(super) fn given(wheels: &[ReactionWheel<f64>], torques: &[f64; WHEELS]) -> Vec3<f64> {
    let each = wheels.iter().zip(torques);
    each.fold(Vec3::zero(), |sum, (wheel, &u)| sum + wheel.axis_B * u)
}

/// Largest torque against its limit.
pub(super) fn peak(wheels: &[ReactionWheel<f64>], torques: &[f64; WHEELS]) -> f64 {
    let each = wheels.iter().zip(torques);
    largest(each.map(|(wheel, u)| u.abs() / wheel.torque_limit))
}

pub(super) fn vector(size: f64) -> impl Strategy<Value = Vec3<f64>> {
    [-size..size, -size..size, -size..size].prop_map(Vec3::from_array)
}

/// Three to eight wheels of different sizes whose axes span well.
pub(super) fn array() -> impl Strategy<Value = Vec<ReactionWheel<f64>>> {
    let axis = vector(1.0).prop_filter("an axis has a length", |a| a.norm() > 0.2);
    let one =
        (axis, 0.05..1.0, 0.02..0.2).prop_map(|(axis, limit, inertia)| wheel(axis, limit, inertia));
    prop::collection::vec(one, 3..=WHEELS).prop_filter("axes span", |wheels| {
        let each = wheels.iter().map(|w| Sym3::symmetric_part(&w.axis_B.outer(w.axis_B)));
        let G = each.fold(Sym3::zero(), |sum, part| sum + part).to_mat3().rows;
        G[0].cross(G[1]).dot(G[2]) > 0.02
    })
}

pub(super) fn speeds() -> impl Strategy<Value = [f64; WHEELS]> {
    prop::array::uniform8(-550.0..550.0)
}
