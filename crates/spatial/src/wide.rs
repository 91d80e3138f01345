//! Numbers in the vector registers of x86-64, and functions built for processors that have them.
//!
//! Each operation is one instruction, and rounds as that of a single number: every width gives the same
//! bits. Registers that only some processors have are reached through [`Instructions::run`] alone, which
//! asks the processor first: no code outside of this crate can name the layouts that use them.
#![allow(unsafe_code, reason = "instructions of a processor, used where it was found to have them")]
#![allow(clippy::wildcard_imports, reason = "each name begins with its own set of instructions")]

use crate::kernel::With;
use crate::trigonometry::{BEYOND, near_sin_cos};
use crate::{Baseline, Instructions, Kernel, Layout, Level, OneByOne, Real, Work};
use core::arch::x86_64::*;
use core::fmt;
use core::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

cpufeatures::new!(avx2, "avx2");
cpufeatures::new!(avx512, "avx512f", "avx512vl", "avx512dq");

#[inline(always)]
pub(crate) fn has_avx2() -> bool {
    avx2::get()
}

#[inline(always)]
pub(crate) fn has_avx512() -> bool {
    avx512::get()
}

/// Four numbers at a time (AVX2).
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Avx2;

/// Eight numbers at a time (AVX-512 F, VL and DQ).
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Avx512;

impl Instructions for Avx2 {
    /// # Panics
    /// On a processor that lacks them: [`Level::is_available`] says so.
    #[inline(always)]
    fn run<W: Work>(work: W) -> W::Out {
        check(has_avx2(), Level::Avx2);
        // SAFETY: the processor has been found to have these instructions.
        unsafe { on_avx2(work) }
    }
}

impl Instructions for Avx512 {
    /// # Panics
    /// On a processor that lacks them: [`Level::is_available`] says so.
    #[inline(always)]
    fn run<W: Work>(work: W) -> W::Out {
        check(has_avx512(), Level::Avx512);
        // SAFETY: the processor has been found to have these instructions.
        unsafe { on_avx512(work) }
    }
}

// A build for any processor to fall back to, beside each of these, would double what is built.
#[inline(always)]
fn check(available: bool, level: Level) {
    assert!(available, "this processor has no {level:?}; ask Level::is_available first");
}

#[inline(never)]
#[target_feature(enable = "avx2")]
fn on_avx2<W: Work>(work: W) -> W::Out {
    work.run()
}

#[inline(never)]
#[target_feature(enable = "avx512f,avx512vl,avx512dq")]
fn on_avx512<W: Work>(work: W) -> W::Out {
    work.run()
}

/// Run an algorithm on the level in use, with links abreast where the robot has room for whole groups.
#[inline(always)]
pub(crate) fn dispatch<K: Kernel<f64>>(kernel: K) -> K::Out {
    // Eight links abreast are no quicker than twice four: most of the rest goes from link to link.
    match Level::in_use() {
        // SAFETY: a level that the processor lacks is never in use, and each has those below it.
        Level::Avx2 | Level::Avx512 if const { K::CAPACITY.is_multiple_of(4) } => unsafe {
            on_avx2(With::<K, FourAbreast>::layout(kernel))
        },
        _ if const { K::CAPACITY.is_multiple_of(2) } => {
            Baseline::run(With::<K, TwoAbreast>::layout(kernel))
        }
        _ => Baseline::run(With::<K, OneByOne<f64>>::layout(kernel)),
    }
}

