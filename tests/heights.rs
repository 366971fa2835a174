//! Grids of heights: every format gives back the surface that its file was made from; damage and absurd sizes are told.

pub(crate) mod files;

use crate::support::Numbers;
use files::*;
use hsd::glam::{DVec2, dvec2};
use hsd::map::heights::{Heights, is_grid, read};
use hsd::map::{Crs, Fault, Kind, Options, OtherGrid};
use hsd::source::{PictureFile, Stream, World};
use std::io;

/// Files in memory.
struct Memory(Vec<(String, Vec<u8>)>);

impl World for Memory {
    fn picture(&self, _: &str) -> Option<PictureFile> {
        None
    }

    fn picture_bytes(&self, path: &str) -> io::Result<Vec<u8>> {
        Err(io::Error::new(io::ErrorKind::NotFound, path))
    }

    fn open(&self, path: &str) -> io::Result<Box<dyn Stream>> {
        let found = self.0.iter().find(|(name, _)| name == path);
        let (_, bytes) = found.ok_or(io::ErrorKind::NotFound)?;
        Ok(Box::new(io::Cursor::new(bytes.clone())))
    }
}

type Window = Option<[DVec2; 2]>;

/// Reads a grid and its remarks.
fn grid(
    files: &[(&str, &[u8])],
    crs: Option<&str>,
    window: Window,
) -> Result<(Heights, Vec<Fault>), Fault> {
    let files = files
        .iter()
        .map(|(name, bytes)| ((*name).to_owned(), bytes.to_vec()));
    let world = Memory(files.collect());
    let (path, _) = &world.0[0];
    let options = Options {
        crs: crs.and_then(Crs::from_name),
        ..Options::default()
    };
    let mut remarks = vec![];
    let heights = read(&world, path, &options, &|_| window, &mut remarks)?;
    Ok((heights, remarks))
}

/// Checks the surface at places between the middles of cells.
fn is_slope(heights: &Heights, tolerance: f64) {
    for k in 0..500 {
        let share = dvec2(
            f64::from(k * 37 % 101) / 100.0,
            f64::from(k * 53 % 97) / 96.0,
        );
        let p = middle(0, ROWS - 1) + share * (middle(COLUMNS - 1, 0) - middle(0, ROWS - 1));
        let found = heights.at(p).unwrap_or_else(|| panic!("a height at {p}"));
        assert!(
            (found - slope(p)).abs() < tolerance,
            "{p}: {found} {}",
            slope(p)
        );
    }
}

#[test]
fn an_ascii_grid_is_the_surface() {
    let (heights, remarks) =
        grid(&[("g.asc", &ascii())], Some("EPSG:6674"), None).expect("is read");
    assert!(remarks.is_empty(), "{remarks:?}");
    is_slope(&heights, 2e-4);
    let [low, high] = heights.bounds();
    assert!((low - AT).length() < 1e-9, "{low}");
    assert!((high - AT - dvec2(COLUMNS as f64, ROWS as f64) * SIDE).length() < 1e-9);
    assert_eq!(heights.at(low - 0.1), None, "outside");
    assert!(heights.at(low + 0.1).is_some(), "the outer half of a cell");
    // The centre of the first cell in place of its corner, and the system from a file beside.
    let text = String::from_utf8(ascii()).expect("is text");
    let centred = text
        .replace(
            &format!("XLLCORNER {}", AT.x),
            &format!("xllcenter {}", AT.x + 5.0),
        )
        .replace(
            &format!("YLLCORNER {}", AT.y),
            &format!("yllcenter {}", AT.y + 5.0),
        );
    let prj = Crs::from_epsg(6674)
        .map(|_| b"EPSG:6674".as_slice())
        .expect("is known");
    let (centred, _) =
        grid(&[("g.asc", centred.as_bytes()), ("g.prj", prj)], None, None).expect("is read");
    assert_eq!(centred, heights);
}

#[test]
fn a_geotiff_is_the_surface() {
    let values: Vec<f64> = cells().collect();
    for how in [
        TIFF,
        Tiff {
            big_endian: true,
            ..TIFF
        },
        Tiff { bits: 64, ..TIFF },
        Tiff {
            of_points: true,
            ..TIFF
        },
    ] {
        let (heights, _) = grid(&[("g.tif", &tiff(how, &values))], None, None).expect("is read");
        assert_eq!(
            heights.crs.as_ref().map(|crs| &*crs.name),
            Some("EPSG:6674")
        );
        is_slope(&heights, 1e-4);
    }
    let whole = Tiff {
        bits: 16,
        format: 2,
        ..TIFF
    };
    let (heights, _) = grid(&[("g.tif", &tiff(whole, &values))], None, None).expect("is read");
    is_slope(&heights, 1.01);
    let feet: Vec<f64> = values.iter().map(|h| h / 0.3048).collect();
    let how = Tiff {
        vertical: 9002,
        ..TIFF
    };
    let (heights, _) = grid(&[("g.tif", &tiff(how, &feet))], None, None).expect("is read");
    is_slope(&heights, 1e-4);
}

