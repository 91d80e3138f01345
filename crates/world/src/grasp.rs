//! Grasp and release of rigid payloads: total momentum continues exactly.

use crate::free_body::FreeBody;
use crate::setup::Drive;
use crate::world::World;
use wrasse_dynamics::{
    BodyId, Frame, JointDrive, Kinematics, PerBody, Robot, State, driven_dynamics,
    inverse_dynamics, kinematics,
};
use wrasse_spatial::{Quat, SpatialForce, SpatialVelocity};

/// How the grip of a payload lies in a tool and moves against it; or the most that a grasp allows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GripOffset {
    /// Distance of the origins (m).
    pub distance: f64,
    /// Angle between the axes (rad).
    pub angle: f64,
    /// Relative angular speed (rad/s).
    pub angular_speed: f64,
    /// Relative speed of the grip at the tool's origin (m/s).
    pub linear_speed: f64,
}

impl GripOffset {
    /// That of a body, whose frame is its grip, from a tool frame of a vehicle.
    pub fn of<const J: usize>(
        k: &Kinematics<'_, f64, J>,
        tool: &Frame<f64>,
        body: &FreeBody,
    ) -> Self {
        let X_FT = k.pose(tool).inverse() * body.pose();
        let V = relative_twist(k, tool, body);
        Self {
            distance: X_FT.translation.norm(),
            angle: Quat::from_matrix(&X_FT.rotation).log().norm(),
            angular_speed: V.angular.norm(),
            linear_speed: V.linear.norm(),
        }
    }
    /// Whether all of it is within these bounds: what is not a number is within none.
    pub fn is_within(&self, most: &Self) -> bool {
        self.distance <= most.distance
            && self.angle <= most.angle
            && self.angular_speed <= most.angular_speed
            && self.linear_speed <= most.linear_speed
    }
}

/// A grasp that was refused, for what it found is not within the bounds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GraspRefused(pub GripOffset);

/// Twist of a body relative to a frame of a vehicle, at the frame's origin, inertial axes.
fn relative_twist<const J: usize>(
    k: &Kinematics<'_, f64, J>,
    frame: &Frame<f64>,
    body: &FreeBody,
) -> SpatialVelocity<f64> {
    let (X_NT, V_NT_T) = (body.pose(), body.twist());
    let at_T = SpatialVelocity::new(X_NT.rotation * V_NT_T.angular, X_NT.rotation * V_NT_T.linear);
    at_T.shifted_by(k.pose(frame).translation - X_NT.translation) - k.velocity(frame)
}

impl<const J: usize> World<J> {
    /// Twist of free body `i` relative to a frame, at the frame's origin, inertial axes.
    pub fn relative_twist(&self, frame: &Frame<f64>, i: usize) -> SpatialVelocity<f64> {
        relative_twist(&kinematics(&self.robot, &self.state()), frame, &self.free[i])
    }

    /// How free body `i` lies in a tool frame and moves against it.
    pub fn grip_offset(&self, tool: &Frame<f64>, i: usize) -> GripOffset {
        GripOffset::of(&kinematics(&self.robot, &self.state()), tool, &self.free[i])
    }

    /// Make free body `i` part of the body that carries `frame`, where it is now: a plastic impact.
    /// Total momentum continues exactly. Joints that are driven by torque give way; prescribed joints
    /// keep their rates and a held base its attitude, whatever impulse that takes. The change of
    /// energy (J) is returned.
    ///
    /// # Errors
    /// If how it lies in the frame and moves against it is not within the bounds.
    ///
    /// # Panics
    /// If no body of this number floats.
    pub fn grasp(
        &mut self,
        frame: &Frame<f64>,
        i: usize,
        most: &GripOffset,
    ) -> Result<f64, GraspRefused> {
        let found = self.grip_offset(frame, i);
        if !found.is_within(most) {
            return Err(GraspRefused(found));
        }
        let body = self.free.remove(i);
        let state = self.state();
        let X_FT = self.pose(frame).inverse() * body.pose();
        let alone = self.robot;
        // Held by its own frame: let go, it has it again.
        self.held.push((Frame { body: frame.body, X_BF: frame.X_BF * X_FT }, body.matter));
        let m = self.mass;
        let total = m + body.matter.M_F_F.mass;
        self.rebuild(total);
        let s = &mut self.system;
        let p_cm = (s.p_NScm_N * m + body.p_NTcm_N * body.matter.M_F_F.mass) * (1.0 / total);
        s.angular += (s.p_NScm_N - p_cm).cross(s.linear)
            + body.angular
            + (body.p_NTcm_N - p_cm).cross(body.linear);
        s.linear += body.linear;
        s.p_NScm_N = p_cm;
        let change = self.impact(&alone, &state, frame.body, &body);
        self.energy_at_grasps += change;
        Ok(change)
    }

