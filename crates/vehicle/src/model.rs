//! A vehicle as its files give it, before it is known whether it can be; and the step that makes a
//! checked vehicle of it, whatever the format.

use crate::assemble::{AssembledRobot, assemble};
use crate::assembly::{Acceptance, Assembly};
use crate::check::check_equipment;
use crate::equipment::Equipment;
use crate::findings::Findings;
use crate::toml::posture_of;
use crate::vehicle::{Shape, Vehicle};
use std::collections::BTreeMap;
use wrasse_document::{Complaint, Document, Severity, at};
use wrasse_dynamics::Frame;
use wrasse_hardware::{AttitudeActuator, Sensors};

/// What a file says.
#[derive(Debug)]
pub(crate) struct Model {
    pub(crate) name: String,
    pub(crate) summary: String,
    /// What no document says of the real vehicle.
    pub(crate) not_public: Vec<String>,
    /// Links and joints, its own and those that it includes.
    pub(crate) assembly: Assembly,
    pub(crate) attitude_actuator: Option<AttitudeActuator<f64>>,
    /// What is bolted on the base, if the file has a table of it.
    pub(crate) equipment: Option<Equipment>,
    pub(crate) sensors: Sensors<f64>,
    /// The file with the place of each value; `None` for a format without.
    pub(crate) document: Option<Document>,
    /// What is wrong with the shape of the file: then what else is found is told beside it.
    pub(crate) shape: Vec<Complaint>,
    /// All else that was found: errors, warnings, notes.
    pub(crate) found: Vec<Complaint>,
}

impl Model {
    /// Of a format that says nothing but links and joints.
    pub(crate) fn bare(name: String, summary: String, assembly: Assembly) -> Self {
        Self {
            name,
            summary,
            assembly,
            not_public: vec![],
            attitude_actuator: None,
            equipment: None,
            sensors: Sensors::default(),
            document: None,
            shape: vec![],
            found: vec![],
        }
    }
    /// The checked vehicle.
    ///
    /// # Errors
    /// All complaints at once, if it is not physically possible or anything was wrong before.
    pub(crate) fn into_vehicle(mut self) -> Result<Vehicle, Vec<Complaint>> {
        let assembled = assemble(&self.assembly);
        let mut found = Findings::within(&self.assembly.files);
        found.take(std::mem::take(&mut self.found));
        let assembled = match assembled {
            Ok(mut assembled) => {
                found.take(self.equipment_on(&assembled, found.without_error()));
                found.take(std::mem::take(&mut assembled.warnings));
                Some(assembled)
            }
            Err(complaints) => {
                found.take(complaints);
                None
            }
        };
        let fine = found.without_error();
        let complaints = found.into_complaints();
        match assembled.filter(|_| fine) {
            Some(assembled) if self.shape.is_empty() => Ok(self.vehicle(assembled, complaints)),
            Some(_) => Err(self.shape),
            None => Err(self.beside_shape(complaints)),
        }
    }
    /// Complaints and those about the shape of the file, as far as they are not the same.
    pub(crate) fn beside_shape(&self, complaints: Vec<Complaint>) -> Vec<Complaint> {
        match &self.document {
            Some(document) if !self.shape.is_empty() => {
                document.beside(self.shape.clone(), complaints)
            }
            _ => complaints,
        }
    }
    /// Has all links use mass properties that no rigid body has, if there is a reason to.
    pub(crate) fn accept_nonphysical(&mut self, reason: Option<&str>) {
        let Some(reason) = reason else { return };
        for matter in self.assembly.links.iter_mut().filter_map(|link| link.matter.as_mut()) {
            let why = || Acceptance { reason: reason.to_owned(), of_this: false };
            matter.accept_nonphysical.get_or_insert_with(why);
        }
    }
    /// Whether the file says what is sensed with.
    pub(crate) fn has_sensors(&self) -> bool {
        self.sensors != Sensors::default()
    }
    /// Whether the equipment suits the base.
    fn equipment_on(&self, assembled: &AssembledRobot, asked: bool) -> Vec<Complaint> {
        match (&self.document, &self.equipment) {
            (Some(document), Some(equipment)) if asked => {
                check_equipment(document, at!["actuators"], equipment, &assembled.robot)
            }
            _ => vec![],
        }
    }
    fn vehicle(self, assembled: AssembledRobot, remarks: Vec<Complaint>) -> Vehicle {
        let assembly = self.assembly;
        let postures =
            assembly.postures.iter().map(|given| posture_of(given, &assembled)).collect();
        let shapes = shapes(&assembly, &assembled);
        let mut frames = assembled.frames;
        for (tool, bounds) in &assembly.tools {
            let of_tool = frames.iter_mut().filter(|frame| frame.name == *tool);
            of_tool.for_each(|frame| frame.grasp_bounds = *bounds);
        }
        let mut texts = assembly.files.iter();
        let text = texts.next().map_or(String::new(), |source| source.text.clone());
        Vehicle {
            name: self.name,
            summary: self.summary,
            text,
            included: texts.cloned().collect(),
            robot: assembled.robot,
            joint_names: assembled.joint_names,
            limits: assembled.limits,
            followers: assembled.followers,
            matter: assembled.matter,
            frames,
            tools: assembly.tools.into_iter().map(|(name, _)| name).collect(),
            postures,
            attitude_actuator: self.attitude_actuator,
            equipment: self.equipment.unwrap_or_default(),
            sensors: self.sensors,
            shapes,
            partly_drawn: assembly.partly_drawn,
            places: assembled.places,
            provenance: assembly.provenance,
            not_public: self.not_public,
            remarks,
        }
    }
}

fn shapes(assembly: &Assembly, assembled: &AssembledRobot) -> Vec<Shape> {
    let frames: BTreeMap<&str, Frame<f64>> =
        assembled.frames.iter().map(|named| (&*named.name, named.frame)).collect();
    let placed = assembly.outlines.iter().filter_map(|outline| {
        let on = *frames.get(&*outline.link)?;
        let frame = Frame { body: on.body, X_BF: on.X_BF * outline.X_LF };
        Some(Shape { link: outline.link.clone(), frame, kind: outline.kind })
    });
    placed.collect()
}

/// Whether any of the complaints is an error.
pub(crate) fn any_error(complaints: &[Complaint]) -> bool {
    complaints.iter().any(|complaint| complaint.severity == Severity::Error)
}
