//! Windows and lattices against the sheet of parts: counted bars, rails and panes, in the catalogue and in the mesh;
//! heights and projections to the millimetre; sound shapes.

use crate::support::shapes::{
    Body, STOREY, bars, bodies, bounds, flaws, flaws_of_classes, part_mesh, rails, scaled_mesh,
    sheet_row, triangles, written,
};

/// A part, what the sheet says of it, and its bars: how many in the catalogue and in the mesh, the plane of their fronts,
/// the sheet's width and clear distance (0 = not said).
const BARS: &[(&str, &str, usize, usize, f64, f64, f64)] = &[
    ("MRE  ", "13-15 bars (odd)", 13, 13, 52.0, 36.0, 0.0),
    ("MMU  ", "6-7 bars 75 mm wide", 6, 6, 92.0, 75.0, 65.0),
    ("MMU 2", "12-14 bars", 12, 12, 92.0, 75.0, 65.0),
    ("MHI  ", "handrail 600 mm high", 5, 5, 147.0, 18.0, 0.0),
    ("MMS 2", "bars 2 sun at 4 sun", 13, 13, 380.0, 61.0, 60.0),
    ("MKU  ", "iron grille", 5, 5, 20.0, 18.0, 0.0),
    ("MMM  ", "boards and gaps 2.5 sun", 5, 5, 48.0, 76.0, 76.0),
    ("MSH  ", "bars 12 mm at 60", 9, 9, 18.0, 12.0, 0.0),
    ("GSB  ", "27 bars 17 mm, gap 17", 27, 27, 54.0, 17.0, 17.0),
    (
        "GIT  ",
        "1 parent 30 mm + 3 children 18 mm",
        5,
        20,
        54.0,
        30.0,
        0.0,
    ),
    (
        "GOR  ",
        "as GIT with 4 children; 4 groups",
        4,
        20,
        54.0,
        30.0,
        0.0,
    ),
    (
        "GGO  ",
        "as GIT with 2 children; 6 groups",
        6,
        18,
        54.0,
        30.0,
        0.0,
    ),
    ("GKO  ", "6 bars 73x42 mm, clear 73", 6, 6, 56.0, 73.0, 73.0),
    ("GSA  ", "6 bars 73x42 mm, clear 73", 6, 6, 56.0, 73.0, 73.0),
    (
        "GSU  ",
        "9 boards 90 mm, slits 12 mm",
        9,
        9,
        50.0,
        90.0,
        12.0,
    ),
    ("GFU  ", "10 bars 45 mm", 10, 10, 54.0, 45.0, 0.0),
    ("GSI  ", "21 bars 20 mm, gap 23", 21, 21, 54.0, 20.0, 23.0),
    ("GOY  ", "9 bars 30 + 9 bars 15", 9, 18, 54.0, 30.0, 0.0),
    ("GDE  ", "bars as GSI", 21, 21, 414.0, 20.0, 23.0),
    ("GDE 2", "as GDE", 41, 41, 414.0, 20.0, 23.0),
    ("GKK h", "10 bars", 10, 10, 54.0, 17.0, 0.0),
];

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() < 0.5
}

#[test]
#[cfg_attr(not(shared_data), ignore = "reads ../shared/data, which is not here")]
fn shared_data_sheet_has_the_bars() {
    for &(code, phrase, ..) in BARS {
        let row = sheet_row(code);
        assert!(row.contains(phrase), "{row}");
    }
}

