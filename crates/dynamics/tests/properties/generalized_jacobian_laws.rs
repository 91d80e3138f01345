//! The generalized and the attitude-held Jacobian: identities, limits, operational space.

use crate::in_time::{Rate, in_time};
use crate::measure::{dense, dense_columns, dense_joints, for_every_robot};
use nalgebra::{DMatrix, DVector};
use wrasse_dynamics::{
    BodyId, Generalized, Jacobian, Kinematics, MassMatrix, MassProperties, Momentum, PerBody,
    Robot, State, angular_momentum_per_rate, attitude_held_jacobian, bias_acceleration, bias_force,
    forward_dynamics, free_floating_dynamics, generalized_jacobian, jacobian, kinematics,
    mass_matrix, momentum, velocity_from_momentum,
};
use wrasse_spatial::{At, Dual, SpatialForce, SpatialMomentum, SpatialVelocity, Sym3, Vec3};
use wrasse_testing::random_robot::{JOINTS, Scene};
use wrasse_testing::{gap, gap_at, larger, largest, size};

/// What every law here starts from.
struct Posture<'a> {
    k: Kinematics<'a, f64, JOINTS>,
    M: MassMatrix<f64, JOINTS>,
    J_frame: Jacobian<f64, JOINTS>,
    n: usize,
}

impl<'a> Posture<'a> {
    fn new(s: &'a Scene) -> Self {
        let k = kinematics(&s.robot, &s.state);
        let (M, J_frame) = (mass_matrix(&k), jacobian(&k, &s.frame));
        Self { k, M, J_frame, n: s.robot.joint_count() }
    }
    fn free(&self) -> [SpatialVelocity<f64>; JOINTS] {
        generalized_jacobian(&self.J_frame, &self.M).columns()
    }
    fn held(&self) -> [SpatialVelocity<f64>; JOINTS] {
        attitude_held_jacobian(&self.J_frame, &self.M, &self.k.state.X_NB.rotation).columns()
    }
    /// `J q̇`.
    fn times(&self, columns: &[SpatialVelocity<f64>; JOINTS]) -> SpatialVelocity<f64> {
        let rates = self.k.state.v;
        columns.iter().zip(rates).fold(SpatialVelocity::zero(), |V, (c, rate)| V + *c * rate)
    }
    /// Locked inertia of the whole system about its centre of mass, inertial axes, body by body.
    fn locked_inertia(&self, p_NScm: Vec3<f64>) -> Sym3<f64> {
        self.k.robot.bodies().fold(Sym3::zero(), |I, body| {
            let X_NB = &self.k.X_NB(body);
            I + X_NB.inertia_to_parent(self.k.robot.inertia(body)).about(p_NScm).rotational
        })
    }
}

fn in_base_axes(s: &Scene, h: &Momentum<f64>) -> SpatialMomentum<f64> {
    let R = s.state.X_NB.rotation;
    SpatialMomentum::new(R.transpose_mul(h.angular), R.transpose_mul(h.linear))
}

/// Measured 3e-15.
#[test]
fn the_twist_of_a_frame_is_that_of_the_joints_plus_that_of_the_momentum() {
    for_every_robot(1e-13, |s| {
        let posture = Posture::new(s);
        let h_B = in_base_axes(s, &momentum(&posture.k));
        let drift = velocity_from_momentum(&posture.J_frame, &posture.M, &h_B);
        let sum = posture.times(&posture.free()) + drift;
        let scale = larger(size(&drift), size(&s.state.v));
        gap_at(&sum, &posture.k.velocity(&s.frame), scale)
    });
}

/// `ẋ_h = [w_h; p/m_T + w_h × d]`, `w_h = I_cm⁻¹ L`, body by body in inertial axes.
/// Measured 3e-14.
#[test]
fn momentum_turns_the_locked_system_about_its_centre_of_mass() {
    for_every_robot(1e-12, |s| {
        let posture = Posture::new(s);
        let h = momentum(&posture.k);
        let h_B = in_base_axes(s, &h);
        let w = posture.locked_inertia(h.p_NScm_N).solve(h.angular);
        let d = posture.k.pose(&s.frame).translation - h.p_NScm_N;
        let expected = SpatialVelocity::new(w, h.linear * (1.0 / h.mass) + w.cross(d));
        gap(&velocity_from_momentum(&posture.J_frame, &posture.M, &h_B), &expected)
    });
}

