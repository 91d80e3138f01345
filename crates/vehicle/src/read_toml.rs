//! A TOML vehicle file to a vehicle.

use crate::assemble::{Assembled, assemble};
use crate::assembly::{AssemblyJoint, Link};
use crate::denavit_hartenberg::arm;
use crate::equipment::Equipment;
use crate::equipment_on_base::check_equipment;
use crate::format::{ActuatorFile, PostureFile, VehicleFile};
use crate::provenance::Sources;
use crate::read_equipment::equipment;
use crate::read_sensors::sensors;
use crate::toml_body::{link, outline};
use crate::toml_joint::joint;
use crate::toml_reading::Reading;
use crate::toml_tool::{grasp_bounds, tool};
use crate::vehicle::{Posture, Shape, ShapeKind, Vehicle};
use std::collections::BTreeMap;
use std::sync::Arc;
use wrasse_document::{Complaint, Document, Source, Step, UNKNOWN, at, closest};
use wrasse_dynamics::{Frame, JointKind};
use wrasse_hardware::{AttitudeActuator, Sensors};
use wrasse_spatial::Pose;

/// The vehicle of a TOML file.
///
/// # Errors
/// All that is wrong with the shape of the file, and all that is wrong with what the rest says.
pub(crate) fn read_toml(source: &Arc<Source>) -> Result<Vehicle, Vec<Complaint>> {
    let document = Document::of(source)?;
    let part = document.read_in_part::<VehicleFile>();
    let Some(file) = part.value else { return Err(part.complaints) };
    match vehicle_of(source, &part.document, file) {
        Ok(vehicle) if part.complaints.is_empty() => Ok(vehicle),
        Ok(_) => Err(part.complaints),
        Err(meaning) => Err(document.beside(part.complaints, meaning)),
    }
}

/// The vehicle of a file whose shape is right.
fn vehicle_of(
    source: &Arc<Source>,
    document: &Document,
    file: VehicleFile,
) -> Result<Vehicle, Vec<Complaint>> {
    let mut reading = Reading::new(document);
    let (mut links, mut joints) = tree_of(&mut reading, &file);
    forget_made_up_names(&mut links, &mut joints);
    let outlines = outlines(&mut reading, &file);
    let attitude_actuator =
        file.attitude_actuator.as_ref().map(|given| actuator(&mut reading, given));
    check_postures(&mut reading, &file.posture, &joints);
    let grasp_bounds = grasp_bounds(&mut reading, &file.tool);
    let mut sources = sources(&mut reading, &file);
    let equipment = equipment_of(&mut reading, &mut sources, &file);
    let sensors = sensors_of(&mut reading, &mut sources, &file);
    sources.warn(&mut reading);
    let assembled = match assemble(source, &links, &joints) {
        Ok(assembled) => assembled,
        Err(complaints) => {
            reading.found.take(complaints);
            return Err(reading.found.into_complaints());
        }
    };
    let mut found = reading.found;
    if found.without_error() && file.actuators.is_some() {
        found.take(check_equipment(document, at!["actuators"], &equipment, &assembled.robot));
    }
    if !found.without_error() {
        found.take(assembled.warnings);
        return Err(found.into_complaints());
    }
    let postures = file.posture.iter().map(|p| posture(p, &assembled)).collect();
    let shapes = shapes(outlines, &assembled);
    found.take(assembled.warnings);
    let mut frames = assembled.frames;
    for (tool, bounds) in file.tool.iter().zip(grasp_bounds) {
        let of_tool = frames.iter_mut().filter(|frame| frame.name == tool.name);
        of_tool.for_each(|frame| frame.grasp_bounds = bounds);
    }
    Ok(Vehicle {
        name: file.name,
        summary: file.summary,
        robot: assembled.robot,
        joint_names: assembled.joint_names,
        limits: assembled.limits,
        frames,
        tools: file.tool.iter().map(|tool| tool.name.clone()).collect(),
        postures,
        attitude_actuator,
        equipment,
        sensors,
        shapes,
        provenance: sources.rows,
        remarks: found.into_complaints(),
    })
}

