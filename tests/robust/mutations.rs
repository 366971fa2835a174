//! The examples with a few bytes changed, always the same way.

use crate::support::Numbers;

/// Things that have a meaning in one of the two syntaxes, or look as if they had.
const TRICKY: &[&str] = &[
    "\u{3000}",
    "\t",
    "L",
    "R",
    "^",
    "\n",
    "\r\n",
    "\n\n",
    "%",
    "#",
    ".....",
    "     ",
    "<",
    ">",
    "&",
    "\"",
    "'",
    "</",
    "/>",
    "<!--",
    "-->",
    "<![CDATA[",
    "]]>",
    "<!DOCTYPE a>",
    "&lol;",
    "&#0;",
    "&#x110000;",
    "{",
    "}",
    "{k}",
    "{1/0}",
    "{1e308*1e308}",
    "<repeat num=\"1000000000\">",
    "<Row>",
    "</Row>",
    "<split>",
    "<upper>",
    "<Loop hole=\"yes\">",
    "<Storey height=\"-1\">",
    "1e999",
    "-1e308",
    "NaN",
    "inf",
    "99999999999999999999",
    "-0",
    "0.0000001",
    "KSK",
    "GKK h",
    "KUD 0",
    "ｶﾞ",
    "\u{0}",
    "\u{feff}",
    "\u{fffd}",
    "家",
    "unit 0",
    "unit 1e9",
    "seed -1",
    "roofs auto",
    "method kd",
    "K X * KIR 0 0 6 8",
    "K F 8.1 HIS 0 0 6 -1",
];

/// One to four changes of a text.
fn mutated(mut bytes: Vec<u8>, numbers: &mut Numbers) -> Vec<u8> {
    for _ in 0..=numbers.below(4) {
        let at = numbers.below(bytes.len() + 1);
        let end = (at + numbers.below(20)).min(bytes.len());
        match numbers.below(6) {
            0 if at < bytes.len() => bytes[at] ^= 1 << numbers.below(8),
            1 => drop(bytes.drain(at..end)),
            2 => {
                let copy = line_at(&bytes, at);
                bytes.splice(at..at, copy);
            }
            3 if at < bytes.len() => bytes[at] = numbers.next() as u8,
            4 => {
                let from = numbers.below(bytes.len() + 1);
                let copy = line_at(&bytes, from);
                bytes.splice(at..end, copy);
            }
            _ => {
                let token = numbers.of(TRICKY).bytes();
                bytes.splice(at..at, token);
            }
        }
    }
    bytes
}

/// The line that holds an offset, with its end.
fn line_at(bytes: &[u8], at: usize) -> Vec<u8> {
    let start = bytes[..at]
        .iter()
        .rposition(|&b| b == b'\n')
        .map_or(0, |i| i + 1);
    let end = bytes[at..]
        .iter()
        .position(|&b| b == b'\n')
        .map_or(bytes.len(), |i| at + i + 1);
    bytes[start..end].to_vec()
}

/// The nth mutation of the examples.
pub(crate) fn mutation(examples: &[(String, Vec<u8>)], index: usize) -> (String, Vec<u8>) {
    let mut numbers = Numbers(index as u64);
    let (name, bytes) = numbers.of(examples);
    let bytes = mutated(bytes.clone(), &mut numbers);
    (format!("{name}, mutation {index}"), bytes)
}
