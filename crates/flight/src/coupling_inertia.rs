//! What the joints' motion and the turning of the base ask of each other.

use crate::base_answer::Carried;
use crate::law::ArmLaw;
use crate::posture::Posture;
use wrasse_dynamics::Robot;
use wrasse_spatial::{Real, Vec3, Work};

/// Coupling inertia of the joints: angular momentum of the system about its centre of mass for unit
/// rate of each joint, on a base that does not turn and is not held against sliding (kg·m², base axes;
/// kg·m for sliding joints).
///
/// With the locked inertia I about the centre of mass, `[I N; Nᵀ H̄] [ẇ; q̈]` are the forces of inertia
/// of base and joints, the sliding of the base taken out.
///
/// # Source
/// [`UmetaniYoshida1989`](wrasse_spatial::references::UmetaniYoshida1989): the matrix that multiplies
/// the joint rates in the conservation of angular momentum.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CouplingInertia<T, const J: usize> {
    columns: [Vec3<T>; J],
}

impl<T: Real, const J: usize> CouplingInertia<T, J> {
    /// No coupling at all.
    pub(crate) fn zero() -> Self {
        Self { columns: [Vec3::zero(); J] }
    }

    /// At joint positions `q` (rad or m).
    pub fn new(robot: &Robot<T, J>, q: &[T; J]) -> Self {
        T::apart(Couple { robot, q })
    }

    /// Torque on the base that joint accelerations (rad/s², m/s²) ask for (N·m, base axes): `N q̈`.
    #[inline(always)]
    pub fn reaction(&self, qddot: &[T; J]) -> Vec3<T> {
        let each = self.columns.iter().zip(qddot);
        each.fold(Vec3::zero(), |sum, (column, &qddot)| sum + *column * qddot)
    }

    /// Torque of each joint (N·m, N) that keeps it from answering an angular acceleration of the base
    /// (rad/s², base axes): `Nᵀ ẇ`.
    #[inline(always)]
    pub fn effort(&self, wdot_NB_B: Vec3<T>) -> [T; J] {
        self.columns.map(|column| column.dot(wdot_NB_B))
    }
}

/// The columns as a piece of work.
struct Couple<'a, T, const J: usize> {
    robot: &'a Robot<T, J>,
    q: &'a [T; J],
}

impl<T: Real, const J: usize> Work for Couple<'_, T, J> {
    type Out = CouplingInertia<T, J>;
    #[inline(always)]
    fn run(self) -> CouplingInertia<T, J> {
        let Self { robot, q } = self;
        let posture = Posture::new(robot, q);
        let carried = Carried::new(ArmLaw::FreeFloating, robot, &posture);
        let p_BScm_B = carried.base.centre_of_mass();
        CouplingInertia { columns: carried.momenta.map(|h| h.about(p_BScm_B).torque) }
    }
}
