//! The page of the book: what was measured, against what was asked.

use super::{Measured, Timing};
use std::fmt::Write;

/// Quantities in the order of the page: name in the results, name for people, times faster asked of a
/// single call, and of a lane.
pub(super) const ROWS: [(&str, &str, f64, Option<f64>); 8] = [
    ("inverse_dynamics", "inverse dynamics", 4.0, Some(20.0)),
    ("mass_matrix", "mass matrix", 3.0, Some(12.0)),
    ("forward_dynamics", "forward dynamics", 4.0, Some(14.0)),
    ("momentum_matrix", "momentum matrix", 4.0, None),
    ("generalized_jacobian", "generalized Jacobian", 4.0, None),
    ("inverse_dynamics_derivatives", "derivatives of inverse dynamics", 2.0, None),
    ("forward_dynamics_derivatives", "derivatives of forward dynamics", 2.0, None),
    ("coasting_step", "fourth-order step, coasting", 6.0, None),
];

const VEHICLES: [(&str, &str); 2] =
    [("one_arm", "base and 7 joints"), ("two_arms", "base, 7 and 6 joints")];

/// One row of results.
pub(super) struct Row {
    pub(super) vehicle: &'static str,
    pub(super) quantity: &'static str,
    pub(super) asked: (f64, Option<f64>),
    pub(super) single: Timing,
    pub(super) wider: Option<Timing>,
    /// For each of eight states.
    pub(super) lane: Option<Timing>,
    pub(super) peer: Option<(String, Timing)>,
    /// Share of the core's peak that lanes reach.
    pub(super) of_peak: Option<f64>,
}

pub(super) fn rows(measured: &Measured) -> Vec<Row> {
    let mut rows = vec![];
    for (vehicle, vehicle_name) in VEHICLES {
        for (key, quantity, single_asked, lane_asked) in ROWS {
            let at = (vehicle.to_owned(), key.to_owned());
            let Some(ways) = measured.timings.get(&at) else { continue };
            let Some(single) = ways.get("single").copied() else { continue };
            let eighth = |t: &Timing| Timing { minimum: t.minimum / 8.0, median: t.median / 8.0 };
            let lane = ways.get("lanes").map(eighth);
            let own = ["single", "single_avx2", "lanes"];
            let peer = ways.iter().find(|(name, _)| !own.contains(&name.as_str()));
            let operations = measured.operations.get(&at);
            let of_peak = operations.zip(lane).map(|(n, t)| n / t.minimum / measured.peak);
            rows.push(Row {
                vehicle: vehicle_name,
                quantity,
                asked: (single_asked, lane_asked),
                single,
                wider: ways.get("single_avx2").copied(),
                lane,
                peer: peer.map(|(name, timing)| (name.clone(), *timing)),
                of_peak,
            });
        }
    }
    rows
}

/// The table, for the terminal and for the page.
pub(super) fn table(measured: &Measured) -> String {
    let mut text = String::from(
        "| vehicle | quantity | peer | single | AVX2 | lane | times faster: single (asked) | AVX2 | lane (asked) | lane, share of peak |\n\
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
            (Some(ratio), Some(asked)) if ratio >= asked => format!("{ratio:.2} ({asked:.0})"),
            (Some(ratio), Some(asked)) => format!("{ratio:.2} ({asked:.0}, **missed**)"),
        };
        let share = row.of_peak.map_or("–".to_owned(), |share| format!("{:.0} %", 100.0 * share));
        let _ = writeln!(
            text,
            "| {} | {} | {} | {} | {} | {} | {} | {} | {} | {share} |",
            row.vehicle,
            row.quantity,
            time(peer),
            time(Some(row.single)),
            time(row.wider),
            time(row.lane),
            verdict(faster(Some(row.single)), Some(row.asked.0)),
            verdict(faster(row.wider), None),
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
         Times are nanoseconds, minimum / median. *Single* is one call in plain double precision; \
         *AVX2* the same code built for that level and chosen as the program runs; *lane* is one of \
         eight states side by side, at the widest level of the processor. Each is a whole call with \
         the joints' sines and cosines. Ratios compare minima. Timings on a shared machine are noisy: \
         trust the ratios of one run.\n\n{}\n\
         ![Times faster than the peer, single calls and lanes](performance.svg)\n\n\
         ## How far from the limit\n\n\
         In lanes this core does at most {:.1} operations a nanosecond when products and sums are not \
         fused: fusing would change the bits from one level to the next. The last column is the share \
         of that which a kernel reaches; its operations are counted by a number that counts.\n\n{}",
        table(measured),
        measured.peak,
        include_str!("remarks.md"),
    )
}
