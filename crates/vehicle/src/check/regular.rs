//! Whether the mass matrix is regular in every posture: then a piece between two joints may be without
//! mass, and a body may be a point or a rod.
//!
//! First by a bound that no posture changes. What a body carries adds to its inertia as the joints see
//! it (the articulated inertia of Featherstone), and never takes from it. A child whose own matter
//! resists every motion adds at least some resistance to every motion of its parent but the one along
//! its own joint, and the axis of that joint stands still in the parent. So the inertia of the body,
//! plus for each such child all motions but that one, is below the articulated inertia in every posture
//! but for a factor above zero. Where it resists the motion of the body's joint, the pivot of that joint
//! is above zero in every posture; where it resists every motion, the body is such a child itself.
//!
//! What that bound leaves open (three hinges and more with nothing between them) is looked for: in
//! many postures, and from the worst of them downhill. A singular posture that is found is an error;
//! if none is found, a warning says that it was looked for and not proved.

use crate::vehicle::VehicleRobot;
use core::f64::consts::{FRAC_PI_2, PI};
use nalgebra::{Matrix6, SymmetricEigen, Vector6};
use wrasse_dynamics::{BodyId, Joint, JointKind, State, kinematics, mass_matrix};
use wrasse_spatial::{SpatialInertia, Vec3};

/// What is known of the mass matrix.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Regularity {
    /// It is regular in every posture.
    Proved,
    /// It is regular in every posture that was looked at: number of postures, and the least pivot as a
    /// part of its diagonal element (–).
    Sampled(usize, f64),
    /// It is singular in this posture, by the pivots of these rows: 0 to 5 are the base's.
    Singular { q: Vec<f64>, rows: Vec<usize> },
}

/// Least eigenvalue of a scaled inertia, and least pivot as a part of its diagonal element, that is
/// told from zero (–). Round-off of both is a few 1e-16 times the number of rows.
const REGULAR: f64 = 1e-13;
/// Postures that are looked at besides those with one joint at a quarter turn.
const POSTURES: usize = 400;
/// A travel that is as good as none (rad or m).
const ENDLESS: f64 = 1e3;
/// Worst postures from which a worse one is looked for.
const DESCENTS: usize = 3;
/// Postures that are looked at on the way down from each: enough for twenty joints to come to rest.
const STEPS: usize = 1500;

/// What is known of the mass matrix of a robot with these travels (rad or m; `None`: a whole turn, or a
/// metre either way).
pub(crate) fn regularity(robot: &VehicleRobot, travels: &[Option<(f64, f64)>]) -> Regularity {
    if holds_in_every_posture(robot) {
        return Regularity::Proved;
    }
    let ends = travel_or_usual(robot, travels);
    let mut looked: Vec<_> =
        postures(&ends).into_iter().map(|q| (least_pivot(robot, &q), q)).collect();
    // The first that is singular is the simplest.
    if let Some((_, q)) = looked.iter().find(|(pivot, _)| *pivot < REGULAR) {
        return singular(robot, &ends, q.clone());
    }
    looked.sort_by(|a, b| a.0.total_cmp(&b.0));
    let count = looked.len();
    let worst = looked.into_iter().take(DESCENTS).map(|(_, q)| downhill(robot, &ends, q));
    match worst.min_by(|a, b| a.0.total_cmp(&b.0)) {
        Some((pivot, q)) if pivot < REGULAR => singular(robot, &ends, q),
        Some((pivot, _)) => Regularity::Sampled(count, pivot),
        None => Regularity::Proved,
    }
}

/// A singular posture, with all joints at zero that may be.
fn singular(robot: &VehicleRobot, ends: &[(f64, f64)], mut q: Vec<f64>) -> Regularity {
    for (j, &(lower, upper)) in ends.iter().enumerate() {
        let at = std::mem::replace(&mut q[j], 0f64.clamp(lower, upper));
        if least_pivot(robot, &q) >= REGULAR {
            q[j] = at;
        }
    }
    let pivots = pivots(robot, &q).into_iter().enumerate();
    let rows = pivots.filter(|(_, pivot)| *pivot < REGULAR).map(|(row, _)| row).collect();
    Regularity::Singular { q, rows }
}

