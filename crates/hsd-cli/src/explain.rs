//! `hsd explain`: prints the page of a diagnostic.

use super::{Exit, Failure, Outcome};
use clap::Args;
use hsd_base::diagnostic::{Code, Language, pages};
use hsd_base::text;
use hsd_report::title;
use std::io::{self, Write};

/// Explain a diagnostic: its cause, an example, and how to fix it.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  hsd explain HSD0104    explain one diagnostic
  hsd explain            list all diagnostics")]
pub(super) struct Explain {
    /// The code of the diagnostic, such as HSD0104; `hsd0104` and `104` are accepted.
    code: Option<String>,
}

impl Explain {
    pub(super) fn run(&self, language: Language) -> Outcome {
        let mut out = io::stdout().lock();
        match &self.code {
            None => {
                for code in pages::codes() {
                    let title = pages::page(code, language).map(title);
                    writeln!(out, "{code}  {}", title.unwrap_or_default())?;
                }
            }
            Some(text) => {
                let page = number(text).and_then(|n| pages::page(Code(n), language));
                let page = page.ok_or_else(|| unknown(text))?;
                writeln!(out, "{}", page.trim_end())?;
            }
        }
        out.flush()?;
        Ok(Exit::Done)
    }
}

/// Parses a diagnostic code: `HSD0104`, `hsd0104` or `104`.
fn number(text: &str) -> Option<u16> {
    let text = text.trim();
    let digits = match text.get(..3) {
        Some(prefix) if prefix.eq_ignore_ascii_case("hsd") => &text[3..],
        _ => text,
    };
    digits.parse().ok()
}

fn unknown(text: &str) -> Failure {
    let Some(wanted) = number(text) else {
        return Failure::Usage(text!([text]
            "{text:?} is not a diagnostic code; codes look like HSD0104, `hsd explain` lists them",
            "{text:?} は指摘のコードではありません。コードは HSD0104 のような形で、`hsd explain` で一覧できます"
        ));
    };
    let mut near: Vec<Code> = pages::codes().collect();
    near.sort_by_key(|c| (c.0.abs_diff(wanted), c.0));
    near.truncate(3);
    near.sort_unstable();
    let near: Vec<String> = near.iter().map(Code::to_string).collect();
    let (wanted, near) = (Code(wanted), near.join(", "));
    Failure::Usage(text!([wanted, near]
        "no diagnostic {wanted}; the nearest are {near}",
        "{wanted} という指摘はありません。近いものは {near} です"
    ))
}
