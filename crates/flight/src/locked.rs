//! The system with its joints locked, and what their motion adds: tip to base, each link in its own axes
//! about its own origin, without the motion of the bodies.

use crate::law::ArmLaw;
use wrasse_dynamics::{BodyId, Robot, State};
use wrasse_spatial::{Real, SpatialInertia, SpatialMomentum, SpatialVelocity, Vec3, Work};

/// What a body carries, itself included.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Locked<T> {
    /// Inertia with joints locked.
    pub(crate) M: SpatialInertia<T>,
    /// Momentum of the joints' motion while the body is at rest (N·m·s, N·s).
    pub(crate) h: SpatialMomentum<T>,
}

impl<T: Real> Locked<T> {
    /// All of it, about the base's origin in base axes.
    pub(crate) fn new<const J: usize>(robot: &Robot<T, J>, q: &[T; J], qdot: &[T; J]) -> Self {
        T::apart(Lock { robot, q, qdot })
    }

    /// Angular momentum of the joints' motion about the system's centre of mass (N·m·s, base axes), on a
    /// base that does not turn but gives way.
    #[inline(always)]
    pub(crate) fn swing_B(&self) -> Vec3<T> {
        self.h.about(self.M.centre_of_mass()).torque
    }
}

/// Locking the joints, as a piece of work.
struct Lock<'a, T, const J: usize> {
    robot: &'a Robot<T, J>,
    q: &'a [T; J],
    qdot: &'a [T; J],
}

impl<T: Real, const J: usize> Work for Lock<'_, T, J> {
    type Out = Locked<T>;
    #[inline(always)]
    fn run(self) -> Locked<T> {
        let Self { robot, q, qdot } = self;
        let mut links = [Locked { M: SpatialInertia::zero(), h: SpatialMomentum::zero() }; J];
        let mut base = Locked { M: *robot.inertia(BodyId::Base), h: SpatialMomentum::zero() };
        for j in robot.joints().rev() {
            let link = robot.link(j);
            let seat = link.at(q[j]);
            // All that the joint carries moves with it as one body.
            let M = links[j].M + link.M_L;
            let h = links[j].h + link.momentum(&M) * qdot[j];
            let parent = match link.parent {
                BodyId::Link(p) if p < J => &mut links[p],
                _ => &mut base,
            };
            parent.M += seat.inertia_to_parent(&M);
            parent.h += seat.force_to_parent(&h);
        }
        base
    }
}

/// Total momentum about the system's centre of mass, inertial axes, as far as the law asks for it: all of
/// it, its linear part, or nothing.
#[inline(always)]
pub(crate) fn momentum_for<T: Real, const J: usize>(
    law: ArmLaw,
    robot: &Robot<T, J>,
    state: &State<T, J>,
) -> SpatialMomentum<T> {
    let h = match law {
        ArmLaw::Terrestrial => return SpatialMomentum::zero(),
        ArmLaw::AttitudeHeld => SpatialMomentum::new(Vec3::zero(), linear_momentum(robot, state)),
        ArmLaw::FreeFloating => {
            let Locked { M, h } = Locked::new(robot, &state.q, &state.v);
            (h + M * state.V_NB_B).about(M.centre_of_mass())
        }
    };
    let R_NB = &state.X_NB.rotation;
    SpatialMomentum::new(*R_NB * h.torque, *R_NB * h.force)
}

/// Linear momentum (N·s, base axes): masses and first moments are enough for it.
#[inline(always)]
fn linear_momentum<T: Real, const J: usize>(robot: &Robot<T, J>, state: &State<T, J>) -> Vec3<T> {
    let M = robot.inertia(BodyId::Base);
    // Of what each body carries: mass, first moment, momentum of the joints' motion.
    let mut links = [(T::zero(), Vec3::zero(), Vec3::zero()); J];
    let mut base = (M.mass, M.first_moment, Vec3::zero());
    for j in robot.joints().rev() {
        let link = robot.link(j);
        let seat = link.at(state.q[j]);
        let (mass, first_moment) = (links[j].0 + link.M_L.mass, links[j].1 + link.M_L.first_moment);
        let M = SpatialInertia { mass, first_moment, ..SpatialInertia::zero() };
        let push = links[j].2 + link.momentum(&M).force * state.v[j];
        let parent = match link.parent {
            BodyId::Link(p) if p < J => &mut links[p],
            _ => &mut base,
        };
        parent.0 += mass;
        parent.1 += seat.to_parent(&first_moment) + seat.p_PL_P * mass;
        parent.2 += seat.to_parent(&push);
    }
    let SpatialVelocity { angular, linear } = state.V_NB_B;
    linear * base.0 + angular.cross(base.1) + base.2
}