/// The ends of travel of each joint (rad or m): where none are given, a whole turn, or a metre either way.
pub(crate) fn travel_or_usual(
    robot: &VehicleRobot,
    travels: &[Option<(f64, f64)>],
) -> Vec<(f64, f64)> {
    let ends = |j: usize| {
        let given = travels.get(j).copied().flatten();
        let within = |(a, b): &(f64, f64)| a <= b && a.abs().max(b.abs()) < ENDLESS;
        given.filter(within).unwrap_or(usual_travel(robot.joint(j).kind))
    };
    robot.joints().map(ends).collect()
}

fn usual_travel(kind: JointKind) -> (f64, f64) {
    match kind {
        JointKind::Revolute => (-PI, PI),
        JointKind::Prismatic => (-1.0, 1.0),
    }
}

/// The bound that no posture changes.
fn holds_in_every_posture(robot: &VehicleRobot) -> bool {
    let length = length(robot);
    let count = robot.joint_count();
    // What each body's children add to it, base first.
    let mut added = vec![Matrix6::zeros(); count + 1];
    for j in (0..count).rev() {
        let joint = robot.joint(j);
        let resists = scaled(robot.inertia(BodyId::Link(j)), length) + added[j + 1];
        let own = motion(joint, false, length);
        let has_rotor = joint.rotor_inertia > 0.0;
        let along_joint = own.dot(&(resists * own));
        if least_eigenvalue(&resists) < -REGULAR || (along_joint < REGULAR && !has_rotor) {
            return false;
        }
        if least_eigenvalue(&resists) > REGULAR {
            // A rotor keeps the joint from giving way for nothing: then no motion is left out.
            let along = motion(joint, true, length) * if has_rotor { 0.0 } else { 1.0 };
            let parent = match joint.parent {
                BodyId::Base => 0,
                BodyId::Link(p) => p + 1,
            };
            added[parent] += Matrix6::identity() - along * along.transpose();
        }
    }
    least_eigenvalue(&(scaled(robot.inertia(BodyId::Base), length) + added[0])) > REGULAR
}

/// A length of the robot's size (m), so that turning and sliding are weighed alike.
fn length(robot: &VehicleRobot) -> f64 {
    let offsets = robot.joints().map(|j| robot.joint(j).X_PB_zero.translation.norm());
    let arms = robot.bodies().filter_map(|body| {
        let M = robot.inertia(body);
        (M.mass > 0.0).then(|| (M.rotational.xx + M.rotational.yy + M.rotational.zz) / M.mass)
    });
    let longest = offsets.chain(arms.map(|square| square.abs().sqrt())).fold(0.0, f64::max);
    if longest > 0.0 { longest } else { 1.0 }
}

/// An inertia as a matrix without unit, of the order of one; zero for none.
fn scaled(M: &SpatialInertia<f64>, length: f64) -> Matrix6<f64> {
    let rows = M.to_matrix();
    let unit = |k: usize| if k < 3 { 1.0 / length } else { 1.0 };
    let matrix = Matrix6::from_fn(|i, k| rows[i][k] * unit(i) * unit(k));
    let size = matrix.amax();
    if size > 0.0 { matrix / size } else { matrix }
}

/// The motion of a joint as a unit vector: of the body that it carries about its origin, in its axes; or
/// seen from the parent, where it is the same in every posture.
fn motion(joint: &Joint<f64>, from_parent: bool, length: f64) -> Vector6<f64> {
    let X = &joint.X_PB_zero;
    let axis = if from_parent { X.rotation * joint.axis_B } else { joint.axis_B };
    let lever = if from_parent { X.translation } else { Vec3::zero() };
    let (turn, slide) = match joint.kind {
        JointKind::Revolute => (axis, lever.cross(axis)),
        JointKind::Prismatic => (Vec3::zero(), axis),
    };
    let [turn, slide] = [turn * length, slide].map(Vec3::to_array);
    Vector6::from_iterator(turn.into_iter().chain(slide)).normalize()
}

