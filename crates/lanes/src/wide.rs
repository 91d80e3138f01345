//! Functions for wider processors, called where there is one.
#![allow(unsafe_code, reason = "a function for a wider processor, called where there is one")]

use crate::Level;
use wrasse_spatial::{Instructions, Work};

/// Four lanes at a time (AVX2).
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Avx2;

/// Eight lanes at a time (AVX-512 F, VL and DQ).
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Avx512;

impl Instructions for Avx2 {
    /// # Panics
    /// On a processor that lacks them: [`Level::choose`] does not come here then.
    #[inline(always)]
    fn run<W: Work>(work: W) -> W::Out {
        check(Level::Avx2);
        // SAFETY: the processor has been found to have these instructions.
        unsafe { on_avx2(work) }
    }
}

impl Instructions for Avx512 {
    /// # Panics
    /// On a processor that lacks them: [`Level::choose`] does not come here then.
    #[inline(always)]
    fn run<W: Work>(work: W) -> W::Out {
        check(Level::Avx512);
        // SAFETY: the processor has been found to have these instructions.
        unsafe { on_avx512(work) }
    }
}

// A build for any processor to fall back to, beside each of these, would double what is built.
#[inline(always)]
fn check(level: Level) {
    assert!(level.is_available(), "this processor has no {level:?}; ask Level::is_available first");
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
