//! URDF files.

mod joint;
mod link;
mod numbers;
mod robot;

pub(crate) use robot::{EXPAND_XACRO, NO_PROVENANCE, read_urdf};
