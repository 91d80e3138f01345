//! Quantities of several vehicles put side by side into lanes, and taken out again.

use crate::{
    Instructions, Lanes, Mat3, Pose, Quat, SpatialForce, SpatialInertia, SpatialVelocity, Sym3,
    Vec3,
};

/// A quantity over lanes, made of one for each lane.
pub trait SideBySide<const N: usize> {
    /// The quantity of one lane.
    type Alone: Copy;
    /// From that of each lane by its number.
    #[must_use]
    fn side_by_side(of: &impl Fn(usize) -> Self::Alone) -> Self;
    /// That of one lane.
    #[must_use]
    fn lane(&self, i: usize) -> Self::Alone;
}

impl<const N: usize, I: Instructions> SideBySide<N> for Lanes<N, I> {
    type Alone = f64;
    #[inline(always)]
    fn side_by_side(of: &impl Fn(usize) -> f64) -> Self {
        Self::from_fn(of)
    }
    #[inline(always)]
    fn lane(&self, i: usize) -> f64 {
        self.0[i]
    }
}

impl<const N: usize, const J: usize, E: SideBySide<N>> SideBySide<N> for [E; J] {
    type Alone = [E::Alone; J];
    #[inline(always)]
    fn side_by_side(of: &impl Fn(usize) -> [E::Alone; J]) -> Self {
        core::array::from_fn(|j| E::side_by_side(&|i| of(i)[j]))
    }
    #[inline(always)]
    fn lane(&self, i: usize) -> [E::Alone; J] {
        core::array::from_fn(|j| self[j].lane(i))
    }
}

macro_rules! of_parts {
    ($kind:ident, $($part:ident),+) => {
        impl<const N: usize, I: Instructions> SideBySide<N> for $kind<Lanes<N, I>> {
            type Alone = $kind<f64>;
            #[inline(always)]
            fn side_by_side(of: &impl Fn(usize) -> $kind<f64>) -> Self {
                Self { $($part: SideBySide::side_by_side(&|i| of(i).$part)),+ }
            }
            #[inline(always)]
            fn lane(&self, i: usize) -> $kind<f64> {
                $kind { $($part: self.$part.lane(i)),+ }
            }
        }
    };
}
of_parts!(Vec3, x, y, z);
of_parts!(Mat3, rows);
of_parts!(Sym3, xx, xy, xz, yy, yz, zz);
of_parts!(Quat, w, x, y, z);
of_parts!(Pose, rotation, translation);
of_parts!(SpatialVelocity, angular, linear);
of_parts!(SpatialForce, torque, force);
of_parts!(SpatialInertia, mass, first_moment, rotational);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vec3;

    #[test]
    fn what_is_put_side_by_side_is_taken_out_again() {
        let pose = |i: usize| {
            let x = f64::from(u8::try_from(i).unwrap());
            let quat = Quat::exp(vec3(0.1 * x, 0.2, -0.3));
            Pose::from_quat(quat, vec3(x, 1.0 - x, 2.0))
        };
        let poses = <[Pose<Lanes<4>>; 2]>::side_by_side(&|i| [pose(i), pose(i + 7)]);
        for i in 0..4 {
            assert_eq!(SideBySide::<4>::lane(&poses, i), [pose(i), pose(i + 7)]);
        }
    }
}