#[test]
fn bars_are_those_of_the_sheet() {
    for &(code, _, written_count, count, front, size, gap) in BARS {
        let data = &written(code, "bars")[0];
        assert_eq!(data["count"].parse(), Ok(written_count), "{code}");
        assert_eq!(data["size"].parse(), Ok(size), "{code}");
        if gap > 0.0 {
            assert_eq!(data["gap"].parse(), Ok(gap), "{code}");
        }
        let mesh = part_mesh(code, STOREY);
        let found = bars(&mesh, front);
        assert_eq!(found.len(), count, "{code}");
        let widths: Vec<f64> = found.iter().map(|b| b.size().x).collect();
        let widest = widths.iter().copied().fold(0.0, f64::max);
        let gaps: Vec<f64> = found.windows(2).map(|w| w[1].lo.x - w[0].hi.x).collect();
        assert!(
            gaps.iter().all(|g| (g - gaps[0]).abs() < 0.2),
            "{code}: uneven gaps {gaps:?}"
        );
        assert!(widest <= size + 0.1, "{code}: {widest}");
        if gap > 0.0 && widest < size - 0.1 {
            assert!(
                (gaps[0] / widest - gap / size).abs() < 0.01,
                "{code}: {} to {widest}",
                gaps[0]
            );
        } else {
            assert!(near(widest, size), "{code}: {widest}");
        }
    }
}

#[test]
fn square_bars_are_square() {
    for (code, front) in [
        ("GSB", 54.0),
        ("GSI", 54.0),
        ("GOY", 54.0),
        ("GIT", 54.0),
        ("GDE", 414.0),
        ("MRE", 52.0),
        ("MMS 2", 380.0),
    ] {
        for bar in bars(&part_mesh(code, STOREY), front) {
            assert!(
                (bar.size().x - bar.size().y).abs() < 0.1,
                "{code}: {:?}",
                bar.size()
            );
        }
    }
}

/// Long bars stand over the whole height; short ones end at two thirds, just above a rail, and light falls in above.
#[test]
fn children_are_cut() {
    for (code, long, short) in [("GIT", 5, 15), ("GOR", 4, 16), ("GGO", 6, 12)] {
        let mesh = part_mesh(code, STOREY);
        let all = bars(&mesh, 54.0);
        let height = all.iter().map(|b| b.size().z).fold(0.0, f64::max);
        let (parents, children): (Vec<Body>, Vec<Body>) =
            all.into_iter().partition(|b| near(b.size().z, height));
        assert_eq!((parents.len(), children.len()), (long, short), "{code}");
        assert!(parents.iter().all(|b| near(b.size().x, 30.0)), "{code}");
        assert!(children.iter().all(|b| near(b.size().x, 18.0)), "{code}");
        let top = children[0].hi.z;
        assert!(
            children
                .iter()
                .all(|b| near(b.size().z, height * 2.0 / 3.0)),
            "{code}"
        );
        let rails = rails(&mesh, 50.0);
        assert_eq!(rails.len(), 4, "{code}");
        let highest_below = rails
            .iter()
            .map(|r| r.hi.z)
            .filter(|z| *z < top)
            .fold(0.0, f64::max);
        assert!(
            (10.0..80.0).contains(&(top - highest_below)),
            "{code}: {}",
            top - highest_below
        );
    }
}

/// Rails run through the bars: their planes lie within the bars' depth, so that they show in the gaps.
#[test]
fn rails_pierce_the_bars() {
    for (code, bar, rail, count, height) in [
        ("GSB", 54.0, 51.0, 4, 20.0),
        ("GSI", 54.0, 50.0, 3, 20.0),
        ("GOY", 54.0, 50.0, 3, 20.0),
        ("GKO", 56.0, 42.0, 3, 82.0),
        ("GSA", 56.0, 42.0, 3, 82.0),
        ("GFU", 54.0, 36.0, 3, 30.0),
        ("GDE", 414.0, 410.0, 3, 20.0),
        ("GDE 2", 414.0, 410.0, 3, 20.0),
        ("GKK h", 54.0, 51.0, 3, 20.0),
        ("MRE", 52.0, 42.0, 1, 24.0),
    ] {
        let mesh = part_mesh(code, STOREY);
        let found = rails(&mesh, rail);
        assert_eq!(found.len(), count, "{code}");
        let back = bars(&mesh, bar)
            .iter()
            .map(|b| b.hi.y)
            .fold(f64::INFINITY, f64::min);
        for r in found {
            assert!(near(r.size().z, height), "{code}: {:?}", r.size());
            assert!(r.hi.y < back, "{code}: a rail behind the bars");
        }
    }
    // The rice dealer's lower two lie close together.
    let rice = rails(&part_mesh("GKO", STOREY), 42.0);
    let mut feet: Vec<f64> = rice.iter().map(|r| r.lo.z).collect();
    feet.sort_by(f64::total_cmp);
    assert!(near(feet[1] - feet[0], 140.0), "{feet:?}");
}

