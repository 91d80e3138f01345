//! How the links of a robot go through an algorithm: one at a time, or some abreast in the lanes of a
//! register.

use crate::{
    ClassicalAcceleration, Mat3, Real, SpatialForce, SpatialInertia, SpatialVelocity, Sym3, Vec3,
    vec3,
};
use core::fmt::Debug;
use core::marker::PhantomData;
use core::ops::IndexMut;

/// How many links are taken at a time through the parts of an algorithm that treat all links alike.
/// Every layout gives the same bits.
///
/// What works on some links must be inlined into the function that is built for the processor's
/// registers: `#[inline(always)]`, and no closure over them, for those are not.
pub trait Layout: Copy + Debug + 'static {
    /// A number of one link.
    type One: Real;
    /// The same number of some links.
    type Some: Real;
    /// How many those are.
    const LINKS: usize;
    /// Eight numbers in such groups.
    type Eight: Copy + Debug + IndexMut<usize, Output = Self::Some>;
    /// All eight the same.
    fn eight(all: Self::Some) -> Self::Eight;
    /// As many groups as a group has places.
    type Square: Copy + Debug + IndexMut<usize, Output = Self::Some>;
    /// All of them the same.
    fn square(all: Self::Some) -> Self::Square;
    /// Rows and columns exchanged.
    fn transpose(rows: Self::Square) -> Self::Square;
    /// Those of the first [`LINKS`](Self::LINKS) places; zeros if there are fewer.
    fn load(from: &[Self::One]) -> Self::Some;
    /// Into the first [`LINKS`](Self::LINKS) places, if there are so many.
    fn store(some: Self::Some, to: &mut [Self::One]);
    /// The same number for each.
    fn all(one: Self::One) -> Self::Some;
    /// The same vector for each.
    #[inline(always)]
    fn all3(one: Vec3<Self::One>) -> Vec3<Self::Some> {
        vec3(Self::all(one.x), Self::all(one.y), Self::all(one.z))
    }
}

/// One link after the other, over any number: flight processors, and vehicles side by side.
#[derive(Debug, Clone, Copy)]
pub struct OneByOne<T>(PhantomData<T>);

impl<T: Real> Layout for OneByOne<T> {
    type One = T;
    type Some = T;
    const LINKS: usize = 1;
    type Eight = [T; 8];
    #[inline(always)]
    fn eight(all: T) -> [T; 8] {
        [all; 8]
    }
    type Square = [T; 1];
    #[inline(always)]
    fn square(all: T) -> [T; 1] {
        [all]
    }
    #[inline(always)]
    fn transpose(rows: [T; 1]) -> [T; 1] {
        rows
    }
    #[inline(always)]
    fn load(from: &[T]) -> T {
        from.first().copied().unwrap_or_default()
    }
    #[inline(always)]
    fn store(some: T, to: &mut [T]) {
        if let Some(to) = to.first_mut() {
            *to = some;
        }
    }
    #[inline(always)]
    fn all(one: T) -> T {
        one
    }
}

/// Links that are taken at a time, by the number of the first.
#[derive(Debug, Clone, Copy)]
pub struct Group<L>(usize, PhantomData<L>);

impl<L: Layout> Group<L> {
    /// The group that a link belongs to.
    #[inline(always)]
    pub fn of(link: usize) -> Self {
        Self(link / L::LINKS * L::LINKS, PhantomData)
    }
    /// The first link.
    #[inline(always)]
    pub fn first(self) -> usize {
        self.0
    }
    /// The groups before this one, from one on.
    #[inline(always)]
    pub fn from(self, first: Self) -> impl Iterator<Item = Self> {
        (first.0..self.0).step_by(L::LINKS).map(|i| Self(i, PhantomData))
    }
    /// The next group.
    #[inline(always)]
    #[must_use]
    pub fn next(self) -> Self {
        Self(self.0 + L::LINKS, PhantomData)
    }
}

/// All groups of the first `count` of `J` links; `J` must be a multiple of [`Layout::LINKS`].
#[inline(always)]
pub fn groups<L: Layout, const J: usize>(
    count: usize,
) -> impl DoubleEndedIterator<Item = Group<L>> {
    // The last bound is for the compiler.
    let last = J.saturating_sub(L::LINKS);
    let number = count.min(J).div_ceil(L::LINKS);
    (0..number).map(move |g| Group((g * L::LINKS).min(last), PhantomData))
}

/// A quantity of each link, its components in rows: that of one link, or of a group of links.
pub trait At<I> {
    /// The quantity of one, or of some.
    type Out;
    /// That of link or group `i`.
    fn at(&self, i: I) -> Self::Out;
    /// Make it that of link or group `i`.
    fn put(&mut self, i: I, x: Self::Out);
}

/// The number of a link has a bound that the compiler sees: no robot has another, and code without a
/// panic is what flies.
impl<T: Real, const J: usize> At<usize> for [T; J] {
    type Out = T;
    #[inline(always)]
    fn at(&self, i: usize) -> T {
        if J == 0 { T::zero() } else { self[i.min(J - 1)] }
    }
    #[inline(always)]
    fn put(&mut self, i: usize, x: T) {
        if J > 0 {
            self[i.min(J - 1)] = x;
        }
    }
}

