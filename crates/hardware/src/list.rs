//! A list of at most `N` things, without a heap.

use core::ops::{Deref, DerefMut};

/// At most `N` things, in order; a slice of those that are there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct List<E, const N: usize> {
    count: usize,
    items: [E; N],
}

impl<E: Copy + Default, const N: usize> List<E, N> {
    /// The first `N` of these things.
    pub fn new(from: &[E]) -> Self {
        let mut items = [E::default(); N];
        items.iter_mut().zip(from).for_each(|(to, from)| *to = *from);
        Self { count: from.len().min(N), items }
    }
    /// Nothing.
    pub fn empty() -> Self {
        Self::new(&[])
    }
    /// Each thing made into another.
    pub fn map<F: Copy + Default>(&self, f: impl Fn(&E) -> F) -> List<F, N> {
        let mut items = [F::default(); N];
        items.iter_mut().zip(self.iter()).for_each(|(to, from)| *to = f(from));
        List { count: self.count, items }
    }
}

impl<E: Copy + Default, const N: usize> Default for List<E, N> {
    fn default() -> Self {
        Self::empty()
    }
}

impl<E, const N: usize> Deref for List<E, N> {
    type Target = [E];
    fn deref(&self) -> &[E] {
        self.items.get(..self.count).unwrap_or(&self.items)
    }
}

impl<E, const N: usize> DerefMut for List<E, N> {
    fn deref_mut(&mut self) -> &mut [E] {
        let count = self.count.min(N);
        self.items.get_mut(..count).unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_list_holds_what_fits_and_shows_what_is_there() {
        let two = List::<u8, 4>::new(&[7, 8]);
        assert_eq!(&two[..], &[7, 8]);
        assert_eq!(&List::<u8, 2>::new(&[1, 2, 3])[..], &[1, 2]);
        assert_eq!(&two.map(|x| x + 1)[..], &[8, 9]);
        assert!(List::<u8, 4>::empty().is_empty());
    }
}