/// Foot and top of openings, shaku.
#[test]
fn openings_are_as_high_as_the_sheet_says() {
    for (code, from, to) in [
        ("MRE", 3.0, 5.5),
        ("MMU", 1.0, 3.0),
        ("MMU 2", 1.0, 3.0),
        ("MHI", 1.2, 5.7),
        ("MGA", 1.2, 5.7),
        ("MMM", 3.5, 5.0),
        ("MTK", 6.5, 8.0),
        ("GSB", 0.8, 5.8),
        ("GIT", 0.8, 5.8),
        ("GSI", 0.8, 5.8),
        ("GSU", 0.8, 5.8),
        ("GFU", 0.8, 5.8),
        ("GOY", 0.8, 5.8),
        ("GKK h", 0.8, 5.8),
        ("GSA", 0.0, 5.8),
    ] {
        let frame = &written(code, "frame")[0];
        let front: f64 = frame["front"].parse().expect("a number");
        let members = bodies(&part_mesh(code, STOREY));
        let members: Vec<&Body> = members.iter().filter(|b| near(b.front(), front)).collect();
        let foot = members.iter().map(|b| b.lo.z).fold(f64::INFINITY, f64::min);
        let top = members.iter().map(|b| b.hi.z).fold(0.0, f64::max);
        let shaku = 10_000.0 / 33.0;
        assert!(
            near(foot, from * shaku) && near(top, to * shaku),
            "{code}: {foot} to {top}"
        );
    }
}

#[test]
fn projections() {
    // Boxes stand 300 to 450 mm before the face of the posts, 60 mm from the centre line.
    let proud = |code: &str, front: f64| bars(&part_mesh(code, STOREY), front);
    assert_eq!(
        proud("GDE", 419.0).len(),
        2,
        "corner posts of the projecting lattice"
    );
    assert_eq!(proud("GDE 2", 419.0).len(), 2);
    assert_eq!(
        proud("MMS 2", 389.0).len() + 11,
        13,
        "corner posts of the barred oriel, 300 mm proud"
    );
    // The handrail: 600 mm high, 100 mm before the posts.
    let shaku = 10_000.0 / 33.0;
    let rail = rails(&part_mesh("MHI", STOREY), 160.0);
    assert_eq!(rail.len(), 1);
    assert!(near(rail[0].hi.z, 1.2 * shaku + 600.0), "{}", rail[0].hi.z);
    // The plastered frame: 60 mm before the wall, whose face is 45 mm out.
    for code in ["MMU", "MMU 2"] {
        let whole = bounds(&triangles(&part_mesh(code, STOREY)));
        assert!(near(whole.front(), 105.0), "{code}: {}", whole.front());
    }
    // The leaf of a storehouse window stands at right angles to the wall.
    let leaf = bodies(&part_mesh("MKU", STOREY));
    let leaf: Vec<&Body> = leaf.iter().filter(|b| near(b.front(), 500.0)).collect();
    assert!(leaf.iter().all(|b| b.size().y > 6.0 * b.size().x) && !leaf.is_empty());
}

/// Side bars of the projecting lattices: seven each, square, on both sides.
#[test]
fn sides_of_projecting_lattices() {
    for code in ["GDE", "GDE 2"] {
        let mesh = part_mesh(code, STOREY);
        let whole = bodies(&mesh);
        let side = |b: &&Body| {
            near(b.size().x, 20.0)
                && near(b.size().y, 20.0)
                && b.front() < 380.0
                && b.size().z > 1000.0
        };
        assert_eq!(whole.iter().filter(side).count(), 14, "{code}");
    }
}

