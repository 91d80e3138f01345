//! The instructions that long pieces of work are built for: part of a number's type.

use core::fmt::Debug;

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
