//! Each finding of a deep check from just beyond its bound, and nothing from just within it.

use std::fmt::Write;
use wrasse_document::Severity;
use wrasse_vehicle::{DeepCheck, Finding, FindingKind, Vehicle, catalogue, read_vehicle};

const BUS: &str = r#"<link name="bus"><inertial><mass value="1000"/>
  <inertia ixx="1000" iyy="1000" izz="1000" ixy="0" ixz="0" iyz="0"/></inertial></link>"#;
/// A sound tool behind the link that is looked at: a cube of 0.2 m.
const TOOL: &str = r#"<link name="tool"><inertial><mass value="8"/>
  <inertia ixx="0.0533" iyy="0.0533" izz="0.0533" ixy="0" ixz="0" iyz="0"/></inertial>
  <visual><geometry><box size="0.2 0.2 0.2"/></geometry></visual></link>"#;

fn vehicle(inside: &str) -> Vehicle {
    let text = format!("<robot name='model'>{BUS}{inside}</robot>");
    read_vehicle("model.urdf", text).unwrap_or_else(|complaints| panic!("{complaints:?}"))
}

/// The link `part` between bus and tool.
struct Part {
    size: Option<[f64; 3]>,
    mass: f64,
    /// Mean squares of the distances from the centre of mass along x, y, z (m²).
    spread: [f64; 3],
    /// Turn of the tensor about z (rad), and its centre of mass (m).
    yaw: f64,
    p_cm: [f64; 3],
    /// Where the tool's joint is (m).
    next: f64,
    /// Limits of the joint of the part.
    limits: &'static str,
}

/// An even cube of 1 m and 200 kg.
fn cube() -> Part {
    let (size, spread) = (Some([1.0; 3]), [1.0 / 12.0; 3]);
    Part { size, mass: 200.0, spread, yaw: 0.0, p_cm: [0.0; 3], next: 0.5, limits: "" }
}

impl Part {
    fn vehicle(&self) -> Vehicle {
        let Self { mass, spread: [x, y, z], yaw, p_cm: [a, b, c], next, limits, .. } = *self;
        let kind = if limits.is_empty() { "continuous" } else { "revolute" };
        let drawn = self.size.map_or(String::new(), |[x, y, z]| {
            format!("<visual><geometry><box size='{x} {y} {z}'/></geometry></visual>")
        });
        vehicle(&format!(
            "<link name='part'><inertial><origin xyz='{a} {b} {c}' rpy='0 0 {yaw}'/>\
             <mass value='{mass}'/>\n<inertia ixx='{}' iyy='{}' izz='{}' ixy='0' ixz='0' iyz='0'/>\
             </inertial>{drawn}</link>{TOOL}\
             <joint name='first' type='{kind}'><parent link='bus'/><child link='part'/>{limits}\
             <axis xyz='0 0 1'/></joint>\
             <joint name='second' type='continuous'><parent link='part'/><child link='tool'/>\
             <origin xyz='{next} 0 0'/><axis xyz='0 1 0'/></joint>",
            mass * (y + z),
            mass * (z + x),
            mass * (x + y)
        ))
    }
    /// The findings about the part and its joint.
    #[track_caller]
    fn kinds(&self) -> Vec<FindingKind> {
        kinds(&self.vehicle().deep_check())
    }
    /// The same with all spreads so many times as large.
    fn spread_by(mut self, factor: f64) -> Self {
        self.spread = self.spread.map(|spread| spread * factor);
        self
    }
    /// Warnings of the plain check about inertia and shape.
    fn plain(&self) -> usize {
        let remarks = self.vehicle().remarks;
        let told = remarks.iter().filter(|remark| remark.message.contains("its shape"));
        told.filter(|remark| remark.severity == Severity::Warning && remark.span.is_some()).count()
    }
}

fn kinds(check: &DeepCheck) -> Vec<FindingKind> {
    check.findings.iter().map(|found| found.kind).collect()
}

#[track_caller]
fn only(check: &DeepCheck) -> &Finding {
    let [finding] = &check.findings[..] else { panic!("{:?}", check.findings) };
    finding
}

