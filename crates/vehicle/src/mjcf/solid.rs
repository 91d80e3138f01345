//! Mass properties of simple shapes, filled evenly or as thin shells.

use core::f64::consts::PI;
use wrasse_spatial::{Pose, Sym3, Vec3};

/// A shape centred on its frame, its axis along z. MJCF gives half of what goes across.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Form {
    /// Radius (m).
    Sphere(f64),
    /// Radius, and half of the length of the cylinder between the caps (m).
    Capsule(f64, f64),
    /// Radius, half of the length (m).
    Cylinder(f64, f64),
    /// Semi-axes (m).
    Ellipsoid([f64; 3]),
    /// Half of the edges (m).
    Box([f64; 3]),
}

/// A shape with mass, on a body.
#[derive(Debug, Clone, Copy)]
pub(super) struct Solid {
    /// Mass (kg).
    pub(super) mass: f64,
    /// Centre of mass (m) and inertia about it (kg·m²), in the axes of the body.
    pub(super) p_cm: Vec3<f64>,
    pub(super) inertia: Sym3<f64>,
}

impl Form {
    /// Volume (m³).
    pub(super) fn volume(self) -> f64 {
        match self {
            Self::Sphere(r) => 4.0 / 3.0 * PI * r * r * r,
            Self::Capsule(r, half) => PI * r * r * (2.0 * half + 4.0 / 3.0 * r),
            Self::Cylinder(r, half) => 2.0 * PI * r * r * half,
            Self::Ellipsoid([a, b, c]) => 4.0 / 3.0 * PI * a * b * c,
            Self::Box([a, b, c]) => 8.0 * a * b * c,
        }
    }

    /// Surface (m²); none of an ellipsoid, which has no closed form.
    pub(super) fn surface(self) -> Option<f64> {
        match self {
            Self::Sphere(r) => Some(4.0 * PI * r * r),
            Self::Capsule(r, half) => Some(4.0 * PI * r * (r + half)),
            Self::Cylinder(r, half) => Some(2.0 * PI * r * (r + 2.0 * half)),
            Self::Ellipsoid(_) => None,
            Self::Box([a, b, c]) => Some(8.0 * (a * b + b * c + c * a)),
        }
    }

    /// Principal moments about the centre per mass (m²), filled evenly.
    pub(super) fn moments(self) -> [f64; 3] {
        match self {
            Self::Sphere(r) => [0.4 * r * r; 3],
            Self::Capsule(r, half) => {
                let caps = 2.0 * r / (2.0 * r + 3.0 * half);
                // The mass of a half ball is 3/8 r from its flat side.
                let ball = 0.4 * r * r;
                let cap = ball + half * half + 0.75 * half * r;
                let [across, _, along] = Self::Cylinder(r, half).moments();
                let [across, along] = [(across, cap), (along, ball)]
                    .map(|(middle, cap)| (1.0 - caps) * middle + caps * cap);
                [across, across, along]
            }
            Self::Cylinder(r, half) => {
                let across = r * r / 4.0 + half * half / 3.0;
                [across, across, r * r / 2.0]
            }
            Self::Ellipsoid([a, b, c]) => {
                [(b * b + c * c) / 5.0, (a * a + c * c) / 5.0, (a * a + b * b) / 5.0]
            }
            Self::Box([a, b, c]) => {
                [(b * b + c * c) / 3.0, (a * a + c * c) / 3.0, (a * a + b * b) / 3.0]
            }
        }
    }

    /// Principal moments about the centre per mass (m²), all mass in the surface; none of an ellipsoid.
    pub(super) fn moments_of_shell(self) -> Option<[f64; 3]> {
        match self {
            Self::Sphere(r) => Some([2.0 / 3.0 * r * r; 3]),
            Self::Capsule(r, half) => {
                let caps = r / (r + half);
                // The mass of half a sphere is r/2 from its flat side.
                let ball = 2.0 / 3.0 * r * r;
                let cap = ball + half * half + half * r;
                let across = (1.0 - caps) * (r * r / 2.0 + half * half / 3.0) + caps * cap;
                Some([across, across, (1.0 - caps) * r * r + caps * ball])
            }
            Self::Cylinder(r, half) => {
                let discs = r / (r + 2.0 * half);
                let disc = r * r / 4.0 + half * half;
                let across = (1.0 - discs) * (r * r / 2.0 + half * half / 3.0) + discs * disc;
                Some([across, across, (1.0 - discs) * r * r + discs * r * r / 2.0])
            }
            Self::Ellipsoid(_) => None,
            Self::Box([a, b, c]) => {
                let whole = a * b + b * c + c * a;
                let [aa, bb, cc] = [a * a, b * b, c * c];
                // Two faces across each edge, each a plate.
                let faces = [
                    (b * c, [bb / 3.0 + cc / 3.0, aa + cc / 3.0, aa + bb / 3.0]),
                    (c * a, [bb + cc / 3.0, aa / 3.0 + cc / 3.0, bb + aa / 3.0]),
                    (a * b, [cc + bb / 3.0, cc + aa / 3.0, aa / 3.0 + bb / 3.0]),
                ];
                Some([0, 1, 2].map(|k| faces.iter().map(|(area, I)| area / whole * I[k]).sum()))
            }
        }
    }
}

