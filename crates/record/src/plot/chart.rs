//! Charts of a quantity over another: lines and points over linear or logarithmic axes.

use maud::{Markup, html};

use super::{Axis, Frame, Length, Line, Scale, corners};

/// How the points of a series are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Shape {
    /// A line through them.
    Line,
    /// Each alone.
    Points,
    /// Each, joined by a line.
    Joined,
}

/// What one name in the legend stands for; without a name it is not in the legend.
#[derive(Debug, Clone)]
pub(crate) struct Series<'a> {
    pub(crate) name: &'a str,
    pub(crate) line: Line,
    pub(crate) shape: Shape,
    pub(crate) points: Vec<[f64; 2]>,
}

/// What an axis of a chart shows.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Shown<'a> {
    /// A quantity, from zero on.
    Linear(&'a str),
    /// The powers of ten of a quantity.
    Logarithmic(&'a str),
}

/// Size of the field, and room above it (SVG units; about pixels).
const SIZE: [f64; 2] = [460.0, 240.0];
const ABOVE: f64 = 14.0;
/// Most ticks of an axis.
const TICKS: f64 = 6.5;

impl<'a> Shown<'a> {
    /// An axis wide enough for all values; none if there is nothing to show.
    fn axis(self, values: impl Iterator<Item = f64>) -> Option<Axis<'a>> {
        let (label, is_logarithmic) = match self {
            Self::Linear(label) => (label, false),
            Self::Logarithmic(label) => (label, true),
        };
        let shown = values.filter(|v| v.is_finite() && (!is_logarithmic || *v > 0.0));
        let ends = (f64::INFINITY, f64::NEG_INFINITY);
        let (low, high) = shown.fold(ends, |(low, high), v| (low.min(v), high.max(v)));
        if low > high {
            return None;
        }
        let (low, high) = if is_logarithmic {
            (libm::floor(libm::log10(low)), libm::ceil(libm::log10(high)))
        } else {
            (low.min(0.0), high + 0.06 * (high - low.min(0.0)))
        };
        let high = if high > low { high } else { low + 1.0 };
        let scale = Scale { is_logarithmic, low, high };
        let ticks = scale.ticks(if is_logarithmic { 7.0 } else { TICKS });
        Some(Axis { label, scale, ticks })
    }
}

/// A chart with its title and legend; nothing if no point can be shown.
pub(crate) fn chart(title: &str, [x, y]: [Shown<'_>; 2], series: &[Series<'_>]) -> Option<Markup> {
    let all = || series.iter().flat_map(|one| &one.points);
    let axes = [x.axis(all().map(|p| p[0]))?, y.axis(all().map(|p| p[1]))?];
    let frame = Frame { above: ABOVE, size: SIZE, axes };
    let drawn = html! { @for one in series { (drawn(one, &frame)) } };
    Some(html! {
        figure.plot {
            p.view { (title) }
            (frame.sheet("chart", title, &drawn))
            figcaption {
                @for one in series.iter().filter(|one| !one.name.is_empty()) {
                    (one.line.key(one.name))
                }
            }
        }
    })
}

fn drawn(series: &Series<'_>, frame: &Frame<'_>) -> Markup {
    let places: Vec<_> = series.points.iter().filter_map(|point| frame.place(*point)).collect();
    let colour = series.line.colour();
    html! {
        g class=(series.line.dash()) {
            @if series.shape != Shape::Points && places.len() > 1 {
                polyline class={ "trace " (colour) } points=(corners(&places)) {}
            }
            @if series.shape != Shape::Line {
                @for [x, y] in &places {
                    circle class={ "point " (colour) } cx=(Length(*x)) cy=(Length(*y)) r="3.5" {
                        title { (series.name) }
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const AXES: [Shown<'_>; 2] = [Shown::Linear("t (s)"), Shown::Logarithmic("torque (N·m)")];

    fn series(points: &[[f64; 2]]) -> Series<'_> {
        let points = points.to_vec();
        Series { name: "a & b", line: Line::FIRST, shape: Shape::Joined, points }
    }

    #[test]
    fn a_logarithmic_axis_reaches_from_power_to_power_and_leaves_out_what_it_cannot_show() {
        let values = [0.5, 30.0, 0.0, f64::INFINITY].into_iter();
        let axis = Shown::Logarithmic("torque (N·m)").axis(values).unwrap();
        assert_eq!((axis.scale.low, axis.scale.high), (-1.0, 2.0));
    }

    #[test]
    fn what_cannot_be_shown_is_left_out_and_names_are_safe() {
        let points = [[0.0, 1.0], [1.0, f64::NAN], [2.0, 0.0], [3.0, 5.0]];
        let svg = chart("x < y", AXES, &[series(&points)]).unwrap().0;
        assert_eq!(svg.matches("<circle").count(), 2);
        assert!(svg.contains("a &amp; b") && svg.contains("x &lt; y") && !svg.contains("NaN"));
        assert!(chart("none", AXES, &[series(&[[1.0, 0.0]])]).is_none());
    }
}
