//! Towns of houses that are all unlike, from text to the bytes of a file: houses a second of one processor, as
//! processor time, beside a drill of the machine in the same run. `cargo bench --bench town` prints the table of
//! `benches/RESULTS.md`; `cargo bench --bench town -- plain` only rows whose names contain `plain`.

#![expect(clippy::print_stdout)] // that is what it is for

mod texts;

use cpu_time::ProcessTime;
use hsd::Options;
use hsd::backend::gltf::Writer;
use hsd::backend::spool::Spool;
use hsd::diagnostic::Diagnostics;
use hsd::driver;
use hsd::parse::divide;
use hsd::scene::{Detail, Stats};
use hsd::source::{FileId, LongFile, NoFiles};
use std::hint::black_box;
use std::io::{self, Cursor};
use std::sync::Arc;
use std::time::{Duration, Instant};

#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

/// Runs of each row; the least of each time counts, since whatever disturbs a measurement makes it longer.
const RUNS: usize = 3;

/// A row of the table.
struct Row {
    name: &'static str,
    text: Arc<[u8]>,
    houses: usize,
    detail: Detail,
}

/// The cost and the output of a run.
struct Taken {
    processor: Duration,
    clock: Duration,
    bytes: u64,
    stats: Stats,
}

fn main() {
    let wanted: Vec<String> = std::env::args()
        .skip(1)
        .filter(|a| !a.starts_with('-'))
        .collect();
    let (plain, dressed, aged) = (10_000, 10_000, 5_000);
    let rows = [
        (
            "plain, gables",
            texts::plain(plain, "KIR"),
            plain,
            Detail::Body,
        ),
        (
            "plain, hips",
            texts::plain(plain, "YOS"),
            plain,
            Detail::Body,
        ),
        ("facades", texts::facades(dressed, 0), dressed, Detail::Body),
        ("facades", texts::facades(dressed, 0), dressed, Detail::Flat),
        (
            "facades",
            texts::facades(dressed / 2, 0),
            dressed / 2,
            Detail::Openings,
        ),
        ("a fifth aged", texts::facades(aged, 5), aged, Detail::Flat),
        (
            "a fifth aged",
            texts::facades(aged, 5),
            aged,
            Detail::Openings,
        ),
    ];
    let rows = rows.map(|(name, text, houses, detail)| Row {
        name,
        text: text.into_bytes().into(),
        houses,
        detail,
    });
    let drill = (0..5).map(|_| drill()).min().unwrap_or_default();
    println!(
        "drill: {:.0} ms of processor time\n",
        drill.as_secs_f64() * 1e3
    );
    println!(
        "| town | detail | houses a second | houses a drill | two threads | a second by the clock | triangles | bytes | peak MiB |"
    );
    println!("|---|---|---|---|---|---|---|---|---|");
    for row in rows
        .iter()
        .filter(|r| wanted.is_empty() || wanted.iter().any(|w| r.name.contains(&**w)))
    {
        row.print(drill);
    }
}

impl Row {
    fn print(&self, drill: Duration) {
        reset_peak();
        let one = self.run(1);
        let peak = peak();
        let two = self.run(2);
        let each = |total: f64| total / self.houses as f64;
        let a_second = 1.0 / each(one.processor.as_secs_f64());
        println!(
            "| {} | {} | {:.0} | {:.0} | {:.2} times | {:.0} | {:.0} | {:.0} | {} |",
            self.name,
            self.detail as u8,
            a_second,
            a_second * drill.as_secs_f64(),
            one.clock.as_secs_f64() / two.clock.as_secs_f64(),
            1.0 / each(two.clock.as_secs_f64()),
            each(one.stats.triangles as f64),
            each(one.bytes as f64),
            peak.map_or("?".into(), |mib| mib.to_string()),
        );
    }

    /// Returns several runs on a number of threads as one, with the least of each time.
    fn run(&self, threads: usize) -> Taken {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        let pool = pool.expect("threads start");
        let runs = (0..RUNS).map(|_| pool.install(|| self.build()));
        let least = |a: Taken, b: Taken| Taken {
            processor: a.processor.min(b.processor),
            clock: a.clock.min(b.clock),
            ..a
        };
        runs.reduce(least).expect("there are runs")
    }

    /// Builds the town as `hsd build` does, into a file that is gone afterwards.
    fn build(&self) -> Taken {
        let text = Cursor::new(Arc::clone(&self.text));
        let (processor, clock) = (ProcessTime::now(), Instant::now());
        let long = long(text);
        let source = long.stub().expect("memory can be read");
        let long = [Arc::new(long)];
        let options = Options {
            detail: self.detail,
            ..Options::default()
        };
        let spool = || -> io::Result<Box<dyn Spool>> {
            Ok(Box::new(tempfile::spooled_tempfile(256 << 10)))
        };
        let mut out = Diagnostics::new();
        let mut writer = Writer::new(&spool).expect("there is room");
        let town = driver::stream(
            driver::Feed {
                sources: &[&source],
                long: &long,
            },
            &NoFiles,
            &options,
            &mut out,
            (&mut |part, images| writer.add(part, images), &spool),
        );
        let town = town.expect("there is room");
        assert!(!out.has_errors(), "the text is wrong");
        let glb = writer
            .glb(&town.materials, &town.library, &town.grown)
            .expect("there is room");
        let mut file = tempfile::tempfile().expect("there is room");
        let bytes = glb.write(&mut file).expect("there is room");
        Taken {
            processor: processor.elapsed(),
            clock: clock.elapsed(),
            bytes,
            stats: town.stats,
        }
    }
}

/// Divides a text, as `hsd build` does a file of this size.
fn long(mut text: Cursor<Arc<[u8]>>) -> LongFile {
    let size = text.get_ref().len() as u64;
    let layout = divide::divide(&mut text, size).expect("memory can be read");
    let layout = layout.expect("houses stand side by side");
    LongFile::new(FileId(0), "town.hsd", (Box::new(text), size), layout)
}

/// Work that any machine can be asked for: a million numbers sorted and summed, ten times.
fn drill() -> Duration {
    let start = ProcessTime::now();
    for round in 0..10_u64 {
        let mut state = round;
        let mut list: Vec<u64> = (0..1_000_000)
            .map(|_| {
                state = state
                    .wrapping_mul(6_364_136_223_846_793_005)
                    .wrapping_add(1_442_695_040_888_963_407);
                state >> 20
            })
            .collect();
        list.sort_unstable();
        black_box(
            list.iter()
                .fold(0, |sum: u64, n| sum.wrapping_mul(31).wrapping_add(*n)),
        );
    }
    start.elapsed()
}

/// Forgets the largest size of this process, where the system can.
fn reset_peak() {
    let _ = std::fs::write("/proc/self/clear_refs", "5");
}

/// Returns the largest size of this process since then, MiB.
fn peak() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status
        .lines()
        .find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kib: u64 = line.trim().strip_suffix(" kB")?.trim().parse().ok()?;
    Some(kib / 1024)
}
