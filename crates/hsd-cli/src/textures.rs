//! `hsd textures`: writes the procedural textures of the materials.

use super::{Exit, Failure, Outcome};
use crate::files::output::{Committer, Files};
use crate::files::terminal::counted;
use clap::Args;
use hsd_base::diagnostic::{Language, noun};
use hsd_base::text;
use hsd_scene::texture;
use std::io::{self, Write};
use std::path::PathBuf;

/// Write the textures of all materials to a folder.
///
/// Each material has a colour map, a normal map and a map of occlusion, roughness and metalness. Models contain the
/// same textures; building one does not require this command.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  hsd textures -o materials/          write all textures
  hsd textures --sheet materials.jpg     draw all materials at the same scale")]
pub(super) struct Textures {
    /// Write to this folder; it is created if missing.
    #[arg(short, long, value_name = "DIR", required_unless_present = "sheet")]
    output: Option<PathBuf>,
    /// Write a JPEG of all materials side by side, each 0.91 m wide.
    #[arg(long, value_name = "FILE")]
    sheet: Option<PathBuf>,
}

impl Textures {
    pub(super) fn run(&self, language: Language) -> Outcome {
        let committer = Committer::default();
        if let Some(folder) = &self.output {
            let shown = folder.display();
            std::fs::create_dir_all(folder).map_err(|e| Failure::at(&shown, e))?;
            let files = texture::FILES.iter();
            let files: Vec<_> = files
                .map(|(name, bytes)| (folder.join(name), bytes.to_vec()))
                .collect();
            let count = counted(files.len(), noun("texture", "テクスチャー{}枚"));
            committer.write_all(files)?;
            let message = text!([count, shown]
                "wrote {count} to {shown}",
                "{count}を {shown} に書きました"
            );
            writeln!(io::stderr(), "{}", message.in_language(language))?;
        }
        if let Some(file) = &self.sheet {
            let shown = file.display();
            let committer = committer.named_by("--sheet");
            committer.write(file, Files::bytes(texture::contact_sheet()))?;
            let message = text!([shown] "wrote {shown}", "{shown} を書きました");
            writeln!(io::stderr(), "{}", message.in_language(language))?;
        }
        Ok(Exit::Done)
    }
}
