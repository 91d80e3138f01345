//! MJCF files, the XML of MuJoCo.
//!
//! Facts about the format are from MuJoCo's documentation, "XML Reference", and were tried on
//! MuJoCo 4.0: `validation/tools/mjcf_against_mujoco.py`.

mod body;
mod compiler;
mod contents;
mod defaults;
mod equality;
mod geom;
mod include;
mod inertial;
mod joint;
mod keyframe;
mod model;
mod orientation;
mod solid;

pub(crate) use model::{is_mjcf, read_mjcf};
