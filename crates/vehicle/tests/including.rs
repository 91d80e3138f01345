//! `[[include]]`: what is taken of another file, what is told of it, and where.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]
#![allow(clippy::unwrap_used, reason = "a test may stop where it finds nothing")]

use std::fs;
use tempfile::TempDir;
use wrasse_document::{Complaint, Severity};
use wrasse_vehicle::{Vehicle, read_vehicle};

const BUS: &str = r#"name = "v"
summary = "a bus"
source.assumed = "none"
[[body]]
name = "bus"
mass_kg = 100
centre_of_mass_m = [0, 0, 0]
inertia_kgm2 = { about = "centre-of-mass", axes = "body", xx = 10, yy = 11, zz = 12 }
"#;

/// A mount, a finger that opens from 10 deg, one that follows it, and one that follows that.
const HAND: &str = r#"<robot name="hand">
  <link name="palm"><inertial><mass value="2"/>
    <inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial></link>
  <link name="one"><inertial><mass value="1"/>
    <inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial></link>
  <link name="two"/>
  <link name="three"/>
  <joint name="three" type="continuous"><parent link="palm"/><child link="three"/>
    <axis xyz="0 0 1"/><mimic joint="two" multiplier="3" offset="0.25"/></joint>
  <joint name="one" type="revolute"><parent link="palm"/><child link="one"/><axis xyz="0 0 1"/>
    <limit lower="0.5" upper="1" effort="1" velocity="1"/></joint>
  <joint name="two" type="continuous"><parent link="palm"/><child link="two"/>
    <axis xyz="0 0 1"/><mimic joint="one" multiplier="2" offset="0.125"/></joint>
</robot>
"#;

/// The vehicle of a file beside others.
fn read(files: &[(&str, &str)], text: &str) -> Result<Vehicle, Vec<Complaint>> {
    let folder = TempDir::new().unwrap();
    for (name, text) in files {
        fs::write(folder.path().join(name), text).unwrap();
    }
    read_vehicle(folder.path().join("v.toml"), text)
}

fn with(more: &str) -> String {
    format!("{BUS}[[include]]\nvehicle = \"hand.urdf\"\n{more}\n")
}

/// The errors: message, name of the file, line.
fn errors(files: &[(&str, &str)], text: &str) -> Vec<(String, String, usize)> {
    let complaints = read(files, text).expect_err("an error");
    let told = complaints.iter().filter(|c| c.severity == Severity::Error).map(|c| {
        let start = c.span.as_ref().map_or(0, |span| span.start);
        let line = c.source.text[..start].matches('\n').count() + 1;
        let file = c.source.path.file_name().unwrap().to_string_lossy().into_owned();
        (c.message.clone(), file, line)
    });
    told.collect()
}

/// How far a link is turned about z from the bus (rad).
fn turn(vehicle: &Vehicle, link: &str) -> f64 {
    let R = vehicle.pose_on_body(link).unwrap().rotation;
    R.rows[1].x.atan2(R.rows[0].x)
}

#[test]
fn a_joint_that_is_fixed_stands_nearest_to_zero_and_its_followers_where_it_has_them() {
    // one at 0.5; two at 2 · 0.5 + 0.125; three at 3 · 1.125 + 0.25, less a whole turn or not.
    for fix in [r#"["*"]"#, r#"["one"]"#, r#"["t*", "one"]"#] {
        let text = with(&format!("on = \"bus\"\nfix = {fix}"));
        let vehicle = read(&[("hand.urdf", HAND)], &text).unwrap();
        assert!(vehicle.joint_names.is_empty(), "{fix}: {:?}", vehicle.joint_names);
        for (link, at) in [("one", 0.5), ("two", 1.125), ("three", 3.625 - std::f64::consts::TAU)] {
            let off = (turn(&vehicle, link) - at).abs();
            assert!(off < 1e-15 * 10.0, "{fix}: {link} is off by {off:e}");
        }
    }
}

