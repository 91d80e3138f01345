//! The sets that a mission without its own is weighed against: what it has, as fitted, and beside that
//! the sets of `studies/sets.toml`, or the units of the hardware catalogue.

use toml::{Table, Value};
use wrasse_document::{Document, at};
use wrasse_dynamics::BodyId;
use wrasse_hardware::Tank;
use wrasse_mission::Mission;
use wrasse_vehicle::{Grade, HardwareEntry, ShapeKind, Vehicle, hardware};

/// The sets that come with the program, the reference first.
const SHIPPED: &str = include_str!("../../../studies/sets.toml");

/// The compared axis that the sets become.
const AXIS: &str = "actuators";

/// What the vehicle's own units are called among the sets.
pub(crate) const AS_FITTED: &str = "as fitted";

/// A kind of unit of the hardware catalogue, each of whose models is weighed in a standard arrangement.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Catalogue {
    /// Four reaction wheels, leaning towards four corners of a cube.
    Wheels,
    /// Four control moment gyros in a pyramid whose envelope is nearly a ball.
    Cmgs,
    /// 24 thrusters at the corners of the bus, along its edges.
    Thrusters,
}

/// A row of the axis of sets: its name, and what it lays over the mission.
#[derive(Debug, Clone)]
pub(crate) struct SetRow {
    pub(crate) name: String,
    set: Table,
}

impl SetRow {
    pub(crate) fn value(&self) -> Value {
        let mut row = Table::new();
        row.insert("name".into(), Value::String(self.name.clone()));
        row.insert("set".into(), Value::Table(self.set.clone()));
        Value::Table(row)
    }
}

/// The reference, and the sets that come with the program.
pub(crate) fn shipped() -> (SetRow, Vec<SetRow>) {
    // Part of the program: a test reads it.
    let file: Table = SHIPPED.parse().unwrap_or_default();
    let axes = file.get("compare").and_then(Value::as_array).into_iter().flatten();
    let rows = axes.filter_map(|axis| axis.get("row")?.as_array()).flatten();
    let mut rows = rows.filter_map(|row| {
        let name = row.get("name")?.as_str()?.to_owned();
        Some(SetRow { name, set: row.get("set")?.as_table()?.clone() })
    });
    let none = || SetRow { name: "ideal".into(), set: Table::new() };
    (rows.next().unwrap_or_else(none), rows.collect())
}

/// A mission with these sets laid over it, the reference first.
pub(crate) fn with_sets(mission: &Document, rows: &[&SetRow]) -> Document {
    let reference = rows.first().map_or("", |row| row.name.as_str());
    let mut axis = Table::new();
    axis.insert("axis".into(), AXIS.into());
    axis.insert("row".into(), Value::Array(rows.iter().map(|row| row.value()).collect()));
    let axes = mission.len(at!["compare"]);
    mission
        .with(at!["study", "sets"], &AXIS.into())
        .with(at!["study", "reference"], &reference.into())
        .with(at!["compare", axes], &Value::Table(axis))
}

/// The vehicle's own units: those that the mission or the vehicle has, without any the ideal actuator
/// of the vehicle within its limits, without that nothing. `own`: what the mission asks of them alone.
pub(crate) fn as_fitted(mission: &Mission, case: usize, own: &Table) -> SetRow {
    let units = !mission.cases[case].equipment.actuators.is_empty();
    let (base, turned_by) = match (units, mission.cases[case].vehicle.attitude_actuator) {
        (true, _) => ("controlled", Some("fitted")),
        (false, Some(_)) => ("controlled", Some("ideal")),
        (false, None) => ("free", None),
    };
    let mut set = Table::new();
    put(&mut set, &["world", "base_attitude"], base.into());
    put(&mut set, &["control", "arm_law"], "attitude-held".into());
    if let Some(turned_by) = turned_by {
        put(&mut set, &["control", "actuators"], turned_by.into());
    }
    lay_over(&mut set, own);
    SetRow { name: AS_FITTED.into(), set }
}

/// One set for each unit of a kind.
pub(crate) fn of_catalogue(kind: Catalogue, vehicle: &Vehicle) -> Vec<SetRow> {
    let of_kind = match kind {
        Catalogue::Wheels => "reaction wheel",
        Catalogue::Cmgs => "control moment gyro",
        Catalogue::Thrusters => "thruster",
    };
    let units = hardware().into_iter().filter(|unit| unit.kind == of_kind);
    units.map(|unit| arranged(kind, &unit, vehicle)).collect()
}

