//! Algorithms over the links of a robot, built once for each width of the processor's registers.

use crate::{Layout, Real, Work};
use core::marker::PhantomData;

/// An algorithm over links with numbers `T`, before it is said how many links go abreast.
///
/// [`kernel!`](crate::kernel) makes one of a function.
pub trait Kernel<T: Real> {
    /// Links that there is room for.
    const CAPACITY: usize;
    /// What comes of it.
    type Out;
    /// Run it, with links in a layout. It is `#[inline(always)]`: it is built where it is called, for
    /// the instructions of that place.
    fn run<L: Layout<One = T>>(self) -> Self::Out;
}

/// A kernel with its links in a layout.
pub(crate) struct With<K, L>(K, PhantomData<L>);

impl<K, L> With<K, L> {
    #[inline(always)]
    pub(crate) fn layout(kernel: K) -> Self {
        Self(kernel, PhantomData)
    }
}

impl<K: Kernel<L::One>, L: Layout> Work for With<K, L> {
    type Out = K::Out;
    #[inline(always)]
    fn run(self) -> K::Out {
        self.0.run::<L>()
    }
}

/// A function over a robot's links as a [`Kernel`]: in its body `L` is the layout, `T` the number and
/// `J` the room for joints. Results go where the caller says: an argument `&mut`.
///
/// ```
/// use wrasse_spatial::{At, Layout, Real, groups, kernel};
/// kernel! {
///     /// Squares of `count` numbers.
///     pub fn squares<L, T, J>(count: usize, x: &[T; J], out: &mut [T; J]) {
///         for i in groups::<L, J>(count) {
///             let x = x.at(i);
///             out.put(i, x * x);
///         }
///     }
/// }
/// let mut out = [0.0; 4];
/// squares(4, &[1.0, 2.0, 3.0, 4.0], &mut out);
/// assert_eq!(out, [1.0, 4.0, 9.0, 16.0]);
/// ```
#[macro_export]
macro_rules! kernel {
    (
        $(#[$about:meta])*
        $vis:vis fn $name:ident<$L:ident, $T:ident, $J:ident>($($argument:ident: $kind:ty),* $(,)?)
        $body:block
    ) => {
        $(#[$about])*
        #[inline]
        $vis fn $name<$T: $crate::Real, const $J: usize>($($argument: $kind),*) {
            #[allow(non_camel_case_types, reason = "named as the arguments are")]
            struct Call<$($argument),*>($($argument),*);
            impl<$T: $crate::Real, const $J: usize> $crate::Kernel<$T> for Call<$($kind),*> {
                const CAPACITY: usize = $J;
                type Out = ();
                #[inline(always)]
                fn run<$L: $crate::Layout<One = $T>>(self) {
                    let Self($($argument),*) = self;
                    $body
                }
            }
            $T::dispatch(Call($($argument),*));
        }
    };
}
