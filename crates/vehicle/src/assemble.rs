//! From named links and joints to a checked robot: links that are fixed to each other become one
//! body, seen from the frame of the link that the moving joint carries.

use crate::assembly::{Assembly, AssemblyJoint, Link, Matter};
use crate::check::{
    Edge, Regularity, Tree, check_body, check_joint, check_numbers, check_single_links,
    doubt_joint, doubt_mass, doubt_matter, regularity, tree,
};
use crate::figures::figures;
use crate::findings::Findings;
use crate::followers::{followers, settle_followers};
use crate::vehicle::{Follower, GraspBounds, JOINTS, LinkMatter, NamedFrame, VehicleRobot};
use wrasse_document::Complaint;
use wrasse_dynamics::{BodyId, Frame, Joint, JointKind, MassProperties};
use wrasse_hardware::JointLimits;
use wrasse_spatial::Pose;

/// A robot, and the names that belong to it.
#[derive(Debug)]
pub(crate) struct AssembledRobot {
    pub(crate) robot: VehicleRobot,
    /// Names of the moving joints, in the robot's order: the file's, parents before children.
    pub(crate) joint_names: Vec<String>,
    /// Their limits.
    pub(crate) limits: Vec<JointLimits<f64>>,
    /// Those of them that follow another one.
    pub(crate) followers: Vec<Follower>,
    /// Every link as a frame of the body that it belongs to, in the order of the file.
    pub(crate) frames: Vec<NamedFrame>,
    /// The matter of each link that has any, in its own frame.
    pub(crate) matter: Vec<LinkMatter>,
    /// Values that are possible but implausible, or impossible and accepted.
    pub(crate) warnings: Vec<Complaint>,
}

/// The robot of these links and joints.
///
/// # Errors
/// All complaints at once, warnings among them, if the links are no tree or no matter can be so.
pub(crate) fn assemble(assembly: &Assembly) -> Result<AssembledRobot, Vec<Complaint>> {
    let mut found = Findings::within(&assembly.files);
    let links = &assembly.links;
    let mut numbers = true;
    for link in links {
        numbers &= check_numbers(link, &mut found);
    }
    let joints = &settle_followers(assembly.joints.clone(), &mut found);
    for joint in joints {
        check_joint(joint, &mut found);
        doubt_joint(joint, &mut found);
    }
    let tree = tree(links, joints, &mut found);
    let moving = joints.iter().filter(|j| j.kind.is_some()).count();
    if let Some(first_too_many) = joints.iter().filter(|j| j.kind.is_some()).nth(JOINTS) {
        let message = format!("{moving} moving joints: a vehicle has at most {JOINTS}");
        let help = "fix the joints that do not move in this study: `fix = [\"finger*\"]` in an \
                    [[include]] of this file";
        found.error(&first_too_many.at, message, "one too many", help);
    }
    let Some(tree) = tree.filter(|_| moving <= JOINTS && numbers) else {
        check_single_links(links, joints, &mut found);
        return Err(found.into_complaints());
    };
    let parts = Parts::of(&tree, links, joints);
    parts.check_masses(&tree, links, joints, &mut found);
    parts.into_robot(links, joints, found)
}

/// Bodies in the making.
struct Parts {
    /// Where each link is on its body.
    frames: Vec<Frame<f64>>,
    /// Matter of the base, then of what each moving joint carries.
    matter: Vec<MassProperties<f64>>,
    /// Moving joints, parents before children, and the body that each is mounted on.
    moving: Vec<(Edge, BodyId, Pose<f64>)>,
}

impl Parts {
    fn of(tree: &Tree, links: &[Link], joints: &[AssemblyJoint]) -> Self {
        let root = Frame { body: BodyId::Base, X_BF: Pose::identity() };
        let mut parts = Self {
            frames: vec![root; links.len()],
            matter: vec![MassProperties::default()],
            moving: vec![],
        };
        for &edge in &tree.order {
            let joint = &joints[edge.joint];
            let on = parts.frames[edge.parent];
            let X_PC = on.X_BF * joint.X_PC;
            parts.frames[edge.child] = if joint.kind.is_none() {
                Frame { body: on.body, X_BF: X_PC }
            } else {
                parts.moving.push((edge, on.body, X_PC));
                parts.matter.push(MassProperties::default());
                Frame { body: BodyId::Link(parts.moving.len() - 1), X_BF: Pose::identity() }
            };
        }
        for (link, frame) in links.iter().zip(&parts.frames) {
            if let Some(m) = &link.matter {
                let matter =
                    MassProperties::from_central(m.mass, m.p_cm, m.inertia).seen_from(&frame.X_BF);
                let body = &mut parts.matter[place(frame.body)];
                *body = body.and(&matter);
            }
        }
        parts
    }

