//! What `hsd build` says of a model: its size, and with `--stats` what it consists of and what it took.

use crate::files::input::STDIN;
use crate::files::terminal::{HOUSE, bytes, counted};
use hsd_base::diagnostic::{Text, noun};
use hsd_base::text;
use hsd_scene::Stats;
use std::path::Path;
use std::time::Duration;

/// Returns the summary of a model: `wrote shop.glb: 1 house, 5230 triangles, 1.2 MB in 12 ms`.
pub(super) fn summary(
    output: &Path,
    (houses, triangles): (usize, usize),
    size: u64,
    took: Duration,
) -> Text {
    let place = match output.as_os_str() == STDIN {
        true => text!("the model", "モデル"),
        false => output.display().to_string().into(),
    };
    let houses = counted(houses, HOUSE);
    let triangles = counted(triangles, noun("triangle", "三角形{}枚"));
    let (size, took) = (bytes(size as usize), took.as_millis());
    text!([place, houses, triangles, size, took]
        "wrote {place}: {houses}, {triangles}, {size} in {took} ms",
        "{place} を書きました: {houses}、{triangles}、{size}、{took} ms"
    )
}

/// Returns the counts of a model, its bytes by kind, the durations of the stages and the memory of the process.
pub(super) fn statistics(
    (stats, materials): (Stats, usize),
    sizes: &[(&'static str, u64)],
    times: &[(&'static str, Duration)],
) -> Text {
    let nodes = counted(stats.nodes, noun("node", "ノード{}個"));
    let meshes = counted(stats.meshes, noun("mesh", "メッシュ{}個"));
    let materials = counted(materials, noun("material", "材質{}種"));
    let size = |(name, size): &(&str, u64)| format!("  {name:<20} {:9.3} MB", megabytes(*size));
    let time = |(name, took): &(&str, Duration)| {
        format!("  {name:<20} {:9.3} ms", took.as_secs_f64() * 1e3)
    };
    let peak = peak_memory().map(|peak| size(&("peak memory", peak)));
    let lines = sizes.iter().map(size).chain(times.iter().map(time));
    let lines: Vec<String> = lines.chain(peak).collect();
    let lines = lines.join("\n");
    text!([nodes, meshes, materials, lines]
        "  {nodes}, {meshes}, {materials}\n{lines}",
        "  {nodes}、{meshes}、{materials}\n{lines}"
    )
}

fn megabytes(bytes: u64) -> f64 {
    bytes as f64 / 1e6
}

/// Returns the most memory that this process has had, in bytes; `None` where the system does not tell it in a file.
fn peak_memory() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status
        .lines()
        .find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kibibytes: u64 = line.trim().strip_suffix(" kB")?.trim().parse().ok()?;
    Some(kibibytes << 10)
}
