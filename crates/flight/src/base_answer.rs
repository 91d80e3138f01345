//! How a law believes the base to answer the joints: a twist for unit rate of each, one that the
//! momentum alone causes, and how they change. All about the base's origin Bo, in base axes.

use crate::law::ArmLaw;
use crate::mobility::Mobility;
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
    /// Each link alone.
    alone: [SpatialInertia<T>; J],
    links: [SpatialInertia<T>; J],
    base: SpatialInertia<T>,
}

impl<T: Real, const J: usize> Carried<T, J> {
    /// In a posture, as far as the law asks for it.
    #[inline(always)]
    pub(crate) fn new(law: ArmLaw, robot: &Robot<T, J>, posture: &Posture<T, J>) -> Self {
        let none = [SpatialInertia::zero(); J];
        let mut carried = Self { alone: none, links: none, base: *robot.inertia(BodyId::Base) };
        for j in robot.joints() {
            carried.alone[j] = match law {
                ArmLaw::Terrestrial => SpatialInertia::zero(),
                ArmLaw::AttitudeHeld => {
                    let (mass, first_moment) = posture.first_moment(robot, j);
                    SpatialInertia { mass, first_moment, rotational: Sym3::zero() }
                }
                ArmLaw::FreeFloating => posture.inertia(robot, j),
            };
        }
        carried.add_up(law, robot);
        carried
    }
    /// How that changes while the links move with the twists `V` relative to the base.
    #[inline(always)]
    fn rate(&self, law: ArmLaw, robot: &Robot<T, J>, V: &[SpatialVelocity<T>; J]) -> Self {
        let none = [SpatialInertia::zero(); J];
        let mut rate = Self { alone: none, links: none, base: SpatialInertia::zero() };
        for j in robot.joints() {
            let M = &self.alone[j];
            rate.alone[j] = match law {
                ArmLaw::FreeFloating => inertia_rate(M, &V[j]),
                _ => SpatialInertia {
                    first_moment: V[j].linear * M.mass + V[j].angular.cross(M.first_moment),
                    ..SpatialInertia::zero()
                },
            };
        }
        rate.add_up(law, robot);
        rate
    }
    /// Tip to base: what each link adds to all that its joint carries.
    #[inline(always)]
    fn add_up(&mut self, law: ArmLaw, robot: &Robot<T, J>) {
        let add = |to: &mut SpatialInertia<T>, M: &SpatialInertia<T>| {
            to.mass += M.mass;
            to.first_moment += M.first_moment;
            if law == ArmLaw::FreeFloating {
                to.rotational += M.rotational;
            }
        };
        for j in robot.joints().rev() {
            add(&mut self.links[j], &self.alone[j]);
            let own = self.links[j];
            match robot.joint(j).parent {
                BodyId::Link(p) if p < J => add(&mut self.links[p], &own),
                _ => add(&mut self.base, &own),
            }
        }
    }
}

/// How the base answers in a posture, by the law, with the total momentum `h_Scm_B` about the
/// system's centre of mass (N·m·s, N·s).
#[inline(always)]
pub(crate) fn base_answer<T: Real, const J: usize>(
    law: ArmLaw,
    robot: &Robot<T, J>,
    posture: &Posture<T, J>,
    carried: &Carried<T, J>,
    h_Scm_B: &SpatialMomentum<T>,
) -> BaseAnswer<T, J> {
    let mut answer = BaseAnswer::none();
    match law {
        ArmLaw::Terrestrial => {}
        ArmLaw::AttitudeHeld => {
            let per_mass = T::one() / carried.base.mass;
            for j in robot.joints() {
                let push = force_of_rate(&carried.links[j], &posture.S[j]);
                answer.per_rate[j].linear = push * -per_mass;
            }
            answer.drift.linear = h_Scm_B.force * per_mass;
        }
        ArmLaw::FreeFloating => {
            let mobility = Mobility::of(&carried.base);
            for j in robot.joints() {
                answer.per_rate[j] = -mobility.times(&(carried.links[j] * posture.S[j]));
            }
            answer.drift = mobility.times(&h_Scm_B.about(-mobility.p_cm));
        }
    }
    answer
}

/// Linear momentum for unit rate of a joint with all that it carries.
#[inline(always)]
fn force_of_rate<T: Real>(M: &SpatialInertia<T>, S: &SpatialVelocity<T>) -> Vec3<T> {
    S.linear * M.mass - M.first_moment.cross(S.angular)
}

/// Time derivative of the base's answer in base axes, while the links move with the twists `V`
/// relative to the base, and the base turns at `w_NB_B` (rad/s).
#[inline(always)]
pub(crate) fn base_answer_rate<T: Real, const J: usize>(
    law: ArmLaw,
    robot: &Robot<T, J>,
    posture: &Posture<T, J>,
    (answer, carried): (&BaseAnswer<T, J>, &Carried<T, J>),
    V: &[SpatialVelocity<T>; J],
    h_Scm_B: &SpatialMomentum<T>,
    w_NB_B: Vec3<T>,
) -> BaseAnswer<T, J> {
    let mut rate = BaseAnswer::none();
    // The momentum stands still in inertial axes.
    let hdot = SpatialForce::new(h_Scm_B.torque.cross(w_NB_B), h_Scm_B.force.cross(w_NB_B));
    let changing = carried.rate(law, robot, V);
    match law {
        ArmLaw::Terrestrial => {}
        ArmLaw::AttitudeHeld => {
            let per_mass = T::one() / carried.base.mass;
            for j in robot.joints() {
                let push = force_of_rate(&carried.links[j], &V[j].cross(&posture.S[j]))
                    - changing.links[j].first_moment.cross(posture.S[j].angular);
                rate.per_rate[j].linear = push * -per_mass;
            }
            rate.drift.linear = hdot.force * per_mass;
        }
        ArmLaw::FreeFloating => {
            let mobility = Mobility::of(&carried.base);
            for j in robot.joints() {
                let S = posture.S[j];
                let of_joint = carried.links[j] * V[j].cross(&S) + changing.links[j] * S;
                let of_base = changing.base * answer.per_rate[j];
                rate.per_rate[j] = -mobility.times(&(of_joint + of_base));
            }
            let pdot_cm = changing.base.first_moment * (T::one() / carried.base.mass);
            let mut push = hdot.about(-mobility.p_cm);
            push.torque += pdot_cm.cross(h_Scm_B.force);
            rate.drift = mobility.times(&(push - changing.base * answer.drift));
        }
    }
    rate
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
