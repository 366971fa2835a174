//! Partition and ridge rules: from a plain rectangle to the densest plan that is searched exactly.

use divan::Bencher;
use hsd::roof::partition::Method;
use hsd::roof::plan::{Cell, Plan};
use hsd::roof::ridge::regions;

#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() {
    divan::main();
}

/// Outlines in quarter units.
const OUTLINES: [&str; 5] = ["rectangle", "L", "H", "Ninomaru", "31x31 fields"];

fn plan(name: &str) -> Plan {
    let halls: Vec<[i64; 4]> = match name {
        "rectangle" => vec![[0, 0, 6, 9]],
        "L" => vec![[0, 0, 14, 6], [0, 6, 6, 12]],
        "H" => vec![[0, 0, 6, 18], [6, 7, 14, 11], [14, 0, 20, 18]],
        "Ninomaru" => vec![
            [82, 0, 90, 10],
            [78, 10, 110, 43],
            [59, 22, 78, 40],
            [32, 26, 59, 56],
            [32, 56, 38, 71],
            [8, 71, 36, 92],
            [14, 92, 16, 107],
            [0, 107, 18, 125],
        ],
        _ => (0..961)
            .map(|n| (n % 31, n / 31))
            .filter(|(x, y)| (x * 7 + y * 13 + x * y) % 5 != 0)
            .map(|(x, y)| [x, y, x + 1, y + 1])
            .collect(),
    };
    let cell = |c: &[i64; 4]| Cell {
        a0: 4 * c[0],
        b0: 4 * c[1],
        a1: 4 * c[2],
        b1: 4 * c[3],
    };
    Plan::from_cells(&halls.iter().map(cell).collect::<Vec<_>>()).clean()
}

#[divan::bench(args = OUTLINES)]
fn least_cut(bencher: Bencher<'_, '_>, name: &str) {
    let plan = plan(name);
    bencher.bench(|| regions(divan::black_box(&plan), None, Method::LeastCut, None, 4));
}

#[divan::bench(args = OUTLINES)]
fn kd(bencher: Bencher<'_, '_>, name: &str) {
    let plan = plan(name);
    bencher.bench(|| regions(divan::black_box(&plan), None, Method::Kd, None, 4));
}
