//! A mission that names no tool guides the vehicle's first: its name is said wherever that decides.

use std::path::Path;
use wrasse_document::render;
use wrasse_mission::{Mission, read_mission};
use wrasse_rehearsal::{Case, End, RunOptions, run_case};

fn read(vehicle: &str, rest: &str) -> Result<Mission, String> {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/tool.toml");
    let text = format!("name = \"tool\"\nvehicle = \"{vehicle}\"\n{rest}");
    read_mission(file, text).map_err(|complaints| render(&complaints, false))
}

fn case(vehicle: &str, rest: &str) -> Case {
    read(vehicle, rest).unwrap_or_else(|said| panic!("{said}")).cases.remove(0)
}

fn reason(case: &Case) -> String {
    match run_case(case, RunOptions::default(), &mut |_, _| {}).end {
        End::Infeasible { reason, .. } | End::Stopped { reason, .. } => reason,
        other => panic!("it is flown: {other:?}"),
    }
}

const START: &str = "[initial]\nposture = \"bent\"\njoints_m.slide = 0.3\n[world]\n\
                     base_attitude = \"held\"\n";

#[test]
fn what_was_flown_names_the_first_tool_and_whence_it_is() {
    let phase = "[[phase]]\nname = \"go\"\nhold = { duration_s = 1 }\n";
    let told = |control: &str| {
        let case = case("two-fingers.toml", &format!("{START}{control}{phase}"));
        let found = case.as_flown.iter().find(|s| s.key == "control.tool").expect("it is told");
        (found.value.clone(), found.origin)
    };
    assert_eq!(told(""), ("palm".into(), "default: the vehicle's first tool"));
    assert_eq!(told("[control]\ntool = \"spare\"\n"), ("spare".into(), "mission file"));
}

#[test]
fn what_cannot_be_reached_is_told_of_a_tool_by_its_name() {
    let line =
        "[[phase]]\nname = \"go\"\nmove_tool = { by_m = [0.0, 0.0, 0.5], duration_s = 20 }\n";
    let first = reason(&case("two-fingers.toml", &format!("{START}{line}")));
    assert!(first.contains("the tool palm falls behind its reference"), "{first}");
    let other = format!("{START}{}", line.replace("move_tool", "tool = \"spare\"\nmove_tool"));
    let other = reason(&case("two-fingers.toml", &other));
    assert!(other.contains("the tool spare falls behind its reference"), "{other}");
    let pose = "[control]\narm_law = \"attitude-held\"\n[[phase]]\nname = \"go\"\n\
                move_joints = { to_tool = { position_m = [9, 0, 0], attitude.rpy_deg = [0, 0, 0] }, \
                duration_s = 20 }\n";
    let far = reason(&case("two-fingers.toml", &format!("{START}{pose}")));
    assert!(far.contains("no joint positions bring the tool palm to its pose"), "{far}");
}

#[test]
fn a_vehicle_without_tools_is_answered_with_its_frames() {
    let urdf = "../../../../vehicles/example-arm.urdf";
    let phase =
        "[[phase]]\nname = \"go\"\nmove_joints = { to_deg.shoulder = 10, duration_s = 20 }\n";
    let Err(said) = read(urdf, phase) else { panic!("no tool is known") };
    for words in [
        "vehicle example-arm has no tool, and the mission names none",
        "name one of the frames that joints move: ",
        "upper_arm",
        "in control.tool",
    ] {
        assert!(said.contains(words), "no `{words}` in\n{said}");
    }
    assert!(said.ends_with("\n1 error\n"), "{said}");
    let named = case(urdf, &format!("[control]\ntool = \"upper_arm\"\n{phase}"));
    assert_eq!(named.frame_name(&named.setup.assignment.tool), "upper_arm");
    let Err(said) = read(urdf, &format!("[control]\ntool = \"bus\"\n{phase}")) else {
        panic!("the bus is moved by no joint")
    };
    assert!(said.contains("bus is fixed to the base") && said.contains("upper_arm"), "{said}");
}
