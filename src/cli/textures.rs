//! `hsd textures`: the drawn materials as files.

use super::{Exit, Outcome, Stop};
use crate::cli::files::terminal::counted;
use crate::diagnostic::{Language, noun};
use crate::text;
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
  hsd textures --sheet materials.jpg     see all of them at one scale")]
pub(super) struct Textures {
    /// The folder; it is made where it is missing.
    #[arg(short, long, value_name = "DIR", required_unless_present = "sheet")]
    output: Option<PathBuf>,
    /// A JPEG of all materials side by side, each as wide as a bay of 0.91 m.
    #[arg(long, value_name = "FILE")]
    sheet: Option<PathBuf>,
}

impl Textures {
    pub(super) fn run(&self, language: Language) -> Outcome {
        if let Some(folder) = &self.output {
            let shown = folder.display();
            let files = texture::write_all(folder).map_err(|e| Stop::at(&shown, e))?;
            let count = counted(files.len(), noun("picture", "画像{}枚"));
            let told = text!([count]
                "wrote {count} to {shown}",
                "{count}を {shown} に書きました"
            );
            writeln!(io::stderr(), "{}", told.in_language(language))?;
        }
        if let Some(file) = &self.sheet {
            let shown = file.display();
            std::fs::write(file, texture::contact_sheet()).map_err(|e| Stop::at(&shown, e))?;
            let told = text!("wrote {shown}", "{shown} を書きました");
            writeln!(io::stderr(), "{}", told.in_language(language))?;
        }
        Ok(Exit::Done)
    }
}
