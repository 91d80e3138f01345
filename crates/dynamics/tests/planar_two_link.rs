//! The planar free-flyer with two links of Papadopoulos and Dubowsky (1993): dynamic singularity
//! and workspace, against the table in `validation/` and a closed form that shares nothing with the
//! kernels.
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]
#![allow(clippy::unwrap_used, reason = "a test may stop where it finds nothing")]
#![allow(clippy::print_stdout, reason = "prints what was measured, under --nocapture")]

use std::f64::consts::PI;
use std::{array, fs, path::PathBuf};
use toml::{Table, Value};
use wrasse_dynamics::{
    BodyId, Frame, Joint, JointKind, MassProperties, Robot, State, barycentric_vectors,
    generalized_jacobian, jacobian, kinematics, mass_matrix,
};
use wrasse_spatial::{Pose, Sym3, Vec3, vec3};
use wrasse_testing::{larger, largest};

/// `J*` in the plane: rows x and y, columns q1 and q2.
type Planar = [[f64; 2]; 2];

/// Base and two links, each along its own x axis.
struct Chain {
    mass: [f64; 3],
    inertia: [f64; 3],
    /// Joint to centre of mass, and centre of mass to the next joint or the tip (m).
    before: [f64; 3],
    behind: [f64; 3],
}

fn table() -> Table {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../validation");
    fs::read_to_string(folder.join("planar_two_link.toml")).unwrap().parse().unwrap()
}

fn number(value: &Value) -> f64 {
    value.as_float().unwrap()
}

fn numbers<const N: usize>(value: &Value) -> [f64; N] {
    array::from_fn(|i| number(&value[i]))
}

fn chain() -> Chain {
    let p = &table()["parameters"];
    Chain {
        mass: numbers(&p["mass_kg"]),
        inertia: numbers(&p["inertia_kg_m2"]),
        before: numbers(&p["from_joint_m"]),
        behind: numbers(&p["to_next_joint_m"]),
    }
}

