//! `wrasse convert`: a vehicle file of another format as a TOML one.

use crate::YES;
use crate::input::{Failure, complain, file_of, say};
use clap::Args;
use std::path::PathBuf;
use std::process::ExitCode;
use wrasse_vehicle::{ConvertOptions, convert_to_toml};

/// Print a URDF file as a TOML vehicle file: `wrasse convert arm.urdf > arm.toml`.
///
/// Links, joints, limits and outlines are taken over with the same numbers; what a URDF has no place for
/// (tools, postures, actuators, where numbers come from) is for you to add. To keep the URDF as it is,
/// take it into a vehicle file by an [[include]] instead.
#[derive(Debug, Args)]
pub(crate) struct Convert {
    /// The file; `-` is standard input.
    file: PathBuf,
    /// Fix the joints of this name, at zero or the end of their travel nearest to it; * stands for any
    /// characters. May be given several times.
    #[arg(long, value_name = "PATTERN")]
    fix: Vec<String>,
    /// Take mass properties that no rigid body has, for this reason.
    #[arg(long, value_name = "REASON")]
    accept_nonphysical: Option<String>,
}

impl Convert {
    pub(crate) fn go(&self) -> Result<ExitCode, Failure> {
        let options = ConvertOptions {
            fix: self.fix.clone(),
            accept_nonphysical: self.accept_nonphysical.clone(),
        };
        let (file, text) = file_of(&self.file)?;
        let (text, remarks) = convert_to_toml(file, text, &options)?;
        if !remarks.is_empty() {
            complain(&remarks);
        }
        say(&text);
        Ok(YES)
    }
}
