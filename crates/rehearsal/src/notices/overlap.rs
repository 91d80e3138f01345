//! Tool and load inside the bus of their own vehicle: contact is not simulated, so a flight that goes
//! through the bus says nothing. The guided tool's point and the boxes of held loads are looked at,
//! against the shapes that the file gives the base; the arm's links are not.

use crate::case::Case;
use crate::notices::solid_shape::Solid;
use crate::outcome::{Event, EventKind, Verdict};
use crate::signals::observe::Observation;
use crate::simulation::Simulation;
use crate::true_plant::TruePlant;
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
pub fn looked_at(case: &Case) -> &'static str {
    if bus(case).next().is_none() {
        "Contact is not simulated; the base has no shape, so whether tool or load are inside it is not \
         looked at."
    } else {
        "Contact is not simulated; the point of the tool and the boxes of held loads are looked at \
         against the shapes of the base, the links of the arm are not."
    }
}

/// Tool and loads that were found inside the bus.
#[derive(Debug, Default)]
pub(crate) struct Overlaps {
    found: Vec<Overlap>,
}

/// A flight in its world.
type Flight<'s, 'a> = &'s Simulation<'a, TruePlant<'a>>;

impl Overlaps {
    /// Look whether tool or loads are inside the bus, and say so once for each.
    pub(crate) fn flown(
        &mut self,
        flight: Flight<'_, '_>,
        seen: &Observation,
        events: &mut Vec<Event>,
    ) {
        let X_BN = seen.state.X_NB.inverse();
        let p_BE = (X_BN * seen.X_NE).translation;
        let mut tell = |said: Option<String>| {
            events.extend(said.map(|text| Event {
                time_s: flight.time(),
                kind: EventKind::Limit,
                text,
            }));
        };
        tell(self.found_inside(flight, None, |solid| solid.depth(p_BE)));
        for i in 0..flight.case().payloads.len() {
            let Some((X_NL, edges)) = held_box(flight, seen, i) else { continue };
            let X = X_BN * X_NL;
            let smaller = edges.map(|x| (x - 2.0 * TOUCHING).max(0.0));
            let inner = Solid { X, kind: ShapeKind::Box(smaller) };
            let whole = Solid { X, kind: ShapeKind::Box(edges) };
            tell(self.found_inside(flight, Some(i), |solid| {
                if inner.overlaps(solid) { whole.shift_apart(solid) } else { 0.0 }
            }));
        }
    }

    /// Notes how deep something is inside the bus; what to say of it.
    fn found_inside(
        &mut self,
        flight: Flight<'_, '_>,
        payload: Option<usize>,
        depth_in: impl Fn(&Solid) -> f64,
    ) -> Option<String> {
        let (case, first) = (flight.case(), flight.periods() == 1);
        let deepest = bus(case)
            .map(|(shape, solid)| (depth_in(&solid), shape.link.as_str()))
            .reduce(|a, b| if b.0 > a.0 { b } else { a });
        let (depth, link) = deepest?;
        let known = self.found.iter().position(|overlap| overlap.payload == payload);
        if depth <= TOUCHING {
            if let Some(i) = known.filter(|&i| self.found[i].stowed) {
                self.found.remove(i);
            }
            return None;
        }
        if let Some(i) = known {
            let overlap = &mut self.found[i];
            overlap.depth = overlap.depth.max(depth);
            return None;
        }
        self.found.push(Overlap { payload, depth, stowed: first });
        let what = case.inside_text(payload);
        Some(if first {
            format!("{what} is drawn inside {link} at the start: not looked at until it is out")
        } else {
            format!("{what} is inside {link}: contact is not simulated, what follows means nothing")
        })
    }
}

/// Of a payload that is held and has a box: the box's pose, and its edges (m).
fn held_box(
    flight: Flight<'_, '_>,
    seen: &Observation,
    payload: usize,
) -> Option<(Pose<f64>, Vec3<f64>)> {
    let edges = Vec3::from_array(flight.case().payloads[payload].box_m?);
    let (_, held) = flight.plant().world.held().find(|(i, _)| *i == payload)?;
    let X = kinematics(flight.plant().world.robot(), &seen.state).pose(&held.frame);
    let middle = X.point(held.matter.M_F_F.centre_of_mass());
    Some((Pose::new(X.rotation, middle), edges))
}

impl Case {
    /// Tool or load in words.
    fn inside_text(&self, payload: Option<usize>) -> String {
        payload.map_or("the tool".to_owned(), |i| format!("load {}", self.payloads[i].name))
    }

    /// A failed verdict for each overlap.
    pub(crate) fn overlap_verdicts(&self, overlaps: &Overlaps) -> Vec<Verdict> {
        let each = overlaps.found.iter().filter(|overlap| !overlap.stowed);
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
