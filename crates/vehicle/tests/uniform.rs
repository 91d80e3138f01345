//! Bodies of even density, as a vehicle file gives them.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

use wrasse_document::render;
use wrasse_dynamics::BodyId;
use wrasse_spatial::{Sym3, vec3};
use wrasse_testing::largest;
use wrasse_vehicle::{ShapeKind, Vehicle, read_vehicle};

/// A vehicle of one body.
fn text(body: &str) -> String {
    format!(
        "name = 'one'\nsummary = 'one'\nsource.assumed = 'a test'\n[[body]]\nname = 'bus'\n{body}\n"
    )
}

#[track_caller]
fn vehicle(body: &str) -> Vehicle {
    let vehicle = read_vehicle("one.toml", text(body));
    let vehicle = vehicle.unwrap_or_else(|why| panic!("{}", render(&why, false)));
    assert_eq!(render(&vehicle.remarks, false), "");
    vehicle
}

/// The body gives one error, which says all these words.
#[track_caller]
fn assert_says(body: &str, words: &[&str]) {
    let complaints = read_vehicle("one.toml", text(body)).expect_err("a complaint");
    let said = render(&complaints, false);
    for word in words {
        assert!(said.contains(word), "no `{word}` in\n{said}");
    }
    assert!(said.ends_with("\n1 error\n"), "not one error:\n{said}");
}

fn central(vehicle: &Vehicle) -> Sym3<f64> {
    vehicle.robot.inertia(BodyId::Base).central()
}

#[track_caller]
fn assert_close(found: Sym3<f64>, expected: [f64; 6]) {
    let found = [found.xx, found.yy, found.zz, found.xy, found.xz, found.yz];
    let off = largest(found.iter().zip(expected).map(|(a, b)| (a - b).abs()));
    assert!(off < 2e-15, "{off:e}: {found:?}");
}

#[test]
fn a_box_has_its_mass_its_middle_and_its_outline() {
    let bus = vehicle("mass_kg = 6\nuniform = { box_m = [1, 1, 2], position_m = [0, 0, 1] }");
    let M = bus.robot.inertia(BodyId::Base);
    assert_eq!(M.mass, 6.0);
    // 6/12 (1 + 4), and 6/12 (1 + 1).
    assert_close(central(&bus), [2.5, 2.5, 1.0, 0.0, 0.0, 0.0]);
    let [shape] = &bus.shapes[..] else { panic!("{:?}", bus.shapes) };
    assert_eq!(shape.kind, ShapeKind::Box(vec3(1.0, 1.0, 2.0)));
    assert_eq!(shape.frame.X_BF.translation, vec3(0.0, 0.0, 1.0));
}

#[test]
fn orientation_turns_inertia_and_outline() {
    // A rod along x: a cylinder of 0.1 m radius and 2 m length. m r²/2, m (3 r² + l²)/12.
    let rod = "mass_kg = 3\nuniform = { cylinder = { radius_m = 0.1, length_m = 2 }, \
               orientation.rpy_deg = [0, 90, 0] }";
    let rod = vehicle(rod);
    assert_close(central(&rod), [0.015, 1.0075, 1.0075, 0.0, 0.0, 0.0]);
    let along = rod.shapes[0].frame.X_BF.rotation * vec3(0.0, 0.0, 1.0);
    assert_eq!(along, vec3(1.0, 0.0, 0.0));
}

#[test]
fn a_turn_that_is_no_quarter_gives_products_of_inertia() {
    let plate = "mass_kg = 12\nuniform = { box_m = [2, 1, 1], orientation.rpy_deg = [0, 0, 45] }";
    // Moments 2, 5, 5 about its own axes; turned by 45 deg: the mean, and half the difference.
    assert_close(central(&vehicle(plate)), [3.5, 3.5, 5.0, -1.5, 0.0, 0.0]);
}

