//! Plots that need no script: lines, limits and points over linear or logarithmic axes.

use crate::drawing::{marks, step};
use crate::markup::escaped;
use crate::numbers::significant;

/// How a series is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Mark {
    /// A line.
    Line,
    /// A dashed line.
    Dashed,
    /// Single points.
    Points,
    /// Points joined by a line.
    Joined,
    /// Points joined by a dashed line.
    JoinedDashed,
}

/// What one name in the legend stands for; without a name it is not in the legend.
#[derive(Debug, Clone)]
pub(crate) struct Series {
    pub(crate) name: String,
    /// Which of the sixteen colours, from one.
    pub(crate) colour: usize,
    pub(crate) mark: Mark,
    pub(crate) points: Vec<[f64; 2]>,
}

/// An axis.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Axis<'a> {
    pub(crate) label: &'a str,
    pub(crate) logarithmic: bool,
}

/// Size of the drawn field (SVG units; about pixels).
const FIELD: [f64; 2] = [460.0, 240.0];
/// Room at the left and below, and at the other sides.
const MARGIN: [f64; 2] = [64.0, 14.0];

/// From the quantity to its place on an axis, as a share of the axis.
struct Scale {
    logarithmic: bool,
    low: f64,
    high: f64,
}

impl Mark {
    fn is_dashed(self) -> bool {
        matches!(self, Self::Dashed | Self::JoinedDashed)
    }
}

impl Scale {
    /// Wide enough for all values; none if there is nothing to show.
    fn of(axis: Axis<'_>, values: impl Iterator<Item = f64>) -> Option<Self> {
        let logarithmic = axis.logarithmic;
        let shown = values.filter(|v| v.is_finite() && (!logarithmic || *v > 0.0));
        let (low, high) = shown
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
        if low > high {
            return None;
        }
        let (low, high) = if logarithmic {
            (libm::floor(libm::log10(low)), libm::ceil(libm::log10(high)))
        } else {
            (low.min(0.0), high)
        };
        let pad = if logarithmic { 0.0 } else { 0.06 * (high - low) };
        let high = if high > low { high + pad } else { low + 1.0 };
        Some(Self { logarithmic, low, high })
    }
    fn share(&self, value: f64) -> Option<f64> {
        let at = if self.logarithmic {
            if value <= 0.0 {
                return None;
            }
            libm::log10(value)
        } else {
            value
        };
        at.is_finite().then(|| (at - self.low) / (self.high - self.low))
    }
    /// Values that get a grid line.
    fn marks(&self) -> Vec<f64> {
        if self.logarithmic {
            let every = libm::ceil((self.high - self.low) / 7.0);
            return marks(self.low, self.high, every).map(|x| libm::pow(10.0, x)).collect();
        }
        let step = step(1.4 * (self.high - self.low));
        marks(self.low, self.high, step).collect()
    }
}

/// A plot with its title and legend; nothing if no point can be shown.
pub(crate) fn plot(title: &str, x: Axis<'_>, y: Axis<'_>, series: &[Series]) -> Option<String> {
    let all = || series.iter().flat_map(|s| &s.points);
    let scales = [Scale::of(x, all().map(|p| p[0]))?, Scale::of(y, all().map(|p| p[1]))?];
    let [width, height] = FIELD.map(|size| size + MARGIN[0] + MARGIN[1]);
    let mut svg = format!(
        "<svg viewBox=\"0 0 {width} {height}\" role=\"img\" aria-label=\"{}\">\n",
        escaped(title)
    );
    svg += &grid(&scales, x, y);
    for one in series {
        svg += &drawn(one, &scales);
    }
    svg += "</svg>";
    let named = series.iter().filter(|s| !s.name.is_empty());
    let keys = named.map(|s| {
        let kind = if s.mark.is_dashed() { "dashed " } else { "" };
        format!("<span class=\"swatch asked {kind}line-{}\">{}</span> ", s.colour, escaped(&s.name))
    });
    Some(format!(
        "<figure class=\"plot\"><p class=\"view\">{}</p>\n{svg}\n<figcaption>{}</figcaption></figure>\n",
        escaped(title),
        keys.collect::<String>()
    ))
}

/// Where a share of both axes is on the sheet.
fn on_sheet(share: [f64; 2]) -> [f64; 2] {
    [MARGIN[0] + share[0] * FIELD[0], MARGIN[1] + (1.0 - share[1]) * FIELD[1]]
}

