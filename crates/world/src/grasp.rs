//! Grasp and release of rigid payloads: total momentum continues exactly.

use crate::free_body::FreeBody;
use crate::scene::{HeldId, Scene, SystemId};
use crate::source::{Booking, Source};
use crate::system::Held;
use wrasse_dynamics::{Frame, Kinematics, kinematics};
use wrasse_spatial::{Quat, SpatialForce, SpatialVelocity, Vec3};

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

/// All of these panic if a system is part of another now.
impl<const J: usize> Scene<J> {
    /// Twist of a rigid body relative to a frame of a system, at the frame's origin, inertial axes.
    pub fn relative_twist(
        &self,
        id: SystemId,
        frame: &Frame<f64>,
        body: SystemId,
    ) -> SpatialVelocity<f64> {
        let body = self.body(body);
        self.with_kinematics(id, |k| relative_twist(k, frame, &body))
    }

    /// How a rigid body lies in a tool frame of a system and moves against it.
    pub fn grip_offset(&self, id: SystemId, tool: &Frame<f64>, body: SystemId) -> GripOffset {
        let body = self.body(body);
        self.with_kinematics(id, |k| GripOffset::of(k, tool, &body))
    }

    /// Make a rigid body part of the body that carries `frame`, where it is now: a plastic impact. Total
    /// momentum continues exactly. Joints that are driven by torque give way; prescribed joints keep
    /// their rates and a held base its attitude, whatever impulse that takes. What holds it from now on
    /// and the change of energy (J) are returned.
    ///
    /// # Errors
    /// If how it lies in the frame and moves against it is not within the bounds.
    ///
    /// # Panics
    /// If the body has joints: it is no rigid body.
    pub fn grasp(
        &mut self,
        id: SystemId,
        frame: &Frame<f64>,
        grasped: SystemId,
        most: &GripOffset,
    ) -> Result<(HeldId, f64), GraspRefused> {
        assert_eq!(self.robot(grasped).joint_count(), 0, "what is grasped is a rigid body");
        let found = self.grip_offset(id, frame, grasped);
        if !found.is_within(most) {
            return Err(GraspRefused(found));
        }
        let (body, before) = (self.body(grasped), self.state(id));
        let X_FT = self.pose(id, frame).inverse() * body.pose();
        let brought = self.system(grasped).momentum();
        let (robot, mass) = (self.system(id).robot, self.system(grasped).mass);
        let system = self.system_mut(id);
        // Held by its own frame: let go, it has it again.
        let frame = Frame { body: frame.body, X_BF: frame.X_BF * X_FT };
        let held = system.hold(Held { frame, matter: body.matter });
        system.take_in(mass, brought);
        let carrier = kinematics(&robot, &before).X_NB(frame.body);
        let about_carrier =
            SpatialForce::new(body.angular, body.linear).about(carrier.translation - body.p_NTcm_N);
        let h_B = SpatialForce::new(
            carrier.rotation.transpose_mul(about_carrier.torque),
            carrier.rotation.transpose_mul(about_carrier.force),
        );
        let jump = system.jump(&robot, &before, (frame.body, h_B));
        let holding_N = before.X_NB.rotation * jump.after.force.base.torque;
        system.turn_by_actuator(holding_N);
        let change = jump.energy - body.kinetic_energy();
        self.book(Source::AttitudeActuator, &Booking::of_turn(holding_N, 0.0));
        self.book(Source::Grasps, &Booking::of_work(change));
        self.systems[grasped.0] = None;
        for side in self.couplings.iter_mut().flatten().flat_map(|c| [&mut c.E, &mut c.F]) {
            if side.system == grasped {
                *side = side.on_held(id, held, &frame);
            }
        }
        self.part_within_bodies();
        self.make_room();
        Ok((held, change))
    }

    /// Let go of a payload. It goes on as it moves, as a system of its own.
    ///
    /// # Panics
    /// If nothing of this number is held.
    pub fn release(&mut self, id: SystemId, held: HeldId) -> SystemId {
        let state = self.state(id);
        let system = self.system_mut(id);
        let Some(Held { frame, matter }) = system.held[held.0].take() else {
            panic!("nothing of number {} is held", held.0)
        };
        let k = kinematics(&system.robot, &state);
        let V_NF_F = frame.X_BF.velocity_to_child(&k.V_NB_B(frame.body));
        let body = FreeBody::new(matter, &k.pose(&frame), &V_NF_F);
        let released = self.add_body(&body);
        let (p_cm, linear, angular) = self.system(released).momentum();
        let mass = self.system(released).mass;
        self.system_mut(id).take_in(-mass, (p_cm, -linear, -angular));
        for side in self.couplings.iter_mut().flatten().flat_map(|c| [&mut c.E, &mut c.F]) {
            if side.held.is_some_and(|(of, _)| of == held) && side.system == id {
                *side = side.let_go(released);
            }
        }
        released
    }
}

impl<const J: usize> crate::system::System<J> {
    fn hold(&mut self, held: Held) -> HeldId {
        self.held.push(Some(held));
        HeldId(self.held.len() - 1)
    }
    /// What it holds has changed: mass (kg), at its centre of mass with its momentum about the origin of
    /// N, is added; or taken away, where all of that is negative but the place.
    fn take_in(&mut self, mass: f64, (p_N, linear, angular): (Vec3<f64>, Vec3<f64>, Vec3<f64>)) {
        let (own_p, own_linear, own_angular) = self.momentum();
        let total = self.mass + mass;
        let p_cm = (own_p * self.mass + p_N * mass) * (1.0 / total);
        self.set_momentum(p_cm, own_linear + linear, own_angular + angular);
        self.weigh();
    }
}
