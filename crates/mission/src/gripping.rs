//! Grasping and releasing in a flight, and what the flight computer then takes the vehicle for.

use crate::flight::Flight;
use crate::outcome::{End, EventKind};
use wrasse_dynamics::{BodyId, Frame, MassProperties};
use wrasse_flight::{Command, Grip};
use wrasse_spatial::{Pose, Sym3};
use wrasse_vehicle::{JOINTS, VehicleRobot};
use wrasse_world::{GraspRefused, GripOffset};

impl Flight<'_> {
    /// The vehicle with what it holds and its propellant, as the flight computer believes it to be: the
    /// true one unless masses are otherwise than it knows.
    pub(crate) fn believed_robot(&self) -> VehicleRobot {
        let Some(alone) = self.believed_alone else { return *self.world.robot() };
        let fed = match self.case.equipment.actuators.tank {
            Some(tank) => {
                let left = self.world.actuator_readings().propellant;
                let base = Frame { body: BodyId::Base, X_BF: Pose::identity() };
                alone.with_payload(
                    &base,
                    &MassProperties::from_central(left, tank.position_B, Sym3::zero()),
                )
            }
            None => alone,
        };
        self.world.held().fold(fed, |robot, (i, held)| {
            robot.with_payload(&held.frame, &self.case.believed_matter(i))
        })
    }

    /// At the end of a control period: what the command told the grip; why the flight ends, if it is
    /// refused. The period before is flown with what was in the grip, by a law that knows it.
    pub(crate) fn grip(&mut self, command: &Command<f64, JOINTS>) -> Option<End> {
        let phase = self.case.phases.get(command.phase)?;
        let done = match command.grip? {
            Grip::Grasp(i) => self.grasp(i, phase.grasp_bounds?),
            Grip::Release(i) => self.release(i),
        };
        match done {
            Ok(text) => {
                self.say(EventKind::Grip, text);
                let believed = self.believed_robot();
                self.computer.robot_changed(&believed);
                None
            }
            Err(reason) => {
                let (phase, time_s) = (phase.name.clone(), self.world.time());
                Some(End::Stopped { phase, time_s, reason })
            }
        }
    }

    fn grasp(&mut self, i: usize, most: GripOffset) -> Result<String, String> {
        let name = &self.case.payloads[i].name;
        let held_already = || format!("{name} does not float: it is held already");
        let tool = *self.computer.tool();
        let found = self.world.grip_offset(&tool, i).ok_or_else(held_already)?;
        let change = self
            .world
            .grasp(&tool, i, &most)
            .map_err(|GraspRefused(found)| refusal(name, &found, &most))?
            .ok_or_else(held_already)?;
        Ok(format!(
            "grasped {name}: its grip {:.2} mm and {:.3} deg from the tool (at most {} mm and {} deg); \
             energy changes by {change:.3e} J",
            found.distance * 1e3,
            found.angle.to_degrees(),
            short(most.distance * 1e3),
            short(most.angle.to_degrees())
        ))
    }

    fn release(&mut self, i: usize) -> Result<String, String> {
        let name = &self.case.payloads[i].name;
        if !self.world.release(i) {
            return Err(format!("{name} cannot be released: nobody holds it"));
        }
        Ok(format!("released {name}"))
    }
}

/// Why a grasp is refused, with the numbers against their bounds.
pub(crate) fn refusal(payload: &str, found: &GripOffset, most: &GripOffset) -> String {
    let each = [
        ("distance of grip and tool", found.distance * 1e3, most.distance * 1e3, "mm"),
        ("angle", found.angle.to_degrees(), most.angle.to_degrees(), "deg"),
        ("relative speed", found.linear_speed, most.linear_speed, "m/s"),
        (
            "relative turning speed",
            found.angular_speed.to_degrees(),
            most.angular_speed.to_degrees(),
            "deg/s",
        ),
    ];
    let parts = each.map(|(what, found, most, unit)| {
        let beyond = if found <= most { "" } else { ", beyond it" };
        format!("{what} {found:.4} {unit} (at most {} {unit}{beyond})", short(most))
    });
    format!("grasp of {payload} refused: {}", parts.join(", "))
}

/// A bound as its file has it: without the round-off of its unit.
fn short(x: f64) -> f64 {
    (x * 1e9).round() / 1e9
}
