//! A TOML vehicle file to a vehicle.

use super::arm::{ArmFile, arm};
use super::attitude_actuator::{ActuatorFile, attitude_actuator};
use super::body::{BodyFile, link, outline};
use super::joint::{JointFile, joint};
use super::posture::{PostureFile, check_postures, posture};
use super::tool::{ToolFile, grasp_bounds, tool};
use super::uniform::outline_of_uniform;
use crate::assemble::{AssembledRobot, assemble};
use crate::assembly::{AssemblyJoint, Link};
use crate::check::check_equipment;
use crate::equipment::Equipment;
use crate::hardware::{EquipmentFile, SensorsFile, equipment, sensors};
use crate::table::{ProvenanceFile, Reading, SourceFile, Sources};
use crate::vehicle::{Shape, ShapeKind, Vehicle};
use schemars::JsonSchema;
use serde::Deserialize;
use std::sync::Arc;
use wrasse_document::{Complaint, Document, Source, UNKNOWN, at};
use wrasse_dynamics::Frame;
use wrasse_hardware::Sensors;
use wrasse_spatial::Pose;

/// A vehicle: a free-flying base and what hangs on it.
///
/// Every number says its unit in its key. The base is the body that no joint carries, with everything
/// fixed to it; its frame is that body's frame.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct VehicleFile {
    /// What it is called.
    #[schemars(length(min = 1))]
    pub(crate) name: String,
    /// One line for lists and reports.
    pub(crate) summary: String,
    /// Where all those numbers come from that have no source of their own.
    pub(crate) source: Option<SourceFile>,
    /// What no document says of the real vehicle, one thing an item: for whoever reads the numbers.
    #[serde(default)]
    #[schemars(inner(length(min = 1)))]
    pub(crate) not_public: Vec<String>,
    /// Rigid bodies, each with a frame of its own.
    pub(crate) body: Vec<BodyFile>,
    /// Joints, each given by the pose of the child's frame on the parent.
    #[serde(default)]
    pub(crate) joint: Vec<JointFile>,
    /// Arms given by Denavit-Hartenberg rows; their joints come after those of `joint`.
    #[serde(default)]
    pub(crate) arm: Vec<ArmFile>,
    /// Named frames where a tool works or a payload is held.
    #[serde(default)]
    pub(crate) tool: Vec<ToolFile>,
    /// Named positions of the joints.
    #[serde(default)]
    pub(crate) posture: Vec<PostureFile>,
    /// What holds and turns the base, as an ideal.
    pub(crate) attitude_actuator: Option<ActuatorFile>,
    /// What holds, turns and moves the base, unit by unit.
    pub(crate) actuators: Option<EquipmentFile>,
    /// What attitude and joints are felt with.
    pub(crate) sensors: Option<SensorsFile>,
}

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
        file.attitude_actuator.as_ref().map(|given| attitude_actuator(&mut reading, given));
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
        text: String::new(),
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
        not_public: file.not_public,
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

/// Outlines with the body they belong to and their place in its frame.
fn outlines(reading: &mut Reading<'_>, file: &VehicleFile) -> Vec<(String, Pose<f64>, ShapeKind)> {
    let mut outlines = vec![];
    for (i, body) in file.body.iter().enumerate() {
        if let Some(uniform) = body.uniform.as_ref().filter(|_| body.shape.is_empty()) {
            // What is wrong with it was told with the mass properties.
            let mut unheard = Reading::new(reading.document);
            let drawn = outline_of_uniform(&mut unheard, at!["body", i], body, uniform);
            outlines.extend(drawn.map(|(X_LS, kind)| (body.name.clone(), X_LS, kind)));
        }
        for (k, shape) in body.shape.iter().enumerate() {
            let drawn = outline(reading, at!["body", i, "shape", k], body, shape);
            outlines.extend(drawn.map(|(X_LS, kind)| (body.name.clone(), X_LS, kind)));
        }
    }
    outlines
}

fn shapes(outlines: Vec<(String, Pose<f64>, ShapeKind)>, assembled: &AssembledRobot) -> Vec<Shape> {
    let placed = outlines.into_iter().filter_map(|(link, X_LS, kind)| {
        let on = assembled.frames.iter().find(|named| named.name == link)?.frame;
        let frame = Frame { body: on.body, X_BF: on.X_BF * X_LS };
        Some(Shape { link, frame, kind })
    });
    placed.collect()
}

/// Where the numbers of each block come from.
fn sources(reading: &mut Reading<'_>, file: &VehicleFile) -> Sources {
    let mut sources = Sources::new(file.source.as_ref());
    let mut block = |kind: &'static str, i: usize, name: &str, provenance: &ProvenanceFile| {
        sources.block(reading, at![kind, i], &format!("{kind}.{name}"), provenance);
    };
    let alone = |source: &Option<SourceFile>| ProvenanceFile {
        source: source.clone(),
        ..ProvenanceFile::default()
    };
    for (i, body) in file.body.iter().enumerate() {
        block("body", i, &body.name, &body.provenance);
    }
    for (i, joint) in file.joint.iter().enumerate() {
        block("joint", i, &joint.name, &joint.provenance);
    }
    for (i, arm) in file.arm.iter().enumerate() {
        block("arm", i, &arm.name, &arm.provenance);
    }
    for (i, tool) in file.tool.iter().enumerate() {
        block("tool", i, &tool.name, &alone(&tool.source));
    }
    for (i, posture) in file.posture.iter().enumerate() {
        block("posture", i, &posture.name, &alone(&posture.source));
    }
    if let Some(actuator) = &file.attitude_actuator {
        let (path, of) = (at!["attitude_actuator"], "attitude_actuator");
        sources.block(reading, path, of, &actuator.provenance);
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
    let mut of_table =
        Sources::within("sensors", table.provenance.source.as_ref(), sources.covered());
    let (sensors, rows) = sensors(reading, &mut of_table, at!["sensors"], table);
    sources.take_without(&mut of_table);
    sources.rows.extend(rows);
    sensors
}

/// The JSON Schema of TOML vehicle files, for editors.
pub fn vehicle_schema() -> serde_json::Value {
    wrasse_document::schema_of::<VehicleFile>()
}
