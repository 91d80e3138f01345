//! Arms by Denavit-Hartenberg rows, against the textbooks' matrices.

#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

use wrasse_dynamics::{State, kinematics};
use wrasse_spatial::Vec3;
use wrasse_testing::larger;
use wrasse_vehicle::{JOINTS, Vehicle, read_vehicle};

type Matrix = [[f64; 4]; 4];

/// (a, alpha, d, theta) of the file, in m and rad.
const ROWS: [[f64; 4]; 3] =
    [[0.31, -72.0, 0.22, 25.0], [-0.13, 48.0, 0.41, -110.0], [0.27, 90.0, -0.08, 12.0]];
/// Travel of each joint: rad, m, rad.
const TRAVEL: [f64; 3] = [0.7, 0.35, -1.1];

fn vehicle(convention: &str) -> Vehicle {
    let text = include_str!("data/denavit_hartenberg.toml").replace("CONVENTION", convention);
    read_vehicle("denavit_hartenberg.toml", text).expect("a file without mistakes")
}

fn product(a: &Matrix, b: &Matrix) -> Matrix {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..4).map(|k| a[i][k] * b[k][j]).sum()))
}

/// Frame i from frame i−1, as Denavit and Hartenberg write it.
fn standard([a, alpha, d, theta]: [f64; 4]) -> Matrix {
    let ((sa, ca), (st, ct)) = (alpha.sin_cos(), theta.sin_cos());
    [
        [ct, -st * ca, st * sa, a * ct],
        [st, ct * ca, -ct * sa, a * st],
        [0.0, sa, ca, d],
        [0.0, 0.0, 0.0, 1.0],
    ]
}

/// Frame i from frame i−1, as Craig writes it; a and alpha are those of link i−1.
fn modified([a, alpha, d, theta]: [f64; 4]) -> Matrix {
    let ((sa, ca), (st, ct)) = (alpha.sin_cos(), theta.sin_cos());
    [
        [ct, -st, 0.0, a],
        [st * ca, ct * ca, -sa, -sa * d],
        [st * sa, ct * sa, ca, ca * d],
        [0.0, 0.0, 0.0, 1.0],
    ]
}

/// The mount of the file: roll 15, pitch −40, yaw 70 degrees.
fn mount() -> Matrix {
    let turn = |deg: f64, axis: usize| {
        let (s, c) = deg.to_radians().sin_cos();
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        let mut m = [[0.0; 4]; 4];
        (m[axis][axis], m[3][3]) = (1.0, 1.0);
        (m[u][u], m[u][v], m[v][u], m[v][v]) = (c, -s, s, c);
        m
    };
    let mut m = product(&product(&turn(70.0, 2), &turn(-40.0, 1)), &turn(15.0, 0));
    (m[0][3], m[1][3], m[2][3]) = (0.5, -0.3, 0.7);
    m
}

/// Largest distance of any body's frame from the textbook's.
fn deviation(convention: &str, textbook: impl Fn([f64; 4]) -> Matrix) -> f64 {
    let vehicle = vehicle(convention);
    assert_eq!(vehicle.joint_names, ["turn", "push", "bend"]);
    let mut state = State::<f64, JOINTS>::default();
    state.q[..3].copy_from_slice(&TRAVEL);
    let poses = kinematics(&vehicle.robot, &state);
    let (mut expected, mut worst) = (mount(), 0.0_f64);
    for (i, name) in ["turret", "slide", "hand"].into_iter().enumerate() {
        let [a, alpha, d, theta] = ROWS[i];
        let (d, theta) = match i {
            1 => (d + TRAVEL[1], theta.to_radians()),
            _ => (d, theta.to_radians() + TRAVEL[i]),
        };
        expected = product(&expected, &textbook([a, alpha.to_radians(), d, theta]));
        let X = poses.pose(&vehicle.frame(name).expect(name));
        let (rows, p) = (X.rotation.rows.map(Vec3::to_array), X.translation.to_array());
        for r in 0..3 {
            for (found, expected) in rows[r].iter().chain([&p[r]]).zip(expected[r]) {
                worst = larger(worst, (found - expected).abs());
            }
        }
    }
    worst
}

#[test]
fn standard_rows_put_each_body_where_denavit_and_hartenberg_do() {
    let off = deviation("standard", standard);
    assert!(off < 2e-15, "a few round-offs of metres; measured 3.4e-16: {off:e}");
}

#[test]
fn modified_rows_put_each_body_where_craig_does() {
    let off = deviation("modified", modified);
    assert!(off < 2e-15, "a few round-offs of metres; measured 2.3e-16: {off:e}");
}

#[test]
fn the_two_conventions_are_told_apart() {
    let (off, also_off) = (deviation("standard", modified), deviation("modified", standard));
    assert!(off > 0.1 && also_off > 0.1, "{off} {also_off}");
}

#[test]
fn mass_properties_are_given_in_the_body_frame_of_either_convention() {
    for convention in ["standard", "modified"] {
        let vehicle = vehicle(convention);
        let state = State::<f64, JOINTS>::default();
        let poses = kinematics(&vehicle.robot, &state);
        // Centre of mass of the whole, from the bodies' frames and the numbers of the file.
        let bodies = [
            ("bus", 100.0, [0.1, -0.2, 0.05]),
            ("turret", 5.0, [-0.1, 0.02, 0.03]),
            ("slide", 4.0, [0.04, 0.05, -0.1]),
            ("hand", 3.0, [0.0, 0.01, 0.02]),
        ];
        let moment = bodies.map(|(name, mass, p)| {
            let X = poses.pose(&vehicle.frame(name).expect(name));
            X.point(Vec3::from_array(p)) * mass
        });
        let sum = moment.into_iter().fold(Vec3::zero(), |sum, m| sum + m);
        let (mass, p_cm) = poses.centre_of_mass();
        let off = (p_cm - sum * (1.0 / 112.0)).norm();
        assert!((mass - 112.0).abs() < 1e-12 && off < 1e-15, "measured 2.8e-17: {off:e}");
    }
}
