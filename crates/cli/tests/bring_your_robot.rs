//! The example of the book's page Bring your robot: a URDF on a bus, flown to a pass.
#![allow(clippy::unwrap_used, reason = "a test may stop where it finds nothing")]

mod binary;

use binary::Folder;
use std::path::Path;

#[test]
fn the_arm_of_a_urdf_on_a_bus_flies_its_mission() {
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/bring_your_robot");
    let mission = data.join("turn.toml");
    let folder = Folder::new();
    let said = folder.wrasse(&["run", mission.to_str().unwrap()]);
    assert_eq!(said.code, 0, "{}{}", said.out, said.err);
    assert!(said.out.contains("base.rotation.max  <= 45  3.5674  deg   pass"), "{}", said.out);
}

#[test]
fn what_is_no_text_is_told_with_how_xml_says_its_encoding() {
    let folder = Folder::new();
    std::fs::write(folder.path().join("r.urdf"), b"<robot name='Ma\xdf'/>").unwrap();
    let said = folder.wrasse(&["check", "r.urdf"]);
    assert_eq!(said.code, 2);
    assert!(said.err.contains("r.urdf is not UTF-8 text") && said.err.contains("ISO-8859-1"));
    let told = "<robot name='r'><link name='a'><inertial><mass value='1'/><inertia ixx='1' ixy='0' \
                ixz='0' iyy='1' iyz='0' izz='1'/></inertial></link></robot>";
    let wide: Vec<u8> = told.encode_utf16().flat_map(u16::to_le_bytes).collect();
    std::fs::write(folder.path().join("wide.urdf"), wide).unwrap();
    assert_eq!(folder.wrasse(&["check", "wide.urdf"]).code, 0);
}
