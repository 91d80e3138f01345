//! Derivatives of inverse dynamics against dual numbers, and against differences.

use crate::measure::{dense, for_every_robot};
use std::array;
use wrasse_dynamics::{
    Generalized, GeneralizedForce, GeneralizedVelocity, InverseDynamicsDerivatives, PerBody, State,
    inverse_dynamics, inverse_dynamics_derivatives, kinematics, mass_matrix,
};
use wrasse_spatial::{Dual, Mat3, Pose, Real, SpatialForce, SpatialVelocity};
use wrasse_testing::random_robot::{JOINTS, Scene};
use wrasse_testing::{gap, gap_at, largest, size};

type D = Dual<f64>;

/// A unit of one number, which varies.
const VARIED: D = Dual { value: 0.0, derivative: 1.0 };

pub(crate) fn dual_force(F: &SpatialForce<f64>) -> SpatialForce<D> {
    SpatialForce::from_array(F.to_array().map(D::from_f64))
}
pub(crate) fn dual_velocity(V: &SpatialVelocity<f64>) -> SpatialVelocity<D> {
    SpatialVelocity::from_array(V.to_array().map(D::from_f64))
}
pub(crate) fn dual_state(s: &State<f64, JOINTS>) -> State<D, JOINTS> {
    State {
        X_NB: Pose::from_f64(&s.X_NB),
        V_NB_B: dual_velocity(&s.V_NB_B),
        q: s.q.map(D::from_f64),
        v: s.v.map(D::from_f64),
    }
}
pub(crate) fn dual_external(s: &Scene) -> PerBody<SpatialForce<D>, JOINTS> {
    let links = array::from_fn(|j| dual_force(&s.external.links[j]));
    PerBody { base: dual_force(&s.external.base), links }
}

/// The six of the base's, and one varied.
pub(crate) fn vary_six(V: &mut SpatialVelocity<D>, c: usize) {
    let mut six = V.to_array();
    six[c] += VARIED;
    *V = SpatialVelocity::from_array(six);
}

/// The base's pose displaced by a unit twist along one of six, in base axes.
pub(crate) fn displace(X_NB: &mut Pose<D>, c: usize) {
    let mut twist = SpatialVelocity::zero();
    vary_six(&mut twist, c);
    let R = X_NB.rotation;
    *X_NB = Pose::new(
        R * (Mat3::identity() + twist.angular.skew()),
        X_NB.translation + R * twist.linear,
    );
}

pub(crate) fn vary(x: &mut D) {
    *x += VARIED;
}

/// Rate of change of the forces where state or acceleration vary.
fn by_duals(
    s: &Scene,
    vary: impl Fn(&mut State<D, JOINTS>, &mut GeneralizedVelocity<D, JOINTS>),
) -> GeneralizedForce<f64, JOINTS> {
    let (robot, mut state) = (s.robot.cast(), dual_state(&s.state));
    let joints = s.nudot.joints.map(D::from_f64);
    let mut nudot = Generalized { base: dual_velocity(&s.nudot.base), joints };
    vary(&mut state, &mut nudot);
    let force = inverse_dynamics(&kinematics(&robot, &state), &nudot, &dual_external(s)).force;
    Generalized {
        base: SpatialForce::from_array(force.base.to_array().map(|x| x.derivative)),
        joints: force.joints.map(|x| x.derivative),
    }
}

fn found(s: &Scene) -> InverseDynamicsDerivatives<f64, JOINTS> {
    inverse_dynamics_derivatives(&kinematics(&s.robot, &s.state), &s.nudot, &s.external)
}

/// The forces come with their derivatives. Measured 2e-15.
#[test]
fn the_forces_that_are_differentiated_are_those_of_inverse_dynamics() {
    for_every_robot(1e-13, |s| {
        let force = inverse_dynamics(&kinematics(&s.robot, &s.state), &s.nudot, &s.external).force;
        gap(&found(s).force, &force)
    });
}

/// Two routes to one exact derivative; they share the joints' poses. Measured 4e-15.
#[test]
fn the_forces_change_with_joint_positions_as_duals_say() {
    for_every_robot(1e-13, |s| {
        let d = found(s).by_position;
        let columns =
            s.robot.joints().map(|j| (d.column(j), by_duals(s, |x, _| vary(&mut x.q[j]))));
        worst(columns)
    });
}

