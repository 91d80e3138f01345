//! Derivatives of forward dynamics against dual numbers, and against those of inverse dynamics.

use crate::inverse_dynamics_derivatives_laws::{
    displace, dual_external, dual_force, dual_state, vary, vary_six, worst,
};
use crate::measure::{dense, for_every_robot};
use nalgebra::DMatrix;
use std::array;
use wrasse_dynamics::{
    ForwardDynamicsDerivatives, Generalized, GeneralizedForce, GeneralizedVelocity, PerBody, State,
    forward_dynamics, forward_dynamics_derivatives, inverse_dynamics_derivatives,
    inverse_mass_matrix, kinematics, mass_matrix,
};
use wrasse_spatial::{Dual, Lanes, Pose, Real, SpatialForce, SpatialVelocity};
use wrasse_testing::random_robot::{JOINTS, Scene};
use wrasse_testing::{gap, larger, largest, size};

type D = Dual<f64>;
type DualForce = GeneralizedForce<D, JOINTS>;

/// Forces of the size of the scene's other forces; nothing beyond the last joint.
fn force(s: &Scene) -> GeneralizedForce<f64, JOINTS> {
    Generalized { base: s.external.links[0], joints: s.xi }
}

fn found(s: &Scene) -> ForwardDynamicsDerivatives<f64, JOINTS> {
    forward_dynamics_derivatives(&kinematics(&s.robot, &s.state), &force(s), &s.external)
}

/// Rate of change of the accelerations where state or force vary, through articulated bodies.
fn by_duals(
    s: &Scene,
    vary: impl Fn(&mut State<D, JOINTS>, &mut DualForce),
) -> GeneralizedVelocity<f64, JOINTS> {
    let (robot, mut state, given) = (s.robot.cast(), dual_state(&s.state), force(s));
    let mut force: DualForce =
        Generalized { base: dual_force(&given.base), joints: given.joints.map(D::from_f64) };
    vary(&mut state, &mut force);
    let nudot = forward_dynamics(&kinematics(&robot, &state), &force, &dual_external(s));
    Generalized {
        base: SpatialVelocity::from_array(nudot.base.to_array().map(|x| x.derivative)),
        joints: nudot.joints.map(|x| x.derivative),
    }
}

/// Articulated bodies against the inverse mass matrix. Measured 1e-13.
#[test]
fn the_accelerations_that_are_differentiated_are_those_of_forward_dynamics() {
    for_every_robot(1e-11, |s| {
        let nudot = forward_dynamics(&kinematics(&s.robot, &s.state), &force(s), &s.external);
        gap(&found(s).nudot, &nudot)
    });
}

/// Duals through articulated bodies: the two routes share the joints' poses only. Round-off times
/// the condition of M, up to 4e4 here. Measured 7e-13.
#[test]
fn the_accelerations_change_with_joint_positions_as_duals_say() {
    for_every_robot(1e-11, |s| {
        let d = found(s).by_position;
        worst(s.robot.joints().map(|j| (d.column(j), by_duals(s, |x, _| vary(&mut x.q[j])))))
    });
}

/// As above. Measured 6e-13.
#[test]
fn the_accelerations_change_with_joint_rates_as_duals_say() {
    for_every_robot(1e-11, |s| {
        let d = found(s).by_rate;
        worst(s.robot.joints().map(|j| (d.column(j), by_duals(s, |x, _| vary(&mut x.v[j])))))
    });
}

/// As above. Measured 1e-13.
#[test]
fn the_accelerations_change_with_the_twist_of_the_base_as_duals_say() {
    for_every_robot(1e-11, |s| {
        let d = found(s).by_base_velocity;
        worst((0..6).map(|c| (d.column(c), by_duals(s, |x, _| vary_six(&mut x.V_NB_B, c)))))
    });
}

/// As above. Measured 1e-13.
#[test]
fn the_accelerations_change_with_the_forces_as_duals_say() {
    for_every_robot(1e-11, |s| {
        let d = found(s).by_force;
        let whole = |c: usize| {
            let mut unit = Generalized { base: SpatialForce::zero(), joints: [0.0; JOINTS] };
            match c.checked_sub(6) {
                None => {
                    let mut six = [0.0; 6];
                    six[c] = 1.0;
                    unit.base = SpatialForce::from_array(six);
                }
                Some(j) => unit.joints[j] = 1.0,
            }
            d.times(&unit)
        };
        let base = (0..6).map(|c| {
            let varied = by_duals(s, |_, f| {
                let mut six = f.base.to_array();
                vary(&mut six[c]);
                f.base = SpatialForce::from_array(six);
            });
            (whole(c), varied)
        });
        let joints = s.robot.joints();
        let joints = joints.map(|j| (whole(6 + j), by_duals(s, |_, f| vary(&mut f.joints[j]))));
        worst(base.chain(joints))
    });
}

