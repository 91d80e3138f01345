//! The report's section on the ledger: what each source gave of momentum and energy, and what none
//! explains.

use maud::{Markup, PreEscaped, html};
use wrasse_rehearsal::{Account, Booking, CaseOutcome, Ledger, Source};
use wrasse_spatial::Vec3;

use super::super::{Head, said, table};
use crate::wording::ledger::{Rest, ledger_rests, no_ledger, sources};
use crate::wording::numbers::{power, significant};

/// What stands behind the sources.
const TAIL: [&str; 5] = ["End", "Unexplained", "Of", "Relative", "Bound"];

const NAMES: [&str; 3] =
    ["Angular momentum (N·m·s)", "Linear momentum (N·s)", "Kinetic energy (J)"];

const FRAMES: &str = "Vectors are in inertial axes, angular momentum is about the origin of N. What the \
     attitude actuator stores is the opposite of its entry; what wheels and CMGs store is part of start \
     and end, so they enter with their work alone. Residuals are the largest over the run.";

/// The ledger of a case, or why there is none.
pub(super) fn ledger(case: &CaseOutcome) -> Markup {
    if let Some(why) = no_ledger(case) {
        let (first, rest) = why.split_at(1);
        return html! { p { (first.to_uppercase()) (rest) "." } };
    }
    let ledger = &case.ledger;
    let given: Vec<_> = sources(ledger).collect();
    let names = given.iter().map(|(source, _)| source.name());
    let head = ["", "Start"].into_iter().chain(names).chain(TAIL);
    let head: Vec<_> = head.map(Head::Plain).collect();
    let rows = NAMES.iter().zip(entries(ledger, &given)).zip(ledger_rests(ledger));
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
        (table("ledger", &head, &body))
        (stores(ledger).unwrap_or_default())
        p.hint { (FRAMES) }
    }
}

fn figures(rest: &Rest) -> [String; 4] {
    [power(rest.rest), significant(rest.scale), power(rest.relative), power(rest.bound)]
}

/// Angular momentum, linear momentum and energy: at the start, what each source gave, at the end. A source
/// that gave nothing of one has an empty cell there.
fn entries(ledger: &Ledger, given: &[(Source, Booking)]) -> [Vec<Markup>; 3] {
    let (start, end) = (&ledger.start, &ledger.end);
    let row = |start: Markup, each: &dyn Fn(&Booking) -> Markup, end: Markup| {
        let sources = given.iter().map(|(_, given)| each(given));
        std::iter::once(start).chain(sources).chain([end]).collect()
    };
    let work =
        |given: &Booking| if given.work == 0.0 { Markup::default() } else { one(given.work) };
    [
        row(stacked(start.angular), &|given| moved(given.angular), stacked(end.angular)),
        row(stacked(start.linear), &|given| moved(given.linear), stacked(end.linear)),
        row(one(start.energy), &work, one(end.energy)),
    ]
}

/// Where the angular momentum was at the start and at the end, if there are wheels or CMGs.
fn stores(ledger: &Ledger) -> Option<Markup> {
    let each = [Source::Wheels, Source::Cmgs].map(|source| {
        let at = |account: &Account| account.stored[source as usize];
        (source.name(), [at(&ledger.start), at(&ledger.end)])
    });
    let there: Vec<_> =
        each.iter().filter(|(_, ends)| ends.iter().any(|h| *h != Vec3::zero())).collect();
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

fn one(x: f64) -> Markup {
    html! { (significant(x)) }
}

/// An impulse; nothing where there is none.
fn moved(v: Vec3<f64>) -> Markup {
    if v == Vec3::zero() { Markup::default() } else { stacked(v) }
}

/// A vector's components below each other.
fn stacked(value: Vec3<f64>) -> Markup {
    PreEscaped(value.to_array().map(significant).join("<br/>"))
}
