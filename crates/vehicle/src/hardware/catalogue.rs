//! The units that come with wrasse: wheels, CMGs, thrusters and sensors that a file can name as its
//! `model`.

use super::numbers::{
    CmgNumbers, Numbers, RateGyroNumbers, StarTrackerNumbers, ThrusterNumbers, WheelNumbers,
    check_figures,
};
use crate::provenance::Provenance;
use crate::table::{Reading, SourceFile, row, under};
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::sync::LazyLock;
use wrasse_document::{Document, Step, closest};

/// A file of the hardware catalogue.
#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct HardwareFile {
    /// Reaction wheels.
    #[serde(default)]
    wheel: Vec<Model<WheelNumbers>>,
    /// Control moment gyros.
    #[serde(default)]
    cmg: Vec<Model<CmgNumbers>>,
    /// Thrusters.
    #[serde(default)]
    thruster: Vec<Model<ThrusterNumbers>>,
    /// Rate gyros.
    #[serde(default)]
    rate_gyro: Vec<Model<RateGyroNumbers>>,
    /// Star trackers.
    #[serde(default)]
    star_tracker: Vec<Model<StarTrackerNumbers>>,
}

/// A unit of the catalogue.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Model<N> {
    /// What a file calls it.
    #[schemars(length(min = 1))]
    name: String,
    /// One line for lists.
    #[schemars(length(min = 1))]
    summary: String,
    /// What it can do.
    #[serde(flatten)]
    numbers: N,
    /// Where its numbers come from.
    source: SourceFile,
    /// Sources of single numbers, by their key, where they differ from `source`.
    #[serde(default)]
    source_of: BTreeMap<String, SourceFile>,
}

/// A unit of the hardware catalogue, for lists.
#[derive(Debug, Clone, PartialEq)]
pub struct HardwareEntry {
    /// What a file calls it.
    pub name: String,
    /// What it is: `reaction wheel`, `control moment gyro`, `thruster`, `rate gyro`, `star tracker`.
    pub kind: &'static str,
    /// One line for lists.
    pub summary: String,
    /// Its numbers, by their keys in a file, in the units that these say.
    pub numbers: Vec<(&'static str, f64)>,
    /// Where each number comes from: how sure it is, and its source.
    pub provenance: Vec<Provenance>,
}

const FILES: [(&str, &str); 4] = [
    ("vehicles/hardware/wheels.toml", include_str!("../../../../vehicles/hardware/wheels.toml")),
    ("vehicles/hardware/cmgs.toml", include_str!("../../../../vehicles/hardware/cmgs.toml")),
    (
        "vehicles/hardware/thrusters.toml",
        include_str!("../../../../vehicles/hardware/thrusters.toml"),
    ),
    ("vehicles/hardware/sensors.toml", include_str!("../../../../vehicles/hardware/sensors.toml")),
];

/// The whole texts of the hardware catalogue, file by file.
pub fn hardware_texts() -> impl Iterator<Item = &'static str> {
    FILES.into_iter().map(|(_, text)| text)
}

static MODELS: LazyLock<HardwareFile> = LazyLock::new(|| {
    let mut all = HardwareFile::default();
    for (path, text) in FILES {
        let document = Document::parse(path, text);
        // Part of the program: a test reads each of these files.
        let file = document.and_then(|d| d.read::<HardwareFile>()).unwrap_or_default();
        all.wheel.extend(file.wheel);
        all.cmg.extend(file.cmg);
        all.thruster.extend(file.thruster);
        all.rate_gyro.extend(file.rate_gyro);
        all.star_tracker.extend(file.star_tracker);
    }
    all
});

/// A kind of unit that the catalogue has.
pub(crate) trait Catalogued: Numbers + 'static {
    /// Its models.
    fn models() -> &'static [Model<Self>];
    /// Of a model's numbers, those that do not contradict a file's own.
    fn beside(self, _own: &Self) -> Self {
        self
    }
}

