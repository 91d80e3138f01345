//! The kernels: each a whole call, from joint positions to the result, into places that are there.

use crate::Subject;
use std::hint::black_box;
use wrasse_dynamics::{
    BaseMode, BodyId, Configuration, ForwardDynamics, Frame, Generalized, InverseDynamics,
    Jacobian, JointDrive, MassMatrix, MomentumMatrix, Outside, accelerate, configure, drive, fill,
    forward_dynamics_derivatives, generalized_columns, inverse_dynamics_derivatives,
    jacobian_columns, kinematics, momentum_columns, place,
};
use wrasse_spatial::{Mat3, Pose, Real, Rows, SpatialForce, SpatialVelocity, Vec3};

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

/// Kernels that are timed for many states too, the first of all.
pub const BATCHES: usize = 3;

/// Places for all that the kernels work out.
#[derive(Debug)]
pub struct Places<T, const J: usize> {
    at: Configuration<T, J>,
    inverse: InverseDynamics<T, J>,
    forward: ForwardDynamics<T, J>,
    M: MassMatrix<T, J>,
    A: MomentumMatrix<T, J>,
    J_frame: Jacobian<T, J>,
    columns: SpatialVelocity<[T; J]>,
}

impl<T: Real, const J: usize> Places<T, J> {
    /// Empty.
    pub fn new() -> Self {
        let (joints, R_NB) = (Rows::zero_rows(), Mat3::identity());
        Self {
            at: Configuration::new(),
            inverse: InverseDynamics::new(),
            forward: ForwardDynamics::new(),
            M: MassMatrix::new(),
            A: MomentumMatrix { base: [SpatialForce::zero(); 6], joints: Rows::zero_rows() },
            J_frame: Jacobian { R_NB, p_BE_N: Vec3::zero(), joints },
            columns: joints,
        }
    }

    /// Work a derivative, or any other quantity, out for one of a subject's states.
    pub fn call_any(&mut self, quantity: Quantity, subject: &Subject<T, J>, state: usize) {
        let (robot, (at, nudot)) = (&subject.robot, &subject.states[state]);
        let base = SpatialForce::new(nudot.base.angular, nudot.base.linear);
        match quantity {
            Quantity::InverseDynamicsDerivatives => {
                let k = kinematics(robot, at);
                black_box(&inverse_dynamics_derivatives(&k, nudot, Outside::nothing()));
            }
            Quantity::ForwardDynamicsDerivatives => {
                let (k, force) =
                    (kinematics(robot, at), Generalized { base, joints: nudot.joints });
                black_box(&forward_dynamics_derivatives(&k, &force, Outside::nothing()));
            }
            _ => self.call(quantity, subject, state),
        }
    }

    /// Work a quantity that is no derivative out for one of a subject's states.
    pub fn call(&mut self, quantity: Quantity, subject: &Subject<T, J>, state: usize) {
        let (robot, (state, nudot)) = (&subject.robot, &subject.states[state]);
        let R_NB = &state.X_NB.rotation;
        match quantity {
            Quantity::InverseDynamics => {
                place(robot, &state.q, &mut self.at.posture);
                let (nu, none) = (state.velocity(), Outside::nothing());
                drive(robot, &self.at.posture, &nu, nudot, none, &mut self.inverse);
                black_box(&self.inverse.force);
            }
            Quantity::MassMatrix => {
                place(robot, &state.q, &mut self.at.posture);
                fill(robot, &self.at.posture, &mut self.at.composite, &mut self.M);
                black_box(&self.M);
            }
            Quantity::ForwardDynamics => {
                configure(robot, &state.q, &mut self.at);
                let drives = nudot.joints.map(JointDrive::Effort);
                let mut outside = Outside::nothing();
                outside.base = SpatialForce::new(nudot.base.angular, nudot.base.linear);
                let (nu, free) = (state.velocity(), BaseMode::Free);
                accelerate(robot, &self.at, &nu, &drives, free, outside, &mut self.forward);
                black_box(&self.forward.found);
            }
            Quantity::MomentumMatrix => {
                configure(robot, &state.q, &mut self.at);
                momentum_columns(&self.at.base, R_NB, &mut self.A);
                black_box(&self.A);
            }
            Quantity::GeneralizedJacobian => {
                configure(robot, &state.q, &mut self.at);
                let body = BodyId::Link(robot.joint_count().saturating_sub(1));
                let frame = Frame { body, X_BF: Pose::identity() };
                self.J_frame.R_NB = *R_NB;
                jacobian_columns(robot, &self.at.posture, &frame, &mut self.J_frame);
                generalized_columns(&self.J_frame, &self.at.base, &mut self.columns);
                black_box(&self.columns);
            }
            Quantity::InverseDynamicsDerivatives | Quantity::ForwardDynamicsDerivatives => {}
        }
    }
}

impl<T: Real, const J: usize> Default for Places<T, J> {
    fn default() -> Self {
        Self::new()
    }
}
