//! Polygons in a plane: the profile of a body of revolution, the cross-section of a rail.

/// A closed polygon, its inside on the left of each edge.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Profile<const N: usize> {
    corners: [[f64; 2]; N],
}

/// Distance from a polygon (m) and its outward gradient.
pub(crate) struct FlatNearest {
    pub(crate) distance: f64,
    pub(crate) normal: [f64; 2],
}

impl<const N: usize> Profile<N> {
    pub(crate) fn new(corners: [[f64; 2]; N]) -> Self {
        Self { corners }
    }

    /// The nearest place of the outline: signed distance, negative inside. Between the ends of an edge the
    /// normal is the edge's own, to the last bit; at a corner it points from there.
    pub(crate) fn nearest(&self, p: [f64; 2]) -> FlatNearest {
        let (mut best, mut found) =
            (f64::INFINITY, FlatNearest { distance: 0.0, normal: [0.0; 2] });
        let (mut inside, mut at_corner) = (false, false);
        for i in 0..N {
            let (a, b) = (self.corners[i], self.corners[(i + 1) % N]);
            inside ^= crosses(a, b, p);
            let (edge, way) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
            let length = norm(edge);
            if length == 0.0 {
                continue;
            }
            let out = [edge[1] / length, -edge[0] / length];
            let along = (way[0] * edge[0] + way[1] * edge[1]) / (length * length);
            let share = along.clamp(0.0, 1.0);
            let from = [way[0] - share * edge[0], way[1] - share * edge[1]];
            let (height, far) = (way[0] * out[0] + way[1] * out[1], norm(from));
            let at_vertex = share != along && far > 0.0;
            let size = if at_vertex { far } else { height.abs() };
            if size < best {
                (best, at_corner) = (size, at_vertex);
                found = if at_vertex {
                    FlatNearest { distance: far, normal: from.map(|x| x / far) }
                } else {
                    FlatNearest { distance: height, normal: out }
                };
            }
        }
        if at_corner && inside {
            found = FlatNearest { distance: -best, normal: found.normal.map(|x| -x) };
        }
        found
    }
}

fn norm(a: [f64; 2]) -> f64 {
    (a[0] * a[0] + a[1] * a[1]).sqrt()
}

/// Whether a ray from p along the first axis crosses the edge from a to b.
fn crosses(a: [f64; 2], b: [f64; 2], p: [f64; 2]) -> bool {
    if (a[1] > p[1]) == (b[1] > p[1]) {
        return false;
    }
    let at = a[0] + (p[1] - a[1]) * (b[0] - a[0]) / (b[1] - a[1]);
    p[0] < at
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square of edge 2 with a notch from above, 1 deep and 1 wide.
    fn notched() -> Profile<8> {
        Profile::new([
            [-1.0, -1.0],
            [1.0, -1.0],
            [1.0, 1.0],
            [0.5, 1.0],
            [0.5, 0.0],
            [-0.5, 0.0],
            [-0.5, 1.0],
            [-1.0, 1.0],
        ])
    }

    #[test]
    fn distances_are_signed_and_normals_point_outward() {
        let half = 0.5_f64.sqrt();
        for (p, distance, normal) in [
            ([0.0, 0.2], 0.2, [0.0, 1.0]),
            ([0.4, 0.6], 0.1, [-1.0, 0.0]),
            ([2.0, 2.0], 2.0_f64.sqrt(), [half, half]),
            ([0.65, 0.8], -0.15, [-1.0, 0.0]),
            ([0.0, -0.3], -0.3, [0.0, 1.0]),
            // Inside, nearest to the reflex corner.
            ([0.6, -0.1], -0.02_f64.sqrt(), [-half, half]),
            ([1.5, 0.0], 0.5, [1.0, 0.0]),
        ] {
            let found = notched().nearest(p);
            assert!((found.distance - distance).abs() < 1e-15, "{p:?}: {}", found.distance);
            let off = [found.normal[0] - normal[0], found.normal[1] - normal[1]];
            assert!(off[0].abs() + off[1].abs() < 1e-14, "{p:?}: {:?}", found.normal);
        }
    }
}
