//! The ground of a town: where houses stand on it, and the mesh of it. The oracle is the formula that the grids are made from.

use crate::tiles::rules::checked;
use crate::tiles::{Memory, build};
use crate::town_types::{hsd, said};
use crate::towns::{in_folder, number};
use hsd::driver::Options;
use hsd::glam::{DVec2, dvec2};
use hsd::scene::Detail;
use hsd::tessellate::GroundMesh;
use hsd::tiles::terrain::{Cell, Patch, cells};
use hsd::town::stream::TownStream;
use hsd::town::{Plan, TownInput, run};
use hsd::{Diagnostics, FileId, FolderWorld, Source};
use std::collections::BTreeMap;
use std::fmt::Write;
use std::fs;
use std::path::Path;

/// A folder with houses along a street that climbs, and a grid of a surface: `west` to `west + 400` and the same to the north.
fn folder(surface: impl Fn(DVec2) -> f64, cell: f64, west: f64) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let n = (400.0 / cell) as usize;
    let mut grid =
        format!("ncols {n}\nnrows {n}\nxllcorner {west}\nyllcorner {west}\ncellsize {cell}\n");
    for row in 0..n {
        for column in 0..n {
            let at = dvec2(column as f64 + 0.5, (n - 1 - row) as f64 + 0.5) * cell + west;
            let _ = write!(grid, "{:.5} ", surface(at));
        }
        grid.push('\n');
    }
    fs::write(folder.path().join("ground.asc"), grid).expect("is written");
    let mut houses = vec![];
    for n in 0..12 {
        for (side, west) in [("w", -15.0), ("e", 3.0)] {
            let (x, y) = (west, f64::from(n) * 9.0 - 55.0);
            let (e, north) = (x + 12.0, y + 7.0);
            houses.push(format!(
                r#"{{"type":"Feature","properties":{{"key":"{side}{n}"}},"geometry":{{"type":"Polygon","coordinates":[[[{x},{y}],[{e},{y}],[{e},{north}],[{x},{north}],[{x},{y}]]]}}}}"#
            ));
        }
    }
    let road = r#"{"type":"Feature","properties":{"width":5},"geometry":{"type":"LineString","coordinates":[[0,-80],[0,80]]}}"#;
    for (name, list) in [
        ("houses.geojson", houses.join(",")),
        ("roads.geojson", road.to_owned()),
    ] {
        let text = format!(r#"{{"type":"FeatureCollection","features":[{list}]}}"#);
        fs::write(folder.path().join(name), text).expect("is written");
    }
    folder
}

fn text(ground: &str, rules: &str) -> String {
    format!(
        "<Town seed=\"1\" origin=\"0 0\">\n{ground}\n<Layer name=\"houses\" src=\"houses.geojson\" crs=\"local\" key=\"key\"/>\n\
         <Layer name=\"roads\" src=\"roads.geojson\" crs=\"local\"/>\n{rules}\n<Tiles size=\"50\"/></Town>"
    )
}

const GROUND: &str =
    "<Layer name=\"ground\" src=\"ground.asc\" crs=\"local\" evidence=\"a formula\"/>";
const ALL: &str = "<for each=\"houses\"><Place type=\"so-nikai\" on=\"plot\"/></for>";

/// Where a house stands: its origin's height, and how far its plinth reaches below it.
type Standing = BTreeMap<String, (f64, f64)>;

/// Reads a town and evaluates it.
fn stand<T>(text: &str, folder: &Path, look: impl FnOnce(&Plan) -> T) -> (Standing, T) {
    let name = folder.join("town.hsd");
    let source = Source::new(FileId(0), name.to_string_lossy(), text.as_bytes());
    let world = FolderWorld::new(vec![], 1 << 20).with_roots(vec![folder.to_owned()]);
    let (options, mut out) = (Options::default(), Diagnostics::new());
    let read = hsd::driver::documents(&[&source], &world, &options, &mut out);
    let town = read
        .documents
        .into_iter()
        .find_map(|d| d.town)
        .expect("is a town");
    let input = TownInput::new(&source, &world, &options);
    let plan = run::plan(input, &town, &mut out)
        .unwrap_or_else(|| panic!("{:?}", out.iter().collect::<Vec<_>>()));
    let standing = TownStream::new(input, &plan).map(|made| {
        let settings = &made.house.settings;
        let of =
            |value: &Option<hsd::source::Spanned<f64>>| value.as_ref().map_or(0.0, |v| v.value);
        (made.name.clone(), (of(&settings.z), of(&settings.plinth)))
    });
    let standing = standing.collect();
    let seen = look(&plan);
    (standing, seen)
}

