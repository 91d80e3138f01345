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
    /// A matrix that is not positive definite gives a [`smallest_pivot`](Self::smallest_pivot) ≤ 0 and
    /// a factor without meaning: no branch is taken here.
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
                    c.smallest_pivot = c.smallest_pivot.min(sum);
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
        let mut x = *b;
        for i in 0..self.n {
            for k in 0..i {
                x[i] -= self.L[i][k] * x[k];
            }
            x[i] *= self.inverse_diagonal[i];
        }
        for i in (0..self.n).rev() {
            for k in i + 1..self.n {
                x[i] -= self.L[k][i] * x[k];
            }
            x[i] *= self.inverse_diagonal[i];
        }
        x
    }
}
