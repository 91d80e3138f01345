//! `[[disperse]]`: what is not known exactly.

use crate::dispersible::{Dispersible, FORMS, Nominal};
use crate::reading::Reading;
use schemars::JsonSchema;
use serde::Deserialize;
use std::mem::discriminant;
use wrasse_document::{Step, at, closest};
use wrasse_rehearsal::{Dispersion, Distribution};

/// Something that is not known exactly: each sample of a sweep draws how far it is from what the files
/// say.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct DisperseFile {
    /// What it is, with its unit: `payload.module.mass_kg`, `initial.joints_deg.elbow`.
    pub(crate) quantity: String,
    /// Standard deviation of a normal deviation.
    #[serde(default)]
    pub(crate) sigma: Option<f64>,
    /// The farthest that a normal deviation goes: what is beyond is cut away.
    #[serde(default)]
    pub(crate) within: Option<f64>,
    /// Least and largest deviation, with all between them alike.
    #[serde(default)]
    pub(crate) between: Option<[f64; 2]>,
    /// Whether the flight computer knows what was drawn, of masses and sensors.
    #[serde(default)]
    pub(crate) known: bool,
}

/// Most and least of what can be said of a deviation.
const SIZES: (f64, f64) = (1e-300, 1e300);

/// Everything that is dispersed, in the order of the file.
pub(crate) fn dispersions(
    r: &mut Reading<'_>,
    files: &[DisperseFile],
    nominal: &Nominal<'_>,
) -> Vec<Dispersion> {
    let there = nominal.dispersible();
    let mut all: Vec<Dispersion> = vec![];
    for (i, file) in files.iter().enumerate() {
        let distribution = distribution(r, i, file);
        let found = find(r, i, &file.quantity, &there);
        let Some(distribution) = distribution else { continue };
        for one in found {
            check_room(r, i, file, one, distribution);
            if let Some(first) = all.iter().find(|d| d.target == one.target) {
                let message = format!("{} is dispersed already, as {}", one.name, first.name);
                let path = at!["disperse", i, "quantity"];
                r.error(path, message, "one distribution for each quantity");
            }
            if file.known && !one.target.can_be_known() {
                let message = format!("the flight computer senses {}", one.name);
                let help = "`known` is for mass properties and sensors: leave it out here";
                r.error(at!["disperse", i, "known"], message, help);
            }
            all.push(Dispersion {
                name: one.name.clone(),
                target: one.target,
                distribution,
                nominal: one.nominal,
                unit: one.unit,
                scale: one.scale,
                known: file.known,
            });
        }
    }
    all
}

/// What a name stands for: one number, or all of a kind.
fn find<'d>(
    r: &mut Reading<'_>,
    i: usize,
    name: &str,
    there: &'d [Dispersible],
) -> Vec<&'d Dispersible> {
    let group = format!("{name}.");
    let is_meant = |d: &&Dispersible| d.name == name || d.name.starts_with(&group);
    let found: Vec<_> = there.iter().filter(is_meant).collect();
    if let Some(first) = found.first() {
        let kind = discriminant(&first.target);
        if found.iter().all(|d| discriminant(&d.target) == kind) {
            return found;
        }
    }
    let groups = there.iter().filter_map(|d| d.name.rsplit_once('.').map(|(group, _)| group));
    let names = there.iter().map(|d| d.name.as_str()).chain(groups);
    let help = match closest(name, names) {
        Some(close) => format!("did you mean {close:?}?"),
        None => FORMS.into(),
    };
    let message = if found.is_empty() {
        format!("there is nothing called {name:?} that could be dispersed")
    } else {
        format!("{name:?} is more than one kind of thing")
    };
    r.error(at!["disperse", i, "quantity"], message, &help);
    vec![]
}

/// How it is distributed.
fn distribution(r: &mut Reading<'_>, i: usize, file: &DisperseFile) -> Option<Distribution> {
    let path = |key| [Step::Key("disperse"), Step::Index(i), Step::Key(key)];
    let before = r.complaints.len();
    let why = "a size in the unit of the quantity";
    let found = match (file.sigma, file.within, file.between) {
        (Some(sigma), None, None) => {
            Distribution::Normal(r.within(&path("sigma"), sigma, SIZES, why))
        }
        (Some(sigma), Some(within), None) => Distribution::Bounded(
            r.within(&path("sigma"), sigma, SIZES, why),
            r.within(&path("within"), within, SIZES, why),
        ),
        (None, None, Some([from, to])) => {
            // Neither holds for what is not a number.
            if !(from < to && (to - from).is_finite()) {
                let message = format!("between {from} and {to} there is nothing to draw");
                r.error(&path("between"), message, "the lesser one first, both finite");
            }
            Distribution::Uniform(from, to)
        }
        (sigma, ..) => {
            let found = if sigma.is_some() || file.within.is_some() && file.between.is_some() {
                "is said to be normal and uniform at once"
            } else {
                "has no distribution"
            };
            let message = format!("{} {found}", file.quantity);
            let help = "give sigma for a normal one, sigma and within for a bounded one, or between = \
                        [least, largest] for a uniform one; all as deviations from what the files say";
            r.error(at!["disperse", i], message, help);
            return None;
        }
    };
    (r.complaints.len() == before).then_some(found)
}

/// What can be drawn must be possible.
fn check_room(
    r: &mut Reading<'_>,
    i: usize,
    file: &DisperseFile,
    one: &Dispersible,
    distribution: Distribution,
) {
    let (low, high) = distribution.reach();
    if low >= one.room.0 && high <= one.room.1 {
        return;
    }
    let far = if low < one.room.0 { low } else { high };
    let message =
        format!("a deviation of {} can be drawn for {}: {}", rounded(far), one.name, one.why);
    let room = format!("from {} to {}", rounded(one.room.0), rounded(one.room.1));
    let (key, help) = match (file.between, file.within) {
        (Some(_), _) => ("between", format!("there is room {room}")),
        (None, Some(_)) => ("within", format!("there is room {room}")),
        (None, None) => ("sigma", format!("add `within` to cut it: there is room {room}")),
    };
    r.error(at!["disperse", i, key], message, &help);
}

/// Four figures.
fn rounded(x: f64) -> f64 {
    format!("{x:.3e}").parse().unwrap_or(x)
}
