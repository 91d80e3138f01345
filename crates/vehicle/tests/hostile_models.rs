//! Models that were made to break a reader: each has a clear complaint, in a time that grows with its
//! length and no faster.

#![allow(clippy::format_collect, reason = "the text of a large model, part by part")]

use std::sync::mpsc::channel;
use std::thread::spawn;
use std::time::Duration;
use wrasse_document::{Complaint, Severity};
use wrasse_vehicle::read_vehicle;

/// Enough for whatever grows with the square to take minutes.
const MANY: usize = 40_000;
/// All tests together took 9 s on two busy cores.
const PATIENCE: Duration = Duration::from_secs(20);

const MATTER: &str = r#"<inertial><mass value="1"/>
    <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>"#;

fn robot(parts: impl Iterator<Item = String>) -> String {
    let base = format!("<robot name=\"r\">\n<link name=\"b\">{MATTER}</link>\n");
    base + &parts.collect::<String>() + "</robot>"
}

fn joint(name: usize, parent: &str, child: &str, kind: &str, more: &str) -> String {
    format!(
        "<joint name=\"j{name}\" type=\"{kind}\"><parent link=\"{parent}\"/>\
         <child link=\"{child}\"/>{more}</joint>\n"
    )
}

fn link(name: usize) -> String {
    format!("<link name=\"l{name}\"/>\n")
}

/// The errors about a file, within the time that anybody waits.
fn errors(name: &'static str, text: &str) -> Vec<Complaint> {
    let (done, waiting) = channel();
    let text = text.to_owned();
    spawn(move || {
        // Nobody waits any more where this fails.
        let _ = done.send(read_vehicle(name, text).err().unwrap_or_default());
    });
    let told = waiting.recv_timeout(PATIENCE).expect("an answer in time, and no panic");
    told.into_iter().filter(|c| c.severity == Severity::Error).collect()
}

fn first(name: &'static str, text: &str) -> String {
    errors(name, text).first().map_or(String::new(), |complaint| complaint.message.clone())
}

#[test]
fn chains_forks_and_rings_of_any_length_are_told_in_time() {
    let chain = |reversed: bool, kind: &str| {
        let on = |i: usize| if i == 0 { "b".to_owned() } else { format!("l{}", i - 1) };
        let mut parts: Vec<_> =
            (0..MANY).map(|i| link(i) + &joint(i, &on(i), &format!("l{i}"), kind, "")).collect();
        if reversed {
            parts.reverse();
        }
        robot(parts.into_iter())
    };
    let fork = robot((0..MANY).map(|i| link(i) + &joint(i, "b", &format!("l{i}"), "fixed", "")));
    assert!(errors("fork.urdf", &fork).is_empty());
    assert!(errors("chain.urdf", &chain(false, "fixed")).is_empty());
    assert!(errors("chain.urdf", &chain(true, "fixed")).is_empty());
    let moving = first("chain.urdf", &chain(true, "continuous"));
    assert!(moving.starts_with("40000 moving joints"), "{moving}");
    let ring = robot((0..MANY).map(|i| {
        let on = format!("l{}", (i + 1) % MANY);
        link(i) + &joint(i, &on, &format!("l{i}"), "fixed", "")
    }));
    let told = errors("ring.urdf", &ring);
    assert_eq!(told.len(), 1, "{told:?}");
    assert!(told[0].message.contains("closes a loop") && told[0].message.len() < 300);
}

#[test]
fn names_that_nobody_has_are_told_in_time() {
    let children = robot((0..MANY).map(|i| joint(i, "b", &format!("none{i}"), "fixed", "")));
    assert_eq!(errors("unknown.urdf", &children).len(), MANY);
    let tags = robot((0..MANY).map(|i| format!("<tag{i}/>")));
    assert!(errors("tags.urdf", &tags).is_empty());
    let attributes = (0..MANY).map(|i| format!(" a{i}='1'")).collect::<String>();
    let crowded = format!("<robot name='r'{attributes}/>");
    assert!(first("crowded.urdf", &crowded).contains("more than 500 attributes"));
    let others = robot((0..MANY).map(|i| format!("<q:tag{i} xmlns:q=\"q\"/>")));
    assert!(errors("others.urdf", &others).is_empty());
}

