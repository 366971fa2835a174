//! Openings with what hangs or stands in them, and modern parts, against the sheet of parts: heights and projections to
//! the millimetre, counts, sound shapes.

use crate::support::shapes::{
    Body, STOREY, bars, bodies, bounds, flaws, flaws_of_classes, part_mesh, rails, scaled_mesh,
    triangles, written,
};

const SHAKU: f64 = 10_000.0 / 33.0;

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() < 0.6
}

/// The bodies of a part in one surface, by the name of its material.
fn of(code: &str, material: &str, height: f64) -> Vec<Body> {
    let run = crate::support::compile(
        "part.hsd",
        format!("0 0 180\n{height}\n\n{code:5}\n").as_bytes(),
    );
    let node = run
        .scene
        .nodes
        .iter()
        .find(|n| n.kind == hsd::scene::Kind::Part);
    let mesh = node.and_then(|n| n.mesh).expect("a part");
    let mut mesh = run.scene.meshes[mesh.0 as usize].clone();
    mesh.primitives.retain(|p| {
        run.scene.materials[p.material.0 as usize]
            .name
            .starts_with(material)
    });
    bodies(&mesh)
}

#[test]
fn curtains_hang_in_an_odd_number_of_cloths() {
    for (code, cloth, drop, lintel) in [
        ("ANO", "indigo", 1130.0, 6.0),
        ("ANL", "persimmon", 1600.0, 6.0),
        ("ANM", "indigo", 400.0, 6.0),
    ] {
        let data = &written(code, "cloth")[0];
        assert_eq!(data["count"], "3", "{code}");
        assert_eq!(data["drop"].parse(), Ok(drop), "{code}");
        let pieces = of(code, cloth, STOREY);
        let foot = pieces.iter().map(|b| b.lo.z).fold(f64::INFINITY, f64::min);
        assert!(near(foot, lintel * SHAKU - drop), "{code}: {foot}");
        // Three loops a cloth, each a body of its own.
        let loops = pieces.iter().filter(|b| near(b.size().x, 30.0));
        assert_eq!(loops.count(), 9, "{code}");
        assert_eq!(of(code, "bamboo", STOREY).len(), 1, "{code}: the pole");
    }
    // Cloth hangs 60 mm behind the lintel's face; folds swing about that plane.
    let cloth = of("ANO", "indigo", STOREY);
    let (lo, hi) = cloth
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), b| {
            (lo.min(b.lo.y), hi.max(b.hi.y))
        });
    assert!(
        ((lo + hi) / 2.0 - 2.5).abs() < 4.0 && hi - lo > 20.0,
        "{lo} {hi}"
    );
}

/// Neighbouring cloths are apart at the foot and together at the seam.
#[test]
fn curtains_are_slit() {
    let mesh = part_mesh("ANO", STOREY);
    let foot = 6.0 * SHAKU - 1130.0;
    let mut ends: Vec<f64> = triangles(&mesh)
        .iter()
        .flatten()
        .filter(|p| near(p.z, foot))
        .map(|p| p.x)
        .collect();
    ends.sort_by(f64::total_cmp);
    ends.dedup_by(|a, b| (*a - *b).abs() < 0.01);
    let gaps: Vec<f64> = ends.windows(2).map(|w| w[1] - w[0]).collect();
    assert_eq!(
        gaps.iter().filter(|g| near(**g, 28.0)).count(),
        2,
        "{gaps:?}"
    );
}

#[test]
fn the_bench_is_folded_down() {
    let mesh = part_mesh("ASH", STOREY);
    let seat: Vec<Body> = bodies(&mesh)
        .into_iter()
        .filter(|b| near(b.size().z, 26.0) && b.front() > 200.0)
        .collect();
    assert_eq!(seat.len(), 3, "boards of the seat");
    let top = seat.iter().map(|b| b.hi.z).fold(0.0, f64::max);
    let front = seat.iter().map(Body::front).fold(0.0, f64::max);
    assert!(near(top, 1.3 * SHAKU), "{top}");
    assert!(near(front, 60.0 + 1.5 * SHAKU), "{front}");
    assert_eq!(bars(&mesh, 54.0).len(), 21, "the lattice behind is GSI's");
    assert_eq!(bars(&mesh, 480.0).len(), 2, "legs");
}

