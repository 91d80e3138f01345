//! How the values of a requirement are spread, as a drawing that needs no script.

use maud::{Markup, html};

use super::{Axis, Frame, Length, Scale};
use crate::wording::numbers::significant;

/// Size of the field, and room above it for the words on the limit (SVG units; about pixels).
const SIZE: [f64; 2] = [460.0, 180.0];
const ABOVE: f64 = 22.4;
/// Most ticks of the axis of values.
const TICKS: f64 = 6.5;

/// Most bars. Fewer where there are few values: their square root, about.
const BARS: usize = 40;

/// A limit this many spans of the values away from them is not drawn, but told.
const FAR: f64 = 1.5;

/// What is drawn.
#[derive(Debug)]
pub(crate) struct Histogram<'a> {
    /// Every value.
    pub(crate) values: Vec<f64>,
    /// The limit, and whether values above it fail.
    pub(crate) limit: f64,
    pub(crate) large_is_bad: bool,
    pub(crate) unit: &'a str,
}

/// The field's edges as values, the width of a bar, and the bars' counts from `first` on.
struct Bars {
    low: f64,
    high: f64,
    first: f64,
    width: f64,
    counts: Vec<usize>,
}

impl Histogram<'_> {
    /// The drawing; nothing of no values.
    pub(crate) fn svg(&self) -> Option<Markup> {
        let bars = self.bars()?;
        let most = bars.counts.iter().copied().max().unwrap_or(1).max(1) as f64;
        let values = Scale::linear(bars.low, bars.high);
        let ticks = values.ticks(TICKS);
        let across = Axis { label: self.unit, scale: values, ticks };
        let up = Axis { label: "", scale: Scale::linear(0.0, most), ticks: vec![0.0, most] };
        let frame = Frame { above: ABOVE, size: SIZE, axes: [across, up] };
        let limit = format!("limit {} {}", significant(self.limit), self.unit);
        let content = html! {
            @for (i, count) in bars.counts.iter().enumerate().filter(|(_, count)| **count > 0) {
                (self.bar(&bars, i, *count as f64, &frame).unwrap_or_default())
            }
            (frame.limit(self.limit, &limit))
        };
        Some(frame.sheet("histogram", "how the values are spread", &content))
    }

    fn bar(&self, bars: &Bars, i: usize, count: f64, frame: &Frame<'_>) -> Option<Markup> {
        let from = bars.first + i as f64 * bars.width;
        let [x, y] = frame.place([from, count])?;
        let [right, base] = frame.place([from + bars.width, 0.0])?;
        let middle = from + 0.5 * bars.width;
        let fails = (middle > self.limit) == self.large_is_bad && middle != self.limit;
        let class = if fails { "fails" } else { "holds" };
        let width = Length((right - x - 1.0).max(1.0));
        Some(html! {
            rect class=(class) x=(Length(x)) y=(Length(y)) width=(width)
                height=(Length(base - y)) {}
        })
    }

    fn bars(&self) -> Option<Bars> {
        let least = self.values.iter().copied().reduce(f64::min)?;
        let largest = self.values.iter().copied().reduce(f64::max)?;
        // Values that are all alike get some room beside them.
        let span = if largest > least { largest - least } else { least.abs().max(1e-12) * 0.1 };
        let mut first = if largest > least { least } else { least - 0.5 * span };
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a few")]
        let count = (libm::sqrt(2.0 * self.values.len() as f64) as usize).clamp(5, BARS);
        let width = span / count as f64;
        let mut count = count;
        if (least..largest).contains(&self.limit) {
            // No bar reaches over the limit.
            first = self.limit - libm::ceil((self.limit - least) / width) * width;
            count += 1;
        }
        let mut counts = vec![0; count];
        for value in &self.values {
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a place")]
            let place = ((value - first) / width) as usize;
            counts[place.min(count - 1)] += 1;
        }
        let (mut low, mut high) = (first, first + width * count as f64);
        if self.is_near(first, span) {
            (low, high) = (low.min(self.limit), high.max(self.limit));
        }
        let pad = 0.04 * (high - low);
        Some(Bars { low: low - pad, high: high + pad, first, width, counts })
    }

    fn is_near(&self, first: f64, span: f64) -> bool {
        self.limit > first - FAR * span && self.limit < first + (1.0 + FAR) * span
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn histogram(values: &[f64], limit: f64) -> Histogram<'_> {
        Histogram { values: values.to_vec(), limit, large_is_bad: true, unit: "mm" }
    }

    #[test]
    fn every_value_is_in_a_bar_and_what_fails_is_beyond_the_limit() {
        let values: Vec<f64> = (0..200).map(|k| 0.001 * f64::from(k)).collect();
        let drawn = histogram(&values, 0.15);
        let bars = drawn.bars().expect("there are values");
        assert_eq!(bars.counts.iter().sum::<usize>(), 200);
        let svg = drawn.svg().expect("there are values").0;
        let (holds, fails) =
            (svg.matches("class=\"holds\"").count(), svg.matches("class=\"fails\"").count());
        let filled = bars.counts.iter().filter(|count| **count > 0).count();
        assert_eq!(holds + fails, filled);
        // 151 hold, 49 fail, and a bar is 0.2 / 20 wide: the limit is where one ends.
        let place = (0.15 - bars.first) / bars.width;
        assert!((place - place.round()).abs() < 1e-9, "{place}");
        assert_eq!(fails, 5, "a quarter of 20 bars: {svg}");
        assert!(svg.contains("limit 0.15 mm<"));
    }

    #[test]
    fn a_limit_far_away_is_told_and_does_not_squeeze_the_values() {
        let svg = histogram(&[1.0, 2.0, 3.0], 1000.0).svg().expect("there are values").0;
        assert!(svg.contains("limit 1000 mm \u{2192}") && !svg.contains("class=\"fails\""));
    }

    #[test]
    fn values_that_are_all_alike_can_be_drawn_and_none_cannot() {
        for value in [0.0, 7.0, -1e-9] {
            let svg = histogram(&[value; 4], 10.0).svg().expect("there are values").0;
            assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
        }
        assert!(histogram(&[], 1.0).svg().is_none());
    }
}
