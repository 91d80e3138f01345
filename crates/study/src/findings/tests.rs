//! Findings from verdicts that are written down.

use super::wording::{FINEST_MM, rounded, span};
use super::*;
use crate::bounds::Bounds;
use crate::judgement::Answer;
use crate::outcome::{Flown, SetKind, SetVerdict};

pub(super) fn set(name: &str, kind: SetKind) -> SetCard {
    SetCard {
        name: name.into(),
        kind,
        mass_kg: None,
        power_w: None,
        within_mass_limit: None,
        within_power_limit: None,
        propellant_kg: None,
        torque_nm: [None; 3],
        momentum_nms: [None; 3],
        momentum_everywhere_nms: None,
        provenance: vec![],
        surfaces: vec![],
    }
}

pub(super) fn verdict(set: &str, torque: Answer, momentum: Answer) -> SetVerdict {
    let none = Bounds { plain: None, best: None };
    SetVerdict {
        set: set.into(),
        suffices: torque.max(momentum),
        torque,
        momentum,
        propellant: Answer::Yes,
        torque_load: none,
        torque_nm: none,
        momentum_nms: none,
        saturates_s: none,
        slower: none,
        fuel_kg: None,
        fuel_in_place_kg: None,
        flown: None,
    }
}

pub(super) fn task(name: &str, verdicts: Vec<SetVerdict>) -> TaskOutcome {
    TaskOutcome {
        name: name.into(),
        labels: vec![],
        unflown: None,
        own_motion: true,
        duration_s: 10.0,
        peak_torque_nm: 80.0,
        peak_torque_by_axis_nm: [0.0, 0.0, 80.0],
        peak_momentum_nms: 70.0,
        gathered_nm: None,
        by_hand: None,
        tool_error_mm: 0.1,
        verdicts,
        demand: crate::demand::Demand::default(),
    }
}

/// A flight that holds its requirements.
pub(super) fn flown() -> Flown {
    Flown {
        tool_error_mm: 0.4,
        tool_error_at_end_mm: 0.1,
        attitude_error_deg: 0.01,
        propellant_kg: None,
        requirements_hold: true,
        ended: None,
        limit: None,
        closes: true,
    }
}

fn text<'a>(all: &'a [Finding], about: &str) -> Option<&'a Finding> {
    all.iter().find(|finding| finding.about == about)
}

const SETS: [(&str, SetKind); 2] = [("wheels", SetKind::Wheels), ("CMGs", SetKind::Cmgs)];

/// Three tasks: only CMGs do, wheels do, nothing does.
#[test]
fn the_claim_is_counted_where_it_holds_and_where_it_does_not() {
    use Answer::{No, WithSteering, Yes};
    let sets = SETS.map(|(name, kind)| set(name, kind));
    let mut slow = verdict("wheels", No, Yes);
    slow.slower.plain = Some(21.0);
    let tasks = [
        task("fast", vec![slow, verdict("CMGs", Yes, WithSteering)]),
        task("light", vec![verdict("wheels", Yes, Yes), verdict("CMGs", Yes, Yes)]),
        task("heavy", vec![verdict("wheels", No, No), verdict("CMGs", No, Yes)]),
    ];
    let all = findings(Some(ClaimIs::CmgsNeeded), &sets, &tasks);
    let holds = text(&all, "CMGs are needed").unwrap();
    assert!(holds.text.starts_with("In 1 of 3 tasks"), "{}", holds.text);
    assert!(holds.text.ends_with("There the claim holds against wheels."), "{}", holds.text);
    assert_eq!(holds.tasks, ["fast"]);
    assert_eq!(text(&all, "wheels suffice").unwrap().tasks, ["light"]);
    assert_eq!(text(&all, "not even CMGs").unwrap().tasks, ["heavy"]);
    let torque = text(&all, "torque decides").unwrap();
    assert!(torque.tasks == ["fast"] && torque.text.contains("21.0 to 21 times"), "{torque:?}");
    assert_eq!(text(&all, "steering decides").unwrap().tasks, ["fast"]);
    assert_eq!(text(&all, "duration decides"), None);
    assert_eq!(text(&all, "thrusters"), None);
}

#[test]
fn what_was_flown_is_told_by_its_tool_error() {
    let sets = SETS.map(|(name, kind)| set(name, kind));
    let mut one = verdict("CMGs", Answer::Yes, Answer::Yes);
    one.flown = Some(flown());
    let tasks = [task("fast", vec![verdict("wheels", Answer::No, Answer::Yes), one])];
    let all = findings(Some(ClaimIs::CmgsNeeded), &sets, &tasks);
    let error = text(&all, "tool error decides").unwrap();
    let told = "CMGs: suffice, 0.4 mm (requirements hold in 1 of 1 flights).";
    assert!(error.text.contains(told) && !error.text.contains("Wheels"), "{error:?}");
}

