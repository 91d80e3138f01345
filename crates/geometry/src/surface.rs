//! The surface of a shape, as seen from a point.

use crate::profile::{FlatNearest, Profile};
use crate::shape::Shape;
use wrasse_spatial::{Vec3, vec3};

/// The place on a surface that is nearest to a point, in the axes of the shape's frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nearest {
    /// From the surface to the point (m): negative inside.
    pub distance: f64,
    /// Out of the shape, of length one: the gradient of the distance. Where several places are equally near it
    /// is that of one of them.
    pub normal: Vec3<f64>,
}

const UP: Vec3<f64> = Vec3 { x: 0.0, y: 0.0, z: 1.0 };

/// The nearest place on the surface of a shape to a point of its frame (m), in closed form.
pub fn nearest(shape: &Shape, p: Vec3<f64>) -> Nearest {
    match shape {
        Shape::Sphere { radius } => from_point(p, *radius),
        Shape::Capsule { radius, length } => {
            let z = p.z.clamp(-0.5 * length, 0.5 * length);
            from_point(vec3(p.x, p.y, p.z - z), *radius)
        }
        Shape::Box { edges, rounding } => of_box(*edges, *rounding, p),
        Shape::Plane => Nearest { distance: p.z, normal: UP },
        Shape::Cylinder { radius, length } => {
            let (r, h) = (*radius, 0.5 * length);
            turned(&Profile::new([[-r, -h], [r, -h], [r, h], [-r, h]]), p)
        }
        Shape::Cone { bottom_radius, top_radius, length, wall } => {
            let (b, t, h) = (*bottom_radius, *top_radius, 0.5 * length);
            let inner = wall.map_or([-b, -t], |wall| [b - wall, t - wall]);
            turned(&Profile::new([[inner[0], -h], [b, -h], [t, h], [inner[1], h]]), p)
        }
        Shape::Torus { radius, tube } => {
            let (rho, e) = around(p);
            let far = from_point(vec3(rho - radius, 0.0, p.z), *tube);
            Nearest { normal: e * far.normal.x + UP * far.normal.z, ..far }
        }
        Shape::Bore { .. } => turned(&bore(shape), p),
        Shape::Rail { width, height, wall, length } => {
            let (w, h, t) = (0.5 * width, *height, *wall);
            let section = Profile::new([
                [-w - t, -t],
                [w + t, -t],
                [w + t, h],
                [w, h],
                [w, 0.0],
                [-w, 0.0],
                [-w, h],
                [-w - t, h],
            ]);
            extruded(&section, 0.5 * length, p)
        }
    }
}

/// The profile of a bore.
fn bore(shape: &Shape) -> Profile<5> {
    let Shape::Bore { radius, depth, block_radius, chamfer_depth, chamfer_angle } = shape else {
        return Profile::new([[0.0; 2]; 5]);
    };
    let mouth = radius + chamfer_depth * libm::tan(*chamfer_angle);
    Profile::new([
        [*radius, -depth],
        [*block_radius, -depth],
        [*block_radius, 0.0],
        [mouth, 0.0],
        [*radius, -chamfer_depth],
    ])
}

/// From a ball about the origin.
fn from_point(p: Vec3<f64>, radius: f64) -> Nearest {
    let far = p.norm();
    Nearest { distance: far - radius, normal: if far > 0.0 { p * (1.0 / far) } else { UP } }
}

fn of_box(edges: Vec3<f64>, rounding: f64, p: Vec3<f64>) -> Nearest {
    let core = edges.map(|edge| 0.5 * edge - rounding).to_array();
    let (p, mut beyond) = (p.to_array(), [0.0; 3]);
    let (mut most, mut axis) = (f64::NEG_INFINITY, 0);
    for i in 0..3 {
        let over = p[i].abs() - core[i];
        if over > most {
            (most, axis) = (over, i);
        }
        beyond[i] = over.max(0.0).copysign(p[i]);
    }
    let outside = Vec3::from_array(beyond);
    let far = outside.norm();
    if most > 0.0 && far > 0.0 {
        return Nearest { distance: far - rounding, normal: outside * (1.0 / far) };
    }
    let mut normal = [0.0; 3];
    normal[axis] = 1.0_f64.copysign(p[axis]);
    Nearest { distance: most - rounding, normal: Vec3::from_array(normal) }
}

/// How far a point is from the z axis (m), and the direction that it is in; the x axis on the axis itself.
fn around(p: Vec3<f64>) -> (f64, Vec3<f64>) {
    let rho = (p.x * p.x + p.y * p.y).sqrt();
    let e = if rho > 0.0 { vec3(p.x / rho, p.y / rho, 0.0) } else { vec3(1.0, 0.0, 0.0) };
    (rho, e)
}

/// From a body whose profile turns about z.
fn turned<const N: usize>(profile: &Profile<N>, p: Vec3<f64>) -> Nearest {
    let (rho, e) = around(p);
    let FlatNearest { distance, normal } = profile.nearest([rho, p.z]);
    Nearest { distance, normal: e * normal[0] + UP * normal[1] }
}

/// From a body whose cross-section in y and z goes along x for `half` (m) on both sides.
fn extruded<const N: usize>(section: &Profile<N>, half: f64, p: Vec3<f64>) -> Nearest {
    let FlatNearest { distance, normal } = section.nearest([p.y, p.z]);
    let flat = vec3(0.0, normal[0], normal[1]);
    let (over, end) = (p.x.abs() - half, vec3(1.0_f64.copysign(p.x), 0.0, 0.0));
    if distance > 0.0 && over > 0.0 {
        let far = (distance * distance + over * over).sqrt();
        return Nearest { distance: far, normal: (flat * distance + end * over) * (1.0 / far) };
    }
    if distance >= over {
        Nearest { distance, normal: flat }
    } else {
        Nearest { distance: over, normal: end }
    }
}
