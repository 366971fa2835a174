//! A house in the legacy form. It is written from the program of the house, where repetitions are expanded and
//! expressions have values; features without a legacy form are reported with their place.

use super::{legacy, own_widths, table};
use crate::messages::print as say;
use crate::messages::views;
use hsd_base::diagnostic::{Diagnostic, Diagnostics};
use hsd_base::source::{Source, Span};
use hsd_ir::ast::{
    Document, Era, RoofDirection, RoofKind, RoofLine, RoofMethod, RoofMode, RoofShape, RoofStyle,
    StoreyKind,
};
use hsd_ir::catalog::Catalog;
use hsd_ir::program::{Content, House, Picture, Program, Roofs, Storey, Unit, WallLine};
use std::collections::BTreeSet;
use std::fmt::Write;

/// Writes the houses of an XML file without errors in the legacy form, with its line ends.
///
/// # Errors `None` if the legacy form cannot express something; `out` receives the reason.
pub fn to_legacy(
    source: &Source,
    document: &Document,
    program: &Program,
    catalog: &Catalog,
    out: &mut Diagnostics,
) -> Option<String> {
    let mut writer = LegacyWriter {
        source,
        catalog,
        pictures: &program.pictures,
        text: String::new(),
        comments: super::xml::comments(source.text()),
        told: BTreeSet::new(),
        out,
    };
    for (place, codes) in super::xml::elements(source.text(), "random") {
        let span = source.span(place);
        writer.refuse(span, say::draw(span, codes));
    }
    for view in &document.views {
        writer.refuse(view.span, views::not_in_legacy(view.span));
    }
    for part in &document.parts {
        writer.refuse(part.span, say::own_part(part.span));
    }
    for (index, house) in program.houses.iter().enumerate() {
        if index > 0 {
            writer.text.push_str("%\n");
        }
        let written = document.houses.get(index);
        let facades = written.and_then(|house| house.structures.first());
        let own = facades.map(|_| own_widths::in_own_widths(house, catalog));
        let house = match (facades, &own) {
            (Some(structure), Some(None)) => {
                // All further messages would follow from that.
                writer.refuse(structure.span, say::facades(structure.span));
                continue;
            }
            (_, own) => own.as_ref().and_then(Option::as_ref).unwrap_or(house),
        };
        if let Some(purpose) = house.purpose {
            writer.refuse(purpose.span, say::roof_style(purpose.span));
        }
        if let Some(outline) = written.and_then(|house| house.outline.as_ref()) {
            writer.refuse(outline.span, say::outline(outline.span));
            continue;
        }
        let textures = written.into_iter().flat_map(|house| &house.textures);
        textures.for_each(|t| writer.refuse(t.span, say::gloss(t.span)));
        let parts = written.into_iter().flat_map(|house| &house.parts);
        parts.for_each(|p| writer.refuse(p.span, say::own_part(p.span)));
        let seed = written.and_then(|house| house.settings.seed.as_ref());
        writer.house(house, seed.map(|s| s.value));
    }
    writer.comments_before(usize::MAX);
    let LegacyWriter { text, told, .. } = writer;
    let end = super::line_end(source.text());
    told.is_empty().then(|| super::with_ends(text, end))
}

struct LegacyWriter<'s> {
    source: &'s Source,
    catalog: &'s Catalog,
    pictures: &'s [Picture],
    text: String,
    /// The comments with the offsets they belong to, and their lines; the last one first.
    comments: Vec<(usize, Vec<String>)>,
    /// The diagnostics reported so far, by code and place: repeated content would repeat them.
    told: BTreeSet<(u16, Span)>,
    out: &'s mut Diagnostics,
}

