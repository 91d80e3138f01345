//! Links and joints as a tree: every name once, every link with one parent, one root.

use crate::assembly::{AssemblyJoint, Link};
use crate::findings::Findings;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

/// A tree over the links and joints of a file, by their places in its lists.
#[derive(Debug)]
pub(crate) struct Tree {
    /// The link that nothing carries.
    pub(crate) root: usize,
    /// Joints in the order of the file, each after the joint that carries its parent.
    pub(crate) order: Vec<Edge>,
}

/// A joint and the links that it connects.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Edge {
    pub(crate) joint: usize,
    pub(crate) parent: usize,
    pub(crate) child: usize,
}

/// The tree, or nothing after complaints about all that keeps it from being one.
pub(crate) fn tree(links: &[Link], joints: &[AssemblyJoint], found: &mut Findings) -> Option<Tree> {
    if links.is_empty() {
        found.error(&(0..0), "the file has no links".into(), "", "a vehicle has at least its base");
        return None;
    }
    let names = first_of_each_name("link", links.iter().map(|l| (&*l.name, &l.at)), found);
    first_of_each_name("joint", joints.iter().map(|j| (&*j.name, &j.at)), found);
    // A link whose name is left out may be any that a joint names.
    let all_named = links.iter().all(|link| !link.name.is_empty());
    let edges: Vec<_> = joints.iter().map(|j| ends(j, &names, all_named, found)).collect();
    let carriers = carriers(links, joints, &edges, found);
    // Two links of one name may look like a loop, and have had their complaint.
    let looped =
        names.len() == links.len() && complain_of_loops(links, joints, &edges, &carriers, found);
    let roots = roots(joints, &names, &edges, &carriers, found);
    if roots.len() > 1 {
        complain_of_roots(links, &roots, found);
    }
    let [root] = roots[..] else { return None };
    if looped || names.len() < links.len() || carriers.iter().any(|c| c.len() > 1) {
        return None;
    }
    let edges = edges
        .iter()
        .enumerate()
        .map(|(joint, &(parent, child))| Some(Edge { joint, parent: parent?, child: child? }));
    let edges: Vec<_> = edges.collect::<Option<_>>()?;
    Some(Tree { root, order: parents_first(links.len(), root, &edges) })
}

/// Places by name; complains of names that are there twice.
fn first_of_each_name<'a>(
    kind: &str,
    named: impl Iterator<Item = (&'a str, &'a Range<usize>)>,
    found: &mut Findings,
) -> BTreeMap<&'a str, usize> {
    let mut first: BTreeMap<&str, (usize, &Range<usize>)> = BTreeMap::new();
    // A missing name has had its complaint, and is empty.
    for (place, (name, at)) in named.enumerate().filter(|(_, (name, _))| !name.is_empty()) {
        if let Some((_, first_at)) = first.get(name) {
            let line = found.line(first_at.start, at);
            let message = format!("two {kind}s are called '{name}'; the other is on {line}");
            let help = if line.contains(" of ") {
                "give one of them another name, or the [[include]] of its file a `prefix`"
            } else {
                "give one of them another name"
            };
            found.error(at, message, "the second", help);
        } else {
            first.insert(name, (place, at));
        }
    }
    first.into_iter().map(|(name, (place, _))| (name, place)).collect()
}

/// Places of a joint's parent and child link.
fn ends(
    joint: &AssemblyJoint,
    names: &BTreeMap<&str, usize>,
    all_named: bool,
    found: &mut Findings,
) -> (Option<usize>, Option<usize>) {
    let mut place = |role: &str, name: &str, at: &Range<usize>| {
        let place = names.get(name).copied();
        if place.is_none() && !name.is_empty() && all_named {
            let message = format!(
                "joint '{}' has the {role} '{name}', but no link has that name",
                joint.name
            );
            let help = match found.meant(name, names.keys().copied()) {
                Some(close) => format!("did you mean '{close}'?"),
                None => format!("links are {}", listed(names.keys())),
            };
            found.error(at, message, "no such link", &help);
        }
        place
    };
    (
        place("parent", &joint.parent, &joint.parent_at),
        place("child", &joint.child, &joint.child_at),
    )
}

/// Up to ten names, in quotes.
fn listed<'a>(names: impl ExactSizeIterator<Item = &'a &'a str>) -> String {
    let more = if names.len() > 10 { ", …" } else { "" };
    let shown: Vec<_> = names.take(10).map(|n| format!("'{n}'")).collect();
    shown.join(", ") + more
}