impl Chain {
    fn robot(&self) -> (Robot<f64, 2>, Frame<f64>) {
        let along = |x: f64| vec3(x, 0.0, 0.0);
        let matter = |i: usize| {
            let I = self.inertia[i];
            MassProperties::from_central(
                self.mass[i],
                along(self.before[i]),
                Sym3::diagonal(I, I, I),
            )
        };
        let at = |x: f64| Pose { translation: along(x), ..Pose::identity() };
        let turning =
            |parent, x| Joint::new(parent, JointKind::Revolute, at(x), vec3(0.0, 0.0, 1.0));
        let length = |i: usize| self.before[i] + self.behind[i];
        let links = [
            (turning(BodyId::Base, length(0)), matter(1)),
            (turning(BodyId::Link(0), length(1)), matter(2)),
        ];
        let robot = Robot::new(matter(0), &links).unwrap();
        (robot, Frame { body: BodyId::Link(1), X_BF: at(length(2)) })
    }
    /// `J*` by the kernels.
    fn J_free(&self, q: [f64; 2]) -> Planar {
        let (robot, frame) = self.robot();
        let state = State { q, ..State::default() };
        let k = kinematics(&robot, &state);
        let columns = generalized_jacobian(&jacobian(&k, &frame), &mass_matrix(&k)).columns();
        [columns.map(|c| c.linear.x), columns.map(|c| c.linear.y)]
    }
    /// Distance of the tip from the system's centre of mass (m).
    fn radius(&self, q: [f64; 2]) -> f64 {
        let (robot, frame) = self.robot();
        let state = State { q, ..State::default() };
        let k = kinematics(&robot, &state);
        (k.pose(&frame).translation - k.centre_of_mass().1).norm()
    }
    /// Lengths a, b, c of the virtual manipulator (m).
    fn lengths(&self) -> [f64; 3] {
        let (robot, frame) = self.robot();
        let state = State::default();
        let lambda = barycentric_vectors(&kinematics(&robot, &state), &frame);
        [lambda.base, lambda.links[0], lambda.links[1]].map(Vec3::norm)
    }
    /// `J*` in closed form: each centre of mass, and the tip, is a sum of unit vectors along the
    /// bodies, counted from the system's centre of mass; zero angular momentum gives the base's
    /// rate.
    fn J_closed(&self, q: [f64; 2]) -> Planar {
        let m_T: f64 = self.mass.iter().sum();
        let length: [f64; 3] = array::from_fn(|i| self.before[i] + self.behind[i]);
        let from_base = |i: usize| -> [f64; 3] {
            array::from_fn(|k| match k {
                k if k < i => length[k],
                k if k == i => self.before[i],
                _ => 0.0,
            })
        };
        let centre: [f64; 3] =
            array::from_fn(|k| (0..3).map(|i| self.mass[i] * from_base(i)[k]).sum::<f64>() / m_T);
        let rho = |i: usize| -> [f64; 3] { array::from_fn(|k| from_base(i)[k] - centre[k]) };
        let theta = [0.0, q[0], q[0] + q[1]];
        // Angular momentum per rate of each body's angle.
        let w: [f64; 3] = array::from_fn(|j| {
            let coupled = (0..3).flat_map(|i| (0..3).map(move |k| (i, k)));
            coupled.fold(self.inertia[j], |sum, (i, k)| {
                sum + self.mass[i] * rho(i)[j] * rho(i)[k] * (theta[j] - theta[k]).cos()
            })
        });
        let all = w[0] + w[1] + w[2];
        let base_rate = [-(w[1] + w[2]) / all, -w[2] / all];
        let tip: [f64; 3] = array::from_fn(|k| length[k] - centre[k]);
        let rates: [[f64; 3]; 2] =
            array::from_fn(|c| array::from_fn(|body| base_rate[c] + f64::from(body > c)));
        let row = |turned: [f64; 3]| rates.map(|r| (0..3).map(|k| tip[k] * r[k] * turned[k]).sum());
        [row(theta.map(|t| -t.sin())), row(theta.map(f64::cos))]
    }
    fn determinant(&self, q: [f64; 2]) -> f64 {
        let [[a, b], [c, d]] = self.J_free(q);
        a * d - b * c
    }
    /// Where `det J*` is zero for this q1, q2 between two angles (rad).
    fn singular_q2(&self, q1: f64, mut low: f64, mut high: f64) -> f64 {
        let sign = self.determinant([q1, low]).signum();
        assert!(sign != self.determinant([q1, high]).signum(), "no root at q1 = {q1}");
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if self.determinant([q1, middle]).signum() == sign {
                low = middle;
            } else {
                high = middle;
            }
        }
        0.5 * (low + high)
    }
    /// Least and largest tip radius of the singular postures with q2 around an angle (rad).
    fn singular_belt(&self, around: f64) -> [f64; 2] {
        (-1800..=1800).fold([f64::INFINITY, 0.0], |[least, most], tenth: i32| {
            let q1 = f64::from(tenth) * 0.1_f64.to_radians();
            let q2 = self.singular_q2(q1, around - 1.0, around + 1.0);
            let r = self.radius([q1, q2]);
            [r.min(least), larger(r, most)]
        })
    }
}

fn radians(value: &Value) -> [f64; 2] {
    numbers::<2>(value).map(f64::to_radians)
}

#[track_caller]
fn agree(what: &str, found: &[f64], expected: &[f64], tolerance: f64) {
    let worst = largest(found.iter().zip(expected).map(|(a, b)| (a - b).abs()));
    println!("{what}: {worst:.1e}");
    assert_eq!(found.len(), expected.len());
    assert!(worst <= tolerance, "{what}: {found:?} is not {expected:?} within {tolerance}");
}

#[test]
fn the_generalized_jacobian_has_the_listed_values() {
    let (chain, table) = (chain(), table());
    let listed = &table["jacobian"];
    let postures = listed["posture"].as_array().unwrap();
    assert_eq!(postures.len(), 3);
    for posture in postures {
        let J = chain.J_free(radians(&posture["q_deg"]));
        let rows: [[f64; 2]; 2] = array::from_fn(|i| numbers(&posture["rows"][i]));
        let tolerance = number(&listed["tolerance"]["absolute"]);
        agree("J*", J.as_flattened(), rows.as_flattened(), tolerance);
    }
}

