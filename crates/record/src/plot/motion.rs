//! The motion as a picture: the vehicle at several instants, from above and from the side.

use std::fmt::Write;

use maud::{Markup, html};
use wrasse_rehearsal::Snapshot;

use super::{Axis, Frame, Length, Scale, corners, multiples, step};
use crate::wording::numbers::significant;

/// Most instants in one picture; more would hide each other.
const INSTANTS: usize = 5;
/// Most points of the tool's path.
const PATH_POINTS: usize = 500;
/// Width of the drawn field (SVG units; about pixels).
const WIDTH: f64 = 520.0;
/// Most height of a field.
const HEIGHT: f64 = 400.0;
/// Room above a field.
const ABOVE: f64 = 12.0;
/// Most grid lines across a field, and so the step of both axes.
const LINES: f64 = 9.0;
/// Farther than this (m) a run has broken down, and nothing could be seen.
const FARTHEST: f64 = 1e6;

/// A point on a view (m).
type Point = [f64; 2];

/// One direction of looking.
struct View {
    title: &'static str,
    /// Which coordinates go to the right and up.
    axes: [usize; 2],
    frame: Frame<'static>,
}

/// Two views of the motion to one scale, as a figure; nothing if there is nothing to draw.
pub(crate) fn drawing(snapshots: &[Snapshot]) -> Option<Markup> {
    let drawn: Vec<&Snapshot> = snapshots.iter().filter(|s| drawable(s)).collect();
    let (first, last) = (drawn.first()?, drawn.last()?);
    let instants = evenly(&drawn, INSTANTS);
    let times: Vec<_> = instants.iter().map(|s| significant(s.time)).collect();
    let shades = if times.len() > 1 { ", from light to dark" } else { "" };
    Some(html! {
        figure.motion {
            div.views {
                @for view in views(&drawn, &instants) {
                    div {
                        p.view { (view.title) }
                        (view.sheet(&drawn, &instants, [first.time, last.time]))
                    }
                }
            }
            figcaption {
                "The vehicle at " (times.join(", ")) " s" (shades) ". "
                span.key.path { (path_of(&drawn)) } " "
                span.key.wanted { "where it should be" }
                " Both views to one scale, in inertial axes."
            }
        }
    })
}

/// The path in words: of the tools that are guided, in their order.
fn path_of(drawn: &[&Snapshot]) -> String {
    let mut guided: Vec<&str> = vec![];
    for snapshot in drawn {
        if !guided.contains(&snapshot.guided.as_str()) {
            guided.push(&snapshot.guided);
        }
    }
    format!("path of {}", guided.join(", "))
}

fn drawable(snapshot: &Snapshot) -> bool {
    points(snapshot).all(|p| p.iter().all(|x| x.abs() <= FARTHEST)) && snapshot.time.is_finite()
}

/// Every point of a snapshot.
fn points(snapshot: &Snapshot) -> impl Iterator<Item = [f64; 3]> {
    let corners = snapshot.boxes.iter().flat_map(|b| b.corners);
    let joints = snapshot.arms.iter().flatten().copied();
    corners.chain(joints).chain([snapshot.tool, snapshot.reference])
}

/// At most `most` snapshots: the first, the last, and those between them, evenly.
fn evenly<'a>(drawn: &[&'a Snapshot], most: usize) -> Vec<&'a Snapshot> {
    let count = drawn.len().min(most);
    let last = drawn.len() - 1;
    (0..count).map(|k| drawn[k * last / (count - 1).max(1)]).collect()
}

/// Bounds views, wide enough for all that is drawn in them, to one scale.
fn views(drawn: &[&Snapshot], instants: &[&Snapshot]) -> [View; 2] {
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    let paths = drawn.iter().flat_map(|s| [s.tool, s.reference]);
    for point in instants.iter().flat_map(|s| points(s)).chain(paths) {
        for k in 0..3 {
            low[k] = low[k].min(point[k]);
            high[k] = high[k].max(point[k]);
        }
    }
    for k in 0..3 {
        let pad = 0.06 * (high[k] - low[k]).max(1.0);
        (low[k], high[k]) = (low[k] - pad, high[k] + pad);
    }
    let span = |k: usize| high[k] - low[k];
    let scale = (WIDTH / span(0)).min(HEIGHT / span(1)).min(HEIGHT / span(2));
    // The field keeps its width where the height limits the scale.
    let more = 0.5 * (WIDTH / scale - span(0));
    let (left, right) = (low[0] - more, high[0] + more);
    [("From above", 1), ("From the side", 2)].map(|(title, up)| {
        let axis = |k: usize, low: f64, high: f64| {
            let ticks = multiples(low, high, step(WIDTH / scale, LINES));
            Axis { label: ["x (m)", "y (m)", "z (m)"][k], scale: Scale::linear(low, high), ticks }
        };
        let frame = Frame {
            above: ABOVE,
            size: [WIDTH, scale * span(up)],
            axes: [axis(0, left, right), axis(up, low[up], high[up])],
        };
        View { title, axes: [0, up], frame }
    })
}

impl View {
    /// Where a point in space is on the sheet; in the corner what has no place.
    fn on_sheet(&self, point: [f64; 3]) -> Point {
        self.frame.place(self.axes.map(|axis| point[axis])).unwrap_or_default()
    }

