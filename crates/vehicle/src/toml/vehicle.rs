//! A TOML vehicle file to a vehicle.

use super::arm::{ArmFile, arm};
use super::attitude_actuator::{ActuatorFile, attitude_actuator};
use super::body::{BodyFile, link, outline};
use super::include::{IncludeFile, include, mount};
use super::joint::{JointFile, joint};
use super::posture::{PostureFile, check_postures, given_posture};
use super::tool::{ToolFile, grasp_bounds, tool};
use super::uniform::outline_of_uniform;
use crate::assembly::{Assembly, AssemblyJoint, Link, Outline};
use crate::equipment::Equipment;
use crate::findings::SourceFiles;
use crate::hardware::{EquipmentFile, SensorsFile, equipment, sensors};
use crate::model::Model;
use crate::read_vehicle::Nesting;
use crate::table::{ProvenanceFile, Reading, SourceFile, Sources};
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeSet;
use std::sync::Arc;
use wrasse_document::{Complaint, Document, Source, UNKNOWN, at};
use wrasse_hardware::Sensors;

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
    #[serde(default)]
    pub(crate) body: Vec<BodyFile>,
    /// Other vehicle files, whose links and joints come after those of this one.
    #[serde(default)]
    pub(crate) include: Vec<IncludeFile>,
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

/// What a TOML file says.
///
/// # Errors
/// All that is wrong with the shape of the file, if too much is wrong to go on.
pub(crate) fn read_toml(
    source: &Arc<Source>,
    nesting: &mut Nesting,
) -> Result<Model, Vec<Complaint>> {
    let document = Document::of(source)?;
    let part = document.read_in_part::<VehicleFile>();
    let Some(file) = part.value else { return Err(part.complaints) };
    let model = model_of(&part.document, file, nesting);
    Ok(Model { document: Some(document), shape: part.complaints, ..model })
}

/// What a file says whose shape is right.
fn model_of(document: &Document, file: VehicleFile, nesting: &mut Nesting) -> Model {
    let mut reading = Reading::new(document);
    let mut assembly = assembly_of(&mut reading, &file);
    let includes = includes(&mut reading, &file, nesting, &mut assembly);
    forget_made_up_names(&mut assembly.links, &mut assembly.joints);
    let attitude_actuator =
        file.attitude_actuator.as_ref().map(|given| attitude_actuator(&mut reading, given));
    check_postures(&mut reading, &file.posture, &assembly.joints);
    let mut sources = sources(&mut reading, &file);
    let equipment = equipment_of(&mut reading, &mut sources, &file);
    let sensors = sensors_of(&mut reading, &mut sources, &file);
    sources.warn(&mut reading);
    // Its own come first, those of what it includes behind them.
    assembly.provenance.splice(0..0, sources.rows);
    if file.body.is_empty() && includes == 0 && file.include.is_empty() {
        let message = "the file has neither a body nor an include".to_owned();
        let help = "a vehicle has at least its base: a [[body]], or an [[include]] of another file";
        reading.error(at!["name"], message, "this vehicle", help);
    }
    Model {
        attitude_actuator,
        equipment,
        sensors,
        not_public: file.not_public,
        found: reading.found.into_complaints(),
        ..Model::bare(file.name, file.summary, assembly)
    }
}

/// Puts what the file includes behind its own. How many of them could be read.
fn includes(
    reading: &mut Reading<'_>,
    file: &VehicleFile,
    nesting: &mut Nesting,
    assembly: &mut Assembly,
) -> usize {
    let mut count = 0;
    for (i, given) in file.include.iter().enumerate() {
        let Some(included) = include(reading, at!["include", i], given, nesting) else { continue };
        assembly.joints.extend(mount(reading, at!["include", i], given, &included));
        assembly.append(included);
        count += 1;
    }
    count
}

/// What the file says itself of links and joints: bodies, joints, arms, tools, in this order.
fn assembly_of(reading: &mut Reading<'_>, file: &VehicleFile) -> Assembly {
    let (links, joints) = tree_of(reading, file);
    let bounds = grasp_bounds(reading, &file.tool);
    let tools = file.tool.iter().map(|tool| tool.name.clone());
    Assembly {
        files: SourceFiles::of(reading.document.source()),
        links,
        joints,
        outlines: outlines(reading, file),
        partly_drawn: BTreeSet::new(),
        tools: tools.zip(bounds).collect(),
        postures: file.posture.iter().map(given_posture).collect(),
        provenance: vec![],
    }
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

/// Outlines of the bodies.
fn outlines(reading: &mut Reading<'_>, file: &VehicleFile) -> Vec<Outline> {
    let mut outlines = vec![];
    for (i, body) in file.body.iter().enumerate() {
        if let Some(uniform) = body.uniform.as_ref().filter(|_| body.shape.is_empty()) {
            // What is wrong with it was told with the mass properties.
            let mut unheard = Reading::new(reading.document);
            let drawn = outline_of_uniform(&mut unheard, at!["body", i], body, uniform);
            let of_body = |(X_LF, kind)| Outline { link: body.name.clone(), X_LF, kind };
            outlines.extend(drawn.map(of_body));
        }
        for (k, shape) in body.shape.iter().enumerate() {
            let drawn = outline(reading, at!["body", i, "shape", k], body, shape);
            let of_body = |(X_LF, kind)| Outline { link: body.name.clone(), X_LF, kind };
            outlines.extend(drawn.map(of_body));
        }
    }
    outlines
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
    for (i, include) in file.include.iter().enumerate() {
        block("include", i, &include.vehicle, &include.provenance);
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
fn equipment_of(
    reading: &mut Reading<'_>,
    sources: &mut Sources,
    file: &VehicleFile,
) -> Option<Equipment> {
    let table = file.actuators.as_ref()?;
    let mut of_table = Sources::within("actuators", table.source.as_ref(), sources.covered());
    let equipment = equipment(reading, &mut of_table, at!["actuators"], table);
    sources.take_without(&mut of_table);
    Some(equipment)
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