#[test]
fn a_cell_without_a_height_has_none() {
    let mut values: Vec<f64> = cells().collect();
    values[5 * COLUMNS + 7] = -9999.0;
    values[5 * COLUMNS + 9] = f64::NAN;
    values[5 * COLUMNS + 11] = -3.4e38;
    let (heights, _) = grid(&[("g.tif", &tiff(TIFF, &values))], None, None).expect("is read");
    for column in [7, 9, 11] {
        assert_eq!(heights.at(middle(column, 5)), None);
        assert_eq!(
            heights.at(middle(column, 5) + dvec2(9.0, 0.0)),
            None,
            "it counts there"
        );
        assert!(heights.at(middle(column + 1, 5)).is_some());
    }
}

#[test]
fn grids_of_the_survey_of_japan_are_the_surface() {
    for (start, count) in [(0, 54), (4, 50), (11, 30)] {
        let (heights, remarks) =
            grid(&[("d.xml", &gml(start, count))], None, None).expect("is read");
        assert!(remarks.is_empty(), "{remarks:?}");
        assert_eq!(
            heights.crs.as_ref().map(|crs| &*crs.name),
            Some("EPSG:6668")
        );
        for cell in 0..54 {
            let p = dvec2(
                135.7505 + (cell % 9) as f64 * 0.001,
                34.9845 - (cell / 9) as f64 * 0.001,
            );
            let known = (start..start + count).contains(&cell);
            match heights.at(p) {
                Some(found) => assert!(known && (found - of_degrees(p)).abs() < 1e-3, "{cell}"),
                None => assert!(!known, "{cell}"),
            }
        }
    }
    let (heights, _) = grid(&[(TILE, &tile())], None, None).expect("is read");
    // Column 14547 and row 6463 of zoom 14: a corner by the formula of the web's tiles.
    let half = std::f64::consts::PI * 6_378_137.0;
    let side = 2.0 * half / f64::from(1 << 14);
    let corner = dvec2(14547.0 * side - half, half - 6463.0 * side);
    let at = |column: f64, row: f64| corner + dvec2(column + 0.5, -row - 0.5) * side / 256.0;
    let found = heights.at(at(10.5, 20.25)).expect("a height");
    assert!(
        (found - (5.0 + 0.25 * 20.25 + 0.5 * 10.5)).abs() < 1e-3,
        "{found}"
    );
    assert_eq!(heights.at(at(10.0, 255.0)), None);
}

#[test]
fn only_the_window_is_kept() {
    let window = [middle(10, 12), middle(12, 10)];
    let values: Vec<f64> = cells().collect();
    for (name, bytes) in [("g.asc", ascii()), ("g.tif", tiff(TIFF, &values))] {
        let (whole, _) = grid(&[(name, &bytes)], Some("EPSG:6674"), None).expect("is read");
        let (part, remarks) =
            grid(&[(name, &bytes)], Some("EPSG:6674"), Some(window)).expect("is read");
        assert!(remarks.is_empty(), "{remarks:?}");
        assert!(
            part.bytes() <= 4 * 64 && whole.bytes() == 4 * COLUMNS * ROWS,
            "{}",
            part.bytes()
        );
        for k in 0..100 {
            let p = window[0].lerp(window[1], f64::from(k) / 99.0);
            let both = part.at(p).zip(whole.at(p)).expect("heights");
            assert!((both.0 - both.1).abs() < 1e-9, "{both:?}");
        }
    }
    let far = [AT + 1e6, AT + 2e6];
    let (none, _) = grid(&[("g.asc", &ascii())], Some("EPSG:6674"), Some(far)).expect("is read");
    assert!(none.is_empty() && none.at(middle(3, 3)).is_none());
}

#[test]
fn what_is_no_grid_of_heights_is_refused() {
    let values: Vec<f64> = cells().collect();
    let other = |how| match grid(&[("g.tif", &tiff(how, &values))], None, None) {
        Err(Fault {
            kind: Kind::OtherGrid { what },
            ..
        }) => what,
        other => panic!("{other:?}"),
    };
    assert_eq!(
        other(Tiff {
            bits: 8,
            format: 1,
            ..TIFF
        }),
        OtherGrid::Bytes
    );
    assert_eq!(
        other(Tiff {
            bits: 16,
            format: 1,
            bands: 3,
            ..TIFF
        }),
        OtherGrid::Colours
    );
    assert_eq!(
        other(Tiff {
            vertical: 9095,
            ..TIFF
        }),
        OtherGrid::Unit
    );
    assert_eq!(other(Tiff { turn: 0.5, ..TIFF }), OtherGrid::Turned);
    let unknown = grid(
        &[("g.tif", &tiff(Tiff { code: 4978, ..TIFF }, &values))],
        None,
        None,
    );
    assert!(
        matches!(
            unknown,
            Err(Fault {
                kind: Kind::UnknownCrs { .. },
                ..
            })
        ),
        "{unknown:?}"
    );
    let degrees = grid(&[("g.asc", &ascii())], Some("EPSG:4326"), None);
    assert!(
        matches!(
            degrees,
            Err(Fault {
                kind: Kind::OutsideCrs { .. },
                ..
            })
        ),
        "{degrees:?}"
    );
}

