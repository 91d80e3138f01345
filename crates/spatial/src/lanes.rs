//! Several numbers side by side, one to each lane of the processor.

use crate::kernel::With;
use crate::trigonometry::{is_near, near_sin_cos};
use crate::{Baseline, Instructions, Kernel, OneByOne, Real, Work};
use core::marker::PhantomData;
use core::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

/// `N` numbers that take the same way through a kernel at once. Each lane gives the bits that the
/// number would give alone, whatever the others are.
///
/// It is a plain array: the compiler makes vector instructions of it, of the width that the
/// surrounding function may use. `I` says which instructions that are: what goes
/// [`apart`](Real::apart) is built for them.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(C, align(64))]
pub struct Lanes<const N: usize, I: Instructions = Baseline>(pub [f64; N], PhantomData<I>);

/// The answer of a comparison in each lane: all bits set where it holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(C, align(64))]
pub struct LaneMask<const N: usize>([u64; N]);

impl<const N: usize, I: Instructions> Lanes<N, I> {
    /// These numbers, one to each lane.
    #[inline(always)]
    pub fn new(numbers: [f64; N]) -> Self {
        Self(numbers, PhantomData)
    }
    /// The number of each lane by its number.
    #[inline(always)]
    pub fn from_fn(f: impl FnMut(usize) -> f64) -> Self {
        Self::new(core::array::from_fn(f))
    }
    /// The number in a lane.
    #[inline(always)]
    pub fn lane(&self, i: usize) -> f64 {
        self.0[i]
    }
    #[inline(always)]
    fn zip(self, b: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        let mut out = [0.0; N];
        for i in 0..N {
            out[i] = f(self.0[i], b.0[i]);
        }
        Self::new(out)
    }
    #[inline(always)]
    fn map(self, f: impl Fn(f64) -> f64) -> Self {
        let mut out = [0.0; N];
        for i in 0..N {
            out[i] = f(self.0[i]);
        }
        Self::new(out)
    }
}

impl<const N: usize> LaneMask<N> {
    /// Whether the comparison holds in a lane.
    #[inline(always)]
    pub fn lane(&self, i: usize) -> bool {
        self.0[i] != 0
    }
    /// A mask by the number of the lane.
    #[inline(always)]
    pub fn from_fn(f: impl Fn(usize) -> bool) -> Self {
        Self(core::array::from_fn(|i| if f(i) { u64::MAX } else { 0 }))
    }
}

impl<const N: usize, I: Instructions> Default for Lanes<N, I> {
    #[inline(always)]
    fn default() -> Self {
        Self::new([0.0; N])
    }
}

macro_rules! operator {
    ($trait:ident, $method:ident, $sign:tt) => {
        impl<const N: usize, I: Instructions> $trait for Lanes<N, I> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, b: Self) -> Self {
                self.zip(b, |x, y| x $sign y)
            }
        }
    };
}
operator!(Add, add, +);
operator!(Sub, sub, -);
operator!(Mul, mul, *);
operator!(Div, div, /);

macro_rules! assignment {
    ($trait:ident, $method:ident, $sign:tt) => {
        impl<const N: usize, I: Instructions> $trait for Lanes<N, I> {
            #[inline(always)]
            fn $method(&mut self, b: Self) {
                *self = *self $sign b;
            }
        }
    };
}
assignment!(AddAssign, add_assign, +);
assignment!(SubAssign, sub_assign, -);
assignment!(MulAssign, mul_assign, *);

impl<const N: usize, I: Instructions> Neg for Lanes<N, I> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        self.map(|x| -x)
    }
}

impl<const N: usize, I: Instructions> Real for Lanes<N, I> {
    type Mask = LaneMask<N>;
    #[inline(always)]
    fn from_f64(x: f64) -> Self {
        Self::new([x; N])
    }
    #[inline(always)]
    fn epsilon() -> Self {
        Self::new([f64::EPSILON; N])
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        self.map(Real::sqrt)
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let mut beyond = false;
        for x in self.0 {
            beyond |= !is_near(x);
        }
        if beyond {
            return each_alone(&self);
        }
        near_sin_cos(self)
    }
    #[inline(always)]
    fn atan2(self, x: Self) -> Self {
        self.zip(x, Real::atan2)
    }
    #[inline(always)]
    fn lt(self, other: Self) -> LaneMask<N> {
        let mut mask = [0; N];
        for i in 0..N {
            mask[i] = if self.0[i] < other.0[i] { u64::MAX } else { 0 };
        }
        LaneMask(mask)
    }
    #[inline(always)]
    fn apart<W: Work>(work: W) -> W::Out {
        I::run(work)
    }
    #[inline(always)]
    fn dispatch<K: Kernel<Self>>(kernel: K) -> K::Out {
        I::run(With::<K, OneByOne<Self>>::layout(kernel))
    }
    #[inline(always)]
    fn select(mask: LaneMask<N>, a: Self, b: Self) -> Self {
        let mut out = [0.0; N];
        for i in 0..N {
            let (a, b) = (a.0[i].to_bits(), b.0[i].to_bits());
            out[i] = f64::from_bits((a & mask.0[i]) | (b & !mask.0[i]));
        }
        Self::new(out)
    }
}

/// Where one lane's angle is too large for the common way, each goes alone.
#[cold]
#[inline(never)]
fn each_alone<const N: usize, I: Instructions>(x: &Lanes<N, I>) -> (Lanes<N, I>, Lanes<N, I>) {
    let both = x.0.map(Real::sin_cos);
    (Lanes::new(both.map(|(s, _)| s)), Lanes::new(both.map(|(_, c)| c)))
}
