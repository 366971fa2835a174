//! A drawn ring in the XML form: rows whose codes, parts and repetitions stay where they are, with the content between
//! them.

use super::change::{CELL, Change, padded};
use super::draft::DraftPiece;
use super::refuse;
use crate::format::Edit;
use crate::stroke::sheet::{Cell, Form, Home, Reason, Sheet, What, name};
use hsd_base::diagnostic::Text;
use hsd_base::geometry::SAME;
use hsd_syntax::parse::syntax::Element;
use std::ops::Range;

/// Returns the edits of the rows of a ring.
pub(super) fn edits(change: &Change<'_>) -> Result<Vec<Edit>, Text> {
    let mut edits = vec![];
    if change.starts_anew() {
        edits.push(start(change)?);
    }
    let mut anchor = 0;
    for (index, line) in change.draft.lines.iter().enumerate() {
        let turn = change.turn(index);
        match line.base {
            Some(base) => {
                if change.differs(base) {
                    row(change, base, &line.pieces, &mut edits);
                }
                edits.extend(turned(change, base, turn)?);
                anchor = base;
            }
            None => edits.push(new_row(change, anchor, &line.pieces, turn)),
        }
    }
    for wall in 0..change.rows.len() {
        if !change.draft.lines.iter().any(|l| l.base == Some(wall)) {
            removed(change, wall, &mut edits);
        }
    }
    Ok(edits)
}

fn element_of<'a>(change: &Change<'a>, wall: usize) -> &'a Element {
    let index = match change.rows[wall].home {
        Home::Element(element) => element,
        Home::Line(_) => 0,
    };
    &change.sheet.outline.elements[index]
}

/// Returns the edit of the attribute that specifies the start of the walk.
fn start(change: &Change<'_>) -> Result<Edit, Text> {
    let Home::Element(row) = change.rows[0].home else {
        return Err(refuse::no_such_place());
    };
    let outline = change.sheet.outline;
    let mut around = outline.around(row).skip(1);
    let owner = around.find(|e| matches!(name(&outline.elements[*e]), "Storey" | "Loop"));
    let Some(owner) = owner else {
        return Err(Reason::First.text());
    };
    if let Some(reason) = change
        .sheet
        .around_fixed(owner)
        .filter(|r| *r != Reason::Repeat)
    {
        return Err(reason.text());
    }
    let element = &outline.elements[owner];
    let rows = change.ring.walls[0].from;
    let to = change.draft.start;
    let Some(given) = element.attribute("start") else {
        let at = element.name.end;
        let text = format!(" start=\"{} {}\"", plain(to.x), plain(to.y));
        return Ok(Edit {
            range: at..at,
            text,
        });
    };
    let mut numbers = given
        .value
        .split([' ', ',', '\t', '\n'])
        .filter(|w| !w.is_empty());
    let mut number = || numbers.next().and_then(|w| w.parse::<f64>().ok());
    let (Some(a), Some(b), true) = (number(), number(), given.expressions.is_empty()) else {
        return Err(Reason::Computed.text());
    };
    // Rows of voids may lead on from there.
    let (a, b) = (a + to.x - rows.x, b + to.y - rows.y);
    if a.abs() < SAME && b.abs() < SAME && !change.ring.hole {
        return Ok(without(change.sheet, &given.range));
    }
    let text = format!("{} {}", plain(a), plain(b));
    let range = given.inner.clone();
    Ok(Edit { range, text })
}

/// Removes an attribute, with the blanks before it.
pub(super) fn without(sheet: &Sheet<'_>, attribute: &Range<usize>) -> Edit {
    let before = sheet.text[..attribute.start].trim_end().len();
    Edit {
        range: before..attribute.end,
        text: String::new(),
    }
}

/// Formats a number without needless decimals.
pub(super) fn plain(number: f64) -> String {
    hsd_export::number::Number(number).to_string()
}

