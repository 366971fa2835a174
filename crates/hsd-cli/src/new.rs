//! `hsd new`: creates a source file from a template.

use super::{Exit, Failure, Outcome};
use crate::files::input::STDIN;
use crate::files::output::{Committer, Files};
use crate::files::terminal::{padded, width};
use clap::Args;
use hsd_base::diagnostic::{Language, Text};
use hsd_base::text;
use hsd_syntax::templates::{EXAMPLES, TYPES, Template};
use std::io::{self, Write};
use std::path::PathBuf;

/// Create a source file from a template.
///
/// The file has parameters for the size and the facades of the house. Without TYPE, the templates are listed.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  hsd new                            list the templates
  hsd new chu-nikai -o shop.hsd      create a town house of the Edo period
  hsd new storehouse                 use any name: 蔵, kura, dozō
  hsd params shop.hsd                list its parameters")]
pub(super) struct New {
    /// The house type, by any of its English or Japanese names.
    #[arg(value_name = "TYPE")]
    kind: Option<String>,

    /// Write to this file; `-` for standard output [default: TYPE.hsd].
    #[arg(short, long, value_name = "FILE", requires = "kind")]
    output: Option<PathBuf>,

    /// Overwrite an existing file.
    #[arg(long, requires = "kind")]
    force: bool,
}

impl New {
    pub(super) fn run(&self, language: Language) -> Outcome {
        let Some(name) = &self.kind else {
            return list(language);
        };
        let found = Template::named(name).map_or_else(|| Template::found(name), |t| vec![t]);
        let [kind] = *found else {
            return Err(undecided(name, &found));
        };
        let path = match &self.output {
            Some(path) => path.clone(),
            None => PathBuf::from(format!("{}.hsd", kind.word)),
        };
        let shown = path.display();
        let stdout = path.as_os_str() == STDIN;
        // A dangling link counts as existing.
        if !stdout && !self.force && path.symlink_metadata().is_ok() {
            return Err(Failure::Io(text!([shown]
                "{shown} already exists; overwrite it with --force or choose another name with -o",
                "{shown} はすでにあります。--force で上書きするか、-o で別の名前を指定してください"
            )));
        }
        Committer::default().write(&path, Files::bytes(kind.text().into_bytes()))?;
        if !stdout {
            let (ja, en) = (kind.ja, kind.en);
            let message = text!([shown, ja, en]
                "wrote {shown}: {ja}, {en}; `hsd params {shown}` lists its parameters",
                "{shown} を書きました: {ja}。パラメーターは `hsd params {shown}` で一覧できます"
            );
            writeln!(io::stderr(), "{}", message.in_language(language))?;
        }
        Ok(Exit::Done)
    }
}

/// Lists the templates, one per line.
fn list(language: Language) -> Outcome {
    let all = || TYPES.iter().chain(EXAMPLES);
    let column = |name: fn(&Template) -> &str| all().map(|t| width(name(t))).max().unwrap_or(0);
    let widths = [column(|t| t.word), column(|t| t.ja), column(|t| t.romaji)];
    let mut out = io::stdout().lock();
    let line = |t: &Template| {
        let cells = [t.word, t.ja, t.romaji].into_iter().zip(widths);
        let cells: Vec<String> = cells.map(|(cell, wide)| padded(cell, wide)).collect();
        format!("{}  {}", cells.join("  "), t.en)
    };
    for t in TYPES {
        writeln!(out, "{}", line(t))?;
    }
    let title = text!(
        "\nComplete houses without parameters:",
        "\nパラメーターのない、完成した家:"
    );
    writeln!(out, "{}", title.in_language(language))?;
    for t in EXAMPLES {
        writeln!(out, "{}", line(t))?;
    }
    let more = text!(
        "\n`hsd new TYPE -o FILE` creates a source file. The first seven are types of Kyoto town houses.",
        "\n`hsd new TYPE -o FILE` でテキストを作ります。初めの七つは京町家の類型です。"
    );
    writeln!(out, "{}", more.in_language(language))?;
    out.flush()?;
    Ok(Exit::Done)
}

/// Returns the error for a name that matches several templates, or none.
fn undecided(name: &str, found: &[&Template]) -> Failure {
    let list = |templates: &[&Template]| {
        let names = templates.iter().map(|t| format!("{} ({})", t.word, t.ja));
        names.collect::<Vec<_>>().join(", ")
    };
    if !found.is_empty() {
        let found = list(found);
        return Failure::Usage(text!([name, found]
            "{name:?} is ambiguous: choose one of {found} with `hsd new TYPE`",
            "{name:?} に当てはまるのは {found} です。`hsd new TYPE` でひとつを選んでください"
        ));
    }
    if let Some(note) = Template::absent(name) {
        return Failure::Usage(Text::from(*note));
    }
    match &*Template::nearest(name) {
        [] => Failure::Usage(text!([name]
            "no house type {name:?}; `hsd new` lists them all",
            "{name:?} という類型はありません。`hsd new` で一覧できます"
        )),
        near => {
            let near = list(near);
            Failure::Usage(text!([name, near]
                "no house type {name:?}; the nearest are {near}; `hsd new` lists them all",
                "{name:?} という類型はありません。近いものは {near} です。`hsd new` で一覧できます"
            ))
        }
    }
}
