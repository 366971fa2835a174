//! Torii and lanterns: one part on a line, which says at once where it stands, how wide it is and what it faces (000-77).

use super::{Laid, LotSite, told};
use crate::shape::{Segment, azimuth};
use hsd_base::diagnostic::Text;
use hsd_base::geometry::{FOUNDATION, SHAKU};
use hsd_base::source::{Span, Spanned};
use hsd_base::text;
use hsd_ir::ast::street::Lone;
use hsd_ir::ast::{House, Put, Settings, Value};
use hsd_syntax::parse;

/// The unit of a house, metres.
const UNIT: f64 = 3.0 * SHAKU;
/// The shortest line that bears a part, metres.
const SHORT: f64 = 0.2;

impl LotSite<'_> {
    /// Sets a part on each line of the feature, from its first point to its last.
    pub(super) fn lone(&self, wish: &Lone, span: Span) -> Result<Laid, Text> {
        let ways = self.ways();
        let lines = ways
            .iter()
            .map(|way| Segment::new(way[0], way[way.len() - 1]));
        let lines: Vec<Segment> = lines.filter(|line| line.length() > SHORT).collect();
        let Some(first) = lines.first() else {
            return Err(text!(
                "it needs a line of 0.2 m at least, which gives its width and what it faces",
                "幅と向きを決める 0.2 m 以上の線が要ります"
            ));
        };
        let parameters = vec![
            (
                "code".to_owned(),
                Value::Text(wish.code.as_str().trim_end().to_owned()),
            ),
            told("width", first.length()),
        ];
        let houses = lines.iter().map(|line| self.part_on(wish, *line, span));
        Ok(Laid::new(houses.collect(), parameters))
    }

    /// Returns the part on a line as a house of nothing else.
    fn part_on(&self, wish: &Lone, line: Segment, span: Span) -> House {
        let width = line.length() / UNIT;
        let catalog = parse::builtin();
        let own = catalog.find(&wish.code).map(|id| catalog.part(id));
        // A part of the author's is as high as it says.
        let grown = own.and_then(|part| Some(part.to? / part.width() * width));
        let mut house = House {
            span,
            name: Some(Spanned::new(wish.word.to_owned(), span)),
            ..House::default()
        };
        house.fittings.puts = vec![Put {
            span: wish.span,
            code: Spanned::new(wish.code.clone(), wish.span),
            at: Spanned::new((0.0, 0.0), span),
            turn: 0.0,
            width: Some(width),
            height: wish.height.or(grown),
        }];
        let at = |value: f64| Some(Spanned::new(value, span));
        let middle = line.middle();
        house.settings = Settings {
            x: at(middle.x),
            y: at(middle.y),
            z: at(self.height(middle) + FOUNDATION),
            azimuth: at(azimuth(-line.normal())),
            ..Settings::default()
        }
        .into();
        house
    }
}
