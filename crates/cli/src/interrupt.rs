//! Ctrl-C: a word on what is kept, and the exit code that a shell expects.

use crate::input::tell;

/// Exit code of a program that Ctrl-C ended: 128 and the number of the signal.
const INTERRUPTED: i32 = 130;

/// At Ctrl-C, say what `kept` tells and end. Results are put in place whole, and the parts of a sweep
/// each for itself: there is nothing to tidy up.
pub(crate) fn at_interrupt(kept: impl Fn() -> String + Send + 'static) {
    // Without a handler the system ends the program: nothing is lost but the word.
    let _ = ctrlc::set_handler(move || {
        // Away from what the bar or the terminal has put on the line.
        tell(&format!("\ninterrupted: {}", kept()));
        std::process::exit(INTERRUPTED);
    });
}

/// Of a command that writes its results at its end.
pub(crate) fn nothing_kept() -> String {
    "nothing is kept; former results are as they were".into()
}
