//! Cases flown side by side: the same bits in the same order for any number of threads.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Sender, channel};
use wrasse_mission::{Mission, Progress};
use wrasse_rehearsal::{CaseOutcome, RunOptions, run_case};

/// Stack of a thread that flies (bytes): a flight keeps the matrices of many joints by value.
const STACK: usize = 16 << 20;

/// Fly the cases of these numbers; outcomes come in the order of the numbers.
pub(crate) fn fly(
    mission: &Mission,
    cases: &[usize],
    threads: usize,
    progress: &mut dyn FnMut(Progress<'_>),
) -> Vec<CaseOutcome> {
    let next = AtomicUsize::new(0);
    let mut outcomes: Vec<Option<CaseOutcome>> = cases.iter().map(|_| None).collect();
    // Whoever is free takes the next one; each is independent of the others.
    let fly_next = |tell: &Sender<(usize, CaseOutcome)>| {
        let number = next.fetch_add(1, Ordering::Relaxed);
        let Some(case) = cases.get(number) else { return false };
        let outcome = run_case(&mission.cases[*case], RunOptions::default(), &mut |_, _| {});
        // Nobody stops listening before the last one.
        let _ = tell.send((number, outcome));
        true
    };
    std::thread::scope(|scope| {
        let (tell, told) = channel();
        let mut flying = 0;
        for _ in 0..threads.clamp(1, cases.len().max(1)) {
            let (tell, fly_next) = (tell.clone(), &fly_next);
            let thread = std::thread::Builder::new().stack_size(STACK);
            // A system that grants no further thread leaves the work to those there are.
            match thread.spawn_scoped(scope, move || while fly_next(&tell) {}) {
                Ok(_) => flying += 1,
                Err(_) => break,
            }
        }
        if flying == 0 {
            while fly_next(&tell) {}
        }
        drop(tell);
        let mut done = 0;
        for (number, outcome) in told {
            outcomes[number] = Some(outcome);
            done += 1;
            let share = if done == cases.len() { 1.0 } else { 0.0 };
            let case = done.min(cases.len() - 1);
            progress(Progress { case, cases: cases.len(), share, doing: "flying" });
        }
    });
    outcomes.into_iter().map(|o| o.expect("each number was taken by one thread")).collect()
}
