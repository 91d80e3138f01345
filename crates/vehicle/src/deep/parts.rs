//! What the checks of a link look at: its matter, what is drawn of it, and where its body is held.

use super::finding::Place;
use crate::check::{Drawn, PrincipalAxis, principal_axes};
use crate::vehicle::{LinkMatter, Vehicle};
use wrasse_dynamics::BodyId;
use wrasse_spatial::Vec3;

/// Joints that are closer to the centre of mass than this (m) say nothing of a link's size: those of a
/// wrist meet in a point.
const CLOSE: f64 = 0.005;

/// A link with mass.
#[derive(Debug)]
pub(super) struct Part<'v> {
    pub(super) matter: &'v LinkMatter,
    pub(super) place: Option<&'v Place>,
    /// Principal axes of its matter, in link axes, long axis first.
    pub(super) axes: [PrincipalAxis; 3],
    /// What is drawn of it, and of its whole body, in link axes.
    pub(super) own: Drawn,
    pub(super) body: Drawn,
    /// Mass of its whole body (kg).
    pub(super) body_mass: f64,
    /// Whether outlines are all that is drawn of its body.
    pub(super) is_drawn_whole: bool,
    /// Whether its body is carried by a joint.
    pub(super) is_carried: bool,
    /// Distance from its centre of mass to the farthest joint of its body (m); `None` where the body has
    /// fewer than two joints, which say nothing of its length.
    pub(super) joint_distance: Option<f64>,
}

impl Part<'_> {
    /// Largest radius of gyration (m).
    pub(super) fn gyration(&self) -> f64 {
        self.axes.iter().map(|axis| axis.gyration).fold(0.0, f64::max)
    }
    /// How far the link reaches from its centre of mass (m): the link alone, and with all that is fixed
    /// to it; and what says so: its outlines, else the joints of its body. `None` where neither does.
    pub(super) fn size(&self) -> Option<(f64, f64, &'static str)> {
        if self.is_drawn_whole && !self.own.is_empty() {
            let [own, body] =
                [&self.own, &self.body].map(|drawn| drawn.farthest_from(self.matter.p_cm));
            return Some((own, body, "what is drawn reaches to"));
        }
        // A small part that is fixed to a long body has nothing to do with where its joints are.
        let is_main = self.matter.mass > 0.5 * self.body_mass;
        let is_said = self.is_carried && is_main;
        let distance = self.joint_distance.filter(|distance| is_said && *distance > CLOSE)?;
        Some((distance, distance, "its farthest joint is"))
    }
}

/// The links that have mass and a tensor, in the order of the file.
pub(super) fn parts(vehicle: &Vehicle) -> Vec<Part<'_>> {
    vehicle.matter.iter().filter_map(|matter| part(vehicle, matter)).collect()
}

fn part<'v>(vehicle: &'v Vehicle, matter: &'v LinkMatter) -> Option<Part<'v>> {
    let axes = principal_axes(matter.mass, matter.inertia).filter(|axes| axes[0].gyration > 0.0)?;
    let (index, named) =
        vehicle.frames.iter().enumerate().find(|(_, named)| named.name == matter.link)?;
    let (body, X_LB) = (named.frame.body, named.frame.X_BF.inverse());
    let drawn = |wanted: &dyn Fn(&str, BodyId) -> bool| {
        let shapes = vehicle.shapes.iter();
        let wanted = shapes.filter(|shape| wanted(&shape.link, shape.frame.body));
        Drawn::of(wanted.map(|shape| (X_LB * shape.frame.X_BF, shape.kind)))
    };
    let mut on_body = vehicle.frames.iter().filter(|other| other.frame.body == body);
    let is_drawn_whole = on_body.all(|frame| !vehicle.partly_drawn.contains(&frame.name));
    Some(Part {
        matter,
        place: vehicle.places.matter.get(index).and_then(Option::as_ref),
        axes,
        own: drawn(&|link, _| link == matter.link),
        body: drawn(&|_, on| on == body),
        body_mass: vehicle.robot.inertia(body).mass,
        is_drawn_whole,
        is_carried: body != BodyId::Base,
        joint_distance: joint_distance(vehicle, body, X_LB.inverse().point(matter.p_cm)),
    })
}

/// Largest distance from a point of a body (m, body axes) to one of its joints, if it has two.
fn joint_distance(vehicle: &Vehicle, body: BodyId, p_B: Vec3<f64>) -> Option<f64> {
    let robot = &vehicle.robot;
    let next = robot.joints().map(|j| robot.joint(j)).filter(|joint| joint.parent == body);
    let own = (body != BodyId::Base).then(Vec3::zero);
    let joints: Vec<_> =
        own.into_iter().chain(next.map(|joint| joint.X_PB_zero.translation)).collect();
    let farthest = joints.iter().map(|p| (*p - p_B).norm()).fold(0.0, f64::max);
    (joints.len() > 1).then_some(farthest)
}
