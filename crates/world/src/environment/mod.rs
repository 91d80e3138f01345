//! What surrounds the systems and acts on every body of all of them: one file for each field.

mod uniform_gravity;

use crate::effectors::Load;
use wrasse_dynamics::Kinematics;
use wrasse_spatial::Vec3;

/// What surrounds the systems of a scene.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub enum Environment {
    /// Nothing: N falls freely, and with it all that is in it.
    #[default]
    FreeSpace,
    /// The same gravity everywhere: N is held against it, as a laboratory is.
    UniformGravity {
        /// Acceleration of what falls, inertial axes (m/s²).
        acceleration_N: Vec3<f64>,
    },
}

impl Environment {
    /// Whether it acts on anything.
    pub(crate) fn acts(&self) -> bool {
        *self != Self::FreeSpace
    }
    /// Acceleration of what falls freely, inertial axes (m/s²); `None` in free space.
    pub fn gravity_N(&self) -> Option<Vec3<f64>> {
        match *self {
            Self::FreeSpace => None,
            Self::UniformGravity { acceleration_N } => Some(acceleration_N),
        }
    }
    /// What it does to the bodies of a system.
    pub(crate) fn act<const J: usize>(&self, k: &Kinematics<'_, f64, J>, load: &mut Load<'_, J>) {
        match self {
            Self::FreeSpace => (),
            Self::UniformGravity { acceleration_N } => {
                uniform_gravity::pull(k, *acceleration_N, load);
            }
        }
    }
}
