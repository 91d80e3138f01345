//! Reaction null space: joint motions that leave the base's attitude alone.

use crate::{MassMatrix, Robot};
use wrasse_spatial::{Real, Vec3};

/// Columns of `H_w`: angular momentum about the system's centre of mass per joint rate, joints moving
/// against a base that does not turn, base axes (N·m·s per rad/s or m/s).
pub fn angular_momentum_per_rate<T: Real, const J: usize>(M: &MassMatrix<T, J>) -> [Vec3<T>; J] {
    let p_BScm_B = M.M_bb.centre_of_mass();
    M.M_bj.map(|h_B| h_B.about(p_BScm_B).torque)
}

/// `(1 - H_w⁺ H_w) ξ`: the part of the joint rates `ξ` that does not turn the base.
///
/// Directions that the arm cannot turn the base about (a planar arm has two) drop out of `H_w`: a row
/// of less than 1e-9 of the largest one is taken for round-off.
///
/// # Source
/// [`Nenchev1992`](wrasse_spatial::references::Nenchev1992).
pub fn reaction_null_space<T: Real, const J: usize>(
    robot: &Robot<T, J>,
    M: &MassMatrix<T, J>,
    xi: &[T; J],
) -> [T; J] {
    let H_w = angular_momentum_per_rate(M);
    let mut rows: [[T; J]; 3] = [H_w.map(|h| h.x), H_w.map(|h| h.y), H_w.map(|h| h.z)];
    let dot = |a: &[T; J], b: &[T; J]| robot.joints().fold(T::zero(), |sum, j| sum + a[j] * b[j]);
    let largest = rows.iter().fold(T::zero(), |m, r| m.max(dot(r, r)));
    let floor = largest * T::from_f64(1e-18);
    let mut rates = *xi;
    for i in 0..3 {
        // Gram–Schmidt, twice, so that the rows are orthogonal to round-off.
        for _ in 0..2 {
            for e in 0..i {
                let along = dot(&rows[e], &rows[i]);
                for j in robot.joints() {
                    rows[i][j] -= along * rows[e][j];
                }
            }
        }
        let square = dot(&rows[i], &rows[i]);
        let counts = floor.lt(square);
        let scale =
            T::select(counts, T::one() / T::select(counts, square, T::one()).sqrt(), T::zero());
        for j in robot.joints() {
            rows[i][j] *= scale;
        }
        let along = dot(&rows[i], &rates);
        for j in robot.joints() {
            rates[j] -= along * rows[i][j];
        }
    }
    rates
}