#[test]
fn houses_stand_a_step_above_the_lowest_point_of_their_street() {
    let surface = |p: DVec2| 30.0 + 0.12 * p.y + 0.2 * p.x;
    let folder = folder(surface, 5.0, -200.0);
    let built = in_folder(&text(GROUND, ALL), folder.path(), |_| {});
    assert_eq!(built.houses, 24, "{:?}", built.found);
    let (standing, ()) = stand(&text(GROUND, ALL), folder.path(), |_| ());
    for row in &built.rows {
        let end = |n: u8| {
            dvec2(
                number(row, &format!("front_x{n}")),
                number(row, &format!("front_y{n}")),
            )
        };
        let (a, b) = (end(1), end(2));
        let (z, plinth) = standing[&format!("houses {}", row["key"])];
        // A plane is lowest at one of the ends.
        let street = surface(a).min(surface(b));
        assert!(
            (z - street - 0.3).abs() < 1e-3,
            "{}: {z} over {street}",
            row["key"]
        );
        let inward = (b - a).normalize().perp() * number(row, "depth");
        for corner in [a, b, b + inward, a + inward] {
            let foot = z - plinth;
            // The mesh is coarser from afar, and its border a line of its own.
            let lowest = surface(corner) - Detail::Body.ground_tolerance() - 0.06;
            assert!(foot <= lowest, "{}: {foot} over {lowest}", row["key"]);
        }
        assert!(plinth < 8.0, "no deeper than it needs: {plinth}");
    }
}

#[test]
fn without_a_ground_houses_stand_as_before() {
    let folder = folder(|_| 0.0, 5.0, -200.0);
    let (standing, ground) = stand(&text("", ALL), folder.path(), |plan| plan.ground.is_empty());
    assert!(ground && standing.values().all(|at| *at == (0.0, 0.0)));
}

#[test]
fn houses_behind_houses_stand_on_their_own_ground() {
    let surface = |p: DVec2| 20.0 + 0.3 * p.x;
    let folder = folder(surface, 5.0, -200.0);
    let lot = r#"{"type":"FeatureCollection","features":[{"type":"Feature","properties":{"key":"lot"},"geometry":{"type":"Polygon","coordinates":[[[3,0],[45,0],[45,9],[3,9],[3,0]]]}}]}"#;
    fs::write(folder.path().join("houses.geojson"), lot).expect("is written");
    let rules =
        "<for each=\"houses\"><Place type=\"chu-nikai\" on=\"plot\" cap=\"9\"/><Rear/></for>";
    let (standing, ()) = stand(&text(GROUND, rules), folder.path(), |_| ());
    let (front, rear): (Vec<_>, Vec<_>) =
        standing.iter().partition(|(name, _)| *name == "houses lot");
    assert!(
        (front[0].1.0 - surface(dvec2(3.0, 0.0)) - 0.3).abs() < 1e-3,
        "{front:?}"
    );
    assert!(!rear.is_empty(), "{standing:?}");
    for (name, (z, plinth)) in rear {
        assert!(
            *z > surface(dvec2(14.0, 0.0)) && *plinth > 1.0,
            "{name} {z} {plinth}"
        );
    }
}

#[test]
fn the_height_at_a_feature_is_a_measure() {
    let folder = folder(|p| 50.0 + p.y, 5.0, -200.0);
    let rules = "<for each=\"houses\" test=\"{z > 50}\"><Place type=\"so-nikai\" on=\"plot\"/></for><for each=\"houses\" test=\"{z &lt;= 50}\"><Skip because=\"low\"/></for>";
    let built = in_folder(&text(GROUND, rules), folder.path(), |_| {});
    for row in &built.rows {
        assert_eq!(row["what"] == "skipped", number(row, "y") <= 0.0, "{row:?}");
    }
}

