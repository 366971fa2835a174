//! A short line diff of two texts.

use hsd_base::diagnostic::{Language, visible};
use hsd_syntax::print;

/// The maximum number of lines shown.
const MOST: usize = 12;

/// Returns the first differing lines, as `3 - before` and `3 + after`, with trailing blanks shown as dots.
pub(crate) fn short(before: &str, after: &str, language: Language) -> Vec<String> {
    let (old, new): (Vec<&str>, Vec<&str>) = (before.lines().collect(), after.lines().collect());
    let mut shown = vec![];
    for (gone, come) in print::changes(&old, &new) {
        if shown.len() > MOST {
            break;
        }
        shown.extend(gone.map(|n| line(n, '-', old[n])));
        shown.extend(come.map(|n| line(n, '+', new[n])));
    }
    if shown.len() > MOST {
        shown.truncate(MOST);
        let more = language.choose("more differences follow", "ほかにも違いがあります");
        shown.push(format!("    {more}"));
    }
    if shown.is_empty() && before != after {
        let ends = language.choose("line endings", "改行コード");
        shown.push(format!("    {ends}"));
    }
    shown
}

fn line(number: usize, sign: char, text: &str) -> String {
    let written = text.trim_end();
    let blanks = text[written.len()..].chars().count();
    let written = visible::line(written);
    format!("{:>5} {sign} {written}{}", number + 1, "·".repeat(blanks))
}

#[cfg(test)]
mod tests {
    use crate::files::diff::*;

    #[test]
    fn lines_that_differ_are_shown_and_no_others() {
        let short = |before: &str, after: &str| short(before, after, Language::English);
        assert_eq!(short("a\nb\nc\n", "a\nb\nc\n"), [""; 0]);
        assert_eq!(
            short("a\nb  \nc\n", "a\nb\nc\n"),
            ["    2 - b··", "    2 + b"]
        );
        assert_eq!(short("a\n\n\nb\n", "a\n\nb\n"), ["    3 - "]);
        assert_eq!(short("a\r\nb", "a\nb"), ["    line endings"]);
        let many: String = (0..99).map(|n| format!("{n} \n")).collect();
        let shown = short(&many, &many.replace(" \n", "\n"));
        assert_eq!(shown.len(), MOST + 1);
    }
}
