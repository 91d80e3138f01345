//! The two ways through a tree of bodies: from the base to the tips, and back.

use crate::robot::within;
use crate::{BodyId, Robot};
use core::ops::Add;
use wrasse_spatial::{At, Real};

/// What a joint is mounted on.
enum Mount {
    Base,
    /// The link with the number before: what it has is still in registers.
    LinkBefore,
    Link(usize),
}

impl<T: Real, const J: usize> Robot<T, J> {
    #[inline(always)]
    fn mount(&self, j: usize) -> Mount {
        let j = within::<J>(j);
        match self.links.parent[j] {
            _ if self.links.follows[j] => Mount::LinkBefore,
            BodyId::Base => Mount::Base,
            BodyId::Link(p) => Mount::Link(p),
        }
    }

    /// What the parent of a joint has. What the link before has stays in registers where it is the parent.
    #[inline(always)]
    pub(crate) fn of_parent<R: At<usize>>(
        &self,
        j: usize,
        base: R::Out,
        before: R::Out,
        links: &R,
    ) -> R::Out {
        match self.mount(j) {
            Mount::LinkBefore => before,
            Mount::Base => base,
            Mount::Link(p) => links.at(p),
        }
    }

    /// Base to tips: a quantity of each link from that of its parent.
    #[inline(always)]
    pub(crate) fn base_to_tips<R: At<usize>>(
        &self,
        base: R::Out,
        links: &mut R,
        mut from_parent: impl FnMut(usize, R::Out) -> R::Out,
    ) where
        R::Out: Copy,
    {
        let mut before = base;
        for j in self.joints() {
            before = from_parent(j, self.of_parent(j, base, before, links));
            links.put(j, before);
        }
    }

    /// Base to tips: to what each link has, what its parent has.
    #[inline(always)]
    pub(crate) fn sum_to_tips<R: At<usize>>(&self, base: R::Out, links: &mut R)
    where
        R::Out: Copy + Add<Output = R::Out>,
    {
        let mut before = base;
        for j in self.joints() {
            before = self.of_parent(j, base, before, links) + links.at(j);
            links.put(j, before);
        }
    }

    /// Tips to base: to what each body has, what the links on it pass on. The base's is returned.
    #[inline(always)]
    pub(crate) fn tips_to_base<R: At<usize>>(
        &self,
        base: R::Out,
        links: &mut R,
        mut onto_parent: impl FnMut(usize, R::Out) -> R::Out,
    ) -> R::Out
    where
        R::Out: Copy + Add<Output = R::Out>,
    {
        let mut base = base;
        let mut all = links.at(self.joint_count().saturating_sub(1));
        for j in self.joints().rev() {
            let onto = onto_parent(j, all);
            let before = j.saturating_sub(1);
            match self.mount(j) {
                Mount::LinkBefore => {
                    all = links.at(before) + onto;
                    links.put(before, all);
                    continue;
                }
                Mount::Base => base = base + onto,
                Mount::Link(p) => links.put(p, links.at(p) + onto),
            }
            all = links.at(before);
        }
        base
    }
}
