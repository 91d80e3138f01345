//! The inverse of `J Jᵀ`, damped where it comes close to singular, and how the damping changes.

use wrasse_spatial::Real;

/// `L D Lᵀ` of a symmetric R×R matrix, L with a unit diagonal.
#[derive(Debug, Clone, Copy)]
struct Factors<T, const R: usize> {
    /// Below the diagonal.
    L: [[T; R]; R],
    pivots: [T; R],
    /// `1/pivot`; zero for a pivot that is not positive.
    inverse_pivots: [T; R],
}

impl<T: Real, const R: usize> Factors<T, R> {
    /// Only the lower triangle is read. What stands behind a pivot that is not positive means
    /// nothing, but it is finite.
    #[inline(always)]
    fn new(A: &[[T; R]; R]) -> Self {
        let zero = [T::zero(); R];
        let mut f = Self { L: [zero; R], pivots: zero, inverse_pivots: zero };
        for i in 0..R {
            let mut pivot = A[i][i];
            // `scaled[k]` is L[i][k] times its pivot.
            let mut scaled = zero;
            for j in 0..i {
                scaled[j] = A[i][j];
                for k in 0..j {
                    scaled[j] -= f.L[j][k] * scaled[k];
                }
            }
            for j in 0..i {
                f.L[i][j] = scaled[j] * f.inverse_pivots[j];
                pivot -= f.L[i][j] * scaled[j];
            }
            f.set_pivot(i, pivot);
        }
        f
    }

    /// The same of `J Jᵀ`, from the columns of J, whose rows are made orthogonal one after the other
    /// (modified Gram-Schmidt). The round-off of the product would hide the small pivots: in single
    /// precision by several times the floor of the damping.
    ///
    /// Rows before the first one that counts have the pivot one.
    #[inline(always)]
    fn of_columns(columns: &mut [[T; R]], first: usize) -> Self {
        let one = [T::one(); R];
        let mut f = Self { L: [[T::zero(); R]; R], pivots: one, inverse_pivots: one };
        let first = first.min(R - 1);
        let mut share = [T::zero(); R];
        for column in columns.iter() {
            (0..R).for_each(|i| share[i] += column[first] * column[i]);
        }
        for k in first..R - 1 {
            f.set_pivot(k, share[k]);
            (0..R).for_each(|i| share[i] *= f.inverse_pivots[k]);
            (k + 1..R).for_each(|i| f.L[i][k] = share[i]);
            let mut products = [T::zero(); R];
            for column in columns.iter_mut() {
                // This row out of those behind it; those before it are zero by now.
                let own = column[k];
                (0..R).for_each(|i| column[i] -= share[i] * own);
                (0..R).for_each(|i| products[i] += column[k + 1] * column[i]);
            }
            share = products;
        }
        f.set_pivot(R - 1, share[R - 1]);
        f
    }

    /// The lower triangle of the matrix, with something added to the diagonal.
    #[inline(always)]
    fn plus(&self, diagonal: T) -> [[T; R]; R] {
        let mut A = [[T::zero(); R]; R];
        for i in 0..R {
            let mut scaled = [T::zero(); R];
            A[i][i] = self.pivots[i] + diagonal;
            for j in 0..i {
                scaled[j] = self.L[i][j] * self.pivots[j];
                A[i][j] = scaled[j];
                (0..j).for_each(|k| A[i][j] += scaled[k] * self.L[j][k]);
                A[i][i] += scaled[j] * self.L[i][j];
            }
        }
        A
    }

    #[inline(always)]
    fn set_pivot(&mut self, i: usize, pivot: T) {
        self.pivots[i] = pivot;
        let positive = T::zero().lt(pivot);
        let divisor = T::select(positive, pivot, T::one());
        self.inverse_pivots[i] = T::select(positive, T::one() / divisor, T::zero());
    }

    /// The smallest pivot (the first that is not positive stays), and the direction z in which the
    /// matrix is as small as that: `pivot = zᵀ A z`, and with the matrix it changes as `zᵀ Ȧ z`.
    #[inline(always)]
    fn smallest(&self) -> (T, [T; R]) {
        let (zero, one) = (T::zero(), T::one());
        let mut smallest = self.pivots[0];
        let mut z = [zero; R];
        z[0] = one;
        for i in 1..R {
            let next = T::select(zero.lt(smallest), self.pivots[i], smallest);
            let smaller = next.lt(smallest);
            smallest = T::select(smaller, next, smallest);
            (0..i).for_each(|k| z[k] = T::select(smaller, zero, z[k]));
            z[i] = T::select(smaller, one, zero);
        }
        for i in (1..R).rev() {
            for k in 0..i {
                z[k] -= self.L[i][k] * z[i];
            }
        }
        (smallest, z)
    }

    #[inline(always)]
    fn solve(&self, b: &[T; R]) -> [T; R] {
        let mut x = *b;
        for i in 1..R {
            for k in 0..i {
                x[i] -= self.L[i][k] * x[k];
            }
        }
        for i in 0..R {
            x[i] *= self.inverse_pivots[i];
        }
        for i in (1..R).rev() {
            for k in 0..i {
                x[k] -= self.L[i][k] * x[i];
            }
        }
        x
    }
}

/// `(J Jᵀ + λ² 1)⁻¹`, with λ zero while the smallest pivot stays above a floor.
///
/// # Source
/// Damping after [`NakamuraHanafusa1986`](wrasse_spatial::references::NakamuraHanafusa1986), with the
/// smallest pivot in place of the manipulability.
#[derive(Debug, Clone, Copy)]
pub(crate) struct DampedInverse<T, const R: usize> {
    damped: Factors<T, R>,
    /// Direction of the smallest pivot.
    weakest: [T; R],
    /// `dλ²/dpivot` (–).
    slope: T,
}

impl<T: Real, const R: usize> DampedInverse<T, R> {
    /// From the columns of J, of which the rows from `first` on count; damped below this singular value.
    #[inline(always)]
    pub(crate) fn new(columns: &mut [[T; R]], first: usize, damped_below: T) -> Self {
        let bare = Factors::of_columns(columns, first);
        let (pivot, weakest) = bare.smallest();
        let floor = damped_below * damped_below;
        let lack = T::one() - pivot / floor;
        let held = lack.max(T::zero()).min(T::one());
        let damping = floor * held * held;
        let steady = lack.lt(T::one());
        let slope = T::select(steady, T::from_f64(-2.0) * held, T::zero());
        Self { damped: Factors::new(&bare.plus(damping)), weakest, slope }
    }
    /// `(J Jᵀ + λ² 1)⁻¹ b`.
    #[inline(always)]
    pub(crate) fn solve(&self, b: &[T; R]) -> [T; R] {
        self.damped.solve(b)
    }
    /// Time derivative of λ², for columns of J that change at these rates.
    #[inline(always)]
    pub(crate) fn damping_rate<'a>(
        &self,
        columns: impl Iterator<Item = (&'a [T; R], &'a [T; R])>,
    ) -> T {
        let dot = |a: &[T; R], z: &[T; R]| (1..R).fold(a[0] * z[0], |sum, r| sum + a[r] * z[r]);
        let mut half = T::zero();
        for (column, rate) in columns {
            half += dot(column, &self.weakest) * dot(rate, &self.weakest);
        }
        self.slope * (half + half)
    }
}
