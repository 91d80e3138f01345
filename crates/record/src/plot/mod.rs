//! Static figures, as SVG that needs no script: scales, ticks, the frame with its axes and limits,
//! and how lines are told apart. Each kind of figure has a file.

use std::fmt::Write;

use maud::{Markup, Render, html};

use crate::wording::numbers::significant;

pub(crate) mod chart;
pub(crate) mod envelope;
pub(crate) mod histogram;
pub(crate) mod motion;
pub(crate) mod study;

/// Room at the left of a field, below it and at its right (SVG units; about pixels).
const LEFT: f64 = 64.0;
const BELOW: f64 = 44.0;
const RIGHT: f64 = 14.0;

/// A length on the sheet to a tenth of a unit.
struct Length(f64);

impl Render for Length {
    fn render_to(&self, text: &mut String) {
        // A string takes all that is written to it.
        let _ = write!(text, "{:.1}", self.0);
    }
}

/// Points as a polyline and a polygon take them.
fn corners(points: &[[f64; 2]]) -> String {
    let mut text = String::new();
    for [x, y] in points {
        let _ = write!(text, "{x:.1},{y:.1} ");
    }
    text.truncate(text.trim_end().len());
    text
}

/// From a quantity to its place on an axis, as a share of the axis.
struct Scale {
    is_logarithmic: bool,
    /// The ends: of a logarithmic scale, their powers of ten.
    low: f64,
    high: f64,
}

impl Scale {
    fn linear(low: f64, high: f64) -> Self {
        Self { is_logarithmic: false, low, high }
    }
    fn share(&self, value: f64) -> Option<f64> {
        let at = match self.is_logarithmic {
            true if value <= 0.0 => return None,
            true => libm::log10(value),
            false => value,
        };
        at.is_finite().then(|| (at - self.low) / (self.high - self.low))
    }
    /// Round values on the axis, at most `most` apart from the first.
    fn ticks(&self, most: f64) -> Vec<f64> {
        if self.is_logarithmic {
            let every = libm::ceil((self.high - self.low) / most);
            let powers = multiples(self.low, self.high, every);
            return powers.into_iter().map(|x| libm::pow(10.0, x)).collect();
        }
        multiples(self.low, self.high, step(self.high - self.low, most))
    }
}

/// A step of 1, 2 or 5 times a power of ten that divides `span` into at most `most` parts.
fn step(span: f64, most: f64) -> f64 {
    let ten = libm::pow(10.0, libm::floor(libm::log10(span / most)));
    let steps = [1.0, 2.0, 5.0].map(|factor| factor * ten);
    // What is a hair above `most` is `most` and round-off.
    steps.into_iter().find(|step| span / step <= most * (1.0 + 1e-9)).unwrap_or(10.0 * ten)
}

/// The multiples of `step` from `low` to `high`.
fn multiples(low: f64, high: f64, step: f64) -> Vec<f64> {
    let first = libm::ceil(low / step);
    (0..64)
        .map(|k| (first + f64::from(k)) * step)
        .take_while(|value| *value <= high)
        // Without the last digits that a product of decimals leaves.
        .map(|value| format!("{value:.6e}").parse().unwrap_or(value))
        .collect()
}

/// An axis of a field.
struct Axis<'a> {
    label: &'a str,
    scale: Scale,
    ticks: Vec<f64>,
}

/// The field in which values are drawn, and its axes.
struct Frame<'a> {
    /// Room above the field (SVG units).
    above: f64,
    /// Width and height of the field (SVG units).
    size: [f64; 2],
    axes: [Axis<'a>; 2],
}

