//! The tables `[[actuators.thruster_set]]`: thrusters on a box, where each pushes and which way, in the
//! frame in the middle of the box.

use super::catalogue::ModelsUsed;
use super::numbers::ThrusterNumbers;
use super::thruster::{Push, mounted, nozzle};
use super::unit::{Head, MountedUnit, UnitEntry, UnitFile};
use crate::figures::figures;
use crate::table::{OrientationFile, ProvenanceFile, Reading, under};
use schemars::JsonSchema;
use serde::Deserialize;
use wrasse_document::Step;
use wrasse_hardware::Thruster;
use wrasse_spatial::{Vec3, vec3};

/// A set of equal thrusters that gives force and torque both ways about every axis. They are called
/// NAME-1, NAME-2, ….
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ThrusterSetFile {
    /// What it is called.
    #[schemars(length(min = 1))]
    pub(crate) name: String,
    /// A thruster of the hardware catalogue.
    #[schemars(length(min = 1))]
    pub(crate) model: Option<String>,
    /// How the thrusters are mounted.
    pub(crate) arrangement: ThrusterArrangementFile,
    /// Number of thrusters: 12 (two in each face, side by side, pushing inward), 16 (four in the middle
    /// of each of the faces +y, +z, -y, -z: along x, -x and both ways along the face), or 24 (three in
    /// each corner, pushing inward along x, y and z).
    #[schemars(range(min = 12, max = 24))]
    pub(crate) count: usize,
    /// Edges of the box along its x, y, z (m).
    pub(crate) edges_m: [f64; 3],
    /// Middle of the box, in the base's frame (m).
    pub(crate) position_m: [f64; 3],
    /// How the box is turned from the base's axes; not at all if not given.
    pub(crate) orientation: Option<OrientationFile>,
    /// What each thruster can do.
    #[serde(flatten)]
    pub(crate) numbers: ThrusterNumbers,
    /// Where these numbers come from.
    #[serde(flatten)]
    pub(crate) provenance: ProvenanceFile,
}

/// A way of mounting several thrusters.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum ThrusterArrangementFile {
    /// On a box.
    Box,
}

impl UnitFile for ThrusterSetFile {
    const KEY: &'static str = "thruster_set";
    type Unit = Thruster<f64>;
    fn head(&self) -> Head<'_> {
        let model = self.model.as_deref();
        Head { name: &self.name, model, provenance: &self.provenance }
    }
    fn read(
        &self,
        reading: &mut Reading<'_>,
        models: &mut ModelsUsed,
        path: &[Step<'_>],
    ) -> Option<Vec<MountedUnit<Self::Unit>>> {
        let of = format!("thruster set '{}'", self.name);
        let X_BA = reading.pose(path, self.position_m, self.orientation.as_ref());
        let pushes = pushes(reading, path, &of, self);
        let numbers = models.numbers(reading, path, &of, self.model.as_deref(), self.numbers)?;
        let nozzle = nozzle(reading, path, &of, &numbers)?;
        let mass_power = (numbers.mass_kg, numbers.power_w);
        let entry = UnitEntry::of(reading, path, self, "thruster", mass_power);
        let in_base = |(position, direction)| {
            (X_BA.rotation * position + X_BA.translation, X_BA.rotation * direction)
        };
        let units = pushes?.into_iter().enumerate().map(|(k, push)| MountedUnit {
            unit: mounted(nozzle, in_base(push)),
            start: 0.0,
            entry: entry.numbered(k),
        });
        Some(units.collect())
    }
}

/// Where the thrusters of a set push, in its frame.
fn pushes(
    reading: &mut Reading<'_>,
    path: &[Step<'_>],
    of: &str,
    file: &ThrusterSetFile,
) -> Option<Vec<Push>> {
    let ThrusterArrangementFile::Box = file.arrangement;
    let flat = file.edges_m.iter().any(|edge| *edge <= 0.0);
    if flat {
        let [x, y, z] = file.edges_m.map(figures);
        let message = format!("edges of the box of {of} must be positive, found [{x}, {y}, {z}]");
        reading.error(&under(path, "edges_m"), message, "these edges", "edges are in metres");
    }
    let half = Vec3::from_array(file.edges_m) * 0.5;
    match file.count {
        12 => Some(twelve(half)),
        16 => Some(sixteen(half)),
        24 => Some(twenty_four(half)),
        found => {
            let message = format!("{of} has {found} thrusters: on a box there are 12, 16 or 24");
            let help = "other thrusters are given one by one in [[actuators.thruster]]";
            reading.error(&under(path, "count"), message, "this number", help);
            None
        }
    }
    .filter(|_| !flat)
}

const SIGNS: [f64; 2] = [1.0, -1.0];

/// Two thrusters in each face, pushing inward. They sit half of an edge from the middle of the face to
/// either side: in the faces of x along y, in those of y along z, in those of z along x. So a pair in
/// opposite faces makes a couple about z, x, y.
fn twelve(half: Vec3<f64>) -> Vec<Push> {
    let half = half.to_array();
    let mut pushes = vec![];
    for axis in 0..3 {
        let along = (axis + 1) % 3;
        for face in SIGNS {
            for side in SIGNS {
                let (mut position, mut direction) = ([0.0; 3], [0.0; 3]);
                position[axis] = face * half[axis];
                position[along] = side * half[along];
                direction[axis] = -face;
                pushes.push((Vec3::from_array(position), Vec3::from_array(direction)));
            }
        }
    }
    pushes
}

/// Four thrusters in the middle of each of the faces +y, +z, -y, -z: along x, along -x, and both ways
/// along the face across x.
fn sixteen(half: Vec3<f64>) -> Vec<Push> {
    let (y, z) = (vec3(0.0, 1.0, 0.0), vec3(0.0, 0.0, 1.0));
    let faces = [(y * half.y, z), (z * half.z, y), (y * -half.y, z), (z * -half.z, y)];
    let x = vec3(1.0, 0.0, 0.0);
    let four = |(position, along): (Vec3<f64>, Vec3<f64>)| {
        [x, -x, along, -along].map(|direction| (position, direction))
    };
    faces.into_iter().flat_map(four).collect()
}

/// Three thrusters in each corner, pushing inward along x, y and z.
fn twenty_four(half: Vec3<f64>) -> Vec<Push> {
    let mut pushes = vec![];
    for x in SIGNS {
        for y in SIGNS {
            for z in SIGNS {
                let corner = vec3(x * half.x, y * half.y, z * half.z);
                let inward = [vec3(-x, 0.0, 0.0), vec3(0.0, -y, 0.0), vec3(0.0, 0.0, -z)];
                pushes.extend(inward.map(|direction| (corner, direction)));
            }
        }
    }
    pushes
}
