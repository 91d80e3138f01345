//! A robot from a plain URDF file: enough to test the dynamics against outside data, no checks.

use roxmltree::{Document, Node};
use std::collections::BTreeMap;
use wrasse_dynamics::{BodyId, Frame, Joint, JointKind, MassProperties, Robot};
use wrasse_spatial::{Mat3, Pose, Sym3, Vec3, vec3};

/// Room for the joints of every golden vehicle.
pub(crate) const JOINTS: usize = 16;

/// A robot, and the names that the file gives to its joints and frames.
pub(crate) struct UrdfRobot {
    pub(crate) robot: Robot<f64, JOINTS>,
    pub(crate) joint_names: Vec<String>,
    pub(crate) frames: BTreeMap<String, Frame<f64>>,
}

/// Read a file whose root link is the base.
pub(crate) fn read(text: &str) -> UrdfRobot {
    let document = Document::parse(text).unwrap();
    let root = document.root_element();
    let named = |tag: &'static str| root.children().filter(move |n| n.has_tag_name(tag));
    let is_child = |link: &str| named("joint").any(|j| link_of(j, "child") == link);
    let base = named("link").map(|l| l.attribute("name").unwrap()).find(|l| !is_child(l)).unwrap();
    let (mut links, mut base_matter) = (vec![], MassProperties::default());
    let (mut joint_names, mut frames) = (vec![], BTreeMap::new());
    let mut waiting = vec![(base, BodyId::Base, Pose::identity())];
    while let Some((link, body, X_BL)) = waiting.pop() {
        frames.insert(link.to_owned(), Frame { body, X_BF: X_BL });
        let node = named("link").find(|l| l.attribute("name") == Some(link)).unwrap();
        let matter = matter(node).seen_from(&X_BL);
        match body {
            BodyId::Base => base_matter = base_matter.and(&matter),
            BodyId::Link(j) => {
                let (_, whole): &mut (Joint<f64>, MassProperties<f64>) = &mut links[j];
                *whole = whole.and(&matter);
            }
        }
        for joint in named("joint").filter(|j| link_of(*j, "parent") == link) {
            let (child, X_BC) = (link_of(joint, "child"), X_BL * origin(joint));
            let kind = match joint.attribute("type").unwrap() {
                "fixed" => {
                    waiting.push((child, body, X_BC));
                    continue;
                }
                "prismatic" => JointKind::Prismatic,
                _ => JointKind::Revolute,
            };
            let axis = joint.children().find(|n| n.has_tag_name("axis")).unwrap();
            let axis = numbers(axis.attribute("xyz").unwrap());
            waiting.push((child, BodyId::Link(links.len()), Pose::identity()));
            links.push((Joint::new(body, kind, X_BC, axis), MassProperties::default()));
            joint_names.push(joint.attribute("name").unwrap().to_owned());
        }
    }
    UrdfRobot { robot: Robot::new(base_matter, &links).unwrap(), joint_names, frames }
}

fn link_of<'a>(joint: Node<'a, '_>, end: &str) -> &'a str {
    let end = joint.children().find(|n| n.has_tag_name(end)).unwrap();
    end.attribute("link").unwrap()
}

fn numbers(text: &str) -> Vec3<f64> {
    let x: Vec<f64> = text.split_whitespace().map(|t| t.parse().unwrap()).collect();
    vec3(x[0], x[1], x[2])
}

/// Fixed-axis roll, pitch, yaw: `Rz(y) Ry(p) Rx(r)`.
fn rotation(rpy: Vec3<f64>) -> Mat3<f64> {
    let ((sr, cr), (sp, cp), (sy, cy)) = (rpy.x.sin_cos(), rpy.y.sin_cos(), rpy.z.sin_cos());
    Mat3::from_rows(
        vec3(cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr),
        vec3(sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr),
        vec3(-sp, cp * sr, cp * cr),
    )
}

fn origin(node: Node) -> Pose<f64> {
    let Some(origin) = node.children().find(|n| n.has_tag_name("origin")) else {
        return Pose::identity();
    };
    let read = |key| origin.attribute(key).map_or(Vec3::zero(), numbers);
    Pose::new(rotation(read("rpy")), read("xyz"))
}

/// What a link is made of, seen from the link's frame.
fn matter(link: Node) -> MassProperties<f64> {
    let Some(inertial) = link.children().find(|n| n.has_tag_name("inertial")) else {
        return MassProperties::default();
    };
    let child = |tag| inertial.children().find(|n| n.has_tag_name(tag)).unwrap();
    let number = |node: Node, key| node.attribute(key).unwrap().parse::<f64>().unwrap();
    let i = child("inertia");
    let I = Sym3 {
        xx: number(i, "ixx"),
        xy: number(i, "ixy"),
        xz: number(i, "ixz"),
        yy: number(i, "iyy"),
        yz: number(i, "iyz"),
        zz: number(i, "izz"),
    };
    let mass = number(child("mass"), "value");
    MassProperties::from_central(mass, Vec3::zero(), I).seen_from(&origin(inertial))
}
