//! Every vehicle of the catalogue plans and flies: arms move their tools a little, vehicles without
//! joints hold and coast.

use wrasse_document::render;
use wrasse_mission::{read_mission, run};
use wrasse_rehearsal::{End, RunOptions};
use wrasse_vehicle::{Vehicle, catalogue};

/// Flies a mission text; the ledger closes and the requirements hold.
#[track_caller]
fn assert_flies(what: &str, text: &str) {
    let mission = read_mission("mission.toml", text).unwrap_or_else(|complaints| {
        panic!("{what}: {}", render(&complaints, false));
    });
    let outcome = run(&mission, RunOptions::default(), &mut |_| {});
    for case in &outcome.cases {
        assert!(case.ledger.closes, "{what}: the ledger is open");
        assert!(matches!(case.end, End::Completed), "{what}: {:?}", case.end);
        assert!(case.passed, "{what}: {:?} {:?}", case.end, case.verdicts);
    }
}

/// What holds the base: what is fitted or ideal, and otherwise nothing.
fn base(vehicle: &Vehicle) -> (&'static str, &'static str) {
    let units = &vehicle.equipment.actuators;
    let fitted = units.wheels.len() + units.cmgs.len() + units.thrusters.len() > 0;
    if fitted || vehicle.attitude_actuator.is_some() {
        ("controlled", "attitude-held")
    } else {
        ("free", "free-floating")
    }
}

/// A straight way of 5 cm along the base's z, within the limits of the joints, if they have any.
fn reach(vehicle: &Vehicle, tool: &str) -> String {
    let (attitude, law) = base(vehicle);
    let limited = vehicle.limits.iter().any(|joint| joint.rate.is_some());
    let within = if limited {
        ", 'joints.effort_use.max <= 100 %', 'joints.rate_use.max <= 100 %'"
    } else {
        ""
    };
    let posture = &vehicle.postures[0].name;
    format!(
        "name = 'small-reach'\nvehicle = '{}'\n\
         requirements = ['tool.position_error.max <= 1 mm'{within}]\n\
         [initial]\nposture = '{posture}'\n\
         [world]\nbase_attitude = '{attitude}'\njoints = 'torque'\n\
         [control]\narm_law = '{law}'\ntool = '{tool}'\n\
         [[phase]]\nname = 'reach'\nmove_tool = {{ by_m = [0.0, 0.0, 0.05], limits = {{ \
         shape = 's-curve', speed_m_s = 0.02, acceleration_m_s2 = 0.005, jerk_m_s3 = 0.005, \
         turn_speed_deg_s = 2.0, turn_acceleration_deg_s2 = 1.0, turn_jerk_deg_s3 = 1.0 }} }}\n",
        vehicle.name
    )
}

#[test]
fn every_arm_of_the_catalogue_moves_its_tool() {
    let mut flown = vec![];
    for entry in catalogue() {
        let vehicle = entry.read().unwrap_or_else(|why| panic!("{}", render(&why, false)));
        // The planar arm moves in a plane; a URDF has no postures.
        if vehicle.robot.joint_count() < 6 {
            continue;
        }
        for tool in &vehicle.tools {
            let what = format!("{} {tool}", entry.name);
            assert_flies(&what, &reach(&vehicle, tool));
            flown.push(what);
        }
    }
    assert!(flown.len() >= 19, "{flown:?}");
}

#[test]
fn what_has_no_joints_coasts_and_what_has_thrusters_holds_itself() {
    let mut flown = 0;
    for entry in catalogue() {
        let vehicle = entry.read().unwrap_or_else(|why| panic!("{}", render(&why, false)));
        if vehicle.robot.joint_count() > 0 {
            continue;
        }
        let (attitude, _) = base(&vehicle);
        let text = format!(
            "name = 'coast'\nvehicle = '{}'\nrequirements = ['base.rotation.max <= 2 deg']\n\
             [world]\nbase_attitude = '{attitude}'\n\
             [[phase]]\nname = 'coast'\nhold = {{ duration_s = 5.0, keep = 'joints' }}\n",
            entry.name
        );
        assert_flies(entry.name, &text);
        flown += 1;
    }
    assert_eq!(flown, 8);
}