fn least_eigenvalue(matrix: &Matrix6<f64>) -> f64 {
    let eigen = SymmetricEigen::try_new(*matrix, f64::EPSILON, 300);
    eigen.map_or(f64::NEG_INFINITY, |eigen| eigen.eigenvalues.min())
}

/// Postures to look at: zero; each joint alone at quarter turns and at its ends; and a spread of all.
pub(crate) fn postures(ends: &[(f64, f64)]) -> Vec<Vec<f64>> {
    let zero: Vec<f64> = ends.iter().map(|&(lower, upper)| 0f64.clamp(lower, upper)).collect();
    let mut all = vec![zero.clone()];
    for (j, &(lower, upper)) in ends.iter().enumerate() {
        for at in [-FRAC_PI_2, FRAC_PI_2, PI, lower, upper] {
            let mut q = zero.clone();
            q[j] = at.clamp(lower, upper);
            all.push(q);
        }
    }
    for k in 1..=POSTURES {
        let spread = |(j, &(lower, upper)): (usize, &(f64, f64))| {
            // Fractional parts of multiples of square roots: even in each joint, and the same always.
            let part = (k as f64 * ((j + 2) as f64 + 0.5).sqrt()).fract();
            lower + part * (upper - lower)
        };
        all.push(ends.iter().enumerate().map(spread).collect());
    }
    all
}

/// The least pivot of the mass matrix as a part of its diagonal element (–).
fn least_pivot(robot: &VehicleRobot, q: &[f64]) -> f64 {
    pivots(robot, q).into_iter().fold(1.0, f64::min)
}

/// The pivots of the mass matrix, each as a part of its diagonal element (–). A row without one is left
/// out of the elimination: those after it still tell of themselves.
fn pivots(robot: &VehicleRobot, q: &[f64]) -> Vec<f64> {
    let mut state = State::default();
    state.q.iter_mut().zip(q).for_each(|(to, from)| *to = *from);
    let k = kinematics(robot, &state);
    let M = mass_matrix(&k);
    let rows = robot.joint_count() + 6;
    let mut lower: Vec<f64> =
        (0..rows * rows).map(|place| M.element(place / rows, place % rows)).collect();
    let diagonal: Vec<f64> = (0..rows).map(|p| lower[p * rows + p]).collect();
    let mut parts = vec![];
    for p in 0..rows {
        let pivot = lower[p * rows + p];
        let part = if diagonal[p] > 0.0 { pivot / diagonal[p] } else { 0.0 };
        parts.push(part);
        if part < REGULAR {
            continue;
        }
        eliminate(&mut lower, rows, p);
    }
    parts
}

/// Takes the row and column of a pivot out of those behind it. By plain indices: some thousand matrices of
/// sixty rows are looked at, in a crate that is built without optimisation.
fn eliminate(lower: &mut [f64], rows: usize, p: usize) {
    let pivot = lower[p * rows + p];
    let mut i = p + 1;
    while i < rows {
        let factor = lower[i * rows + p] / pivot;
        let mut k = p + 1;
        while factor != 0.0 && k <= i {
            lower[i * rows + k] -= factor * lower[k * rows + p];
            k += 1;
        }
        i += 1;
    }
}

