//! Each part by itself.

use super::*;

#[test]
fn every_part_is_sound_and_in_its_bay() {
    for height in [9.0, 5.0, 7.0, 11.55, 2.0] {
        let height = height * SHAKU;
        for part in hsd::parse::builtin()
            .parts()
            .iter()
            .filter(|p| !" O".contains(p.class()))
        {
            let mesh = mesh_of(part.code(), height);
            let (lo, hi) = bounds(&triangles(&mesh));
            let code = part.code();
            assert!(!mesh.primitives.is_empty(), "{code} at {height}");
            let side = if part.width() > 0.0 { 1e-4 } else { 0.3 };
            assert!(lo.x > -side as f32, "{code}: x from {}", lo.x);
            assert!(
                f64::from(hi.x) < part.width() * UNIT + side,
                "{code}: x to {}",
                hi.x
            );
            // What stands before the wall reaches down to the foot of the foundation.
            let low = code.starts_with('A') || code == "KUD 0";
            let foot = if low { 0.285 } else { 0.0 };
            assert!(lo.z > -foot - 1e-4, "{code}: z from {}", lo.z);
            assert!(
                f64::from(hi.z) < height + 1e-4,
                "{code}: z to {} of {height}",
                hi.z
            );
        }
    }
}

#[test]
fn parts_are_unlike() {
    let parts = hsd::parse::builtin().parts().iter();
    let mut seen: Vec<(String, Mesh)> = Vec::new();
    for part in parts.filter(|p| p.class() != ' ') {
        let mesh = mesh_of(part.code(), 9.0 * SHAKU);
        for (other, shape) in &seen {
            // Party walls are built like plaster walls.
            let like = part.code() == "APW  " && other == "KSK  ";
            let painted = [
                "KSKO ", "KSKK ", "KTU  ", "KJU  ", "ASH  ", "TIKS ", "MRGS ",
            ];
            if !like && !painted.contains(&part.code()) && !painted.contains(&other.as_str()) {
                assert_ne!(
                    triangles(shape),
                    triangles(&mesh),
                    "{} = {other}",
                    part.code()
                );
            }
        }
        seen.push((part.code().to_owned(), mesh));
    }
}

/// Bodies whose outermost plane lies so many millimetres outside the centre line.
fn bodies_at(mesh: &Mesh, front: f64) -> Vec<(Vec3, Vec3)> {
    let all = bodies(mesh).into_iter().map(|b| bounds(&b));
    all.filter(|(lo, _)| (f64::from(lo.y) + front / 1000.0).abs() < 1e-4)
        .collect()
}

#[test]
fn bars_are_counted() {
    for (code, front, count) in [
        ("GSB", 54.0, 27),
        ("GIT", 54.0, 20),
        ("GOR", 54.0, 20),
        ("GGO", 54.0, 18),
        ("GKO", 56.0, 6),
        ("GSA", 56.0, 6),
        ("GSU", 50.0, 9),
        ("GFU", 54.0, 10),
        ("GSI", 54.0, 21),
        ("GOY", 54.0, 18),
        ("GDE", 414.0, 21),
        ("GKK h", 54.0, 10),
        ("MRE", 52.0, 13),
        ("MMU", 92.0, 6),
        ("MMU 2", 92.0, 12),
        ("MMS 2", 380.0, 13),
        ("AIN", 527.0, 25),
    ] {
        let found = bodies_at(&mesh_of(code, 9.0 * SHAKU), front).len();
        assert_eq!(found, count, "{code}");
    }
}

#[test]
fn children_are_cut() {
    let mesh = mesh_of("GIT", 9.0 * SHAKU);
    let bars = bodies_at(&mesh, 54.0);
    let top = bars.iter().map(|(_, hi)| hi.z).fold(0.0, f32::max);
    let long = bars
        .iter()
        .filter(|(_, hi)| (hi.z - top).abs() < 1e-4)
        .count();
    assert_eq!((long, bars.len() - long), (5, 15));
    let width = |i: usize| f64::from(bars[i].1.x - bars[i].0.x);
    let widths: Vec<f64> = (0..bars.len()).map(width).collect();
    assert_eq!(
        widths.iter().filter(|w| (**w - 0.030).abs() < 1e-4).count(),
        5
    );
    assert_eq!(
        widths.iter().filter(|w| (**w - 0.018).abs() < 1e-4).count(),
        15
    );
}

#[test]
fn narrow_bays_keep_the_ratio_of_bar_to_gap() {
    let bars = bodies_at(&mesh_of("GSI", 9.0 * SHAKU), 54.0);
    let mut ends: Vec<(f32, f32)> = bars.iter().map(|(lo, hi)| (lo.x, hi.x)).collect();
    ends.sort_by(|a, b| a.0.total_cmp(&b.0));
    let bar = ends[0].1 - ends[0].0;
    let gap = ends[1].0 - ends[0].1;
    assert!((gap / bar - 23.0 / 20.0).abs() < 1e-3, "{bar} {gap}");
}
