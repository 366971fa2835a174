//! Outlines as surveyed: `Outline`, `Hole`; and what stands on their sides: `Walls`, `Side`, `fill`, `door`.

use crate::parse::schema::attributes::CORNERS_MOST;
use crate::parse::schema::vocabulary::ON;
use crate::parse::schema::{Schema, Tag};
use crate::parse::xml::edits;
use crate::parse::xml::read::{AllowedChild, Attributes, Reader};
use crate::parse::xml::tree::Element;
use crate::parse::xml::tree::chars::is_blank;
use glam::dvec2;
use hsd_base::source::{Span, Spanned};
use hsd_base::text;
use hsd_ir::ast::{
    CodeText, Half, Hole, House, On, Outline, OutlinePart, Points, SidePart, SideWall, Stand,
    Storey, Walls,
};
use hsd_ir::messages::xml as say;

impl<'t> Reader<'t, '_> {
    /// Reads the outline of a house; `settings` are the attributes of the house.
    pub(in crate::parse::xml) fn only_outline(
        &mut self,
        schema: &'static Schema,
        element: &'t Element<'t>,
        settings: &Attributes<'t>,
        house: &mut House,
    ) {
        let read = self.outline(schema, element, settings);
        match house.outline.as_ref().map(|first| first.span) {
            Some(first) => self.second(schema.name, "House", first, element),
            None => house.outline = Some(Box::new(read)),
        }
    }

    /// Reads what stands on the sides of the outline in a storey.
    pub(in crate::parse::xml) fn only_walls(
        &mut self,
        schema: &'static Schema,
        element: &'t Element<'t>,
        parent: &Element<'t>,
        storey: &mut Storey,
    ) {
        let of = self.attributes(schema, element);
        let shares = ["long", "short"].map(|name| self.usual(&of, name));
        let at = self.point(&of, "at");
        let rest = self.text(&of, "rest");
        let walls = Walls {
            span: self.start(element),
            rest: rest.map(|code| Spanned::new(CodeText::new(&code.value), code.span)),
            part: (shares != [1.0; 2]).then(|| OutlinePart {
                shares,
                at: at.map_or([0.5; 2], |at| at.value.into()),
            }),
            sides: self.side_walls(element, schema),
        };
        match storey.walls.as_ref().map(|first| first.span) {
            Some(first) => self.second(schema.name, parent.name, first, element),
            None => storey.walls = Some(Box::new(walls)),
        }
    }

    fn second(&mut self, name: &str, parent: &str, first: Span, element: &Element<'_>) {
        let fixes = edits::of_two(self.reporter, self.tree, first, element);
        self.reporter.at(&element.name_range, |s| {
            say::second_of(s, name, parent, first, fixes)
        });
    }

    pub(in crate::parse::xml) fn outline(
        &mut self,
        schema: &'static Schema,
        element: &'t Element<'t>,
        settings: &Attributes<'t>,
    ) -> Outline {
        let of = self.attributes(schema, element);
        let points = self.points(&of, "points");
        let is_no = |square: &str| square.trim_matches(is_blank) == "no";
        let square = match of.get("square") {
            Some(square) if is_no(square.value.as_str()) => {
                Some(Spanned::new(0.0, self.value_span(square)))
            }
            _ => self.number(&of, "square"),
        };
        let join = self.number(&of, "join");
        let front = self.whole_number(&of, "front");
        let front = front.and_then(|f| Some(Spanned::new(u32::try_from(f.value).ok()?, f.span)));
        let (street, neighbour) = (
            self.positions(&of, "street"),
            self.positions(&of, "neighbour"),
        );
        let mut holes = vec![];
        for node in self.children(element, schema.content()) {
            if let AllowedChild::Element(schema, child) = node {
                let of = self.attributes(schema, child);
                self.no_children(child);
                let points = self.points(&of, "points");
                holes.extend(points.map(|points| Hole {
                    span: self.whole(child),
                    points,
                }));
            }
        }
        Outline {
            span: self.whole(element),
            // Points that cannot be read were reported; nothing else is, then.
            points: points.unwrap_or_else(|| Spanned::new(vec![], self.start(element))),
            square,
            join,
            front,
            street,
            neighbour,
            stand: match settings.get("azimuth") {
                Some(_) => Stand::Facing,
                None => Stand::Surveyed(0.0),
            },
            holes,
        }
    }

    /// Reads corners: pairs of numbers, divided by blanks or commas.
    fn points(&mut self, of: &Attributes<'t>, name: &str) -> Option<Points> {
        let attribute = of.get(name)?;
        let divides = |c| is_blank(c) || matches!(c, ',' | ';' | '、' | '\n' | '\r');
        let (mut numbers, mut good) = (vec![], true);
        for piece in self.lengths(of, name, divides) {
            let span = self.reporter.span(&attribute.value.range(piece.clone()));
            match self.number_in(of, name, piece) {
                Some(value) => numbers.push(Spanned::new(value, span)),
                None => good = false,
            }
        }
        let whole = self.value_span(attribute);
        if numbers.len() as u64 > 2 * CORNERS_MOST {
            let count = numbers.len() / 2;
            self.reporter
                .push(|| say::too_many_corners(whole, count, CORNERS_MOST));
            return None;
        }
        let (pairs, odd) = numbers.as_chunks::<2>();
        if let [last] = odd
            && good
        {
            let (span, count) = (last.span, numbers.len());
            self.reporter.push(|| say::odd_corner(span, name, count));
            return None;
        }
        let point =
            |[e, n]: &[Spanned<f64>; 2]| Spanned::new(dvec2(e.value, n.value), e.span.to(n.span));
        good.then(|| Spanned::new(pairs.iter().map(point).collect(), whole))
    }

    fn side_walls(&mut self, element: &'t Element<'t>, schema: &'static Schema) -> Vec<SideWall> {
        let mut sides = vec![];
        for node in self.children(element, schema.content()) {
            if let AllowedChild::Element(schema, child) = node {
                let side = match self.again.side(child) {
                    Some(known) => known,
                    None => self.side_wall(schema, child),
                };
                sides.push(side);
            }
        }
        sides
    }

    fn side_wall(&mut self, schema: &'static Schema, element: &'t Element<'t>) -> SideWall {
        let of = self.attributes(schema, element);
        let on = self.on(&of);
        let side = SideWall {
            span: self.whole(element),
            on: on.unwrap_or_else(|| Spanned::new(On::Any, self.start(element))),
            parts: self.side_parts(element, schema),
        };
        self.again.keep_side(element, &side);
        side
    }

    /// Reads a kind of side, or the number of one.
    fn on(&mut self, of: &Attributes<'t>) -> Option<Spanned<On>> {
        let written = of.get("on")?;
        let text = written.value.as_str().trim_matches(is_blank);
        if !text.starts_with(|c: char| c.is_ascii_digit()) {
            return self.choice(of, "on", &ON);
        }
        let number = self.number(of, "on")?;
        if number.value.fract() == 0.0 {
            return Some(Spanned::new(On::Number(number.value as u32), number.span));
        }
        let near = number.value.round().to_string();
        self.reporter.push(|| {
            let bounds = text!("the whole number of a side", "辺の番号(整数)");
            say::out_of_range(number.span, "on", text, bounds, Some(&near))
        });
        None
    }

    fn side_parts(&mut self, element: &'t Element<'t>, schema: &'static Schema) -> Vec<SidePart> {
        let (mut parts, mut run) = (vec![], vec![]);
        for node in self.children(element, schema.content()) {
            match node {
                AllowedChild::Text(text) => {
                    self.codes(text, false, &mut run);
                }
                AllowedChild::Element(schema, child)
                    if matches!(schema.tag, Tag::Fill | Tag::Door) =>
                {
                    if !run.is_empty() {
                        parts.push(SidePart::Pieces(std::mem::take(&mut run)));
                    }
                    self.attributes(schema, child);
                    let half = Half {
                        span: self.whole(child),
                        pieces: self.line(child, schema.content(), false).pieces,
                    };
                    parts.push(match schema.tag {
                        Tag::Fill => SidePart::Fill(half),
                        _ => SidePart::Door(half),
                    });
                }
                AllowedChild::Element(schema, child) => {
                    run.extend(self.piece(schema, child, false));
                }
            }
        }
        if !run.is_empty() {
            parts.push(SidePart::Pieces(run));
        }
        parts
    }
}
