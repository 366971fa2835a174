//! Names of rooms that say how many mats lie in them.

/// Returns the number of mats in a name: 八畳, 四畳半, 8 mats.
pub(super) fn called(name: &str) -> Option<f64> {
    let at = ["畳", "帖", "mat", "-mat", "jo"]
        .iter()
        .find_map(|word| name.find(word))?;
    let half = name[at..].chars().nth(1) == Some('半');
    let digit = |c: char| match c {
        '0'..='9' | '.' => Some(c),
        '０'..='９' => char::from_digit(u32::from(c) - u32::from('０'), 10),
        _ => None,
    };
    let before = name[..at].trim_end_matches([' ', '\u{3000}', '-']);
    let tail = |is: &dyn Fn(char) -> bool| {
        let start = before
            .char_indices()
            .rev()
            .take_while(|(_, c)| is(*c))
            .last();
        start.map(|(i, _)| &before[i..])
    };
    let number = match tail(&|c| digit(c).is_some()) {
        Some(text) => text
            .chars()
            .filter_map(digit)
            .collect::<String>()
            .parse()
            .ok()?,
        None => kanji(tail(&|c| KANJI.contains(c) || c == '十')?)?,
    };
    Some(number + if half { 0.5 } else { 0.0 })
}

const KANJI: &str = "一二三四五六七八九";

/// Returns a number below a hundred that is written in kanji.
fn kanji(text: &str) -> Option<f64> {
    let digit = |c: char| KANJI.chars().position(|k| k == c).map(|i| i as f64 + 1.0);
    let one = |text: &str, empty: f64| {
        let mut chars = text.chars();
        match (chars.next(), chars.next()) {
            (None, _) => Some(empty),
            (Some(c), None) => digit(c),
            _ => None,
        }
    };
    match text.split_once('十') {
        Some((tens, ones)) => Some(one(tens, 1.0)? * 10.0 + one(ones, 0.0)?),
        None => one(text, 0.0),
    }
}

#[cfg(test)]
mod tests {
    use super::called;

    #[test]
    fn names_tell_the_number_of_mats() {
        for (name, mats) in [
            ("八畳", Some(8.0)),
            ("四畳半", Some(4.5)),
            ("座敷(十二畳)", Some(12.0)),
            ("二十一畳の間", Some(21.0)),
            ("６畳", Some(6.0)),
            ("4.5 mats", Some(4.5)),
            ("8-mat room", Some(8.0)),
            ("座敷", None),
            ("matsu", None),
            ("畳", None),
        ] {
            assert_eq!(called(name), mats, "{name}");
        }
    }
}
