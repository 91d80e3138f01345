//! The lines that a run of the golden periods gives: compared with another run, and summed up.

use std::collections::BTreeMap;
use std::fmt::Write;

/// Instructions of the emulated processor per tick of its timer.
const INSTRUCTIONS_PER_TICK: u64 = 40;
/// Control periods per second that shares are given for.
const PERIODS_PER_SECOND: f64 = 100.0;

/// One vehicle and law.
#[derive(Debug, Default, PartialEq)]
struct Subject {
    /// Ticks of each period.
    ticks: Vec<u64>,
    /// Hash of the bits that each period gave.
    bits: Vec<String>,
    /// Bytes of stack that the deepest period used.
    stack: u64,
}

/// A run of all golden periods.
#[derive(Debug, PartialEq)]
pub(super) struct Run(BTreeMap<String, Subject>);

impl Run {
    /// From its lines: `arms law state ticks bits`, and `arms law stack bytes`.
    pub(super) fn read(text: &str) -> Result<Self, String> {
        let mut subjects: BTreeMap<String, Subject> = BTreeMap::new();
        for line in text.lines() {
            let bad = || format!("the run printed `{line}`, not `arms law state ticks bits`");
            let words: Vec<_> = line.split(' ').collect();
            let number = |word: &str| word.parse::<u64>().map_err(|_| bad());
            match words[..] {
                [arms, law, "stack", bytes] => {
                    subjects.entry(format!("{arms} {law}")).or_default().stack = number(bytes)?;
                }
                [arms, law, state, ticks, bits] => {
                    let subject = subjects.entry(format!("{arms} {law}")).or_default();
                    if number(state)? != subject.ticks.len() as u64 {
                        return Err(bad());
                    }
                    subject.ticks.push(number(ticks)?);
                    subject.bits.push(bits.to_owned());
                }
                _ => return Err(bad()),
            }
        }
        if subjects.values().all(|subject| subject.bits.is_empty()) {
            return Err("the run printed no period".to_owned());
        }
        Ok(Self(subjects))
    }

    /// How many periods it has.
    pub(super) fn len(&self) -> usize {
        self.0.values().map(|subject| subject.bits.len()).sum()
    }

    /// Whether another run gave the same bits in every period.
    pub(super) fn same_bits(&self, other: &Self) -> Result<(), String> {
        if !self.0.keys().eq(other.0.keys()) {
            return Err(format!("periods of {:?}, not {:?}", other.0.keys(), self.0.keys()));
        }
        for (name, subject) in &self.0 {
            let others = &other.0[name].bits;
            if subject.bits.len() != others.len() {
                let (found, expected) = (others.len(), subject.bits.len());
                return Err(format!("{name}: {found} periods, expected {expected}"));
            }
            let differ = subject.bits.iter().zip(others).filter(|(a, b)| a != b).count();
            if let Some(state) = subject.bits.iter().zip(others).position(|(a, b)| a != b) {
                return Err(format!(
                    "{name}: {differ} of {} periods differ from the host in their bits, state {state} \
                     first",
                    others.len()
                ));
            }
        }
        Ok(())
    }

    /// Instructions and stack of each subject, and the share of a 100 Hz period on three processors.
    pub(super) fn print(&self) {
        println!("{}", self.table());
    }

    fn table(&self) -> String {
        let mut text = format!(
            "{:14} {:>12} {:>9} {:>9} {:>8} {:>8} {:>8} {:>9}\n",
            "arms, law",
            "instructions",
            "smallest",
            "largest",
            "100 MIPS",
            "200 MIPS",
            "400 MIPS",
            "stack"
        );
        for (name, subject) in &self.0 {
            let mut sorted = subject.ticks.clone();
            sorted.sort_unstable();
            let at = |k: usize| sorted.get(k).map_or(0, |t| t * INSTRUCTIONS_PER_TICK);
            let (median, last) = (at(sorted.len() / 2), at(sorted.len().saturating_sub(1)));
            let share = |mips: f64| last as f64 * PERIODS_PER_SECOND / (mips * 1e6) * 100.0;
            let _ = writeln!(
                text,
                "{name:14} {median:12} {:9} {last:9} {:7.1}% {:7.1}% {:7.1}% {:7} B",
                at(0),
                share(100.0),
                share(200.0),
                share(400.0),
                subject.stack
            );
        }
        text + "shares are of the largest, at 100 periods per second; stack is the deepest that was used"
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_run_is_the_same_whatever_it_took_and_differs_by_one_bit() {
        let host = Run::read("one held 0 0 ab\none held 1 0 cd\none held stack 0\n").unwrap();
        let board = Run::read("one held 0 7 ab\none held 1 9 cd\none held stack 400\n").unwrap();
        let wrong = Run::read("one held 0 7 ab\none held 1 9 ce\none held stack 400\n").unwrap();
        let short = Run::read("one held 0 7 ab\none held stack 400\n").unwrap();
        assert_eq!(host.same_bits(&board), Ok(()));
        assert!(host.same_bits(&wrong).is_err_and(|why| why.contains("state 1")));
        assert!(host.same_bits(&short).is_err_and(|why| why.contains("1 periods")));
        assert!(board.table().contains("one held                360       280       360"));
    }

    #[test]
    fn a_run_that_broke_off_or_says_something_else_is_refused() {
        for text in ["", "one held stack 3\n", "one held 1 7 ab\n", "fault\n"] {
            assert!(Run::read(text).is_err(), "{text}");
        }
    }
}