impl LegacyWriter<'_> {
    fn refuse(&mut self, span: Span, message: Diagnostic) {
        if self.told.insert((message.code.0, span)) {
            self.out.push(message);
        }
    }

    fn house(&mut self, house: &House, seed: Option<u64>) {
        self.comments_before(self.source.text_range(house.span).start);
        let [x, y, z] = house.origin;
        if z != 0.0 || house.plinth != 0.0 {
            self.refuse(house.span, say::raised(self.head(house.span)));
        }
        let _ = write!(self.text, "{x} {y}");
        if house.azimuth != 180.0 {
            let _ = write!(self.text, " {}", house.azimuth);
        }
        self.text.push('\n');
        let heights: Vec<String> = house
            .storeys
            .iter()
            .map(|s| format!("{:?}", s.height))
            .collect();
        let _ = writeln!(self.text, "{}", heights.join(" "));
        if !house.name.is_empty() {
            let _ = writeln!(self.text, "name {}", house.name);
        }
        if house.unit_shaku != 3.0 {
            let _ = writeln!(self.text, "unit {:?}", house.unit_shaku);
        }
        if let Some(seed) = seed {
            let _ = writeln!(self.text, "seed {seed}");
        }
        if house.street {
            self.text.push_str("street yes\n");
        }
        if let Some(age) = &house.age {
            let _ = writeln!(self.text, "age {:?}", age.years);
            if age.era != Era::All {
                let _ = writeln!(self.text, "era {}", age.era.word());
            }
        }
        self.fittings(house);
        self.roof_settings(&house.roofs);
        self.text.push('\n');
        for (index, storey) in house.storeys.iter().enumerate() {
            self.storey(storey, index + 1 < house.storeys.len());
        }
        self.roof_lines(&house.roofs);
    }

    /// Refuses what a house has besides outer walls and roofs, each at its element.
    fn fittings(&mut self, house: &House) {
        let mut found: Vec<Span> = vec![];
        found.extend(house.platform.iter().map(|p| p.span));
        found.extend(house.finials.iter().map(|f| f.span));
        found.extend(house.puts.iter().map(|p| p.span));
        found.extend(house.grounds.iter().map(|g| g.span));
        for storey in &house.storeys {
            let order = &storey.order;
            found.extend(order.posts.iter().map(|p| p.span));
            found.extend(order.veranda.iter().map(|v| v.span));
            found.extend(order.brackets.iter().map(|b| b.span));
            let inner = storey.loops.iter().filter(|walk| walk.inner);
            found.extend(inner.map(|walk| walk.span));
            found.extend(storey.rooms.iter().map(|r| r.span));
            found.extend(storey.fixtures.iter().map(|f| f.span));
        }
        for span in found {
            let head = self.head(span);
            // A monument is written as one element.
            let text = &self.source.text()[self.source.text_range(head)];
            let name = text.trim_start_matches('<').split([' ', '/', '>']).next();
            let element = match name.unwrap_or_default() {
                // Outer walls may be loops too.
                "Loop" => "Loop inner=\"yes\"".to_owned(),
                name => name.to_owned(),
            };
            self.refuse(head, say::no_such_element(head, &element));
        }
    }

    fn roof_settings(&mut self, roofs: &Roofs) {
        let wished = roofs.wished.is_some() && roofs.lines.is_empty();
        let usual = roofs.method == RoofMethod::default();
        match roofs.mode {
            RoofMode::Explicit => self.text.push_str("roofs explicit\n"),
            RoofMode::Auto if wished && usual => self.text.push_str("roofs auto\n"),
            RoofMode::Auto => {}
        }
        if !usual {
            let name = RoofMethod::ALL.iter().find(|(_, m)| *m == roofs.method);
            let _ = writeln!(self.text, "method {}", name.map_or("", |(n, _)| n));
        }
    }

    fn storey(&mut self, storey: &Storey, more: bool) {
        if storey.kind == StoreyKind::Parapet {
            let span = self.head(storey.span);
            self.refuse(storey.span, say::parapet(span));
        }
        let outer: Vec<_> = storey.loops.iter().filter(|walk| !walk.inner).collect();
        let [walk] = outer[..] else {
            let second = outer.get(1).map_or(storey.span, |walk| walk.span);
            let message = say::second_walk(self.head(second));
            return self.refuse(second, message);
        };
        if walk.hole {
            self.refuse(walk.span, say::second_walk(self.head(walk.span)));
        }
        let voids = self.way(walk.start, walk.span);
        let last = walk.lines.len().saturating_sub(1);
        for (index, line) in walk.lines.iter().enumerate() {
            self.comments_before(self.source.text_range(line.span).start);
            if index == 0 {
                self.text.push_str(&voids);
            }
            let control = match (index == last, more) {
                (true, true) => "^",
                (true, false) => "",
                (false, _) => self.turn(line),
            };
            self.line(line, control);
        }
    }

    /// Returns the letter of a turn.
    fn turn(&mut self, line: &WallLine) -> &'static str {
        match line.turn {
            90.0 if line.units.is_empty() => "R",
            90.0 => "",
            -90.0 => "L",
            degrees => {
                self.refuse(line.span, say::odd_turn(self.head(line.span), degrees));
                ""
            }
        }
    }

    fn line(&mut self, line: &WallLine, control: &str) {
        if line.units.is_empty() && control.is_empty() && self.text.ends_with('\n') {
            return; // a last line without parts; a blank one would end the walls all the same
        }
        let codes: Vec<_> = line.units.iter().map(|unit| self.code(unit)).collect();
        let codes = codes
            .into_iter()
            .map(|code| hsd_ir::ast::CodeText::new(&code));
        // The voids that lead to the start may be on the line already, as whole codes.
        legacy::codes(codes, &mut self.text, control);
        self.text.push('\n');
    }

    /// Returns the code of a unit.
    fn code(&mut self, unit: &Unit) -> String {
        let (code, width) = match &unit.content {
            Content::Void => (".....", 1.0),
            Content::Part(id) => {
                let part = self.catalog.part(*id);
                (part.code(), part.width())
            }
            Content::Picture(id) => {
                let picture = self.pictures.get(id.0 as usize);
                (picture.map_or("", |p| &*p.name), 1.0)
            }
            Content::Split(_) => {
                self.refuse(unit.span, say::split(unit.span));
                return String::new();
            }
        };
        let code = code.to_owned();
        if code.len() > 5 || !code.bytes().all(|b| (b' '..=b'~').contains(&b)) {
            self.refuse(unit.span, say::long_name(unit.span, &code));
        }
        if unit.width != width {
            self.refuse(
                unit.span,
                say::own_width(unit.span, code.trim_end(), unit.width, width),
            );
        }
        if unit.height.is_some() {
            self.refuse(unit.span, say::own_height(unit.span, code.trim_end()));
        }
        if unit.reflection.is_some() {
            self.refuse(unit.span, say::gloss(unit.span));
        }
        code
    }

    /// Writes voids and turns that lead to the start of a storey: whole lines, or voids before the first part.
    fn way(&mut self, (a, b): (f64, f64), span: Span) -> String {
        if a.fract() != 0.0 || b.fract() != 0.0 || a.abs().max(b.abs()) > 1000.0 {
            self.refuse(span, say::start_between(self.head(span)));
            return String::new();
        }
        let (mut text, mut heading) = (String::new(), 0);
        let mut turn_to = |text: &mut String, target: i32| {
            // The end of a line turns right by default.
            let right = if text.ends_with('.') { "\n" } else { "R\n" };
            match (target - heading).rem_euclid(4) {
                1 => text.push_str(right),
                2 => text.extend([right, "R\n"]),
                3 => text.push_str("L\n"),
                _ => {}
            }
            heading = target;
        };
        for (length, ahead, back) in [(a, 0, 2), (b, 1, 3)] {
            if length != 0.0 {
                turn_to(&mut text, if length > 0.0 { ahead } else { back });
                text.push_str(&".....".repeat(length.abs() as usize));
            }
        }
        turn_to(&mut text, 0);
        text
    }

    fn roof_lines(&mut self, roofs: &Roofs) {
        let automatic = roofs.mode == RoofMode::Auto;
        if automatic && let Some(span) = style_span(&roofs.style) {
            self.refuse(span, say::roof_style(span));
        }
        let styles = roofs.lines.iter().map(|line| &line.style);
        for style in styles.chain([&roofs.style]) {
            let wall = style.gable_wall.map(|s| s.span);
            let paint = style.paint.map(|s| s.span);
            let offset = style.offset.map(|s| s.span);
            for span in wall.into_iter().chain(paint).chain(offset) {
                self.refuse(span, say::eaves_look(span));
            }
        }
        let lines: Vec<String> = roofs
            .lines
            .iter()
            .map(|line| roof(line, &roofs.style))
            .collect();
        let mut columns = table::Table::default();
        lines.iter().for_each(|line| columns.hold(line));
        for (index, (line, words)) in roofs.lines.iter().zip(&lines).enumerate() {
            if index == 0 {
                self.text.push('\n');
            }
            self.comments_before(self.source.text_range(line.span).start);
            columns.line(words, &mut self.text);
            self.text.push('\n');
        }
    }

    fn comments_before(&mut self, place: usize) {
        while let Some((_, lines)) = self.comments.pop_if(|(at, _)| *at <= place) {
            for line in lines {
                let _ = writeln!(self.text, "{}", format!("# {line}").trim_end());
            }
        }
    }

    /// Returns the first line of a long construct.
    fn head(&self, span: Span) -> Span {
        let range = self.source.text_range(span);
        let first = self.source.text()[range.clone()].lines().next();
        self.source
            .span(range.start..range.start + first.unwrap_or_default().len())
    }
}

