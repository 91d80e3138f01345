//! Inverse dynamics against momentum rates, energy and the Lagrangian form.

use crate::in_time::{Rate, in_time};
use crate::measure::{dense, dense_vector, for_every_robot};
use nalgebra::DMatrix;
use wrasse_dynamics::{
    BodyId, Frame, Generalized, MassMatrix, PerBody, State, bias_force, inverse_dynamics, jacobian,
    kinematics, kinetic_energy, mass_matrix,
};
use wrasse_spatial::{At, Dual, Pose, SpatialForce, SpatialVelocity};
use wrasse_testing::random_robot::{JOINTS, Scene};
use wrasse_testing::{gap, gap_at, larger, largest, size};

fn nothing() -> PerBody<SpatialForce<f64>, JOINTS> {
    PerBody::filled(SpatialForce::zero())
}

/// Rate of each body's momentum about No in inertial axes, less the external wrench on it: exact,
/// through no recursion but that of the poses and twists.
fn pushed(scene: &Scene) -> PerBody<SpatialForce<f64>, JOINTS> {
    let robot = scene.robot.cast::<Dual<f64>>();
    let moving = in_time(&scene.state, &scene.nudot);
    let k_moving = kinematics(&robot, &moving);
    let k = kinematics(&scene.robot, &scene.state);
    let mut pushed = nothing();
    for body in scene.robot.bodies() {
        let h_B = *robot.inertia(body) * k_moving.V_NB_B(body);
        let rate = k_moving.X_NB(body).force_to_parent(&h_B).rate();
        pushed[body] = rate - k.X_NB(body).force_to_parent(&scene.external[body]);
    }
    pushed
}

/// Sums of up to 13 bodies, seen from 3 m away. Measured 4e-15.
#[test]
fn every_joint_carries_the_momentum_rate_of_the_bodies_behind_it() {
    for_every_robot(1e-13, |s| {
        let k = kinematics(&s.robot, &s.state);
        let dynamics = inverse_dynamics(&k, &s.nudot, &s.external);
        let alone = pushed(s);
        let scale = largest(s.robot.bodies().map(|b| size(&alone[b])));
        largest(s.robot.bodies().map(|body| {
            let behind = |b: &BodyId| match body {
                BodyId::Base => true,
                BodyId::Link(j) => s.robot.path_to_base(*b).any(|at| at == j),
            };
            let sum = s.robot.bodies().filter(behind);
            let F_N = sum.fold(SpatialForce::zero(), |F, b| F + alone[b]);
            let F_B = k.X_NB(body).force_to_child(&F_N);
            let along = match body {
                BodyId::Base => gap_at(&dynamics.force.base, &F_B, scale),
                BodyId::Link(j) => {
                    let S = s.robot.joint(j).velocity(1.0);
                    gap_at(&dynamics.force.joints[j], &S.power(&F_B), scale)
                }
            };
            larger(along, gap_at(&dynamics.F_B_B(&k, body), &F_B, scale))
        }))
    });
}

/// Two algorithms that share the kinematics. Measured 1e-15.
#[test]
fn the_forces_are_mass_times_acceleration_plus_bias_less_what_comes_from_outside() {
    for_every_robot(1e-13, |s| {
        let k = kinematics(&s.robot, &s.state);
        let found = inverse_dynamics(&k, &s.nudot, &s.external).force;
        let mut sum = dense(&mass_matrix(&k)) * dense_vector(&s.robot, &s.nudot)
            + dense_vector(&s.robot, &bias_force(&k));
        for body in s.robot.bodies() {
            // Σ Jᵀ F, with the wrench in inertial axes at the body's origin.
            let J_body = jacobian(&k, &Frame { body, X_BF: Pose::identity() });
            let (R, F) = (k.X_NB(body).rotation, s.external[body]);
            let F_N = SpatialForce::new(R * F.torque, R * F.force);
            let of_base = J_body.base();
            let of_joints = J_body.joints.columns();
            let columns = of_base.iter().chain(&of_joints[..s.robot.joint_count()]);
            for (row, column) in columns.enumerate() {
                sum[row] -= column.power(&F_N);
            }
        }
        gap(&dense_vector(&s.robot, &found), &sum)
    });
}

