//! Cases flown side by side: the same bits in the same order for any number of threads.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::channel;
use wrasse_mission::{CaseOutcome, Mission, Progress, RunOptions, run_case};

/// Fly the cases of these numbers; outcomes come in the order of the numbers.
pub(crate) fn fly(
    mission: &Mission,
    cases: &[usize],
    threads: usize,
    progress: &mut dyn FnMut(Progress<'_>),
) -> Vec<CaseOutcome> {
    let next = AtomicUsize::new(0);
    let mut outcomes: Vec<Option<CaseOutcome>> = cases.iter().map(|_| None).collect();
    std::thread::scope(|scope| {
        let (tell, told) = channel();
        for _ in 0..threads.clamp(1, cases.len().max(1)) {
            let (tell, next) = (tell.clone(), &next);
            scope.spawn(move || {
                loop {
                    // Whoever is free takes the next one; each is independent of the others.
                    let number = next.fetch_add(1, Ordering::Relaxed);
                    let Some(case) = cases.get(number) else { break };
                    let outcome = run_case(mission, *case, RunOptions::default(), &mut |_, _| {});
                    // Nobody stops listening before the last one.
                    let _ = tell.send((number, outcome));
                }
            });
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
