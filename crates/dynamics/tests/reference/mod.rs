//! Inverse dynamics as the textbook has it: link by link, each in its body's own axes, with spatial
//! accelerations. Slow, and to be read.

use wrasse_dynamics::{BodyId, GeneralizedVelocity, PerBody, Robot, State};
use wrasse_spatial::{Pose, SpatialForce, SpatialVelocity};

/// Joint forces of a motion without wrenches from outside: [`Featherstone2008`] table 5.1, on a moving
/// base.
///
/// [`Featherstone2008`]: wrasse_spatial::references::Featherstone2008
pub(crate) fn inverse_dynamics<const J: usize>(
    robot: &Robot<f64, J>,
    state: &State<f64, J>,
    nudot: &GeneralizedVelocity<f64, J>,
) -> [f64; J] {
    let mut V: PerBody<SpatialVelocity<f64>, J> = PerBody::filled(state.V_NB_B);
    let mut A: PerBody<SpatialVelocity<f64>, J> = PerBody::filled(nudot.base);
    let mut F: PerBody<SpatialForce<f64>, J> = PerBody::filled(SpatialForce::zero());
    let mut X_PB = [Pose::identity(); J];
    for i in robot.joints() {
        let (joint, body) = (robot.joint(i), BodyId::Link(i));
        let (vJ, p) = (joint.velocity(state.v[i]), joint.parent);
        X_PB[i] = joint.X_PB(state.q[i]);
        V[body] = X_PB[i].velocity_to_child(&V[p]) + vJ;
        let S_qddot = joint.velocity(nudot.joints[i]);
        A[body] = X_PB[i].velocity_to_child(&A[p]) + S_qddot + V[body].cross(&vJ);
        let I = *robot.inertia(body);
        F[body] = I * A[body] + V[body].cross_force(&(I * V[body]));
    }
    let mut tau = [0.0; J];
    for i in robot.joints().rev() {
        let F_i = F.links[i];
        tau[i] = robot.joint(i).project(&F_i);
        F[robot.joint(i).parent] += X_PB[i].force_to_parent(&F_i);
    }
    tau
}
