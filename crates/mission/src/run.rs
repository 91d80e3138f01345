//! A mission run: its cases, one after the other.

use crate::mission::Mission;
use crate::outcome::{Outcome, ProvenanceRow, VehicleCard};
use wrasse_rehearsal::{RunOptions, looked_at, run_case};
use wrasse_vehicle::Grade;

/// How far a run is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Progress<'a> {
    /// Number of the case, from zero.
    pub case: usize,
    /// Number of cases.
    pub cases: usize,
    /// Share of the case that is done (–).
    pub share: f64,
    /// What is being done.
    pub doing: &'a str,
}

/// Run a mission.
pub fn run(
    mission: &Mission,
    options: RunOptions,
    progress: &mut dyn FnMut(Progress<'_>),
) -> Outcome {
    let cases = mission.cases.len();
    let mut outcomes = vec![];
    for number in 0..cases {
        let mut tell = |doing: &str, share| {
            progress(Progress { case: number, cases, share, doing });
        };
        outcomes.push(run_case(&mission.cases[number], options, &mut tell));
    }
    Outcome {
        mission: mission.name.clone(),
        summary: mission.summary.clone(),
        mission_file: mission.file.clone(),
        mission_text: mission.text.clone(),
        settings: mission.settings.clone(),
        version: env!("CARGO_PKG_VERSION").into(),
        seed: mission.seed,
        vehicle: vehicle_card(mission),
        environment: format!("{} {}", environment(mission), looked_at(&mission.cases[0])),
        cases: outcomes,
    }
}

/// What acts on the vehicle, in a sentence.
fn environment(mission: &Mission) -> &'static str {
    if mission.cases.iter().all(|case| case.wrenches.is_empty()) {
        "Free space: nothing acts on the vehicle but its own actuators."
    } else {
        "Free space: nothing acts on the vehicle but its own actuators and the applied wrenches."
    }
}

fn vehicle_card(mission: &Mission) -> VehicleCard {
    let case = &mission.cases[0];
    let vehicle = &case.vehicle;
    let provenance = vehicle.provenance.iter().chain(&case.equipment.provenance);
    let rows = provenance.map(|p| ProvenanceRow {
        of: p.of.clone(),
        grade: match p.grade {
            Grade::Published => "published",
            Grade::Derived => "derived",
            Grade::Assumed => "assumed",
        }
        .into(),
        source: p.source.clone(),
    });
    VehicleCard {
        name: vehicle.name.clone(),
        summary: vehicle.summary.clone(),
        file: case.vehicle_name.clone(),
        mass_kg: vehicle.robot.mass(),
        joints: vehicle.robot.joint_count(),
        provenance: rows.collect(),
        remarks: vehicle
            .remarks
            .iter()
            .chain(&mission.remarks)
            .map(|c| c.message.clone())
            .collect(),
    }
}
