//! The inverse of `J Jᵀ`, damped where it comes close to singular, and how the damping changes.

use wrasse_spatial::Real;

/// `L D Lᵀ` of a symmetric 6×6 matrix, L with a unit diagonal.
#[derive(Debug, Clone, Copy)]
struct Factors<T> {
    /// Below the diagonal.
    L: [[T; 6]; 6],
    pivots: [T; 6],
    /// `1/pivot`; zero for a pivot that is not positive.
    inverse_pivots: [T; 6],
}

impl<T: Real> Factors<T> {
    /// Only the lower triangle is read. What stands behind a pivot that is not positive means
    /// nothing, but it is finite.
    #[inline(always)]
    fn new(A: &[[T; 6]; 6]) -> Self {
        let zero = [T::zero(); 6];
        let mut f = Self { L: [zero; 6], pivots: zero, inverse_pivots: zero };
        for i in 0..6 {
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
            f.pivots[i] = pivot;
            let positive = T::zero().lt(pivot);
            let divisor = T::select(positive, pivot, T::one());
            f.inverse_pivots[i] = T::select(positive, T::one() / divisor, T::zero());
        }
        f
    }

    /// The smallest pivot (the first that is not positive stays), and the direction z in which the
    /// matrix is as small as that: `pivot = zᵀ A z`, and with the matrix it changes as `zᵀ Ȧ z`.
    #[inline(always)]
    fn smallest(&self) -> (T, [T; 6]) {
        let (zero, one) = (T::zero(), T::one());
        let mut smallest = self.pivots[0];
        let mut z = [one, zero, zero, zero, zero, zero];
        for i in 1..6 {
            let next = T::select(zero.lt(smallest), self.pivots[i], smallest);
            let smaller = next.lt(smallest);
            smallest = T::select(smaller, next, smallest);
            (0..i).for_each(|k| z[k] = T::select(smaller, zero, z[k]));
            z[i] = T::select(smaller, one, zero);
        }
        for i in (1..6).rev() {
            for k in 0..i {
                z[k] -= self.L[i][k] * z[i];
            }
        }
        (smallest, z)
    }

    #[inline(always)]
    fn solve(&self, b: &[T; 6]) -> [T; 6] {
        let mut x = *b;
        for i in 1..6 {
            for k in 0..i {
                x[i] -= self.L[i][k] * x[k];
            }
        }
        for i in 0..6 {
            x[i] *= self.inverse_pivots[i];
        }
        for i in (1..6).rev() {
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
pub(crate) struct DampedInverse<T> {
    damped: Factors<T>,
    /// Direction of the smallest pivot.
    weakest: [T; 6],
    /// `dλ²/dpivot` (–).
    slope: T,
}

impl<T: Real> DampedInverse<T> {
    /// Of a symmetric matrix of which the lower triangle is given, damped below this singular value.
    #[inline(always)]
    pub(crate) fn new(JJt: &[[T; 6]; 6], damped_below: T) -> Self {
        let (pivot, weakest) = Factors::new(JJt).smallest();
        let floor = damped_below * damped_below;
        let lack = T::one() - pivot / floor;
        let held = lack.max(T::zero()).min(T::one());
        let damping = floor * held * held;
        let mut A = *JJt;
        (0..6).for_each(|r| A[r][r] += damping);
        let steady = lack.lt(T::one());
        let slope = T::select(steady, T::from_f64(-2.0) * held, T::zero());
        Self { damped: Factors::new(&A), weakest, slope }
    }
    /// `(J Jᵀ + λ² 1)⁻¹ b`.
    #[inline(always)]
    pub(crate) fn solve(&self, b: &[T; 6]) -> [T; 6] {
        self.damped.solve(b)
    }
    /// Time derivative of λ², for columns of J that change at these rates.
    #[inline(always)]
    pub(crate) fn damping_rate<'a>(
        &self,
        columns: impl Iterator<Item = (&'a [T; 6], &'a [T; 6])>,
    ) -> T {
        let dot = |a: &[T; 6], z: &[T; 6]| (1..6).fold(a[0] * z[0], |sum, r| sum + a[r] * z[r]);
        let mut half = T::zero();
        for (column, rate) in columns {
            half += dot(column, &self.weakest) * dot(rate, &self.weakest);
        }
        self.slope * (half + half)
    }
}
