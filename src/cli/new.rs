//! `hsd new`: a text to start from.

use super::{Exit, Outcome, Stop};
use crate::cli::files::input::STDIN;
use crate::cli::files::output;
use crate::cli::files::output::Files;
use crate::cli::files::terminal::{padded, width};
use crate::diagnostic::{Language, Text};
use crate::templates::{EXAMPLES, TYPES, Template};
use crate::text;
use clap::Args;
use std::io::{self, Write};
use std::path::PathBuf;

/// Start a text from a type of house: a copy with parameters for its size and its fronts.
///
/// Without TYPE it lists the types.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  hsd new                            the types
  hsd new chu-nikai -o shop.hsd      a town house of Edo to start from
  hsd new storehouse                 any name will do: 蔵, kura, dozō
  hsd params shop.hsd                what can be set in it")]
pub(super) struct New {
    /// The type, by any of its names in English or Japanese.
    #[arg(value_name = "TYPE")]
    kind: Option<String>,

    /// Where the text goes; `-` is standard output. Without it TYPE.hsd in this folder.
    #[arg(short, long, value_name = "FILE", requires = "kind")]
    output: Option<PathBuf>,

    /// Write over a file that is there.
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
        let screen = path.as_os_str() == STDIN;
        // A link that leads nowhere is there as well.
        if !screen && !self.force && path.symlink_metadata().is_ok() {
            return Err(Stop::Io(text!(
                "{shown} is there already; --force writes over it, -o gives another name",
                "{shown} はすでにあります。--force で上書きし、-o で別の名前を付けられます"
            )));
        }
        output::write(&path, Files::bytes(kind.text().into_bytes()))?;
        if !screen {
            let (ja, en) = (kind.ja, kind.en);
            let said = text!(
                "wrote {shown}: {ja}, {en}; `hsd params {shown}` lists what can be set",
                "{shown} を書きました: {ja}。設定できるものは `hsd params {shown}` で分かります"
            );
            writeln!(io::stderr(), "{}", said.in_language(language))?;
        }
        Ok(Exit::Done)
    }
}

/// A line for each type.
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
        "\nFinished houses, without parameters:",
        "\n変数のない、完成した家:"
    );
    writeln!(out, "{}", title.in_language(language))?;
    for t in EXAMPLES {
        writeln!(out, "{}", line(t))?;
    }
    let more = text!(
        "\n`hsd new TYPE -o FILE` copies one. The first seven are the types of Kyoto's town houses.",
        "\n`hsd new TYPE -o FILE` で写しを作ります。初めの七つは京町家の類型です。"
    );
    writeln!(out, "{}", more.in_language(language))?;
    out.flush()?;
    Ok(Exit::Done)
}

/// Refuses a word that several templates answer to, or none.
fn undecided(name: &str, found: &[&Template]) -> Stop {
    let list = |templates: &[&Template]| {
        let names = templates.iter().map(|t| format!("{} ({})", t.word, t.ja));
        names.collect::<Vec<_>>().join(", ")
    };
    if !found.is_empty() {
        let found = list(found);
        return Stop::Usage(text!(
            "{name:?} may be any of {found}; `hsd new TYPE` copies one",
            "{name:?} に当たるものは {found} です。`hsd new TYPE` でそのひとつを写せます"
        ));
    }
    if let Some(note) = Template::absent(name) {
        return Stop::Usage(Text::from(*note));
    }
    match &*Template::nearest(name) {
        [] => Stop::Usage(text!(
            "there is no type {name:?}; `hsd new` lists them all",
            "{name:?} という類型はありません。`hsd new` で一覧できます"
        )),
        near => {
            let near = list(near);
            Stop::Usage(text!(
                "there is no type {name:?}; the nearest are {near}; `hsd new` lists them all",
                "{name:?} という類型はありません。近いものは {near} です。`hsd new` で一覧できます"
            ))
        }
    }
}