#[test]
fn place_prefix_and_base_are_those_of_the_include() {
    let text = with(
        "on = \"bus\"\nposition_m = [1, 2, 3]\norientation.rpy_deg = [0, 0, 90]\nprefix = \"h_\"",
    );
    let one = HAND.find("<link name=\"one\"").unwrap()..HAND.find("<link name=\"two\"").unwrap();
    let like_one = |name: &str| HAND[one.clone()].replace("one", name);
    let massive = HAND
        .replace("<link name=\"two\"/>", &like_one("two"))
        .replace("<link name=\"three\"/>", &like_one("three"));
    let vehicle = read(&[("hand.urdf", &massive)], &text).unwrap();
    assert_eq!(vehicle.joint_names, ["h_three", "h_one", "h_two"]);
    let X = vehicle.pose_on_body("h_palm").unwrap();
    assert_eq!(X.translation.to_array(), [1.0, 2.0, 3.0]);
    assert!((turn(&vehicle, "h_palm") - std::f64::consts::FRAC_PI_2).abs() < 1e-15);
    let [three, two] = &vehicle.followers[..] else { panic!("{:?}", vehicle.followers) };
    assert_eq!((three.joint, three.leader, three.ratio, three.offset), (0, 1, 6.0, 0.625));
    assert_eq!((two.joint, two.leader, two.ratio, two.offset), (2, 1, 2.0, 0.125));
    // The hand is part of the bus but for what moves: 100 + 2 kg.
    assert_eq!(vehicle.robot.inertia(wrasse_dynamics::BodyId::Base).mass, 102.0);
}

#[test]
fn what_is_wrong_is_told_of_the_file_and_line_where_it_stands() {
    let hand = [("hand.urdf", HAND)];
    for (more, told, line) in [
        ("on = \"bos\"", "the parent 'bos', but no link has that name", 11),
        ("on = \"bus\"\nfix = [\"x*\"]", "no joint that moves is called 'x*'", 12),
        (
            "position_m = [0, 0, 1]\non = \"bus\"\nfix = [\"*\", \"?\"]",
            "no joint that moves is called '?'",
            13,
        ),
        ("position_m = [0, 0, 1]", "`position_m` says nothing without `on`", 11),
    ] {
        let errors = errors(&hand, &with(more));
        let at = (errors[0].1.as_str(), errors[0].2);
        assert!(errors[0].0.contains(told) && at == ("v.toml", line), "{errors:?}");
    }
    let wrong = HAND.replacen("value=\"1\"", "value=\"-1\"", 1);
    let of_mass = errors(&[("hand.urdf", &wrong)], &with("on = \"bus\""));
    assert!(of_mass.iter().any(|e| e.0.contains("found -1 kg") && e.1 == "hand.urdf" && e.2 == 4));
    let same = HAND.replace("\"palm\"", "\"bus\"");
    let twice = errors(&[("hand.urdf", &same)], &with("on = \"bus\""));
    assert!(twice[0].0.contains("two links are called 'bus'"), "{twice:?}");
    assert!(twice[0].0.contains("line 5 of ") && twice[0].1 == "hand.urdf" && twice[0].2 == 2);
    let broken = errors(&[("hand.urdf", "<robot name='r'>\n<link\n")], &with("on = \"bus\""));
    assert!(broken[0].0.contains("not XML") && broken[0].1 == "hand.urdf", "{broken:?}");
}

#[test]
fn files_that_include_one_another_end_with_a_complaint() {
    let include = |file: &str| {
        format!("{BUS}[[include]]\nvehicle = \"{file}\"\nprefix = \"p\"\non = \"bus\"\n")
    };
    let ring = errors(
        &[("v.toml", &include("w.toml")), ("w.toml", &include("v.toml"))],
        &include("w.toml"),
    );
    assert!(ring[0].0.contains("it includes itself"), "{ring:?}");
    let deep: Vec<_> =
        (0..70).map(|i| (format!("d{i}.toml"), include(&format!("d{}.toml", i + 1)))).collect();
    let files: Vec<_> = deep.iter().map(|(name, text)| (&**name, &**text)).collect();
    let told = errors(&files, &include("d0.toml"));
    assert!(told[0].0.contains("more than 8 files include one another"), "{told:?}");
    let one = |i| format!("[[include]]\nvehicle = \"h.toml\"\non = \"bus\"\nprefix = \"h{i}_\"\n");
    let many = (0..1000).map(one).collect::<Vec<_>>().concat();
    let told = errors(&[("h.toml", BUS)], &(BUS.to_owned() + &many));
    assert!(told[0].0.contains("made of more than 64 files"), "{told:?}");
}

