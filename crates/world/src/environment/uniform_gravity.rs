//! The same gravity everywhere.

use crate::effectors::Load;
use wrasse_dynamics::Kinematics;
use wrasse_spatial::{SpatialForce, Vec3};

/// `m g` on each body at its centre of mass, which is `p × m g` about the origin of N; `g` in inertial
/// axes (m/s²).
pub(crate) fn pull<const J: usize>(
    k: &Kinematics<'_, f64, J>,
    acceleration_N: Vec3<f64>,
    load: &mut Load<'_, J>,
) {
    for body in k.robot.bodies() {
        let M_B = k.robot.inertia(body);
        if M_B.mass > 0.0 {
            let weight_B = k.X_NB(body).rotation.transpose_mul(acceleration_N) * M_B.mass;
            let torque_B = M_B.centre_of_mass().cross(weight_B);
            load.push(k, body, &SpatialForce::new(torque_B, weight_B));
        }
    }
}
