//! The page of the book: what was measured, against what was asked.

use super::{Measured, Timing};
use std::fmt::Write;

/// What is asked of a quantity: how many times faster than the peer.
#[derive(Debug, Clone, Copy)]
pub(super) struct Workload {
    /// Name in the results, and for people.
    key: &'static str,
    name: &'static str,
    /// Required of one arm and of two; with two, of the derivatives nothing.
    single: [Option<f64>; 2],
    /// Required of each of many states, of one arm.
    batch: Option<f64>,
}

const fn asked(
    key: &'static str,
    name: &'static str,
    single: [Option<f64>; 2],
    batch: Option<f64>,
) -> Workload {
    Workload { key, name, single, batch }
}

/// Quantities in the order of the page.
const WORKLOADS: [Workload; 8] = [
    asked("inverse_dynamics", "inverse dynamics", [Some(5.5), Some(5.0)], Some(8.5)),
    asked("mass_matrix", "mass matrix", [Some(3.5), Some(3.0)], Some(5.0)),
    asked("forward_dynamics", "forward dynamics", [Some(4.3), Some(3.8)], Some(6.8)),
    asked("momentum_matrix", "momentum matrix", [Some(3.9), Some(3.0)], None),
    asked("generalized_jacobian", "generalized Jacobian", [Some(8.5), Some(7.0)], None),
    asked(
        "inverse_dynamics_derivatives",
        "derivatives of inverse dynamics",
        [Some(3.4), None],
        None,
    ),
    asked(
        "forward_dynamics_derivatives",
        "derivatives of forward dynamics",
        [Some(2.0), None],
        None,
    ),
    asked("coasting_step", "fourth-order step, coasting", [Some(3.5), Some(2.7)], None),
];

/// Quantities that a quick run takes.
pub(super) const QUICK: [&str; 6] = [
    "inverse_dynamics",
    "mass_matrix",
    "forward_dynamics",
    "momentum_matrix",
    "generalized_jacobian",
    "coasting_step",
];

pub(super) const VEHICLES: [(&str, &str); 2] =
    [("one_arm", "base and 7 joints"), ("two_arms", "base, 7 and 6 joints")];

/// The ways that wrasse works a quantity out; all others are peers.
const WAYS: [&str; 4] = ["base", "avx2", "avx512", "batch_of_8"];

/// One row of results.
pub(super) struct Row {
    pub(super) vehicle: &'static str,
    pub(super) quantity: &'static str,
    pub(super) asked: (Option<f64>, Option<f64>),
    /// On the level that this processor uses by itself.
    pub(super) single: Timing,
    /// On SSE2.
    pub(super) narrow: Option<Timing>,
    /// Each of many states.
    pub(super) lane: Option<Timing>,
    pub(super) peer: Option<(String, Timing)>,
    /// Share of the core's peak that a single call reaches.
    pub(super) of_peak: Option<f64>,
}

pub(super) fn rows(measured: &Measured) -> Vec<Row> {
    let mut rows = vec![];
    for (vehicle, vehicle_name) in VEHICLES {
        for Workload { key, name, single: asked, batch } in WORKLOADS {
            let at = (vehicle.to_owned(), key.to_owned());
            let Some(ways) = measured.timings.get(&at) else { continue };
            let widest = WAYS[..3].iter().rev().find_map(|way| ways.get(*way).copied());
            let Some(single) = widest else { continue };
            let eighth = |t: &Timing| Timing { minimum: t.minimum / 8.0, median: t.median / 8.0 };
            let peer = ways.iter().find(|(name, _)| !WAYS.contains(&name.as_str()));
            let operations = measured.operations.get(&at);
            let arms = usize::from(vehicle != "one_arm");
            rows.push(Row {
                vehicle: vehicle_name,
                quantity: name,
                asked: (asked[arms], batch.filter(|_| arms == 0)),
                single,
                narrow: ways.get("base").copied(),
                lane: ways.get("batch_of_8").map(eighth),
                peer: peer.map(|(name, timing)| (name.clone(), *timing)),
                of_peak: operations.map(|n| n / single.minimum / measured.peak),
            });
        }
    }
    rows
}