    /// Complains of bodies that cannot be, and warns of what is implausible.
    fn check_masses(
        &self,
        tree: &Tree,
        links: &[Link],
        joints: &[AssemblyJoint],
        found: &mut Findings,
    ) {
        for (link, frame) in links.iter().zip(&self.frames) {
            doubt_matter(link, frame.body, found);
        }
        let mut of_body: Vec<Vec<(&Link, &Matter)>> = vec![vec![]; self.matter.len()];
        for (link, frame) in links.iter().zip(&self.frames) {
            let matter = link.matter.as_ref();
            of_body[place(frame.body)].extend(matter.map(|matter| (link, matter)));
        }
        for (parts, matter) in of_body.iter().zip(&self.matter) {
            check_body(parts, &matter.M_F_F, found);
        }
        let whole: f64 = self.matter.iter().map(|m| m.M_F_F.mass).sum();
        if whole <= 0.0 {
            let root = &links[tree.root];
            let message = "nothing in this file has mass".to_owned();
            found.error(&root.at, message, "the base", "give it mass, centre of mass and inertia");
        }
        for (j, (edge, ..)) in self.moving.iter().enumerate() {
            doubt_mass(&joints[edge.joint], self.matter[j + 1].M_F_F.mass, whole, found);
        }
    }

    fn into_robot(
        self,
        links: &[Link],
        joints: &[AssemblyJoint],
        mut found: Findings,
    ) -> Result<AssembledRobot, Vec<Complaint>> {
        if !found.without_error() {
            return Err(found.into_complaints());
        }
        let mut carried = Vec::with_capacity(self.moving.len());
        for ((edge, parent, X_PB), matter) in self.moving.iter().zip(&self.matter[1..]) {
            let joint = &joints[edge.joint];
            let Some(kind) = joint.kind else { continue };
            carried.push((Joint::new(*parent, kind, *X_PB, joint.axis), *matter));
        }
        let robot = match VehicleRobot::new(self.matter[0], &carried) {
            Ok(robot) => robot,
            Err(why) => {
                found.error(&links[0].at, why.to_string(), "this vehicle", "");
                return Err(found.into_complaints());
            }
        };
        let moving: Vec<_> = self.moving.iter().map(|(edge, ..)| &joints[edge.joint]).collect();
        check_regular(&robot, &moving, &links[0], &mut found);
        if !found.without_error() {
            return Err(found.into_complaints());
        }
        let named = |(link, frame): (&Link, &Frame<f64>)| NamedFrame {
            name: link.name.clone(),
            frame: *frame,
            grasp_bounds: GraspBounds::default(),
        };
        Ok(AssembledRobot {
            robot,
            joint_names: moving.iter().map(|joint| joint.name.clone()).collect(),
            limits: moving.iter().map(|joint| joint.limits).collect(),
            followers: followers(&moving),
            frames: links.iter().zip(&self.frames).map(named).collect(),
            matter: links.iter().filter_map(LinkMatter::of).collect(),
            warnings: found.into_complaints(),
        })
    }
}

/// Complains of a robot whose equations of motion have no solution in some posture within the travels.
fn check_regular(
    robot: &VehicleRobot,
    moving: &[&AssemblyJoint],
    base: &Link,
    found: &mut Findings,
) {
    let travels: Vec<_> = moving.iter().map(|joint| joint.limits.travel).collect();
    match regularity(robot, &travels) {
        Regularity::Proved => {}
        Regularity::Sampled(postures, pivot) => {
            let message = format!(
                "the mass matrix is regular in {postures} postures that were looked at, by {} of its \
                 diagonal at the least: it is not proved for all",
                figures(pivot)
            );
            let help = "a piece between two joints has no mass of its own; give it some to be sure";
            found.warning(&base.at, message, "this vehicle", help);
        }
        Regularity::Singular { q, rows } => {
            let at_posture = posture(&q, moving);
            let help = "give the links mass properties, fix the joint, or keep its travel clear of \
                        the posture";
            let (of_base, of_joints): (Vec<usize>, Vec<usize>) =
                rows.into_iter().partition(|row| *row < 6);
            for j in of_joints.into_iter().map(|row| row - 6) {
                let Some(joint) = moving.get(j) else { continue };
                let what = if robot.inertia(BodyId::Link(j)).mass > 0.0 {
                    "what has no inertia about its axis".to_owned()
                } else {
                    format!("no mass: neither '{}' nor anything fixed to it has any", joint.child)
                };
                let message = format!(
                    "joint '{}' moves {what}, and the mass matrix is singular{at_posture}",
                    joint.name
                );
                found.error(&joint.child_at, message, "no inertia", help);
            }
            if !of_base.is_empty() {
                let message = format!(
                    "the base can move without moving any mass: the mass matrix is singular\
                     {at_posture}"
                );
                found.error(&base.at, message, "the base", help);
            }
        }
    }
}