/// Links and joints: bodies, joints, arms, tools, in this order.
fn tree_of(reading: &mut Reading<'_>, file: &VehicleFile) -> (Vec<Link>, Vec<AssemblyJoint>) {
    let (mut links, mut joints) = (vec![], vec![]);
    for (i, body) in file.body.iter().enumerate() {
        links.push(link(reading, at!["body", i], body));
    }
    for (i, given) in file.joint.iter().enumerate() {
        joints.push(joint(reading, at!["joint", i], given));
    }
    for (i, given) in file.arm.iter().enumerate() {
        let (frames, of_arm) = arm(reading, at!["arm", i], given);
        links.extend(frames);
        joints.extend(of_arm);
    }
    for (i, given) in file.tool.iter().enumerate() {
        let (frame, mount) = tool(reading, at!["tool", i], given);
        links.push(frame);
        joints.push(mount);
    }
    (links, joints)
}

/// A name that the file leaves out has had its complaint: in the tree it is empty.
fn forget_made_up_names(links: &mut [Link], joints: &mut [AssemblyJoint]) {
    let of_joints = joints.iter_mut().flat_map(|j| [&mut j.name, &mut j.parent, &mut j.child]);
    for name in links.iter_mut().map(|link| &mut link.name).chain(of_joints) {
        if name.contains(UNKNOWN) {
            name.clear();
        }
    }
}

fn actuator(reading: &mut Reading<'_>, file: &ActuatorFile) -> AttitudeActuator<f64> {
    for (key, limit, unit) in [
        ("torque_limit_nm", file.torque_limit_nm, "N·m"),
        ("momentum_limit_nms", file.momentum_limit_nms, "N·m·s"),
    ] {
        if limit <= 0.0 {
            let message =
                format!("`{key}` of the attitude actuator must be positive, found {limit} {unit}");
            let help = "a vehicle without attitude actuator has no [attitude_actuator]";
            reading.error(at!["attitude_actuator", key], message, "this limit", help);
        }
    }
    AttitudeActuator { torque_limit: file.torque_limit_nm, momentum_limit: file.momentum_limit_nms }
}

/// Postures name joints that move, in the unit of their motion, within their travel.
fn check_postures(reading: &mut Reading<'_>, postures: &[PostureFile], joints: &[AssemblyJoint]) {
    let moving = joints.iter().filter_map(|j| Some((j.name.as_str(), (j.kind?, j.limits.travel))));
    let moving: BTreeMap<_, _> = moving.collect();
    for (i, posture) in postures.iter().enumerate() {
        if let Some(first) = postures[..i].iter().position(|p| p.name == posture.name) {
            let line = reading.found.line(reading.at(at!["posture", first, "name"]).start);
            let message =
                format!("two postures are called '{}'; the other is on line {line}", posture.name);
            let help = "give one of them another name";
            reading.error(at!["posture", i, "name"], message, "the second", help);
        }
        for (key, kind, positions) in [
            ("joints_deg", JointKind::Revolute, &posture.joints_deg),
            ("joints_m", JointKind::Prismatic, &posture.joints_m),
        ] {
            for (name, position) in positions {
                let path = at!["posture", i, key, name];
                check_position(reading, path, kind, *position, &moving);
            }
        }
    }
}

/// Joints that move, by name: how, and from where to where (rad or m).
type Moving<'a> = BTreeMap<&'a str, (JointKind, Option<(f64, f64)>)>;