#[test]
fn absurd_sizes_and_cut_files_are_told() {
    let head = |n: &str, more: &str| {
        format!("ncols {n}\nnrows {n}\nxllcorner 0\nyllcorner 0\ncellsize 1\n{more}")
    };
    let kind = |text: String| {
        grid(&[("g.asc", text.as_bytes())], Some("local"), None)
            .map(|(_, r)| r)
            .map_err(|f| f.kind)
    };
    assert!(matches!(
        kind(head("99999999", "1 2 3")),
        Err(Kind::TooLarge { .. })
    ));
    assert!(matches!(
        kind(head("1000000", "1 2 3")),
        Err(Kind::TooLarge { .. })
    ));
    assert!(matches!(kind(head("0", "")), Err(Kind::Damaged { .. })));
    assert!(matches!(
        kind(head("3", "1 2 three")),
        Err(Kind::Damaged { .. })
    ));
    assert!(matches!(
        kind(head("3", &"9".repeat(100))),
        Err(Kind::Damaged { .. })
    ));
    let cut = kind(head("3", "1 2 3 4")).expect("is read as far as it goes");
    assert!(
        matches!(
            cut[..],
            [Fault {
                kind: Kind::CellsDiffer { said: 9, found: 4 },
                ..
            }]
        ),
        "{cut:?}"
    );
    let mut bytes = tiff(TIFF, &cells().collect::<Vec<f64>>());
    bytes.truncate(bytes.len() / 3);
    assert!(grid(&[("g.tif", &bytes)], None, None).is_err());
}

#[test]
fn grids_are_told_from_other_maps() {
    let values: Vec<f64> = cells().collect();
    let is =
        |name: &str, bytes: &[u8]| is_grid(&Memory(vec![(name.to_owned(), bytes.to_vec())]), name);
    assert!(
        is("a.asc", &ascii())
            && is("a.tif", &tiff(TIFF, &values))
            && is("a.xml", &gml(0, 54))
            && is(TILE, &tile())
    );
    assert!(
        !is("14/1/2.csv", &tile())
            && !is("points.txt", &tile())
            && !is("14/1/2.txt", b"lon,lat\n1,2\n")
    );
    assert!(
        !is(
            "a.geojson",
            b"{\"type\":\"FeatureCollection\",\"features\":[]}"
        ) && !is("none", b"")
    );
}

#[test]
fn five_hundred_damages_of_each_format() {
    let values: Vec<f64> = cells().collect();
    let files = [
        ("g.asc", ascii()),
        ("g.tif", tiff(TIFF, &values)),
        ("d.xml", gml(4, 40)),
        (TILE, tile()),
    ];
    for (name, whole) in files {
        let mut random = Numbers(0x2545_f491_4f6c_dd1d);
        let (mut refused, mut told) = (0, 0);
        for _ in 0..500 {
            let mut bytes = whole.clone();
            for _ in 0..=random.below(3) {
                if bytes.is_empty() {
                    break;
                }
                // Heads matter most, so half of the damage is there.
                let reach = if random.below(2) == 0 {
                    bytes.len()
                } else {
                    bytes.len().min(400)
                };
                let at = random.below(reach);
                let end = (at + 1 + random.below(12)).min(bytes.len());
                match random.below(5) {
                    0 | 1 => bytes[at] = random.below(256) as u8,
                    2 => drop(bytes.drain(at..end)),
                    3 => {
                        let again = bytes[at..end].to_vec();
                        bytes.splice(at..at, again);
                    }
                    _ => bytes.truncate(bytes.len() - random.below(bytes.len() / 2 + 1)),
                }
            }
            match grid(&[(name, &bytes)], Some("local"), None) {
                Ok((heights, remarks)) => {
                    told += usize::from(!remarks.is_empty());
                    let [low, high] = heights.bounds();
                    for k in 0..20 {
                        let found = heights.at(low.lerp(high, f64::from(k) / 19.0));
                        assert!(found.is_none_or(f64::is_finite));
                    }
                }
                Err(_) => refused += 1,
            }
        }
        assert!(refused > 50, "{name}: {refused} refused, {told} told");
    }
}
