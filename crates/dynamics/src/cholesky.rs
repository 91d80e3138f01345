//! Cholesky factorization of a small symmetric positive definite matrix, in fixed memory.

use wrasse_spatial::Real;

/// `M = L Lᵀ` of the leading n×n part of an array.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cholesky<T, const N: usize> {
    n: usize,
    L: [[T; N]; N],
    /// `1/L[i][i]`.
    inverse_diagonal: [T; N],
    /// Smallest pivot `L[i][i]²`: its sign and size say how definite the matrix is.
    smallest_pivot: T,
}

impl<T: Real, const N: usize> Cholesky<T, N> {
    /// Factor the leading `n`×`n` part of a symmetric matrix; only its lower triangle is read.
    ///
    /// A matrix that is not positive definite gives a [`smallest_pivot`](Self::smallest_pivot) that
    /// is not positive (NaN among them) and a factor without meaning: no branch is taken here.
    #[inline(always)]
    pub fn new(M: &[[T; N]; N], n: usize) -> Self {
        let n = n.min(N);
        let mut c = Self {
            n,
            L: [[T::zero(); N]; N],
            inverse_diagonal: [T::one(); N],
            smallest_pivot: T::from_f64(f64::MAX.sqrt()),
        };
        for i in 0..n {
            for j in 0..=i {
                let mut sum = M[i][j];
                for k in 0..j {
                    sum -= c.L[i][k] * c.L[j][k];
                }
                if i == j {
                    // A NaN is smaller than nothing, so it is asked whether the old one is; the
                    // first pivot that is not positive stays.
                    let old = c.smallest_pivot;
                    let smaller = T::select(old.lt(sum), old, sum);
                    c.smallest_pivot = T::select(T::zero().lt(old), smaller, old);
                    c.L[i][i] = sum.sqrt();
                    c.inverse_diagonal[i] = T::one() / c.L[i][i];
                } else {
                    c.L[i][j] = sum * c.inverse_diagonal[j];
                }
            }
        }
        c
    }
    /// Smallest pivot; positive if and only if the matrix is positive definite.
    pub fn smallest_pivot(&self) -> T {
        self.smallest_pivot
    }
    /// `M⁻¹ b`; entries from n on are passed through.
    #[inline(always)]
    #[must_use]
    pub fn solve(&self, b: &[T; N]) -> [T; N] {
        let (mut x, n) = (*b, self.n.min(N));
        for i in 0..n {
            for k in 0..i {
                x[i] -= self.L[i][k] * x[k];
            }
            x[i] *= self.inverse_diagonal[i];
        }
        for i in (0..n).rev() {
            for k in i + 1..n {
                x[i] -= self.L[k][i] * x[k];
            }
            x[i] *= self.inverse_diagonal[i];
        }
        x
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const M: [[f64; 3]; 3] = [[4.0, 2.0, 0.6], [2.0, 5.0, -1.0], [0.6, -1.0, 3.0]];

    /// Round-off of three eliminations. Measured 2e-16.
    #[test]
    fn the_solution_satisfies_the_equations() {
        let b = [1.0, -2.0, 0.5];
        let x = Cholesky::new(&M, 3).solve(&b);
        for i in 0..3 {
            let row: f64 = (0..3).map(|k| M[i][k] * x[k]).sum();
            assert!((row - b[i]).abs() < 1e-15, "row {i}: {row}, not {}", b[i]);
        }
    }

    #[test]
    fn entries_beyond_the_leading_part_are_passed_through() {
        let x = Cholesky::new(&M, 2).solve(&[8.0, 9.0, 7.0]);
        assert_eq!(x[2], 7.0);
        assert!((4.0 * x[0] + 2.0 * x[1] - 8.0).abs() < 1e-15, "{x:?}");
    }

    /// Pivots by hand: 4, 5 - 2²/4 = 4, 3 - 0.6²/4 - 1.3²/4 = 2.4875. Round-off: measured 4e-16.
    #[test]
    fn the_smallest_pivot_is_the_one_by_hand() {
        let found = Cholesky::new(&M, 3).smallest_pivot();
        assert!((found - 2.4875).abs() < 1e-15, "{found}");
    }

    #[test]
    fn a_matrix_that_is_not_positive_definite_has_no_positive_pivot() {
        for (i, k, x) in [(0, 0, -4.0), (1, 1, 0.9), (2, 0, 9.0), (2, 2, f64::NAN)] {
            let mut spoilt = M;
            spoilt[i][k] = x;
            let pivot = Cholesky::new(&spoilt, 3).smallest_pivot();
            assert!(pivot.is_nan() || pivot <= 0.0, "element {i},{k} = {x}: {pivot}");
        }
    }
}
