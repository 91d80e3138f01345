//! The kernels: each a whole call, from joint angles to the result.

use crate::Subject;
use std::hint::black_box;
use wrasse_dynamics::{
    BodyId, Frame, Generalized, Outside, base_rows, forward_dynamics, forward_dynamics_derivatives,
    generalized_jacobian, inverse_dynamics, inverse_dynamics_derivatives, jacobian, kinematics,
    mass_matrix, momentum_matrix,
};
use wrasse_lanes::Kernel;
use wrasse_spatial::{Pose, Real, SpatialForce};

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
    /// Derivatives of inverse dynamics.
    InverseDynamicsDerivatives,
    /// Derivatives of forward dynamics.
    ForwardDynamicsDerivatives,
}

/// All of them, by the names that results carry.
pub const KERNELS: [(&str, Quantity); 7] = [
    ("inverse_dynamics", Quantity::InverseDynamics),
    ("mass_matrix", Quantity::MassMatrix),
    ("forward_dynamics", Quantity::ForwardDynamics),
    ("momentum_matrix", Quantity::MomentumMatrix),
    ("generalized_jacobian", Quantity::GeneralizedJacobian),
    ("inverse_dynamics_derivatives", Quantity::InverseDynamicsDerivatives),
    ("forward_dynamics_derivatives", Quantity::ForwardDynamicsDerivatives),
];

/// One call for one state.
#[derive(Debug, Clone, Copy)]
pub struct Work<'a, T, const J: usize> {
    /// What.
    pub quantity: Quantity,
    /// Of which robot.
    pub subject: &'a Subject<T, J>,
    /// In which of its states.
    pub state: usize,
}

impl<T: Real, const J: usize> Kernel for Work<'_, T, J> {
    type Out = ();
    #[inline(always)]
    fn run(self) {
        let (robot, (state, nudot)) = (&self.subject.robot, &self.subject.states[self.state]);
        let force = Generalized {
            base: SpatialForce::new(nudot.base.angular, nudot.base.linear),
            joints: nudot.joints,
        };
        let k = kinematics(robot, state);
        match self.quantity {
            Quantity::InverseDynamics => {
                black_box(&inverse_dynamics(&k, nudot, Outside::nothing()).force);
            }
            Quantity::MassMatrix => {
                black_box(&mass_matrix(&k));
            }
            Quantity::ForwardDynamics => {
                black_box(&forward_dynamics(&k, &force, Outside::nothing()));
            }
            Quantity::MomentumMatrix => {
                black_box(&momentum_matrix(&base_rows(&k), &state.X_NB.rotation));
            }
            Quantity::GeneralizedJacobian => {
                let body = BodyId::Link(robot.joint_count().saturating_sub(1));
                let J_frame = jacobian(&k, &Frame { body, X_BF: Pose::identity() });
                black_box(&generalized_jacobian(&J_frame, &base_rows(&k)));
            }
            Quantity::InverseDynamicsDerivatives => {
                black_box(&inverse_dynamics_derivatives(&k, nudot, Outside::nothing()));
            }
            Quantity::ForwardDynamicsDerivatives => {
                black_box(&forward_dynamics_derivatives(&k, &force, Outside::nothing()));
            }
        }
    }
}