/// Returns the edit of the turn at the end of a row, if it changes.
fn turned(change: &Change<'_>, wall: usize, turn: Option<&str>) -> Result<Option<Edit>, Text> {
    let Some(turn) = turn else { return Ok(None) };
    let element = element_of(change, wall);
    let usual = if change.ring.hole { "L" } else { "R" };
    let Some(given) = element.attribute("turn") else {
        let at = element.name.end;
        let text = format!(" turn=\"{turn}\"");
        return Ok((turn != usual).then_some(Edit {
            range: at..at,
            text,
        }));
    };
    if !given.expressions.is_empty() {
        return Err(Reason::Computed.text());
    }
    let degrees = if turn == "R" { "90" } else { "-90" };
    if given.value.trim() == turn || given.value.trim() == degrees {
        return Ok(None);
    }
    if turn == usual {
        return Ok(Some(without(change.sheet, &given.range)));
    }
    let range = given.inner.clone();
    Ok(Some(Edit {
        range,
        text: turn.to_owned(),
    }))
}

/// Adds a new row after another one.
fn new_row(change: &Change<'_>, wall: usize, pieces: &[DraftPiece], turn: Option<&str>) -> Edit {
    let at = element_of(change, wall).range.end;
    let usual = if change.ring.hole { "L" } else { "R" };
    let turn = turn.filter(|t| *t != usual);
    let turn = turn.map_or(String::new(), |t| format!(" turn=\"{t}\""));
    let gap = gap_before(change.sheet.text, element_of(change, wall).range.start);
    let content = rendered(change, pieces, Style::Codes, "", true);
    let text = format!("{gap}<Row{turn}>{content}</Row>");
    Edit {
        range: at..at,
        text,
    }
}

/// Returns the line end and the blanks before an element that is first on its line.
pub(super) fn gap_before(text: &str, at: usize) -> &str {
    let head = text[..at].trim_end_matches([' ', '\t']);
    if !head.ends_with(['\n', '\r']) {
        return "";
    }
    let start = head.strip_suffix('\n').unwrap_or(head);
    let start = start.strip_suffix('\r').unwrap_or(start);
    &text[start.len()..at]
}

/// Removes a row.
fn removed(change: &Change<'_>, wall: usize, edits: &mut Vec<Edit>) {
    let range = element_of(change, wall).range.clone();
    edits.extend(gone(change.sheet, range));
}

/// Removes an element with its line, if it is alone on it; comments in it stay.
pub(super) fn gone(sheet: &Sheet<'_>, range: Range<usize>) -> Vec<Edit> {
    let mut edits = vec![];
    let gap = gap_before(sheet.text, range.start).len();
    let mut from = range.start - gap;
    let nothing = |range| Edit {
        range,
        text: String::new(),
    };
    let comments = sheet.outline.comments.iter();
    for comment in comments.filter(|c| range.start <= c.start && c.end <= range.end) {
        edits.push(nothing(from.max(range.start)..comment.start));
        from = comment.end;
    }
    edits.push(nothing(from..range.end));
    edits
}

/// The form in which new parts are written.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Style {
    Codes,
    Parts,
}

/// Returns the edits of a remaining row.
fn row(change: &Change<'_>, wall: usize, pieces: &[DraftPiece], edits: &mut Vec<Edit>) {
    let row = &change.rows[wall];
    let first = row.leads();
    let (mut next, mut kept, mut come) = (first, None, 0);
    for (number, piece) in pieces.iter().enumerate() {
        let own = piece.old.filter(|(w, c)| *w == wall && *c >= next);
        let Some((_, cell)) = own else { continue };
        gap(
            change,
            wall,
            (kept, next..cell),
            &pieces[come..number],
            edits,
        );
        recount(&row.cells[cell], piece, edits);
        (kept, next, come) = (Some(cell), cell + 1, number + 1);
    }
    gap(
        change,
        wall,
        (kept, next..row.cells.len()),
        &pieces[come..],
        edits,
    );
}

/// Changes the count of a remaining `repeat`.
fn recount(cell: &Cell, piece: &DraftPiece, edits: &mut Vec<Edit>) {
    if let Form::Run(num, count) = &cell.form
        && *count != piece.count
    {
        edits.push(Edit {
            range: num.clone(),
            text: piece.count.to_string(),
        });
    }
}

