//! The board: its timer counts instructions, its stack shows how deep it was used.

use crate::host::Output;
use core::arch::asm;
use wrasse_golden_periods::Machine;

const SYSTICK_CONTROL: *mut u32 = 0xE000_E010 as *mut u32;
const SYSTICK_RELOAD: *mut u32 = 0xE000_E014 as *mut u32;
const SYSTICK_CURRENT: *mut u32 = 0xE000_E018 as *mut u32;

/// What unused stack holds.
const MARK: u32 = 0x5AFE_57AC;

unsafe extern "C" {
    /// The lowest word of the stack, from the linker script.
    static mut _stack_bottom: u32;
}

/// A board under emulation.
pub(crate) struct Board {
    output: Output,
    /// Where the stack stood when it was marked.
    marked_from: usize,
}

impl Board {
    /// With its timer counting down, by the processor's clock, without interrupts.
    pub(crate) fn new() -> Self {
        // SAFETY: registers of the system timer, which nothing else uses.
        unsafe {
            SYSTICK_RELOAD.write_volatile(0xFF_FFFF);
            SYSTICK_CURRENT.write_volatile(0);
            SYSTICK_CONTROL.write_volatile(0b101);
        }
        Self { output: Output::open(), marked_from: 0 }
    }
}

impl Machine for Board {
    fn put(&mut self, text: &str) {
        self.output.put(text);
    }

    fn ticks(&mut self) -> u32 {
        // SAFETY: reading the timer changes nothing that is used here.
        0xFF_FFFF - unsafe { SYSTICK_CURRENT.read_volatile() }
    }

    #[inline(always)]
    fn mark_stack(&mut self) {
        let top = stack_pointer();
        self.marked_from = top;
        let mut at = &raw mut _stack_bottom;
        while (at as usize) < top {
            // SAFETY: between the end of the stack and where it stands now nothing lives.
            unsafe {
                at.write_volatile(MARK);
                at = at.add(1);
            }
        }
    }

    #[inline(always)]
    fn stack_used(&mut self) -> u32 {
        let mut at = &raw mut _stack_bottom;
        // SAFETY: reads between the end of the stack and where it stood, which is memory.
        unsafe {
            while (at as usize) < self.marked_from && at.read_volatile() == MARK {
                at = at.add(1);
            }
        }
        (self.marked_from - at as usize) as u32
    }
}

/// Where the stack stands in the function that this is inlined into.
#[inline(always)]
fn stack_pointer() -> usize {
    let at;
    // SAFETY: copies a register.
    unsafe { asm!("mov {}, sp", out(reg) at, options(nomem, nostack, preserves_flags)) };
    at
}
