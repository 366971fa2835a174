//! A short diff of two texts, line by line, for a reader who wants to know what would change.

use crate::diagnostic::Language;

/// Lines shown.
const MOST: usize = 12;

/// How far apart the same line may stand in both texts.
const NEAR: usize = 60;

/// The first lines that differ: `3 - before`, `3 + after`, with blanks at their ends made visible.
pub(super) fn short(before: &str, after: &str, language: Language) -> Vec<String> {
    let (old, new): (Vec<&str>, Vec<&str>) = (before.lines().collect(), after.lines().collect());
    let (mut i, mut j, mut shown) = (0, 0, vec![]);
    while (i < old.len() || j < new.len()) && shown.len() <= MOST {
        if i < old.len() && j < new.len() && old[i] == new[j] {
            (i, j) = (i + 1, j + 1);
            continue;
        }
        let (gone, come) = apart(&old[i..], &new[j..]);
        shown.extend((i..i + gone).map(|n| line(n, '-', old[n])));
        shown.extend((j..j + come).map(|n| line(n, '+', new[n])));
        (i, j) = (i + gone, j + come);
    }
    if shown.len() > MOST {
        shown.truncate(MOST);
        let more = language.choose("and more", "ほかにもあります");
        shown.push(format!("    {more}"));
    }
    if shown.is_empty() && before != after {
        let ends = language.choose("line ends", "改行");
        shown.push(format!("    {ends}"));
    }
    shown
}

/// How many lines of both stand before the next one they share; at least one of both texts moves on.
fn apart(old: &[&str], new: &[&str]) -> (usize, usize) {
    for distance in 1..=NEAR.min(old.len() + new.len()) {
        for gone in (0..=distance.min(old.len())).rev() {
            let come = distance - gone;
            let both = old.get(gone).zip(new.get(come));
            let ends = gone == old.len() && come == new.len();
            if ends || both.is_some_and(|(o, n)| o == n) {
                return (gone, come);
            }
        }
    }
    (1.min(old.len()), 1.min(new.len()))
}

fn line(number: usize, sign: char, text: &str) -> String {
    let written = text.trim_end();
    let blanks = text[written.len()..].chars().count();
    format!("{:>5} {sign} {written}{}", number + 1, "·".repeat(blanks))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_that_differ_are_shown_and_no_others() {
        let short = |before: &str, after: &str| short(before, after, Language::English);
        assert_eq!(short("a\nb\nc\n", "a\nb\nc\n"), [""; 0]);
        assert_eq!(
            short("a\nb  \nc\n", "a\nb\nc\n"),
            ["    2 - b··", "    2 + b"]
        );
        assert_eq!(short("a\n\n\nb\n", "a\n\nb\n"), ["    3 - "]);
        assert_eq!(short("a\r\nb", "a\nb"), ["    line ends"]);
        let many: String = (0..99).map(|n| format!("{n} \n")).collect();
        let shown = short(&many, &many.replace(" \n", "\n"));
        assert_eq!(shown.len(), MOST + 1);
    }
}