/// Returns the removed and the new source between two remaining cells.
fn gap(
    change: &Change<'_>,
    wall: usize,
    (kept, gone): (Option<usize>, Range<usize>),
    come: &[DraftPiece],
    edits: &mut Vec<Edit>,
) {
    let cells = &change.rows[wall].cells;
    let (mut gone, mut come) = (gone, come);
    let mut at = kept.map(|c| (c, cells[c].range.end));
    if let (Some(first), Some(new)) = (gone.clone().next(), come.first()) {
        if let Form::Part(element) = cells[first].form
            && let Some(edit) = recoded(change.sheet, element, new)
        {
            edits.push(edit);
            at = Some((first, cells[first].range.end));
            come = &come[1..];
        } else {
            let style = if cells[first].form == Form::Code {
                Style::Codes
            } else {
                style(cells)
            };
            let glue = gap_before(change.sheet.text, cells[first].range.start);
            let ends = ends_line(change, wall, first);
            let text = rendered(change, come, style, glue, ends);
            edits.push(Edit {
                range: cells[first].range.clone(),
                text,
            });
            come = &[];
        }
        gone.start += 1;
    }
    gone.for_each(|c| edits.extend(deleted(change.sheet, cells, c)));
    if !come.is_empty() {
        edits.extend(inserted(change, wall, at, come));
    }
}

/// Returns the edit that replaces the code of a `Part`, unless its width or height is given for the old one.
fn recoded(sheet: &Sheet<'_>, element: usize, piece: &DraftPiece) -> Option<Edit> {
    let own = &sheet.outline.elements[element];
    let said = own.attribute("width").is_some() || own.attribute("height").is_some();
    let code = own.attribute("code")?;
    let whole = !said || piece.instead;
    (whole && piece.old.is_none()).then(|| Edit {
        range: code.inner.clone(),
        text: escaped(&piece.code),
    })
}

fn escaped(code: &str) -> String {
    quick_xml::escape::escape(code).into_owned()
}

/// Removes a cell, with its line if it is alone on it.
fn deleted(sheet: &Sheet<'_>, cells: &[Cell], cell: usize) -> Vec<Edit> {
    let (text, range) = (sheet.text, cells[cell].range.clone());
    let rest = text[range.end..].trim_start_matches([' ', '\t']);
    if cells[cell].form != Form::Code {
        if rest.starts_with(['\r', '\n']) {
            return gone(sheet, range);
        }
        let gap = gap_before(text, range.start).len();
        let mut edits = gone(sheet, range.clone());
        edits[0].range.start += gap;
        return edits;
    }
    // Padding blanks of the code before it are removed at the end of a line.
    let before = cell.checked_sub(1).map(|c| &cells[c]);
    let beside = before.filter(|b| b.form == Form::Code && b.range.end == range.start);
    let last = cells
        .get(cell + 1)
        .is_none_or(|n| n.range.start != range.end);
    let blanks = beside.filter(|_| last).map_or(0, |b| {
        let written = &text[b.range.clone()];
        let blanks = written.len() - written.trim_end_matches(' ').len();
        if blanks < written.len() { blanks } else { 0 }
    });
    let gap = gap_before(text, range.start).len();
    let alone = gap > 0 && rest.starts_with(['\r', '\n']);
    let start = range.start - if alone { gap } else { blanks };
    vec![Edit {
        range: start..range.end,
        text: String::new(),
    }]
}

/// Returns the form in which a row writes its parts.
fn style(cells: &[Cell]) -> Style {
    let codes = cells.iter().any(|c| c.form == Form::Code);
    let parts = cells.iter().any(|c| matches!(c.form, Form::Part(_)));
    if parts && !codes {
        Style::Parts
    } else {
        Style::Codes
    }
}