    /// Joint rates after the impact, and the impulse that holds the base; the change of energy (J).
    ///
    /// At the instant only momentum counts: `M⁺ ν⁺ = M ν + Jᵀ h` is forward dynamics at rest, with the
    /// generalized momentum in place of the forces and the rates in place of the accelerations.
    fn impact(
        &mut self,
        alone: &Robot<f64, J>,
        before: &State<f64, J>,
        grip: BodyId,
        body: &FreeBody,
    ) -> f64 {
        let at_rest = State { V_NB_B: SpatialVelocity::zero(), v: [0.0; J], ..*before };
        let none = PerBody::filled(SpatialForce::zero());
        let own = inverse_dynamics(&kinematics(alone, &at_rest), &before.velocity(), &none).force;
        let k = kinematics(&self.robot, &at_rest);
        let X_NB = &k.X_NB(grip);
        let h_N = SpatialForce::new(body.angular, body.linear);
        let about_Bo = h_N.about(X_NB.translation - body.p_NTcm_N);
        let brought = SpatialForce::new(
            X_NB.rotation.transpose_mul(about_Bo.torque),
            X_NB.rotation.transpose_mul(about_Bo.force),
        );
        let mut momenta = none;
        momenta[grip] += brought;
        momenta.base += own.base;
        let drives = core::array::from_fn(|j| match self.drives[j] {
            Drive::Follow(_) => JointDrive::Acceleration(before.v[j]),
            Drive::Effort(_) => JointDrive::Effort(own.joints[j]),
        });
        let found = driven_dynamics(&k, &drives, self.base.mode(), &momenta);
        for j in self.robot.joints() {
            self.system.v[j] = found.nudot.joints[j];
        }
        let holding_N = before.X_NB.rotation * found.force.base.torque;
        self.system.angular += holding_N;
        self.booked.from_actuator += holding_N;

        let after = State { V_NB_B: found.nudot.base, v: found.nudot.joints, ..*before };
        let k_after = kinematics(&self.robot, &after);
        let mut twice = after.V_NB_B.power(&(own.base + found.force.base))
            + k_after.V_NB_B(grip).power(&brought)
            - before.V_NB_B.power(&own.base);
        for j in self.robot.joints() {
            twice += after.v[j] * found.force.joints[j] - before.v[j] * own.joints[j];
        }
        0.5 * twice - body.kinetic_energy()
    }

    /// Let go of a payload, by its number in [`held`](Self::held). It goes on as it moves; its number
    /// among the free bodies is returned.
    ///
    /// # Panics
    /// If nothing of this number is held.
    pub fn release(&mut self, number: usize) -> usize {
        let (frame, payload) = self.held.remove(number);
        let state = self.state();
        let k = kinematics(&self.robot, &state);
        let V_NF_F = k.V_NB_B(frame.body);
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
        self.free.len() - 1
    }

    /// The robot with its propellant and with what is in its grips.
    pub(crate) fn laden(&self) -> Robot<f64, J> {
        let fed = self.tank.map_or(self.empty, |tank| tank.added_to(&self.empty));
        self.held.iter().fold(fed, |robot, (frame, p)| robot.with_payload(frame, p))
    }

    fn rebuild(&mut self, mass: f64) {
        self.robot = self.laden();
        self.mass = mass;
    }
}
