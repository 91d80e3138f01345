//! Which vector instructions the processor has, and kernels built for each of them.
//!
//! A kernel over lanes is plain code. It is built once for each level, and the level is chosen as the
//! program runs. All levels give the same bits: none fuses a product with a sum.

/// A piece of work that is built for each level. Its `run` and all that it calls should be
/// `#[inline(always)]`: what is not becomes a call of code that is built for any processor.
pub trait Kernel {
    /// What comes of it.
    type Out;
    /// Do it.
    fn run(self) -> Self::Out;
}

/// How wide the vectors are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// What every processor of the kind has: two lanes at a time on x86-64 (SSE2).
    Base,
    /// Four lanes at a time (AVX2).
    Avx2,
    /// Eight lanes at a time (AVX-512 F, VL and DQ).
    Avx512,
}

impl Level {
    /// All levels, the narrowest first.
    pub const ALL: [Self; 3] = [Self::Base, Self::Avx2, Self::Avx512];

    /// The widest that this processor has.
    pub fn best() -> Self {
        let available = Self::ALL.into_iter().rfind(|level| level.is_available());
        available.unwrap_or(Self::Base)
    }

    /// Whether this processor has it.
    #[cfg(target_arch = "x86_64")]
    pub fn is_available(self) -> bool {
        match self {
            Self::Base => true,
            Self::Avx2 => is_x86_feature_detected!("avx2"),
            Self::Avx512 => {
                is_x86_feature_detected!("avx512f")
                    && is_x86_feature_detected!("avx512vl")
                    && is_x86_feature_detected!("avx512dq")
            }
        }
    }

    /// Whether this processor has it.
    #[cfg(not(target_arch = "x86_64"))]
    pub fn is_available(self) -> bool {
        self == Self::Base
    }

    /// Run a kernel as it is built for this level; for the base level where the processor lacks it.
    #[inline(always)]
    pub fn run<K: Kernel>(self, kernel: K) -> K::Out {
        #[cfg(target_arch = "x86_64")]
        if self != Self::Base && self.is_available() {
            return wide::run(self, kernel);
        }
        kernel.run()
    }
}

#[cfg(target_arch = "x86_64")]
mod wide {
    #![allow(unsafe_code, reason = "a function for a wider processor, called where there is one")]

    use crate::{Kernel, Level};

    /// Run a kernel on a level that is there: the caller has asked.
    #[inline(always)]
    pub(crate) fn run<K: Kernel>(level: Level, kernel: K) -> K::Out {
        match level {
            Level::Base => kernel.run(),
            // SAFETY: the only caller has found that the processor has these instructions.
            Level::Avx2 => unsafe { on_avx2(kernel) },
            // SAFETY: as above.
            Level::Avx512 => unsafe { on_avx512(kernel) },
        }
    }

    #[target_feature(enable = "avx2")]
    fn on_avx2<K: Kernel>(kernel: K) -> K::Out {
        kernel.run()
    }

    #[target_feature(enable = "avx512f,avx512vl,avx512dq")]
    fn on_avx512<K: Kernel>(kernel: K) -> K::Out {
        kernel.run()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Sum([f64; 8]);

    impl Kernel for Sum {
        type Out = f64;
        #[inline(always)]
        fn run(self) -> f64 {
            self.0.iter().fold(0.0, |sum, x| sum + x * 0.1)
        }
    }

    #[test]
    fn every_level_gives_the_same_bits() {
        let x = [0.1, 0.7, -3.0, 1e9, 1e-9, 2.0, 0.3, -0.3];
        let base = Level::Base.run(Sum(x)).to_bits();
        for level in Level::ALL {
            assert_eq!(level.run(Sum(x)).to_bits(), base, "{level:?}");
        }
    }

    #[test]
    fn the_best_level_is_there() {
        assert!(Level::best().is_available() && Level::Base.is_available());
    }
}
