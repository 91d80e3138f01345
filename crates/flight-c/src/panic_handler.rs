//! What a panic would call: an undefined symbol, so that a program that could panic does not
//! link.
#![allow(unsafe_code, reason = "the symbol is foreign")]

use core::panic::PanicInfo;

unsafe extern "C" {
    /// Defined nowhere.
    fn WRASSE_PANIC_PATH_REMAINS() -> !;
}

#[panic_handler]
fn panic(_: &PanicInfo<'_>) -> ! {
    // SAFETY: never linked, so never called.
    unsafe { WRASSE_PANIC_PATH_REMAINS() }
}