#[test]
fn features_off_the_ground_are_told() {
    // The grid begins 30 m south of the northern end of the street.
    let folder = folder(|_| 5.0, 5.0, 20.0);
    let lots = "<for each=\"houses\"><Place type=\"so-nikai\" on=\"plot\"/></for>";
    let built = in_folder(&text(GROUND, lots), folder.path(), |_| {});
    assert!(
        built.found.contains(&"HSD1163".to_owned()),
        "{:?}",
        built.found
    );
    let off: Vec<_> = built
        .corrected
        .iter()
        .filter(|c| c[2] == "HSD1163")
        .collect();
    assert!(
        off.len() >= 20 && off.iter().any(|c| c[3].contains("next one")),
        "{off:?}"
    );
    let (standing, ()) = stand(&text(GROUND, lots), folder.path(), |_| ());
    assert!(
        standing.values().any(|at| (at.0 - 5.3).abs() < 1e-3),
        "the next height counts"
    );
}

#[test]
fn faults_of_a_ground_are_told() {
    let folder = folder(|_| 5.0, 5.0, -200.0);
    let found =
        |ground: &str, rules: &str| in_folder(&text(ground, rules), folder.path(), |_| {}).found;
    assert!(
        found(GROUND, "<for each=\"ground\"><Skip because=\"no\"/></for>")
            .contains(&"HSD1160".to_owned())
    );
    let keyed = GROUND.replace("crs", "key=\"k\" crs");
    assert!(found(&keyed, ALL).contains(&"HSD1160".to_owned()));
    let alone = format!("<Town>{GROUND}</Town>");
    assert!(
        in_folder(&alone, folder.path(), |_| {})
            .found
            .contains(&"HSD1161".to_owned())
    );
    let unplaced = GROUND.replace("crs=\"local\"", "");
    assert!(found(&unplaced, ALL).contains(&"HSD1143".to_owned()));
    let elsewhere = GROUND.replace("local", "EPSG:6674");
    assert!(found(&elsewhere, ALL).contains(&"HSD1115".to_owned()));
    let mut far = fs::read_to_string(folder.path().join("ground.asc")).expect("is there");
    far = far.replace("xllcorner -200", "xllcorner 99000");
    fs::write(folder.path().join("ground.asc"), far).expect("is written");
    assert!(found(GROUND, ALL).contains(&"HSD1162".to_owned()));
}

/// A surface with slopes, a terrace and a hollow.
fn hills(p: DVec2) -> f64 {
    let hollow = (-(p - dvec2(20.0, 10.0)).length_squared() / 900.0).exp();
    let terrace = if p.y > 31.0 { 3.0 } else { 0.0 };
    40.0 + 0.05 * p.x + 2.0 * (p.x / 17.0).sin() * (p.y / 23.0).cos() - 6.0 * hollow + terrace
}

/// The pieces of a ground with their meshes at all levels.
fn pieces(plan: &Plan) -> BTreeMap<Cell, Vec<GroundMesh>> {
    let size = plan.town.tiles.size;
    let all = cells(plan, &plan.town.tiles).expect("nothing waits in a spool");
    let patch = |cell: Cell| Some((cell, Patch::new(&plan.ground, cell, size)?));
    let meshes = |patch: &Patch| {
        Detail::ALL
            .map(|d| patch.mesh(d.ground_tolerance()))
            .to_vec()
    };
    all.into_iter()
        .filter_map(patch)
        .map(|(cell, p)| (cell, meshes(&p)))
        .collect()
}

/// The height of a mesh at a place, by the triangle over it; `None` where there is none.
fn height(mesh: &GroundMesh, p: DVec2) -> Option<f64> {
    mesh.indices.chunks_exact(3).find_map(|t| {
        let [a, b, c] = [t[0], t[1], t[2]].map(|n| mesh.positions[n as usize]);
        let (u, v, w) = ((b - a).truncate(), (c - a).truncate(), p - a.truncate());
        let whole = u.perp_dot(v);
        assert!(whole > 0.0, "counter-clockwise from above");
        let (s, t) = (w.perp_dot(v) / whole, u.perp_dot(w) / whole);
        let inside = s >= -1e-9 && t >= -1e-9 && s + t <= 1.0 + 1e-9;
        inside.then_some(a.z + (b.z - a.z) * s + (c.z - a.z) * t)
    })
}