/// Returns true if nothing follows a cell in its line of codes.
fn ends_line(change: &Change<'_>, wall: usize, cell: usize) -> bool {
    let own = &change.rows[wall].cells[cell].range;
    let rest = change.sheet.text[own.end..].trim_start_matches([' ', '\t']);
    // A comment does not separate codes.
    !rest.starts_with("<!--") && rest.starts_with(['<', '\n', '\r'])
}

/// Inserts parts after a cell, or before the first one.
fn inserted(
    change: &Change<'_>,
    wall: usize,
    after: Option<(usize, usize)>,
    come: &[DraftPiece],
) -> Option<Edit> {
    let (text, cells) = (change.sheet.text, &change.rows[wall].cells);
    let style = style(cells);
    let Some((cell, at)) = after else {
        let first = cells.get(change.rows[wall].leads())?;
        let at = first.range.start;
        let glue = gap_before(text, at);
        let style = if first.form == Form::Code {
            Style::Codes
        } else {
            style
        };
        let mut new = rendered(change, come, style, glue, false);
        if style == Style::Parts {
            new += glue;
        }
        return Some(Edit {
            range: at..at,
            text: new,
        });
    };
    let own = &cells[cell];
    let glue = gap_before(text, own.range.start);
    let style = match own.form {
        Form::Code => Style::Codes,
        Form::Part(_) => Style::Parts,
        _ => style,
    };
    let mut new = rendered(change, come, style, glue, ends_line(change, wall, cell));
    match (style, &own.form) {
        (Style::Codes, Form::Code) => {
            let written = &text[own.range.clone()];
            new.insert_str(0, &padded(written)[written.len()..]);
        }
        _ => new.insert_str(0, glue),
    }
    Some(Edit {
        range: at..at,
        text: new,
    })
}

/// Renders pieces as source. `ends` = nothing follows them in their line of codes.
fn rendered(
    change: &Change<'_>,
    pieces: &[DraftPiece],
    style: Style,
    glue: &str,
    ends: bool,
) -> String {
    let mut text = String::new();
    let mut open = false; // the last code is not filled up yet
    for (number, piece) in pieces.iter().enumerate() {
        let (written, code) = written(change, piece, style);
        if !code && number > 0 {
            text += glue;
        }
        if code && open {
            text = fill(text);
        }
        text += &written;
        open = code;
    }
    if open && !ends { fill(text) } else { text }
}

/// Pads the code at the end of a string with blanks.
fn fill(text: String) -> String {
    let code = text.rfind('>').map_or(0, |i| i + 1);
    let filled = padded(&text[code..]);
    text[..code].to_owned() + &filled
}

/// Returns a copy of a source file with its comments blanked out, at the same offsets.
fn uncommented(text: &str) -> String {
    let mut copy = String::new();
    let mut rest = text;
    while let Some((before, behind)) = rest.split_once("<!--") {
        copy += before;
        rest = behind.split_once("-->").map_or("", |(_, after)| after);
    }
    copy + rest
}

/// Renders a piece; returns also whether it is a code in columns.
fn written(change: &Change<'_>, piece: &DraftPiece, style: Style) -> (String, bool) {
    if let Some((wall, cell)) = piece.old {
        let own = &change.rows[wall].cells[cell];
        let slice = change.slice((wall, cell));
        return match &own.form {
            Form::Code if piece.what == What::Void => (piece.code.clone(), true),
            Form::Code => (slice.trim_end_matches(' ').to_owned(), true),
            Form::Run(num, _) => {
                let (from, to) = (num.start - own.range.start, num.end - own.range.start);
                let count = piece.count.to_string();
                let copy = [&slice[..from], &count, &slice[to..]].concat();
                (uncommented(&copy), false)
            }
            _ => (uncommented(slice), false),
        };
    }
    let columns = piece.code.len() <= CELL
        && piece
            .code
            .bytes()
            .all(|b| b.is_ascii_graphic() || b == b' ');
    let plain = !piece.code.contains(['<', '&', '{', '}', '>']);
    match style == Style::Codes && columns && plain {
        true => (piece.code.clone(), true),
        false => (format!("<Part code=\"{}\"/>", escaped(&piece.code)), false),
    }
}