/// From a posture to a worse one: one joint after the other is moved by less and less, within its travel.
fn downhill(robot: &VehicleRobot, ends: &[(f64, f64)], mut q: Vec<f64>) -> (f64, Vec<f64>) {
    let mut worst = least_pivot(robot, &q);
    let (mut step, mut looked) = (0.25, 0);
    while step > 1e-9 && worst >= REGULAR && looked < STEPS {
        looked += 2 * ends.len();
        let before = worst;
        for (j, &(lower, upper)) in ends.iter().enumerate() {
            for side in [-1.0, 1.0] {
                let at = q[j];
                q[j] = (at + side * step).clamp(lower, upper);
                let here = least_pivot(robot, &q);
                if here < worst {
                    worst = here;
                } else {
                    q[j] = at;
                }
            }
        }
        if worst >= 0.9 * before {
            step *= 0.5;
        }
    }
    (worst, q)
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::f64::consts::FRAC_PI_3;
    use wrasse_dynamics::MassProperties;
    use wrasse_spatial::{Pose, Sym3, vec3};

    const X: [f64; 3] = [1.0, 0.0, 0.0];
    const Y: [f64; 3] = [0.0, 1.0, 0.0];
    const Z: [f64; 3] = [0.0, 0.0, 1.0];

    fn boom() -> MassProperties<f64> {
        let inertia = Sym3::diagonal(0.1, 0.4, 0.4);
        MassProperties::from_central(4.0, vec3(0.5, 0.0, 0.0), inertia)
    }

    fn rod() -> MassProperties<f64> {
        MassProperties::from_central(4.0, vec3(0.5, 0.0, 0.0), Sym3::diagonal(0.0, 0.4, 0.4))
    }

    /// A chain of hinges about these axes through one point, each with what it carries.
    fn chain(hinges: &[([f64; 3], MassProperties<f64>)]) -> VehicleRobot {
        let bus = MassProperties::from_central(50.0, Vec3::zero(), Sym3::diagonal(8.0, 9.0, 10.0));
        let mut parent = BodyId::Base;
        let mut links = vec![];
        for (j, (axis, matter)) in hinges.iter().enumerate() {
            let axis = Vec3::from_array(*axis);
            let joint = Joint::new(parent, JointKind::Revolute, Pose::identity(), axis);
            links.push((joint, *matter));
            parent = BodyId::Link(j);
        }
        VehicleRobot::new(bus, &links).unwrap()
    }

    fn found(hinges: &[([f64; 3], MassProperties<f64>)]) -> Regularity {
        regularity(&chain(hinges), &[])
    }

    #[test]
    fn one_massless_piece_between_two_hinges_is_proved_regular_unless_their_axes_are_one() {
        let nothing = MassProperties::default();
        assert_eq!(found(&[(Z, nothing), (Y, boom())]), Regularity::Proved);
        let parallel = found(&[(Z, nothing), (Z, boom())]);
        assert!(
            matches!(parallel, Regularity::Singular { ref rows, .. } if *rows == [7]),
            "{parallel:?}"
        );
    }

    #[test]
    fn three_crossed_hinges_without_mass_between_are_singular_at_gimbal_lock_and_only_there() {
        let nothing = MassProperties::default();
        let gimbal = [(Z, nothing), (Y, nothing), (X, boom())];
        let Regularity::Singular { q, .. } = found(&gimbal) else { panic!("not found") };
        assert!((q[1].abs() - FRAC_PI_2).abs() < 1e-6, "{q:?}");
        let short = [None, Some((-FRAC_PI_3, FRAC_PI_3)), None];
        let within = regularity(&chain(&gimbal), &short);
        assert!(matches!(within, Regularity::Sampled(_, least) if least > 0.01), "{within:?}");
        // Nor is a lock missed that lies between the samples.
        let aslant = [1.0, 0.3, 0.2];
        let slanted = found(&[(Z, nothing), (Y, nothing), (aslant, boom())]);
        assert!(matches!(slanted, Regularity::Singular { .. }), "{slanted:?}");
    }

    #[test]
    fn a_rod_is_singular_about_itself_and_regular_about_any_other_axis() {
        assert_eq!(found(&[(Z, rod())]), Regularity::Proved);
        let spun = found(&[(X, rod())]);
        assert!(matches!(spun, Regularity::Singular { ref rows, .. } if *rows == [6]), "{spun:?}");
        assert_eq!(found(&[(X, boom())]), Regularity::Proved);
    }

    #[test]
    fn a_base_without_mass_is_singular_with_one_boom_and_regular_with_two_that_differ() {
        let of = |axes: &[[f64; 3]]| {
            let links: Vec<_> = axes
                .iter()
                .map(|axis| {
                    let axis = Vec3::from_array(*axis);
                    let X_PB = Pose::identity();
                    (Joint::new(BodyId::Base, JointKind::Revolute, X_PB, axis), boom())
                })
                .collect();
            VehicleRobot::new(MassProperties::default(), &links).unwrap()
        };
        assert!(matches!(regularity(&of(&[Z]), &[]), Regularity::Singular { .. }));
        assert_eq!(regularity(&of(&[Z, Y]), &[]), Regularity::Proved);
    }
}