/// Relative to the largest elements of both. Measured 2e-16.
#[test]
fn the_inverse_mass_matrix_undoes_the_mass_matrix() {
    for_every_robot(1e-14, |s| {
        let blocks = mass_matrix(&kinematics(&s.robot, &s.state));
        let (d, M) = (inverse_mass_matrix(&s.robot, &blocks), dense(&blocks));
        let size = M.nrows();
        let inverse = DMatrix::from_fn(size, size, |i, j| d.element(i, j));
        let scale = inverse.amax() * M.amax();
        (&M * &inverse - DMatrix::identity(size, size)).amax() / scale
    });
}

/// What the accelerations give way, and what force that takes, undo what the state asks for:
/// `∂τ/∂x + M ∂ν̇/∂x = 0` at the same motion. Measured 2e-14.
#[test]
fn the_accelerations_give_way_to_all_the_force_that_a_change_asks_for() {
    for_every_robot(1e-12, |s| {
        let (k, d) = (kinematics(&s.robot, &s.state), found(s));
        let asked = inverse_dynamics_derivatives(&k, &d.nudot, &s.external);
        let n = s.robot.joint_count();
        let M = dense(&mass_matrix(&k));
        let matrix = |base: &dyn Fn(usize) -> [f64; 6], joints: &[[f64; JOINTS]; JOINTS]| {
            DMatrix::from_fn(6 + n, n, |i, j| {
                i.checked_sub(6).map_or_else(|| base(j)[i], |i| joints[i][j])
            })
        };
        [(asked.by_position, d.by_position), (asked.by_rate, d.by_rate)].iter().fold(
            0.0,
            |m: f64, (force, acceleration)| {
                let force = matrix(&|j| force.base[j].to_array(), &force.joints);
                let given = &M * matrix(&|j| acceleration.base[j].to_array(), &acceleration.joints);
                larger(m, gap(&force, &-given))
            },
        )
    });
}

/// In free space nothing depends on where the base is and how it is turned: duals of forward
/// dynamics say so. Measured 0.
#[test]
fn the_accelerations_do_not_change_with_the_pose_of_the_base() {
    for_every_robot(0.0, |s| {
        largest((0..6).map(|c| size(&by_duals(s, |x, _| displace(&mut x.X_NB, c)))))
    });
}

/// Two states side by side: the second has other positions and rates.
fn two_at_once(s: &Scene) -> ForwardDynamicsDerivatives<Lanes<2>, JOINTS> {
    type L = Lanes<2>;
    let beside = |a: f64, b: f64| L::from_fn(|lane| [a, b][lane]);
    let joints = |a: &[f64; JOINTS]| array::from_fn(|j| beside(a[j], 0.7 * a[j] - 0.1));
    let wrench = |F: &SpatialForce<f64>| SpatialForce::from_array(F.to_array().map(L::from_f64));
    let robot = s.robot.cast();
    let state = State {
        X_NB: Pose::from_f64(&s.state.X_NB),
        V_NB_B: SpatialVelocity::from_array(s.state.V_NB_B.to_array().map(|x| beside(x, -x))),
        q: joints(&s.state.q),
        v: joints(&s.state.v),
    };
    let external = PerBody {
        base: wrench(&s.external.base),
        links: array::from_fn(|j| wrench(&s.external.links[j])),
    };
    let force =
        Generalized { base: wrench(&force(s).base), joints: force(s).joints.map(L::from_f64) };
    forward_dynamics_derivatives(&kinematics(&robot, &state), &force, &external)
}

/// Nothing is decided on a value, so a state gives the same numbers beside another. Measured 0.
#[test]
fn derivatives_in_a_lane_are_exactly_those_alone() {
    for_every_robot(0.0, |s| {
        let (alone, both) = (found(s), two_at_once(s));
        let lane = |rows: [[Lanes<2>; JOINTS]; JOINTS]| rows.map(|row| row.map(|x| x.lane(0)));
        let six = |columns: [SpatialVelocity<Lanes<2>>; JOINTS]| {
            columns.map(|V| V.to_array().map(|x| x.lane(0)))
        };
        let pairs = [
            (lane(both.by_position.joints), alone.by_position.joints),
            (lane(both.by_rate.joints), alone.by_rate.joints),
            (lane(both.by_force.A_jj), alone.by_force.A_jj),
        ];
        let joints = largest(pairs.iter().map(|(a, b)| gap(a, b)));
        let base = alone.by_rate.base.map(SpatialVelocity::to_array);
        larger(joints, gap(&six(both.by_rate.base), &base))
    });
}
