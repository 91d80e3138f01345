//! The solution of least peak: no larger value anywhere than must be.

use super::span::{Span, all_finite, least_norm, no_angle, sum, thinnest};
use wrasse_spatial::{Scalar, Vec3};

/// The x of least `max |x_k|` whose `Σ axis_k x_k` comes nearest to what is wanted; zero for axes not
/// used.
///
/// All sums with `|x_k| ≤ 1` fill a zonotope, whose faces have normals across two of the axes, or one
/// axis in a plane. The least peak is how far it must be blown up to hold what is wanted, which the
/// steepest face says: `t = max n·wanted / Σ |n·axis_k|`. Every axis off that face must then stand at
/// ±t; those in it share what is left, which is the same question with one dimension less. So at most
/// three rounds, each over every pair, give the exact answer, and the peak of the rest is least too.
pub(super) fn least_peak<T: Scalar, const N: usize>(
    axes: &[Vec3<T>; N],
    used: &[bool; N],
    wanted: Vec3<T>,
) -> [T; N] {
    let (mut x, mut free) = ([T::zero(); N], *used);
    let wanted = Span::of(axes, used, thinnest()).inside(wanted);
    for _ in 0..3 {
        let span = Span::of(axes, &free, no_angle());
        let left = span.inside(wanted - sum(axes, &x));
        let Some(face) = steepest_face(axes, &free, &span, left) else { break };
        for k in 0..N {
            let slope = axes[k].dot(face.normal);
            if free[k] && slope.abs() > no_angle::<T>() * axes[k].norm() * face.normal.norm() {
                x[k] = if slope > T::zero() { face.peak } else { -face.peak };
                free[k] = false;
            }
        }
    }
    // What was taken to lie in a face may be off it by the tolerance: the sum is made exact.
    let rest = least_norm(axes, used, wanted - sum(axes, &x));
    let x = core::array::from_fn(|k| x[k] + rest[k]);
    if all_finite(&x) { x } else { [T::zero(); N] }
}

/// A face of the zonotope, and how far it must be moved out.
struct Face<T> {
    normal: Vec3<T>,
    peak: T,
}

/// The face that what is wanted lies farthest beyond; none if nothing is wanted or no axis is there.
fn steepest_face<T: Scalar, const N: usize>(
    axes: &[Vec3<T>; N],
    free: &[bool; N],
    span: &Span<T>,
    wanted: Vec3<T>,
) -> Option<Face<T>> {
    let mut steepest = Face { normal: Vec3::zero(), peak: T::zero() };
    let mut see = |normal: Vec3<T>| {
        let there = (0..N).filter(|&k| free[k]);
        let width = there.fold(T::zero(), |w, k| w + axes[k].dot(normal).abs());
        let height = normal.dot(wanted);
        let peak = height.abs() / width;
        if peak > steepest.peak && peak.is_finite() {
            let normal = if height > T::zero() { normal } else { -normal };
            steepest = Face { normal, peak };
        }
    };
    match *span.directions() {
        [only] => see(only),
        [e, f] => {
            let across = e.cross(f);
            (0..N).filter(|&k| free[k]).for_each(|k| see(axes[k].cross(across)));
        }
        _ => {
            for i in (0..N).filter(|&i| free[i]) {
                for j in (0..i).filter(|&j| free[j]) {
                    let normal = axes[i].cross(axes[j]);
                    // Nearly parallel axes have a face too thin to matter, and no sure normal.
                    if normal.norm() > no_angle::<T>() * axes[i].norm() * axes[j].norm() {
                        see(normal);
                    }
                }
            }
        }
    }
    (steepest.peak > T::zero()).then_some(steepest)
}
