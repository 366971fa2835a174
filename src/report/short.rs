//! One line per message, as compilers write them: editors jump to such lines.

use super::{Report, clean, word};
use crate::diagnostic::Language;
use std::io::{self, Write};

pub(super) fn write(report: &Report<'_>, out: &mut dyn Write) -> io::Result<()> {
    for d in report.diagnostics {
        let at = report.position(d.span);
        let (name, message) = (
            clean::line(report.name(d.span.file)),
            clean::line(&d.message.in_language(report.language)),
        );
        let (line, column, word) = (at.line, at.column, word(d.severity));
        write!(out, "{name}:{line}:{column}: {word}[{}]: {message}", d.code)?;
        if !d.help.is_empty() {
            let help = clean::line(&d.help.in_language(report.language));
            let word = report.language.choose("help", "対処");
            write!(out, " ({word}: {help})")?;
        }
        for label in &d.labels {
            let at = report.position(label.span);
            let (line, text) = (at.line, label.message.in_language(report.language));
            let line = match report.language {
                Language::English => format!("line {line}"),
                Language::Japanese => format!("{line}行目"),
            };
            write!(out, " ({line}: {})", clean::line(&text))?;
        }
        writeln!(out)?;
    }
    Ok(())
}