impl Solid {
    /// Of a mass and its principal moments per mass, in a frame on the body.
    pub(super) fn new(mass: f64, moments: [f64; 3], X_BG: &Pose<f64>) -> Self {
        let [xx, yy, zz] = moments.map(|moment| moment * mass);
        let inertia = X_BG.rotation.congruence(Sym3::diagonal(xx, yy, zz));
        Self { mass, p_cm: X_BG.translation, inertia }
    }

    /// What stands in for a solid after a complaint: the rest is still checked.
    pub(super) fn stand_in() -> Self {
        Self { mass: 1.0, p_cm: Vec3::default(), inertia: Sym3::diagonal(1.0, 1.0, 1.0) }
    }

    /// Several as one; none of none.
    pub(super) fn sum(solids: &[Self]) -> Option<Self> {
        if let [only] = solids {
            return Some(*only);
        }
        let mass: f64 = solids.iter().map(|solid| solid.mass).sum();
        if solids.is_empty() {
            return None;
        }
        let first = solids.iter().fold(Vec3::default(), |sum, s| sum + s.p_cm * s.mass);
        let p_cm = first * (1.0 / mass);
        let about = |s: &Self| s.inertia + Sym3::of_point(s.mass, s.p_cm - p_cm);
        let inertia = solids.iter().fold(Sym3::zero(), |sum, solid| sum + about(solid));
        Some(Self { mass, p_cm, inertia })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use wrasse_testing::largest;

    const CAPSULE: Form = Form::Capsule(0.1, 0.35);
    const CYLINDER: Form = Form::Cylinder(0.1, 0.35);
    const BOX: Form = Form::Box([0.1, 0.2, 0.4]);

    /// A solid is a stack of shells, each a little larger: mass m(s) = ∫ surface, moments alike.
    /// The surface of a box, cylinder or sphere that grows by ds all over sweeps its volume.
    #[test]
    fn a_solid_that_grows_by_a_shell_all_over_gains_mass_and_moments_of_the_shell() {
        let grown = |form: Form, d: f64| match form {
            Form::Sphere(r) => Form::Sphere(r + d),
            Form::Capsule(r, half) => Form::Capsule(r + d, half),
            Form::Cylinder(r, half) => Form::Cylinder(r + d, half + d),
            Form::Ellipsoid(a) => Form::Ellipsoid(a.map(|a| a + d)),
            Form::Box(a) => Form::Box(a.map(|a| a + d)),
        };
        let d = 1e-5;
        for form in [Form::Sphere(0.3), CAPSULE, CYLINDER, BOX] {
            let (inner, outer) = (grown(form, -d), grown(form, d));
            let (area, shell) = (form.surface(), form.moments_of_shell());
            let (area, shell) = (area.expect("a surface"), shell.expect("moments"));
            let gained = (outer.volume() - inner.volume()) / (2.0 * d);
            assert!((gained / area - 1.0).abs() < 1e-8, "{form:?}: {gained} {area}");
            let moments = [0, 1, 2].map(|k| {
                let [outer, inner] = [outer, inner].map(|form| form.volume() * form.moments()[k]);
                (outer - inner) / (2.0 * d) / area / shell[k] - 1.0
            });
            // Central differences: off by d²/size² of the value, and round-off over d.
            assert!(largest(moments.map(f64::abs)) < 1e-7, "{form:?}: {moments:?}");
        }
    }

    #[test]
    fn a_capsule_without_length_is_a_ball_and_one_without_radius_a_rod() {
        let off = |a: [f64; 3], b: [f64; 3]| largest([0, 1, 2].map(|k| (a[k] - b[k]).abs()));
        assert!(off(Form::Capsule(0.3, 0.0).moments(), Form::Sphere(0.3).moments()) < 1e-16);
        let rod = [0.5 * 0.5 / 3.0, 0.5 * 0.5 / 3.0, 0.0];
        assert!(off(Form::Capsule(1e-9, 0.5).moments(), rod) < 1e-8);
        let ball = Form::Ellipsoid([0.3; 3]);
        assert!(off(ball.moments(), Form::Sphere(0.3).moments()) < 1e-16);
        assert!((ball.volume() - Form::Sphere(0.3).volume()).abs() < 1e-16);
    }

    #[test]
    fn two_halves_of_a_box_are_the_box() {
        let at = |x: f64| Pose::new(wrasse_spatial::Mat3::identity(), Vec3 { x, y: 0.0, z: 0.0 });
        let half = |x| Solid::new(3.0, Form::Box([0.05, 0.2, 0.4]).moments(), &at(x));
        let whole = Solid::new(6.0, BOX.moments(), &at(0.7));
        let sum = Solid::sum(&[half(0.65), half(0.75)]).expect("two");
        let I = [sum.inertia, whole.inertia].map(|I| [I.xx, I.yy, I.zz, I.xy, I.xz, I.yz]);
        assert!(largest([0, 1, 2, 3, 4, 5].map(|k| (I[0][k] - I[1][k]).abs())) < 1e-15);
        assert!((sum.p_cm - whole.p_cm).norm() < 1e-15 && sum.mass == 6.0);
    }
}
