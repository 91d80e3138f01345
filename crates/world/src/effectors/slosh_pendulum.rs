//! How heavy and how long the pendulum is that swings as the liquid in a tank does.

use wrasse_hardware::{Slosh, TankShape};

/// First zero of `J₁'` (–): the wave number of the first mode across a cylinder, times its radius.
const FIRST_ZERO: f64 = 1.841_183_781_340_659_4;

/// Depths in a sphere at which its first mode was computed: so many to a radius, from zero on.
const ROWS_PER_RADIUS: f64 = 10.0;
/// Length of the pendulum in a sphere, over its radius (–).
#[rustfmt::skip]
const SPHERE_LENGTH: [f64; 20] = [
    1.00000, 0.96648, 0.93255, 0.89820, 0.86336, 0.82801, 0.79208, 0.75550, 0.71819, 0.68005,
    0.64096, 0.60076, 0.55923, 0.51610, 0.47099, 0.42333, 0.37225, 0.31629, 0.25256, 0.17353,
];
/// Mass of the pendulum in a sphere, over that of the liquid (–).
#[rustfmt::skip]
const SPHERE_SHARE: [f64; 20] = [
    1.00000, 0.96594, 0.93038, 0.89322, 0.85437, 0.81372, 0.77117, 0.72660, 0.67990, 0.63097,
    0.57969, 0.52599, 0.46980, 0.41114, 0.35009, 0.28693, 0.22222, 0.15707, 0.09363, 0.03654,
];

/// The first mode of a liquid, as a pendulum beside a mass at rest.
///
/// In an upright cylinder with `κ = 1.8412/R`: frequency `ω² = g κ tanh κh`, length `L = g/ω²`, mass
/// `m₁ = m 2 tanh κh / (κh (1.8412² - 1))`, at rest `h - (2/κ) tanh κh/2` above the bottom. In a sphere
/// the hinge is the centre, for there all pressures of the wall meet; length and mass are those of the
/// mode that Ritz's method finds. What is left of the liquid is a point where both together have its
/// centre of mass.
///
/// # Assumptions
/// Small waves; the modes above the first and the liquid's own turning are part of the mass at rest,
/// which is a point.
///
/// # Source
/// Derived from the potential flow in `book/src/theory/slosh.md`;
/// [`Abramson1966`](wrasse_spatial::references::Abramson1966) ch. 6 and
/// [`Dodge2000`](wrasse_spatial::references::Dodge2000) ch. 3 have models of this form.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SloshPendulum {
    /// What swings (kg).
    pub mass: f64,
    /// From the hinge to it (m).
    pub length: f64,
    /// Of the hinge above the bottom (m).
    pub hinge_height: f64,
    /// What does not swing (kg).
    pub rest_mass: f64,
    /// Of that above the bottom (m).
    pub rest_height: f64,
    /// Damping about the hinge (N·m·s/rad).
    pub damping: f64,
}

/// The first mode at some depth: share of the liquid that swings (–), length of the pendulum and height of
/// its hinge above the bottom (m).
struct FirstMode {
    share: f64,
    length: f64,
    hinge_height: f64,
}

impl FirstMode {
    fn of(shape: &TankShape, depth: f64) -> Self {
        match *shape {
            TankShape::UprightCylinder { radius, .. } => Self::upright_cylinder(radius, depth),
            TankShape::Sphere { radius } => Self::sphere(radius, depth),
        }
    }
    fn upright_cylinder(R: f64, h: f64) -> Self {
        let kappa = FIRST_ZERO / R;
        let tanh = libm::tanh(kappa * h);
        let length = 1.0 / (kappa * tanh);
        let bob_height = h - 2.0 / kappa * libm::tanh(0.5 * kappa * h);
        let share = 2.0 * tanh / (kappa * h * (FIRST_ZERO * FIRST_ZERO - 1.0));
        Self { share, length, hinge_height: bob_height + length }
    }
    fn sphere(R: f64, h: f64) -> Self {
        let row = h / R * ROWS_PER_RADIUS;
        Self {
            share: interpolated(&SPHERE_SHARE, row),
            length: R * interpolated(&SPHERE_LENGTH, row),
            hinge_height: R,
        }
    }
}