#[test]
fn an_even_cube_is_fine_and_every_check_says_what_it_looked_at() {
    let check = cube().vehicle().deep_check();
    assert_eq!(check.findings, []);
    let fine: Vec<_> = check.fine.iter().map(|fine| fine.kind).collect();
    let expected = [
        FindingKind::UnitSlip,
        FindingKind::InertiaBeyondShape,
        FindingKind::GyrationAgainstSize,
        FindingKind::Density,
        FindingKind::Asymmetry,
        FindingKind::MassMatrixCondition,
    ];
    assert_eq!(fine, expected);
}

/// Matter in a cube of 1 m has at most a spread of 0.25 m² along an edge; 1.05² is allowed to it.
#[test]
fn more_spread_than_the_shape_holds_is_told() {
    for (spread, told) in [(0.273, &[][..]), (0.278, &[FindingKind::InertiaBeyondShape])] {
        assert_eq!(Part { spread: [spread; 3], ..cube() }.kinds(), told, "{spread}");
    }
    // Off the middle there is less room: 0.7 times 0.3, 0.21 m², times 1.05².
    for (spread, told) in [(0.229, &[][..]), (0.234, &[FindingKind::InertiaBeyondShape])] {
        let part = Part { p_cm: [0.2, 0.0, 0.0], spread: [spread, 0.1, 0.1], ..cube() };
        assert_eq!(part.kinds(), told, "{spread}");
    }
}

/// The farthest corner of the cube is 0.866 m from its middle, times 1.5: 1.299 m.
#[test]
fn a_gyration_beyond_the_farthest_corner_is_a_plain_warning() {
    for (gyration, warnings) in [(1.29_f64, 0), (1.31, 1)] {
        let part = Part { spread: [0.5 * gyration * gyration; 3], ..cube() };
        assert_eq!(part.plain(), warnings, "{gyration}");
    }
}

/// A part that a mesh draws too is not judged by its box, nor one that a box is fixed to.
#[test]
fn what_else_is_drawn_of_a_body_keeps_the_warnings_away() {
    let part = Part { spread: [2.0; 3], ..cube() }.vehicle();
    let text = part.text;
    assert!(part.remarks.iter().any(|remark| remark.message.contains("beyond its shape")));
    let mesh = "<visual><geometry><mesh filename='part.stl'/></geometry></visual></link>";
    let panel = "</link><link name='panel'><visual><origin xyz='3 0 0'/><geometry>\
                 <box size='1 1 1'/></geometry></visual></link>\
                 <joint name='glue' type='fixed'><parent link='part'/><child link='panel'/></joint>";
    for more in [mesh, panel] {
        let at = text.find("<link name=\"tool\"").expect("the tool");
        let before = text[..at].strip_suffix("</link>").expect("the end of the part");
        let vehicle = read_vehicle("more.urdf", format!("{before}{more}{}", &text[at..])).unwrap();
        let about_shape = vehicle.remarks.iter().filter(|r| r.message.contains("its shape"));
        assert_eq!(about_shape.count(), 0, "{more}");
    }
}

#[test]
fn a_long_tensor_across_a_long_shape_is_told() {
    let long = |length: f64, ratio: f64, yaw: f64| Part {
        size: Some([length, 1.0, 1.0]),
        spread: [0.2 / ratio, 0.2, 0.2 / ratio],
        yaw,
        ..cube()
    };
    let across = &[FindingKind::InertiaAcrossShape][..];
    // Lengths of shape and tensor in the ratio 2 at least, to tell; 3 at least, to warn.
    for (length, ratio, told, warnings) in [
        (3.2, 3.9, &[][..], 0),
        (3.2, 4.1, across, 0),
        (1.95, 16.0, &[], 0),
        (2.05, 16.0, across, 0),
        (3.2, 8.9, across, 0),
        (3.2, 9.1, across, 1),
        (2.95, 16.0, across, 0),
        (3.05, 16.0, across, 1),
    ] {
        let part = long(length, ratio, 0.0);
        assert_eq!((part.kinds(), part.plain()), (told.to_vec(), warnings), "{length} {ratio}");
    }
    // Turned back by so much, the tensor is 90 degrees less that from the shape's long axis.
    for (back, told, warnings) in
        [(29.0, across, 1), (31.0, across, 0), (59.0, across, 0), (61.0, &[][..], 0)]
    {
        let part = long(3.2, 16.0, f64::to_radians(back));
        assert_eq!((part.kinds(), part.plain()), (told.to_vec(), warnings), "{back}");
    }
}

