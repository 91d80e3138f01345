//! The paper's Jacobian: base attitude held, centre of mass at rest.

use crate::{BaseRows, Jacobian};
use wrasse_spatial::{At, Mat3, Real, SpatialVelocity};

/// `J̄`: twist of the frame per joint rate, base rotation held and linear momentum zero.
///
/// Its rotational rows are the arm's own; its linear rows are those of the frame less those of the
/// system's centre of mass, because the base recoils so that the centre of mass stays.
///
/// # Source
/// [`Ellery2004`](wrasse_spatial::references::Ellery2004), below eq. (7), mended: as printed it
/// sums over the column index, leaves out the payload term and has no rotational rows.
#[inline(always)]
pub fn attitude_held_jacobian<T: Real, const J: usize>(
    J_frame: &Jacobian<T, J>,
    M: &BaseRows<T, J>,
    R_NB: &Mat3<T>,
) -> SpatialVelocity<[T; J]> {
    let per_mass = T::one() / M.M_bb.mass;
    let mut columns = J_frame.joints;
    for j in 0..M.count.min(J) {
        let mut V = columns.at(j);
        V.linear -= *R_NB * M.M_bj.at(j).force * per_mass;
        columns.put(j, V);
    }
    columns
}
