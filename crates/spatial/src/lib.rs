//! Poses, spatial velocities, forces and inertias over any scalar. No heap, no `std`.
//!
//! Notation is monogram: `X_NB` is the pose of B measured in N, and inner letters touch in every
//! product (`X_NE = X_NB * X_BE`). The angular part comes first in every spatial vector. See
//! `book/src/notation.md`.
#![no_std]
#![allow(non_snake_case, reason = "monogram notation, see book/src/notation.md")]

#[cfg(feature = "counted")]
mod counted;
mod dual;
mod inertia;
mod instructions;
mod kernel;
mod lanes;
mod layout;
mod matrix;
mod motion;
mod pose;
mod quaternion;
mod real;
pub mod references;
mod rotation_vector;
mod side_by_side;
mod trigonometry;
mod turn;
mod vector;
#[cfg(target_arch = "x86_64")]
mod wide;

#[cfg(feature = "counted")]
pub use counted::Counted;
pub use dual::Dual;
pub use inertia::{InverseInertia, SpatialInertia};
pub use instructions::{Baseline, Instructions, Level, Work};
pub use kernel::Kernel;
pub use lanes::{LaneMask, Lanes};
pub use layout::{At, Group, Layout, OneByOne, Rows, groups};
pub use matrix::{Mat3, Sym3};
pub use motion::{
    ClassicalAcceleration, SpatialAcceleration, SpatialForce, SpatialMomentum, SpatialVelocity,
};
pub use pose::Pose;
pub use quaternion::Quat;
pub use real::{Real, Scalar};
pub use rotation_vector::{rotation_vector_rate, turned_by};
pub use side_by_side::SideBySide;
pub use turn::Turn;
pub use vector::{Vec3, vec3};
#[cfg(target_arch = "x86_64")]
pub use wide::{Avx2, Avx512};
