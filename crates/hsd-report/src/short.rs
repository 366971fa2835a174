//! One line per message, as compilers write them: editors jump to such lines.

use super::{Report, word};
use hsd_base::diagnostic::Language;
use hsd_base::diagnostic::visible;
use std::io::{self, Write};

pub(super) fn write(report: &Report<'_>, out: &mut dyn Write) -> io::Result<()> {
    for d in report.diagnostics {
        if let Some(span) = d.span() {
            let (name, at) = (visible::line(report.name(span.file)), report.position(span));
            write!(out, "{name}:{}:{}: ", at.line, at.column)?;
        }
        let message = visible::line(&d.full_message().in_language(report.language));
        write!(out, "{}[{}]: {message}", word(d.severity), d.code)?;
        if !d.help.is_empty() {
            let help = visible::line(&d.help.in_language(report.language));
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
            write!(out, " ({line}: {})", visible::line(&text))?;
        }
        writeln!(out)?;
    }
    Ok(())
}
