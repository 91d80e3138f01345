//! How near an arm is to where it cannot go on: reach left, singular values left.

use nalgebra::{SMatrix, SymmetricEigen};
use wrasse_dynamics::{BodyId, Frame, JointKind, Kinematics};
use wrasse_flight::Task;
use wrasse_spatial::SpatialVelocity;

/// Smallest singular value of the task's rows of a Jacobian (m, rad), from the eigenvalues of `J Jᵀ`.
pub(crate) fn smallest_singular_value<const J: usize>(
    columns: &[SpatialVelocity<f64>; J],
    task: Task,
) -> f64 {
    let mut JJt = SMatrix::<f64, 6, 6>::zeros();
    for column in columns {
        let c = nalgebra::Vector6::from(column.to_array());
        JJt += c * c.transpose();
    }
    let first = match task {
        Task::Pose => 0,
        Task::Position => 3,
    };
    // Rows that are not asked for are made harmless: larger than any that is.
    for r in 0..first {
        JJt.row_mut(r).fill(0.0);
        JJt.column_mut(r).fill(0.0);
        JJt[(r, r)] = JJt.trace().max(1.0);
    }
    SymmetricEigen::new(JJt).eigenvalues.min().max(0.0).sqrt()
}

/// How much farther the tool could be from its mount if the arm were stretched out straight (m): a
/// bound, reached only where nothing else stops the arm. `None` where a joint on the way slides.
pub(crate) fn reach_margin<const J: usize>(
    k: &Kinematics<'_, f64, J>,
    tool: &Frame<f64>,
) -> Option<f64> {
    let tip = k.pose(tool).translation;
    let (mut stretched, mut mount) = (0.0, tip);
    for j in k.robot.path_to_base(tool.body) {
        if k.robot.joint(j).kind == JointKind::Prismatic {
            return None;
        }
        let next = k.X_NB(BodyId::Link(j)).translation;
        stretched += (next - mount).norm();
        mount = next;
    }
    let moves = tool.body != BodyId::Base;
    moves.then(|| stretched - (tip - mount).norm())
}
