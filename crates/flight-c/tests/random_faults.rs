//! A million random faults of single words, in C: nothing that is not finite passes for good, and what is
//! refused leaves no trace.
#![allow(clippy::unwrap_used, reason = "a test may stop where it finds nothing")]

mod c_programs;

use c_programs::run_in_c;
use std::collections::BTreeMap;

/// Measured: 860,526 of the faults are accepted (they are within bounds, or in words that are not read); of
/// the others 99,637 are readings, the rest is asked. Of 50,000 set-ups 26,149 are accepted.
#[test]
fn of_a_million_faults_none_is_flown_with_a_number_that_is_not_finite_and_none_refused_leaves_a_trace()
 {
    let Some(printed) = run_in_c("random_faults", &["1000000", "50000"]) else { return };
    let counts: BTreeMap<&str, u64> = printed
        .lines()
        .map(|line| line.split_once(' ').unwrap())
        .map(|(name, count)| (name, count.parse().unwrap()))
        .collect();
    let refused: u64 = (1..10).map(|k| counts[format!("refused_by_status_{k}").as_str()]).sum();
    assert_eq!(counts["accepted"] + refused, 1_000_000, "{printed}");
    assert!(counts["refused_by_status_7"] > 50_000, "few readings are refused: {printed}");
    assert!(counts["set_ups_accepted"] > 10_000, "few set-ups are accepted: {printed}");
    for never in [
        "not_finite",
        "not_finite_next",
        "next_refused",
        "changed",
        "not_safe",
        "silent",
        "set_ups_changed",
        "set_ups_not_finite",
        "set_ups_that_do_not_fly",
    ] {
        assert_eq!(counts[never], 0, "{never}: {printed}");
    }
}
