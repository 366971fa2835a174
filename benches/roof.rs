//! Partition and ridge rules: from a plain rectangle to the densest plan that is searched exactly; and the mean
//! real house, divided and roofed.

mod outlines;
mod texts;

use divan::Bencher;
use divan::counter::ItemsCount;
use hsd::building::Shell;
use hsd::diagnostic::Diagnostics;
use hsd::geometry::plan::{Cell, Plan};
use hsd::roof::partition::{Method, partition};
use hsd::roof::plan::roles::regions;

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

#[divan::bench(args = OUTLINES)]
fn branch_cut(bencher: Bencher<'_, '_>, name: &str) {
    let plan = plan(name);
    bencher.bench(|| regions(divan::black_box(&plan), None, Method::BranchCut, None, 4));
}

/// The outlines of a museum village; the time of one is the mean.
#[divan::bench(args = [Method::Kd, Method::LeastCut, Method::BranchCut])]
fn real_outlines_divided(bencher: Bencher<'_, '_>, method: Method) {
    let plans = outlines::village();
    bencher.counter(ItemsCount::new(plans.len())).bench(|| {
        let cells = |plan| partition(divan::black_box(plan), method).len();
        plans.iter().map(cells).sum::<usize>()
    });
}

/// The same divided by `least-cut`, their walls given, up to closed solids.
#[divan::bench]
fn real_outlines_roofed(bencher: Bencher<'_, '_>) {
    roofed(bencher, &outlines::village());
}

/// What one house of so many corners costs.
#[divan::bench(args = [4, 6, 8, 10, 12, 14, 16, 20, 26])]
fn corners_divided(bencher: Bencher<'_, '_>, corners: usize) {
    let plans = outlines::of(corners, 40);
    bencher.counter(ItemsCount::new(plans.len())).bench(|| {
        let cells = |plan| partition(divan::black_box(plan), Method::LeastCut).len();
        plans.iter().map(cells).sum::<usize>()
    });
}

/// The same up to closed solids.
#[divan::bench(args = [4, 6, 8, 10, 12, 14, 16, 20, 26])]
fn corners_roofed(bencher: Bencher<'_, '_>, corners: usize) {
    roofed(bencher, &outlines::of(corners, 40));
}

fn roofed(bencher: Bencher<'_, '_>, plans: &[Plan]) {
    let shell = shell(plans);
    bencher
        .counter(ItemsCount::new(plans.len()))
        .with_inputs(|| shell.clone())
        .bench_values(|shell| hsd::roof::roof(shell, &mut Diagnostics::new()));
}

/// The walls of houses of one storey.
fn shell(plans: &[Plan]) -> Shell {
    let text: Vec<String> = plans.iter().map(outlines::text).collect();
    texts::shell(&text.join("%\n"))
}