#[test]
fn panes_are_counted() {
    // Two sashes of 2 x 3 panes; one of 5; and handrail windows of 3 each.
    for (code, leaves, cols, rows) in [("MGA", 2, 2, 3), ("MTK", 1, 5, 1), ("MHI", 2, 1, 3)] {
        let data = &written(code, "leaf")[0];
        let count = |name: &str| data.get(name).map_or(1, |n| n.parse().expect("a count"));
        assert_eq!(
            [count("leaves"), count("cols"), count("rows")],
            [leaves, cols, rows],
            "{code}"
        );
        let front: f64 = data["front"].parse().expect("a number");
        let mesh = part_mesh(code, STOREY);
        // Upright muntins lie 2 mm behind their leaf, and the second leaf behind the first.
        let muntins = bodies(&mesh)
            .into_iter()
            .filter(|b| near(b.size().x, 12.0) && b.front() < front);
        assert_eq!(muntins.count(), leaves * (cols - 1), "{code}");
    }
}

/// The opening of the bare lathing is round: nothing of the wall lies within a shaku of its middle, all corners are full.
#[test]
fn the_bare_lathing_shows_in_a_circle() {
    let mesh = part_mesh("MSH", STOREY);
    let corners: Vec<_> = triangles(&mesh)
        .into_iter()
        .filter(|t| t.iter().all(|p| (p.y + 45.0).abs() < 0.1))
        .collect();
    let middle = glam::DVec3::new(909.09 / 2.0, -45.0, 4.0 * 10_000.0 / 33.0);
    let radius = corners
        .iter()
        .flatten()
        .map(|p| p.distance(middle))
        .fold(f64::INFINITY, f64::min);
    assert!((radius - 303.0).abs() < 1.0, "{radius}");
    let round = corners
        .iter()
        .flatten()
        .filter(|p| (p.distance(middle) - 303.0).abs() < 1.0)
        .count();
    assert!(round > 40, "{round}");
    assert_eq!(bars(&mesh, 18.0).len(), 9);
    assert_eq!(rails(&mesh, 5.0).len(), 9);
}

/// The slits of the wide plastered window end in half circles, 26 of them: one body each, of two halves that meet.
#[test]
fn slits_end_round() {
    let mesh = part_mesh("MMU 2", STOREY);
    let fillers = bodies(&mesh)
        .into_iter()
        .filter(|b| near(b.front(), 66.0) && b.size().x > 1000.0 && b.size().z < 60.0);
    // One body over all slits and one below them.
    assert_eq!(fillers.count(), 2);
    assert_eq!(written("MMU 2", "bars")[0]["slits"], "yes");
    assert!(!written("MMU", "bars")[0].contains_key("slits"));
}

#[test]
fn every_window_and_lattice_is_sound() {
    crate::support::assert_none(&flaws_of_classes("MG", 1600));
}

/// Facades of a given size draw parts out or press them together.
#[test]
fn parts_of_any_width_are_sound() {
    let mut found = vec![];
    let parts = hsd::parse::builtin().parts().iter();
    for part in parts.filter(|p| "MG".contains(p.class()) && p.width() > 0.0) {
        for share in [0.5, 0.75, 1.6, 2.6] {
            // A storehouse window keeps its two shaku: in a narrower wall its hood meets the neighbours.
            if part.code() == "MKU  " && share < 1.0 {
                continue;
            }
            // Nor has a window of thirteen bars room for them in half its bay.
            if part.code().starts_with("MRG") && share < 0.75 {
                continue;
            }
            let width = share * part.width() * 10.0 / 11.0;
            let flaws = flaws(&scaled_mesh(part.code(), width));
            found.extend(
                flaws
                    .into_iter()
                    .map(|f| format!("{} {width} m: {f}", part.code())),
            );
        }
    }
    crate::support::assert_none(&found);
}