/// Joints named in a complaint about a posture.
const SHOWN: usize = 4;

/// The posture in words, by the joints that are not at zero.
fn posture(q: &[f64], moving: &[&AssemblyJoint]) -> String {
    let turned: Vec<_> = q.iter().zip(moving).filter(|(q, _)| q.abs() > 1e-12).collect();
    let told: Vec<_> = turned
        .iter()
        .take(SHOWN)
        .map(|(q, joint)| match joint.kind {
            Some(JointKind::Prismatic) => format!("'{}' = {} m", joint.name, figures(**q)),
            _ => format!("'{}' = {} deg", joint.name, figures(q.to_degrees())),
        })
        .collect();
    match (told.is_empty(), turned.len().saturating_sub(SHOWN)) {
        (true, _) => String::new(),
        (false, 0) => format!(" at {}", told.join(", ")),
        (false, more) => format!(" at {} and {more} joints more", told.join(", ")),
    }
}

/// Place of a body in a list that begins with the base.
fn place(body: BodyId) -> usize {
    match body {
        BodyId::Base => 0,
        BodyId::Link(j) => j + 1,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assembly::{Acceptance, Rounding};
    use crate::findings::SourceFiles;
    use wrasse_document::{Severity, Source};
    use wrasse_spatial::{Sym3, vec3};

    fn bus(mass: f64, zz: f64, accept_nonphysical: Option<&str>) -> Link {
        let matter = Matter {
            mass,
            mass_at: 0..1,
            p_cm: vec3(0.0, 0.0, 0.0),
            inertia: Sym3::diagonal(1.0, 1.0, zz),
            inertia_at: 1..2,
            rounding: Rounding::default(),
            accept_nonphysical: accept_nonphysical
                .map(|reason| Acceptance { reason: reason.to_owned(), of_this: true }),
        };
        Link { name: "bus".into(), at: 0..1, matter: Some(matter) }
    }

    fn assembled(bus: Link) -> Result<AssembledRobot, Vec<Complaint>> {
        let files = SourceFiles::of(&Source::new("bus.toml", "bus"));
        assemble(&Assembly { files, links: vec![bus], ..Assembly::default() })
    }

    #[test]
    fn a_reason_turns_impossible_inertia_into_a_warning_that_quotes_it() {
        let refused = assembled(bus(5.0, 3.0, None)).expect_err("an error");
        assert_eq!(refused[0].severity, Severity::Error);
        let accepted = assembled(bus(5.0, 3.0, Some("printed so"))).expect("a robot");
        let [warning] = &accepted.warnings[..] else { panic!("{:?}", accepted.warnings) };
        assert_eq!(warning.severity, Severity::Warning);
        assert!(warning.help.as_deref().is_some_and(|help| help.ends_with("says: printed so")));
        assert_eq!(accepted.robot.mass(), 5.0);
    }

    #[test]
    fn no_reason_makes_a_vehicle_without_mass_or_with_numbers_that_are_not_finite() {
        for (mass, zz, told) in
            [(-5.0, 1.0, "found -5 kg"), (f64::NAN, 1.0, "finite"), (5.0, f64::NAN, "finite")]
        {
            let complaints = assembled(bus(mass, zz, Some("printed so"))).expect_err("an error");
            let errors: Vec<_> =
                complaints.iter().filter(|c| c.severity == Severity::Error).collect();
            assert_eq!(errors.len(), 1, "{complaints:?}");
            assert!(errors[0].message.contains(told), "{errors:?}");
        }
    }

    #[test]
    fn a_reason_that_is_not_needed_is_warned_of() {
        let assembled = assembled(bus(5.0, 1.5, Some("printed so"))).expect("a robot");
        assert_eq!(assembled.warnings.len(), 1);
        assert!(assembled.warnings[0].message.contains("but its are possible"));
    }
}
