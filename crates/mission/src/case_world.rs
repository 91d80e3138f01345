//! The world that a case is flown in, at its start.

use crate::applied_wrench::together;
use crate::mission::Case;
use crate::read_base::Turning;
use wrasse_dynamics::{BodyId, Frame, MassProperties};
use wrasse_hardware::{ActuatorCommand, SetPoint, SetPointMotion};
use wrasse_spatial::{Pose, Sym3, Vec3};
use wrasse_vehicle::{JOINTS, VehicleRobot};
use wrasse_world::{Drive, Equipment, Stepper, World, WorldSetup};

/// The vehicle of a case with what it holds, and what pushes at it; nothing floats beside it yet.
pub(crate) fn world_of(case: &Case, stepper: Stepper) -> World<JOINTS> {
    let held = case.held_at_start();
    let mut world = World::new(&WorldSetup {
        robot: &case.vehicle.robot,
        limits: &case.vehicle.limits,
        actuator: match case.turning {
            Turning::Ideal(actuator) => actuator,
            Turning::Fitted => None,
        },
        equipment: equipment(case),
        base: case.base,
        stepper,
        start: case.start,
        held: &held,
    });
    // Prescribed joints keep their rates from the first instant on.
    let (start, period) = (case.start, case.period());
    let drives: [Drive; JOINTS] = core::array::from_fn(|j| {
        let at = |t: f64| SetPoint {
            position: start.q[j] + start.v[j] * t,
            rate: start.v[j],
            acceleration: 0.0,
        };
        if case.torque[j] {
            return Drive::Effort(0.0);
        }
        Drive::Follow(SetPointMotion::between(at(0.0), at(period), period))
    });
    world.command(&drives, Vec3::zero(), &ActuatorCommand::default(), period);
    if !case.wrenches.is_empty() {
        let (wrench, bends) = together(case.wrenches.clone());
        world.set_outside_wrench(wrench, &bends);
    }
    world
}

/// What the world is told of the wheels, CMGs and thrusters of a case.
fn equipment(case: &Case) -> Equipment {
    Equipment {
        actuators: case.equipment.actuators,
        wheel_speed: case.equipment.wheel_speed,
        gimbal_angle: case.equipment.gimbal_angle,
        seed: case.seed,
    }
}

/// The vehicle as the flight computer believes it to be, with nothing in its grips and tank, and its
/// wheels counted for themselves, as the world does.
pub(crate) fn believed_alone(case: &Case) -> VehicleRobot {
    let mut equipment = equipment(case);
    equipment.actuators.tank = None;
    let world = World::new(&WorldSetup {
        robot: case.believed_robot(),
        limits: &case.vehicle.limits,
        actuator: None,
        equipment,
        base: case.base,
        stepper: case.stepper,
        start: case.start,
        held: &[],
    });
    *world.robot()
}

/// The vehicle that the laws believe in, with its propellant and nothing in its grips: what leaves the
/// tank on the way is not planned.
pub(crate) fn fuelled(case: &Case) -> VehicleRobot {
    let alone = believed_alone(case);
    let Some(tank) = case.equipment.actuators.tank else { return alone };
    let base = Frame { body: BodyId::Base, X_BF: Pose::identity() };
    let matter = MassProperties::from_central(tank.propellant, tank.position_B, Sym3::zero());
    alone.with_payload(&base, &matter)
}
