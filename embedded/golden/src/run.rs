//! All golden periods, one line each.

use crate::period::{STATES, Subject, numbers, one_arm, two_arms};
use crate::report::{Machine, decimal, hexadecimal};
use wrasse_flight::ArmLaw;
use wrasse_spatial::Scalar;

/// A number whose bits can be told.
pub trait Number: Scalar {
    /// Its bits, in the low end of the word.
    fn bits(self) -> u64;
}
impl Number for f32 {
    fn bits(self) -> u64 {
        u64::from(self.to_bits())
    }
}
impl Number for f64 {
    fn bits(self) -> u64 {
        self.to_bits()
    }
}

/// Run all of them: lines `arms law state ticks bits`, then for each subject `arms law stack bytes`.
/// The bits are a hash of all the numbers that a period gives.
pub fn run<T: Number>(machine: &mut impl Machine) {
    each("one held ", one_arm::<T, 7>(ArmLaw::AttitudeHeld), machine);
    each("one floating ", one_arm::<T, 7>(ArmLaw::FreeFloating), machine);
    each("two held ", two_arms::<T, 14>(ArmLaw::AttitudeHeld), machine);
    each("two floating ", two_arms::<T, 14>(ArmLaw::FreeFloating), machine);
}

fn each<T: Number, const J: usize>(
    name: &str,
    subject: Option<Subject<T, J>>,
    machine: &mut impl Machine,
) {
    let Some(subject) = subject else { return };
    let mut deepest = 0;
    for number in 0..STATES {
        let mut start = subject.start(number);
        machine.mark_stack();
        let before = machine.ticks();
        let given = subject.period(&mut start);
        let took = machine.ticks().wrapping_sub(before) & 0xFF_FFFF;
        deepest = deepest.max(machine.stack_used());
        machine.put(name);
        decimal(machine, number);
        machine.put(" ");
        decimal(machine, took);
        machine.put(" ");
        hexadecimal(machine, hash(numbers(&given)));
        machine.put("\n");
    }
    machine.put(name);
    machine.put("stack ");
    decimal(machine, deepest);
    machine.put("\n");
}

/// FNV-1a over the words: the same bits give the same hash.
fn hash<T: Number>(numbers: impl Iterator<Item = T>) -> u64 {
    numbers.fold(0xCBF2_9CE4_8422_2325, |h, x| (h ^ x.bits()).wrapping_mul(0x0100_0000_01B3))
}