#[test]
fn the_mesh_keeps_within_its_tolerance() {
    let folder = folder(hills, 2.0, -200.0);
    let ((), ()) = ((), ());
    let (_, ()) = stand(&text(GROUND, ALL), folder.path(), |plan| {
        let size = plan.town.tiles.size;
        let all = pieces(plan);
        assert!(all.len() >= 9, "{:?}", all.keys());
        let count = |level: usize| all.values().map(|m| m[level].indices.len()).sum::<usize>();
        assert!(count(0) * 5 < count(3) * 4, "{} {}", count(0), count(3));
        for (cell, meshes) in &all {
            let counts: Vec<usize> = meshes.iter().map(|m| m.indices.len() / 3).collect();
            assert!(counts.is_sorted(), "coarser from afar: {counts:?}");
            for (detail, mesh) in Detail::ALL.into_iter().zip(meshes) {
                for k in 0..150 {
                    let share = dvec2(
                        f64::from(k * 37 % 149) / 149.0,
                        f64::from(k * 61 % 151) / 151.0,
                    );
                    let p = (dvec2(cell.0 as f64, cell.1 as f64) + share) * size;
                    let found = height(mesh, p).expect("no holes");
                    let known = plan.ground.at(p).expect("is covered");
                    // Half a metre of lattice between the heights adds the curve of the surface between its corners.
                    let most = detail.ground_tolerance() + 0.05 + 0.35;
                    assert!(
                        (found - known).abs() < most,
                        "{cell:?} {detail:?} {p}: {found} {known}"
                    );
                }
            }
        }
    });
}

#[test]
fn pieces_meet_without_a_gap_at_all_levels() {
    let folder = folder(hills, 2.0, -200.0);
    let (_, ()) = stand(&text(GROUND, ALL), folder.path(), |plan| {
        let size = plan.town.tiles.size;
        let all = pieces(plan);
        let mut borders = 0;
        for (cell, meshes) in &all {
            for (east, north) in [(1, 0), (0, 1)] {
                let Some(others) = all.get(&(cell.0 + east, cell.1 + north)) else {
                    continue;
                };
                borders += 1;
                let from = dvec2((cell.0 + east) as f64, (cell.1 + north) as f64) * size;
                let way = dvec2(north as f64, east as f64) * size;
                for k in 0..=97 {
                    let p = from + way * (f64::from(k) / 97.0);
                    let seen = |meshes: &Vec<GroundMesh>| -> Vec<f64> {
                        meshes
                            .iter()
                            .map(|mesh| height(mesh, p).expect("reaches the border"))
                            .collect()
                    };
                    let heights = [seen(meshes), seen(others)].concat();
                    let low = heights.iter().copied().fold(f64::INFINITY, f64::min);
                    let high = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
                    assert!(high - low < 1e-6, "{cell:?} at {p}: {heights:?}");
                }
            }
        }
        assert!(borders >= 12, "{borders}");
    });
}

#[test]
fn gaps_of_a_grid_stay_open() {
    let void = |p: DVec2| {
        if p.distance(dvec2(-25.0, 0.0)) < 12.0 {
            -9999.0
        } else {
            7.0
        }
    };
    let folder = folder(void, 2.0, -200.0);
    let (_, ()) = stand(&text(GROUND, ALL), folder.path(), |plan| {
        for meshes in pieces(plan).values() {
            for mesh in meshes {
                assert!(mesh.positions.iter().all(|p| (p.z - 7.0).abs() < 1e-6));
                let near = |p: DVec2| p.distance(dvec2(-25.0, 0.0));
                for t in mesh.indices.chunks_exact(3) {
                    let middle: DVec2 = t
                        .iter()
                        .map(|n| mesh.positions[*n as usize].truncate())
                        .sum();
                    assert!(near(middle / 3.0) > 10.0, "nothing over the gap");
                }
            }
        }
    });
}

