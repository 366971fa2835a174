//! The words of roof lines: option letters with their bounds, and the names that authors write instead of letters.

use super::words::Range64;
use hsd_base::diagnostic::noun;

/// Options with a number, by letter.
pub(super) const OPTIONS: [(char, Range64); 8] = [
    (
        'P',
        Range64 {
            what: noun("the pitch", "勾配"),
            bounds: 0.1..=30.0,
            unit: noun("sun per shaku", "寸勾配"),
        },
    ),
    (
        'E',
        Range64 {
            what: noun("the eaves", "軒の出"),
            bounds: 0.0..=20.0,
            unit: noun("shaku", "尺"),
        },
    ),
    (
        'G',
        Range64 {
            what: noun("the verge", "螻羽の出"),
            bounds: 0.0..=20.0,
            unit: noun("shaku", "尺"),
        },
    ),
    (
        'T',
        Range64 {
            what: noun("the thickness", "屋根の厚さ"),
            bounds: 0.05..=5.0,
            unit: noun("shaku", "尺"),
        },
    ),
    (
        'M',
        Range64 {
            what: noun("the number of ridge courses", "のし瓦の段数"),
            bounds: 0.0..=20.0,
            unit: noun("courses", "段"),
        },
    ),
    (
        'S',
        Range64 {
            what: noun("the sag of the slope", "反り"),
            bounds: -20.0..=20.0,
            unit: noun("per cent", "パーセント"),
        },
    ),
    (
        'C',
        Range64 {
            what: noun("the place of the gable", "妻の位置"),
            bounds: 0.0..=0.5,
            unit: noun("of the span", "梁間に対する比"),
        },
    ),
    (
        'R',
        Range64 {
            what: noun("the length of the ridge", "棟の長さ"),
            bounds: 0.0..=1.0,
            unit: noun("of the roof's length", "屋根の長さに対する比"),
        },
    ),
];