/// dT/dt = τ·ν, exactly differentiated; the powers of 13 bodies cancel in part. Measured 2e-15.
#[test]
fn what_the_motors_put_in_is_what_the_kinetic_energy_gains() {
    for_every_robot(1e-13, |s| {
        let k = kinematics(&s.robot, &s.state);
        let force = inverse_dynamics(&k, &s.nudot, &nothing()).force;
        let robot = s.robot.cast::<Dual<f64>>();
        let moving = in_time(&s.state, &s.nudot);
        let gained = kinetic_energy(&kinematics(&robot, &moving)).rate();
        let powers: Vec<f64> = dense_vector(&s.robot, &force)
            .iter()
            .zip(dense_vector(&s.robot, &s.state.velocity()).iter())
            .map(|(f, v)| f * v)
            .collect();
        gap_at(&gained, &powers.iter().sum::<f64>(), size(&powers))
    });
}

/// The rate of the whole mass matrix along the motion.
fn mass_matrix_rate(scene: &Scene, state: &State<f64, JOINTS>) -> DMatrix<f64> {
    let robot = scene.robot.cast::<Dual<f64>>();
    let moving = in_time(state, &Generalized::default());
    let M: MassMatrix<Dual<f64>, JOINTS> = mass_matrix(&kinematics(&robot, &moving));
    let size = 6 + scene.robot.joint_count();
    DMatrix::from_fn(size, size, |i, j| M.element(i, j).derivative)
}

/// `νᵀ (Ṁ - 2C) ν = 0`: with a free base, whose rates are no derivatives of coordinates, this is
/// what is left of the skew symmetry. Measured 2e-15.
#[test]
fn the_bias_force_does_half_the_work_of_the_changing_mass_matrix() {
    for_every_robot(1e-13, |s| {
        let nu = dense_vector(&s.robot, &s.state.velocity());
        let work = (mass_matrix_rate(s, &s.state) * &nu).component_mul(&nu);
        let c = dense_vector(&s.robot, &bias_force(&kinematics(&s.robot, &s.state)));
        let bias_work = c.component_mul(&nu);
        gap_at(&(0.5 * work.sum()), &bias_work.sum(), larger(size(&work), size(&bias_work)))
    });
}

/// Where q̇ = v, `C` is made of the Christoffel symbols of the joint block, and with it `Ṁ - 2C` is
/// skew; the base rests. What cancels on the way is of the size of the mass matrix at unit rates:
/// its rate is summed from turns of the axes that leave it alone. Measured 7e-15.
#[test]
fn the_bias_of_the_joints_is_the_christoffel_product_while_the_base_rests() {
    for_every_robot(1e-13, |s| {
        let n = s.robot.joint_count();
        let partial: Vec<DMatrix<f64>> = (0..n)
            .map(|k| {
                let mut state = State { V_NB_B: SpatialVelocity::zero(), ..s.state };
                state.v = std::array::from_fn(|j| f64::from(j == k));
                mass_matrix_rate(s, &state).view((6, 6), (n, n)).into_owned()
            })
            .collect();
        let v = &s.state.v;
        let C = DMatrix::from_fn(n, n, |i, j| {
            (0..n).fold(0.0, |sum, k| {
                let symbol = partial[k][(i, j)] + partial[j][(i, k)] - partial[i][(j, k)];
                sum + 0.5 * symbol * v[k]
            })
        });
        let qdot = nalgebra::DVector::from_column_slice(&v[..n]);
        let state = State { V_NB_B: SpatialVelocity::zero(), ..s.state };
        let c = bias_force(&kinematics(&s.robot, &state));
        let c = nalgebra::DVector::from_column_slice(&c.joints[..n]);
        let M = dense(&mass_matrix(&kinematics(&s.robot, &state)));
        let scale = largest([size(&c), size(&C), size(&M.view((6, 6), (n, n)).into_owned())]);
        let mut Mdot = DMatrix::zeros(n, n);
        for k in 0..n {
            Mdot += &partial[k] * v[k];
        }
        let skew = &Mdot - 2.0 * &C;
        larger(gap_at(&(&C * qdot), &c, scale), gap_at(&skew, &-skew.transpose(), scale))
    });
}

/// What no joint is behind stays zero, element by element: in the mass matrix off the diagonal too.
/// Measured 0: nothing is written there.
#[test]
fn joints_that_are_not_there_take_no_force() {
    for_every_robot(0.0, |s| {
        let k = kinematics(&s.robot, &s.state);
        let n = s.robot.joint_count();
        let force = inverse_dynamics(&k, &s.nudot, &s.external).force;
        let M = mass_matrix(&k);
        let of_nothing = |i: usize, j: usize| if i.max(j) < n { 0.0 } else { M.M_jj[i][j] };
        let beyond: Vec<f64> = (0..JOINTS * JOINTS)
            .map(|ij| of_nothing(ij / JOINTS, ij % JOINTS))
            .chain(force.joints[n..].iter().copied())
            .chain((n..JOINTS).flat_map(|j| M.M_bj.at(j).to_array()))
            .collect();
        size(&beyond)
    });
}