/// The closed form shares only the parameters. Angles up to 190 rad. Measured 1e-14.
#[test]
fn the_generalized_jacobian_is_that_of_the_closed_form() {
    let chain = chain();
    for step in 0..100 {
        let q = [0.7 * f64::from(step), 1.9 * f64::from(step) + 0.1];
        let (J, closed) = (chain.J_free(q), chain.J_closed(q));
        agree("closed form", J.as_flattened(), closed.as_flattened(), 1e-13);
    }
}

#[test]
fn the_determinant_has_the_listed_values() {
    let (chain, table) = (chain(), table());
    let listed = &table["determinant"];
    let postures = listed["posture"].as_array().unwrap();
    assert_eq!(postures.len(), 4);
    for posture in postures {
        let found = chain.determinant(radians(&posture["q_deg"]));
        let tolerance = number(&listed["tolerance"]["absolute"]);
        agree("det J*", &[found], &[number(&posture["value"])], tolerance);
    }
}

#[test]
fn the_dynamic_singularity_lies_where_it_was_published() {
    let (chain, table) = (chain(), table());
    for key in ["published_singularity", "dynamic_singularity"] {
        let listed = &table[key];
        let q1 = number(&listed["q1_deg"]).to_radians();
        let q2 = chain.singular_q2(q1, -0.5, 0.0).to_degrees();
        let tolerance = number(&listed["tolerance"]["absolute_deg"]);
        agree(key, &[q2], &[number(&listed["q2_deg"])], tolerance);
    }
}

/// On a fixed base the same posture is regular: the singularity is the dynamics'. `l1 l2 sin q2`
/// with links of 1 m.
#[test]
fn the_posture_is_regular_on_a_fixed_base() {
    let (robot, frame) = chain().robot();
    let q2 = chain().singular_q2(-65_f64.to_radians(), -0.5, 0.0);
    let state = State { q: [-65_f64.to_radians(), q2], ..State::default() };
    let [a, b] = jacobian(&kinematics(&robot, &state), &frame).joints.columns().map(|c| c.linear);
    let fixed = a.x * b.y - b.x * a.y;
    assert!((fixed - q2.sin()).abs() < 1e-15, "{fixed}, not {}", q2.sin());
    assert!(fixed.abs() > 0.19);
}

#[test]
fn the_virtual_manipulator_has_the_listed_lengths() {
    let (chain, table) = (chain(), table());
    let listed = &table["virtual_manipulator"];
    let (lengths, tolerance) = (chain.lengths(), number(&listed["tolerance"]["absolute_m"]));
    agree("lengths", &lengths, &numbers::<3>(&listed["lengths_m"]), tolerance);
    agree("reach", &[lengths.iter().sum()], &[number(&listed["reach_m"])], tolerance);
    agree("straight", &[chain.radius([0.0, 0.0])], &[number(&listed["reach_m"])], tolerance);
}

#[test]
fn the_singular_postures_fill_the_listed_belts() {
    let (chain, table) = (chain(), table());
    let (outer, inner) = (chain.singular_belt(0.0), chain.singular_belt(PI));
    let listed = &table["singular_loci"];
    let tolerance = number(&listed["tolerance"]["absolute_m"]);
    agree("outer", &outer, &numbers::<2>(&listed["outer_m"]), tolerance);
    agree("inner", &inner, &numbers::<2>(&listed["inner_m"]), tolerance);
    // What lies between the belts is reached without meeting a singularity, whatever the path.
    let listed = &table["path_independent_workspace"];
    let belts: [[f64; 2]; 2] = array::from_fn(|i| numbers(&listed["belts_m"][i]));
    let found = [[0.0, inner[0]], [inner[1], outer[0]]];
    let tolerance = number(&listed["tolerance"]["absolute_m"]);
    agree("workspace", found.as_flattened(), belts.as_flattened(), tolerance);
}
