//! Where the numbers of a TOML vehicle file come from, and which do not say.

use super::reading::{Reading, under};
use crate::provenance::{Grade, Provenance};
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::ops::Range;
use wrasse_document::{Step, closest};

/// Where numbers come from.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub(crate) enum SourceFile {
    /// They stand in this document: title, year, page or table.
    Published(#[schemars(length(min = 1))] String),
    /// They were computed from published numbers, in this way.
    Derived(#[schemars(length(min = 1))] String),
    /// They were chosen, for this reason.
    Assumed(#[schemars(length(min = 1))] String),
}

/// Where the numbers of a table come from.
#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
pub(crate) struct ProvenanceFile {
    /// Where these numbers come from.
    pub(crate) source: Option<SourceFile>,
    /// Sources of single numbers, by their key, where they differ from `source`.
    #[serde(default)]
    pub(crate) source_of: BTreeMap<String, SourceFile>,
}

/// Keys of a block that hold numbers about the vehicle.
#[rustfmt::skip]
const NUMBERS: [&str; 65] = [
    "mass_kg", "centre_of_mass_m", "inertia_kgm2", "uniform", "position_m", "orientation", "axis",
    "travel_deg", "travel_m", "rate_deg_s", "rate_m_s", "effort_nm", "effort_n", "mount", "row",
    "joints_deg", "joints_m", "torque_limit_nm", "momentum_limit_nms", "speed_limit_rpm",
    "speed_rpm", "momentum_nms", "coulomb_friction_nm", "viscous_friction_nms", "torque_step_nm",
    "power_w", "gimbal_axis", "spin_axis", "gimbal_angle_deg", "gimbal_angles_deg",
    "gimbal_rate_limit_deg_s", "gimbal_acceleration_limit_deg_s2", "gimbal_inertia_kgm2",
    "motor_torque_limit_nm", "servo_bandwidth_rad_s", "skew_deg", "count", "direction", "force_n",
    "specific_impulse_s", "minimum_on_time_s", "rise_time_s", "fall_time_s",
    "impulse_noise_percent", "edges_m", "propellant_kg", "bias_deg_h",
    "angle_random_walk_deg_sqrt_h", "bias_random_walk_deg_h_sqrt_h", "rate_step_deg_s", "boresight",
    "noise_across_arcsec", "noise_about_arcsec", "rate_hz", "latency_s", "rate_limit_deg_s",
    "encoder_step_deg", "cylinder", "sphere", "density_kg_m3", "damping_ratio", "acceleration_m_s2",
    "stiffness_nm_rad", "rotor_inertia_kgm2", "rotor_inertia_kg",
];

/// How many blocks without source a warning names.
const NAMED: usize = 6;

/// Rows for the report, and blocks that do not say where their numbers come from.
#[derive(Debug, Default)]
pub(crate) struct Sources {
    /// In the order of the file's kinds of blocks.
    pub(crate) rows: Vec<Provenance>,
    without: Vec<(String, Range<usize>)>,
    /// Whether the file has a source for all that have none.
    covered: bool,
}

impl Sources {
    /// With the source of the whole file, if it has one.
    pub(crate) fn new(whole: Option<&SourceFile>) -> Self {
        let mut sources = Self { covered: whole.is_some(), ..Self::default() };
        sources.rows.extend(whole.map(|source| row("all else", source)));
        sources
    }
    /// For the blocks of a table that may have a source for all of them, as `of` in reports; `covered`
    /// says that the file has one, or that it need not.
    pub(crate) fn within(of: &str, source: Option<&SourceFile>, covered: bool) -> Self {
        let mut sources = Self { covered: covered || source.is_some(), ..Self::default() };
        sources.rows.extend(source.map(|source| row(of, source)));
        sources
    }
    /// Whether the file has a source for all that have none.
    pub(crate) fn covered(&self) -> bool {
        self.covered
    }
    /// The blocks without source of a table of this file.
    pub(crate) fn take_without(&mut self, table: &mut Self) {
        self.without.append(&mut table.without);
    }
    /// A block that is called `of` in reports, its source, and those of its single numbers.
    pub(crate) fn block(
        &mut self,
        reading: &mut Reading<'_>,
        path: &[Step<'_>],
        of: &str,
        ProvenanceFile { source, source_of }: &ProvenanceFile,
    ) {
        let source = source.as_ref();
        self.rows.extend(source.map(|source| row(of, source)));
        let keys = reading.document.keys(path);
        let numbers: Vec<_> = keys.into_iter().filter(|key| NUMBERS.contains(key)).collect();
        for (key, source) in source_of {
            if numbers.contains(&key.as_str()) {
                self.rows.push(row(&format!("{of}.{key}"), source));
            } else {
                let message = format!("{of} has no number `{key}` that could have a source");
                let help = match closest(key, numbers.iter().copied()) {
                    Some(meant) => format!("did you mean `{meant}`?"),
                    None => format!("its numbers are {}", numbers.join(", ")),
                };
                let path = under(&under(path, "source_of"), key);
                reading.wrong_key(&path, message, "no such number", &help);
            }
        }
        let all_sourced = numbers.iter().all(|key| source_of.contains_key(*key));
        if source.is_none() && !self.covered && !all_sourced {
            self.without.push((of.to_owned(), reading.at(path)));
        }
    }
    /// One warning for all blocks without source.
    pub(crate) fn warn(&self, reading: &mut Reading<'_>) {
        let Some((_, first)) = self.without.first() else { return };
        let names: Vec<_> = self.without.iter().map(|(of, _)| of.as_str()).take(NAMED).collect();
        let more = match self.without.len().saturating_sub(NAMED) {
            0 => String::new(),
            more => format!(" and {more} more"),
        };
        let message =
            format!("nothing says where these numbers come from: {}{more}", names.join(", "));
        let help = "write source.published, source.derived or source.assumed = \"…\" in each \
                    block, or once at the top of the file";
        reading.found.warning(first, message, "the first of them", help);
    }
}

pub(crate) fn row(of: &str, source: &SourceFile) -> Provenance {
    let (grade, text) = match source {
        SourceFile::Published(text) => (Grade::Published, text),
        SourceFile::Derived(text) => (Grade::Derived, text),
        SourceFile::Assumed(text) => (Grade::Assumed, text),
    };
    Provenance { of: of.to_owned(), grade, source: text.clone() }
}
