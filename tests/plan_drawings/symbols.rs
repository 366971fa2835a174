//! Openings as surveyors draw them, along +x from a post's middle, +y into the house.

use super::sheet::{Place, Shape};
use super::survey::Style;

fn straight(x0: f32, x1: f32, y: f32) -> Shape {
    Shape::Line(vec![(x0, y), (x1, y)])
}

fn upright(x: f32, y0: f32, y1: f32) -> Shape {
    Shape::Line(vec![(x, y0), (x, y1)])
}

fn boxed(x: (f32, f32), y: (f32, f32)) -> Vec<Place> {
    vec![(x.0, y.0), (x.1, y.0), (x.1, y.1), (x.0, y.1)]
}

/// Leaves on two tracks that overlap in the middle; a single one stands before half of its opening.
pub fn slide(length: f32, style: &Style) -> Vec<Shape> {
    let leaves = (length as usize).max(2);
    let (track, lap) = ((style.wall * 0.24).max(0.028), 0.07);
    let post = style.post / 2.0;
    let mut shapes = Vec::new();
    if style.sill {
        shapes.extend([
            straight(post, length - post, -style.wall / 2.0),
            straight(post, length - post, style.wall / 2.0),
        ]);
    }
    for k in 0..leaves {
        let step = length / leaves as f32;
        let x0 = if k == 0 {
            post
        } else {
            k as f32 * step - lap / 2.0
        };
        let x1 = if k + 1 == leaves {
            length - post
        } else {
            (k + 1) as f32 * step + lap / 2.0
        };
        let inside = if leaves == 4 {
            k == 1 || k == 2
        } else {
            k % 2 == 1
        };
        let y = if inside { track } else { -track };
        let thick = track * 0.55;
        match style.leaf {
            0 => shapes.push(straight(x0, x1, y)),
            1 => shapes.push(Shape::Loop(boxed((x0, x1), (y - thick, y + thick)))),
            2 => shapes.push(Shape::Fill(boxed((x0, x1), (y - thick, y + thick)))),
            _ => shapes.extend([
                straight(x0, x1, y),
                upright(x0, y - thick, y + thick),
                upright(x1, y - thick, y + thick),
            ]),
        }
    }
    shapes
}

/// A leaf and the arc of its swing.
pub fn hinged(length: f32, style: &Style, mirrored: bool, outwards: bool) -> Vec<Shape> {
    let post = style.post / 2.0;
    let side = if outwards { -1.0 } else { 1.0 };
    let radius = length - 2.0 * post;
    let x = |t: f32| {
        if mirrored {
            length - post - t
        } else {
            post + t
        }
    };
    let tip = (
        x(radius * style.swing.cos()),
        side * radius * style.swing.sin(),
    );
    let hinge = (x(0.0), 0.0);
    let mut shapes = vec![
        Shape::Line(vec![hinge, tip]),
        Shape::Arc(hinge, tip, (x(radius), 0.0)),
    ];
    if style.sill {
        shapes.extend([
            straight(post, length - post, -style.wall / 2.0),
            straight(post, length - post, style.wall / 2.0),
        ]);
    }
    shapes
}

/// Two faces and the pane between them.
pub fn window(length: f32, style: &Style) -> Vec<Shape> {
    let (post, half) = (style.post / 2.0, (style.wall / 2.0).max(0.055));
    let (x0, x1) = (post, length - post);
    let mut shapes = vec![straight(x0, x1, -half), straight(x0, x1, half)];
    match style.panes {
        0 => shapes.push(straight(x0, x1, 0.0)),
        1 => shapes.extend([
            straight(x0, x1, -half * 0.25),
            straight(x0, x1, half * 0.25),
        ]),
        2 => shapes.extend([
            straight(x0, length / 2.0 + 0.04, half * 0.3),
            straight(length / 2.0 - 0.04, x1, -half * 0.3),
        ]),
        _ => shapes.extend([
            straight(x0, x1, -half * 1.8),
            upright(x0, -half * 1.8, half),
            upright(x1, -half * 1.8, half),
        ]),
    }
    shapes
}

/// Bars between two thin lines, on the wall or in a box before it.
pub fn lattice(length: f32, style: &Style, outer: bool) -> Vec<Shape> {
    let half = (style.wall / 2.0).max(0.055);
    let (near, far) = if style.projecting && outer {
        (-half * 3.2, -half * 1.2)
    } else {
        (-half, half)
    };
    let post = style.post / 2.0;
    let mut shapes = vec![
        straight(post, length - post, near),
        straight(post, length - post, far),
    ];
    if style.projecting && outer {
        shapes.extend([
            straight(post, length - post, half),
            upright(post, near, half),
            upright(length - post, near, half),
        ]);
    }
    let bars = length as i32 * style.bars;
    let size = (far - near) * 0.32;
    for k in 1..bars {
        let x = length * k as f32 / bars as f32;
        let middle = (near + far) / 2.0;
        shapes.push(if style.bars > 6 {
            upright(x, near, far)
        } else {
            Shape::Fill(boxed((x - size, x + size), (middle - size, middle + size)))
        });
    }
    shapes
}
