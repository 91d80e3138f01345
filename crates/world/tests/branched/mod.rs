//! A light free-flyer with two arms, one joint that slides and axes in no special direction: nothing
//! is zero by accident, and the base feels the arms.
#![allow(dead_code, reason = "each test binary uses its part")]

use wrasse_dynamics::{BodyId, Frame, Joint, JointKind, MassProperties, Robot, State};
use wrasse_spatial::{Pose, Quat, SpatialVelocity, Sym3, Vec3, vec3};
use wrasse_world::{BaseAttitude, Equipment, Stepper};
use wrasse_world_testing::{OneSystem, OneSystemSetup};

/// Joints of both arms.
pub(crate) const J: usize = 4;

pub(crate) fn pose(turn: Vec3<f64>, shift: Vec3<f64>) -> Pose<f64> {
    Pose::from_quat(Quat::exp(turn), shift)
}

/// A rigid part with its centre of mass off its origin and its principal axes oblique.
fn part(mass: f64, p_cm: Vec3<f64>, size: f64) -> MassProperties<f64> {
    let I = Sym3::diagonal(0.4, 0.7, 0.9).scaled(mass * size * size);
    let turned = pose(vec3(0.3, -0.5, 0.2), p_cm);
    MassProperties::from_central(mass, Vec3::zero(), I).seen_from(&turned)
}

/// Base of 40 kg; arm one turns and slides, arm two turns twice.
pub(crate) fn robot() -> Robot<f64, J> {
    use JointKind::{Prismatic, Revolute};
    let base = part(40.0, vec3(0.05, -0.1, 0.08), 0.5);
    let joint = |parent, kind, X, axis| Joint::new(parent, kind, X, axis);
    let links = [
        (
            joint(
                BodyId::Base,
                Revolute,
                pose(vec3(0.4, 0.1, -0.6), vec3(0.5, 0.1, 0.2)),
                vec3(0.2, 1.0, 0.4),
            ),
            part(6.0, vec3(0.3, 0.02, -0.05), 0.3),
        ),
        (
            joint(
                BodyId::Link(0),
                Prismatic,
                pose(vec3(-0.2, 0.7, 0.3), vec3(0.6, 0.0, 0.1)),
                vec3(1.0, 0.3, -0.2),
            ),
            part(4.0, vec3(0.1, -0.06, 0.2), 0.2),
        ),
        (
            joint(
                BodyId::Base,
                Revolute,
                pose(vec3(-0.5, 0.2, 0.9), vec3(-0.4, 0.3, -0.1)),
                vec3(-0.6, 0.2, 1.0),
            ),
            part(5.0, vec3(0.25, 0.1, 0.03), 0.3),
        ),
        (
            joint(
                BodyId::Link(2),
                Revolute,
                pose(vec3(0.1, -0.8, 0.2), vec3(0.5, 0.05, 0.0)),
                vec3(0.7, -0.7, 0.3),
            ),
            part(3.0, vec3(0.2, 0.0, -0.08), 0.2),
        ),
    ];
    Robot::new(base, &links).expect("four joints fit")
}

/// Moving in every way: joints at some tenths of a radian and a metre per second.
pub(crate) fn moving() -> State<f64, J> {
    State {
        X_NB: pose(vec3(0.5, -0.3, 0.8), vec3(1.0, -2.0, 0.5)),
        V_NB_B: SpatialVelocity::from_array([0.1, -0.15, 0.2, 0.05, -0.02, 0.04]),
        q: [0.4, 0.1, -0.7, 0.9],
        v: [0.3, -0.05, -0.4, 0.5],
    }
}

/// A grip on the sliding link.
pub(crate) fn grip() -> Frame<f64> {
    Frame { body: BodyId::Link(1), X_BF: pose(vec3(0.3, 0.2, -0.4), vec3(0.3, 0.0, 0.1)) }
}

/// Something of 12 kg to hold, off its own frame.
pub(crate) fn load() -> MassProperties<f64> {
    part(12.0, vec3(0.2, 0.1, -0.15), 0.4)
}

/// The robot from a state, without limits, actuator or payload.
pub(crate) fn world(start: State<f64, J>, base: BaseAttitude, step: f64) -> OneSystem<J> {
    OneSystem::new(&OneSystemSetup {
        robot: &robot(),
        limits: &[],
        actuator: None,
        equipment: Equipment::default(),
        base,
        stepper: Stepper::Fixed { step },
        start,
        held: &[],
    })
}