fn grid(scales: &[Scale; 2], x: Axis<'_>, y: Axis<'_>) -> String {
    let [left, bottom] = on_sheet([0.0, 0.0]);
    let [right, top] = on_sheet([1.0, 1.0]);
    let mut svg = format!(
        "<rect class=\"field\" x=\"{left}\" y=\"{top}\" width=\"{}\" height=\"{}\"/>\n",
        FIELD[0], FIELD[1]
    );
    for value in scales[0].marks() {
        let Some(share) = scales[0].share(value) else { continue };
        let at = on_sheet([share, 0.0])[0];
        svg += &format!(
            "<path class=\"grid\" d=\"M{at:.1} {top}V{bottom}\"/><text x=\"{at:.1}\" y=\"{}\" \
             text-anchor=\"middle\">{}</text>\n",
            bottom + 16.0,
            significant(value)
        );
    }
    for value in scales[1].marks() {
        let Some(share) = scales[1].share(value) else { continue };
        let at = on_sheet([0.0, share])[1];
        svg += &format!(
            "<path class=\"grid\" d=\"M{left} {at:.1}H{right}\"/><text x=\"{}\" y=\"{:.1}\" \
             text-anchor=\"end\">{}</text>\n",
            left - 6.0,
            at + 4.0,
            significant(value)
        );
    }
    svg + &format!(
        "<text class=\"axis\" x=\"{:.0}\" y=\"{}\" text-anchor=\"middle\">{}</text>\
         <text class=\"axis\" transform=\"translate(12 {:.0}) rotate(-90)\" \
         text-anchor=\"middle\">{}</text>\n",
        0.5 * (left + right),
        bottom + 36.0,
        escaped(x.label),
        0.5 * (top + bottom),
        escaped(y.label)
    )
}

fn drawn(series: &Series, scales: &[Scale; 2]) -> String {
    let places = series
        .points
        .iter()
        .filter_map(|[x, y]| Some(on_sheet([scales[0].share(*x)?, scales[1].share(*y)?])));
    let places: Vec<_> = places.collect();
    let line = series.colour;
    let mut svg = String::new();
    if series.mark != Mark::Points && places.len() > 1 {
        let text: Vec<_> = places.iter().map(|[x, y]| format!("{x:.1},{y:.1}")).collect();
        let dashed = if series.mark.is_dashed() { " dashed" } else { "" };
        svg += &format!(
            "<polyline class=\"trace line-{line}{dashed}\" points=\"{}\"/>\n",
            text.join(" ")
        );
    }
    if matches!(series.mark, Mark::Points | Mark::Joined | Mark::JoinedDashed) {
        for [x, y] in &places {
            svg += &format!(
                "<circle class=\"point line-{line}\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3.5\"><title>{}</title></circle>",
                escaped(&series.name)
            );
        }
        svg.push('\n');
    }
    svg
}

#[cfg(test)]
mod tests {
    use super::*;

    const LINEAR: Axis<'_> = Axis { label: "t (s)", logarithmic: false };
    const LOGARITHMIC: Axis<'_> = Axis { label: "torque (N·m)", logarithmic: true };

    fn series(points: &[[f64; 2]]) -> Series {
        Series { name: "a & b".into(), colour: 2, mark: Mark::Joined, points: points.to_vec() }
    }

    #[test]
    fn powers_of_ten_are_evenly_spaced_on_a_logarithmic_axis() {
        let scale = Scale::of(LOGARITHMIC, [0.5, 30.0, 0.0, f64::INFINITY].into_iter()).unwrap();
        assert_eq!((scale.low, scale.high), (-1.0, 2.0));
        assert_eq!(scale.share(1.0), Some(1.0 / 3.0));
        assert_eq!(scale.share(0.0), None);
        assert_eq!(scale.marks(), [0.1, 1.0, 10.0, 100.0]);
    }

    #[test]
    fn what_cannot_be_shown_is_left_out_and_names_are_safe() {
        let svg = plot(
            "x < y",
            LINEAR,
            LOGARITHMIC,
            &[series(&[[0.0, 1.0], [1.0, f64::NAN], [2.0, 0.0], [3.0, 5.0]])],
        )
        .unwrap();
        assert_eq!(svg.matches("<circle").count(), 2);
        assert!(svg.contains("a &amp; b") && svg.contains("x &lt; y") && !svg.contains("NaN"));
        assert!(plot("none", LINEAR, LOGARITHMIC, &[series(&[[1.0, 0.0]])]).is_none());
    }
}
