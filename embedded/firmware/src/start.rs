//! The first instructions, and what a panic would call.

use crate::host;
use core::arch::global_asm;
use core::panic::PanicInfo;

// The vector table, then: switch the floating-point unit on (CPACR, coprocessors 10 and 11) before any
// Rust runs, for its compiler uses it from the first instruction on.
global_asm!(
    ".section .vectors, \"ax\"",
    ".word _stack_top",
    ".word start",
    ".rept 14",
    ".word fault",
    ".endr",
    ".text",
    ".global start",
    ".type start, %function",
    ".thumb_func",
    "start:",
    "ldr r0, =0xE000ED88",
    "ldr r1, [r0]",
    "orr r1, r1, #0xF00000",
    "str r1, [r0]",
    "dsb",
    "isb",
    "bl firmware",
    "b finished",
    ".size start, . - start",
);

/// The end of a run that went well.
#[unsafe(no_mangle)]
extern "C" fn finished() -> ! {
    host::end(true)
}

/// What every exception leads to.
#[unsafe(no_mangle)]
extern "C" fn fault() -> ! {
    host::end(false)
}

unsafe extern "C" {
    /// Nobody defines this: a program that could panic does not link.
    fn PANIC_PATH_REMAINS() -> !;
}

#[panic_handler]
fn panic(_: &PanicInfo<'_>) -> ! {
    // SAFETY: never linked, so never called.
    unsafe { PANIC_PATH_REMAINS() }
}
