//! Arrows on stairs: the way up from the lower storey, the way down from the upper one.

use super::{MM, draw};
use crate::support::compile;
use glam::{DVec2, dvec2};
use hsd::drawing::Wanted;

#[test]
fn arrows_point_the_way_one_walks() {
    let unit = 3.0 * hsd::geometry::SHAKU * MM;
    for (faces, at, up) in [
        ("F", "3 2", DVec2::Y),
        ("B", "3 2", DVec2::NEG_Y),
        ("L", "2 3", DVec2::X),
        ("R", "2 3", DVec2::NEG_X),
    ] {
        let size = if up.x == 0.0 { "1 3" } else { "3 1" };
        let row = |code: &str| format!("<Row>{}</Row>", code.repeat(8));
        let rows = format!(
            "{}{}{}{}",
            row("GSI  "),
            row("KTU  "),
            row("KTU  "),
            row("KTU  ")
        );
        let text = format!(
            r#"<House><Storey height="9">{rows}<Fixture kind="stairs" at="{at}" size="{size}" faces="{faces}"/></Storey>
               <Storey height="8">{rows}</Storey></House>"#
        );
        let run = compile("house.hsd", text.as_bytes());
        for (plan, way) in [(1, up), (2, -up)] {
            let drawn = draw(&run, &run.scene, Wanted::Plan(plan), &[]);
            let arrows: Vec<_> = drawn.iter().filter(|d| d.role == "fall").collect();
            let [arrow] = arrows[..] else {
                panic!("{faces}, plan {plan}: {} arrows", arrows.len());
            };
            let shaft = &arrow.rings[0];
            let along = shaft[1] - shaft[0];
            let right = way * (3.0 * unit - 1.6);
            assert!(
                (along - right).length() < 1e-2,
                "{faces}, plan {plan}: {along} {right}"
            );
            // Both strokes of the head end at the tip and come from behind it.
            for head in &arrow.rings[1..] {
                assert!(head[1].distance(shaft[1]) < 1e-2);
                assert!((head[0] - head[1]).dot(way) < -1.0);
            }
            assert_eq!(arrow.rings.len(), 3);
        }
        let plan = draw(&run, &run.scene, Wanted::Plan(1), &[]);
        let walls = plan.iter().filter(|d| d.role == "wall" || d.role == "post");
        let corners = || {
            walls
                .clone()
                .flat_map(|d| d.rings.iter().flatten().copied())
        };
        let low = corners().reduce(DVec2::min).expect("walls");
        let high = corners().reduce(DVec2::max).expect("walls");
        let shaft = plan.iter().find(|d| d.role == "fall").expect("an arrow");
        let middle = (shaft.rings[0][0] + shaft.rings[0][1]) / 2.0;
        // The right end of the front is the origin: a runs to the left, b up the paper.
        let center = (low + high) / 2.0;
        let expected = center + dvec2(4.0 - 3.5, 3.5 - 4.0) * unit;
        assert!(
            middle.distance(expected) < 1.0,
            "{faces}: {middle} {expected}"
        );
    }
}