#[test]
fn a_hollow_sphere_lies_between_ball_and_shell() {
    let of = |wall: &str| {
        let body = format!("mass_kg = 10\nuniform = {{ sphere_radius_m = 0.3{wall} }}");
        central(&vehicle(&body)).xx
    };
    let (ball, hollow, shell) = (of(""), of(", wall_m = 0.1"), of(", wall_m = 1e-6"));
    assert_eq!(ball, 0.36);
    // 2/5 m (R⁵ − r⁵)/(R³ − r³) with R = 0.3, r = 0.2.
    assert!((hollow - 4.0 * 0.002_11 / 0.019).abs() < 1e-15, "{hollow}");
    assert!((shell - 0.6).abs() < 3e-6, "2/3 m R²: {shell}");
}

#[test]
fn a_shape_of_the_bodys_own_is_drawn_at_the_middle_of_its_mass() {
    let body = "mass_kg = 6\nuniform = { sphere_radius_m = 0.3, position_m = [1, 0, 0] }\n\
                shape = [{ box_m = [2, 2, 2] }]";
    let [shape] = &vehicle(body).shapes[..] else { panic!("one shape") };
    assert_eq!(shape.kind, ShapeKind::Box(vec3(2.0, 2.0, 2.0)));
    assert_eq!(shape.frame.X_BF.translation, vec3(1.0, 0.0, 0.0));
}

#[test]
fn what_contradicts_a_uniform_body_is_refused() {
    let uniform = "uniform = { box_m = [1, 1, 2] }";
    assert_says(uniform, &["has `uniform`, but not `mass_kg`", "of what mass?"]);
    assert_says(
        &format!("mass_kg = 1\ncentre_of_mass_m = [0, 0, 0]\n{uniform}"),
        &["body 'bus' has `uniform` and `centre_of_mass_m`", "leave one of them out"],
    );
    let inertia = "inertia_kgm2 = { about = 'origin', axes = 'body', xx = 1, yy = 1, zz = 1 }";
    assert_says(
        &format!("mass_kg = 1\n{inertia}\n{uniform}"),
        &["body 'bus' has `uniform` and `inertia_kgm2`", "said twice"],
    );
}

#[test]
fn a_uniform_body_is_one_shape_with_sizes() {
    assert_says("mass_kg = 1\nuniform = {}", &["`uniform` of 'bus' has 0 outlines, must have one"]);
    let two = "mass_kg = 1\nuniform = { box_m = [1, 1, 1], sphere_radius_m = 1 }";
    assert_says(two, &["has 2 outlines"]);
    let flat = "mass_kg = 1\nuniform = { box_m = [1, 0, 1] }";
    assert_says(flat, &["`uniform` of 'bus' has a size of 0 m"]);
}

#[test]
fn a_wall_is_inside_its_outline() {
    for (shape, most) in [
        ("box_m = [1, 0.2, 3]", "0.1 m"),
        ("cylinder = { radius_m = 1, length_m = 0.5 }", "0.25 m"),
        ("cylinder = { radius_m = 0.1, length_m = 2 }", "0.1 m"),
        ("sphere_radius_m = 0.3", "0.3 m"),
    ] {
        for wall in ["1", "0", "-0.1"] {
            let body = format!("mass_kg = 1\nuniform = {{ {shape}, wall_m = {wall} }}");
            let words = [&format!("at most half of its smallest size, {most}")[..], "this wall"];
            assert_says(&body, &words);
        }
    }
    vehicle("mass_kg = 1\nuniform = { sphere_radius_m = 0.3, wall_m = 0.3 }");
}

#[test]
fn a_quaternion_that_is_none_is_told_once() {
    let quaternion = "orientation.quaternion = { w = 2, x = 0, y = 0, z = 0 }";
    let body = format!("mass_kg = 1\nuniform = {{ sphere_radius_m = 1, {quaternion} }}");
    assert_says(&body, &["a quaternion must have length 1, found 2"]);
}

#[test]
fn the_source_of_a_uniform_body_is_its_own_number() {
    let body =
        "mass_kg = 1\nuniform = { sphere_radius_m = 1 }\nsource_of.uniform.assumed = 'a ball'";
    assert!(vehicle(body).provenance.iter().any(|row| row.of == "body.bus.uniform"));
}
