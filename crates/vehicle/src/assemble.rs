//! From named links and joints to a checked robot: links that are fixed to each other become one
//! body, seen from the frame of the link that the moving joint carries.

use crate::assembly::{AssemblyJoint, Link};
use crate::check::{
    Edge, Tree, check_joint, check_matter, doubt_joint, doubt_mass, doubt_matter, tree,
};
use crate::findings::Findings;
use crate::vehicle::{GraspBounds, JOINTS, NamedFrame, VehicleRobot};
use std::sync::Arc;
use wrasse_document::{Complaint, Source};
use wrasse_dynamics::{BodyId, Frame, Joint, MassProperties};
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
    /// Every link as a frame of the body that it belongs to, in the order of the file.
    pub(crate) frames: Vec<NamedFrame>,
    /// Values that are possible but implausible, or impossible and accepted.
    pub(crate) warnings: Vec<Complaint>,
}

/// The robot of these links and joints.
///
/// # Errors
/// All complaints at once, warnings among them, if the links are no tree or no matter can be so.
pub(crate) fn assemble(
    source: &Arc<Source>,
    links: &[Link],
    joints: &[AssemblyJoint],
) -> Result<AssembledRobot, Vec<Complaint>> {
    let mut found = Findings::new(source);
    for link in links {
        check_matter(link, &mut found);
    }
    for joint in joints {
        check_joint(joint, &mut found);
        doubt_joint(joint, &mut found);
    }
    let tree = tree(links, joints, &mut found);
    let moving = joints.iter().filter(|j| j.kind.is_some()).count();
    if let Some(first_too_many) = joints.iter().filter(|j| j.kind.is_some()).nth(JOINTS) {
        let message = format!("{moving} moving joints: a vehicle has at most {JOINTS}");
        let help = "fix the joints that do not move in this study";
        found.error(&first_too_many.at, message, "one too many", help);
    }
    let Some(tree) = tree.filter(|_| moving <= JOINTS) else {
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

    /// Complains of bodies without mass, and warns of what is implausible.
    fn check_masses(
        &self,
        tree: &Tree,
        links: &[Link],
        joints: &[AssemblyJoint],
        found: &mut Findings,
    ) {
        let whole: f64 = self.matter.iter().map(|m| m.M_F_F.mass).sum();
        for (link, frame) in links.iter().zip(&self.frames) {
            doubt_matter(link, frame.body, found);
        }
        let has_matter = |body: BodyId| {
            let mut of_body =
                links.iter().zip(&self.frames).filter(|(_, frame)| frame.body == body);
            of_body.any(|(link, _)| link.matter.is_some())
        };
        let root = &links[tree.root];
        if !has_matter(BodyId::Base) {
            let message =
                format!("the base has no mass: neither '{}' nor anything fixed to it", root.name);
            found.error(&root.at, message, "the base", "give it mass, centre of mass and inertia");
        }
        for (j, (edge, ..)) in self.moving.iter().enumerate() {
            let joint = &joints[edge.joint];
            if !has_matter(BodyId::Link(j)) {
                let message = format!(
                    "joint '{}' moves a body without mass: neither '{}' nor anything fixed to it \
                     has any",
                    joint.name, joint.child
                );
                let help = "give the link mass properties, or fix the joint";
                found.error(&joint.child_at, message, "no mass", help);
            }
            doubt_mass(joint, self.matter[j + 1].M_F_F.mass, whole, found);
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
        let named = |(link, frame): (&Link, &Frame<f64>)| NamedFrame {
            name: link.name.clone(),
            frame: *frame,
            grasp_bounds: GraspBounds::default(),
        };
        let of_moving = |(edge, ..): &(Edge, BodyId, Pose<f64>)| &joints[edge.joint];
        Ok(AssembledRobot {
            robot,
            joint_names: self.moving.iter().map(|m| of_moving(m).name.clone()).collect(),
            limits: self.moving.iter().map(|m| of_moving(m).limits).collect(),
            frames: links.iter().zip(&self.frames).map(named).collect(),
            warnings: found.into_complaints(),
        })
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
    use crate::assembly::Matter;
    use wrasse_document::Severity;
    use wrasse_spatial::{Sym3, vec3};

    fn bus(mass: f64, zz: f64, accept_nonphysical: Option<&str>) -> Link {
        let matter = Matter {
            mass,
            mass_at: 0..1,
            p_cm: vec3(0.0, 0.0, 0.0),
            inertia: Sym3::diagonal(1.0, 1.0, zz),
            inertia_at: 1..2,
            accept_nonphysical: accept_nonphysical.map(str::to_owned),
        };
        Link { name: "bus".into(), at: 0..1, matter: Some(matter) }
    }

    fn assembled(bus: Link) -> Result<AssembledRobot, Vec<Complaint>> {
        assemble(&Source::new("bus.toml", "bus"), &[bus], &[])
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
