//! A drive limit of zero was accepted, and a tool had no bounds for what it grasps.

use wrasse_document::render;
use wrasse_vehicle::{GraspBounds, Vehicle, read_vehicle};

/// An arm of one joint with this limit, and a tool with this line.
fn read(limit: &str, tool: &str) -> Result<Vehicle, String> {
    let inertia = "inertia_kgm2 = { about = \"centre-of-mass\", axes = \"body\", xx = 0.1, yy = 0.4, zz = 0.4 }";
    let text = format!(
        "name = \"t\"\nsummary = \"one joint\"\nsource.assumed = \"test\"\n\
         [[body]]\nname = \"bus\"\nmass_kg = 100\ncentre_of_mass_m = [0, 0, 0]\n{inertia}\n\
         [[body]]\nname = \"l1\"\nmass_kg = 4\ncentre_of_mass_m = [0.5, 0, 0]\n{inertia}\n\
         [[joint]]\nname = \"j1\"\nkind = \"revolute\"\nparent = \"bus\"\nchild = \"l1\"\n\
         position_m = [0.5, 0, 0]\naxis = [0, 0, 1]\ntravel_deg = [-90, 90]\n{limit}\n\
         [[tool]]\nname = \"tool\"\non = \"l1\"\nposition_m = [1, 0, 0]\n{tool}\n"
    );
    read_vehicle("t.toml", text).map_err(|complaints| render(&complaints, false))
}

#[test]
fn a_drive_limit_of_zero_is_complained_of_where_it_stands() {
    for key in ["rate_deg_s", "effort_nm"] {
        let text = read(&format!("{key} = 0"), "").expect_err("it could not be driven");
        let words = format!("{key} of joint 'j1' is 0: the joint could not be driven");
        assert!(text.contains(&words) && text.contains("leave out what is not limited"), "{text}");
        assert!(read(&format!("{key} = 1"), "").is_ok());
    }
}

#[test]
fn a_tool_says_how_far_a_grip_may_be_and_5_mm_and_half_a_degree_where_it_does_not() {
    let bounds = |tool: &str| {
        let vehicle = read("rate_deg_s = 1", tool).unwrap_or_else(|text| panic!("{text}"));
        let tool = vehicle.frames.iter().find(|frame| frame.name == "tool");
        tool.expect("the tool is a frame").grasp_bounds
    };
    let half = 0.5_f64.to_radians();
    assert_eq!(bounds(""), GraspBounds { distance: 0.005, angle: half });
    let given = bounds("grasp_bounds = { distance_m = 0.02 }");
    assert_eq!(given, GraspBounds { distance: 0.02, angle: half });
    for bad in ["distance_m = 0", "distance_m = -1", "angle_deg = 181", "distance_m = nan"] {
        let text = read("rate_deg_s = 1", &format!("grasp_bounds = {{ {bad} }}"));
        assert!(text.expect_err(bad).contains("grasp_bounds"), "{bad}");
    }
}
