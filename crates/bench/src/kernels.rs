//! The kernels: each a whole call, from joint angles to the result.

use crate::Subject;
use std::hint::black_box;
use wrasse_dynamics::{
    BodyId, Frame, Generalized, GeneralizedForce, GeneralizedVelocity, Outside, base_rows,
    forward_dynamics, forward_dynamics_derivatives, generalized_jacobian, inverse_dynamics,
    inverse_dynamics_derivatives, jacobian, kinematics, mass_matrix, momentum_matrix,
};
use wrasse_spatial::{Pose, Real, SpatialForce, Work};

/// What is worked out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// Forces of a motion.
    InverseDynamics,
    /// The mass matrix.
    MassMatrix,
    /// Accelerations of forces.
    ForwardDynamics,
    /// The momentum matrix.
    MomentumMatrix,
    /// The generalized Jacobian of the last link.
    GeneralizedJacobian,
}

/// All of them, by the names that results carry.
pub const KERNELS: [(&str, Quantity); 5] = [
    ("inverse_dynamics", Quantity::InverseDynamics),
    ("mass_matrix", Quantity::MassMatrix),
    ("forward_dynamics", Quantity::ForwardDynamics),
    ("momentum_matrix", Quantity::MomentumMatrix),
    ("generalized_jacobian", Quantity::GeneralizedJacobian),
];

/// Derivatives are worked out one vehicle at a time: nobody waits for many.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Derivative {
    /// Of inverse dynamics.
    InverseDynamics,
    /// Of forward dynamics.
    ForwardDynamics,
}

/// Both, by the names that results carry.
pub const DERIVATIVES: [(&str, Derivative); 2] = [
    ("inverse_dynamics_derivatives", Derivative::InverseDynamics),
    ("forward_dynamics_derivatives", Derivative::ForwardDynamics),
];

/// One call for one state.
#[derive(Debug, Clone, Copy)]
pub struct Call<'a, Q, T, const J: usize> {
    /// What.
    pub quantity: Q,
    /// Of which robot.
    pub subject: &'a Subject<T, J>,
    /// In which of its states.
    pub state: usize,
}

impl<T: Real, const J: usize> Work for Call<'_, Quantity, T, J> {
    type Out = ();
    #[inline(always)]
    fn run(self) {
        let (robot, (state, nudot)) = (&self.subject.robot, &self.subject.states[self.state]);
        let k = kinematics(robot, state);
        match self.quantity {
            Quantity::InverseDynamics => {
                black_box(&inverse_dynamics(&k, nudot, Outside::nothing()).force);
            }
            Quantity::MassMatrix => {
                black_box(&mass_matrix(&k));
            }
            Quantity::ForwardDynamics => {
                black_box(&forward_dynamics(&k, &force(nudot), Outside::nothing()));
            }
            Quantity::MomentumMatrix => {
                black_box(&momentum_matrix(&base_rows(&k), &state.X_NB.rotation));
            }
            Quantity::GeneralizedJacobian => {
                let body = BodyId::Link(robot.joint_count().saturating_sub(1));
                let J_frame = jacobian(&k, &Frame { body, X_BF: Pose::identity() });
                black_box(&generalized_jacobian(&J_frame, &base_rows(&k)));
            }
        }
    }
}

impl<T: Real, const J: usize> Work for Call<'_, Derivative, T, J> {
    type Out = ();
    #[inline(always)]
    fn run(self) {
        let (robot, (state, nudot)) = (&self.subject.robot, &self.subject.states[self.state]);
        let k = kinematics(robot, state);
        match self.quantity {
            Derivative::InverseDynamics => {
                black_box(&inverse_dynamics_derivatives(&k, nudot, Outside::nothing()));
            }
            Derivative::ForwardDynamics => {
                black_box(&forward_dynamics_derivatives(&k, &force(nudot), Outside::nothing()));
            }
        }
    }
}

/// Forces of the same numbers.
#[inline(always)]
fn force<T: Real, const J: usize>(nudot: &GeneralizedVelocity<T, J>) -> GeneralizedForce<T, J> {
    let base = SpatialForce::new(nudot.base.angular, nudot.base.linear);
    Generalized { base, joints: nudot.joints }
}
