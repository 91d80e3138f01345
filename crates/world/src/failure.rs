//! What can break, and what its breaking does.

use crate::setup::{BaseAttitude, Drive};
use crate::thrusters::Jammed;
use crate::world::World;
use wrasse_dynamics::{JointDrive, PerBody, State, driven_dynamics, kinematics};
use wrasse_spatial::{SpatialForce, SpatialVelocity, Vec3};

/// Something that breaks, from now on: a valve from the next command on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Failure {
    /// The motor of this wheel gives nothing; the friction of its bearing stays.
    Wheel(usize),
    /// This gimbal is stuck.
    Gimbal(usize),
    /// This thruster stays shut.
    ThrusterShut(usize),
    /// This thruster stays open.
    ThrusterOpen(usize),
}

impl<const J: usize> World<J> {
    /// Let something break. What there is not cannot break, and what does not act, on a base that is
    /// held, breaks unseen: nothing happens.
    pub fn fail(&mut self, failure: Failure) {
        if self.base == BaseAttitude::Held {
            return;
        }
        match failure {
            Failure::Wheel(i) => self.wheels.break_motor(i),
            Failure::Gimbal(i) if i < self.cmgs.count() => {
                let had = core::mem::take(&mut self.system.gimbal_rate[i]);
                self.carry.gimbal_rate[i] = 0.0;
                // What the gimbal had is the bodies' now: the sum of both stays, and with it the state.
                let impulse_B = self.cmgs.jam(i, had);
                self.jolt(impulse_B);
            }
            Failure::Gimbal(_) => {}
            Failure::ThrusterShut(i) => self.thrusters.jam(i, Jammed::Shut),
            Failure::ThrusterOpen(i) => self.thrusters.jam(i, Jammed::Open),
        }
    }

    /// An angular impulse (N·m·s, base axes) that something inside gives the base at once. Joints that
    /// are driven by torque give way; prescribed joints keep their rates.
    ///
    /// The base's twist follows from the momentum that wheels and CMGs no longer hold; what is left
    /// to find are the joint rates: `M Δν = impulse` is forward dynamics at rest.
    fn jolt(&mut self, impulse_B: Vec3<f64>) {
        let t = self.into_period;
        let at_rest =
            State { V_NB_B: SpatialVelocity::zero(), v: [0.0; J], ..self.expand(&self.system, t) };
        let drives = self.drives.map(|drive| match drive {
            Drive::Follow(_) => JointDrive::Acceleration(0.0),
            Drive::Effort(_) => JointDrive::Effort(0.0),
        });
        let mut impulses = PerBody::filled(SpatialForce::zero());
        impulses.base.torque = impulse_B;
        let k = kinematics(&self.robot, &at_rest);
        let jump = driven_dynamics(&k, &drives, self.base.mode(), &impulses);
        for j in self.robot.joints() {
            self.system.v[j] += jump.nudot.joints[j];
        }
        // The work of an impulse is the impulse times the mean of the rates before and after.
        let after = self.state();
        let mean_w = after.V_NB_B.angular - jump.nudot.base.angular * 0.5;
        self.booked.work.y += impulse_B.dot(mean_w);
        for j in self.robot.joints() {
            let mean_v = after.v[j] - jump.nudot.joints[j] * 0.5;
            self.booked.work.x += jump.force.joints[j] * mean_v;
        }
    }
}