#[test]
fn where_nothing_was_flown_nothing_is_found() {
    let sets = SETS.map(|(name, kind)| set(name, kind));
    let unflown = TaskOutcome { unflown: Some("out of reach".into()), ..task("far", vec![]) };
    assert_eq!(findings(Some(ClaimIs::CmgsNeeded), &sets, &[unflown]), []);
    assert_eq!(findings(None, &sets, &[]), []);
}

/// "Wheels suffice." would be told the opposite of what is found.
#[test]
fn a_claim_of_another_kind_is_not_judged() {
    use Answer::{No, Yes};
    let sets = SETS.map(|(name, kind)| set(name, kind));
    let tasks = [
        task("fast", vec![verdict("wheels", No, Yes), verdict("CMGs", Yes, Yes)]),
        task("light", vec![verdict("wheels", Yes, Yes), verdict("CMGs", Yes, Yes)]),
        task("heavy", vec![verdict("wheels", No, No), verdict("CMGs", No, Yes)]),
    ];
    let judging = |claim| {
        let all = findings(claim, &sets, &tasks);
        all.iter().filter(|finding| finding.text.contains("claim")).count()
    };
    assert_eq!((judging(None), judging(Some(ClaimIs::CmgsNeeded))), (0, 3));
}

#[test]
fn thrusters_are_named_where_they_suffice_too() {
    use Answer::{No, Yes};
    let sets = [SETS[0], SETS[1], ("small", SetKind::Thrusters), ("large", SetKind::Thrusters)];
    let sets = sets.map(|(name, kind)| set(name, kind));
    let jets =
        |name: &str, torque, fuel| SetVerdict { fuel_kg: Some(fuel), ..verdict(name, torque, Yes) };
    let with =
        |small, large| vec![verdict("wheels", No, Yes), verdict("CMGs", Yes, Yes), small, large];
    let tasks = [
        task("fast", with(jets("small", No, 0.9), jets("large", Yes, 0.3))),
        task("slow", with(jets("small", Yes, 0.2), jets("large", Yes, 0.4))),
        task("wild", with(jets("small", No, 0.9), jets("large", No, 0.9))),
    ];
    let all = findings(None, &sets, &tasks);
    let told = &text(&all, "CMGs are needed").unwrap().text;
    assert!(told.starts_with("In 3 of 3 tasks"), "{told}");
    assert!(told.contains("Thrusters suffice too in 2 of them, for up to 300 g"), "{told}");
    // Of those that suffice only.
    let told = &text(&all, "thrusters").unwrap().text;
    assert!(told.contains("for up to 400 g"), "{told}");
}

/// A larger set suffices: that a smaller one lacks the torque decides nothing.
#[test]
fn torque_decides_only_where_no_wheels_suffice() {
    use Answer::{No, Yes};
    let sets = [("small", SetKind::Wheels), ("large", SetKind::Wheels)];
    let sets = sets.map(|(name, kind)| set(name, kind));
    let of = |large| task("light", vec![verdict("small", No, Yes), verdict("large", large, Yes)]);
    assert_eq!(text(&findings(None, &sets, &[of(Yes)]), "torque decides"), None);
    assert_eq!(text(&findings(None, &sets, &[of(No)]), "torque decides").unwrap().tasks, ["light"]);
}

#[test]
fn a_task_that_asks_for_nothing_is_said_to_and_not_counted() {
    let sets = SETS.map(|(name, kind)| set(name, kind));
    let all_yes =
        || SETS.map(|(name, _)| verdict(name, Answer::Yes, Answer::Yes)).into_iter().collect();
    let idle =
        TaskOutcome { peak_torque_nm: 0.0, peak_momentum_nms: 0.0, ..task("idle", all_yes()) };
    let all = findings(None, &sets, &[idle, task("light", all_yes())]);
    let told = text(&all, "nothing asked").unwrap();
    assert!(told.text.starts_with("1 of 2 tasks") && told.tasks == ["idle"], "{told:?}");
    assert_eq!(text(&all, "wheels suffice").unwrap().tasks, ["light"]);
    assert!(text(&all, "wheels suffice").unwrap().text.starts_with("In 1 of 1"));
}

/// "0.00017 to 0.00017 mm" was told of flights whose vehicle is known to a few percent.
#[test]
fn findings_have_two_digits_and_no_error_below_what_can_be_built() {
    assert_eq!(
        ["717.3", "12345", "48", "16.8", "0.0123"].map(|x| rounded(x.parse().unwrap())),
        ["720", "12000", "48", "17", "0.012"]
    );
    assert_eq!(span(1.7e-4, 1.73e-4, FINEST_MM), "less than 0.001");
    assert_eq!(span(1.7e-4, 26.7, FINEST_MM), "less than 0.001 to 27");
    assert_eq!(span(0.4, 0.401, FINEST_MM), "0.4");
}
