//! The exact faces of a sum of segments, for drawings and as a second route to its size.

use super::directions::unit;
use super::solid::{Piece, Solid};
use wrasse_spatial::Vec3;

/// A face of a polytope.
#[derive(Debug, Clone, PartialEq)]
pub struct Facet {
    /// Unit normal outwards (–).
    pub normal: Vec3<f64>,
    /// Distance of its plane from zero.
    pub distance: f64,
    /// Corners in order around the normal.
    pub corners: Vec<Vec3<f64>>,
}

/// Segments whose angle (as a sine) to a plane is below this lie in it.
const IN_PLANE: f64 = 1e-9;

/// The faces of a solid whose pieces are segments, wheels say: each lies across two of them that are
/// not parallel. Nothing for a solid with other pieces, or one that is flat.
pub fn facets(solid: &Solid) -> Vec<Facet> {
    let mut halves = vec![];
    for piece in &solid.pieces {
        match *piece {
            Piece::Segment { half } if half.norm() > 0.0 => halves.push(half),
            Piece::Segment { .. } => {}
            _ => return vec![],
        }
    }
    let mut facets: Vec<Facet> = vec![];
    for (i, a) in halves.iter().enumerate() {
        for b in &halves[..i] {
            let normal = unit(unit(*a).cross(unit(*b)));
            if unit(*a).cross(unit(*b)).norm() <= IN_PLANE {
                continue;
            }
            for normal in [normal, -normal] {
                let known = facets.iter().any(|f| (f.normal - normal).norm() < 1e-7);
                if !known && let Some(facet) = facet(&halves, normal) {
                    facets.push(facet);
                }
            }
        }
    }
    facets
}

/// The face across a normal: segments that lie in it span it, the others carry it outwards.
fn facet(halves: &[Vec3<f64>], normal: Vec3<f64>) -> Option<Facet> {
    let mut middle = Vec3::zero();
    let mut edges = vec![];
    for half in halves {
        let out = half.dot(normal);
        if out.abs() > IN_PLANE * half.norm() {
            middle += if out > 0.0 { *half } else { -*half };
        } else {
            edges.push(*half);
        }
    }
    let distance = middle.dot(normal);
    (distance > 0.0).then(|| Facet { normal, distance, corners: outline(&edges, middle, normal) })
}

/// Corners of a flat sum of segments about `middle`: its edges in the order of their angle.
fn outline(edges: &[Vec3<f64>], middle: Vec3<f64>, normal: Vec3<f64>) -> Vec<Vec3<f64>> {
    let Some(first) = edges.first() else { return vec![] };
    let (e1, e2) = (unit(*first), normal.cross(unit(*first)));
    // Each edge pointing to one side, by its angle.
    let angle = |e: &Vec3<f64>| wrasse_spatial::Real::atan2(e.dot(e2), e.dot(e1));
    let turned = edges.iter().map(|e| {
        let backwards = e.dot(e2) < 0.0 || (e.dot(e2) == 0.0 && e.dot(e1) < 0.0);
        if backwards { -*e } else { *e }
    });
    let mut ordered: Vec<_> = turned.collect();
    ordered.sort_by(|a, b| angle(a).total_cmp(&angle(b)));
    let mut corner = ordered.iter().fold(middle, |at, e| at - *e);
    let mut corners = vec![];
    for sign in [2.0, -2.0] {
        for edge in &ordered {
            corners.push(corner);
            corner += *edge * sign;
        }
    }
    corners
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::envelope::directions::spread;
    use wrasse_spatial::vec3;

    fn solid(halves: &[[f64; 3]]) -> Solid {
        let pieces = halves.iter().map(|h| Piece::Segment { half: Vec3::from_array(*h) });
        Solid { pieces: pieces.collect() }
    }

    #[test]
    fn a_box_has_six_faces_of_four_corners() {
        let faces = facets(&solid(&[[3.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 1.0]]));
        assert_eq!(faces.len(), 6);
        for face in &faces {
            assert_eq!(face.corners.len(), 4);
            assert!(face.corners.iter().all(|c| c.map(f64::abs) == vec3(3.0, 2.0, 1.0)));
        }
        assert_eq!(facets(&solid(&[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])), vec![]);
    }

    /// The radius is the least of the faces' distances, and the faces enclose the volume
    /// `8 Σ |det(a, b, c)|` over all triples of half segments.
    #[test]
    fn faces_give_the_radius_and_enclose_the_volume() {
        let halves = [
            [1.0, 0.2, 0.1],
            [-0.3, 0.9, 0.4],
            [0.2, -0.5, 1.1],
            [0.6, 0.6, -0.7],
            [0.4, 0.0, 0.9],
        ];
        let solid = solid(&halves);
        let faces = facets(&solid);
        assert_eq!(faces.len(), 5 * 4);
        for d in spread(30) {
            let out = faces.iter().filter(|f| f.normal.dot(d) > 0.0);
            let radius = out.map(|f| f.distance / f.normal.dot(d)).fold(f64::INFINITY, f64::min);
            // Measured 8e-15.
            assert!((radius - solid.radius(d)).abs() < 1e-13, "{radius} {}", solid.radius(d));
        }
        let mut enclosed = 0.0;
        for face in &faces {
            for pair in face.corners[1..].windows(2) {
                enclosed += face.corners[0].dot(pair[0].cross(pair[1])) / 6.0;
            }
        }
        let mut volume = 0.0;
        let v = halves.map(Vec3::from_array);
        for i in 0..5 {
            for j in 0..i {
                for k in 0..j {
                    volume += 8.0 * v[i].dot(v[j].cross(v[k])).abs();
                }
            }
        }
        // Measured 7e-15.
        assert!((enclosed - volume).abs() < 1e-12, "{enclosed} {volume}");
    }
}