#[test]
fn the_apron_is_an_arc() {
    let laths: Vec<Body> = of("AIN", "bamboo_old", STOREY);
    assert_eq!(laths.len(), 25);
    let lath = laths[0];
    assert!(
        near(lath.front(), 72.0 + 455.0) && near(lath.hi.z, 620.0),
        "{lath:?}"
    );
    assert!(near(lath.lo.z, -285.0), "it stands on the ground");
    assert!((2.0 * SHAKU..3.0 * SHAKU).contains(&lath.hi.z));
    assert_eq!(
        of("AIN", "bamboo", STOREY).len(),
        25 + 3,
        "laths and level laths"
    );
    // Points of the outer face lie on a quarter of an ellipse.
    let mesh = part_mesh("AIN", STOREY);
    let high = |p: &&glam::DVec3| p.y < -100.0 && p.x < 30.0 && p.z > -280.0;
    for p in triangles(&mesh).iter().flatten().filter(high) {
        let share = ((-p.y - 72.0) / 455.0).powi(2) + ((p.z + 285.0) / 905.0).powi(2);
        assert!((0.94..1.06).contains(&share), "{p}");
    }
}

#[test]
fn the_low_rail_and_the_passage() {
    let mesh = part_mesh("AKO", STOREY);
    let post = bars(&mesh, 515.0);
    assert_eq!(post.len(), 1);
    assert!(near(post[0].hi.z, 2.0 * SHAKU) && near(post[0].front(), 60.0 + 1.5 * SHAKU));
    assert_eq!(rails(&mesh, 500.0).len(), 1);
    let passage = bounds(&triangles(&part_mesh("ATN", STOREY)));
    assert!(passage.hi.y > 3000.0, "{}", passage.hi.y);
    for (code, lintel) in [("AKI", 150.0), ("AKI 2", 210.0)] {
        let beam = rails(&part_mesh(code, STOREY), 59.0);
        assert!(
            beam.iter()
                .any(|b| near(b.size().z, lintel + 1.0) && near(b.hi.z, 6.0 * SHAKU + lintel)),
            "{code}: {beam:?}"
        );
    }
}

#[test]
fn aluminium_windows() {
    let mesh = part_mesh("NAS 2", 10.5);
    // The frame: 70 deep, 40 behind the wall's face, which is 75 out.
    let frame = bodies(&mesh)
        .into_iter()
        .find(|b| near(b.front(), 35.0) && near(b.size().y, 70.0));
    let frame = frame.expect("a frame");
    assert!(
        near(frame.lo.z, 900.0) && near(frame.hi.z, 2000.0),
        "{frame:?}"
    );
    // Two leaves on two tracks: their fronts lie a leaf and a gap apart.
    let leaves = of("NAS 2", "glass", 10.5);
    assert_eq!(leaves.len(), 2);
    assert!(
        near((leaves[0].lo.y - leaves[1].lo.y).abs(), 26.0 + 3.0),
        "{leaves:?}"
    );
    assert!(leaves[0].lo.y < leaves[1].lo.y, "the left one in front");
}