impl Frame<'_> {
    /// Where a point is on the sheet, y downwards; none for what the axes cannot show.
    fn place(&self, point: [f64; 2]) -> Option<[f64; 2]> {
        let [x, y] = &self.axes;
        let (x, y) = (x.scale.share(point[0])?, y.scale.share(point[1])?);
        Some([LEFT + x * self.size[0], self.above + (1.0 - y) * self.size[1]])
    }
    /// Left, right, upper and lower edge of the field.
    fn edges(&self) -> [f64; 4] {
        let [width, height] = self.size;
        [LEFT, LEFT + width, self.above, self.above + height]
    }
    /// The sheet: the field with its grid, and `content` on it.
    fn sheet(&self, class: &str, label: &str, content: &Markup) -> Markup {
        let [_, right, _, bottom] = self.edges();
        let size = format!("0 0 {:.0} {:.0}", right + RIGHT, bottom + BELOW);
        html! {
            svg class=(class) viewBox=(size) role="img" aria-label=(label) {
                (self.grid()) (content)
            }
        }
    }
    /// Grid lines with their figures, and the names of the axes.
    fn grid(&self) -> Markup {
        let [left, right, top, bottom] = self.edges();
        let [x, y] = &self.axes;
        let [width, height] = self.size;
        let along = x.ticks.iter().filter_map(|t| Some((t, LEFT + x.scale.share(*t)? * width)));
        let up = y.ticks.iter().filter_map(|t| Some((t, bottom - y.scale.share(*t)? * height)));
        let upright = format!("translate(12 {:.0}) rotate(-90)", 0.5 * (top + bottom));
        html! {
            rect.field x=(Length(left)) y=(Length(top))
                width=(Length(width)) height=(Length(height)) {}
            @for (value, at) in along {
                path.grid d={ "M" (Length(at)) " " (Length(top)) "V" (Length(bottom)) } {}
                text x=(Length(at)) y=(Length(bottom + 16.0)) text-anchor="middle" {
                    (significant(*value))
                }
            }
            @for (value, at) in up {
                path.grid d={ "M" (Length(left)) " " (Length(at)) "H" (Length(right)) } {}
                text x=(Length(left - 6.0)) y=(Length(at + 4.0)) text-anchor="end" {
                    (significant(*value))
                }
            }
            text.axis x=(Length(0.5 * (left + right))) y=(Length(bottom + 36.0))
                text-anchor="middle" { (x.label) }
            @if !y.label.is_empty() {
                text.axis transform=(upright) text-anchor="middle" { (y.label) }
            }
        }
    }
    /// A limit on the quantity along the field: a line with its words, or where the line would be.
    fn limit(&self, value: f64, words: &str) -> Markup {
        let [left, right, top, bottom] = self.edges();
        let share = self.axes[0].scale.share(value).unwrap_or(f64::NAN);
        let text = |x: f64, anchor: &str, words: &str| {
            html! {
                text.limit x=(Length(x)) y=(Length(top - 6.0)) text-anchor=(anchor) { (words) }
            }
        };
        if share > 1.0 {
            return text(right, "end", &format!("{words} \u{2192}"));
        }
        if share < 0.0 {
            return text(left, "start", &format!("\u{2190} {words}"));
        }
        let x = left + share * (right - left);
        let (beside, anchor) = if share > 0.5 { (x - 5.0, "end") } else { (x + 5.0, "start") };
        html! {
            path.limit d={ "M" (Length(x)) " " (Length(top - 16.0)) "V" (Length(bottom)) } {}
            (text(beside, anchor, words))
        }
    }
}

/// How a line is told from others: by colour and by dash, so that either will do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Line {
    colour: usize,
    dash: usize,
}

impl Line {
    /// Colours beside the first; dashes beside the line without one. They have no common factor.
    const COLOURS: usize = 15;
    const DASHES: usize = 7;
    /// The line that others are held against.
    const FIRST: Self = Self { colour: 1, dash: 0 };

    /// The k-th of the others: the same in every figure.
    fn nth(k: usize) -> Self {
        Self { colour: 2 + k % Self::COLOURS, dash: 1 + k % Self::DASHES }
    }
    /// Its colour, as a class of the style.
    fn colour(self) -> String {
        format!("line-{}", self.colour)
    }
    /// Its dash, as a class of the style.
    fn dash(self) -> String {
        format!("dash-{}", self.dash)
    }
    /// Its name, behind a piece of it.
    fn key(self, name: &str) -> Markup {
        html! { span class={ "swatch asked " (self.colour()) " " (self.dash()) } { (name) } " " }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_inside() {
        assert_eq!(step(3.7, 9.0), 0.5);
        assert_eq!(Scale::linear(-0.7, 1.2).ticks(4.0), [-0.5, 0.0, 0.5, 1.0]);
        assert_eq!(Scale::linear(0.013, 0.021).ticks(6.0), [0.014, 0.016, 0.018, 0.02]);
        assert_eq!(Scale::linear(-1e-6, 9e-6).ticks(6.0), [0.0, 2e-6, 4e-6, 6e-6, 8e-6]);
    }

    #[test]
    fn powers_of_ten_are_evenly_spaced_on_a_logarithmic_axis() {
        let scale = Scale { is_logarithmic: true, low: -1.0, high: 2.0 };
        assert_eq!(scale.share(1.0), Some(1.0 / 3.0));
        assert_eq!(scale.share(0.0), None);
        assert_eq!(scale.ticks(7.0), [0.1, 1.0, 10.0, 100.0]);
    }

    #[test]
    fn a_hundred_lines_differ_in_colour_or_dash_and_the_style_has_them_all() {
        let lines: Vec<_> = (0..Line::COLOURS * Line::DASHES).map(Line::nth).collect();
        let css = include_str!("../../assets/plot.css");
        for (k, line) in lines.iter().enumerate() {
            assert!(*line != Line::FIRST && !lines[..k].contains(line), "{line:?}");
            for class in [line.colour(), line.dash()] {
                assert!(css.contains(&format!(".{class} {{")), "{class} is not in the style");
            }
        }
    }
}
