//! Thrusters on a box: where each pushes and which way, in the frame in the middle of the box.

use wrasse_spatial::{Vec3, vec3};

/// Where a force acts (m) and its unit direction (–).
pub(crate) type Push = (Vec3<f64>, Vec3<f64>);

const SIGNS: [f64; 2] = [1.0, -1.0];

/// Two thrusters in each face, pushing inward. They sit half of an edge from the middle of the face to
/// either side: in the faces of x along y, in those of y along z, in those of z along x. So a pair in
/// opposite faces makes a couple about z, x, y.
pub(crate) fn twelve(half: Vec3<f64>) -> Vec<Push> {
    let half = half.to_array();
    let mut pushes = vec![];
    for axis in 0..3 {
        let along = (axis + 1) % 3;
        for face in SIGNS {
            for side in SIGNS {
                let (mut position, mut direction) = ([0.0; 3], [0.0; 3]);
                position[axis] = face * half[axis];
                position[along] = side * half[along];
                direction[axis] = -face;
                pushes.push((Vec3::from_array(position), Vec3::from_array(direction)));
            }
        }
    }
    pushes
}

/// Four thrusters in the middle of each of the faces +y, +z, -y, -z: along x, along -x, and both ways
/// along the face across x.
pub(crate) fn sixteen(half: Vec3<f64>) -> Vec<Push> {
    let (y, z) = (vec3(0.0, 1.0, 0.0), vec3(0.0, 0.0, 1.0));
    let faces = [(y * half.y, z), (z * half.z, y), (y * -half.y, z), (z * -half.z, y)];
    let x = vec3(1.0, 0.0, 0.0);
    let four = |(position, along): (Vec3<f64>, Vec3<f64>)| {
        [x, -x, along, -along].map(|direction| (position, direction))
    };
    faces.into_iter().flat_map(four).collect()
}

/// Three thrusters in each corner, pushing inward along x, y and z.
pub(crate) fn twenty_four(half: Vec3<f64>) -> Vec<Push> {
    let mut pushes = vec![];
    for x in SIGNS {
        for y in SIGNS {
            for z in SIGNS {
                let corner = vec3(x * half.x, y * half.y, z * half.z);
                let inward = [vec3(-x, 0.0, 0.0), vec3(0.0, -y, 0.0), vec3(0.0, 0.0, -z)];
                pushes.extend(inward.map(|direction| (corner, direction)));
            }
        }
    }
    pushes
}
