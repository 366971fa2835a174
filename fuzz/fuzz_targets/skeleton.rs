//! Any corners whatever: a hipped roof that is whole and covers the walls, or the reason why there is none.
//!
//! The first byte says how the others are read: on a grid, where everything happens at once, slightly off it, where
//! it nearly does, or as fine as two bytes say; and how many courts there are.

#![no_main]

use glam::{DVec2, dvec2};
use hsd::building::Finish;
use hsd::check::solid_flaws;
use hsd::roof::shape::look::Look;
use hsd::roof::skeleton::Invalid;
use libfuzzer_sys::fuzz_target;

fn corners(bytes: &[u8], how: u8) -> Vec<DVec2> {
    let near = [1e-3, 1e-5, 1e-7, 1e-9][usize::from(how >> 2 & 3)];
    let low = |b: u8| f64::from(b & 15);
    let off = |b: u8| f64::from(b >> 4) * near;
    match how & 3 {
        0 => bytes
            .chunks_exact(1)
            .map(|b| dvec2(low(b[0]), f64::from(b[0] >> 4)))
            .collect(),
        1 => bytes
            .chunks_exact(2)
            .map(|b| dvec2(low(b[0]) + off(b[0]), low(b[1]) + off(b[1])))
            .collect(),
        2 => {
            let wide = |b: &[u8]| f64::from(u16::from_le_bytes([b[0], b[1]])) / 1000.0;
            bytes
                .chunks_exact(4)
                .map(|b| dvec2(wide(b), wide(&b[2..])))
                .collect()
        }
        // A star: always simple.
        _ => {
            let turn = |i: usize| std::f64::consts::TAU * i as f64 / bytes.len() as f64;
            let far = |b: u8| 1.0 + low(b) + off(b);
            let at = |(i, b): (usize, &u8)| far(*b) * dvec2(turn(i).cos(), turn(i).sin());
            bytes.iter().enumerate().map(at).collect()
        }
    }
}

fn area(ring: &[DVec2]) -> f64 {
    let next = ring.iter().cycle().skip(1);
    (ring
        .iter()
        .zip(next)
        .map(|(p, q)| p.perp_dot(*q))
        .sum::<f64>()
        / 2.0)
        .abs()
}

fuzz_target!(|bytes: &[u8]| {
    let [how, cut, rest @ ..] = bytes else { return };
    if rest.len() > 400 {
        return;
    }
    let (outline, court) = rest.split_at(rest.len() * usize::from(*cut).min(255) / 255);
    let outline = corners(outline, *how);
    let courts = vec![corners(court, how & 0x0c)];
    let courts = if court.len() < 3 { vec![] } else { courts };
    let look = Look::gable(None, &Default::default(), 6.0, 0.909);
    match hsd::roof::over(&outline, &courts, 3.0, &look) {
        Err(why) => assert_ne!(why, Invalid::NotFound),
        Ok(roof) => {
            for solid in &roof.solids {
                assert_eq!(solid_flaws(solid).next(), None);
            }
            let bare = Look { eaves: 0.0, ..look };
            let bare = hsd::roof::over(&outline, &courts, 3.0, &bare).expect("has one with eaves");
            let faces = bare
                .solids
                .iter()
                .flat_map(|s| s.faces.iter().map(move |f| (s, f)));
            let tops = faces.filter(|(_, f)| matches!(f.finish, Finish::Covering(_)));
            let plan = |s: &hsd::building::Solid, c: &u32| s.points[*c as usize].truncate();
            let cover: f64 = tops
                .map(|(s, f)| area(&f.corners.iter().map(|c| plan(s, c)).collect::<Vec<_>>()))
                .sum();
            let whole = area(&outline) - courts.iter().map(|c| area(c)).sum::<f64>();
            let rim: f64 = outline.len() as f64 * 40.0 * 0.002;
            assert!(
                (cover - whole).abs() < 1e-3 * whole + rim,
                "{cover} of {whole}"
            );
        }
    }
});
