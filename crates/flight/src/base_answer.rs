//! How a law believes the base to answer the joints: a twist for unit rate of each, one that the
//! momentum alone causes, and how they change. All about the base's origin Bo, in base axes.

use crate::law::ArmLaw;
use crate::posture::Posture;
use wrasse_dynamics::{BodyId, Robot};
use wrasse_spatial::{
    Real, SpatialForce, SpatialInertia, SpatialMomentum, SpatialVelocity, Sym3, Vec3,
};

/// `V_NB_B = Σ per_rate q̇ + drift`, or the time derivatives of both.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BaseAnswer<T, const J: usize> {
    /// Twist for unit rate of each joint.
    pub(crate) per_rate: [SpatialVelocity<T>; J],
    /// Twist that the momentum alone causes (rad/s, m/s).
    pub(crate) drift: SpatialVelocity<T>,
}

impl<T: Real, const J: usize> BaseAnswer<T, J> {
    /// A base that is bolted down.
    #[inline(always)]
    fn none() -> Self {
        Self { per_rate: [SpatialVelocity::zero(); J], drift: SpatialVelocity::zero() }
    }
    /// The answer to joint rates, without the drift.
    #[inline(always)]
    pub(crate) fn caused_by(&self, robot: &Robot<T, J>, qdot: &[T; J]) -> SpatialVelocity<T> {
        let mut V = SpatialVelocity::zero();
        for j in robot.joints() {
            V += self.per_rate[j] * qdot[j];
        }
        V
    }
}

/// What each joint carries, the base what all do; without rotational parts where only masses and
/// first moments count.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Carried<T, const J: usize> {
    links: [SpatialInertia<T>; J],
    pub(crate) base: SpatialInertia<T>,
    /// Momentum for unit rate of each joint, the base at rest; the linear part, where only that counts.
    pub(crate) momenta: [SpatialMomentum<T>; J],
}

impl<T: Real, const J: usize> Carried<T, J> {
    /// In a posture, as far as the law asks for it: tip to base, what each link adds.
    #[inline(always)]
    pub(crate) fn new(law: ArmLaw, robot: &Robot<T, J>, posture: &Posture<T, J>) -> Self {
        let none = [SpatialInertia::zero(); J];
        let base = *robot.inertia(BodyId::Base);
        let mut carried = Self { links: none, base, momenta: [SpatialMomentum::zero(); J] };
        if law == ArmLaw::Terrestrial {
            return carried;
        }
        for j in robot.joints().rev() {
            let (S, mut M) = (&posture.S[j], carried.links[j]);
            if law == ArmLaw::FreeFloating {
                M += posture.inertia(robot, j);
                carried.momenta[j] = M * *S;
            } else {
                let (mass, first_moment) = posture.first_moment(robot, j);
                (M.mass, M.first_moment) = (M.mass + mass, M.first_moment + first_moment);
                carried.momenta[j].force = S.linear * M.mass - M.first_moment.cross(S.angular);
            }
            carried.links[j] = M;
            let all = match robot.joint(j).parent {
                BodyId::Link(p) if p < J => &mut carried.links[p],
                _ => &mut carried.base,
            };
            (all.mass, all.first_moment) = (all.mass + M.mass, all.first_moment + M.first_moment);
            if law == ArmLaw::FreeFloating {
                all.rotational += M.rotational;
            }
        }
        carried
    }
}

/// How the base answers in a posture, by the law, with the total momentum `h_Scm_B` about the
/// system's centre of mass (N·m·s, N·s).
#[inline(always)]
pub(crate) fn base_answer<T: Real, const J: usize>(
    law: ArmLaw,
    robot: &Robot<T, J>,
    carried: &Carried<T, J>,
    h_Scm_B: &SpatialMomentum<T>,
) -> BaseAnswer<T, J> {
    let mut answer = BaseAnswer::none();
    match law {
        ArmLaw::Terrestrial => {}
        ArmLaw::AttitudeHeld => {
            let per_mass = T::one() / carried.base.mass;
            for j in robot.joints() {
                answer.per_rate[j].linear = carried.momenta[j].force * -per_mass;
            }
            answer.drift.linear = h_Scm_B.force * per_mass;
        }
        ArmLaw::FreeFloating => {
            let mobility = carried.base.inverse();
            for j in robot.joints() {
                answer.per_rate[j] = -mobility.velocity_of(&carried.momenta[j]);
            }
            answer.drift = mobility.velocity_of(&h_Scm_B.about(-mobility.p_cm));
        }
    }
    answer
}

