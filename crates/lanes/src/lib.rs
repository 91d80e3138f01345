//! Which vector instructions the processor has, and numbers in lanes that are worked with them.
//!
//! What is done with lanes is plain code. It is built once for each level, and the level is chosen as
//! the program runs. All levels give the same bits: none fuses a product with a sum.

use wrasse_spatial::{Baseline, Instructions};

#[cfg(target_arch = "x86_64")]
mod wide;
#[cfg(target_arch = "x86_64")]
pub use wide::{Avx2, Avx512};

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

/// Something that can be done on any level: what it does with lanes is built for each.
pub trait OnAnyLevel {
    /// What comes of it.
    type Out;
    /// Do it with lanes of these instructions.
    fn with<I: Instructions>(self) -> Self::Out;
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
    #[inline(always)]
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

    /// Do something on this level; on the base level where the processor lacks it.
    pub fn choose<W: OnAnyLevel>(self, what: W) -> W::Out {
        match self {
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 if self.is_available() => what.with::<Avx2>(),
            #[cfg(target_arch = "x86_64")]
            Self::Avx512 if self.is_available() => what.with::<Avx512>(),
            _ => what.with::<Baseline>(),
        }
    }

    /// Do something on this level if it is wider than the base level and the processor has it; nothing
    /// is built for the base level.
    pub fn choose_wide<W: OnAnyLevel>(self, what: W) -> Option<W::Out> {
        match self {
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 if self.is_available() => Some(what.with::<Avx2>()),
            #[cfg(target_arch = "x86_64")]
            Self::Avx512 if self.is_available() => Some(what.with::<Avx512>()),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::any::TypeId;
    use wrasse_spatial::{Lanes, Real, Work};

    /// Square roots of quotients, summed: in a function of their own.
    struct Sum<I: Instructions>([Lanes<8, I>; 3]);

    impl<I: Instructions> Work for Sum<I> {
        type Out = Lanes<8, I>;
        #[inline(always)]
        fn run(self) -> Lanes<8, I> {
            let third = Lanes::from_f64(1.0 / 3.0);
            self.0.into_iter().fold(Lanes::zero(), |sum, x| sum * third + (x * x / third).sqrt())
        }
    }

    #[derive(Clone, Copy)]
    struct SumOf([f64; 8]);

    impl OnAnyLevel for SumOf {
        type Out = [u64; 8];
        fn with<I: Instructions>(self) -> [u64; 8] {
            let x = Lanes::<8, I>::new(self.0);
            Lanes::<8, I>::apart(Sum([x, x * x, x + x])).0.map(f64::to_bits)
        }
    }

    #[test]
    fn every_level_gives_the_bits_of_the_number_alone() {
        let x = [0.1, 0.7, -3.0, 1e9, 1e-9, 2.0, 0.3, -0.3];
        let alone = x.map(|x| {
            let root = |x: f64| (x * x / (1.0 / 3.0)).sqrt();
            let third = 1.0 / 3.0;
            ((root(x) * third + root(x * x)) * third + root(x + x)).to_bits()
        });
        for level in Level::ALL {
            assert_eq!(level.choose(SumOf(x)), alone, "{level:?}");
        }
    }

    struct Name;

    impl OnAnyLevel for Name {
        type Out = TypeId;
        fn with<I: Instructions>(self) -> TypeId {
            TypeId::of::<I>()
        }
    }

    #[test]
    fn each_level_that_is_there_has_instructions_of_its_own_and_the_rest_the_baseline() {
        let available = Level::ALL.into_iter().filter(|level| level.is_available());
        let mut names: Vec<_> = available.map(|level| level.choose(Name)).collect();
        let different = names.len();
        names.dedup();
        assert_eq!(names.len(), different);
        let lacking = Level::ALL.into_iter().filter(|level| !level.is_available());
        assert!(lacking.into_iter().all(|level| level.choose(Name) == TypeId::of::<Baseline>()));
        assert!(Level::best().is_available() && Level::Base.is_available());
        for level in Level::ALL {
            let wide = level.is_available() && level != Level::Base;
            assert_eq!(level.choose_wide(Name), wide.then(|| level.choose(Name)));
        }
    }
}
