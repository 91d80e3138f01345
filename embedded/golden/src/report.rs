//! What a run tells, without the formatting of the standard library, which can panic.

/// What runs the periods: it takes the lines, and counts where it can.
pub trait Machine {
    /// Take a piece of a line.
    fn put(&mut self, text: &str);
    /// A counter that goes up by one with every [`INSTRUCTIONS_PER_TICK`] instructions, modulo 2²⁴.
    fn ticks(&mut self) -> u32;
    /// Mark the free stack, so that it shows how deep it was used.
    fn mark_stack(&mut self);
    /// Most bytes of stack that were used below the caller since it was marked.
    fn stack_used(&mut self) -> u32;
}

/// Instructions per tick: one nanosecond each, a timer of 25 MHz.
pub const INSTRUCTIONS_PER_TICK: u32 = 40;

const DIGITS: [&str; 16] =
    ["0", "1", "2", "3", "4", "5", "6", "7", "8", "9", "a", "b", "c", "d", "e", "f"];

/// A number in decimal.
pub(crate) fn decimal(machine: &mut impl Machine, mut number: u32) {
    let mut digits = [0_u8; 10];
    for place in digits.iter_mut().rev() {
        *place = (number % 10) as u8;
        number /= 10;
    }
    let mut started = false;
    for (place, digit) in digits.into_iter().enumerate() {
        started |= digit != 0 || place == 9;
        if started {
            machine.put(DIGITS[usize::from(digit & 15)]);
        }
    }
}

/// A number as sixteen hexadecimal digits.
pub(crate) fn hexadecimal(machine: &mut impl Machine, number: u64) {
    for place in (0..16).rev() {
        machine.put(DIGITS[(number >> (4 * place) & 15) as usize]);
    }
}
