//! `View`: a camera that the author has named.

use crate::messages::views as say;
use crate::parse::schema::Schema;
use crate::parse::xml::read::{Attributes, Reader};
use crate::parse::xml::tree::Element;
use hsd_base::source::Spanned;
use hsd_ir::ast::{Frame, NamedView, ViewTime};

/// The least distance between a camera and what it looks at, metres.
const APART: f64 = 1e-3;

impl<'t> Reader<'t, '_> {
    /// Reads a view in the frame of the groups around it.
    pub(in crate::parse::xml) fn view(
        &mut self,
        schema: &'static Schema,
        element: &'t Element<'t>,
        frame: Option<Frame>,
    ) {
        let of = self.attributes(schema, element);
        self.no_children(element);
        let name = self.text(&of, "name");
        let (from, to) = (self.spot(&of, "from"), self.spot(&of, "to"));
        let fov = self.usual(&of, "fov");
        let time = self.view_time(&of);
        let (Some(name), Some(from), Some(to)) = (name, from, to) else {
            return;
        };
        let apart = (0..3).map(|k| (from.value[k] - to.value[k]).abs());
        if apart.fold(0.0, f64::max) < APART {
            self.reporter.push(|| say::looks_at_itself(to.span));
            return;
        }
        let taken = self.views.iter().find(|v| v.name.value == name.value);
        if let Some(first) = taken.map(|v| v.name.span) {
            self.reporter
                .push(|| say::name_taken(name.span, &name.value, Some(first)));
            return;
        }
        if NamedView::is_preset(&name.value) {
            self.reporter
                .push(|| say::name_taken(name.span, &name.value, None));
        }
        let place = |p: [f64; 3]| frame.map_or(p, |frame| frame.point(p));
        self.views.push(NamedView {
            span: self.whole(element),
            from: place(from.value),
            to: place(to.value),
            name,
            fov,
            time,
        });
    }

    /// Reads three coordinates: metres east, north and up.
    fn spot(&mut self, of: &Attributes<'t>, name: &str) -> Option<Spanned<[f64; 3]>> {
        let list = self.numbers(of, name)?;
        let (span, count) = (list.span, list.value.len());
        let Ok(spot) = <[f64; 3]>::try_from(list.value) else {
            self.reporter.push(|| say::not_a_spot(span, name, count));
            return None;
        };
        Some(Spanned::new(spot, span))
    }

    fn view_time(&mut self, of: &Attributes<'t>) -> Option<ViewTime> {
        let (date, hour) = (self.text(of, "date"), self.text(of, "hour"));
        let hour = match hour {
            Some(hour) if date.is_none() => {
                self.reporter.push(|| say::hour_of_no_day(hour.span));
                return None;
            }
            Some(hour) => match ViewTime::hour(&hour.value) {
                Some(value) => value,
                None => {
                    self.reporter.push(|| say::no_hour(hour.span, &hour.value));
                    return None;
                }
            },
            None => ViewTime::USUAL_HOUR,
        };
        let date = date?;
        let Some(day) = ViewTime::date(&date.value) else {
            self.reporter.push(|| say::no_date(date.span, &date.value));
            return None;
        };
        Some(ViewTime { date: day, hour })
    }
}