/// `J* = J̄ - [1; -[d]×] I_cm⁻¹ H_w`: the attitude-held Jacobian less the turning of the base.
/// Measured 1e-14.
#[test]
fn the_generalized_jacobian_is_the_attitude_held_one_less_the_turn_of_the_base() {
    for_every_robot(1e-12, |s| {
        let posture = Posture::new(s);
        let h = momentum(&posture.k);
        let I_cm = posture.locked_inertia(h.p_NScm_N);
        let d = posture.k.pose(&s.frame).translation - h.p_NScm_N;
        let (held, H_w) = (posture.held(), angular_momentum_per_rate(&posture.M));
        let expected: Vec<_> = (0..posture.n)
            .map(|j| {
                let w = I_cm.solve(s.state.X_NB.rotation * H_w[j]);
                held[j] - SpatialVelocity::new(w, w.cross(d))
            })
            .collect();
        gap(&posture.free()[..posture.n].to_vec(), &expected)
    });
}

/// `J̄_v = J_tip - J_com` of the arm on a fixed base, the latter by exact derivative; `J̄_w =
/// J_tip`. Measured 4e-16.
#[test]
fn the_attitude_held_jacobian_is_that_of_the_tip_less_that_of_the_centre_of_mass() {
    for_every_robot(1e-14, |s| {
        let posture = Posture::new(s);
        let robot = s.robot.cast::<Dual<f64>>();
        let expected: Vec<_> = (0..posture.n)
            .map(|j| {
                let v = std::array::from_fn(|i| f64::from(i == j));
                let state = State { V_NB_B: SpatialVelocity::zero(), v, ..s.state };
                let moving = in_time(&state, &Generalized::default());
                let v_cm = kinematics(&robot, &moving).centre_of_mass().1.rate();
                let tip = posture.J_frame.joints.at(j);
                SpatialVelocity::new(tip.angular, tip.linear - v_cm)
            })
            .collect();
        gap(&posture.held()[..posture.n].to_vec(), &expected)
    });
}

/// `v_e = v_cm + w_0 × (p - p_cm) + J̄_v q̇`, `w_e = w_0 + J̄_w q̇`: any attitude rate, any
/// momentum. Measured 2e-15.
#[test]
fn the_attitude_held_jacobian_gives_the_twist_at_any_attitude_rate_and_momentum() {
    for_every_robot(1e-13, |s| {
        let posture = Posture::new(s);
        let h = momentum(&posture.k);
        let w_0 = s.state.X_NB.rotation * s.state.V_NB_B.angular;
        let d = posture.k.pose(&s.frame).translation - h.p_NScm_N;
        let base = SpatialVelocity::new(w_0, h.linear * (1.0 / h.mass) + w_0.cross(d));
        gap(&(base + posture.times(&posture.held())), &posture.k.velocity(&s.frame))
    });
}

/// `J M⁻¹ Jᵀ = J* H*⁻¹ J*ᵀ + J_b M_bb⁻¹ J_bᵀ`: a force from outside meets less inertia than one
/// from the joints. Measured 6e-15.
#[test]
fn a_force_from_outside_meets_less_inertia_than_one_from_the_joints() {
    for_every_robot(1e-13, |s| {
        let posture = Posture::new(s);
        let columns =
            [&posture.J_frame.base()[..], &posture.J_frame.joints.columns()[..posture.n]].concat();
        let J = dense_columns(&columns);
        let whole = &J * dense(&posture.M).cholesky().unwrap().solve(&J.transpose());
        let c = bias_force(&posture.k);
        let H = free_floating_dynamics(&s.robot, &posture.M, &c).H;
        let J_free = dense_columns(&posture.free()[..posture.n]);
        let solved = dense_joints(&H, posture.n).cholesky().unwrap().solve(&J_free.transpose());
        gap(&whole, &(J_free * solved + base_mobility(&posture)))
    });
}

