//! Grasping and releasing in a flight, and what the flight computer then takes the vehicle for.

use crate::flight::Flight;
use crate::outcome::{End, EventKind};
use wrasse_dynamics::{BodyId, Frame, Payload, kinematics};
use wrasse_flight::Grip;
use wrasse_spatial::{Pose, Sym3};
use wrasse_vehicle::VehicleRobot;

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
                    &Payload::from_central(left, tank.position_B, Sym3::zero()),
                )
            }
            None => alone,
        };
        let held = self.holding.iter().zip(self.world.held()).zip(&self.X_FT);
        held.fold(fed, |robot, ((&i, (frame, _)), X_FT)| {
            robot.with_payload(frame, &self.case.believed_matter(i).seen_from(X_FT))
        })
    }

    /// Where each payload's centre of mass is, and how it is turned.
    pub(crate) fn payload_poses(&self) -> Vec<(usize, Pose<f64>)> {
        let state = self.world.state();
        let k = kinematics(self.world.robot(), &state);
        let at_cm = |X: Pose<f64>, i: usize, matter: &Payload<f64>| {
            let p_cm = X.point(matter.M_F_F.centre_of_mass());
            (i, Pose::new(X.rotation, p_cm))
        };
        let held = self.holding.iter().zip(self.world.held());
        let held = held.map(|(&i, (frame, matter))| at_cm(k.pose(frame), i, matter));
        let floating = self.floating.iter().enumerate().filter_map(|(i, n)| n.map(|n| (i, n)));
        let floating = floating.map(|(i, n)| {
            let body = &self.world.free_bodies()[n];
            at_cm(body.pose(), i, &body.matter)
        });
        held.chain(floating).collect()
    }

    /// Grasp or release; why the flight ends, if it is refused.
    pub(crate) fn grip(&mut self, grip: Grip, phase: usize) -> Option<End> {
        let done = match grip {
            Grip::Grasp(i) => self.grasp(i, self.case.phases[phase].grasp_bounds),
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
                let phase = self.case.phases[phase].name.clone();
                Some(End::Stopped { phase, time_s: self.world.time(), reason })
            }
        }
    }

    fn grasp(&mut self, i: usize, (angular, linear): (f64, f64)) -> Result<String, String> {
        let name = &self.case.payloads[i].name;
        let Some(number) = self.floating[i] else {
            return Err(format!("{name} does not float: it is held already"));
        };
        let tool = *self.computer.tool();
        let refused = |r: wrasse_world::GraspRefused| {
            format!(
                "grasp of {name} refused: relative speed {:.4} m/s (at most {linear} m/s), relative \
                 turning speed {:.4} deg/s (at most {:.4} deg/s)",
                r.linear_speed,
                r.angular_speed.to_degrees(),
                angular.to_degrees()
            )
        };
        let X_FT = self.world.pose(&tool).inverse() * self.world.free_bodies()[number].pose();
        let change = self.world.grasp(&tool, number, angular, linear).map_err(refused)?;
        self.X_FT.push(X_FT);
        self.floating[i] = None;
        self.floating.iter_mut().flatten().filter(|n| **n > number).for_each(|n| *n -= 1);
        self.holding.push(i);
        Ok(format!("grasped {name}: energy changes by {change:.3e} J"))
    }

    fn release(&mut self, i: usize) -> Result<String, String> {
        let name = &self.case.payloads[i].name;
        let Some(number) = self.holding.iter().position(|&held| held == i) else {
            return Err(format!("{name} cannot be released: nobody holds it"));
        };
        self.holding.remove(number);
        self.X_FT.remove(number);
        self.floating[i] = Some(self.world.release(number));
        Ok(format!("released {name}"))
    }
}