fn check_position(
    reading: &mut Reading<'_>,
    path: &[Step<'_>],
    kind: JointKind,
    position: f64,
    moving: &Moving<'_>,
) {
    let name = path.last().map(ToString::to_string).unwrap_or_default();
    let Some((moves, travel)) = moving.get(name.as_str()) else {
        // A joint whose name is left out may be meant.
        if moving.contains_key("") {
            return;
        }
        let message = format!("no joint that moves is called '{name}'");
        let help = match closest(&name, moving.keys().copied()) {
            Some(meant) => format!("did you mean '{meant}'?"),
            None => format!(
                "joints that move: {}",
                moving.keys().copied().collect::<Vec<_>>().join(", ")
            ),
        };
        return reading.wrong_key(path, message, "no such joint", &help);
    };
    if *moves != kind {
        let (does, write) = match moves {
            JointKind::Revolute => ("turns", "joints_deg"),
            JointKind::Prismatic => ("slides", "joints_m"),
        };
        let message = format!("joint '{name}' {does}");
        return reading.wrong_key(path, message, "wrong unit", &format!("write it in `{write}`"));
    }
    let (in_si, unit) = match kind {
        JointKind::Revolute => (position.to_radians(), "deg"),
        JointKind::Prismatic => (position, "m"),
    };
    // The ends of the travel are converted as the position is: equal stays equal.
    if let Some((lower, upper)) = travel.filter(|(lower, upper)| in_si < *lower || in_si > *upper) {
        let in_file = |end: f64| if kind == JointKind::Revolute { end.to_degrees() } else { end };
        let (lower, upper) = (in_file(lower), in_file(upper));
        let message = format!(
            "joint '{name}' is at {position} {unit}, beyond its travel from {lower} to {upper} {unit}"
        );
        reading.warning(path, message, "beyond its travel", "");
    }
}

fn posture(file: &PostureFile, assembled: &Assembled) -> Posture {
    let position = |name: &String| {
        let turned = file.joints_deg.get(name).copied().map(f64::to_radians);
        turned.or_else(|| file.joints_m.get(name).copied()).unwrap_or(0.0)
    };
    Posture { name: file.name.clone(), q: assembled.joint_names.iter().map(position).collect() }
}

/// Outlines with the body they belong to and their place in its frame.
fn outlines(reading: &mut Reading<'_>, file: &VehicleFile) -> Vec<(String, Pose<f64>, ShapeKind)> {
    let mut outlines = vec![];
    for (i, body) in file.body.iter().enumerate() {
        for (k, shape) in body.shape.iter().enumerate() {
            let drawn = outline(reading, at!["body", i, "shape", k], body, shape);
            outlines.extend(drawn.map(|(X_LS, kind)| (body.name.clone(), X_LS, kind)));
        }
    }
    outlines
}

fn shapes(outlines: Vec<(String, Pose<f64>, ShapeKind)>, assembled: &Assembled) -> Vec<Shape> {
    let placed = outlines.into_iter().filter_map(|(link, X_LS, kind)| {
        let on = assembled.frames.iter().find(|named| named.name == link)?.frame;
        let frame = Frame { body: on.body, X_BF: on.X_BF * X_LS };
        Some(Shape { link, frame, kind })
    });
    placed.collect()
}

/// Where the numbers of each block come from.
fn sources(reading: &mut Reading<'_>, file: &VehicleFile) -> Sources {
    let none = BTreeMap::new();
    let mut sources = Sources::new(file.source.as_ref());
    let mut block = |kind: &'static str, i: usize, name: &str, source, source_of| {
        sources.block(reading, at![kind, i], &format!("{kind}.{name}"), source, source_of);
    };
    for (i, body) in file.body.iter().enumerate() {
        block("body", i, &body.name, body.source.as_ref(), &body.source_of);
    }
    for (i, joint) in file.joint.iter().enumerate() {
        block("joint", i, &joint.name, joint.source.as_ref(), &joint.source_of);
    }
    for (i, arm) in file.arm.iter().enumerate() {
        block("arm", i, &arm.name, arm.source.as_ref(), &arm.source_of);
    }
    for (i, tool) in file.tool.iter().enumerate() {
        block("tool", i, &tool.name, tool.source.as_ref(), &none);
    }
    for (i, posture) in file.posture.iter().enumerate() {
        block("posture", i, &posture.name, posture.source.as_ref(), &none);
    }
    if let Some(actuator) = &file.attitude_actuator {
        let (source, source_of) = (actuator.source.as_ref(), &actuator.source_of);
        let path = at!["attitude_actuator"];
        sources.block(reading, path, "attitude_actuator", source, source_of);
    }
    sources
}

/// The equipment, if there is any.
fn equipment_of(reading: &mut Reading<'_>, sources: &mut Sources, file: &VehicleFile) -> Equipment {
    let Some(table) = &file.actuators else { return Equipment::default() };
    let mut of_table = Sources::within("actuators", table.source.as_ref(), sources.covered());
    let equipment = equipment(reading, &mut of_table, at!["actuators"], table);
    sources.take_without(&mut of_table);
    equipment
}

/// The sensors, if the file says of any.
fn sensors_of(
    reading: &mut Reading<'_>,
    sources: &mut Sources,
    file: &VehicleFile,
) -> Sensors<f64> {
    let Some(table) = &file.sensors else { return Sensors::default() };
    let mut of_table = Sources::within("sensors", table.source.as_ref(), sources.covered());
    let (sensors, rows) = sensors(reading, &mut of_table, at!["sensors"], table);
    sources.take_without(&mut of_table);
    sources.rows.extend(rows);
    sensors
}

/// The JSON Schema of TOML vehicle files, for editors.
pub fn vehicle_schema() -> serde_json::Value {
    wrasse_document::schema_of::<VehicleFile>()
}
