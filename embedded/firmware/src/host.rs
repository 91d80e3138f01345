//! The way out: semihosting, by which a program tells the machine that emulates it.

use core::arch::asm;

/// The standard output of the machine outside.
pub(crate) struct Output {
    handle: usize,
}

impl Output {
    /// Open it: `:tt` is the console, mode 4 is to write text.
    pub(crate) fn open() -> Self {
        let name = c":tt";
        let call = [name.as_ptr() as usize, 4, name.count_bytes()];
        // SAFETY: SYS_OPEN reads the three words and the name, and writes nothing.
        let handle = unsafe { ask(0x01, call.as_ptr() as usize) };
        Self { handle }
    }

    /// Write a text.
    pub(crate) fn put(&self, text: &str) {
        let call = [self.handle, text.as_ptr() as usize, text.len()];
        // SAFETY: SYS_WRITE reads the three words and the text, and writes nothing.
        unsafe { ask(0x05, call.as_ptr() as usize) };
    }
}

/// End the run: success is reported as exit code 0.
pub(crate) fn end(success: bool) -> ! {
    // ADP_Stopped_ApplicationExit, or ADP_Stopped_RunTimeErrorUnknown.
    let reason = if success { 0x20026 } else { 0x20023 };
    loop {
        // SAFETY: SYS_EXIT does not come back.
        unsafe { ask(0x18, reason) };
    }
}

/// One semihosting call.
///
/// # Safety
/// The parameter must be what the operation asks for.
unsafe fn ask(operation: usize, parameter: usize) -> usize {
    let answer;
    // SAFETY: the emulator answers this breakpoint in r0 and changes no other register.
    unsafe {
        asm!("bkpt 0xAB", inout("r0") operation => answer, in("r1") parameter);
    }
    answer
}