/// Returns the words of a roof line; settings of all roofs are repeated for each.
fn roof(line: &RoofLine, all: &RoofStyle) -> String {
    let own = &line.style;
    let letter = |kind: RoofKind| {
        RoofKind::ALL
            .iter()
            .find(|(_, k)| *k == kind)
            .map_or('*', |(l, _)| *l)
    };
    let kind = own
        .kind
        .as_ref()
        .or(all.kind.as_ref())
        .map_or('*', |k| letter(k.value));
    let direction = line.direction.as_ref().map_or('*', |d| match d.value {
        RoofDirection::AlongFront => 'X',
        RoofDirection::AcrossFront => 'Y',
        RoofDirection::Front => 'F',
        RoofDirection::Back => 'B',
        RoofDirection::Left => 'L',
        RoofDirection::Right => 'R',
    });
    let height = line
        .height
        .as_ref()
        .map_or("*".into(), |h| format!("{:?}", h.value));
    let shape: Option<RoofShape> = own.shape.as_ref().or(all.shape.as_ref()).map(|s| s.value);
    let mut words = format!(
        "{kind} {direction} {height} {}",
        shape.map_or("*", RoofShape::letters)
    );
    for corner in line.corners.value {
        let _ = write!(words, " {corner}");
    }
    let numbers = [
        ('P', &own.pitch, &all.pitch),
        ('E', &own.eaves, &all.eaves),
        ('G', &own.verge, &all.verge),
        ('T', &own.thickness, &all.thickness),
        ('S', &own.sori, &all.sori),
        ('C', &own.gable, &all.gable),
        ('R', &own.ratio, &all.ratio),
    ];
    for (letter, own, all) in numbers {
        if let Some(number) = own.as_ref().or(all.as_ref()) {
            let _ = write!(words, " {letter}{:?}", number.value);
        }
    }
    if let Some(noshi) = own.noshi.as_ref().or(all.noshi.as_ref()) {
        let _ = write!(words, " M{}", noshi.value);
    }
    if own
        .plain_ridge
        .as_ref()
        .or(all.plain_ridge.as_ref())
        .is_some_and(|p| p.value)
    {
        words.push_str(" O");
    }
    words
}

/// Returns the place of a setting for all roofs.
fn style_span(style: &RoofStyle) -> Option<Span> {
    let numbers = [
        &style.pitch,
        &style.eaves,
        &style.verge,
        &style.thickness,
        &style.sori,
        &style.gable,
        &style.ratio,
    ];
    let spans = [
        style.kind.as_ref().map(|s| s.span),
        style.shape.as_ref().map(|s| s.span),
        style.noshi.as_ref().map(|s| s.span),
        style.plain_ridge.as_ref().map(|s| s.span),
    ];
    let numbers = numbers.into_iter().map(|n| n.as_ref().map(|n| n.span));
    spans.into_iter().chain(numbers).flatten().reduce(Span::to)
}
