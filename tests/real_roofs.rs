//! Hipped roofs over every outline of the real maps: houses, roofs as measured, lots, blocks and roads. The maps lie
//! beside the repository, not in it; without them the test is reported as ignored.
use crate::support::assert_none;
use crate::support::maps::{maps, plans};
use glam::DVec2;
use hsd::building::{Finish, Roof};
use hsd::check::solid_flaws;
use hsd::roof::shape::hipped::over;
use hsd::roof::shape::look::Look;

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

/// The area in plan of a roof's covering and its height over the plate, in sum over the area: without eaves the
/// first is the area of the walls.
fn covered(roof: &Roof) -> f64 {
    let faces = roof
        .solids
        .iter()
        .flat_map(|s| s.faces.iter().map(move |f| (s, f)));
    let tops = faces.filter(|(_, f)| matches!(f.finish, Finish::Covering(_)));
    tops.map(|(s, f)| {
        let ring: Vec<DVec2> = f
            .corners
            .iter()
            .map(|c| s.points[*c as usize].truncate())
            .collect();
        area(&ring)
    })
    .sum()
}

#[test]
#[cfg_attr(not(shared_data), ignore = "reads ../shared/data, which is not here")]
fn shared_data_outlines_all_get_a_whole_roof() {
    let maps = maps();
    assert!(!maps.is_empty(), "there are no maps in ../shared/data");
    let style = Default::default();
    let look = Look::gable(None, &style, 6.0, 0.909);
    let bare = Look { eaves: 0.0, ..look };
    let (mut all, mut roofed, mut refused, mut findings) = (0, 0, vec![], vec![]);
    for map in &maps {
        let plans = plans(map);
        let before = roofed;
        for plan in &plans {
            let (outline, courts, name) = (&plan.outline, &plan.courts, &plan.name);
            let roof = match over(outline, courts, 3.0, &look) {
                Ok(roof) => roof,
                Err(why) => {
                    refused.push(format!("{name}: {why}"));
                    continue;
                }
            };
            roofed += 1;
            for solid in &roof.solids {
                findings.extend(solid_flaws(solid).map(|flaw| format!("{name}: {flaw:?}")));
            }
            let whole = area(outline) - courts.iter().map(|c| area(c)).sum::<f64>();
            let cover = over(outline, courts, 3.0, &bare).map_or(0.0, |r| covered(&r));
            if (cover - whole).abs() > 1e-3 * whole.max(1.0) {
                findings.push(format!("{name}: covers {cover:.4} of {whole:.4} m2"));
            }
            let wide = covered(&roof);
            if wide < 0.999 * whole {
                findings.push(format!("{name}: eaves take {wide:.4} from {whole:.4} m2"));
            }
        }
        all += plans.len();
        eprintln!("{} of {} {}", roofed - before, plans.len(), map.display());
    }
    eprintln!(
        "{roofed} of {all} outlines have a roof; the others:\n{}",
        refused.join("\n")
    );
    assert_none(&findings);
    assert!(all > 6000, "{all}");
    assert!(1000 * roofed >= 995 * all, "{roofed} of {all}");
}
