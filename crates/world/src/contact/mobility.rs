//! How much a point of a system gives way to an impulse: the inverse effective mass there.

use crate::gears::with_gears;
use crate::scene::{Scene, SystemId};
use wrasse_dynamics::{BodyId, JointDrive, PerBody, State, driven_dynamics, kinematics};
use wrasse_spatial::{Mat3, SpatialForce, SpatialVelocity, Vec3, vec3};

impl<const J: usize> Scene<J> {
    /// Velocity of a point of a body (inertial axes) per impulse there (1/kg): `J M⁻¹ Jᵀ`. Prescribed joints
    /// and a held attitude do not give way.
    ///
    /// # Panics
    /// If the system is part of another now.
    pub fn mobility(&self, id: SystemId, body: BodyId, x: Vec3<f64>) -> Mat3<f64> {
        let (system, state) = (self.system(id), self.state(id));
        let at_rest = State { V_NB_B: SpatialVelocity::zero(), v: [0.0; J], ..state };
        let k = kinematics(&system.robot, &at_rest);
        let X_NB = k.X_NB(body);
        let p_B = X_NB.rotation.transpose_mul(x - X_NB.translation);
        let drives = core::array::from_fn(|j| {
            if system.drive_is_followed(j) {
                JointDrive::Acceleration(0.0)
            } else {
                JointDrive::Effort(0.0)
            }
        });
        let given = |impulse_N: Vec3<f64>| {
            let f_B = X_NB.rotation.transpose_mul(impulse_N);
            let mut on = PerBody::filled(SpatialForce::zero());
            on[body] += SpatialForce::new(p_B.cross(f_B), f_B);
            let mut found = driven_dynamics(&k, &drives, system.base.mode(), &on);
            if !system.followers.is_empty() {
                with_gears(&system.followers, &drives, &mut |drives| {
                    found = driven_dynamics(&k, drives, system.base.mode(), &on);
                    found.force.joints
                });
            }
            let moved = State { V_NB_B: found.nudot.base, v: found.nudot.joints, ..at_rest };
            let V = kinematics(&system.robot, &moved).V_NB_B(body);
            X_NB.rotation * (V.linear + V.angular.cross(p_B))
        };
        let columns = [vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0), vec3(0.0, 0.0, 1.0)].map(given);
        Mat3 { rows: columns }
    }
}
