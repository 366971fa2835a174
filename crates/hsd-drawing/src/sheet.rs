//! Views side by side on a sheet of paper, with a frame and a title block.

use crate::Settings;
use crate::paper::{Anchor, Mark, Role, Shape, Sheet, View, width};
use glam::{DVec2, dvec2};
use hsd_base::diagnostic::Language;

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

/// Views side by side, by their numbers in all rows, and their common size.
struct Line {
    views: Vec<usize>,
    size: DVec2,
}

/// Returns the space for views on a sheet.
fn inner(paper: Paper) -> DVec2 {
    paper.size() - 2.0 * (MARGIN + SPACE / 2.0)
}

/// Divides rows of views of these sizes into lines. None if they do not fit on a sheet. A row too long for the sheet goes
/// on below.
fn lines(rows: &[Vec<DVec2>], paper: Paper) -> Option<Vec<Line>> {
    let inner = inner(paper);
    let mut lines: Vec<Line> = vec![];
    let mut number = 0;
    for row in rows {
        let mut begun = false;
        for own in row {
            let last = lines.last_mut();
            let last = last.filter(|l| begun && l.size.x + SPACE + own.x <= inner.x);
            match last {
                Some(line) => {
                    line.size = dvec2(line.size.x + SPACE + own.x, line.size.y.max(own.y));
                    line.views.push(number);
                }
                None => lines.push(Line {
                    views: vec![number],
                    size: *own,
                }),
            }
            begun = true;
            number += 1;
        }
    }
    let fits = lines.iter().all(|l| l.size.x <= inner.x) && free(&lines, paper) >= 0.0;
    fits.then_some(lines)
}

/// The height that lines of views and the title block leave free; it stands beside the last line if there is room.
fn free(lines: &[Line], paper: Paper) -> f64 {
    let high: f64 = lines.iter().map(|l| l.size.y + SPACE).sum();
    let below = if has_block(lines, paper) {
        0.0
    } else {
        BLOCK.y + SPACE
    };
    inner(paper).y - (high - SPACE) - below
}

/// Returns true if the title block stands beside the last line.
fn has_block(lines: &[Line], paper: Paper) -> bool {
    let last = lines.last();
    last.is_none_or(|l| l.size.x + SPACE + BLOCK.x <= inner(paper).x)
}

/// Returns whether views drawn at one scale fit on a sheet if what they show is so many times as large.
pub fn fits(rows: &[Vec<View>], paper: Paper, times: f64) -> bool {
    let sizes = |row: &Vec<View>| row.iter().map(|v| v.size_at(times)).collect();
    lines(&rows.iter().map(sizes).collect::<Vec<_>>(), paper).is_some()
}

/// Returns rows of views on a sheet; none if they do not fit.
pub fn arranged(rows: &[Vec<View>], paper: Paper, settings: &Settings) -> Option<Sheet> {
    let sizes = |row: &Vec<View>| row.iter().map(|v| v.bounds().size()).collect();
    let lines = lines(&rows.iter().map(sizes).collect::<Vec<_>>(), paper)?;
    let (size, inner) = (paper.size(), inner(paper));
    let all: Vec<&View> = rows.iter().flatten().collect();
    let gap = SPACE + free(&lines, paper) / (lines.len() + 1) as f64;
    let mut top = size.y - MARGIN - SPACE / 2.0 - (gap - SPACE);
    let mut views = vec![];
    for (number, line) in lines.iter().enumerate() {
        let beside = number + 1 == lines.len() && has_block(&lines, paper);
        let room = inner.x - if beside { BLOCK.x + SPACE } else { 0.0 };
        let spare = (room - line.size.x).max(0.0) / (line.views.len() + 1) as f64;
        let mut x = MARGIN + SPACE / 2.0;
        for view in line.views.iter().map(|n| all[*n]) {
            let bounds = view.bounds();
            x += spare;
            let at = dvec2(x, top - line.size.y);
            views.push(view.moved(at - bounds.low));
            x += bounds.size().x + SPACE;
        }
        top -= line.size.y + gap;
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
        drawn: DVec2::ZERO,
        marks,
    }
}