impl<L: Layout, const J: usize> At<Group<L>> for [L::One; J] {
    type Out = L::Some;
    #[inline(always)]
    fn at(&self, i: Group<L>) -> L::Some {
        L::load(self.get(i.0..i.0 + L::LINKS).unwrap_or_default())
    }
    #[inline(always)]
    fn put(&mut self, i: Group<L>, x: L::Some) {
        L::store(x, self.get_mut(i.0..i.0 + L::LINKS).unwrap_or_default());
    }
}

/// Quantities of each link, in rows.
pub trait Rows {
    /// All zero.
    fn zero_rows() -> Self;
}

impl<T: Real, const J: usize> Rows for [T; J] {
    #[inline(always)]
    fn zero_rows() -> Self {
        [T::zero(); J]
    }
}

macro_rules! of_parts {
    ($kind:ident, $($part:ident),+) => {
        impl<I: Copy, R: At<I>> At<I> for $kind<R> {
            type Out = $kind<R::Out>;
            #[inline(always)]
            fn at(&self, i: I) -> Self::Out {
                $kind { $($part: self.$part.at(i)),+ }
            }
            #[inline(always)]
            fn put(&mut self, i: I, x: Self::Out) {
                $(self.$part.put(i, x.$part);)+
            }
        }
        impl<R: Rows> Rows for $kind<R> {
            #[inline(always)]
            fn zero_rows() -> Self {
                Self { $($part: Rows::zero_rows()),+ }
            }
        }
    };
}
of_parts!(Vec3, x, y, z);
of_parts!(Sym3, xx, xy, xz, yy, yz, zz);
of_parts!(SpatialVelocity, angular, linear);
of_parts!(ClassicalAcceleration, angular, linear);
of_parts!(SpatialForce, torque, force);
of_parts!(SpatialInertia, mass, first_moment, rotational);

impl<I: Copy, R: At<I>> At<I> for Mat3<R> {
    type Out = Mat3<R::Out>;
    #[inline(always)]
    fn at(&self, i: I) -> Self::Out {
        let [x, y, z] = &self.rows;
        Mat3 { rows: [x.at(i), y.at(i), z.at(i)] }
    }
    #[inline(always)]
    fn put(&mut self, i: I, M: Self::Out) {
        let ([x, y, z], [a, b, c]) = (&mut self.rows, M.rows);
        x.put(i, a);
        y.put(i, b);
        z.put(i, c);
    }
}
impl<R: Rows> Rows for Mat3<R> {
    #[inline(always)]
    fn zero_rows() -> Self {
        Self { rows: [Rows::zero_rows(), Rows::zero_rows(), Rows::zero_rows()] }
    }
}

macro_rules! columns {
    ($kind:ident) => {
        impl<T: Real, const J: usize> $kind<[T; J]> {
            /// Those of all links, one by one.
            #[inline(always)]
            pub fn columns(&self) -> [$kind<T>; J] {
                core::array::from_fn(|j| self.at(j))
            }
        }
    };
}
columns!(SpatialVelocity);
columns!(SpatialForce);

/// Several quantities of each link at a time.
impl<I: Copy, A: At<I>, B: At<I>> At<I> for (&mut A, &mut B) {
    type Out = (A::Out, B::Out);
    #[inline(always)]
    fn at(&self, i: I) -> Self::Out {
        (self.0.at(i), self.1.at(i))
    }
    #[inline(always)]
    fn put(&mut self, i: I, (a, b): Self::Out) {
        self.0.put(i, a);
        self.1.put(i, b);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vec3;

    crate::kernel! {
        /// Squares of seven numbers.
        fn squares<L, T, J>(x: &[T; J], out: &mut [T; J]) {
            for i in groups::<L, J>(7) {
                let x = x.at(i);
                out.put(i, x * x);
            }
        }
    }

    #[test]
    fn every_layout_takes_every_link_once() {
        let x = core::array::from_fn::<f64, 8, _>(|i| i as f64);
        let squares_of = |i: usize| (i * i) as f64;
        let mut out = [0.0; 8];
        squares(&x, &mut out);
        assert_eq!(out[..7], core::array::from_fn::<_, 7, _>(squares_of));
        let (few, mut odd) = (core::array::from_fn::<f64, 7, _>(|i| i as f64), [0.0; 7]);
        squares(&few, &mut odd);
        assert_eq!(odd, core::array::from_fn(squares_of));
    }

    #[test]
    fn the_vector_of_a_link_is_a_column_of_the_rows() {
        let mut v: Vec3<[f64; 4]> = Rows::zero_rows();
        v.put(2, vec3(1.0, 2.0, 3.0));
        let one: Group<OneByOne<f64>> = Group::of(2);
        assert_eq!((v.at(2), v.at(1), v.at(one)), (vec3(1.0, 2.0, 3.0), Vec3::zero(), v.at(2)));
    }
}