/// As above. Measured 7e-15.
#[test]
fn the_forces_change_with_joint_rates_as_duals_say() {
    for_every_robot(1e-13, |s| {
        let d = found(s).by_rate;
        let columns =
            s.robot.joints().map(|j| (d.column(j), by_duals(s, |x, _| vary(&mut x.v[j]))));
        worst(columns)
    });
}

/// As above. Measured 2e-15.
#[test]
fn the_forces_change_with_the_twist_of_the_base_as_duals_say() {
    for_every_robot(1e-13, |s| {
        let d = found(s).by_base_velocity;
        worst((0..6).map(|c| (d.column(c), by_duals(s, |x, _| vary_six(&mut x.V_NB_B, c)))))
    });
}

/// Largest difference of two matrices from their columns, relative to the largest element.
pub(crate) fn worst<B: Copy>(
    columns: impl Iterator<Item = (Generalized<B, f64, JOINTS>, Generalized<B, f64, JOINTS>)>,
) -> f64
where
    Generalized<B, f64, JOINTS>: wrasse_testing::Numbers,
{
    let columns: Vec<_> = columns.collect();
    let scale = largest(columns.iter().map(|(_, b)| size(b)));
    largest(columns.iter().map(|(a, b)| gap_at(a, b, scale)))
}

/// In free space nothing depends on where the base is and how it is turned: duals through inverse
/// dynamics say so. Measured 0.
#[test]
fn the_forces_do_not_change_with_the_pose_of_the_base() {
    for_every_robot(0.0, |s| {
        largest((0..6).map(|c| size(&by_duals(s, |x, _| displace(&mut x.X_NB, c)))))
    });
}

/// Both are sums over composite bodies, by different routes. Measured 8e-16.
#[test]
fn the_derivative_by_acceleration_is_the_mass_matrix() {
    for_every_robot(1e-13, |s| {
        let M = mass_matrix(&kinematics(&s.robot, &s.state));
        gap(&dense(&found(s).by_acceleration), &dense(&M))
    });
}

/// Forces at a state a step along joint positions and rates, and along the base's twist.
fn stepped(s: &Scene, h: f64) -> GeneralizedForce<f64, JOINTS> {
    let mut state = s.state;
    for j in s.robot.joints() {
        state.q[j] += h * s.xi[j];
        state.v[j] += h * s.nudot.joints[j];
    }
    state.V_NB_B += s.nudot.base * h;
    inverse_dynamics(&kinematics(&s.robot, &state), &s.nudot, &s.external).force
}

/// Error of fourth order in the step of 1e-3, and round-off over the step. Measured 5e-11.
#[test]
fn a_small_step_changes_the_forces_by_their_derivatives() {
    for_every_robot(1e-9, |s| {
        let d = found(s);
        let mut foretold: GeneralizedForce<f64, JOINTS> = Generalized::default();
        let mut add = |column: GeneralizedForce<f64, JOINTS>, by: f64| {
            foretold.base += column.base * by;
            (0..JOINTS).for_each(|i| foretold.joints[i] += column.joints[i] * by);
        };
        for j in s.robot.joints() {
            add(d.by_position.column(j), s.xi[j]);
            add(d.by_rate.column(j), s.nudot.joints[j]);
        }
        let of_base = s.nudot.base.to_array();
        (0..6).for_each(|c| add(d.by_base_velocity.column(c), of_base[c]));
        let h = 1e-3;
        let at = [stepped(s, h), stepped(s, -h), stepped(s, 2.0 * h), stepped(s, -2.0 * h)];
        let slope = |x: [f64; 4]| (8.0 * (x[0] - x[1]) - (x[2] - x[3])) / (12.0 * h);
        let six = at.map(|f| f.base.to_array());
        let differences: GeneralizedForce<f64, JOINTS> = Generalized {
            base: SpatialForce::from_array(array::from_fn(|i| slope(six.map(|f| f[i])))),
            joints: array::from_fn(|i| slope(at.map(|f| f.joints[i]))),
        };
        gap(&foretold, &differences)
    });
}
