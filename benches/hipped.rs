//! Hipped roofs by the straight skeleton, from corners to closed solids, by the number of corners.

use divan::Bencher;
use glam::{DVec2, dvec2};
use hsd::ast::RoofStyle;
use hsd::roof::shape::look::Look;

#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() {
    divan::main();
}

/// Real outlines have 5 to 8 corners: the first three are such.
const SHAPES: [&str; 9] = [
    "rectangle",
    "skew 5",
    "skew 8",
    "court",
    "star 20",
    "star 50",
    "star 200",
    "star 1000",
    "comb 1000",
];

/// An outline in metres, and its courts.
fn outline(name: &str) -> (Vec<DVec2>, Vec<Vec<DVec2>>) {
    let points = |p: &[(f64, f64)]| p.iter().map(|p| dvec2(p.0, p.1)).collect::<Vec<_>>();
    let (kind, count) = name.split_once(' ').unwrap_or((name, "0"));
    let count: usize = count.parse().unwrap_or_default();
    match (kind, count) {
        ("rectangle", _) => (
            points(&[(0.0, 0.0), (9.0, 0.0), (9.0, 5.5), (0.0, 5.5)]),
            vec![],
        ),
        ("skew", 5) => (
            points(&[(0.0, 0.0), (9.0, 0.3), (8.7, 5.5), (3.0, 7.0), (-0.2, 5.4)]),
            vec![],
        ),
        ("skew", _) => {
            let t = [
                (0.0, 0.0),
                (12.0, 0.1),
                (12.0, 4.0),
                (8.0, 4.1),
                (7.9, 12.3),
                (5.0, 12.0),
                (5.1, 4.1),
                (0.0, 4.0),
            ];
            (points(&t), vec![])
        }
        ("court", _) => (
            points(&[(0.0, 0.0), (14.0, 0.0), (14.0, 12.0), (0.0, 12.0)]),
            vec![points(&[(4.0, 4.0), (10.0, 4.0), (10.0, 8.0), (4.0, 8.0)])],
        ),
        ("star", n) => {
            let corner = |i: usize| {
                let turn = std::f64::consts::TAU * i as f64 / n as f64;
                let far = 10.0 + ((i * 7919) % 101) as f64 / 10.0;
                dvec2(far * turn.cos(), far * turn.sin())
            };
            ((0..n).map(corner).collect(), vec![])
        }
        (_, n) => {
            let teeth = n / 4;
            let mut comb = vec![dvec2(0.0, 0.0), dvec2(2.0 * teeth as f64 - 1.0, 0.0)];
            for k in (0..teeth).rev() {
                let x = 2.0 * k as f64;
                comb.extend(points(&[(x + 1.0, 3.0), (x, 3.0)]));
                if k > 0 {
                    comb.extend(points(&[(x, 1.0), (x - 1.0, 1.0)]));
                }
            }
            (comb, vec![])
        }
    }
}

/// From corners to closed solids.
#[divan::bench(args = SHAPES)]
fn hipped(bencher: Bencher<'_, '_>, name: &str) {
    let (outline, courts) = outline(name);
    let look = Look::gable(None, &RoofStyle::default(), 6.0, 0.909);
    bencher.bench(|| hsd::roof::over(divan::black_box(&outline), &courts, 3.0, &look));
}
