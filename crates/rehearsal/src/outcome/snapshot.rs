//! The vehicle at one instant, as lines and boxes.

use crate::case::Case;
use crate::case_world::CaseWorld;
use crate::outcome::{Snapshot, SnapshotBox};
use wrasse_dynamics::{BodyId, Frame, Kinematics, kinematics};
use wrasse_spatial::{Pose, Vec3};
use wrasse_vehicle::{JOINTS, ShapeKind};

/// The corners of a box of these edges (m), centred on a pose.
fn corners(X_NF: &Pose<f64>, edges: Vec3<f64>) -> [[f64; 3]; 8] {
    core::array::from_fn(|i| {
        let side = |bit: usize, edge: f64| if i >> bit & 1 == 1 { 0.5 * edge } else { -0.5 * edge };
        let corner = Vec3 { x: side(0, edges.x), y: side(1, edges.y), z: side(2, edges.z) };
        X_NF.point(corner).to_array()
    })
}

/// The box that a shape fits in.
fn edges(kind: ShapeKind) -> Vec3<f64> {
    match kind {
        ShapeKind::Box(edges) => edges,
        ShapeKind::Cylinder { radius, length } => {
            Vec3 { x: 2.0 * radius, y: 2.0 * radius, z: length }
        }
        ShapeKind::Sphere(radius) => Vec3 { x: 2.0 * radius, y: 2.0 * radius, z: 2.0 * radius },
    }
}

/// The vehicle now, with its payloads; `tips` are the
/// tool and its reference.
pub(crate) fn snapshot(
    case: &Case,
    world: &CaseWorld,
    guided: &Frame<f64>,
    tips: [Vec3<f64>; 2],
) -> Snapshot {
    let state = world.state();
    let k = kinematics(world.robot(), &state);
    let bodies = case.vehicle.shapes.iter().map(|shape| SnapshotBox {
        name: shape.link.clone(),
        corners: corners(&k.pose(&shape.frame), edges(shape.kind)),
    });
    let loads = world.payload_motions().into_iter().filter_map(|(i, X, _)| {
        let payload = &case.payloads[i];
        let edges = Vec3::from_array(payload.box_m?);
        Some(SnapshotBox { name: payload.name.clone(), corners: corners(&X, edges) })
    });
    Snapshot {
        time: world.time(),
        boxes: bodies.chain(loads).collect(),
        arms: arms(case, &k),
        tool: tips[0].to_array(),
        reference: tips[1].to_array(),
        guided: case.frame_name(guided).to_owned(),
    }
}

/// A line for each chain: from where it leaves the base, through its joints, to its outermost frame.
fn arms(case: &Case, k: &Kinematics<'_, f64, JOINTS>) -> Vec<Vec<[f64; 3]>> {
    // Its own joints: propellant swings on others.
    let robot = &case.vehicle.robot;
    let is_tip = |j: usize| robot.joints().all(|c| robot.joint(c).parent != BodyId::Link(j));
    let mut lines = vec![];
    for tip in robot.joints().filter(|&j| is_tip(j)) {
        let mut line: Vec<[f64; 3]> = robot
            .path_to_base(BodyId::Link(tip))
            .map(|j| k.X_NB(BodyId::Link(j)).translation.to_array())
            .collect();
        line.reverse();
        let on_tip = case.vehicle.frames.iter().filter(|f| f.frame.body == BodyId::Link(tip));
        let outermost = on_tip.max_by(|a, b| {
            let reach = |f: &wrasse_vehicle::NamedFrame| f.frame.X_BF.translation.norm();
            reach(a).total_cmp(&reach(b))
        });
        line.extend(outermost.map(|f| k.pose(&f.frame).translation.to_array()));
        lines.push(line);
    }
    lines
}
