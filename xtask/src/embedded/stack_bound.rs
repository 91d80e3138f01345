//! How much stack a control period can use at most: the frames that the compiler notes, summed along
//! the deepest way through the calls.

use super::call_graph::{CallGraph, Node};
use std::collections::BTreeMap;
use std::path::Path;

/// One sentence for the control periods in a firmware.
pub(super) fn of_firmware(program: &Path) -> Result<String, String> {
    let graph = CallGraph::read(program)?;
    let mut bounds = Vec::new();
    for function in graph.functions.iter().filter(|f| is_period(&f.name)) {
        let bound = deepest(function.start, &graph.nodes, &mut Vec::new())
            .map_err(|(what, at)| format!("the stack has no bound: {what}: {}", graph.name(at)))?;
        bounds.push(bound);
    }
    bounds.sort_unstable();
    let (Some(one), Some(two)) = (bounds.first(), bounds.last()) else {
        return Err("no control period was found in the firmware".to_owned());
    };
    Ok(format!(
        "stack bound by the call graph: {one} B for one arm, {two} B for two; no recursion, no call \
         through a pointer"
    ))
}

/// Whether a mangled name is `Subject::period`.
fn is_period(name: &str) -> bool {
    name.contains("7Subject") && name.contains("E6period")
}

/// Bytes along the deepest way from a function, or what makes it unknown and where.
fn deepest(
    start: u32,
    graph: &BTreeMap<u32, Node>,
    way: &mut Vec<u32>,
) -> Result<u32, (&'static str, u32)> {
    if way.contains(&start) {
        return Err(("it calls itself again", start));
    }
    let node = graph.get(&start).ok_or(("not a function", start))?;
    if node.indirect {
        return Err(("it calls through a pointer", start));
    }
    let frame = node.frame.ok_or(("the compiler noted no frame", start))?;
    way.push(start);
    let mut below = 0;
    for callee in &node.calls {
        below = below.max(deepest(*callee, graph, way)?);
    }
    way.pop();
    Ok(frame + below)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn graph(nodes: &[(u32, Option<u32>, &[u32], bool)]) -> BTreeMap<u32, Node> {
        let node = |&(start, frame, calls, indirect): &(u32, Option<u32>, &[u32], bool)| {
            (start, Node { frame, calls: calls.to_vec(), indirect })
        };
        nodes.iter().map(node).collect()
    }

    #[test]
    fn the_bound_is_the_deepest_way_and_not_the_sum() {
        let g = graph(&[
            (1, Some(100), &[2, 3], false),
            (2, Some(50), &[4], false),
            (3, Some(60), &[], false),
            (4, Some(20), &[], false),
        ]);
        assert_eq!(deepest(1, &g, &mut Vec::new()), Ok(170));
    }

    #[test]
    fn recursion_pointers_and_unknown_frames_have_no_bound() {
        let again = graph(&[(1, Some(1), &[2], false), (2, Some(1), &[1], false)]);
        let pointer = graph(&[(1, Some(1), &[2], false), (2, Some(1), &[], true)]);
        let unknown = graph(&[(1, Some(1), &[2], false), (2, None, &[], false)]);
        for g in [again, pointer, unknown] {
            assert!(deepest(1, &g, &mut Vec::new()).is_err());
        }
    }
}
