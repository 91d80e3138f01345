//! The motion as a picture: the vehicle at several instants, from above and from the side.

use wrasse_mission::Snapshot;

use crate::numbers::significant;

/// Most instants in one picture; more would hide each other.
const INSTANTS: usize = 5;
/// Most points of the tool's path.
const PATH_POINTS: usize = 500;
/// Width of the drawn field (SVG units; about pixels).
const WIDTH: f64 = 520.0;
/// Most height of a field.
const HEIGHT: f64 = 400.0;
/// Room for figures left of and below a field, and at its other sides.
const MARGIN: [f64; 2] = [52.0, 12.0];
/// Farther than this (m) a run has broken down, and nothing could be seen.
const FARTHEST: f64 = 1e6;

/// A point on a view (m).
type Point = [f64; 2];

/// One direction of looking.
struct View {
    title: &'static str,
    /// Which coordinates go to the right and up.
    axes: [usize; 2],
    /// Lower left and upper right corner of the field (m).
    low: Point,
    high: Point,
    /// SVG units for a metre.
    scale: f64,
}

/// Two views of the motion to one scale, as a figure; nothing if there is nothing to draw.
pub(crate) fn drawing(snapshots: &[Snapshot]) -> Option<String> {
    let drawn: Vec<&Snapshot> = snapshots.iter().filter(|s| drawable(s)).collect();
    let (first, last) = (drawn.first()?, drawn.last()?);
    let instants = evenly(&drawn, INSTANTS);
    let times: Vec<_> = instants.iter().map(|s| significant(s.time)).collect();
    let span = if times.len() > 1 {
        format!("at {} s, from light to dark", times.join(", "))
    } else {
        format!("at {} s", times.join(""))
    };
    let views = views(&drawn, &instants).map(|view| {
        format!(
            "<div><p class=\"view\">{}</p>\n{}</div>\n",
            view.title,
            svg(&view, &drawn, &instants, [first.time, last.time])
        )
    });
    Some(format!(
        "<figure class=\"motion\"><div class=\"views\">{}</div>\n<figcaption>The vehicle {span}. \
         <span class=\"key path\">path of the tool</span> \
         <span class=\"key wanted\">where it should be</span> Both views to one scale, in inertial \
         axes.</figcaption></figure>\n",
        views.concat()
    ))
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

/// Both views, wide enough for all that is drawn in them, to one scale.
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
    [("From above", 1), ("From the side", 2)].map(|(title, up)| View {
        title,
        axes: [0, up],
        low: [left, low[up]],
        high: [right, high[up]],
        scale,
    })
}

impl View {
    fn height(&self) -> f64 {
        self.scale * (self.high[1] - self.low[1])
    }
    /// Where a point in space is on the sheet.
    fn on_sheet(&self, point: [f64; 3]) -> Point {
        self.place(self.axes.map(|axis| point[axis]))
    }
    /// Where a point of the view is on the sheet, y downwards.
    fn place(&self, point: Point) -> Point {
        [
            MARGIN[0] + self.scale * (point[0] - self.low[0]),
            MARGIN[1] + self.scale * (self.high[1] - point[1]),
        ]
    }
}

fn svg(view: &View, drawn: &[&Snapshot], instants: &[&Snapshot], times: [f64; 2]) -> String {
    let (width, height) = (WIDTH + MARGIN[0] + MARGIN[1], view.height() + MARGIN[0] + MARGIN[1]);
    let mut svg = format!(
        "<svg viewBox=\"0 0 {width:.0} {height:.0}\" role=\"img\" aria-label=\"{} view of the motion\">\n",
        view.title
    );
    svg += &grid(view);
    for (k, snapshot) in instants.iter().enumerate() {
        // From a fifth to full strength.
        let strength = (k + 1) as f64 / instants.len() as f64;
        svg += &instant(view, snapshot, 0.1 + 0.9 * strength * strength);
    }
    let along = evenly(drawn, PATH_POINTS);
    let wanted: Vec<_> = along.iter().map(|s| view.on_sheet(s.reference)).collect();
    let gone: Vec<_> = along.iter().map(|s| view.on_sheet(s.tool)).collect();
    svg += &format!("<polyline class=\"wanted\" points=\"{}\"/>\n", sheet_points(&wanted));
    svg += &format!("<polyline class=\"gone\" points=\"{}\"/>\n", sheet_points(&gone));
    if let [first, .., last] = gone.as_slice() {
        // The times stand on the outer sides of the path.
        let apart = if first[0] < last[0] { [-1.0, 1.0] } else { [1.0, -1.0] };
        svg += &tool_mark(*first, times[0], apart[0]);
        svg += &tool_mark(*last, times[1], apart[1]);
    }
    svg + "</svg>"
}

/// A ring at the tool, with the time beside it: at its right for a `side` of 1, at its left for -1.
fn tool_mark([x, y]: Point, time: f64, side: f64) -> String {
    let anchor = if side > 0.0 { "start" } else { "end" };
    format!(
        "<circle class=\"tool\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"4\"/>\
         <text class=\"time\" x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"{anchor}\">{} s</text>\n",
        x + 8.0 * side,
        y + 4.0,
        significant(time)
    )
}

