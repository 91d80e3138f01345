//! Firmware that runs the golden control periods and tells what they gave and what they took.
#![no_std]
#![no_main]

mod board;
mod host;
mod start;

use board::Board;

#[cfg(feature = "double")]
type Number = f64;
#[cfg(not(feature = "double"))]
type Number = f32;

/// What runs once the processor is set up.
#[unsafe(no_mangle)]
extern "C" fn firmware() {
    #[cfg(feature = "planted-panic")]
    planted_panic();
    wrasse_golden_periods::run::<Number>(&mut Board::new());
}

/// An index that no compiler knows: what must not link.
#[cfg(feature = "planted-panic")]
fn planted_panic() {
    let numbers = [1, 2, 3];
    let at = core::hint::black_box(2);
    core::hint::black_box(numbers[at]);
}