/// A number type of one register, and the layout of links that it makes.
///
/// SAFETY of what is in it: a register's numbers are made by its layout alone, and that is used in
/// [`Instructions::run`] alone, after the processor was asked.
macro_rules! register {
    (
        $name:ident, $layout:ident, $width:literal, $about:literal, $register:ty, $mask:ty,
        $set:ident, $add:ident, $sub:ident, $mul:ident, $div:ident, $sqrt:ident, $load:ident,
        $store:ident, ($a:ident, $b:ident, $m:ident) $lt:expr, $all:expr, $select:expr, $neg:expr,
        $rows:ident => $transpose:expr
    ) => {
        #[doc = $about]
        #[derive(Clone, Copy)]
        #[repr(transparent)]
        pub(crate) struct $name($register);

        impl $name {
            #[inline(always)]
            fn to_array(self) -> [f64; $width] {
                let mut out = [0.0; $width];
                unsafe { $store(out.as_mut_ptr(), self.0) };
                out
            }
            #[inline(always)]
            fn from_array(a: [f64; $width]) -> Self {
                Self(unsafe { $load(a.as_ptr()) })
            }
            /// Where one number is too large an angle for the common way, each goes alone.
            #[cold]
            #[inline(never)]
            fn each_alone(x: [f64; $width]) -> ([f64; $width], [f64; $width]) {
                let both = x.map(Real::sin_cos);
                (both.map(|(s, _)| s), both.map(|(_, c)| c))
            }
        }

        impl Default for $name {
            #[inline(always)]
            fn default() -> Self {
                Self::from_f64(0.0)
            }
        }
        impl fmt::Debug for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                self.to_array().fmt(f)
            }
        }
        impl PartialEq for $name {
            fn eq(&self, other: &Self) -> bool {
                self.to_array() == other.to_array()
            }
        }
        register!(@operator $name, Add, add, AddAssign, add_assign, $add);
        register!(@operator $name, Sub, sub, SubAssign, sub_assign, $sub);
        register!(@operator $name, Mul, mul, MulAssign, mul_assign, $mul);
        impl Div for $name {
            type Output = Self;
            #[inline(always)]
            fn div(self, b: Self) -> Self {
                Self(unsafe { $div(self.0, b.0) })
            }
        }
        impl Neg for $name {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                let $a = self.0;
                Self(unsafe { $neg })
            }
        }
        impl Real for $name {
            type Mask = $mask;
            #[inline(always)]
            fn from_f64(x: f64) -> Self {
                Self(unsafe { $set(x) })
            }
            #[inline(always)]
            fn epsilon() -> Self {
                Self::from_f64(f64::EPSILON)
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                Self(unsafe { $sqrt(self.0) })
            }
            #[inline(always)]
            fn sin_cos(self) -> (Self, Self) {
                let $m = self.abs().lt(Self::from_f64(BEYOND));
                if $all {
                    return near_sin_cos(self);
                }
                let (s, c) = Self::each_alone(self.to_array());
                (Self::from_array(s), Self::from_array(c))
            }
            #[inline(always)]
            fn atan2(self, x: Self) -> Self {
                let (y, x) = (self.to_array(), x.to_array());
                Self::from_array(core::array::from_fn(|i| Real::atan2(y[i], x[i])))
            }
            #[inline(always)]
            fn lt(self, other: Self) -> $mask {
                let ($a, $b) = (self.0, other.0);
                unsafe { $lt }
            }
            #[inline(always)]
            fn select($m: $mask, a: Self, b: Self) -> Self {
                let ($a, $b) = (a.0, b.0);
                Self(unsafe { $select })
            }
        }

        /// So many links of one vehicle abreast.
        #[derive(Debug, Clone, Copy)]
        pub(crate) struct $layout;

        impl Layout for $layout {
            type One = f64;
            type Some = $name;
            const LINKS: usize = $width;
            type Eight = [$name; 8 / $width];
            #[inline(always)]
            fn eight(all: $name) -> Self::Eight {
                [all; 8 / $width]
            }
            type Square = [$name; $width];
            #[inline(always)]
            fn square(all: $name) -> Self::Square {
                [all; $width]
            }
            #[inline(always)]
            fn transpose($rows: Self::Square) -> Self::Square {
                unsafe { $transpose }
            }
            #[inline(always)]
            fn load(from: &[f64]) -> $name {
                match from.first_chunk::<$width>() {
                    Some(from) => $name(unsafe { $load(from.as_ptr()) }),
                    None => $name::default(),
                }
            }
            #[inline(always)]
            fn store(some: $name, to: &mut [f64]) {
                if let Some(to) = to.first_chunk_mut::<$width>() {
                    unsafe { $store(to.as_mut_ptr(), some.0) };
                }
            }
            #[inline(always)]
            fn all(one: f64) -> $name {
                $name::from_f64(one)
            }
        }
    };
    (@operator $name:ident, $trait:ident, $method:ident, $assign:ident, $in_place:ident, $by:ident) => {
        impl $trait for $name {
            type Output = Self;
            #[inline(always)]
            fn $method(self, b: Self) -> Self {
                Self(unsafe { $by(self.0, b.0) })
            }
        }
        impl $assign for $name {
            #[inline(always)]
            fn $in_place(&mut self, b: Self) {
                self.0 = unsafe { $by(self.0, b.0) };
            }
        }
    };
}

register!(
    Two, TwoAbreast, 2, "Two numbers (SSE2, which every x86-64 has).", __m128d, __m128d,
    _mm_set1_pd, _mm_add_pd, _mm_sub_pd, _mm_mul_pd, _mm_div_pd, _mm_sqrt_pd, _mm_loadu_pd,
    _mm_storeu_pd, (a, b, m) _mm_cmplt_pd(a, b), unsafe { _mm_movemask_pd(m) } == 0b11,
    _mm_or_pd(_mm_and_pd(m, a), _mm_andnot_pd(m, b)), _mm_xor_pd(a, _mm_set1_pd(-0.0)),
    rows => {
        let [a, b] = rows;
        [Two(_mm_unpacklo_pd(a.0, b.0)), Two(_mm_unpackhi_pd(a.0, b.0))]
    }
);
register!(
    Four, FourAbreast, 4, "Four numbers (AVX).", __m256d, __m256d,
    _mm256_set1_pd, _mm256_add_pd, _mm256_sub_pd, _mm256_mul_pd, _mm256_div_pd, _mm256_sqrt_pd,
    _mm256_loadu_pd, _mm256_storeu_pd, (a, b, m) _mm256_cmp_pd::<_CMP_LT_OQ>(a, b),
    unsafe { _mm256_movemask_pd(m) } == 0b1111,
    _mm256_blendv_pd(b, a, m), _mm256_xor_pd(a, _mm256_set1_pd(-0.0)),
    rows => {
        let [a, b, c, d] = rows;
        let (ab, cd) = (_mm256_unpacklo_pd(a.0, b.0), _mm256_unpacklo_pd(c.0, d.0));
        let (ab_odd, cd_odd) = (_mm256_unpackhi_pd(a.0, b.0), _mm256_unpackhi_pd(c.0, d.0));
        [
            Four(_mm256_permute2f128_pd::<0x20>(ab, cd)),
            Four(_mm256_permute2f128_pd::<0x20>(ab_odd, cd_odd)),
            Four(_mm256_permute2f128_pd::<0x31>(ab, cd)),
            Four(_mm256_permute2f128_pd::<0x31>(ab_odd, cd_odd)),
        ]
    }
);
