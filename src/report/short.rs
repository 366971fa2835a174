//! A line a message, as compilers write them: editors jump to such lines.

use super::{Report, clean, word};
use std::io::{self, Write};

pub(super) fn write(report: &Report<'_>, out: &mut dyn Write) -> io::Result<()> {
    for d in report.diagnostics {
        let at = report.position(d.span);
        let (name, message) = (
            clean::line(report.name(d.span.file)),
            clean::line(&d.message),
        );
        let (line, column, word) = (at.line, at.column, word(d.severity));
        write!(out, "{name}:{line}:{column}: {word}[{}]: {message}", d.code)?;
        if !d.help.is_empty() {
            write!(out, " (help: {})", clean::line(&d.help))?;
        }
        for label in &d.labels {
            let at = report.position(label.span);
            write!(out, " (line {}: {})", at.line, clean::line(&label.message))?;
        }
        writeln!(out)?;
    }
    Ok(())
}
