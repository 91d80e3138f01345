//! A vehicle with a tank in which the propellant swings, and the same with a pendulum hung by hand.
#![allow(dead_code, reason = "each test binary uses its part")]

use wrasse_dynamics::{BodyId, Frame, Joint, JointKind, MassProperties, Robot, State};
use wrasse_hardware::{Slosh, Tank, TankShape};
use wrasse_spatial::{Pose, Quat, SpatialVelocity, Sym3, Vec3, vec3};
use wrasse_world::{BaseAttitude, Equipment, SloshPendulum, Stepper};
use wrasse_world_testing::{OneSystem, OneSystemSetup};

/// Room for two joints of a pendulum, and two more.
pub(crate) const J: usize = 4;
/// Axis of the tank: oblique.
pub(crate) const AXIS: Vec3<f64> = Vec3 { x: 0.48, y: 0.6, z: 0.64 };
/// Centre of the propellant (m).
pub(crate) const POSITION: Vec3<f64> = Vec3 { x: -0.3, y: 0.1, z: 0.2 };
/// Propellant (kg).
pub(crate) const LIQUID: f64 = 60.0;
/// What is a tenth of the radius deep (kg).
pub(crate) const SHALLOW: f64 = 1000.0 * std::f64::consts::PI * 0.3 * 0.3 * 0.03;

/// A tank of 0.3 m radius; damped at 0.02 m/s², not restored.
pub(crate) fn slosh() -> Slosh {
    Slosh {
        axis_B: AXIS,
        shape: TankShape::UprightCylinder { radius: 0.3, height: 0.5 },
        density: 1000.0,
        damping_ratio: 0.03,
        acceleration: 0.02,
        stiffness: 0.0,
    }
}

pub(crate) fn equipment(slosh: Option<Slosh>) -> Equipment {
    let mut equipment = Equipment { slosh, ..Equipment::default() };
    equipment.actuators.tank = Some(Tank { position_B: POSITION, propellant: LIQUID });
    equipment
}

fn hull() -> MassProperties<f64> {
    MassProperties::from_central(200.0, vec3(0.05, -0.1, 0.08), Sym3::diagonal(30.0, 40.0, 50.0))
}

/// A base alone.
pub(crate) fn bare() -> Robot<f64, J> {
    Robot::new(hull(), &[]).expect("a base is a robot")
}

/// The base with what does not swing, and the rest on a joint about y and then one about x, of a frame
/// whose z is the tank's axis.
pub(crate) fn hung_by_hand(p: &SloshPendulum) -> Robot<f64, J> {
    let bottom = POSITION - AXIS * (0.5 * LIQUID / (1000.0 * std::f64::consts::PI * 0.09));
    let point = |mass, at| MassProperties::from_central(mass, at, Sym3::zero());
    let base = hull().and(&point(p.rest_mass, bottom + AXIS * p.rest_height));
    // From z to the axis by the shortest way.
    let about = vec3(0.0, 0.0, 1.0).cross(AXIS);
    let turn = Quat::exp(about * (libm::asin(about.norm()) / about.norm()));
    let mount = Pose::from_quat(turn, bottom + AXIS * p.hinge_height);
    let (x, y) = (vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0));
    let revolute = |parent, X, axis| Joint::new(parent, JointKind::Revolute, X, axis);
    let links = [
        (revolute(BodyId::Base, mount, y), MassProperties::default()),
        (revolute(BodyId::Link(0), Pose::identity(), x), point(p.mass, vec3(0.0, 0.0, -p.length))),
    ];
    Robot::new(base, &links).expect("two joints fit")
}

/// Somewhere, moving in every way, the rod along the axis and swinging (rad/s).
pub(crate) fn flying(rates: [f64; 2]) -> State<f64, J> {
    State {
        X_NB: Pose::from_quat(Quat::exp(vec3(0.5, -0.3, 0.8)), vec3(1.0, -2.0, 0.5)),
        V_NB_B: SpatialVelocity::from_array([0.03, -0.05, 0.04, 0.05, -0.02, 0.04]),
        v: [rates[0], rates[1], 0.0, 0.0],
        ..State::default()
    }
}

pub(crate) fn world(
    robot: &Robot<f64, J>,
    start: State<f64, J>,
    equipment: &Equipment,
    base: BaseAttitude,
) -> OneSystem<J> {
    OneSystem::new(&OneSystemSetup {
        robot,
        limits: &[],
        actuator: None,
        equipment: *equipment,
        base,
        stepper: Stepper::Adaptive { tolerance: 1e-12 },
        start,
        held: &[],
    })
}

/// Where the bob is, inertial axes (m), on the joint after `first`.
pub(crate) fn bob_N(world: &OneSystem<J>, first: usize, p: &SloshPendulum) -> Vec3<f64> {
    let X_BF = Pose { translation: vec3(0.0, 0.0, -p.length), ..Pose::identity() };
    world.pose(&Frame { body: BodyId::Link(first + 1), X_BF }).translation
}
