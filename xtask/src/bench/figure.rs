//! The picture: how many times faster than the peer each quantity is, and what was asked.

use super::Measured;
use super::page::{Row, rows};
use std::fmt::Write;

const LEFT: f64 = 300.0;
const WIDTH: f64 = 560.0;
const LINE: f64 = 34.0;

/// Bars of single calls and lanes for each row, on a logarithmic axis, with ticks where it was asked.
pub(super) fn figure(measured: &Measured) -> String {
    let rows: Vec<Row> = rows(measured).into_iter().filter(|row| row.peer.is_some()).collect();
    let height = LINE * rows.len() as f64 + 70.0;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {height}\" \
         font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
        LEFT + WIDTH + 40.0
    );
    for times in [1.0, 2.0, 4.0, 8.0, 16.0, 32.0] {
        let x = at(times);
        let _ = writeln!(
            svg,
            "<line x1=\"{x:.1}\" x2=\"{x:.1}\" y1=\"10\" y2=\"{:.1}\" stroke=\"#ccc\"/>\
             <text x=\"{x:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{times:.0}</text>",
            height - 50.0,
            height - 34.0
        );
    }
    for (i, row) in rows.iter().enumerate() {
        bars(&mut svg, row, 16.0 + LINE * i as f64);
    }
    let _ = writeln!(
        svg,
        "<text x=\"{:.1}\" y=\"{:.1}\">times faster than the peer (–): blue single, orange each of many; \
         the stroke is what was asked</text>\n</svg>",
        LEFT - 60.0,
        height - 12.0
    );
    svg
}

fn at(times: f64) -> f64 {
    LEFT + WIDTH * (times.max(0.5).log2() + 1.0) / 6.0
}

fn bars(svg: &mut String, row: &Row, y: f64) {
    let Some((_, peer)) = &row.peer else { return };
    let _ = writeln!(
        svg,
        "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{} ({})</text>",
        LEFT - 8.0,
        y + 14.0,
        row.quantity,
        row.vehicle.replace("base and ", "").replace("base, ", "")
    );
    let ways = [(Some(row.single), row.asked.0, "#2b6cb0"), (row.lane, row.asked.1, "#dd6b20")];
    for (k, (own, asked, colour)) in ways.into_iter().enumerate() {
        let top = y + 12.0 * k as f64;
        if let Some(own) = own {
            let to = at(peer.minimum / own.minimum);
            let _ = writeln!(
                svg,
                "<rect x=\"{LEFT}\" y=\"{top:.1}\" width=\"{:.1}\" height=\"10\" fill=\"{colour}\"/>",
                to - LEFT
            );
        }
        if let Some(asked) = asked {
            let x = at(asked);
            let (up, down) = (top - 1.0, top + 11.0);
            let _ = writeln!(
                svg,
                "<line x1=\"{x:.1}\" x2=\"{x:.1}\" y1=\"{up:.1}\" y2=\"{down:.1}\" stroke=\"black\" stroke-width=\"2\"/>"
            );
        }
    }
}
