//! Views side by side on a sheet of paper, with a frame and a title block.

use crate::diagnostic::Language;
use crate::drawing::Settings;
use crate::drawing::paper::{Anchor, Mark, Role, Shape, Sheet, View, width};
use glam::{DVec2, dvec2};

/// The margin of a sheet, millimetres (ISO 5457 has 10, and 20 on the left for filing).
const MARGIN: f64 = 10.0;

/// The space between views, millimetres.
const SPACE: f64 = 12.0;

/// Width and height of the title block, millimetres.
const BLOCK: DVec2 = DVec2::new(90.0, 26.0);

/// The sizes of paper of ISO 216, millimetres.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Paper {
    /// 297 x 210.
    A4,
    /// 420 x 297.
    A3,
    /// 594 x 420.
    A2,
    /// 841 x 594.
    A1,
    /// 1189 x 841.
    A0,
}

impl Paper {
    /// All sizes, the smallest first.
    pub const ALL: [Paper; 5] = [Paper::A4, Paper::A3, Paper::A2, Paper::A1, Paper::A0];

    /// Returns width and height, the longer side level, millimetres.
    pub fn size(self) -> DVec2 {
        match self {
            Paper::A4 => dvec2(297.0, 210.0),
            Paper::A3 => dvec2(420.0, 297.0),
            Paper::A2 => dvec2(594.0, 420.0),
            Paper::A1 => dvec2(841.0, 594.0),
            Paper::A0 => dvec2(1189.0, 841.0),
        }
    }

    /// Returns its name.
    pub fn word(self) -> &'static str {
        match self {
            Paper::A4 => "A4",
            Paper::A3 => "A3",
            Paper::A2 => "A2",
            Paper::A1 => "A1",
            Paper::A0 => "A0",
        }
    }
}

/// Returns one view on paper of its own size, without frame.
pub fn single(view: &View, scale: u32) -> Sheet {
    let bounds = view.bounds();
    Sheet {
        size: bounds.size() + 2.0 * MARGIN,
        scale,
        title: view.title.clone(),
        views: vec![view.moved(MARGIN - bounds.low)],
    }
}

/// Returns rows of views on a sheet; none if they do not fit. A row too long for the sheet goes on below.
pub fn arranged(rows: &[Vec<View>], paper: Paper, settings: &Settings) -> Option<Sheet> {
    let size = paper.size();
    let inner = size - 2.0 * (MARGIN + SPACE / 2.0);
    let mut lines: Vec<(Vec<&View>, DVec2)> = vec![];
    for row in rows {
        let mut line: (Vec<&View>, DVec2) = (vec![], DVec2::ZERO);
        for view in row {
            let own = view.bounds().size();
            if own.x > inner.x {
                return None;
            }
            if !line.0.is_empty() && line.1.x + SPACE + own.x > inner.x {
                lines.push(std::mem::take(&mut line));
            }
            let space = if line.0.is_empty() { 0.0 } else { SPACE };
            line.1 = dvec2(line.1.x + space + own.x, line.1.y.max(own.y));
            line.0.push(view);
        }
        if !line.0.is_empty() {
            lines.push(line);
        }
    }
    let high: f64 = lines.iter().map(|l| l.1.y + SPACE).sum::<f64>() - SPACE;
    // The title block stands beside the last line if there is room.
    let beside = lines
        .last()
        .is_none_or(|l| l.1.x + SPACE + BLOCK.x <= inner.x);
    let free = inner.y - high - if beside { 0.0 } else { BLOCK.y + SPACE };
    if free < 0.0 {
        return None;
    }
    let gap = SPACE + free / (lines.len() + 1) as f64;
    let mut top = size.y - MARGIN - SPACE / 2.0 - (gap - SPACE);
    let mut views = vec![];
    for (line, own) in &lines {
        let mut x = MARGIN + SPACE / 2.0;
        let spare = (inner.x - own.x).max(0.0) / (line.len() + 1) as f64;
        let last = std::ptr::eq(line, &lines[lines.len() - 1].0);
        // Beside the title block views stay on the left.
        let spare = if last && beside {
            spare.min((inner.x - own.x - BLOCK.x - SPACE).max(0.0) / (line.len() + 1) as f64)
        } else {
            spare
        };
        for view in line {
            let bounds = view.bounds();
            x += spare;
            let at = dvec2(x - bounds.low.x, top - own.y - bounds.low.y);
            views.push(view.moved(at));
            x += bounds.size().x + SPACE;
        }
        top -= own.y + gap;
    }
    views.push(frame(size, paper, settings));
    Some(Sheet {
        size,
        scale: settings.scale,
        title: settings.title.clone(),
        views,
    })
}

/// Returns the frame and the title block.
fn frame(size: DVec2, paper: Paper, settings: &Settings) -> View {
    let (low, high) = (DVec2::splat(MARGIN), size - MARGIN);
    let block = dvec2(high.x - BLOCK.x, low.y);
    let mut lines = vec![];
    for (low, high) in [(low, high), (block, block + BLOCK)] {
        let corners = [low, dvec2(high.x, low.y), high, dvec2(low.x, high.y)];
        lines.extend((0..4).map(|k| [corners[k], corners[(k + 1) % 4]]));
    }
    let level = |y: f64| [block + dvec2(0.0, y), block + dvec2(BLOCK.x, y)];
    lines.extend([level(8.0), level(15.0)]);
    let mut marks = vec![Mark::new(Role::Frame, Shape::Lines(lines))];
    let mut say = |x: f64, y: f64, size: f64, text: String| {
        // Long names are set smaller.
        let room = BLOCK.x - x - 3.0;
        let size = size.min(room / width(&text).max(1.0));
        let at = block + dvec2(x, y);
        marks.push(Mark::label(Role::Text, at, size, Anchor::Start, text));
    };
    say(3.0, 18.0, 4.5, settings.title.clone());
    let (scale, ken) = (settings.scale, settings.ken);
    match settings.language {
        Language::English => {
            say(3.0, 10.0, 2.5, format!("Source: {}", settings.source));
            say(
                3.0,
                2.8,
                2.5,
                format!("Scale 1:{scale} on {}", paper.word()),
            );
            say(50.0, 2.8, 2.5, format!("1 ken = {ken:.3} m"));
        }
        Language::Japanese => {
            say(3.0, 10.0, 2.5, format!("原稿 {}", settings.source));
            say(3.0, 2.8, 2.5, format!("縮尺 1:{scale}（{}）", paper.word()));
            say(50.0, 2.8, 2.5, format!("1 間 = {ken:.3} m"));
        }
    }
    View {
        name: "sheet".to_owned(),
        title: settings.title.clone(),
        marks,
    }
}