/// A quarter of the gyration of an even cube is a sixteenth of its spread.
#[test]
fn far_less_inertia_than_the_shape_has_is_told() {
    assert_eq!(cube().spread_by(1.0 / 15.5).kinds(), []);
    assert_eq!(cube().spread_by(1.0 / 16.5).kinds(), [FindingKind::InertiaBelowShape]);
}

/// The farthest joint is 1 m from the centre of mass.
#[test]
fn a_gyration_out_of_proportion_to_the_joints_is_told() {
    for (gyration, is_told) in [(4.9_f64, false), (5.1, true), (0.031, false), (0.029, true)] {
        // Bricks: the ellipsoid of inertia has the density of wood.
        let mass = 500.0 * 4.19 * (2.5 * gyration * gyration).powf(1.5);
        let spread = [0.5 * gyration * gyration; 3];
        let part = Part { size: None, mass, spread, next: 1.0, ..cube() };
        let told = part.kinds().contains(&FindingKind::GyrationAgainstSize);
        assert_eq!(told, is_told, "{gyration}");
    }
}

#[test]
fn a_mass_that_its_volume_contradicts_is_told() {
    for (mass, told) in [
        (4.9, &[FindingKind::Density][..]),
        (5.1, &[]),
        (22_500.0, &[]),
        (22_700.0, &[FindingKind::Density]),
        (99_000.0, &[FindingKind::Density]),
        // As grams it is a part of 101 kg/m³.
        (101_000.0, &[FindingKind::UnitSlip]),
    ] {
        assert_eq!(Part { mass, ..cube() }.kinds(), told, "{mass}");
    }
    // Without a shape its ellipsoid of inertia has 1.127 m³.
    for (mass, told) in [(5.5, &[FindingKind::Density][..]), (5.8, &[])] {
        assert_eq!(Part { size: None, mass, ..cube() }.kinds(), told, "{mass}");
    }
}

/// Usual is half of 0.866 m: gyrations in the ratio of units, and within a factor of 3 of it.
#[test]
fn inertia_in_another_unit_is_told_and_says_which() {
    for (ratio, unit) in [
        (10.4, None),
        (10.7, Some("g·m²")),
        (94.0, Some("g·m²")),
        (96.0, None),
        (330.0, None),
        (340.0, Some("kg·mm²")),
        (3.0e4, Some("g·mm²")),
        (1e-3, Some("in mm")),
        (1.0 / 31.6, Some("mass in g")),
    ] {
        let gyration: f64 = ratio * 0.5 * 0.75f64.sqrt();
        let part = Part { spread: [0.5 * gyration * gyration; 3], ..cube() };
        let check = part.vehicle().deep_check();
        let slip = check.findings.iter().find(|found| found.kind == FindingKind::UnitSlip);
        assert_eq!(slip.is_some(), unit.is_some(), "{ratio}: {:?}", check.findings);
        let Some((slip, unit)) = slip.zip(unit) else { continue };
        assert!(slip.message.contains(unit), "{ratio}: {}", slip.message);
        // What follows from it is not told beside it.
        let of_part = check.findings.iter().filter(|found| found.subject == "part");
        assert_eq!(of_part.count(), 1, "{:?}", check.findings);
        let place = slip.place.as_ref().expect("the inertia's place");
        assert_eq!(place.to_string(), "model.urdf:3");
        assert_eq!(place.source.text.get(place.span.start..place.span.start + 7), Some("inertia"));
    }
}

