//! The instructions that long pieces of work are built for, and which of them this processor has.
//!
//! What is worked is plain code. It is built once for each level, and the level is chosen as the
//! program runs. All levels give the same bits: none fuses a product with a sum.

use core::fmt::Debug;
use core::sync::atomic::{AtomicU8, Ordering};

/// A piece of work that can be built as a function of its own. Its `run` is `#[inline(always)]`: it is
/// built where it is called, for the instructions of that place.
pub trait Work {
    /// What comes of it.
    type Out;
    /// Do it.
    fn run(self) -> Self::Out;
}

/// Instructions of a processor that a piece of work is built for. All give the same bits.
pub trait Instructions: Copy + Debug + Default + PartialEq + 'static {
    /// Do it, in a function of its own that is built for these instructions.
    fn run<W: Work>(work: W) -> W::Out;
}

/// What every processor of the kind has.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Baseline;

impl Instructions for Baseline {
    #[inline(never)]
    fn run<W: Work>(work: W) -> W::Out {
        work.run()
    }
}

/// How wide the processor's vectors are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
#[repr(u8)]
pub enum Level {
    /// What every processor of the kind has: two numbers at a time on x86-64 (SSE2).
    Base = 0,
    /// Four numbers at a time (AVX2).
    Avx2 = 1,
    /// Eight numbers at a time (AVX-512 F, VL and DQ).
    Avx512 = 2,
}

/// The widest level that may be used; anything else than a level where nobody has asked yet.
static WIDEST: AtomicU8 = AtomicU8::new(u8::MAX);

impl Level {
    /// All levels, the narrowest first.
    pub const ALL: [Self; 3] = [Self::Base, Self::Avx2, Self::Avx512];

    /// Whether this processor has it.
    pub fn is_available(self) -> bool {
        match self {
            Self::Base => true,
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 => crate::wide::has_avx2(),
            #[cfg(target_arch = "x86_64")]
            Self::Avx512 => crate::wide::has_avx512(),
            #[cfg(not(target_arch = "x86_64"))]
            _ => false,
        }
    }

    /// The level that single numbers are worked on: the widest that this processor has, unless a
    /// narrower one was [asked for](Self::restrict).
    #[inline(always)]
    pub fn in_use() -> Self {
        match WIDEST.load(Ordering::Relaxed) {
            0 => Self::Base,
            1 => Self::Avx2,
            2 => Self::Avx512,
            _ => Self::find(),
        }
    }

    #[cold]
    fn find() -> Self {
        let widest = Self::best();
        WIDEST.store(widest as u8, Ordering::Relaxed);
        widest
    }

    /// The widest that this processor has.
    pub fn best() -> Self {
        let available = Self::ALL.into_iter().rfind(|level| level.is_available());
        available.unwrap_or(Self::Base)
    }

    /// Use no wider level than this from now on, in the whole program: for measurements, and to show
    /// that all levels give the same bits.
    pub fn restrict(self) {
        WIDEST.store(self.min(Self::best()) as u8, Ordering::Relaxed);
    }
}
