//! Vehicles of the catalogue as the tables that the C interface takes.

use wrasse_dynamics::{BodyId, JointKind};
use wrasse_flight_c::{WrasseBody, WrasseFrame, WrasseJoint, WrasseLink};
use wrasse_spatial::{SpatialInertia, Vec3};
use wrasse_vehicle::{Vehicle, catalogue};

/// A vehicle of the catalogue.
pub(crate) fn vehicle(name: &str) -> Vehicle {
    catalogue().iter().find(|entry| entry.name == name).unwrap().read().unwrap()
}

fn body(M: &SpatialInertia<f64>) -> WrasseBody {
    let I = M.central();
    WrasseBody {
        mass: M.mass,
        centre_of_mass: M.centre_of_mass().to_array(),
        inertia: [I.xx, I.yy, I.zz, I.xy, I.xz, I.yz],
    }
}

/// A vehicle's robot as a table.
pub(crate) fn table(vehicle: &Vehicle) -> (WrasseBody, Vec<WrasseLink>) {
    let robot = &vehicle.robot;
    let links = robot.joints().map(|j| {
        let joint = robot.joint(j);
        let parent = match joint.parent {
            BodyId::Base => -1,
            BodyId::Link(p) => i32::try_from(p).unwrap(),
        };
        WrasseLink {
            joint: WrasseJoint {
                parent,
                sliding: i32::from(joint.kind == JointKind::Prismatic),
                position: joint.X_PB_zero.translation.to_array(),
                rotation: joint.X_PB_zero.rotation.rows.map(Vec3::to_array),
                axis: joint.axis_B.to_array(),
            },
            body: body(robot.inertia(BodyId::Link(j))),
        }
    });
    (body(robot.inertia(BodyId::Base)), links.collect())
}

/// Where its first tool is.
pub(crate) fn tool(vehicle: &Vehicle) -> WrasseFrame {
    let frame = vehicle.frame(&vehicle.tools[0]).unwrap();
    WrasseFrame {
        link: match frame.body {
            BodyId::Base => -1,
            BodyId::Link(j) => i32::try_from(j).unwrap(),
        },
        position: frame.X_BF.translation.to_array(),
        rotation: frame.X_BF.rotation.rows.map(Vec3::to_array),
    }
}
