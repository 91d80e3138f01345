//! How the base moves when the joints do: a twist for unit rate of each, one that the momentum alone
//! causes, and how these change. About the base's origin Bo, in base axes.

use crate::{BaseMode, BaseRows, Configuration, Robot};
use wrasse_spatial::{
    At, InverseInertia, Real, Rows, SpatialForce, SpatialInertia, SpatialMomentum, SpatialVelocity,
    Sym3, Vec3,
};

/// `V_NB_B = Σ per_rate q̇ + drift`, or the time derivatives of both.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BaseResponse<T, const J: usize> {
    /// Twist for unit rate of each joint.
    pub per_rate: SpatialVelocity<[T; J]>,
    /// Twist that the momentum alone causes (rad/s, m/s).
    pub drift: SpatialVelocity<T>,
    /// `M_bb⁻¹`.
    pub mobility: InverseInertia<T>,
}

impl<T: Real, const J: usize> BaseResponse<T, J> {
    /// A base that is bolted down.
    #[inline(always)]
    fn none() -> Self {
        let mobility =
            InverseInertia { per_mass: T::zero(), p_cm: Vec3::zero(), per_central: Sym3::zero() };
        Self { per_rate: Rows::zero_rows(), drift: SpatialVelocity::zero(), mobility }
    }
    /// The twist that joint rates cause, without the drift.
    #[inline(always)]
    pub fn to_rates(&self, robot: &Robot<T, J>, qdot: &[T; J]) -> SpatialVelocity<T> {
        let mut V = SpatialVelocity::zero();
        for j in robot.joints() {
            V += self.per_rate.at(j) * qdot.at(j);
        }
        V
    }
}

/// The response of a base with the total momentum `h_Scm_B` about the system's centre of mass (N·m·s,
/// N·s), of which only the linear part counts where the attitude is held.
///
/// # Source
/// [`UmetaniYoshida1989`](wrasse_spatial::references::UmetaniYoshida1989): momentum is kept.
#[inline(always)]
pub fn base_response<T: Real, const J: usize>(
    mode: BaseMode,
    M: &BaseRows<T, J>,
    h_Scm_B: &SpatialMomentum<T>,
) -> BaseResponse<T, J> {
    let (mut response, none) = (BaseResponse::none(), Vec3::zero());
    match mode {
        BaseMode::Fixed => {}
        BaseMode::AttitudeHeld => {
            let per_mass = T::one() / M.M_bb.mass;
            for j in 0..M.count.min(J) {
                let v = M.M_bj.at(j).force * -per_mass;
                response.per_rate.put(j, SpatialVelocity::new(none, v));
            }
            response.drift.linear = h_Scm_B.force * per_mass;
        }
        BaseMode::Free => {
            let mobility = M.M_bb.inverse();
            for j in 0..M.count.min(J) {
                response.per_rate.put(j, -mobility.velocity_of(&M.M_bj.at(j)));
            }
            response.drift = mobility.velocity_of(&h_Scm_B.about(-mobility.p_cm));
            response.mobility = mobility;
        }
    }
    response
}

/// Time derivative of the response in base axes, while the joints move at `qdot` and so the links with
/// the twists `V` relative to the base, and the base turns at `w_NB_B` (rad/s).
#[inline(always)]
pub fn base_response_rate<T: Real, const J: usize>(
    mode: BaseMode,
    robot: &Robot<T, J>,
    configuration: &Configuration<T, J>,
    response: &BaseResponse<T, J>,
    (V, qdot): (&SpatialVelocity<[T; J]>, &[T; J]),
    h_Scm_B: &SpatialMomentum<T>,
    w_NB_B: Vec3<T>,
) -> BaseResponse<T, J> {
    // The momentum stands still in inertial axes.
    let hdot = SpatialForce::new(h_Scm_B.torque.cross(w_NB_B), h_Scm_B.force.cross(w_NB_B));
    match mode {
        BaseMode::Fixed => BaseResponse::none(),
        BaseMode::AttitudeHeld => held_rate(robot, &configuration.base, (V, qdot), hdot.force),
        BaseMode::Free => {
            let (pushes, Mdot_bb) = base_rows_rate(robot, configuration, V, qdot);
            let mobility = &response.mobility;
            let mut rate = BaseResponse::none();
            for j in robot.joints() {
                let push = pushes.at(j) + Mdot_bb * response.per_rate.at(j);
                rate.per_rate.put(j, -mobility.velocity_of(&push));
            }
            let pdot_cm = Mdot_bb.first_moment * mobility.per_mass;
            let mut push = hdot.about(-mobility.p_cm);
            push.torque += pdot_cm.cross(h_Scm_B.force);
            rate.drift = mobility.velocity_of(&(push - Mdot_bb * response.drift));
            rate
        }
    }
}

