//! The table `[actuators]` to the equipment of a base.

use crate::equipment::Equipment;
use crate::equipment_format::EquipmentFile;
use crate::format::SourceFile;
use crate::hardware_catalogue::ModelsUsed;
use crate::mounted_unit::Mounted;
use crate::provenance::Sources;
use crate::spanning::check_spanning;
use crate::toml_cmg::{cmg, cmg_array};
use crate::toml_reading::{Reading, under};
use crate::toml_thruster::{tank, thruster, thruster_set};
use crate::toml_wheel::wheel;
use std::ops::Range;
use wrasse_document::{Complaint, Document, Step};
use wrasse_hardware::{
    Actuators, CMGS, ControlMomentGyro, List, ReactionWheel, THRUSTERS, Thruster, WHEELS,
};

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

/// All units of a table that could be read.
#[derive(Default)]
struct Units {
    /// Whether one could not.
    broken: bool,
    wheels: Vec<Mounted<ReactionWheel<f64>>>,
    cmgs: Vec<Mounted<ControlMomentGyro<f64>>>,
    thrusters: Vec<Mounted<Thruster<f64>>>,
}

/// The equipment of a table; its blocks without source are left with `sources`.
pub(crate) fn equipment(
    reading: &mut Reading<'_>,
    sources: &mut Sources,
    path: &[Step<'_>],
    file: &EquipmentFile,
) -> Equipment {
    let mut models = ModelsUsed::default();
    let units = units(reading, &mut models, path, file);
    check_counts(reading, &units);
    check_names(reading, path, file, &units);
    let tank = file.tank.as_ref().map(|given| tank(reading, &under(path, "tank"), given));
    blocks(reading, sources, path, file);
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
        mass: units.sum(|unit| unit.0),
        power: units.sum(|unit| unit.1),
        provenance,
    }
}

/// The units of each kind, in the order of the file, single ones before sets.
fn units(
    reading: &mut Reading<'_>,
    models: &mut ModelsUsed,
    path: &[Step<'_>],
    file: &EquipmentFile,
) -> Units {
    let mut all = Units::default();
    for (i, given) in file.wheel.iter().enumerate() {
        let unit = wheel(reading, models, &item(path, "wheel", i), given);
        all.broken |= unit.is_none();
        all.wheels.extend(unit);
    }
    for (i, given) in file.cmg.iter().enumerate() {
        let unit = cmg(reading, models, &item(path, "cmg", i), given);
        all.broken |= unit.is_none();
        all.cmgs.extend(unit);
    }
    for (i, given) in file.cmg_array.iter().enumerate() {
        let array = cmg_array(reading, models, &item(path, "cmg_array", i), given);
        all.broken |= array.is_none();
        all.cmgs.extend(array.into_iter().flatten());
    }
    for (i, given) in file.thruster.iter().enumerate() {
        let unit = thruster(reading, models, &item(path, "thruster", i), given);
        all.broken |= unit.is_none();
        all.thrusters.extend(unit);
    }
    for (i, given) in file.thruster_set.iter().enumerate() {
        let set = thruster_set(reading, models, &item(path, "thruster_set", i), given);
        all.broken |= set.is_none();
        all.thrusters.extend(set.into_iter().flatten());
    }
    all
}

/// The path of an item of a list.
fn item<'p>(path: &[Step<'p>], key: &'p str, i: usize) -> Vec<Step<'p>> {
    [path, &[Step::Key(key), Step::Index(i)]].concat()
}

fn bare<U: Copy>(units: &[Mounted<U>]) -> Vec<U> {
    units.iter().map(|mounted| mounted.unit).collect()
}

fn names<U>(units: &[Mounted<U>], most: usize) -> Vec<String> {
    units.iter().take(most).map(|mounted| mounted.name.clone()).collect()
}

fn starts<U, const N: usize>(units: &[Mounted<U>]) -> [f64; N] {
    let mut starts = [0.0; N];
    starts.iter_mut().zip(units).for_each(|(start, mounted)| *start = mounted.start);
    starts
}

/// What tables and checks want to know of any unit.
type MassAndPower = (Option<f64>, Option<f64>);

