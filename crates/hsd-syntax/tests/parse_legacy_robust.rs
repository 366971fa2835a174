//! No bytes whatever disturb the reader of the legacy text, or hold it up.

use hsd_base::diagnostic::{Diagnostic, Diagnostics, Severity};
use hsd_base::source::{FileId, Limits, Source};
use hsd_testing::cpu::{assert_linear, spent};
use std::time::Duration;

/// The example of docs/evidence.md 2.6.
const TOWN_HOUSE: &str = "\
0 0 180
9.0 5.0

GSI  GSI  GDE 2TOD  KKS
APW  APW  APW  APW  APW  APW  APW  APW
KTU  TSH 2TSH 2KTU
APW  APW  APW  APW  APW  APW  APW  APW  ^
KSK  MMU 2MMU 2KSK
APW  APW  APW  APW  APW  APW  APW  APW
KTU  MMU 2MMU 2KTU
APW  APW  APW  APW  APW  APW  APW  APW

K X  14.0 KIR   0   0   6   8  P4.0 E2.5 G0.5 M3
K F   8.1 HIS   0   0   6  -1  P3.0
";

fn read_bytes(bytes: &[u8]) -> Vec<Diagnostic> {
    let source = Source::new(FileId(0), "a.hsd", bytes);
    let mut out = Diagnostics::new();
    hsd_syntax::parse::parse(&source, &Limits::default(), &mut out);
    out.into_sorted()
}

/// A generator of numbers without a seed from outside, so that a failure can be found again.
struct Draws(u64);

impl Draws {
    fn next(&mut self, below: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 % below as u64) as usize
    }
}

fn mutate(bytes: &mut Vec<u8>, draws: &mut Draws) {
    const BITS: [&[u8]; 16] = [
        b"\n",
        b"\r",
        b"\t",
        b" ",
        b"L",
        b"^",
        b"#",
        b"%",
        b".....",
        "　".as_bytes(),
        "Ｌ".as_bytes(),
        b"\0",
        b"\xff",
        b"K X * KIR 0 0 1 1",
        b"\n\n",
        b"1e9 ",
    ];
    let at = draws.next(bytes.len() + 1);
    match draws.next(4) {
        0 => drop(bytes.splice(at..at, BITS[draws.next(BITS.len())].iter().copied())),
        1 if at < bytes.len() => bytes[at] = draws.next(256) as u8,
        2 => {
            let end = (at + draws.next(12)).min(bytes.len());
            bytes.drain(at..end);
        }
        _ => {
            let end = (at + draws.next(40)).min(bytes.len());
            let copy = bytes[at..end].to_vec();
            let to = draws.next(bytes.len() + 1);
            bytes.splice(to..to, copy);
        }
    }
}

#[test]
fn no_mutation_disturbs_the_reader() {
    let mut draws = Draws(0x9e37_79b9_7f4a_7c15);
    let sample = format!("# 町家\n{TOWN_HOUSE}%\nname 蔵\n{TOWN_HOUSE}");
    let (mut sound, mut changed) = (Duration::ZERO, Duration::ZERO);
    for round in 0..10_000 {
        let mut bytes = sample.clone().into_bytes();
        for _ in 0..=draws.next(8) {
            mutate(&mut bytes, &mut draws);
        }
        let source = Source::new(FileId(0), "a.hsd", &bytes);
        let mut out = Diagnostics::new();
        let parse = |out| hsd_syntax::parse::legacy::parse(&source, &Limits::default(), out);
        let (document, took) = spent(|| parse(&mut out));
        changed += took;
        sound += spent(|| read_bytes(sample.as_bytes())).1;
        let errors = out.iter().any(|d| d.severity == Severity::Error);
        assert_eq!(errors, out.has_errors());
        let inside = |s: &hsd_base::source::Span| s.start <= s.end && s.end as usize <= bytes.len();
        for told in out.iter() {
            assert!(inside(&told.span().unwrap()), "round {round}: {told:?}");
            assert!(told.labels.iter().all(|l| inside(&l.span)), "round {round}");
        }
        assert!(
            document.houses.iter().all(|h| inside(&h.span)),
            "round {round}"
        );
        assert!(errors || !document.houses.is_empty(), "round {round}");
    }
    // Messages take more than they replace, but none takes a multiple of the whole.
    assert!(changed < 4 * sound, "{changed:?} instead of {sound:?}");
}

#[test]
fn lines_of_anything_are_read_in_linear_time() {
    for piece in [
        "A#BCD", "^", "^ ", "KSM ", "町", "#", "\u{1}\n", "L\n", "seed 1\n", "KX ", ".", "　",
        "K X ", "\r", "\r\r\n", "大戸 ",
    ] {
        for before in ["", "0 0\n\n", "0 0\n\nKSM\n\nK X * KIR 0 0 1 1 "] {
            let make = |bytes: usize| format!("{before}{}", piece.repeat(bytes / piece.len()));
            let read = |text: &String| {
                let told = read_bytes(text.as_bytes());
                assert!(told.len() <= 503, "{piece:?}");
            };
            assert_linear(&format!("{before:?} {piece:?}"), 75_000, make, read);
        }
    }
}

proptest::proptest! {
    #![proptest_config(hsd_testing::sampled(256))]

    #[test]
    fn any_bytes_are_read(bytes in proptest::collection::vec(proptest::num::u8::ANY, 0..400)) {
        let told = read_bytes(&bytes);
        for d in told {
            assert!(d.span().unwrap().start <= d.span().unwrap().end && d.span().unwrap().end as usize <= bytes.len());
        }
    }
}