impl Catalogued for WheelNumbers {
    fn models() -> &'static [Model<Self>] {
        &MODELS.wheel
    }
    /// Momentum is inertia times speed.
    fn beside(mut self, own: &Self) -> Self {
        let (inertia, momentum) = (own.inertia_kgm2.is_some(), own.momentum_nms.is_some());
        if inertia || momentum {
            (self.inertia_kgm2, self.momentum_nms) = (None, None);
        }
        if inertia && momentum {
            self.speed_limit_rpm = None;
        }
        self
    }
}
impl Catalogued for CmgNumbers {
    fn models() -> &'static [Model<Self>] {
        &MODELS.cmg
    }
    /// Torque is momentum times gimbal rate.
    fn beside(mut self, own: &Self) -> Self {
        if own.gimbal_rate_limit_deg_s.is_some() || own.torque_limit_nm.is_some() {
            (self.gimbal_rate_limit_deg_s, self.torque_limit_nm) = (None, None);
        }
        self
    }
}
impl Catalogued for ThrusterNumbers {
    fn models() -> &'static [Model<Self>] {
        &MODELS.thruster
    }
}
impl Catalogued for RateGyroNumbers {
    fn models() -> &'static [Model<Self>] {
        &MODELS.rate_gyro
    }
}
impl Catalogued for StarTrackerNumbers {
    fn models() -> &'static [Model<Self>] {
        &MODELS.star_tracker
    }
}

/// All units of the hardware catalogue, kind by kind.
pub fn hardware() -> Vec<HardwareEntry> {
    let mut all = entries::<WheelNumbers>();
    all.extend(entries::<CmgNumbers>());
    all.extend(entries::<ThrusterNumbers>());
    all.extend(entries::<RateGyroNumbers>());
    all.extend(entries::<StarTrackerNumbers>());
    all
}

fn entries<N: Catalogued>() -> Vec<HardwareEntry> {
    let entry = |model: &Model<N>| HardwareEntry {
        name: model.name.clone(),
        kind: N::KIND,
        summary: model.summary.clone(),
        numbers: model.given(),
        provenance: model.provenance(),
    };
    N::models().iter().map(entry).collect()
}

impl<N: Numbers> Model<N> {
    fn given(&self) -> Vec<(&'static str, f64)> {
        self.numbers.figures().iter().filter_map(|f| Some((f.key, f.value?))).collect()
    }
    /// One row for the model and one for each number with a source of its own.
    fn provenance(&self) -> Vec<Provenance> {
        let of = format!("model.{}", self.name);
        let mut rows = vec![row(&of, &self.source)];
        rows.extend(self.source_of.iter().map(|(key, source)| row(&format!("{of}.{key}"), source)));
        rows
    }
}

/// The models that a file has named so far, and where their numbers come from.
#[derive(Debug, Default)]
pub(crate) struct ModelsUsed {
    pub(crate) rows: Vec<Provenance>,
}

impl ModelsUsed {
    /// The numbers of a unit that is called `of` in complaints: its own, and for the rest those of the
    /// model that it names. `None` if there is no such model.
    pub(crate) fn numbers<N: Catalogued>(
        &mut self,
        reading: &mut Reading<'_>,
        path: &[Step<'_>],
        of: &str,
        model: Option<&str>,
        own: N,
    ) -> Option<N> {
        check_figures(reading, path, of, &own.figures());
        let Some(name) = model else { return Some(own) };
        let Some(model) = N::models().iter().find(|model| model.name == name) else {
            let (message, help) = no_such_model::<N>(name);
            reading.error(&under(path, "model"), message, "no such model", &help);
            return None;
        };
        let rows = model.provenance();
        if !self.rows.iter().any(|row| row.of == rows[0].of) {
            self.rows.extend(rows);
        }
        Some(own.or(model.numbers.beside(&own)))
    }
}

/// What is wrong with a name that no model of this kind has, and how to mend it.
fn no_such_model<N: Catalogued>(name: &str) -> (String, String) {
    let message = format!("no {} of the hardware catalogue is called \"{name}\"", N::KIND);
    if let Some(other) = hardware().iter().find(|entry| entry.name == name) {
        return (message, format!("\"{name}\" is a {}", other.kind));
    }
    let names = || N::models().iter().map(|model| model.name.as_str());
    let renamed = name.replace("gyro", "cmg");
    if name != renamed && names().any(|known| known == renamed) {
        return (message, format!("\"{name}\" was renamed: write \"{renamed}\""));
    }
    if let Some(meant) = closest(name, names()) {
        return (message, format!("did you mean \"{meant}\"?"));
    }
    let alike: Vec<_> = names().filter(|known| known.starts_with(name)).collect();
    let told = if alike.is_empty() { names().collect() } else { alike };
    let help = format!("the catalogue has {}", told.join(", "));
    (message, help)
}
