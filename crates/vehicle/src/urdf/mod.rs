//! URDF files.

mod joint;
mod link;
mod numbers;
mod robot;

pub(crate) use robot::read_urdf;