/// Time derivative of the base's answer in base axes, while the joints move at `qdot` and so the links
/// with the twists `V` relative to the base, and the base turns at `w_NB_B` (rad/s).
#[inline(always)]
pub(crate) fn base_answer_rate<T: Real, const J: usize>(
    law: ArmLaw,
    robot: &Robot<T, J>,
    posture: &Posture<T, J>,
    (answer, carried): (&BaseAnswer<T, J>, &Carried<T, J>),
    (V, qdot): (&[SpatialVelocity<T>; J], &[T; J]),
    h_Scm_B: &SpatialMomentum<T>,
    w_NB_B: Vec3<T>,
) -> BaseAnswer<T, J> {
    // The momentum stands still in inertial axes.
    let hdot = SpatialForce::new(h_Scm_B.torque.cross(w_NB_B), h_Scm_B.force.cross(w_NB_B));
    match law {
        ArmLaw::Terrestrial => BaseAnswer::none(),
        ArmLaw::AttitudeHeld => held_rate(robot, posture, carried, (V, qdot), hdot.force),
        ArmLaw::FreeFloating => {
            let (pushes, changing) = momentum_rates(robot, posture, carried, (V, qdot));
            let mobility = carried.base.inverse();
            let mut rate = BaseAnswer::none();
            for j in robot.joints() {
                let push = pushes[j] + changing * answer.per_rate[j];
                rate.per_rate[j] = -mobility.velocity_of(&push);
            }
            let pdot_cm = changing.first_moment * mobility.per_mass;
            let mut push = hdot.about(-mobility.p_cm);
            push.torque += pdot_cm.cross(h_Scm_B.force);
            rate.drift = mobility.velocity_of(&(push - changing * answer.drift));
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
    posture: &Posture<T, J>,
    carried: &Carried<T, J>,
    (V, qdot): (&[SpatialVelocity<T>; J], &[T; J]),
    hdot: Vec3<T>,
) -> BaseAnswer<T, J> {
    let mut rate = BaseAnswer::none();
    let per_mass = T::one() / carried.base.mass;
    let mut behind = [Vec3::zero(); J];
    for j in robot.joints().rev() {
        let push = carried.momenta[j].force;
        let change = V[j].angular.cross(push) + posture.S[j].angular.cross(behind[j]);
        rate.per_rate[j].linear = change * -per_mass;
        let all = behind[j] + push * qdot[j];
        if let BodyId::Link(p) = robot.joint(j).parent
            && p < J
        {
            behind[p] += all;
        }
    }
    rate.drift.linear = hdot * per_mass;
    rate
}

/// Time derivatives of the momenta for unit rate of the joints, and of the inertia of the whole:
/// `d(M S)/dt = V ×* (M S) + D S`, where D is how the inertia that a joint carries changes as seen from
/// its own link: by what the joints behind it do.
#[inline(always)]
fn momentum_rates<T: Real, const J: usize>(
    robot: &Robot<T, J>,
    posture: &Posture<T, J>,
    carried: &Carried<T, J>,
    (V, qdot): (&[SpatialVelocity<T>; J], &[T; J]),
) -> ([SpatialForce<T>; J], SpatialInertia<T>) {
    let mut rate = [SpatialForce::zero(); J];
    let mut base = SpatialInertia::zero();
    let mut behind = [base; J];
    for j in robot.joints().rev() {
        let (S, own) = (&posture.S[j], behind[j]);
        rate[j] = V[j].cross_force(&carried.momenta[j]) + own * *S;
        let all = own + inertia_rate(&carried.links[j], &(*S * qdot[j]));
        match robot.joint(j).parent {
            BodyId::Link(p) if p < J => behind[p] += all,
            _ => base += all,
        }
    }
    (rate, base)
}

/// `V ×* M - M V ×`: how an inertia about a fixed point changes as its body moves. The mass stays.
#[inline(always)]
fn inertia_rate<T: Real>(M: &SpatialInertia<T>, V: &SpatialVelocity<T>) -> SpatialInertia<T> {
    let (w, v, h) = (V.angular, V.linear, M.first_moment);
    let two = T::from_f64(2.0);
    // w × I - I × w, then 2 (v·h) 1 - (v hᵀ + h vᵀ).
    let along = two * v.dot(h);
    let turned = w.skew() * M.rotational.to_mat3() - v.outer(h);
    let rotational =
        Sym3::symmetric_part(&turned).scaled(two) + Sym3::diagonal(along, along, along);
    SpatialInertia { mass: T::zero(), first_moment: v * M.mass + w.cross(h), rotational }
}