/// The vehicle at one instant: silhouettes and edges of its boxes, arms as lines, joints as dots.
fn instant(view: &View, snapshot: &Snapshot, strength: f64) -> String {
    let mut svg = format!("<g opacity=\"{strength:.2}\">\n");
    for solid in &snapshot.boxes {
        let corners = solid.corners.map(|corner| view.on_sheet(corner));
        svg += &format!("<polygon class=\"face\" points=\"{}\"/>", sheet_points(&hull(&corners)));
        svg += &format!("<path class=\"edge\" d=\"{}\"/>\n", edges(&corners));
    }
    for arm in &snapshot.arms {
        let joints: Vec<_> = arm.iter().map(|joint| view.on_sheet(*joint)).collect();
        svg += &format!("<polyline class=\"arm\" points=\"{}\"/>", sheet_points(&joints));
        for [x, y] in joints {
            svg += &format!("<circle class=\"joint\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"2.6\"/>");
        }
        svg.push('\n');
    }
    svg + "</g>\n"
}

/// The twelve edges of a box whose corners count in binary: each joins corners one bit apart.
fn edges(corners: &[Point; 8]) -> String {
    let mut path = String::new();
    for from in 0..8 {
        for bit in [1, 2, 4] {
            if from & bit == 0 {
                let ([x, y], [to_x, to_y]) = (corners[from], corners[from | bit]);
                path += &format!("M{x:.1} {y:.1}L{to_x:.1} {to_y:.1}");
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

/// Grid lines with their metres, and the names of the axes.
fn grid(view: &View) -> String {
    let (right, bottom) = (MARGIN[0] + WIDTH, MARGIN[1] + view.height());
    let (left, top) = (MARGIN[0], MARGIN[1]);
    let step = step(WIDTH / view.scale);
    let mut svg = format!(
        "<rect class=\"field\" x=\"{left}\" y=\"{top}\" width=\"{WIDTH}\" height=\"{:.1}\"/>\n",
        view.height()
    );
    for metres in marks(view.low[0], view.high[0], step) {
        let [x, _] = view.place([metres, view.low[1]]);
        svg += &format!(
            "<path class=\"grid\" d=\"M{x:.1} {top}V{bottom:.1}\"/>\
             <text class=\"figure\" x=\"{x:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>\n",
            bottom + 16.0,
            significant(metres)
        );
    }
    for metres in marks(view.low[1], view.high[1], step) {
        let [_, y] = view.place([view.low[0], metres]);
        svg += &format!(
            "<path class=\"grid\" d=\"M{left} {y:.1}H{right}\"/>\
             <text class=\"figure\" x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{}</text>\n",
            left - 6.0,
            y + 4.0,
            significant(metres)
        );
    }
    let [across, up] = view.axes.map(|axis| ["x", "y", "z"][axis]);
    let middle = 0.5 * (top + bottom);
    svg + &format!(
        "<text class=\"axis\" x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{across} (m)</text>\
         <text class=\"axis\" transform=\"translate(14 {middle:.1}) rotate(-90)\" \
         text-anchor=\"middle\">{up} (m)</text>\n",
        0.5 * (left + right),
        bottom + 36.0
    )
}

/// A step of 1, 2 or 5 times a power of ten (m) that divides `span` into at most nine parts.
pub(crate) fn step(span: f64) -> f64 {
    let mut step = 1e-3;
    for factor in [2.0, 2.5, 2.0].iter().cycle() {
        if span / step <= 9.0 {
            break;
        }
        step *= factor;
    }
    step
}

/// The multiples of `step` from `low` to `high`.
pub(crate) fn marks(low: f64, high: f64, step: f64) -> impl Iterator<Item = f64> {
    let first = (low / step).ceil();
    (0..64).map(move |k| (first + f64::from(k)) * step).take_while(move |metres| *metres <= high)
}

fn sheet_points(points: &[Point]) -> String {
    points.iter().map(|[x, y]| format!("{x:.1},{y:.1}")).collect::<Vec<_>>().join(" ")
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
    fn marks_of_the_axes_are_round_and_inside() {
        assert_eq!(step(3.7), 0.5);
        let metres: Vec<_> = marks(-0.7, 1.2, 0.5).collect();
        assert_eq!(metres, [-0.5, 0.0, 0.5, 1.0]);
    }

    #[test]
    fn a_broken_down_instant_is_left_out_and_the_rest_is_drawn() {
        let calm = Snapshot {
            time: 0.0,
            boxes: vec![],
            arms: vec![vec![[0.0; 3], [1.0, 0.5, 0.2]]],
            tool: [1.0, 0.5, 0.2],
            reference: [1.0, 0.5, 0.2],
        };
        let wild = Snapshot { tool: [f64::NAN, f64::INFINITY, 1e300], ..calm.clone() };
        let svg = drawing(&[calm, wild.clone()]).unwrap();
        assert!(!svg.contains("NaN") && !svg.contains("inf,"), "{svg}");
        assert!(drawing(&[wild]).is_none());
    }
}
