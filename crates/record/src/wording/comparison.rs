//! Several cases side by side: what tells them apart, how they ended, what they measured.

use wrasse_mission::Outcome;
use wrasse_rehearsal::CaseOutcome;

use super::cases::{ending, quantity};

/// Metrics worth a column whenever a case has them, in this order.
const TELLING: [&str; 5] = [
    "tool.along_track_error.final",
    "tool.lateral_error.final",
    "tool.attitude_error.final",
    "base.rotation.final",
    "base.translation.final",
];

/// Most columns of figures, so that the table still fits a page.
const COLUMNS: usize = 8;

/// The table that compares the cases of one mission.
pub(crate) struct Comparison<'a> {
    /// Names of what is varied.
    pub(crate) axes: Vec<&'a str>,
    /// Metrics in the table.
    pub(crate) columns: Vec<Column<'a>>,
    /// One row for each case.
    pub(crate) rows: Vec<Row<'a>>,
}

/// A metric in the table.
pub(crate) struct Column<'a> {
    /// Its name.
    pub(crate) name: &'a str,
    /// Unit of the figures below it.
    pub(crate) unit: &'a str,
    /// What values are multiplied with to be in that unit.
    factor: f64,
}

/// A case in the table.
pub(crate) struct Row<'a> {
    /// Its place on each axis; empty where the axis does not concern it.
    pub(crate) labels: Vec<&'a str>,
    /// How it ended, in a few words.
    pub(crate) ending: String,
    /// All requirements hold and the ledger closes.
    pub(crate) passed: bool,
    /// One figure for each column.
    pub(crate) values: Vec<Option<f64>>,
}

/// Whether there is a case, and every case passed.
pub(crate) fn passed(outcome: &Outcome) -> bool {
    !outcome.cases.is_empty() && outcome.cases.iter().all(|case| case.passed)
}

/// The comparison of an outcome's cases.
pub(crate) fn comparison(outcome: &Outcome) -> Comparison<'_> {
    let mut axes: Vec<&str> = Vec::new();
    for (axis, _) in outcome.cases.iter().flat_map(|case| &case.labels) {
        if !axes.contains(&axis.as_str()) {
            axes.push(axis);
        }
    }
    let columns = columns(outcome);
    let rows = outcome.cases.iter().map(|case| row(case, &axes, &columns)).collect();
    Comparison { axes, columns, rows }
}

impl Comparison<'_> {
    /// The largest size in each column.
    pub(crate) fn largest(&self) -> Vec<f64> {
        let size = |row: &Row<'_>, k: usize| row.values[k].map_or(0.0, f64::abs);
        (0..self.columns.len())
            .map(|k| self.rows.iter().map(|row| size(row, k)).fold(0.0, f64::max))
            .collect()
    }
}

fn row<'a>(case: &'a CaseOutcome, axes: &[&str], columns: &[Column<'_>]) -> Row<'a> {
    let label = |axis: &&str| {
        case.labels.iter().find(|(name, _)| name == axis).map_or("", |(_, row)| row.as_str())
    };
    let value = |column: &Column<'_>| {
        let metric = case.metrics.iter().find(|metric| metric.name == column.name)?;
        Some(metric.value * column.factor)
    };
    Row {
        labels: axes.iter().map(label).collect(),
        ending: ending(&case.end),
        passed: case.passed,
        values: columns.iter().map(value).collect(),
    }
}

/// The telling metrics that some case has, then those that a requirement names; failing both,
/// the first few there are.
fn columns(outcome: &Outcome) -> Vec<Column<'_>> {
    let mut names: Vec<&str> = Vec::new();
    let metrics = || outcome.cases.iter().flat_map(|case| &case.metrics);
    let mut take = |name: &'_ str| {
        let known = metrics().find(|metric| metric.name == name);
        if let Some(metric) = known
            && !names.contains(&metric.name.as_str())
        {
            names.push(&metric.name);
        }
    };
    for name in TELLING {
        take(name);
    }
    for verdict in outcome.cases.iter().flat_map(|case| &case.verdicts) {
        take(quantity(&verdict.requirement, &verdict.comparison));
    }
    if names.is_empty() {
        names = outcome.cases.first().map_or(vec![], |case| {
            case.metrics.iter().take(4).map(|metric| metric.name.as_str()).collect()
        });
    }
    names.truncate(COLUMNS);
    names.into_iter().map(|name| column(outcome, name)).collect()
}

/// Metres are shown as millimetres and radians as degrees where that is the handier unit.
fn column<'a>(outcome: &'a Outcome, name: &'a str) -> Column<'a> {
    let same =
        || outcome.cases.iter().flat_map(|case| &case.metrics).filter(|metric| metric.name == name);
    let unit = same().next().map_or("", |metric| metric.unit.as_str());
    let small = same().all(|metric| metric.value.abs() < 1.0);
    let (unit, factor) = match unit {
        "m" if small => ("mm", 1e3),
        "rad" => ("deg", 180.0 / std::f64::consts::PI),
        unit => (unit, 1.0),
    };
    Column { name, unit, factor }
}
