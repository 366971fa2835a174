//! Japanese words in letters: how to tell that two spellings are one word.

/// A reading without what romanisations differ in: long vowels, hyphens, blanks.
pub fn folded(reading: &str) -> String {
    let mut out = String::new();
    for c in reading.to_lowercase().chars() {
        let plain = match c {
            'ā' | 'â' => 'a',
            'ī' | 'î' => 'i',
            'ū' | 'û' => 'u',
            'ē' | 'ê' => 'e',
            'ō' | 'ô' => 'o',
            '-' | ' ' | '\'' | '\u{304}' | '\u{302}' => continue,
            c => c,
        };
        let long = match plain {
            'u' => out.ends_with(['o', 'u']),
            'o' | 'a' => out.ends_with(plain),
            _ => false,
        };
        if !long {
            out.push(plain);
        }
    }
    out
}