/// The joints that carry each link; complains of links that more than one carries.
fn carriers(
    links: &[Link],
    joints: &[AssemblyJoint],
    edges: &[(Option<usize>, Option<usize>)],
    found: &mut Findings,
) -> Vec<Vec<usize>> {
    let mut carriers: Vec<Vec<usize>> = vec![Vec::new(); links.len()];
    for (j, (_, child)) in edges.iter().enumerate() {
        let Some(child) = *child else { continue };
        if let Some(&other) = carriers[child].first() {
            let (link, other) = (&links[child].name, &joints[other]);
            let message = format!(
                "link '{link}' is the child of '{}' and already of '{}' on {}",
                joints[j].name,
                other.name,
                found.line(other.child_at.start, &joints[j].child_at)
            );
            let help = "a vehicle is a tree: each link hangs on one joint";
            found.error(&joints[j].child_at, message, "a second parent", help);
        }
        carriers[child].push(j);
    }
    carriers
}

/// Follows each link towards the root; one complaint for each ring that it runs into.
fn complain_of_loops(
    links: &[Link],
    joints: &[AssemblyJoint],
    edges: &[(Option<usize>, Option<usize>)],
    carriers: &[Vec<usize>],
    found: &mut Findings,
) -> bool {
    // The joint above a link; a link with two parents has had its complaint.
    let above = |link: usize| match carriers[link][..] {
        [joint] => Some((joint, edges[joint].0?)),
        _ => None,
    };
    let mut seen_from = vec![None; links.len()];
    let mut looped = false;
    for start in 0..links.len() {
        let mut at = start;
        while seen_from[at].is_none() {
            seen_from[at] = Some(start);
            let Some((_, parent)) = above(at) else { break };
            let closing = above(parent).filter(|_| seen_from[parent] == Some(start));
            if let Some((joint, _)) = closing {
                looped = true;
                let ring = ring_through(parent, above, links);
                let message = format!("joint '{}' closes a loop: {ring}", joints[joint].name);
                let help = "a vehicle is a tree that hangs on one root; \
                            closed chains are not supported";
                found.error(&joints[joint].parent_at, message, "back to where it came from", help);
            }
            at = parent;
        }
    }
    looped
}

/// Names of a ring that are told.
const TOLD: usize = 12;

/// The names along a ring, base to tip, first and last the same; of a long one those at its ends.
fn ring_through(
    start: usize,
    above: impl Fn(usize) -> Option<(usize, usize)>,
    links: &[Link],
) -> String {
    let mut names = vec![&*links[start].name];
    let mut at = start;
    while let Some((_, parent)) = above(at) {
        names.push(&links[parent].name);
        at = parent;
        if at == start {
            break;
        }
    }
    if names.len() <= TOLD {
        return joined(&names);
    }
    let (tip, base) = (&names[..TOLD / 2], &names[names.len() - TOLD / 2..]);
    format!("{} → … {} more … → {}", joined(base), names.len() - TOLD, joined(tip))
}

/// Names from tip to base, the base first.
fn joined(names: &[&str]) -> String {
    names.iter().rev().copied().collect::<Vec<_>>().join(" → ")
}

/// Links that no joint carries. A child that is not known, or known twice, leaves another link
/// without parent: one complaint is enough, so those are left out.
fn roots(
    joints: &[AssemblyJoint],
    names: &BTreeMap<&str, usize>,
    edges: &[(Option<usize>, Option<usize>)],
    carriers: &[Vec<usize>],
    found: &mut Findings,
) -> Vec<usize> {
    let mut roots: BTreeSet<_> =
        names.values().copied().filter(|&link| carriers[link].is_empty()).collect();
    let mut explained: usize = carriers.iter().map(|c| c.len().saturating_sub(1)).sum();
    let unknown = joints.iter().zip(edges).filter(|(_, (_, child))| child.is_none());
    for (joint, _) in unknown {
        let meant = found.meant(&joint.child, names.keys().copied());
        if !meant.and_then(|name| names.get(name)).is_some_and(|root| roots.remove(root)) {
            explained += 1;
        }
    }
    let shown = if roots.len() <= 1 + explained { 1 } else { roots.len() };
    roots.into_iter().take(shown).collect()
}

/// One complaint for each root after the first.
fn complain_of_roots(links: &[Link], roots: &[usize], found: &mut Findings) {
    let first = &links[roots[0]];
    for &other in &roots[1..] {
        let message = format!(
            "links '{}' ({}) and '{}' both have no parent: a vehicle has one root",
            first.name,
            found.line(first.at.start, &links[other].at),
            links[other].name
        );
        let help = "connect one of them to the rest with a joint";
        found.error(&links[other].at, message, "a second root", help);
    }
}

/// Keeps the order of the file, but no joint comes before the one that carries its parent.
fn parents_first(links: usize, root: usize, edges: &[Edge]) -> Vec<Edge> {
    let mut on: Vec<Vec<usize>> = vec![vec![]; links];
    for (place, edge) in edges.iter().enumerate() {
        on[edge.parent].push(place);
    }
    let mut order: Vec<Edge> = Vec::with_capacity(edges.len());
    // Joints whose parent is placed: the first of the file is next.
    let mut ready: BTreeSet<usize> = on[root].iter().copied().collect();
    while let Some(next) = ready.pop_first() {
        ready.extend(&on[edges[next].child]);
        order.push(edges[next]);
    }
    order
}
