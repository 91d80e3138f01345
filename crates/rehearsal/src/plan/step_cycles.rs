//! Steps that could come one after the other for ever.

use wrasse_flight::Step;
use wrasse_vehicle::JOINTS;

/// The steps that may come after one, if each that has attempts has used them up: such a step leads to what
/// comes instead of it, or to the end.
fn followers(steps: &[Step<f64, JOINTS>], number: usize) -> impl Iterator<Item = usize> {
    let step = &steps[number];
    let all = match step.attempts {
        Some(_) => [None, None, step.on_exhausted],
        None => [Some(step.then), step.on_fault, None],
    };
    all.into_iter().flatten().filter_map(move |next| next.after(number, steps.len()))
}

/// A cycle that nothing ends, if there is one: every way round must use up attempts, and what comes once
/// they are used up must lead out of it.
pub fn cycle_without_attempts(steps: &[Step<f64, JOINTS>]) -> Option<Vec<usize>> {
    let mut is_cleared = vec![false; steps.len()];
    (0..steps.len()).find_map(|start| cycle_from(steps, start, &mut vec![], &mut is_cleared))
}

/// A cycle that a way runs into; `way` are the steps on it so far, and those that are cleared run into none.
fn cycle_from(
    steps: &[Step<f64, JOINTS>],
    step: usize,
    way: &mut Vec<usize>,
    is_cleared: &mut [bool],
) -> Option<Vec<usize>> {
    if let Some(at) = way.iter().position(|&on_way| on_way == step) {
        return Some(way[at..].to_vec());
    }
    if is_cleared[step] {
        return None;
    }
    way.push(step);
    let found = followers(steps, step).find_map(|next| cycle_from(steps, next, way, is_cleared));
    way.pop();
    is_cleared[step] = found.is_none();
    found
}

/// Longest sums of some times (s) along the ways from each step, where those with attempts count nothing;
/// `None` where a time that counts is not known. There must be no [cycle](cycle_without_attempts).
pub(super) fn longest_ways(steps: &[Step<f64, JOINTS>], times: &[Option<f64>]) -> Vec<Option<f64>> {
    let mut order = vec![];
    let mut is_seen = vec![false; steps.len()];
    (0..steps.len()).for_each(|step| last_first(steps, step, &mut is_seen, &mut order));
    let mut longest = vec![None; steps.len()];
    for step in order {
        let mut behind = followers(steps, step).map(|next| longest[next]);
        let behind = behind.try_fold(0.0_f64, |most, x: Option<f64>| Some(most.max(x?)));
        let own = if steps[step].attempts.is_some() { Some(0.0) } else { times[step] };
        longest[step] = own.zip(behind).map(|(own, behind)| own + behind);
    }
    longest
}

/// Steps behind those that follow them.
fn last_first(
    steps: &[Step<f64, JOINTS>],
    step: usize,
    is_seen: &mut [bool],
    order: &mut Vec<usize>,
) {
    if !std::mem::replace(&mut is_seen[step], true) {
        followers(steps, step).for_each(|next| last_first(steps, next, is_seen, order));
        order.push(step);
    }
}