/// A unit in the standard arrangement of its kind.
fn arranged(kind: Catalogue, unit: &HardwareEntry, vehicle: &Vehicle) -> SetRow {
    let count = if kind == Catalogue::Thrusters { 24 } else { 4 };
    let assumed = unit.provenance.first().is_some_and(|row| row.grade == Grade::Assumed);
    let mark = if assumed { " (assumed)" } else { "" };
    let name = format!("{count} x {}{mark}", unit.name);
    let mut set = Table::new();
    put(&mut set, &["failure"], Value::Array(vec![]));
    put(&mut set, &["world", "base_attitude"], "controlled".into());
    put(&mut set, &["control", "arm_law"], "attitude-held".into());
    put(&mut set, &["control", "actuators"], "fitted".into());
    put(&mut set, &["actuators", "name"], name.as_str().into());
    for list in ["wheel", "cmg", "cmg_array", "thruster", "thruster_set"] {
        put(&mut set, &["actuators", list], Value::Array(vec![]));
    }
    let (list, units) = match kind {
        Catalogue::Wheels => ("wheel", wheels(&unit.name)),
        Catalogue::Cmgs => ("cmg_array", vec![pyramid(&unit.name)]),
        Catalogue::Thrusters => {
            // Couples made of single pulses push a little.
            put(&mut set, &["control", "position_hold", "bandwidth_rad_s"], 0.3.into());
            ("thruster_set", vec![corners(&unit.name, vehicle)])
        }
    };
    put(&mut set, &["actuators", list], Value::Array(units));
    SetRow { name, set }
}

/// Any three of the four suffice.
fn wheels(model: &str) -> Vec<Value> {
    let axes = [[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]];
    let wheel = |(i, axis): (usize, [i64; 3])| {
        let name = format!("wheel{}", i + 1);
        let axis = Value::Array(axis.into_iter().map(Value::Integer).collect());
        unit(&name, model, &[("axis", axis)])
    };
    axes.into_iter().enumerate().map(wheel).collect()
}

fn pyramid(model: &str) -> Value {
    unit("cmg", model, &[("arrangement", "pyramid".into()), ("skew_deg", 54.7356.into())])
}

fn corners(model: &str, vehicle: &Vehicle) -> Value {
    let (edges, centre) = bus(vehicle);
    let vector = |v: [f64; 3]| Value::Array(v.into_iter().map(Value::Float).collect());
    let more = [
        ("arrangement", "box".into()),
        ("count", 24.into()),
        ("edges_m", vector(edges)),
        ("position_m", vector(centre)),
    ];
    unit("jet", model, &more)
}

fn unit(name: &str, model: &str, more: &[(&str, Value)]) -> Value {
    let mut unit = Table::new();
    unit.insert("name".into(), name.into());
    unit.insert("model".into(), model.into());
    unit.extend(more.iter().map(|(key, value)| ((*key).to_owned(), value.clone())));
    Value::Table(unit)
}

/// Edges where no box is drawn of a base (m): those of a bus of 1.5 t.
const USUAL_BUS: [f64; 3] = [1.8, 1.6, 1.6];

/// Edges and centre of the bus (m, base axes): the largest box that is drawn of the base, or else a
/// usual one about its centre of mass.
fn bus(vehicle: &Vehicle) -> ([f64; 3], [f64; 3]) {
    let boxes = vehicle.shapes.iter().filter_map(|shape| match shape.kind {
        ShapeKind::Box(edges) if shape.frame.body == BodyId::Base => {
            // As far along the base's axes as its corners are.
            let R = shape.frame.X_BF.rotation;
            let along = [0, 1, 2].map(|row| {
                let edges = edges.to_array();
                (0..3).map(|k| (R.rows[row].to_array()[k] * edges[k]).abs()).sum::<f64>()
            });
            Some((along, shape.frame.X_BF.translation.to_array()))
        }
        _ => None,
    });
    let volume = |(edges, _): &([f64; 3], [f64; 3])| edges.iter().product::<f64>();
    let centre = vehicle.robot.inertia(BodyId::Base).centre_of_mass().to_array();
    boxes.max_by(|a, b| volume(a).total_cmp(&volume(b))).unwrap_or((USUAL_BUS, centre))
}

/// Sets fed from the vehicle's own tank: it weighs the same whatever turns it.
pub(crate) fn fed(mut rows: Vec<SetRow>, tank: Option<Tank<f64>>) -> Vec<SetRow> {
    let Some(tank) = tank else { return rows };
    let place: Vec<Value> = tank.position_B.to_array().into_iter().map(Value::Float).collect();
    for row in &mut rows {
        put(&mut row.set, &["actuators", "tank", "propellant_kg"], tank.propellant.into());
        put(&mut row.set, &["actuators", "tank", "position_m"], Value::Array(place.clone()));
    }
    rows
}

/// Put a value at the end of a way of keys.
pub(crate) fn put(table: &mut Table, way: &[&str], value: Value) {
    let Some((last, above)) = way.split_last() else { return };
    let mut at = table;
    for key in above {
        let inner = at.entry((*key).to_owned()).or_insert_with(|| Value::Table(Table::new()));
        let Value::Table(inner) = inner else { return };
        at = inner;
    }
    at.insert((*last).to_owned(), value);
}

/// Tables merge key by key, everything else is replaced.
fn lay_over(table: &mut Table, over: &Table) {
    for (key, value) in over {
        match (table.get_mut(key), value) {
            (Some(Value::Table(inner)), Value::Table(over)) => lay_over(inner, over),
            _ => {
                table.insert(key.clone(), value.clone());
            }
        }
    }
}
