//! `hsd textures`: the drawn materials as files.

use super::terminal::counted;
use super::{Exit, Outcome, Stop};
use crate::texture;
use clap::Args;
use std::io::{self, Write};
use std::path::PathBuf;

/// Draw the pictures of all materials into a folder.
///
/// Each material has a colour, a normal map and a map of occlusion, roughness and metalness. They are the
/// pictures that models carry; nothing has to be drawn to build one.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  hsd textures -o materials/          draw all of them
  hsd textures -o /tmp/m && ls /tmp/m    see what they are called")]
pub(super) struct Textures {
    /// The folder; it is made where it is missing.
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
}

impl Textures {
    pub(super) fn run(&self) -> Outcome {
        let shown = self.output.display();
        let files = texture::write_all(&self.output).map_err(|e| Stop::at(&shown, e))?;
        writeln!(
            io::stderr(),
            "wrote {} to {shown}",
            counted(files.len(), "picture")
        )?;
        Ok(Exit::Done)
    }
}
