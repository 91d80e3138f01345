//! The table `[actuators]`: the equipment of a base.

use super::catalogue::ModelsUsed;
use super::cmg::CmgFile;
use super::cmg_array::CmgArrayFile;
use super::slosh::slosh;
use super::tank::{TankFile, tank};
use super::thruster::ThrusterFile;
use super::thruster_set::ThrusterSetFile;
use super::unit::{Head, MountedUnit, UnitEntry, UnitFile};
use super::wheel::WheelFile;
use super::wheel_array::WheelArrayFile;
use crate::check::check_spanning;
use crate::equipment::Equipment;
use crate::table::{Reading, SourceFile, Sources, under};
use schemars::JsonSchema;
use serde::Deserialize;
use std::ops::Range;
use wrasse_document::{Complaint, Document, Step, at};
use wrasse_hardware::{
    Actuators, CMGS, ControlMomentGyro, List, ReactionWheel, THRUSTERS, Thruster, WHEELS,
};

/// Wheels, CMGs and thrusters of the base, and the tank of the thrusters.
///
/// Units are matter of the base: its mass and inertia include theirs. Propellant comes on top.
/// Positions and directions are in the base's frame.
#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct EquipmentFile {
    /// What the set is called in tables; made from its units if not given.
    #[schemars(length(min = 1))]
    pub(crate) name: Option<String>,
    /// Reaction wheels, one by one.
    #[serde(default)]
    pub(crate) wheel: Vec<WheelFile>,
    /// Arrays of equal reaction wheels; they come after those of `wheel`.
    #[serde(default)]
    pub(crate) wheel_array: Vec<WheelArrayFile>,
    /// Control moment gyros, one by one.
    #[serde(default)]
    #[schemars(extend("x-formerly" = ["gyro"]))]
    pub(crate) cmg: Vec<CmgFile>,
    /// Arrays of equal control moment gyros; they come after those of `cmg`.
    #[serde(default)]
    #[schemars(extend("x-formerly" = ["gyro_array"]))]
    pub(crate) cmg_array: Vec<CmgArrayFile>,
    /// Thrusters, one by one.
    #[serde(default)]
    pub(crate) thruster: Vec<ThrusterFile>,
    /// Sets of equal thrusters; they come after those of `thruster`.
    #[serde(default)]
    pub(crate) thruster_set: Vec<ThrusterSetFile>,
    /// The tank of all thrusters; without one they never run dry and nothing grows lighter.
    pub(crate) tank: Option<TankFile>,
    /// Where the numbers of all units come from that have no source of their own.
    pub(crate) source: Option<SourceFile>,
}

