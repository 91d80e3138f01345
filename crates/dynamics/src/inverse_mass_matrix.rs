//! The inverse of the mass matrix: accelerations per unit force.

use crate::factorization::Columns;
use crate::{Factorization, Generalized, GeneralizedForce, GeneralizedVelocity, MassMatrix, Robot};
use core::array;
use wrasse_spatial::{OneByOne, Real, SpatialForce, SpatialVelocity};

/// `M⁻¹` in the blocks of [`MassMatrix`]; symmetric.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InverseMassMatrix<T, const J: usize> {
    /// Number of joints, n.
    pub count: usize,
    /// Columns of the base block: the base's acceleration per unit wrench on it, torque first.
    pub A_bb: [SpatialVelocity<T>; 6],
    /// Columns of the coupling block: the base's acceleration per unit force of each joint.
    pub A_bj: [SpatialVelocity<T>; J],
    /// Joint block; rows and columns from the number of joints on are zero.
    pub A_jj: [[T; J]; J],
}

/// Inverse of the mass matrix: arm by arm with the base held, then the base with what hangs on it.
///
/// No branch is taken on a value: a mass matrix that is not positive definite gives numbers without
/// meaning.
pub fn inverse_mass_matrix<T: Real, const J: usize>(
    robot: &Robot<T, J>,
    M: &MassMatrix<T, J>,
) -> InverseMassMatrix<T, J> {
    let (mut factors, free) = (Factorization::new(), [T::one(); J]);
    factors.eliminate::<OneByOne<T>>(robot, &M.base, &free, &Generalized::default());
    InverseMassMatrix::of(robot, &factors)
}

/// Columns that are solved for at a time: enough to fill the processor's lanes.
const SOME: usize = 4;

impl<T: Real, const J: usize> InverseMassMatrix<T, J> {
    #[inline(always)]
    pub(crate) fn nothing() -> Self {
        Self {
            count: 0,
            A_bb: [SpatialVelocity::zero(); 6],
            A_bj: [SpatialVelocity::zero(); J],
            A_jj: [[T::zero(); J]; J],
        }
    }
    /// From the factors of the mass matrix: the answers to unit forces.
    #[inline(always)]
    pub(crate) fn of(robot: &Robot<T, J>, M: &Factorization<T, J>) -> Self {
        let mut found = Self::nothing();
        let n = robot.joint_count();
        found.count = n;
        let (mut unit, mut answer) = (Columns::zero(), Columns::zero());
        for first in (0..n).step_by(SOME) {
            let columns: [usize; SOME] = array::from_fn(|c| (first + c).min(n - 1));
            for i in robot.joints() {
                unit.joints[i] = columns.map(|j| if i == j { T::one() } else { T::zero() });
            }
            M.solve(robot, &unit, &mut answer);
            for (c, &j) in columns.iter().enumerate() {
                found.A_bj[j] = answer.base_column(c);
                for i in robot.joints() {
                    found.A_jj[i][j] = answer.joints[i][c];
                }
            }
        }
        for (c, column) in found.A_bb.iter_mut().enumerate() {
            let unit = array::from_fn(|r| if r == c { T::one() } else { T::zero() });
            *column = M.push_base(&SpatialForce::from_array(unit));
        }
        found
    }
    /// `M⁻¹ force`.
    #[inline(always)]
    pub fn times(&self, force: &GeneralizedForce<T, J>) -> GeneralizedVelocity<T, J> {
        let n = self.count.min(J);
        let mut found = Generalized { base: SpatialVelocity::zero(), joints: [T::zero(); J] };
        let six = force.base.to_array();
        for c in 0..6 {
            found.base += self.A_bb[c] * six[c];
        }
        for j in 0..n {
            found.base += self.A_bj[j] * force.joints[j];
            found.joints[j] = self.A_bj[j].power(&force.base);
            for i in 0..n {
                found.joints[j] += self.A_jj[j][i] * force.joints[i];
            }
        }
        found
    }
    /// One element of the whole matrix; `row` and `column` in 0..6+n.
    pub fn element(&self, row: usize, column: usize) -> T {
        match (row.checked_sub(6), column.checked_sub(6)) {
            (None, None) => self.A_bb[column].to_array()[row],
            (None, Some(j)) => self.A_bj[j].to_array()[row],
            (Some(j), None) => self.A_bj[j].to_array()[column],
            (Some(i), Some(j)) => self.A_jj[i][j],
        }
    }
}
