//! Grasp and release of rigid payloads: total momentum continues exactly.

use crate::free_body::FreeBody;
use crate::world::{BaseAttitude, World};
use wrasse_dynamics::{Frame, Robot, kinematics, kinetic_energy, momentum};
use wrasse_spatial::{SpatialVelocity, Vec3};

/// A grasp that was refused: the grip and the payload move too differently.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GraspRefused {
    /// Relative angular speed (rad/s).
    pub angular_speed: f64,
    /// Relative speed of the grip point (m/s).
    pub linear_speed: f64,
}

impl<const J: usize> World<J> {
    /// Twist of free body `i` relative to a frame, at the frame's origin, inertial axes.
    pub fn relative_twist(&self, frame: &Frame<f64>, i: usize) -> SpatialVelocity<f64> {
        let state = self.state();
        let k = kinematics(&self.robot, &state);
        let (X_NT, V_NT_T) = (self.free[i].pose(), self.free[i].twist());
        let at_T =
            SpatialVelocity::new(X_NT.rotation * V_NT_T.angular, X_NT.rotation * V_NT_T.linear);
        at_T.shifted_by(k.pose(frame).translation - X_NT.translation) - k.velocity(frame)
    }

    /// Make free body `i` part of the body that carries `frame`, where it is now; those behind it
    /// move up by one number. The joints keep their rates, whatever drives them; total momentum
    /// continues exactly. The energy changes by what the grip dissipates and by what the drives do to
    /// keep the rates; the change is booked.
    ///
    /// # Errors
    /// If the relative twist is not within the bounds (rad/s, m/s).
    ///
    /// # Panics
    /// If no body of this number floats.
    pub fn grasp(
        &mut self,
        frame: &Frame<f64>,
        i: usize,
        largest_angular: f64,
        largest_linear: f64,
    ) -> Result<(), GraspRefused> {
        let V = self.relative_twist(frame, i);
        let (angular_speed, linear_speed) = (V.angular.norm(), V.linear.norm());
        let within = angular_speed <= largest_angular && linear_speed <= largest_linear;
        if !within {
            return Err(GraspRefused { angular_speed, linear_speed });
        }
        let before = self.account();
        let body = self.free.remove(i);
        let X_FT = self.pose(frame).inverse() * body.pose();
        self.held.push((*frame, body.matter.seen_from(&X_FT)));
        let m = self.mass;
        let total = m + body.matter.M_F_F.mass;
        let s = &mut self.system;
        let p_cm = (s.p_NScm_N * m + body.p_NTcm_N * body.matter.M_F_F.mass) * (1.0 / total);
        s.angular += (s.p_NScm_N - p_cm).cross(s.linear)
            + body.angular
            + (body.p_NTcm_N - p_cm).cross(body.linear);
        s.linear += body.linear;
        s.p_NScm_N = p_cm;
        self.rebuild(total);
        self.book_change(&before);
        Ok(())
    }

    /// Let go of a payload, by its number in [`held`](Self::held). It goes on as it moves; its number
    /// among the free bodies is returned.
    ///
    /// # Panics
    /// If nothing of this number is held.
    pub fn release(&mut self, number: usize) -> usize {
        let before = self.account();
        let (frame, payload) = self.held.remove(number);
        let state = self.state();
        let k = kinematics(&self.robot, &state);
        let V_NF_F = k.V_NB_B[frame.body];
        let V_NF_F = frame.X_BF.velocity_to_child(&V_NF_F);
        let body = FreeBody::new(payload, &k.pose(&frame), &V_NF_F);
        let m = self.mass - payload.M_F_F.mass;
        let s = &mut self.system;
        let p_cm = (s.p_NScm_N * self.mass - body.p_NTcm_N * payload.M_F_F.mass) * (1.0 / m);
        s.linear -= body.linear;
        s.angular = s.angular
            - body.angular
            - (body.p_NTcm_N - s.p_NScm_N).cross(body.linear)
            - (p_cm - s.p_NScm_N).cross(s.linear);
        s.p_NScm_N = p_cm;
        self.free.push(body);
        self.rebuild(m);
        self.book_change(&before);
        self.free.len() - 1
    }

    /// The robot from what is in its grips.
    fn rebuild(&mut self, mass: f64) {
        let holding =
            |robot: Robot<f64, J>, (frame, p): &(Frame<f64>, _)| robot.with_payload(frame, p);
        self.robot = self.held.iter().fold(self.empty, holding);
        self.mass = mass;
    }

    /// Book what a grasp or release changed: energy, and where the attitude is held the angular
    /// impulse that held it.
    fn book_change(&mut self, before: &crate::Account) {
        if self.base == BaseAttitude::Held {
            let state = self.state();
            let h = momentum(&kinematics(&self.robot, &state));
            self.system.angular = h.angular;
        }
        let after = self.account();
        self.energy_at_grasps += after.energy - before.energy;
        let impulse = after.angular - before.angular;
        if self.base == BaseAttitude::Held {
            self.booked.from_actuator += impulse;
        }
    }

    /// Kinetic energy of the vehicle alone (J).
    pub fn vehicle_energy(&self) -> f64 {
        kinetic_energy(&kinematics(&self.robot, &self.state()))
    }

    /// Centre of mass of the vehicle and what it holds (m, inertial axes).
    pub fn centre_of_mass(&self) -> Vec3<f64> {
        self.system.p_NScm_N
    }
}
