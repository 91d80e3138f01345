//! Covariance of the errors of attitude and gyro bias: what a linear map makes of it.

use wrasse_spatial::{Mat3, Real, Sym3, Vec3};

/// Covariance of two errors of three components each: attitude a (rad) and bias b (rad/s), base
/// axes. Symmetric as it stands: the block below the diagonal is the transpose of `ab`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ErrorCovariance<T> {
    /// Of the attitude (rad²).
    pub(crate) aa: Sym3<T>,
    /// Of attitude and bias (rad²/s).
    pub(crate) ab: Mat3<T>,
    /// Of the bias (rad²/s²).
    pub(crate) bb: Sym3<T>,
}

/// A linear map of the two errors, by blocks.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ErrorMap<T> {
    pub(crate) aa: Mat3<T>,
    pub(crate) ab: Mat3<T>,
    pub(crate) ba: Mat3<T>,
    pub(crate) bb: Mat3<T>,
}

impl<T: Real> ErrorCovariance<T> {
    /// Errors of attitude (rad) and bias (rad/s) that know nothing of each other, each the same
    /// about every axis.
    pub(crate) fn of_sigmas(attitude: T, bias: T) -> Self {
        Self { aa: isotropic(attitude * attitude), ab: Mat3::zero(), bb: isotropic(bias * bias) }
    }
    /// `M P Mᵀ`.
    pub(crate) fn mapped(&self, M: &ErrorMap<T>) -> Self {
        let (aa, ab, bb) = (self.aa.to_mat3(), self.ab, self.bb.to_mat3());
        let ba = ab.transpose();
        // Rows of M P.
        let (top_a, top_b) = (M.aa * aa + M.ab * ba, M.aa * ab + M.ab * bb);
        let (low_a, low_b) = (M.ba * aa + M.bb * ba, M.ba * ab + M.bb * bb);
        let to_a = (M.aa.transpose(), M.ab.transpose());
        let to_b = (M.ba.transpose(), M.bb.transpose());
        Self {
            aa: Sym3::symmetric_part(&(top_a * to_a.0 + top_b * to_a.1)),
            ab: top_a * to_b.0 + top_b * to_b.1,
            bb: Sym3::symmetric_part(&(low_a * to_b.0 + low_b * to_b.1)),
        }
    }
    /// With another covariance added.
    pub(crate) fn with(&self, more: &Self) -> Self {
        Self { aa: self.aa + more.aa, ab: self.ab + more.ab, bb: self.bb + more.bb }
    }
}

/// `s 1`.
pub(crate) fn isotropic<T: Real>(s: T) -> Sym3<T> {
    Sym3::diagonal(s, s, s)
}

/// `∫₀¹ exp(-s [u]×) ds` for a turn `u` (rad): the mean of the axes on the way, seen from its end.
/// In closed form `1 - (1 - cos θ)/θ² [u] + (θ - sin θ)/θ³ [u]²`.
pub(crate) fn mean_of_turn<T: Real>(u: Vec3<T>) -> Mat3<T> {
    let (c, square) = (T::from_f64, u.dot(u));
    // Below 0.03 rad the quotients lose more digits than their series leave out.
    let small = square.lt(c(1e-3));
    let theta = T::select(small, T::one(), square).sqrt();
    let (sin, cos) = theta.sin_cos();
    let first = T::select(
        small,
        c(0.5) - square * (c(1.0 / 24.0) - square * c(1.0 / 720.0)),
        (T::one() - cos) / square,
    );
    let second = T::select(
        small,
        c(1.0 / 6.0) - square * (c(1.0 / 120.0) - square * c(1.0 / 5040.0)),
        (theta - sin) / (square * theta),
    );
    let skew = u.skew();
    Mat3::identity() - skew.scaled(first) + (skew * skew).scaled(second)
}

#[cfg(test)]
mod tests {
    use super::*;
    use wrasse_spatial::{Quat, vec3};
    use wrasse_testing::largest;

    fn worst(difference: Mat3<f64>) -> f64 {
        largest(difference.rows.iter().map(|row| row.norm()))
    }

    /// Against Simpson's rule with 200 intervals, for a small turn and a large one.
    /// Measured 4e-16, and 1.8e-12 of Simpson's own.
    #[test]
    fn the_mean_of_a_turn_is_the_integral_it_stands_for() {
        for u in [vec3(0.01, -0.02, 0.015), vec3(0.9, -1.4, 0.7)] {
            let back = |s: f64| Quat::exp(u * -s).to_matrix();
            let n = 200;
            let sum = (0..n).fold(Mat3::zero(), |sum, k| {
                let at = |offset: f64| (f64::from(k) + offset) / f64::from(n);
                sum + (back(at(0.0)) + back(at(0.5)).scaled(4.0) + back(at(1.0))).scaled(1.0 / 6.0)
            });
            let off = worst(mean_of_turn(u) - sum.scaled(1.0 / f64::from(n)));
            assert!(off < 1e-11, "{u:?}: {off:e}");
        }
    }

    /// The quotients lose 1e-13 there. Measured 3e-14.
    #[test]
    fn series_and_closed_form_of_the_mean_join_without_a_step() {
        let theta = Real::sqrt(1e-3_f64);
        let [below, above] =
            [1.0 - 1e-12, 1.0 + 1e-12].map(|s| mean_of_turn(vec3(0.0, theta * s, 0.0)));
        let step = worst(below - above);
        assert!(step < 1e-12, "{step:e}");
    }

    /// By hand, with multiples of the identity: variance of `2a + 3b` and `b - a`.
    #[test]
    fn a_map_makes_of_variances_what_the_textbook_says() {
        let one = Mat3::identity();
        let P = ErrorCovariance { aa: isotropic(5.0), ab: one.scaled(0.5), bb: isotropic(7.0) };
        let M =
            ErrorMap { aa: one.scaled(2.0), ab: one.scaled(3.0), ba: one.scaled(-1.0), bb: one };
        let Q = P.mapped(&M);
        assert_eq!(Q.aa, isotropic(4.0 * 5.0 + 2.0 * 6.0 * 0.5 + 9.0 * 7.0));
        assert_eq!(Q.ab, one.scaled(-2.0 * 5.0 + (2.0 - 3.0) * 0.5 + 3.0 * 7.0));
        assert_eq!(Q.bb, isotropic(5.0 - 2.0 * 0.5 + 7.0));
    }
}