/// The value of a table between its rows, by the cubic through the four nearest.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to the rows")]
fn interpolated(table: &[f64; 20], row: f64) -> f64 {
    let first = (row - 1.0).clamp(0.0, 16.0) as usize;
    let t = row - first as f64;
    let [a, b, c, d] = [0, 1, 2, 3].map(|i| table[first + i]);
    let (from_a, from_b, from_c, from_d) = (t, t - 1.0, t - 2.0, t - 3.0);
    (d * from_a - a * from_d) * from_b * from_c / 6.0
        + (b * from_c - c * from_b) * from_a * from_d / 2.0
}

impl SloshPendulum {
    /// Of so much liquid (kg); `None` where it does not swing.
    pub fn of(slosh: &Slosh, liquid: f64) -> Option<Self> {
        if !slosh.swings(liquid) {
            return None;
        }
        let FirstMode { share, length, hinge_height } =
            FirstMode::of(&slosh.shape, slosh.depth(liquid));
        let mass = liquid * share;
        let rest_mass = liquid - mass;
        let moment = slosh.centre_height(liquid) * liquid - (hinge_height - length) * mass;
        let inertia = mass * length * length;
        let square = slosh.acceleration / length + slosh.stiffness / inertia;
        Some(Self {
            mass,
            length,
            hinge_height,
            rest_mass,
            rest_height: moment / rest_mass,
            damping: 2.0 * slosh.damping_ratio * libm::sqrt(square) * inertia,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{DMatrix, DVector, SymmetricEigen};
    use std::f64::consts::PI;
    use wrasse_spatial::Vec3;

    const TANK: Slosh = Slosh {
        axis_B: Vec3 { x: 0.0, y: 0.0, z: 1.0 },
        shape: TankShape::UprightCylinder { radius: 0.7, height: 2.0 },
        density: 1010.0,
        damping_ratio: 0.01,
        acceleration: 0.3,
        stiffness: 0.0,
    };
    const SPHERE: Slosh = Slosh { shape: TankShape::Sphere { radius: 0.7 }, ..TANK };

    /// `∫ f` from `a` to `b` by Simpson's rule.
    fn integral(a: f64, b: f64, f: impl Fn(f64) -> f64) -> f64 {
        let (n, h) = (2000, (b - a) / 2000.0);
        let weight = |i: i32| if i == 0 || i == n { 1.0 } else { 2.0 + 2.0 * f64::from(i % 2) };
        (0..=n).map(|i| weight(i) * f(a + f64::from(i) * h)).sum::<f64>() * h / 3.0
    }

    /// The first mode of the potential flow, `φ = J₁(κr) cos θ cosh κz`, z from the bottom: that its mass, length
    /// and hinge are those of the pendulum. The mass is `P²/2T`, with P the momentum across the tank of the
    /// mode and 2T twice its kinetic energy; the hinge is where the pressure on wall and bottom has no
    /// moment; `ω² = g φ_z/φ` at the surface. All by quadrature: measured 1e-13.
    #[test]
    fn the_pendulum_is_the_first_mode_of_the_potential_flow() {
        let R = TANK.shape.radius();
        let kappa = FIRST_ZERO / R;
        let slope = libm::j0(FIRST_ZERO) - libm::j1(FIRST_ZERO) / FIRST_ZERO;
        assert!(slope.abs() < 1e-15, "no flow through the wall: {slope:e}");
        for h in [0.1, 0.4, 0.7, 1.5] {
            let p = SloshPendulum::of(&TANK, TANK.density * PI * R * R * h).unwrap();
            let (top, pi) = (libm::cosh(kappa * h), PI);
            let wall = |f: &dyn Fn(f64) -> f64| {
                libm::j1(FIRST_ZERO) * pi * R * integral(0.0, h, |z| f(z) * libm::cosh(kappa * z))
            };
            let push = wall(&|_| 1.0);
            let square = |r: f64| libm::j1(kappa * r) * libm::j1(kappa * r) * r;
            let twice = kappa * libm::sinh(kappa * h) * top * pi * integral(0.0, R, square);
            let mass = TANK.density * push * push / twice;
            let on_bottom = pi * integral(0.0, R, |r| r * r * libm::j1(kappa * r));
            let hinge = (wall(&|z| z) + on_bottom) / push;
            let length = top / (kappa * libm::sinh(kappa * h));
            for (found, expected) in [(p.mass, mass), (p.hinge_height, hinge), (p.length, length)] {
                assert!((found / expected - 1.0).abs() < 1e-11, "{h} m: {found} {expected}");
            }
        }
    }

    /// Both parts together have the mass of the liquid and its centre of mass, hanging.
    #[test]
    fn what_swings_and_what_does_not_are_the_liquid() {
        for (slosh, liquid) in
            [160.0, 500.0, 1300.0].into_iter().flat_map(|liquid| [(TANK, liquid), (SPHERE, liquid)])
        {
            let p = SloshPendulum::of(&slosh, liquid).unwrap();
            let moment = p.mass * (p.hinge_height - p.length) + p.rest_mass * p.rest_height;
            assert!((p.mass + p.rest_mass - liquid).abs() < 1e-12 * liquid);
            assert!((moment / liquid / slosh.centre_height(liquid) - 1.0).abs() < 1e-14);
            assert!(p.mass > 0.0 && p.rest_mass > 0.0 && p.rest_height > 0.0);
        }
    }

    /// Solid harmonics `rⁿ Pₙ¹(cos θ)` from n = 0 to `N`, about the centre of the sphere.
    fn solid_harmonics(rho: f64, z: f64) -> [f64; N + 1] {
        let mut S = [0.0; N + 1];
        S[1] = rho;
        for n in 1..N {
            let l = n as f64;
            S[n + 1] =
                ((2.0 * l + 1.0) * z * S[n] - (l + 1.0) * (rho * rho + z * z) * S[n - 1]) / l;
        }
        S
    }
    const N: usize = 24;

    /// `ω² R/g` and share of the liquid of the first mode in a sphere of radius one, by Ritz's method: the
    /// largest `∫ φ² dS` on the surface for an energy of one, of potentials that are sums of solid harmonics.
    fn ritz(depth: f64) -> (f64, f64) {
        let (top, edge) = (depth - 1.0, (depth * (2.0 - depth)).sqrt());
        let on_disc = |f: &dyn Fn(&[f64]) -> f64| {
            PI * integral(0.0, edge, |rho| f(&solid_harmonics(rho, top)) * rho)
        };
        let on_wall = |f: &dyn Fn(&[f64], f64) -> f64| {
            let at = |z: f64| ((1.0 - z * z).max(0.0).sqrt(), z);
            PI * integral(-1.0, top, |z| f(&solid_harmonics(at(z).0, z), at(z).0))
        };
        let surface = DMatrix::from_fn(N, N, |i, j| on_disc(&|S| S[i + 1] * S[j + 1]));
        let energy = DMatrix::from_fn(N, N, |i, j| {
            let n = (j + 1) as f64;
            on_disc(&|S| S[i + 1] * (n + 1.0) * S[j]) + n * on_wall(&|S, _| S[i + 1] * S[j + 1])
        });
        let across = DVector::from_fn(N, |i, _| on_wall(&|S, rho| S[i + 1] * rho));
        let scale = DVector::from_fn(N, |i, _| 1.0 / energy[(i, i)].sqrt());
        let scaled = |M: &DMatrix<f64>| {
            DMatrix::from_fn(N, N, |i, j| 0.5 * (M[(i, j)] + M[(j, i)]) * scale[i] * scale[j])
        };
        // What harmonics of high order add is lost in the rounding: left out.
        let SymmetricEigen { eigenvalues, eigenvectors } = scaled(&energy).symmetric_eigen();
        let kept: Vec<usize> = (0..N).filter(|&i| eigenvalues[i] > 1e-12).collect();
        let unit = DMatrix::from_fn(N, kept.len(), |i, k| {
            eigenvectors[(i, kept[k])] / eigenvalues[kept[k]].sqrt()
        });
        let modes = (unit.transpose() * scaled(&surface) * &unit).symmetric_eigen();
        let first = modes.eigenvalues.imax();
        let mode = (unit * modes.eigenvectors.column(first)).component_mul(&scale);
        let momentum = mode.dot(&across);
        let volume = PI * depth * depth * (1.0 - depth / 3.0);
        (1.0 / modes.eigenvalues[first], momentum * momentum / volume)
    }

    /// Between the rows of the tables as at them. Measured 1.5e-5 up to a depth of 1.4 radii, and 2e-3 near
    /// the top, where next to nothing swings.
    #[test]
    fn the_pendulum_in_a_sphere_is_the_first_mode_of_the_potential_flow() {
        for (depth, close) in [(0.35, 2e-5), (1.0, 2e-5), (1.35, 2e-5), (1.65, 3e-4), (1.85, 3e-3)]
        {
            let liquid = SPHERE.density * 0.343 * PI * depth * depth * (1.0 - depth / 3.0);
            let p = SloshPendulum::of(&SPHERE, liquid).unwrap();
            let (square, share) = ritz(depth);
            let off = [p.length / 0.7 * square - 1.0, p.mass / liquid - share];
            assert!(off.iter().all(|x| x.abs() < close), "{depth}: {off:?}");
            assert_eq!(p.hinge_height, 0.7);
        }
    }

    /// A hemisphere of 10 ft at 10 ft/s²: 0.1988 Hz by finite elements, demonstration 3-3-1 of NASTRAN,
    /// table 1.
    #[test]
    fn a_half_full_sphere_swings_as_fast_as_by_finite_elements() {
        let slosh = Slosh { shape: TankShape::Sphere { radius: 10.0 }, ..TANK };
        let p = SloshPendulum::of(&slosh, 0.5 * slosh.shape.capacity() * slosh.density).unwrap();
        let frequency = (10.0 / p.length).sqrt() / (2.0 * PI);
        assert!((frequency - 0.1988).abs() < 5e-5, "{frequency} Hz");
    }

    /// `2 ζ ω m L²` at `ω² = a/L + k/(m L²)`.
    #[test]
    fn the_damping_ratio_is_that_of_the_swing_that_is_restored() {
        let p = SloshPendulum::of(&TANK, 500.0).unwrap();
        let inertia = p.mass * p.length * p.length;
        let by_gravity = 2.0 * 0.01 * (0.3 / p.length).sqrt() * inertia;
        assert!((p.damping / by_gravity - 1.0).abs() < 1e-14);
        let sprung = Slosh { acceleration: 0.0, stiffness: 7.0, ..TANK };
        let by_spring = 2.0 * 0.01 * (7.0 * inertia).sqrt();
        let p = SloshPendulum::of(&sprung, 500.0).unwrap();
        assert!((p.damping / by_spring - 1.0).abs() < 1e-14);
    }

    #[test]
    fn a_film_and_what_is_no_number_do_not_swing() {
        let film = 0.99 * 0.07 * TANK.density * 0.49 * PI;
        for liquid in [film, 0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert_eq!(SloshPendulum::of(&TANK, liquid), None, "{liquid}");
        }
        assert!(SloshPendulum::of(&TANK, film * 1.02).is_some());
        for slosh in [TANK, SPHERE] {
            let full = slosh.shape.capacity() * slosh.density;
            assert_eq!(SloshPendulum::of(&slosh, full * 1.001), None, "no room");
            assert!(SloshPendulum::of(&slosh, full * 0.98).is_some());
        }
    }
}