#[test]
fn pieces_are_tiles_of_the_town() {
    let folder = folder(hills, 5.0, -200.0);
    let text = text(GROUND, ALL).replace("size=\"50\"", "size=\"50\" detail=\"0,1\"");
    let of = |threads| {
        let store = Memory::default();
        build(&text, folder.path(), &store, threads).expect("nothing fails")
    };
    let one = of(1);
    for threads in [2, 7] {
        assert!(
            of(threads).all() == one.all(),
            "{threads} threads write other bytes"
        );
    }
    // The rules of 3D Tiles: boxes hold what is in them, errors shrink, every file is named once.
    let found = checked(&one);
    let keys: Vec<&String> = found.keys.values().flatten().collect();
    assert!(keys.iter().any(|key| *key == "0_0") && keys.iter().any(|key| *key == "e3"));
    let pieces = one
        .town
        .tiles
        .iter()
        .filter(|tile| tile.tile.starts_with("ground-"));
    let pieces: Vec<_> = pieces.collect();
    assert!(pieces.len() >= 9, "{}", pieces.len());
    for piece in pieces {
        assert_eq!(piece.houses, 0);
        assert!(
            piece
                .levels
                .iter()
                .all(|level| level.low[2] > 20_000 && level.high[2] < 60_000)
        );
    }
    // What does not change is not made again; another ground makes its pieces and the houses on it anew.
    let store = Memory::default();
    build(&text, folder.path(), &store, 2).expect("nothing fails");
    let again = build(&text, folder.path(), &store, 2).expect("nothing fails");
    assert_eq!(again.town.kept, again.town.tiles.len());
}

#[test]
fn the_ground_is_in_every_output() {
    let folder = folder(|p| 10.0 + 0.1 * p.x, 5.0, -200.0);
    let town = text(GROUND, ALL);
    fs::write(folder.path().join("t.hsd"), town).expect("is written");
    let write = |out: &str| {
        let run = hsd(
            folder.path(),
            &["town", "t.hsd", "-o", out, "--detail", "0"],
        );
        assert!(run.status.success(), "{}", said(&run));
    };
    write("t.city.json");
    let json = fs::read(folder.path().join("t.city.json")).expect("is there");
    let json: serde_json::Value = serde_json::from_slice(&json).expect("is JSON");
    let objects = json["CityObjects"].as_object().expect("objects").values();
    let grounds: Vec<_> = objects.filter(|o| o["type"] == "TINRelief").collect();
    assert!(grounds.len() >= 9, "{}", grounds.len());
    for ground in grounds {
        assert_eq!(ground["geometry"][0]["type"], "CompositeSurface");
        assert_eq!(ground["attributes"]["evidence"], "a formula");
        let faces = ground["geometry"][0]["boundaries"]
            .as_array()
            .expect("faces");
        for corner in faces.iter().flat_map(|f| f[0].as_array().expect("a ring")) {
            let at = &json["vertices"][corner.as_u64().expect("a number") as usize];
            let [x, _, z] = [0, 1, 2].map(|k| at[k].as_i64().expect("millimetres") as f64 / 1000.0);
            assert!((z - 10.0 - 0.1 * x).abs() < 0.06, "{x} {z}");
        }
    }
    write("t.obj");
    let names: Vec<String> = fs::read_dir(folder.path())
        .expect("is a folder")
        .map(|entry| {
            entry
                .expect("is there")
                .file_name()
                .to_string_lossy()
                .into_owned()
        })
        .collect();
    assert!(
        names.contains(&"t-ground-0_0.obj".to_owned()) && names.contains(&"t-0_0.obj".to_owned()),
        "{names:?}"
    );
    let houses = names
        .iter()
        .filter(|n| n.ends_with(".obj") && !n.contains("ground"));
    let text = |name: &String| fs::read_to_string(folder.path().join(name)).expect("is text");
    let all: String = houses.map(text).collect();
    for n in 0..12 {
        assert!(
            all.contains(&format!("houses_e{n}")) || all.contains(&format!("houses e{n}")),
            "e{n}"
        );
    }
    write("t.glb");
    let glb = fs::read(folder.path().join("t.glb")).expect("is there");
    let has = |word: &str| glb.windows(word.len()).any(|w| w == word.as_bytes());
    assert!(has("ground-0_0") && has("houses e3"));
}