/// The same where the base does not turn: only linear momenta count.
///
/// The momentum of a joint turns with what the joint carries; behind it, what other joints carry gains
/// the first moment that their momenta are.
#[inline(always)]
fn held_rate<T: Real, const J: usize>(
    robot: &Robot<T, J>,
    M: &BaseRows<T, J>,
    (V, qdot): (&SpatialVelocity<[T; J]>, &[T; J]),
    hdot: Vec3<T>,
) -> BaseResponse<T, J> {
    let mut rate = BaseResponse::none();
    let per_mass = T::one() / M.M_bb.mass;
    let mut behind: Vec3<[T; J]> = Rows::zero_rows();
    robot.tips_to_base(Vec3::zero(), &mut behind, |j, behind: Vec3<T>| {
        let push = M.M_bj.force.at(j);
        let change = V.angular.at(j).cross(push) + M.S.angular.at(j).cross(behind);
        rate.per_rate.linear.put(j, change * -per_mass);
        behind + push * qdot.at(j)
    });
    rate.drift.linear = hdot * per_mass;
    rate
}

/// Time derivatives of the base's rows `M_bj` and `M_bb`, in base axes:
/// `d(M S)/dt = V ×* (M S) + D S`, where D is how the inertia that a joint carries changes as seen from
/// its own link: by what the joints behind it do.
#[inline(always)]
fn base_rows_rate<T: Real, const J: usize>(
    robot: &Robot<T, J>,
    configuration: &Configuration<T, J>,
    V: &SpatialVelocity<[T; J]>,
    qdot: &[T; J],
) -> (SpatialForce<[T; J]>, SpatialInertia<T>) {
    let Configuration { posture, composite, base: M } = configuration;
    let mut rate: SpatialForce<[T; J]> = Rows::zero_rows();
    let mut D: SpatialInertia<[T; J]> = Rows::zero_rows();
    let whole = robot.tips_to_base(SpatialInertia::zero(), &mut D, |j, D| {
        rate.put(j, V.at(j).cross_force(&M.M_bj.at(j)) + D * M.S.at(j));
        let turn = robot.subspace_of(j, posture.axis_of(j)) * qdot.at(j);
        let own = inertia_rate(&composite.carried(robot, j), &turn, robot.any_slides());
        D + own.about(-posture.p_BL_B.at(j))
    });
    (rate, whole)
}

/// `V ×* M - M V ×`: how an inertia about a point that stays changes as its body moves. The mass stays.
#[inline(always)]
fn inertia_rate<T: Real>(
    M: &SpatialInertia<T>,
    V: &SpatialVelocity<T>,
    slides: bool,
) -> SpatialInertia<T> {
    let (w, v, h, two) = (V.angular, V.linear, M.first_moment, T::from_f64(2.0));
    // w × I - I × w, then 2 (v·h) 1 - (v hᵀ + h vᵀ).
    let turned = w.skew() * M.rotational.to_mat3();
    let mut rate = SpatialInertia {
        mass: T::zero(),
        first_moment: w.cross(h),
        rotational: Sym3::symmetric_part(&turned).scaled(two),
    };
    if slides {
        let along = two * v.dot(h);
        let moved = Sym3::symmetric_part(&v.outer(h)).scaled(two);
        rate.first_moment += v * M.mass;
        rate.rotational = rate.rotational + Sym3::diagonal(along, along, along) - moved;
    }
    rate
}