impl Units {
    fn each<'u, R>(
        &'u self,
        of_wheel: impl Fn(&'u Mounted<ReactionWheel<f64>>) -> R,
        of_cmg: impl Fn(&'u Mounted<ControlMomentGyro<f64>>) -> R,
        of_thruster: impl Fn(&'u Mounted<Thruster<f64>>) -> R,
    ) -> Vec<R> {
        let mut all: Vec<R> = self.wheels.iter().map(of_wheel).collect();
        all.extend(self.cmgs.iter().map(of_cmg));
        all.extend(self.thrusters.iter().map(of_thruster));
        all
    }
    /// Where the first wheel or CMG stands.
    fn first_that_turns(&self) -> Option<Range<usize>> {
        let cmg = || self.cmgs.first().map(|unit| unit.at.clone());
        self.wheels.first().map(|unit| unit.at.clone()).or_else(cmg)
    }
    /// A number of all units together; `None` if there are none or one does not say it.
    fn sum(&self, of: impl Fn(MassAndPower) -> Option<f64>) -> Option<f64> {
        let each = self.each(|u| (u.mass, u.power), |u| (u.mass, u.power), |u| (u.mass, u.power));
        let numbers: Option<Vec<f64>> = each.into_iter().map(of).collect();
        numbers.filter(|numbers| !numbers.is_empty()).map(|numbers| numbers.iter().sum())
    }
    /// How many of what: `4 x airbus-cmg-75-75s, 12 x moog-monarc-22-6`.
    fn name(&self) -> String {
        let mut counts: Vec<(&str, usize)> = vec![];
        for label in self.each(|u| u.label.as_str(), |u| u.label.as_str(), |u| u.label.as_str()) {
            match counts.iter_mut().find(|(known, _)| *known == label) {
                Some((_, count)) => *count += 1,
                None => counts.push((label, 1)),
            }
        }
        let told: Vec<_> = counts.iter().map(|(label, n)| format!("{n} x {label}")).collect();
        if told.is_empty() { "none".into() } else { told.join(", ") }
    }
}

/// Complains of units that there is no room for.
fn check_counts(reading: &mut Reading<'_>, units: &Units) {
    let counts = [
        ("wheels", units.wheels.len(), units.wheels.get(WHEELS).map(|u| &u.at), WHEELS),
        ("cmgs", units.cmgs.len(), units.cmgs.get(CMGS).map(|u| &u.at), CMGS),
        (
            "thrusters",
            units.thrusters.len(),
            units.thrusters.get(THRUSTERS).map(|u| &u.at),
            THRUSTERS,
        ),
    ];
    for (what, count, first_too_many, most) in counts {
        if let Some(at) = first_too_many {
            let message = format!("{count} {what}: a vehicle has at most {most}");
            reading.found.error(at, message, "too many", "leave some out, or take stronger ones");
        }
    }
}

/// Complains of units of one name: commands and failures name them.
fn check_names(reading: &mut Reading<'_>, path: &[Step<'_>], file: &EquipmentFile, units: &Units) {
    let mut named = vec![];
    macro_rules! names_of {
        ($list:ident) => {
            for (i, unit) in file.$list.iter().enumerate() {
                let place = reading.below(&item(path, stringify!($list), i), "name");
                named.push((unit.name.clone(), place));
            }
        };
    }
    names_of!(wheel);
    names_of!(cmg);
    names_of!(cmg_array);
    names_of!(thruster);
    names_of!(thruster_set);
    // Names that arrays and sets give, and not again those of single units.
    let given = units.each(|u| (&u.name, &u.at), |u| (&u.name, &u.at), |u| (&u.name, &u.at));
    let given = given.into_iter().map(|(name, at)| (name.clone(), at.clone()));
    let fresh: Vec<_> = given.filter(|unit| !named.contains(unit)).collect();
    named.extend(fresh);
    // Two arrays of one name are one mistake.
    let mut told: Vec<&Range<usize>> = vec![];
    for (i, (name, at)) in named.iter().enumerate() {
        let known = named[..i].iter().find(|(known, place)| known == name && place != at);
        let Some((_, other)) = known.filter(|_| !told.contains(&at)) else { continue };
        told.push(at);
        let line = reading.found.line(other.start);
        let message = format!("two units are called '{name}'; the other is on line {line}");
        reading.found.error(at, message, "the second", "give one of them another name");
    }
}

/// Where the numbers of each block come from.
fn blocks(
    reading: &mut Reading<'_>,
    sources: &mut Sources,
    path: &[Step<'_>],
    file: &EquipmentFile,
) {
    let mut block = |path: &[Step<'_>], of: String, source: Option<&SourceFile>, source_of| {
        sources.block(reading, path, &format!("actuators.{of}"), source, source_of);
    };
    macro_rules! blocks_of {
        ($list:ident) => {
            for (i, unit) in file.$list.iter().enumerate() {
                let kind = stringify!($list);
                let of = format!("{kind}.{}", unit.name);
                block(&item(path, kind, i), of, unit.source.as_ref(), &unit.source_of);
            }
        };
    }
    blocks_of!(wheel);
    blocks_of!(cmg);
    blocks_of!(cmg_array);
    blocks_of!(thruster);
    blocks_of!(thruster_set);
    if let Some(tank) = &file.tank {
        block(&under(path, "tank"), "tank".into(), tank.source.as_ref(), &tank.source_of);
    }
}
