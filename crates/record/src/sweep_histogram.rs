//! How the values of a requirement are spread, as a drawing that needs no script.

use crate::markup::escaped;
use crate::numbers::significant;

/// Size of the drawn field (SVG units; about pixels), and room around it.
const FIELD: [f64; 2] = [460.0, 180.0];
const MARGIN: [f64; 2] = [52.0, 14.0];

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
    pub(crate) fn svg(&self) -> Option<String> {
        let bars = self.bars()?;
        let (width, height) = (FIELD[0] + MARGIN[0] + MARGIN[1], top() + FIELD[1] + 44.0);
        let mut svg = format!(
            "<svg class=\"histogram\" viewBox=\"0 0 {width:.0} {height:.0}\" role=\"img\" \
             aria-label=\"how the values are spread\">\n"
        );
        svg += &self.axes(&bars);
        let most = bars.counts.iter().copied().max().unwrap_or(1).max(1) as f64;
        for (i, &count) in bars.counts.iter().enumerate().filter(|(_, count)| **count > 0) {
            let from = bars.first + i as f64 * bars.width;
            let (x, right) = (bars.place(from), bars.place(from + bars.width));
            let tall = FIELD[1] * count as f64 / most;
            let middle = from + 0.5 * bars.width;
            let fails = (middle > self.limit) == self.large_is_bad && middle != self.limit;
            svg += &format!(
                "<rect class=\"{}\" x=\"{x:.1}\" y=\"{:.1}\" width=\"{:.1}\" height=\"{tall:.1}\"/>\n",
                if fails { "fails" } else { "holds" },
                top() + FIELD[1] - tall,
                (right - x - 1.0).max(1.0)
            );
        }
        svg += &self.limit_line(&bars);
        Some(svg + "</svg>")
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

    /// The limit, or where it would be.
    fn limit_line(&self, bars: &Bars) -> String {
        let limit = significant(self.limit);
        let (unit, base) = (escaped(self.unit), top() + FIELD[1]);
        if (bars.low..=bars.high).contains(&self.limit) {
            let x = bars.place(self.limit);
            let anchor = if x > MARGIN[0] + 0.5 * FIELD[0] { "end" } else { "start" };
            let beside = if anchor == "end" { x - 5.0 } else { x + 5.0 };
            return format!(
                "<path class=\"limit\" d=\"M{x:.1} {:.1}V{base:.1}\"/><text class=\"limit\" x=\"{beside:.1}\" \
                 y=\"{:.1}\" text-anchor=\"{anchor}\">limit {limit} {unit}</text>\n",
                top() - 16.0,
                top() - 6.0
            );
        }
        let (x, anchor, words) = if self.limit > bars.high {
            (MARGIN[0] + FIELD[0], "end", format!("limit {limit} {unit} \u{2192}"))
        } else {
            (MARGIN[0], "start", format!("\u{2190} limit {limit} {unit}"))
        };
        format!(
            "<text class=\"limit\" x=\"{x:.1}\" y=\"{:.1}\" text-anchor=\"{anchor}\">{words}</text>\n",
            top() - 6.0
        )
    }

    fn axes(&self, bars: &Bars) -> String {
        let base = top() + FIELD[1];
        let mut svg = format!(
            "<rect class=\"field\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>\n",
            MARGIN[0],
            top(),
            FIELD[0],
            FIELD[1]
        );
        for mark in marks(bars.low, bars.high) {
            let x = bars.place(mark);
            svg += &format!(
                "<path class=\"grid\" d=\"M{x:.1} {:.1}V{base:.1}\"/><text x=\"{x:.1}\" y=\"{:.1}\" \
                 text-anchor=\"middle\">{}</text>\n",
                top(),
                base + 16.0,
                significant(mark)
            );
        }
        let most = bars.counts.iter().copied().max().unwrap_or(0);
        svg += &format!(
            "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{most}</text>\
             <text x=\"{:.1}\" y=\"{base:.1}\" text-anchor=\"end\">0</text>\n",
            MARGIN[0] - 6.0,
            top() + 10.0,
            MARGIN[0] - 6.0
        );
        svg + &format!(
            "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>\n",
            MARGIN[0] + 0.5 * FIELD[0],
            base + 36.0,
            escaped(self.unit)
        )
    }
}

/// Where the field begins, below the words on the limit.
fn top() -> f64 {
    1.6 * MARGIN[1]
}

impl Bars {
    /// Where a value is on the sheet.
    fn place(&self, value: f64) -> f64 {
        MARGIN[0] + FIELD[0] * (value - self.low) / (self.high - self.low)
    }
}

/// Round values from `low` to `high`, four to nine of them.
fn marks(low: f64, high: f64) -> Vec<f64> {
    let ten = libm::pow(10.0, libm::floor(libm::log10((high - low) / 4.0)));
    let steps = [1.0, 2.0, 5.0].map(|factor| factor * ten);
    let step = steps.into_iter().rev().find(|step| (high - low) / step >= 4.0).unwrap_or(ten);
    let first = libm::ceil(low / step);
    (0..12)
        .map(|k| (first + f64::from(k)) * step)
        .take_while(|mark| *mark <= high)
        // Without the last digits that a product of decimals leaves.
        .map(|mark| format!("{mark:.6e}").parse().unwrap_or(mark))
        .collect()
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
        let svg = drawn.svg().expect("there are values");
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
        let svg = histogram(&[1.0, 2.0, 3.0], 1000.0).svg().expect("there are values");
        assert!(svg.contains("limit 1000 mm \u{2192}") && !svg.contains("class=\"fails\""));
    }

    #[test]
    fn values_that_are_all_alike_can_be_drawn_and_none_cannot() {
        for value in [0.0, 7.0, -1e-9] {
            let svg = histogram(&[value; 4], 10.0).svg().expect("there are values");
            assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
        }
        assert!(histogram(&[], 1.0).svg().is_none());
    }

    #[test]
    fn marks_are_round_and_inside() {
        assert_eq!(marks(0.013, 0.021), [0.014, 0.016, 0.018, 0.02]);
        assert_eq!(marks(-1e-6, 9e-6), [0.0, 2e-6, 4e-6, 6e-6, 8e-6]);
    }
}
