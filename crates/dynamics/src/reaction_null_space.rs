//! Reaction null space: joint motions that leave the base's attitude alone.

use crate::{BaseRows, Robot};
use wrasse_spatial::{At, Real, Vec3};

/// Columns of `H_w`: angular momentum about the system's centre of mass per joint rate, joints
/// moving against a base that does not turn, base axes (N·m·s per rad/s or m/s).
pub fn angular_momentum_per_rate<T: Real, const J: usize>(M: &BaseRows<T, J>) -> [Vec3<T>; J] {
    let p_BScm_B = M.M_bb.centre_of_mass();
    core::array::from_fn(|j| M.M_bj.at(j).about(p_BScm_B).torque)
}

/// `(1 - H_w⁺ H_w) ξ`: the part of the joint rates `ξ` that does not turn the base.
///
/// Directions that the arm cannot turn the base about (a planar arm has two) drop out of `H_w`:
/// what is left of a row beside the larger ones is taken for round-off below 1000 ε of the largest
/// row.
///
/// # Source
/// [`Nenchev1992`](wrasse_spatial::references::Nenchev1992).
pub fn reaction_null_space<T: Real, const J: usize>(
    robot: &Robot<T, J>,
    M: &BaseRows<T, J>,
    xi: &[T; J],
) -> [T; J] {
    let H_w = angular_momentum_per_rate(M);
    let rows = orthonormal([H_w.map(|h| h.x), H_w.map(|h| h.y), H_w.map(|h| h.z)], robot);
    let mut rates = *xi;
    for row in &rows {
        take_out(&mut rates, row, robot);
    }
    rates
}

fn dot<T: Real, const J: usize>(a: &[T; J], b: &[T; J], robot: &Robot<T, J>) -> T {
    robot.joints().fold(T::zero(), |sum, j| sum + a[j] * b[j])
}

/// Orthonormal rows that span the same space; rows of round-off become zero.
fn orthonormal<T: Real, const J: usize>(mut rows: [[T; J]; 3], robot: &Robot<T, J>) -> [[T; J]; 3] {
    let mut largest = T::zero();
    for i in 0..3 {
        // The largest of what is left goes first: a small row would pass on its round-off.
        for e in i + 1..3 {
            let larger = dot(&rows[i], &rows[i], robot).lt(dot(&rows[e], &rows[e], robot));
            for j in robot.joints() {
                let (a, b) = (rows[i][j], rows[e][j]);
                (rows[i][j], rows[e][j]) = (T::select(larger, b, a), T::select(larger, a, b));
            }
        }
        // Gram–Schmidt a second time, so that the rows are orthogonal to round-off.
        for e in 0..i {
            let done = rows[e];
            take_out(&mut rows[i], &done, robot);
        }
        let square = dot(&rows[i], &rows[i], robot);
        largest = largest.max(square);
        let floor = T::from_f64(1e3) * T::epsilon();
        let counts = (largest * floor * floor).lt(square);
        let length = T::select(counts, square, T::one()).sqrt();
        let scale = T::select(counts, T::one() / length, T::zero());
        for j in robot.joints() {
            rows[i][j] *= scale;
        }
        let done = rows[i];
        for row in &mut rows[i + 1..] {
            take_out(row, &done, robot);
        }
    }
    rows
}

/// Leave only what is across a unit row.
fn take_out<T: Real, const J: usize>(row: &mut [T; J], unit: &[T; J], robot: &Robot<T, J>) {
    let along = dot(unit, row, robot);
    for j in robot.joints() {
        row[j] -= along * unit[j];
    }
}
