//! How far a run, a sweep or a study is: a bar on a terminal, a line a minute anywhere else.

use crate::input::tell;
use indicatif::{ProgressBar, ProgressStyle};
use std::io::IsTerminal;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};
use wrasse_mission::Progress;

/// Time between two lines where no bar is seen.
const MINUTE: Duration = Duration::from_mins(1);

/// Stack of the thread that tells of progress (bytes): it formats a line.
const STACK: usize = 256 << 10;

/// Steps of the bar.
const STEPS: u64 = 1000;

/// What is told of progress.
#[derive(Debug)]
pub(crate) struct Bar {
    shared: Arc<Shared>,
    bar: Option<ProgressBar>,
    lines: Option<JoinHandle<()>>,
}

#[derive(Debug)]
struct Shared {
    state: Mutex<State>,
    /// Told when all is done.
    done: Condvar,
}

/// How far it is.
#[derive(Debug, Clone)]
struct State {
    pace: Pace,
    what: String,
    is_done: bool,
}

/// Work and the time it takes. What was there at the first word was done before: it is no speed.
#[derive(Debug, Clone, Copy)]
struct Pace {
    first: Option<(Instant, f64)>,
    share: f64,
}

impl Pace {
    fn new() -> Self {
        Self { first: None, share: 0.0 }
    }
    fn note(&mut self, share: f64, now: Instant) {
        self.first.get_or_insert((now, share));
        self.share = share;
    }
    /// Time that the rest takes at the pace so far; `None` before there is one.
    fn left(&self, now: Instant) -> Option<Duration> {
        let (began, before) = self.first?;
        let done = self.share - before;
        let each = (now - began).as_secs_f64() / done;
        let left = Duration::try_from_secs_f64(each * (1.0 - self.share)).ok();
        left.filter(|_| done > 0.0)
    }
}

/// A time as people say it.
fn in_words(time: Duration) -> String {
    let seconds = time.as_secs();
    match seconds {
        0..=99 => format!("{seconds} s"),
        100..=5999 => format!("{} min", (seconds + 30) / 60),
        _ => format!("{:.1} h", seconds as f64 / 3600.0),
    }
}

impl State {
    fn line(&self, now: Instant) -> String {
        let left = self.pace.left(now).map(|time| format!(", about {} left", in_words(time)));
        let percent = 100.0 * self.pace.share;
        format!("{percent:.0} %: {}{}", self.what, left.unwrap_or_default())
    }
}

impl Bar {
    pub(crate) fn new() -> Self {
        let state = State { pace: Pace::new(), what: "planning".into(), is_done: false };
        let shared = Arc::new(Shared { state: Mutex::new(state), done: Condvar::new() });
        if std::io::stderr().is_terminal() {
            let bar = ProgressBar::new(STEPS);
            let style = ProgressStyle::with_template("{bar:32} {msg}");
            bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
            return Self { shared, bar: Some(bar), lines: None };
        }
        let told = Arc::clone(&shared);
        let thread = std::thread::Builder::new().name("progress".into()).stack_size(STACK);
        // Without a thread nothing is told: the work goes on.
        let lines = thread.spawn(move || told.lines(MINUTE, &mut |line| tell(line))).ok();
        Self { shared, bar: None, lines }
    }
    /// How far a run is.
    pub(crate) fn show(&self, progress: Progress<'_>) {
        let share = (progress.case as f64 + progress.share) / progress.cases.max(1) as f64;
        self.note(
            share,
            &match progress.cases {
                1 => progress.doing.to_owned(),
                cases => format!("{} {} of {cases}", progress.doing, progress.case + 1),
            },
        );
    }
    /// How many flights are done, of how many.
    pub(crate) fn count(&self, done: u64, of: u64) {
        let share = done as f64 / of.max(1) as f64;
        self.note(share, &format!("{done} of {of} flights"));
    }
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a share of 1000")]
    fn note(&self, share: f64, what: &str) {
        let now = Instant::now();
        let mut state = self.shared.state();
        state.pace.note(share, now);
        if state.what != what {
            what.clone_into(&mut state.what);
        }
        if let Some(bar) = &self.bar {
            let line = state.line(now);
            if bar.message() != line {
                bar.set_message(line);
            }
            bar.set_position((share * STEPS as f64) as u64);
        }
    }
    pub(crate) fn done(self) {
        self.shared.state().is_done = true;
        self.shared.done.notify_all();
        if let Some(bar) = self.bar {
            bar.finish_and_clear();
        }
        if let Some(lines) = self.lines {
            let _ = lines.join();
        }
    }
}

impl Shared {
    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
    /// Say a line each `time` until all is done.
    fn lines(&self, time: Duration, say: &mut dyn FnMut(&str)) {
        let mut state = self.state();
        let mut next = Instant::now() + time;
        while !state.is_done {
            let now = Instant::now();
            if now >= next {
                next = now + time;
                say(&state.line(now));
            }
            let waited = self.done.wait_timeout(state, next.saturating_duration_since(now));
            state = waited.unwrap_or_else(PoisonError::into_inner).0;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_done_before_is_no_speed() {
        let (began, mut pace) = (Instant::now(), Pace::new());
        pace.note(0.9, began);
        assert_eq!(pace.left(began), None);
        // A hundredth in ten seconds: nine hundredths take ninety, not the tenth of a second that it
        // would be if all had been flown just now.
        let now = began + Duration::from_secs(10);
        pace.note(0.91, now);
        let left = pace.left(now).unwrap().as_secs_f64();
        assert!((left - 90.0).abs() < 1e-9, "{left}");
        // Where nothing comes any more the rest takes longer the longer one waits.
        let later = pace.left(now + Duration::from_secs(10)).unwrap().as_secs_f64();
        assert!((later - 180.0).abs() < 1e-9, "{later}");
    }

    #[test]
    fn a_line_is_told_each_time_until_all_is_done() {
        let mut pace = Pace::new();
        pace.note(0.25, Instant::now());
        let state = State { pace, what: "5 of 20 flights".into(), is_done: false };
        let shared = Shared { state: Mutex::new(state), done: Condvar::new() };
        let mut lines = vec![];
        std::thread::scope(|scope| {
            let told = scope.spawn(|| {
                shared.lines(Duration::from_millis(5), &mut |line| lines.push(line.to_owned()));
            });
            std::thread::sleep(Duration::from_millis(60));
            shared.state().is_done = true;
            shared.done.notify_all();
            told.join().unwrap();
        });
        assert!((2..=12).contains(&lines.len()), "{lines:?}");
        assert!(lines.iter().all(|line| line == "25 %: 5 of 20 flights"), "{lines:?}");
    }

    #[test]
    fn times_are_said_in_the_unit_that_fits() {
        let said = |s| in_words(Duration::from_secs(s));
        assert_eq!([said(7), said(99), said(150), said(7200)], ["7 s", "99 s", "3 min", "2.0 h"]);
    }
}
