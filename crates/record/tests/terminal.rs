//! The table in the terminal.

mod sample;

use wrasse_record::verdict_table;
use wrasse_rehearsal::{Event, EventKind};

#[test]
fn a_single_case_shows_its_verdicts_and_a_line_each_for_momentum_and_energy() {
    let expected = "
requirement                              limit    value  unit   verdict
tool.position_error.max                 <= 0.3  0.01234  mm     pass
base.attitude_error.max                 <= 0.5   0.0831  deg    pass
joint.rate.max                            <= 5    4.327  deg/s  pass
actuator.momentum.max                    <= 25    23.45  N·m·s  pass
tool.position_error.final during hold  <= 0.02   0.0017  mm     pass

momentum  ledger closes: angular 3.1e-14 of 48.2 N·m·s unexplained (6.4e-16, bound 1.0e-12); linear 1.2e-14 of 14.6 N·s unexplained (8.2e-16, bound 1.0e-12)
energy    ledger closes: 2.4e-12 of 0.391 J unexplained (6.1e-12, bound 1.0e-8); joint drives 0.0123 J, attitude actuator -0.0123 J
integration error, from a second run at half the step: base.attitude 3.1e-12 rad
";
    assert_eq!(format!("\n{}", verdict_table(&sample::single())), expected);
}

#[test]
fn compared_cases_share_one_table_with_a_row_for_each() {
    let expected = "
                                                                     tool           tool      base            tool
                                                        along_track_error  lateral_error  rotation  position_error
                                                                    final          final     final             max
law            load     outcome                verdict                 mm             mm       deg              mm
terrestrial    unladen  completed              FAIL               -15.598         4.6817    0.0831          15.612
terrestrial    200 kg   completed              FAIL               -70.198         21.062    0.0831          70.212
terrestrial    500 kg   completed              FAIL                -124.8         37.442    0.0831          124.81
attitude-held  unladen  completed              pass                0.0021         0.0017    0.0831         0.01234
attitude-held  200 kg   completed              pass                0.0021         0.0017    0.0831         0.01234
attitude-held  500 kg   completed              pass                0.0021         0.0017    0.0831         0.01234
free-floating  unladen  completed              pass                0.0021         0.0017    0.0831         0.01234
free-floating  200 kg   completed              pass                0.0021         0.0017    0.0831         0.01234
free-floating  500 kg   infeasible at 13.28 s  FAIL                     -              -         -               -

5 of 9 cases pass
law=terrestrial, load=unladen: tool.position_error.max <= 0.3 mm fails with 15.612 mm
law=terrestrial, load=200 kg: tool.position_error.max <= 0.3 mm fails with 70.212 mm
law=terrestrial, load=500 kg: tool.position_error.max <= 0.3 mm fails with 124.81 mm
law=free-floating, load=500 kg: infeasible in phase reach at 13.28 s: the wrist is 0.8731 m from the shoulder, the arm reaches 0.8500 m: the base recoils away from the target

momentum  ledger closes: angular 3.1e-14 of 48.2 N·m·s unexplained (6.4e-16, bound 1.0e-12); linear 1.2e-14 of 14.6 N·s unexplained (8.2e-16, bound 1.0e-12) (worst of the cases: law=terrestrial, load=unladen)
energy    ledger closes: 2.4e-12 of 0.391 J unexplained (6.1e-12, bound 1.0e-8); joint drives 0.0123 J, attitude actuator -0.0123 J
";
    assert_eq!(format!("\n{}", verdict_table(&sample::compared())), expected);
}

#[test]
fn a_limit_that_was_reached_is_told_between_verdicts_and_ledger() {
    let mut outcome = sample::single();
    outcome.cases[0].events.push(Event {
        time_s: 7.25,
        kind: EventKind::Limit,
        text: "attitude actuator full: 25 N·m·s about z".into(),
    });
    let table = verdict_table(&outcome);
    let told = table.find("\nat 7.25 s: attitude actuator full: 25 N·m·s about z\n");
    assert!(told.expect("it is told") < table.find("momentum  ledger").expect("the ledger"));
}

#[test]
fn each_of_several_cases_tells_its_first_limit_and_how_many_there_are_more() {
    let mut outcome = sample::compared();
    let event = |time_s, kind, text: &str| Event { time_s, kind, text: text.into() };
    outcome.cases[1].events.push(event(7.25, EventKind::Failure, "wheel x fails"));
    outcome.cases[1].events.push(event(8.0, EventKind::Limit, "wheel y full"));
    outcome.cases[1].events.push(event(9.0, EventKind::Limit, "wheel z full"));
    outcome.cases[4].events.push(event(2.0, EventKind::Limit, "wheel y full"));
    let table = verdict_table(&outcome);
    let told = "\nlaw=terrestrial, load=200 kg: at 7.25 s: wheel x fails; and 2 more: see the report\n\
                law=attitude-held, load=200 kg: at 2 s: wheel y full\n\nmomentum  ledger";
    assert!(table.contains(told), "{table}");
}

#[test]
fn limits_and_failures_of_many_cases_take_at_most_twelve_lines_each() {
    let mut outcome = sample::compared();
    outcome.cases.extend(outcome.cases.clone());
    for case in &mut outcome.cases {
        let text = "wheel y full".into();
        case.events.push(Event { time_s: 2.0, kind: EventKind::Limit, text });
        case.verdicts[0].pass = false;
        case.verdicts[0].value = Some(0.7);
    }
    let table = verdict_table(&outcome);
    assert_eq!(table.matches(": at 2 s: wheel y full\n").count(), 12, "{table}");
    assert_eq!(table.matches(" fails with 0.7 mm\n").count(), 12, "{table}");
    assert_eq!(table.matches("\nand 6 more cases: see the report\n").count(), 2, "{table}");
}
