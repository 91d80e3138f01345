//! The ATLAS-class servicer with a 500 kg cube in its grip, as the catalogue has it, built by hand.
#![allow(dead_code, reason = "each test binary uses its part")]

use wrasse_dynamics::{BodyId, Frame, Joint, JointKind, MassProperties, Robot, State};
use wrasse_spatial::{Pose, Sym3, Vec3, vec3};

/// Joints of the arm.
pub(crate) const J: usize = 7;
/// The posture `sideways_300mm` (deg).
pub(crate) const SIDEWAYS_300MM_DEG: [f64; J] = [
    10.310_339_413,
    -35.907_341_878,
    -34.307_016_688,
    107.791_590_573,
    -19.778_031_938,
    -77.655_586_423,
    23.013_651_172,
];

fn shifted(p: Vec3<f64>) -> Pose<f64> {
    Pose { translation: p, ..Pose::identity() }
}

/// A spherical–revolute–spherical arm of 1.05 m and 56 kg on a 1500 kg bus.
pub(crate) fn unladen() -> Robot<f64, J> {
    let bus =
        MassProperties::from_central(1500.0, Vec3::zero(), Sym3::diagonal(640.0, 725.0, 725.0));
    // (mount on the parent, mass, centre of mass along x, inertia about x, about y and z)
    let links = [
        (vec3(0.9, 0.5, 0.0), 10.0, 0.0, 0.018, 0.021),
        (Vec3::zero(), 10.0, 0.05, 0.018, 0.021),
        (Vec3::zero(), 8.0, 0.225, 0.0144, 0.1422),
        (vec3(0.45, 0.0, 0.0), 8.0, 0.05, 0.0144, 0.0168),
        (Vec3::zero(), 6.0, 0.2, 0.0108, 0.0854),
        (vec3(0.4, 0.0, 0.0), 6.0, 0.03, 0.0108, 0.0104),
        (Vec3::zero(), 8.0, 0.1, 0.0144, 0.101_6 / 3.0),
    ];
    let mut chain = Vec::new();
    for (j, (p, m, x, ix, it)) in links.into_iter().enumerate() {
        let parent = if j == 0 { BodyId::Base } else { BodyId::Link(j - 1) };
        let axis = if j % 2 == 0 { vec3(1.0, 0.0, 0.0) } else { vec3(0.0, 1.0, 0.0) };
        let joint = Joint::new(parent, JointKind::Revolute, shifted(p), axis);
        let I = Sym3::diagonal(ix, it, it);
        chain.push((joint, MassProperties::from_central(m, vec3(x, 0.0, 0.0), I)));
    }
    Robot::new(bus, &chain).expect("seven joints fit")
}

/// The tool frame: 0.2 m ahead of the last joint.
pub(crate) fn tool() -> Frame<f64> {
    Frame { body: BodyId::Link(6), X_BF: shifted(vec3(0.2, 0.0, 0.0)) }
}

/// A cube of 1 m and the given mass (kg), gripped at a face.
pub(crate) fn cube(mass: f64) -> MassProperties<f64> {
    MassProperties::from_central(
        mass,
        vec3(0.5, 0.0, 0.0),
        Sym3::diagonal(1.0, 1.0, 1.0).scaled(mass / 6.0),
    )
}

/// Coasting from `sideways_300mm` with joint rates up to 0.02 rad/s and base rates up to 0.01.
pub(crate) fn coasting() -> State<f64, J> {
    State {
        q: SIDEWAYS_300MM_DEG.map(f64::to_radians),
        v: [0.02, -0.017, 0.013, 0.019, -0.02, 0.011, -0.015],
        V_NB_B: wrasse_spatial::SpatialVelocity::from_array([
            0.01, -0.007, 0.004, 0.006, 0.01, -0.008,
        ]),
        ..State::default()
    }
}