#[test]
fn places_in_millimetres_are_told() {
    // 1 kg of the density of wood, with a gyration of 0.0336 m: 300 times that is 10.08 m.
    let at = |x: f64, gyration: f64| Part {
        size: None,
        mass: 1.0,
        spread: [0.5 * gyration * gyration; 3],
        p_cm: [x, 0.0, 0.0],
        ..cube()
    };
    let slips = |part: &Part| part.kinds().contains(&FindingKind::UnitSlip);
    assert!(!slips(&at(9.9, 0.03)) && !slips(&at(10.05, 0.0336)) && slips(&at(10.1, 0.0336)));
    for (long, told) in [(9.9, false), (10.1, true)] {
        let mut inside = TOOL.replace("tool", "k0");
        inside +=
            "<joint name='j0' type='continuous'><parent link='bus'/><child link='k0'/></joint>";
        for (k, x) in [(1, 0.03), (2, 0.03), (3, long), (4, 0.03)] {
            inside += &TOOL.replace("tool", &format!("k{k}"));
            let _ = write!(
                inside,
                "<joint name='j{k}' type='continuous'><parent link='k{}'/><child link='k{k}'/>\
                 <origin xyz='{x} 0 0'/></joint>",
                k - 1
            );
        }
        let check = vehicle(&inside).deep_check();
        let slip = check.findings.iter().find(|found| found.kind == FindingKind::UnitSlip);
        assert_eq!(slip.map(|found| &*found.subject), told.then_some("j3"), "{:?}", check.findings);
    }
}

#[test]
fn limits_in_degrees_are_told() {
    for (limits, told) in [
        ("<limit lower='-90' upper='135' effort='9' velocity='1'/>", Some("in degrees")),
        ("<limit lower='-12' upper='12' effort='9' velocity='1'/>", None),
        ("<limit lower='-13' upper='13' effort='9' velocity='1'/>", Some("in degrees")),
        ("<limit lower='-90.5' upper='135.5' effort='9' velocity='1'/>", None),
        ("<limit lower='-0.0274' upper='0.0274' effort='9' velocity='1'/>", Some("twice")),
        ("<limit lower='-0.052' upper='0.052' effort='9' velocity='1'/>", Some("twice")),
        ("<limit lower='-0.053' upper='0.053' effort='9' velocity='1'/>", None),
        ("<limit lower='-1' upper='1' effort='9' velocity='57.2'/>", None),
        ("<limit lower='-1' upper='1' effort='9' velocity='57.4'/>", Some("deg/s")),
        ("<limit lower='-1' upper='1' effort='9' velocity='1000'/>", None),
    ] {
        let check = Part { limits, ..cube() }.vehicle().deep_check();
        let Some(part) = told else {
            assert_eq!(check.findings, [], "{limits}");
            continue;
        };
        let finding = only(&check);
        assert_eq!((finding.kind, &*finding.subject), (FindingKind::UnitSlip, "first"));
        assert!(finding.message.contains(part), "{}", finding.message);
    }
}

/// Two arms of two links, mirrored in y; what the second differs in is put in its place.
fn two_arms(names: [&str; 2], differ: [&str; 2]) -> DeepCheck {
    let mut inside = String::new();
    for (side, name) in [(1.0, names[0]), (-1.0, names[1])] {
        let arm = format!(
            "<link name='{name}upper'><inertial><origin xyz='0.2 {y} 0'/><mass value='8'/>\
             <inertia ixx='0.2' iyy='0.3' izz='0.4' ixy='0' ixz='0' iyz='0'/></inertial></link>\
             <link name='{name}fore'><inertial><mass value='8'/>\
             <inertia ixx='0.2' iyy='0.3' izz='0.4' ixy='0' ixz='0' iyz='0'/></inertial></link>\
             <joint name='{name}shoulder' type='revolute'><parent link='bus'/>\
             <child link='{name}upper'/><origin xyz='0 {side} 0'/><axis xyz='0 0 1'/>\
             <limit lower='{lower}' upper='{upper}' effort='9' velocity='1'/></joint>\
             <joint name='{name}elbow' type='revolute'><parent link='{name}upper'/>\
             <child link='{name}fore'/><origin xyz='0.5 0 0'/><axis xyz='0 1 0'/>\
             <limit lower='-1' upper='1' effort='9' velocity='1'/></joint>",
            y = 0.02 * side,
            lower = if side > 0.0 { -0.5 } else { -1.5 },
            upper = if side > 0.0 { 1.5 } else { 0.5 },
        );
        inside += &if side < 0.0 { arm.replacen(differ[0], differ[1], 1) } else { arm };
    }
    vehicle(&inside).deep_check()
}