/// The equipment of a table `[actuators]` that stands at `path` in a document, and all complaints about
/// it. Whether it suits a vehicle is for [`crate::check_equipment`] to say.
pub fn read_equipment(
    document: &Document,
    path: &[Step<'_>],
    file: &EquipmentFile,
) -> (Equipment, Vec<Complaint>) {
    let mut reading = Reading::new(document);
    let mut sources = Sources::within("actuators", file.source.as_ref(), true);
    let equipment = equipment(&mut reading, &mut sources, path, file);
    (equipment, reading.found.into_complaints())
}

/// The equipment of a table; its blocks without source are left with `sources`.
pub(crate) fn equipment(
    reading: &mut Reading<'_>,
    sources: &mut Sources,
    path: &[Step<'_>],
    file: &EquipmentFile,
) -> Equipment {
    let mut models = ModelsUsed::default();
    let units = Units::of(reading, sources, &mut models, path, file);
    units.check_counts(reading);
    units.check_names(reading);
    let tank = file.tank.as_ref().map(|given| {
        let path = under(path, "tank");
        sources.block(reading, &path, "actuators.tank", &given.provenance);
        tank(reading, &path, given)
    });
    let slosh = file.tank.as_ref().zip(tank).and_then(|(given, tank)| {
        let (given, path) = (given.slosh.as_ref()?, [path, at!["tank", "slosh"]].concat());
        sources.block(reading, &path, "actuators.tank.slosh", &given.provenance);
        slosh(reading, &path, given, &tank)
    });
    let mut provenance = std::mem::take(&mut sources.rows);
    provenance.append(&mut models.rows);
    let Units { wheels, cmgs, thrusters, .. } = &units;
    let actuators = Actuators {
        wheels: List::new(&bare(wheels)),
        cmgs: List::new(&bare(cmgs)),
        thrusters: List::new(&bare(thrusters)),
        tank,
    };
    let gimbal_angle = starts(cmgs);
    if let Some(at) = units.first_that_turns().filter(|_| !units.broken) {
        check_spanning(reading, &actuators, &gimbal_angle, &at);
    }
    Equipment {
        name: file.name.clone().unwrap_or_else(|| units.name()),
        actuators,
        wheel_names: names(wheels, WHEELS),
        cmg_names: names(cmgs, CMGS),
        thruster_names: names(thrusters, THRUSTERS),
        wheel_speed: starts(wheels),
        gimbal_angle,
        slosh,
        mass: units.sum(|entry| entry.mass),
        power: units.sum(|entry| entry.power),
        provenance,
    }
}

fn bare<U: Copy>(units: &[MountedUnit<U>]) -> Vec<U> {
    units.iter().map(|mounted| mounted.unit).collect()
}

fn names<U>(units: &[MountedUnit<U>], most: usize) -> Vec<String> {
    units.iter().take(most).map(|mounted| mounted.entry.name.clone()).collect()
}

fn starts<U, const N: usize>(units: &[MountedUnit<U>]) -> [f64; N] {
    let mut starts = [0.0; N];
    starts.iter_mut().zip(units).for_each(|(start, mounted)| *start = mounted.start);
    starts
}

fn entries<U>(units: &[MountedUnit<U>]) -> impl Iterator<Item = &UnitEntry> {
    units.iter().map(|mounted| &mounted.entry)
}

/// All units of a table that could be read.
#[derive(Default)]
struct Units {
    /// Whether one could not.
    broken: bool,
    /// Names that stand in the file, and where.
    named: Vec<(String, Range<usize>)>,
    wheels: Vec<MountedUnit<ReactionWheel<f64>>>,
    cmgs: Vec<MountedUnit<ControlMomentGyro<f64>>>,
    thrusters: Vec<MountedUnit<Thruster<f64>>>,
}

impl Units {
    /// The units of each kind, in the order of the file, single ones before sets.
    fn of(
        reading: &mut Reading<'_>,
        sources: &mut Sources,
        models: &mut ModelsUsed,
        path: &[Step<'_>],
        file: &EquipmentFile,
    ) -> Self {
        let mut all = Self::default();
        let mut context = (reading, sources, models, path);
        all.wheels = all.read(&mut context, &file.wheel);
        let wheels = all.read(&mut context, &file.wheel_array);
        all.wheels.extend(wheels);
        all.cmgs = all.read(&mut context, &file.cmg);
        let cmgs = all.read(&mut context, &file.cmg_array);
        all.cmgs.extend(cmgs);
        all.thrusters = all.read(&mut context, &file.thruster);
        let of_sets = all.read(&mut context, &file.thruster_set);
        all.thrusters.extend(of_sets);
        all
    }
    /// The units of all tables of one kind.
    fn read<F: UnitFile>(
        &mut self,
        (reading, sources, models, path): &mut Context<'_, '_>,
        files: &[F],
    ) -> Vec<MountedUnit<F::Unit>> {
        let mut units = vec![];
        for (i, file) in files.iter().enumerate() {
            let path = [*path, &[Step::Key(F::KEY), Step::Index(i)]].concat();
            let read = file.read(reading, models, &path);
            self.broken |= read.is_none();
            units.extend(read.into_iter().flatten());
            let Head { name, provenance, .. } = file.head();
            self.named.push((name.to_owned(), reading.below(&path, "name")));
            sources.block(reading, &path, &format!("actuators.{}.{name}", F::KEY), provenance);
        }
        units
    }
    fn entries(&self) -> impl Iterator<Item = &UnitEntry> {
        entries(&self.wheels).chain(entries(&self.cmgs)).chain(entries(&self.thrusters))
    }
    /// Where the first wheel or CMG stands.
    fn first_that_turns(&self) -> Option<Range<usize>> {
        entries(&self.wheels).chain(entries(&self.cmgs)).next().map(|entry| entry.at.clone())
    }
    /// A number of all units together; `None` if there are none or one does not say it.
    fn sum(&self, of: impl Fn(&UnitEntry) -> Option<f64>) -> Option<f64> {
        let numbers: Option<Vec<f64>> = self.entries().map(of).collect();
        numbers.filter(|numbers| !numbers.is_empty()).map(|numbers| numbers.iter().sum())
    }
    /// How many of what: `4 x airbus-cmg-75-75s, 12 x moog-monarc-22-6`.
    fn name(&self) -> String {
        let mut counts: Vec<(&str, usize)> = vec![];
        for UnitEntry { label, .. } in self.entries() {
            match counts.iter_mut().find(|(known, _)| known == label) {
                Some((_, count)) => *count += 1,
                None => counts.push((label, 1)),
            }
        }
        let told: Vec<_> = counts.iter().map(|(label, n)| format!("{n} x {label}")).collect();
        if told.is_empty() { "none".into() } else { told.join(", ") }
    }
    /// Complains of units that there is no room for.
    fn check_counts(&self, reading: &mut Reading<'_>) {
        let kinds: [(_, Vec<_>, _); 3] = [
            ("wheels", entries(&self.wheels).collect(), WHEELS),
            ("cmgs", entries(&self.cmgs).collect(), CMGS),
            ("thrusters", entries(&self.thrusters).collect(), THRUSTERS),
        ];
        for (what, units, most) in kinds {
            if let Some(first_too_many) = units.get(most) {
                let message = format!("{} {what}: a vehicle has at most {most}", units.len());
                let help = "leave some out, or take stronger ones";
                reading.found.error(&first_too_many.at, message, "too many", help);
            }
        }
    }
    /// Complains of units of one name: commands and failures name them.
    fn check_names(&self, reading: &mut Reading<'_>) {
        // Names that arrays and sets give, and not again those of single units.
        let given = self.entries().map(|entry| (entry.name.clone(), entry.at.clone()));
        let fresh = given.filter(|unit| !self.named.contains(unit));
        let named: Vec<_> = self.named.iter().cloned().chain(fresh).collect();
        // Two arrays of one name are one mistake.
        let mut told: Vec<&Range<usize>> = vec![];
        for (i, (name, at)) in named.iter().enumerate() {
            let known = named[..i].iter().find(|(known, place)| known == name && place != at);
            let Some((_, other)) = known.filter(|_| !told.contains(&at)) else { continue };
            told.push(at);
            let line = reading.found.line(other.start, at);
            let message = format!("two units are called '{name}'; the other is on {line}");
            reading.found.error(at, message, "the second", "give one of them another name");
        }
    }
}

/// What a table is read with: the reading, sources and models so far, and where the table stands.
type Context<'a, 'd> = (&'a mut Reading<'d>, &'a mut Sources, &'a mut ModelsUsed, &'a [Step<'a>]);