/// How many times faster than the peer, one line each, for a program to read.
pub(super) fn ratios(measured: &Measured) -> String {
    let mut text = String::new();
    for (vehicle, _) in VEHICLES {
        for key in QUICK {
            let at = (vehicle.to_owned(), key.to_owned());
            let Some(ways) = measured.timings.get(&at) else { continue };
            let own = WAYS[..3].iter().rev().find_map(|way| ways.get(*way));
            let peer = ways.iter().find(|(name, _)| !WAYS.contains(&name.as_str()));
            if let Some((own, (_, peer))) = own.zip(peer) {
                let _ = writeln!(text, "ratio {vehicle} {key} {:.2}", peer.minimum / own.minimum);
            }
        }
    }
    text
}

/// The table, for the terminal and for the page.
pub(super) fn table(measured: &Measured) -> String {
    let mut text = String::from(
        "| vehicle | quantity | peer | single | SSE2 | of many | times faster: single (asked) | SSE2 | of many (asked) | single, share of peak |\n\
         |---|---|---|---|---|---|---|---|---|---|\n",
    );
    for row in rows(measured) {
        let time = |t: Option<Timing>| {
            t.map_or("–".to_owned(), |t| format!("{:.0} / {:.0}", t.minimum, t.median))
        };
        let peer = row.peer.as_ref().map(|(_, t)| *t);
        let faster = |own: Option<Timing>| peer.zip(own).map(|(p, own)| p.minimum / own.minimum);
        let verdict = |ratio: Option<f64>, asked: Option<f64>| match (ratio, asked) {
            (None, _) => "–".to_owned(),
            (Some(ratio), None) => format!("{ratio:.2}"),
            (Some(ratio), Some(asked)) if ratio >= asked => format!("{ratio:.2} ({asked})"),
            (Some(ratio), Some(asked)) => format!("{ratio:.2} ({asked}, **missed**)"),
        };
        let share = row.of_peak.map_or("–".to_owned(), |share| format!("{:.0} %", 100.0 * share));
        let _ = writeln!(
            text,
            "| {} | {} | {} | {} | {} | {} | {} | {} | {} | {share} |",
            row.vehicle,
            row.quantity,
            time(peer),
            time(Some(row.single)),
            time(row.narrow),
            time(row.lane),
            verdict(faster(Some(row.single)), row.asked.0),
            verdict(faster(row.narrow), None),
            verdict(faster(row.lane), row.asked.1),
        );
    }
    text
}

/// The whole page.
pub(super) fn page(measured: &Measured) -> String {
    let [cpu, compiler, commit] = &measured.circumstances;
    let peers = measured.without_peers.as_ref().map_or_else(
        || "Peers: Pinocchio 4.1 built with `-O3 -march=native` (the faster of its conventions), and \
            for the step MuJoCo 4.0's fourth-order one."
            .to_owned(),
        |why| format!("**The peers are missing: {why}.**"),
    );
    format!(
        "# How fast it is\n\n\
         `cargo xtask bench` made this page. It times wrasse (plain `cargo build --release`) and the \
         peers on the same files, one after the other, and writes minimum and median.\n\n\
         - Processor: {cpu}\n- Compiler: {compiler}\n- Commit: {commit}\n\n{peers}\n\n\
         Times are nanoseconds, minimum / median. *Single* is one call in double precision, built for \
         four links abreast and chosen as the program runs; *SSE2* the same on a processor without AVX2; \
         *of many* is one of eight states side by side, at the widest level of the processor. Each is a \
         whole call with the joints' sines and cosines, into places that are there; rooms are for 8 and \
         16 joints. The coasting step is the world's own, with its books. Ratios compare minima. Timings \
         on a shared machine are noisy: trust the ratios of one run.\n\n{}\n\
         ![Times faster than the peer, single calls and each of many](performance.svg)\n\n\
         ## How far from the limit\n\n\
         This core does at most {:.1} operations a nanosecond when products and sums are not fused: \
         fusing would change the bits from one level to the next. The last column is the share of that \
         which a single call reaches; its operations are counted by a number that counts.\n\n{}",
        table(measured),
        measured.peak,
        include_str!("remarks.md"),
    )
}