#[test]
fn arms_that_mirror_each_other_and_differ_are_told_by_name_and_by_geometry() {
    for names in [["left_", "right_"], ["one_", "other_"]] {
        let same = two_arms(names, ["", ""]);
        assert_eq!(same.findings, []);
        let fine = same.fine.iter().find(|fine| fine.kind == FindingKind::Asymmetry).unwrap();
        assert!(fine.numbers[0].1 > 0.0, "{fine:?}");
        for (differ, what) in [
            (["mass value='8'", "mass value='8.17'"], "mass (kg) 8 and 8.17"),
            (["izz='0.4'", "izz='0.41'"], "largest moment (kg·m²) 0.4 and 0.41"),
            (["xyz='0.2 -0.02 0'", "xyz='0.3 -0.02 0'"], "distance of the centre of mass"),
            (["lower='-1.5'", "lower='-1.6'"], "lower end (rad or m) -0.5 and -1.6"),
            (["effort='9'", "effort='9.2'"], "effort limit 9 and 9.2"),
            (["velocity='1'", "velocity='2'"], "rate limit 1 and 2"),
        ] {
            let check = two_arms(names, differ);
            let finding = only(&check);
            assert_eq!(finding.kind, FindingKind::Asymmetry);
            assert!(finding.message.contains(what), "{}", finding.message);
            assert!(finding.subject.contains(names[1]), "{}", finding.subject);
        }
        // Rounding of drawings.
        assert_eq!(two_arms(names, ["mass value='8'", "mass value='8.15'"]).findings, []);
    }
    // Chains of other lengths are not made alike.
    let other = two_arms(["one_", "other_"], ["xyz='0.5 0 0'", "xyz='0.51 0 0'"]);
    assert_eq!(other.findings, []);
}

/// A piece of so little inertia between two joints on one axis: the two rows nearly agree.
#[test]
fn a_mass_matrix_that_is_near_singular_is_told_above_its_bound() {
    let check = |between: f64| {
        vehicle(&format!(
            "<link name='piece'><inertial><mass value='0.1'/><inertia ixx='{between}' iyy='{between}' \
             izz='{between}' ixy='0' ixz='0' iyz='0'/></inertial></link>{TOOL}\
             <joint name='a' type='continuous'><parent link='bus'/><child link='piece'/></joint>\
             <joint name='b' type='continuous'><parent link='piece'/><child link='tool'/></joint>"
        ))
        .deep_check()
    };
    let mut told = vec![];
    for between in [3e-7, 2.2e-7, 2.0e-7, 1e-7] {
        let check = check(between);
        let found = check.findings.iter().find(|f| f.kind == FindingKind::MassMatrixCondition);
        let fine = check.fine.iter().find(|f| f.kind == FindingKind::MassMatrixCondition);
        let numbers = found.map(|f| &f.numbers).or(fine.map(|f| &f.numbers)).unwrap();
        assert_eq!(found.is_some(), numbers[0].1 > 1e6, "{between}: {numbers:?}");
        assert_eq!(numbers[1], ("postures", 411.0));
        told.push(found.is_some());
    }
    assert_eq!(told, [false, false, true, true]);
}

/// What a deep check says of the catalogue: outlines that leave out what the published tensors hold.
#[test]
fn the_catalogue_is_found_fine_but_for_outlines_that_leave_out_parts() {
    let mut told = String::new();
    for entry in catalogue() {
        let check = entry.read().expect("the catalogue reads").deep_check();
        for found in check.findings {
            let _ = writeln!(told, "{} {} {}", entry.name, found.kind.word(), found.subject);
        }
    }
    let of_etsvii = |name: &str| {
        ["base", "link1", "link2", "link3", "link6"]
            .map(|link| format!("{name} inertia_beyond_shape {link}\n"))
            .concat()
    };
    let of_station = |name: &str| format!("{name} inertia_beyond_shape station\n");
    let expected = [
        of_etsvii("etsvii"),
        of_etsvii("etsvii-repaired"),
        of_station("ssrms"),
        of_station("dextre-class"),
        of_station("era-class"),
        of_station("jemrms-class"),
    ];
    assert_eq!(told, expected.concat());
}
