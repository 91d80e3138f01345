//! The span of some axes, and the solution of least norm in it.

use wrasse_spatial::{Mat3, Scalar, Sym3, Vec3};

/// Sine of an angle that may be round-off of none.
pub(super) fn no_angle<T: Scalar>() -> T {
    T::epsilon().sqrt()
}

/// Sine below which an axis adds no direction to solve for: the normal equations square it, and must
/// stay well above round-off.
pub(super) fn thinnest<T: Scalar>() -> T {
    T::from_f64(16.0) * no_angle()
}

/// What some axes span: orthonormal directions, as many as the rank.
#[derive(Debug, Clone, Copy)]
pub(super) struct Span<T> {
    basis: [Vec3<T>; 3],
    rank: usize,
}

impl<T: Scalar> Span<T> {
    /// Span of the axes that are used; lengths do not matter. An axis counts as inside if the sine of
    /// its angle to the span is below the least one.
    pub(super) fn of<const N: usize>(axes: &[Vec3<T>; N], used: &[bool; N], least_sine: T) -> Self {
        let mut span = Self { basis: [Vec3::zero(); 3], rank: 0 };
        while span.rank < 3 {
            // The axis that stands out most is the next direction.
            let (mut most, mut direction) = (least_sine, Vec3::zero());
            for k in (0..N).filter(|&k| used[k]) {
                let out = span.across(unit(axes[k]));
                if most < out.norm() {
                    (most, direction) = (out.norm(), out);
                }
            }
            if direction == Vec3::zero() {
                break;
            }
            // Once more, since round-off has grown with the division.
            span.basis[span.rank] = unit(span.across(unit(direction)));
            span.rank += 1;
        }
        span
    }
    /// The orthonormal directions.
    pub(super) fn directions(&self) -> &[Vec3<T>] {
        self.basis.get(..self.rank).unwrap_or(&self.basis)
    }
    /// Part of a vector inside the span.
    pub(super) fn inside(&self, v: Vec3<T>) -> Vec3<T> {
        self.directions().iter().fold(Vec3::zero(), |sum, &e| sum + e * e.dot(v))
    }
    /// Part of a vector across the span.
    pub(super) fn across(&self, v: Vec3<T>) -> Vec3<T> {
        self.directions().iter().fold(v, |rest, &e| rest - e * e.dot(rest))
    }
}

/// A vector at length one; zero stays zero.
fn unit<T: Scalar>(v: Vec3<T>) -> Vec3<T> {
    let length = v.norm();
    if length > T::zero() { v * (T::one() / length) } else { Vec3::zero() }
}

/// `Σ axis_k x_k`.
pub(super) fn sum<T: Scalar, const N: usize>(axes: &[Vec3<T>; N], x: &[T; N]) -> Vec3<T> {
    axes.iter().zip(x).fold(Vec3::zero(), |sum, (&axis, &x)| sum + axis * x)
}

/// `A Aᵀ` of the axes that are used.
pub(super) fn gram<T: Scalar, const N: usize>(axes: &[Vec3<T>; N], used: &[bool; N]) -> Sym3<T> {
    let each = axes.iter().zip(used).filter(|(_, used)| **used);
    each.fold(Sym3::zero(), |G, (&a, _)| G + Sym3::symmetric_part(&a.outer(a)))
}

/// The x of least norm whose `Σ axis_k x_k` comes nearest to what is wanted; zero for axes not used.
#[doc(alias = "Moore-Penrose")]
pub(super) fn least_norm<T: Scalar, const N: usize>(
    axes: &[Vec3<T>; N],
    used: &[bool; N],
    wanted: Vec3<T>,
) -> [T; N] {
    let span = Span::of(axes, used, thinnest());
    // Across the span anything positive will do: nothing is wanted there.
    let mut G = gram(axes, used);
    let size = G.xx + G.yy + G.zz;
    let ones = Mat3::identity();
    let rows = ones.rows.map(|e| span.across(e) * size);
    G += Sym3::symmetric_part(&Mat3 { rows });
    let mut x = [T::zero(); N];
    // The second round takes back the round-off of the first.
    for _ in 0..2 {
        let y = G.solve(span.inside(wanted - sum(axes, &x)));
        for k in (0..N).filter(|&k| used[k]) {
            x[k] += axes[k].dot(y);
        }
    }
    // Without any axis the equations have no solution; what is wanted may be beyond all numbers.
    if all_finite(&x) { x } else { [T::zero(); N] }
}

/// Whether all are finite.
pub(super) fn all_finite<T: Scalar>(x: &[T]) -> bool {
    x.iter().all(|x| x.is_finite())
}

/// The largest part, at most the whole, of `extra` that fits on top of `x` between the bounds.
pub(super) fn share_that_fits<T: Scalar, const N: usize>(
    x: &[T; N],
    extra: &[T; N],
    lower: &[T; N],
    upper: &[T; N],
) -> T {
    let (mut share, zero) = (T::one(), T::zero());
    for k in 0..N {
        let bound = if extra[k] > zero { upper[k] } else { lower[k] };
        if extra[k] != zero {
            share = share.min(((bound - x[k]) / extra[k]).max(zero));
        }
    }
    share
}
