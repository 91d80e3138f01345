//! Tool and load inside the bus of their own vehicle: contact is not simulated, so a flight that goes
//! through the bus says nothing. The guided tool's point and the boxes of held loads are looked at,
//! against the shapes that the file gives the base; the arm's links are not.

use crate::flight::Flight;
use crate::mission::Case;
use crate::observe::Observation;
use crate::outcome::{EventKind, Verdict};
use crate::solid_shape::Solid;
use wrasse_dynamics::{BodyId, kinematics};
use wrasse_spatial::{Pose, Vec3};
use wrasse_vehicle::{Shape, ShapeKind};

/// Depth up to which solids count as touching (m).
const TOUCHING: f64 = 1e-3;

/// What was found inside the bus.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Overlap {
    /// A payload; the tool without one.
    payload: Option<usize>,
    /// Deepest so far (m).
    depth: f64,
    /// It was there from the start, and has not been out: it is stowed.
    stowed: bool,
}

/// The shapes of the base.
fn bus(case: &Case) -> impl Iterator<Item = (&Shape, Solid)> {
    let of_base = case.vehicle.shapes.iter().filter(|shape| shape.frame.body == BodyId::Base);
    of_base.map(|shape| (shape, Solid { X: shape.frame.X_BF, kind: shape.kind }))
}

/// What is looked at, in a sentence for the report.
pub(crate) fn looked_at(case: &Case) -> &'static str {
    if bus(case).next().is_none() {
        "Contact is not simulated; the base has no shape, so whether tool or load are inside it is not \
         looked at."
    } else {
        "Contact is not simulated; the point of the tool and the boxes of held loads are looked at \
         against the shapes of the base, the links of the arm are not."
    }
}

impl Flight<'_> {
    /// Look whether tool or loads are inside the bus, and say so once for each.
    pub(crate) fn look_for_overlap(&mut self, seen: &Observation, first: bool) {
        let X_BN = seen.state.X_NB.inverse();
        let p_BE = (X_BN * seen.X_NE).translation;
        self.found_inside(None, first, |solid| solid.depth(p_BE));
        for i in 0..self.case.payloads.len() {
            let Some((X_NL, edges)) = self.held_box(seen, i) else { continue };
            let X = X_BN * X_NL;
            let smaller = edges.map(|x| (x - 2.0 * TOUCHING).max(0.0));
            let inner = Solid { X, kind: ShapeKind::Box(smaller) };
            let whole = Solid { X, kind: ShapeKind::Box(edges) };
            self.found_inside(Some(i), first, |solid| {
                if inner.overlaps(solid) { whole.shift_apart(solid) } else { 0.0 }
            });
        }
    }

    /// Of a payload that is held and has a box: the box's pose, and its edges (m).
    fn held_box(&self, seen: &Observation, payload: usize) -> Option<(Pose<f64>, Vec3<f64>)> {
        let edges = Vec3::from_array(self.case.payloads[payload].box_m?);
        let (_, held) = self.world.held().find(|(i, _)| *i == payload)?;
        let X = kinematics(self.world.robot(), &seen.state).pose(&held.frame);
        let middle = X.point(held.matter.M_F_F.centre_of_mass());
        Some((Pose::new(X.rotation, middle), edges))
    }

    fn found_inside(
        &mut self,
        payload: Option<usize>,
        first: bool,
        depth_in: impl Fn(&Solid) -> f64,
    ) {
        let deepest = bus(self.case)
            .map(|(shape, solid)| (depth_in(&solid), shape.link.as_str()))
            .reduce(|a, b| if b.0 > a.0 { b } else { a });
        let Some((depth, link)) = deepest else { return };
        let known = self.overlaps.iter().position(|overlap| overlap.payload == payload);
        if depth <= TOUCHING {
            if let Some(i) = known.filter(|&i| self.overlaps[i].stowed) {
                self.overlaps.remove(i);
            }
            return;
        }
        if let Some(i) = known {
            let overlap = &mut self.overlaps[i];
            overlap.depth = overlap.depth.max(depth);
            return;
        }
        self.overlaps.push(Overlap { payload, depth, stowed: first });
        let what = self.case.inside_text(payload);
        let text = if first {
            format!("{what} is drawn inside {link} at the start: not looked at until it is out")
        } else {
            format!("{what} is inside {link}: contact is not simulated, what follows means nothing")
        };
        self.say(EventKind::Limit, text);
    }
}

impl Case {
    /// Tool or load in words.
    fn inside_text(&self, payload: Option<usize>) -> String {
        payload.map_or("the tool".to_owned(), |i| format!("load {}", self.payloads[i].name))
    }

    /// A failed verdict for each overlap.
    pub(crate) fn overlap_verdicts(&self, overlaps: &[Overlap]) -> Vec<Verdict> {
        let each = overlaps.iter().filter(|overlap| !overlap.stowed);
        each.map(|overlap| Verdict {
            requirement: format!("{} outside the bus", self.inside_text(overlap.payload)),
            comparison: "<=".into(),
            limit: 0.0,
            value: Some(overlap.depth),
            unit: "m inside".into(),
            pass: false,
        })
        .collect()
    }
}
