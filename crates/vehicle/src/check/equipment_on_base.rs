//! Whether equipment suits the base that it is bolted on.

use super::physical::principal_moments;
use super::plausible::BASE_SIZE;
use super::torque_cone::can_make;
use crate::equipment::Equipment;
use crate::figures::figures;
use crate::table::{Reading, under};
use crate::vehicle::{JOINTS, VehicleRobot};
use wrasse_document::{Complaint, Document, Step, at};
use wrasse_dynamics::{BodyId, PerBody};
use wrasse_spatial::{Pose, Sym3, Vec3, vec3};

/// Complaints about equipment that does not suit a robot: units heavier than the base that they are
/// part of, thrusters that cannot turn it. `path` is where the table of the equipment stands.
pub fn check_equipment(
    document: &Document,
    path: &[Step<'_>],
    equipment: &Equipment,
    robot: &VehicleRobot,
) -> Vec<Complaint> {
    let mut reading = Reading::new(document);
    check_base(&mut reading, path, equipment, robot);
    check_thrusters(&mut reading, path, equipment, robot);
    check_room_for_slosh(&mut reading, path, equipment, robot);
    doubt_places(&mut reading, path, equipment);
    reading.found.into_complaints()
}

/// Units are part of the base: it has their mass, and their inertia about their axes.
fn check_base(
    reading: &mut Reading<'_>,
    path: &[Step<'_>],
    equipment: &Equipment,
    robot: &VehicleRobot,
) {
    let base = robot.inertia(BodyId::Base);
    if let Some(mass) = equipment.mass.filter(|mass| *mass >= base.mass) {
        let message = format!(
            "the actuators weigh {} kg, and the base with them {} kg",
            figures(mass),
            figures(base.mass)
        );
        let help = "their mass is part of the base's: does its `mass_kg` leave them out?";
        reading.error(path, message, "these actuators", help);
    }
    let about =
        |axis: Vec3<f64>, inertia: f64| Sym3::symmetric_part(&axis.outer(axis)).scaled(inertia);
    let actuators = &equipment.actuators;
    let wheels = actuators.wheels.iter().map(|wheel| about(wheel.axis_B, wheel.inertia));
    let gimbals = actuators.cmgs.iter().map(|cmg| about(cmg.gimbal_axis_B, cmg.gimbal_inertia));
    let turning = wheels.chain(gimbals).fold(Sym3::zero(), |sum, one| sum + one);
    let [least, ..] = principal_moments(base.central() - turning);
    if least <= 0.0 {
        let [small, middle, large] = principal_moments(base.central()).map(figures);
        let [.., most] = principal_moments(turning).map(figures);
        let message = format!(
            "wheels and gimbals turn {most} kg·m² about their axes, and the base with them has \
             {small}, {middle}, {large} kg·m²"
        );
        let help = "their inertia is part of the base's: is it in kg·m²?";
        let key = if actuators.wheels.is_empty() { "cmg" } else { "wheel" };
        reading.error(&under(path, key), message, "what turns", help);
    }
}

/// Thrusters alone must turn the vehicle both ways about each axis; beside wheels or CMGs they need
/// not, but then cannot unload them.
fn check_thrusters(
    reading: &mut Reading<'_>,
    path: &[Step<'_>],
    equipment: &Equipment,
    robot: &VehicleRobot,
) {
    let actuators = &equipment.actuators;
    if actuators.thrusters.is_empty() {
        return;
    }
    let p_cm = centre_of_mass(equipment, robot);
    let torque =
        |t: &wrasse_hardware::Thruster<f64>| (t.position_B - p_cm).cross(t.direction_B) * t.force;
    let torques: Vec<_> = actuators.thrusters.iter().map(torque).collect();
    let wanted = [
        ("+x", vec3(1.0, 0.0, 0.0)),
        ("-x", vec3(-1.0, 0.0, 0.0)),
        ("+y", vec3(0.0, 1.0, 0.0)),
        ("-y", vec3(0.0, -1.0, 0.0)),
        ("+z", vec3(0.0, 0.0, 1.0)),
        ("-z", vec3(0.0, 0.0, -1.0)),
    ];
    let missing: Vec<_> =
        wanted.iter().filter(|(_, axis)| !can_make(&torques, *axis)).map(|w| w.0).collect();
    if missing.is_empty() {
        return;
    }
    let [x, y, z] = p_cm.to_array().map(figures);
    let message = format!(
        "the thrusters cannot make a torque about {} alone: they only push, and the centre of mass, \
         all joints at zero, is at [{x}, {y}, {z}] m",
        missing.join(", ")
    );
    let single = reading.document.keys(path).contains(&"thruster");
    let place = under(path, if single { "thruster" } else { "thruster_set" });
    if actuators.wheels.is_empty() && actuators.cmgs.is_empty() {
        let help = "add thrusters, wheels or CMGs; a [[actuators.thruster_set]] of 12 on a box is \
                    enough for force and torque every way";
        reading.error(&place, message, "these thrusters", help);
    } else {
        let help = "wheels or CMGs that saturate this way cannot be unloaded";
        reading.warning(&place, message, "these thrusters", help);
    }
}

/// Centre of mass of the vehicle with its propellant, all joints at zero, in the base's frame (m).
fn centre_of_mass(equipment: &Equipment, robot: &VehicleRobot) -> Vec3<f64> {
    let mut X: PerBody<Pose<f64>, JOINTS> = PerBody::filled(Pose::identity());
    let mut moment = Vec3::zero();
    for body in robot.bodies() {
        if let BodyId::Link(j) = body {
            let joint = robot.joint(j);
            X[body] = X[joint.parent] * joint.X_PB(0.0);
        }
        let M = robot.inertia(body);
        moment += X[body].translation * M.mass + X[body].rotation * M.first_moment;
    }
    let (mass, p_cm) = (robot.mass(), moment * (1.0 / robot.mass()));
    match equipment.actuators.tank {
        None => p_cm,
        Some(tank) => {
            let moment = p_cm * mass + tank.position_B * tank.propellant;
            moment * (1.0 / (mass + tank.propellant))
        }
    }
}

/// Propellant swings on two joints more.
fn check_room_for_slosh(
    reading: &mut Reading<'_>,
    path: &[Step<'_>],
    equipment: &Equipment,
    robot: &VehicleRobot,
) {
    let own = robot.joint_count();
    if equipment.slosh.is_some() && own + 2 > JOINTS {
        let message = format!(
            "propellant swings on two joints, and {own} of {JOINTS} that a vehicle may have are taken"
        );
        let help = "weld joints that do not move, or leave out [actuators.tank.slosh]";
        reading.error(&[path, at!["tank", "slosh"]].concat(), message, "no room", help);
    }
}

/// Warns of thrusters and tanks that are farther away than any spacecraft is wide.
fn doubt_places(reading: &mut Reading<'_>, path: &[Step<'_>], equipment: &Equipment) {
    let thrusters = equipment.thruster_names.iter().zip(equipment.actuators.thrusters.iter());
    let mut places: Vec<_> =
        thrusters.map(|(name, t)| (format!("thruster '{name}'"), t.position_B)).collect();
    places.extend(equipment.actuators.tank.map(|tank| ("the tank".into(), tank.position_B)));
    if let Some((what, place)) = places.iter().find(|(_, place)| place.norm() > BASE_SIZE) {
        let message = format!("{what} is {} m from the base's frame", figures(place.norm()));
        reading.warning(path, message, "these actuators", "positions are in metres");
    }
}