/// `B = J_b M_bb⁻¹ J_bᵀ`.
fn base_mobility(posture: &Posture) -> DMatrix<f64> {
    let J_b = dense_columns(&posture.J_frame.base());
    let M_bb = dense(&posture.M).view((0, 0), (6, 6)).into_owned();
    &J_b * M_bb.cholesky().unwrap().solve(&J_b.transpose())
}

/// At rest, `τ = -J*ᵀ F` keeps the joints still under a tip wrench F, and the tip accelerates by
/// `B F` with the base. Measured 9e-13.
#[test]
fn a_tip_wrench_is_held_by_the_generalized_jacobian_and_accelerates_the_base() {
    for_every_robot(1e-11, |s| {
        let state = State { v: [0.0; JOINTS], V_NB_B: SpatialVelocity::zero(), ..s.state };
        let still = Scene { state, ..*s };
        let posture = Posture::new(&still);
        let F_N = s.external.base;
        let joints = posture.free().map(|column| -column.power(&F_N));
        let force = Generalized { base: SpatialForce::zero(), joints };
        let mut external = PerBody::filled(SpatialForce::zero());
        let X_NF = posture.k.pose(&s.frame);
        let at_Bo = F_N.about(posture.k.X_NB(s.frame.body).translation - X_NF.translation);
        let R = posture.k.X_NB(s.frame.body).rotation;
        external[s.frame.body] =
            SpatialForce::new(R.transpose_mul(at_Bo.torque), R.transpose_mul(at_Bo.force));
        let found = forward_dynamics(&posture.k, &force, &external);
        let A = posture.J_frame.times(&found);
        let expected = base_mobility(&posture) * DVector::from_column_slice(&F_N.to_array());
        // Without the motors the joints would give way as fast as this.
        let slack = forward_dynamics(&posture.k, &Generalized::default(), &external).joints;
        larger(
            gap_at(&found.joints, &[0.0; JOINTS], size(&slack)),
            gap(&A.to_array().to_vec(), &expected.as_slice().to_vec()),
        )
    });
}

/// Pressed against a wall with `τ = J*ᵀ n f_d`, a free-flyer gives `η f_d`,
/// `η = (J* H*⁻¹ J*ᵀ)_n / (J M⁻¹ Jᵀ)_n < 1`: what the wall moves more than the motors is the base,
/// `B_n`. By forward dynamics. Measured 1e-15.
#[test]
fn a_free_flyer_presses_on_a_wall_with_less_than_its_joints_ask_for() {
    for_every_robot(1e-13, |s| {
        let state = State { v: [0.0; JOINTS], V_NB_B: SpatialVelocity::zero(), ..s.state };
        let still = Scene { state, ..*s };
        let posture = Posture::new(&still);
        let normal = s.external.base.force * (1.0 / s.external.base.force.norm());
        let n = SpatialForce::new(Vec3::zero(), normal);
        let none = PerBody::filled(SpatialForce::zero());
        let motors = posture.free().map(|column| column.power(&n));
        let driven = Generalized { base: SpatialForce::zero(), joints: motors };
        // The wall pushes on everything that moves the tip, base and joints.
        let all = |column: &SpatialVelocity<f64>| column.power(&n);
        let wall = Generalized {
            base: SpatialForce::from_array(posture.J_frame.base().each_ref().map(all)),
            joints: posture.J_frame.joints.columns().each_ref().map(all),
        };
        let along = |force| {
            let nudot = forward_dynamics(&posture.k, &force, &none);
            posture.J_frame.times(&nudot).power(&n)
        };
        let (by_motors, by_wall) = (along(driven), along(wall));
        let eta = by_motors / by_wall;
        let B_n = n.to_array();
        let B_n = DVector::from_column_slice(&B_n)
            .dot(&(base_mobility(&posture) * DVector::from_column_slice(&B_n)));
        assert!(eta > 0.0 && eta < 1.0, "eta {eta}");
        gap(&by_wall, &(by_motors + B_n))
    });
}

