//! What is told of a way that cannot be gone.

use std::sync::Arc;
use wrasse_mission::read_mission;
use wrasse_rehearsal::{Case, End, RunOptions, run_case};

fn end(case: &Case) -> End {
    run_case(case, RunOptions::default(), &mut |_, _| {}).end
}

/// The elbow may hardly close, and the way asks it to: bent to the other side it has room.
#[test]
fn another_posture_is_named_where_another_branch_of_the_arm_has_room() {
    let text = "name = \"way\"\nvehicle = \"atlas-class\"\n\
                [initial]\nposture = \"sideways_300mm\"\n[world]\nbase_attitude = \"held\"\n\
                [control]\narm_law = \"attitude-held\"\nrate_hz = 20\n[[phase]]\nname = \"back\"\n\
                move_tool = { by_m = [-0.2, 0.0, 0.0], duration_s = 30.0 }\n";
    let mut case = read_mission("way.toml", text).expect("it is sound").cases.remove(0);
    assert_eq!(end(&case), End::Completed);
    let travel = Some((-3.1, case.start.q[3] + 0.05));
    case.setup.limits[3].travel = travel;
    Arc::make_mut(&mut case.vehicle).limits[3].travel = travel;
    let End::Infeasible { reason, .. } = end(&case) else { panic!("it has no room") };
    assert!(reason.contains("joint joint4 would leave its travel"), "{reason}");
    let told = reason.split("; ").find_map(|one| one.split_once("another posture of the same arm"));
    let (_, told) = told.unwrap_or_else(|| panic!("{reason}"));
    // As a reader takes it from the sentence.
    let list = told.split("{ ").nth(1).expect("a table").trim_end_matches(" }");
    for (j, one) in list.split(", ").enumerate() {
        let (name, degrees) = one.split_once(" = ").expect("a key and a number");
        assert_eq!(name, case.joint_name(j));
        case.start.q[j] = degrees.parse::<f64>().expect("a number").to_radians();
    }
    assert!(case.start.q[3] < 0.0, "{told}");
    assert_eq!(end(&case), End::Completed);
}