    fn sheet(&self, drawn: &[&Snapshot], instants: &[&Snapshot], times: [f64; 2]) -> Markup {
        let along = evenly(drawn, PATH_POINTS);
        // A path for each tool that is guided for a while: between two of them nothing moved.
        let paths = || along.chunk_by(|a, b| a.guided == b.guided);
        let line = |path: &[&Snapshot], point: fn(&Snapshot) -> [f64; 3]| {
            let points: Vec<_> = path.iter().map(|s| self.on_sheet(point(s))).collect();
            corners(&points)
        };
        let gone: Vec<_> = along.iter().map(|s| self.on_sheet(s.tool)).collect();
        let content = html! {
            @for (k, snapshot) in instants.iter().enumerate() {
                // From a fifth to full strength.
                @let strength = (k + 1) as f64 / instants.len() as f64;
                (self.instant(snapshot, 0.1 + 0.9 * strength * strength))
            }
            @for path in paths() { polyline.wanted points=(line(path, |s| s.reference)) {} }
            @for path in paths() { polyline.gone points=(line(path, |s| s.tool)) {} }
            @if let [first, .., last] = gone.as_slice() {
                // The times stand on the outer sides of the path.
                @let apart = if first[0] < last[0] { [-1.0, 1.0] } else { [1.0, -1.0] };
                (tool_mark(*first, times[0], apart[0]))
                (tool_mark(*last, times[1], apart[1]))
            }
        };
        self.frame.sheet("view", &format!("{} view of the motion", self.title), &content)
    }

    /// The vehicle at one instant: silhouettes and edges of its boxes, arms as lines, joints as
    /// dots.
    fn instant(&self, snapshot: &Snapshot, strength: f64) -> Markup {
        html! {
            g opacity=(format!("{strength:.2}")) {
                @for solid in &snapshot.boxes {
                    @let seen = solid.corners.map(|corner| self.on_sheet(corner));
                    polygon.face points=(corners(&hull(&seen))) {}
                    path.edge d=(edges(&seen)) {}
                }
                @for arm in &snapshot.arms {
                    @let joints: Vec<_> = arm.iter().map(|joint| self.on_sheet(*joint)).collect();
                    polyline.arm points=(corners(&joints)) {}
                    @for [x, y] in joints {
                        circle.joint cx=(Length(x)) cy=(Length(y)) r="2.6" {}
                    }
                }
            }
        }
    }
}

/// A ring at the tool, with the time beside it: at its right for a `side` of 1, at its left for -1.
fn tool_mark([x, y]: Point, time: f64, side: f64) -> Markup {
    let anchor = if side > 0.0 { "start" } else { "end" };
    html! {
        circle.tool cx=(Length(x)) cy=(Length(y)) r="4" {}
        text.time x=(Length(x + 8.0 * side)) y=(Length(y + 4.0)) text-anchor=(anchor) {
            (significant(time)) " s"
        }
    }
}

/// The twelve edges of a box whose corners count in binary: each joins corners one bit apart.
fn edges(corners: &[Point; 8]) -> String {
    let mut path = String::new();
    for from in 0..8 {
        for bit in [1, 2, 4] {
            if from & bit == 0 {
                let ([x, y], [to_x, to_y]) = (corners[from], corners[from | bit]);
                let _ = write!(path, "M{x:.1} {y:.1}L{to_x:.1} {to_y:.1}");
            }
        }
    }
    path
}

/// Convex hull by the monotone chain.
fn hull(points: &[Point]) -> Vec<Point> {
    let mut sorted = points.to_vec();
    sorted.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let turns_left = |a: Point, b: Point, c: Point| {
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0.0
    };
    let chain = |points: &mut dyn Iterator<Item = Point>| {
        let mut chain: Vec<Point> = Vec::new();
        for point in points {
            while let [.., a, b] = chain[..]
                && !turns_left(a, b, point)
            {
                chain.pop();
            }
            chain.push(point);
        }
        // Its end is the other chain's beginning.
        chain.pop();
        chain
    };
    let mut hull = chain(&mut sorted.iter().copied());
    hull.extend(chain(&mut sorted.iter().rev().copied()));
    hull
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hull_of_a_box_seen_along_an_axis_is_its_face() {
        let corners: Vec<Point> =
            (0..8).map(|k| [f64::from(k & 1), f64::from((k >> 1) & 1)]).collect();
        assert_eq!(hull(&corners), [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
    }

    #[test]
    fn both_views_have_one_scale_with_x_to_the_right_and_y_or_z_up() {
        let at = |time: f64, tool: [f64; 3]| Snapshot {
            time,
            boxes: vec![],
            arms: vec![],
            tool,
            reference: tool,
            guided: "tool".into(),
        };
        let (near, far) = (at(0.0, [0.0; 3]), at(1.0, [2.0, 1.0, 0.5]));
        let drawn = [&near, &far];
        let [above, side] = views(&drawn, &drawn);
        for (view, up) in [(above, 1.0), (side, 0.5)] {
            let [from, to] = drawn.map(|s| view.on_sheet(s.tool));
            let across = to[0] - from[0];
            assert!(across > 0.0);
            // The sheet counts downwards. Measured 3e-14 and 2e-14 of some 200.
            assert!((from[1] - to[1] - across * up / 2.0).abs() < 1e-10);
        }
    }

    #[test]
    fn a_broken_down_instant_is_left_out_and_the_rest_is_drawn() {
        let calm = Snapshot {
            time: 0.0,
            boxes: vec![],
            arms: vec![vec![[0.0; 3], [1.0, 0.5, 0.2]]],
            tool: [1.0, 0.5, 0.2],
            reference: [1.0, 0.5, 0.2],
            guided: "tool".into(),
        };
        let wild = Snapshot { tool: [f64::NAN, f64::INFINITY, 1e300], ..calm.clone() };
        let svg = drawing(&[calm, wild.clone()]).unwrap().0;
        assert!(svg.contains("path of tool"), "the tool is named");
        assert!(!svg.contains("NaN") && !svg.contains("inf,"), "{svg}");
        assert!(drawing(&[wild]).is_none());
    }
}