/// A device never ends; what it holds is not asked for.
#[cfg(unix)]
#[test]
fn devices_folders_and_links_to_the_file_itself_are_not_included() {
    let text = |file: &str| format!("{BUS}[[include]]\nvehicle = \"{file}\"\n");
    let device = errors(&[], &text("/dev/zero"));
    assert!(device[0].0.contains("device"), "{device:?}");
    let folder = TempDir::new().unwrap();
    let file = folder.path().join("v.toml");
    fs::write(&file, text("link.toml")).unwrap();
    std::os::unix::fs::symlink(&file, folder.path().join("link.toml")).unwrap();
    let told = read_vehicle(file, text("link.toml")).expect_err("a ring");
    assert!(told[0].message.contains("it includes itself"), "{told:?}");
}

/// A bus includes a box of tools, which includes a hand: poses and prefixes go on, tools and postures come
/// along, and each number keeps its source.
#[test]
fn what_is_included_may_include() {
    let hinge = "[[joint]]\nname = \"lid\"\nkind = \"continuous\"\nparent = \"chest\"\nchild = \"cover\"\n\
                 position_m = [0, 0, 0]\naxis = [0, 0, 1]\n";
    let chest = BUS.replace("\"bus\"", "\"chest\"").replace("\"none\"", "\"a chest\"")
        + &BUS[BUS.find("[[body]]").unwrap()..].replace("\"bus\"", "\"cover\"")
        + hinge
        + "[[tool]]\nname = \"hook\"\non = \"cover\"\nposition_m = [0.5, 0, 0]\n\
           [[posture]]\nname = \"open\"\njoints_deg.lid = 30\n\
           [[include]]\nvehicle = \"hand.urdf\"\non = \"chest\"\nposition_m = [0, 2, 0]\nprefix = \"h_\"\n\
           fix = [\"*\"]\nsource.derived = \"a hand\"\n";
    let outer = format!(
        "{BUS}[[include]]\nvehicle = \"chest.toml\"\non = \"bus\"\nposition_m = [1, 0, 0]\n\
         orientation.rpy_deg = [0, 0, 90]\nprefix = \"c_\"\n"
    );
    let vehicle = read(&[("chest.toml", &chest), ("hand.urdf", HAND)], &outer).unwrap();
    assert_eq!(vehicle.joint_names, ["c_lid"]);
    assert_eq!(vehicle.tools, ["c_hook"]);
    assert!((vehicle.posture("c_open").unwrap().q[0] - 30_f64.to_radians()).abs() < 1e-15);
    // The hand stands 2 m along y of a chest that is turned by 90 deg: at 1 - 2 along x.
    let palm = vehicle.pose_on_body("c_h_palm").unwrap().translation;
    assert!((palm - wrasse_spatial::vec3(-1.0, 0.0, 0.0)).norm() < 1e-15, "{palm:?}");
    assert_eq!(vehicle.included.len(), 2);
    let sources: Vec<_> = vehicle.provenance.iter().map(|row| row.source.as_str()).collect();
    assert!(sources.contains(&"a chest") && sources.contains(&"a hand"), "{sources:?}");
}

/// A hand whose finger cannot be is refused, and taken where the include says why.
#[test]
fn an_include_accepts_what_cannot_be_for_a_reason() {
    let flat = HAND.replace("iyy=\"0.1\"", "iyy=\"0.9\"");
    let of = |more: &str| {
        read(&[("hand.urdf", &flat)], &with(&format!("on = \"bus\"\nfix = [\"t*\"]\n{more}")))
    };
    let refused = of("").unwrap_err();
    assert!(refused.iter().any(|c| c.message.contains("triangle inequality")), "{refused:?}");
    let vehicle = of("accept_nonphysical = \"as published\"").unwrap();
    let why = |c: &Complaint| c.help.as_deref().unwrap_or_default().contains("as published");
    let told = vehicle.remarks.iter().filter(|c| c.severity == Severity::Warning && why(c));
    assert_eq!(told.count(), 1, "{:?}", vehicle.remarks);
}
