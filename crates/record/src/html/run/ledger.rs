//! The report's section on the ledger: what was booked of momentum and energy, and what is left
//! over.

use maud::{Markup, PreEscaped, html};
use wrasse_mission::{CaseOutcome, Ledger};

use super::super::{Head, said, table};
use crate::wording::ledger::{Rest, ledger_rests, no_ledger};
use crate::wording::numbers::{power, significant};

const HEAD: [&str; 13] = [
    "",
    "Start",
    "Joint drives",
    "Attitude actuator",
    "Thrusters",
    "Outside",
    "With propellant",
    "Grasps",
    "End",
    "Unexplained",
    "Of",
    "Relative",
    "Bound",
];

const NAMES: [&str; 3] =
    ["Angular momentum (N·m·s)", "Linear momentum (N·s)", "Kinetic energy (J)"];

const FRAMES: &str = "Vectors are in inertial axes, angular momentum is about the centre of mass \
     of everything simulated. What the attitude actuator stores is the opposite of its entry; what \
     wheels and CMGs store is part of start and end, and the work on the bodies of thrusters, \
     wheels and CMGs stands under the attitude actuator. Rests are the largest over the run.";

/// The ledger of a case, or why there is none.
pub(super) fn ledger(case: &CaseOutcome) -> Markup {
    if let Some(why) = no_ledger(case) {
        let (first, rest) = why.split_at(1);
        return html! { p { (first.to_uppercase()) (rest) "." } };
    }
    let ledger = &case.ledger;
    let rows = NAMES.iter().zip(entries(ledger)).zip(ledger_rests(ledger));
    let body = html! {
        @for ((name, entries), rest) in rows {
            tr {
                th scope="row" { (name) }
                @for entry in entries { td.n { (entry) } }
                @for figure in figures(&rest) { td.n { (figure) } }
            }
        }
    };
    let why = if ledger.closes {
        ": every rest is within its bound."
    } else {
        ": a rest is above its bound."
    };
    html! {
        p { (said(ledger.closes, "closes", "stays open")) (why) }
        (table("ledger", &HEAD.map(Head::Plain), &body))
        (stores(ledger).unwrap_or_default())
        p.hint { (FRAMES) }
    }
}

fn figures(rest: &Rest) -> [String; 4] {
    [power(rest.rest), significant(rest.scale), power(rest.relative), power(rest.bound)]
}

/// What was booked of angular momentum, linear momentum and energy, in the order of the table.
fn entries(ledger: &Ledger) -> [[Markup; 8]; 3] {
    let none = Markup::default;
    let left = |v: [f64; 3]| stacked(v.map(|x| -x));
    let one = |x: f64| html! { (significant(x)) };
    [
        [
            stacked(ledger.angular_start),
            none(),
            stacked(ledger.angular_from_actuator),
            stacked(ledger.angular_from_thrusters),
            stacked(ledger.angular_from_outside),
            left(ledger.angular_with_propellant),
            none(),
            stacked(ledger.angular_end),
        ],
        [
            stacked(ledger.linear_start),
            none(),
            none(),
            stacked(ledger.linear_from_thrusters),
            stacked(ledger.linear_from_outside),
            left(ledger.linear_with_propellant),
            none(),
            stacked(ledger.linear_end),
        ],
        [
            one(ledger.energy_start),
            one(ledger.work_of_joints),
            one(ledger.work_of_actuator),
            none(),
            one(ledger.work_from_outside),
            one(-ledger.energy_with_propellant),
            one(ledger.energy_at_grasps),
            one(ledger.energy_end),
        ],
    ]
}

/// Where the angular momentum was at the start and at the end, if there are wheels or CMGs.
fn stores(ledger: &Ledger) -> Option<Markup> {
    let each = [("wheels", ledger.angular_in_wheels), ("cmgs", ledger.angular_in_cmgs)];
    let holds = |[start, end]: &[[f64; 3]; 2]| start.iter().chain(end).any(|x| *x != 0.0);
    let there: Vec<_> = each.iter().filter(|(_, ends)| holds(ends)).collect();
    let body = html! {
        @for (what, ends) in &there {
            tr {
                td { "in the " (what) " (N·m·s)" }
                @for momentum in ends { td.n { (stacked(*momentum)) } }
            }
        }
    };
    let head = ["Angular momentum", "Start", "End"].map(Head::Plain);
    (!there.is_empty()).then(|| table("text", &head, &body))
}

/// A vector's components below each other.
fn stacked(value: [f64; 3]) -> Markup {
    PreEscaped(value.map(significant).join("<br/>"))
}
