//! A plan read again, from a better scan: what the author has changed since the first reading stays.

use diffy::{ConflictStyle, MergeOptions};

/// The length of marks round what both have changed: longer than anything that a text repeats.
const MARK: usize = 64;
/// Ends a piece of a line.
const PIECE: &str = "\u{1}\n";

/// A text of two readings.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Merged {
    /// The text.
    pub text: String,
    /// Places that the author has changed and that are read otherwise now: they are as the author has them.
    pub kept: Vec<std::ops::Range<usize>>,
}

/// Puts the changes of an author, who began with one reading, into another.
pub fn merged(before: &str, edited: &str, now: &str) -> Merged {
    let mut options = MergeOptions::new();
    options
        .set_conflict_marker_length(MARK)
        .set_conflict_style(ConflictStyle::Merge);
    let both = options
        .merge(&pieces(before), &pieces(edited), &pieces(now))
        .unwrap_or_else(|marked| marked);
    let mut out = Merged {
        text: String::new(),
        kept: vec![],
    };
    let is_mark = |line: &str, c: char| line.chars().take_while(|d| *d == c).count() == MARK;
    let (mut start, mut is_theirs) = (0, false);
    for line in both.split_inclusive('\n') {
        if is_mark(line, '<') {
            start = out.text.len();
        } else if is_mark(line, '=') {
            is_theirs = true;
            out.kept.push(start..out.text.len());
        } else if is_mark(line, '>') {
            is_theirs = false;
        } else if !is_theirs {
            out.text.push_str(line.strip_suffix(PIECE).unwrap_or(line));
        }
    }
    out
}

/// A text with each part of a row on a line of its own, so that the changes of two parts of one wall do not meet.
fn pieces(text: &str) -> String {
    let mut out = String::with_capacity(text.len() * 2);
    for line in text.split_inclusive('\n') {
        let Some((before, codes, after)) = row(line) else {
            out.push_str(line);
            continue;
        };
        out.push_str(before);
        out.push_str(PIECE);
        let mut rest = codes;
        while !rest.is_empty() {
            let end = rest.char_indices().nth(5).map_or(rest.len(), |(at, _)| at);
            out.push_str(&rest[..end]);
            out.push_str(PIECE);
            rest = &rest[end..];
        }
        out.push_str(after);
    }
    out
}

/// A line with a row: its opening tag, its parts, what follows.
fn row(line: &str) -> Option<(&str, &str, &str)> {
    let tag = line.find("<Row")?;
    let open = tag + line[tag..].find('>')? + 1;
    let close = open + line[open..].find("</Row>")?;
    Some((&line[..open], &line[open..close], &line[close..]))
}

#[cfg(test)]
mod tests {
    use super::*;

    const BEFORE: &str =
        "<House>\n  <!-- in doubt: KTU at 1 0 -->\n  <Row>KTU  KTU  GSI  KTU  </Row>\n</House>\n";

    #[test]
    fn changes_of_both_stay_in_one_row() {
        let edited = BEFORE
            .replace("<Row>KTU  KTU", "<Row>KTU  AKI")
            .replace("  <!-- in doubt: KTU at 1 0 -->\n", "");
        let now = BEFORE.replace("GSI  KTU  ", "GSI  TSH  ");
        let both = merged(BEFORE, &edited, &now);
        assert_eq!(
            both.text,
            "<House>\n  <Row>KTU  AKI  GSI  TSH  </Row>\n</House>\n"
        );
        assert_eq!(both.kept, []);
    }

    #[test]
    fn where_both_differ_the_author_is_right_and_the_place_is_told() {
        let edited = BEFORE.replace("GSI  ", "MRE  ");
        let now = BEFORE.replace("GSI  ", "TSH  ");
        let both = merged(BEFORE, &edited, &now);
        assert_eq!(both.text, edited);
        let [place] = &both.kept[..] else {
            panic!("{:?}", both.kept)
        };
        assert_eq!(&both.text[place.clone()], "MRE  ");
    }

    #[test]
    fn without_changes_the_new_reading_stands() {
        let now = "<House>\n  <Row>TSH 2</Row>\n</House>\n";
        assert_eq!(merged(BEFORE, BEFORE, now).text, now);
        assert_eq!(merged(BEFORE, "mine\n", BEFORE).text, "mine\n");
    }
}