#[test]
fn chains_and_rings_of_followers_are_told_in_time() {
    let all = |leader: &dyn Fn(usize) -> usize, last: &str| {
        robot((0..MANY).map(|i| {
            let mimic = format!("<mimic joint=\"j{}\"/>", leader(i));
            let kind = if i + 1 == MANY { last } else { "continuous" };
            link(i) + &joint(i, "b", &format!("l{i}"), kind, &mimic)
        }))
    };
    let ring = errors("ring.urdf", &all(&|i| (i + 1) % MANY, "continuous"));
    let rings = ring.iter().filter(|c| c.message.contains("follows itself")).count();
    assert_eq!(rings, 1, "one complaint of one ring");
    let chain = first("chain.urdf", &all(&|i| i + 1, "fixed"));
    assert_eq!(chain, "", "what follows a fixed joint is fixed");
    let unknown = errors("unknown.urdf", &all(&|i| i + MANY, "continuous"));
    assert!(unknown.iter().any(|c| c.message.contains("which is no joint")));
}

#[test]
fn bodies_classes_and_equalities_of_an_mjcf_are_told_in_time() {
    let bodies = (0..MANY / 4).map(|i| {
        format!("<body name='b{i}'><joint name='j{i}'/><geom size='1' class='c{i}'/></body>")
    });
    let classes = (0..MANY / 4).map(|i| format!("<default class='c{i}'/>"));
    let follow = (1..MANY / 4).map(|i| format!("<joint joint1='j{i}' joint2='j0'/>"));
    let text = format!(
        "<mujoco><default>{}</default><worldbody><body name='base'><freejoint/><geom size='1'/>{}\
         </body></worldbody><equality>{}</equality></mujoco>",
        classes.collect::<String>(),
        bodies.collect::<String>(),
        follow.collect::<String>()
    );
    assert!(first("many.mjcf", &text).starts_with("10000 moving joints"));
    let deep = "<body><geom size='1'/>".repeat(MANY) + &"</body>".repeat(MANY);
    let deep = format!("<mujoco><worldbody>{deep}</worldbody></mujoco>");
    assert!(errors("deep.mjcf", &deep).is_empty(), "one body in another, all fixed");
}

/// Entities are not expanded at all: a document type is refused.
#[test]
fn no_entity_is_expanded() {
    let bomb = "<!DOCTYPE r [<!ENTITY a 'aaaa'><!ENTITY b '&a;&a;'>]><robot name='&b;'/>";
    assert!(first("bomb.urdf", bomb).contains("DTD"));
    let outside = "<!DOCTYPE r [<!ENTITY x SYSTEM 'file:///etc/passwd'>]><robot name='&x;'/>";
    assert!(first("outside.urdf", outside).contains("DTD"));
}

#[test]
fn numbers_that_are_none_or_are_too_large_are_told_briefly() {
    let with = |mass: &str| {
        format!(
            "<robot name='r'><link name='a'>{}</link></robot>",
            MATTER.replacen("\"1\"", &format!("\"{mass}\""), 1)
        )
    };
    for (mass, told) in [
        ("1e999", "not finite"),
        ("nan", "not finite"),
        ("0x10", "not a number"),
        ("1,5", "not a number"),
        ("1.7e308", "beyond 1e40"),
        ("${m * 2}", "must be one number"),
        ("${m}", "a xacro expression"),
        (&"1".repeat(10_000), "not finite"),
        (&"x".repeat(10_000), "not a number"),
    ] {
        let errors = errors("number.urdf", &with(mass));
        let message = &errors[0].message;
        assert!(message.contains(told) && message.len() < 120, "{mass:.20}: {message:.200}");
    }
    let far =
        robot([link(0) + &joint(0, "b", "l0", "fixed", "<origin xyz=\"1e200 0 0\"/>")].into_iter());
    assert!(first("far.urdf", &far).contains("beyond 1e40"));
}

/// As many joints as a vehicle may have, two of three on nothing: some thousand postures are looked at.
#[test]
fn a_mass_matrix_that_is_hard_to_judge_is_judged_in_time() {
    let parts = (0..48).map(|i| {
        let on = if i == 0 { "b".to_owned() } else { format!("l{}", i - 1) };
        let axis = ["1 0 0", "0 1 0", "0 0 1"][i % 3];
        let matter = if i % 3 == 2 { MATTER } else { "" };
        let more =
            format!("<origin xyz=\"0.1 0.02 0.3\" rpy=\"0.3 0.2 0.1\"/><axis xyz=\"{axis}\"/>");
        format!("<link name=\"l{i}\">{matter}</link>\n")
            + &joint(i, &on, &format!("l{i}"), "continuous", &more)
    });
    let told = first("wrists.urdf", &robot(parts));
    assert!(told.is_empty() || told.contains("singular"), "{told}");
}