#[test]
fn shutters_curtain_walls_and_balconies() {
    let slats = of("NSH 2", "painted_steel", 10.5);
    let box_of = slats.iter().filter(|b| near(b.size().z, 350.0));
    assert_eq!(box_of.count(), 1, "the box is 350 high");
    let curtain = part_mesh("NGC", 11.55);
    let frame = bodies(&curtain).into_iter().find(|b| near(b.front(), 75.0));
    assert!(near(frame.expect("mullions").size().y, 150.0), "150 deep");
    let panes = of("NGC", "glass_dark", 11.55);
    assert_eq!(panes.len(), 2, "spandrel and window");
    for pane in panes {
        assert!(near(pane.front(), 75.0 - 20.0), "glass 20 behind");
        // Half a mullion of 50 at each side.
        assert!(near(pane.lo.x, 25.0), "{pane:?}");
    }
    let balcony = bounds(&triangles(&part_mesh("NBA 2", 10.5)));
    assert!(near(balcony.front(), 75.0 + 1200.0), "{}", balcony.front());
    let rail = of("NBA 2", "iron", 10.5);
    let top = rail.iter().map(|b| b.hi.z).fold(0.0, f64::max);
    assert!(near(top, 150.0 + 1100.0), "{top}");
    assert_eq!(
        bars(&part_mesh("NBA 2", 10.5), 1252.0).len(),
        19,
        "balusters"
    );
    let sign = bounds(&triangles(&part_mesh("NKB", 9.0)));
    assert!(sign.front() > 375.0);
    let frame = bodies(&part_mesh("NKB", 9.0))
        .into_iter()
        .find(|b| near(b.front(), 375.0));
    assert!(near(
        frame.expect("a frame 300 before the face").size().z,
        1308.0
    ));
}

#[test]
fn every_fitting_and_modern_part_is_sound() {
    crate::support::assert_none(&flaws_of_classes("AN", 2000));
}

/// A dressed street house at full detail: under 60,000 triangles seen, under 550 KB of meshes, of which verges
/// tile by tile, the joints of eaves tiles and their discs take a fourth.
#[test]
fn houses_stay_light() {
    for name in ["machiya", "omotedana", "kanban", "buke-nagaya"] {
        let path = crate::support::root().join(format!("examples/{name}.hsd"));
        let scene = crate::support::compile_file(&path).scene;
        let parts = scene.meshes.iter().flat_map(|m| &m.primitives);
        // Positions, normals and texture coordinates are 32 bytes a vertex, indices 2.
        let bytes: usize = parts
            .map(|p| 32 * p.positions.len() + 2 * p.indices.len())
            .sum();
        let seen = scene.stats().triangles;
        assert!(
            seen < 60_000 && bytes < 550_000,
            "{name}: {seen} triangles, {bytes} bytes"
        );
    }
}

/// Facades of a given size draw parts out or press them together.
#[test]
fn parts_of_any_width_are_sound() {
    let mut found = vec![];
    let parts = hsd::parse::builtin().parts().iter();
    for part in parts.filter(|p| "AN".contains(p.class()) && p.width() > 0.0) {
        for share in [0.5, 0.75, 1.6, 2.6] {
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

/// A mortar front rises 3 to 4 shaku above the eaves, along all its modern units, on the highest storey alone.
#[test]
fn mortar_fronts_have_a_parapet() {
    let text = "0 0 180\n9 9\n\nNMO  NAS 2NMO  KSK  \nKSK  \nKSK  KSK  KSK  KSK  KSK  \nKSK  ^\n\
                NMO  NAS 2NMO  KSK  \nKSK  \nKSK  KSK  KSK  KSK  KSK  \nKSK  \n";
    let scene = crate::support::compile("front.hsd", text.as_bytes()).scene;
    let heads: Vec<_> = scene.nodes.iter().filter(|n| n.name == "parapet").collect();
    assert_eq!(heads.len(), 1);
    assert_eq!(heads[0].storey, Some(2));
    assert!((heads[0].at.z * 1000.0 - 9.0 * SHAKU).abs() < 0.1);
    let mesh = &scene.meshes[heads[0].mesh.expect("a mesh").0 as usize];
    let whole = bounds(&triangles(mesh));
    assert!(
        (3.0 * SHAKU..4.0 * SHAKU).contains(&whole.hi.z),
        "{whole:?}"
    );
    // Four units, the corner post at one end, the cap over both.
    assert!(
        near(whole.size().x, 12.0 * SHAKU + 68.0 + 40.0),
        "{whole:?}"
    );
    assert_eq!(flaws(mesh), Vec::<String>::new());
}