/// `ẍ = J* q̈ + J̇ν - J_b M_bb⁻¹ c_b` for a base that nothing pushes. Measured 8e-16.
#[test]
fn the_tip_accelerates_with_the_joints_and_the_bias_of_the_free_base() {
    for_every_robot(1e-14, |s| {
        let posture = Posture::new(s);
        let motors = Generalized { base: SpatialForce::zero(), joints: s.xi };
        let none = PerBody::filled(SpatialForce::zero());
        let nudot = forward_dynamics(&posture.k, &motors, &none);
        let bias = bias_acceleration(&posture.k, &s.frame);
        let whole = posture.J_frame.times(&nudot) + bias;
        let recoil = posture.M.M_bb.velocity_of(&bias_force(&posture.k).base);
        let mut reduced = bias - posture.J_frame.of_base(&recoil);
        for (column, qddot) in posture.free().iter().zip(nudot.joints) {
            reduced += *column * qddot;
        }
        gap_at(&reduced, &whole, larger(size(&whole), size(&nudot)))
    });
}

/// Columns that a robot whose base is `s` times heavier has; `mass` says whether its mass grows
/// too.
fn heavy(scene: &Scene, s: f64, mass: bool) -> (DMatrix<f64>, DMatrix<f64>, DMatrix<f64>) {
    let M = scene.robot.inertia(BodyId::Base);
    let (m, p, I) = (M.mass, M.centre_of_mass(), M.central());
    let grown = if mass { m * s } else { m };
    let base = MassProperties::from_central(grown, p, I.scaled(s));
    let links: Vec<_> = scene
        .robot
        .joints()
        .map(|j| {
            let M = scene.robot.inertia(BodyId::Link(j));
            let matter = MassProperties::from_central(M.mass, M.centre_of_mass(), M.central());
            (*scene.robot.joint(j), matter)
        })
        .collect();
    let robot = Robot::new(base, &links).unwrap();
    let scene = Scene { robot, ..*scene };
    let posture = Posture::new(&scene);
    let n = posture.n;
    let fixed = dense_columns(&posture.J_frame.joints.columns()[..n]);
    (dense_columns(&posture.free()[..n]), dense_columns(&posture.held()[..n]), fixed)
}

/// The distance to the limit falls tenfold per decade of base mass and inertia: over four decades
/// the product of both is constant to the next order, which is the arm's inertia over the base's,
/// up to 100/s. Measured 2e-3, from s = 1e5 on.
#[test]
fn a_heavy_base_makes_the_robot_a_fixed_base_one_along_a_straight_line() {
    for_every_robot(2e-3, |scene| {
        straight_line(|s| {
            let (free, _, fixed) = heavy(scene, s, true);
            size(&(&free - &fixed)) * s
        })
    });
}

/// The same with a base that is hard to turn only. Measured 1e-3.
#[test]
fn a_base_that_is_hard_to_turn_makes_the_robot_an_attitude_held_one_along_a_straight_line() {
    for_every_robot(2e-3, |scene| {
        straight_line(|s| {
            let (free, held, _) = heavy(scene, s, false);
            size(&(&free - &held)) * s
        })
    });
}

/// Largest relative change of what ought to be constant from one decade to the next.
fn straight_line(product: impl Fn(f64) -> f64) -> f64 {
    let decades = [1e5, 1e6, 1e7, 1e8, 1e9].map(product);
    assert!(decades[0] > 0.0, "the limit is approached, not sat on");
    largest(decades.windows(2).map(|pair| (pair[1] / pair[0] - 1.0).abs()))
}

/// Nothing in the dual route changes a value. Measured 0.
#[test]
fn duals_carry_the_same_values_as_plain_numbers() {
    for_every_robot(0.0, |s| {
        let posture = Posture::new(s);
        let robot = s.robot.cast::<Dual<f64>>();
        let moving = in_time(&s.state, &s.nudot);
        let M = mass_matrix(&kinematics(&robot, &moving));
        let size = 6 + posture.n;
        let values = DMatrix::from_fn(size, size, |i, j| M.element(i, j).value);
        f64::from(values != dense(&posture.M))
    });
}
