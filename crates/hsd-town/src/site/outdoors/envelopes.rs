//! Zones of building law, and the envelopes of lots in them (002-28 to 002-32).

use super::{Laid, LotSite, told};
use crate::layer::Shape;
use crate::plan::ZoneArea;
use crate::plot::Rectangle;
use crate::shape::area;
use crate::site::law::{
    Envelope, EnvelopeFace, EnvelopeRow, Facet, Ground, Rule, envelope, fronts,
};
use glam::{DVec2, DVec3};
use hsd_base::diagnostic::Text;
use hsd_base::source::Span;
use hsd_base::text;
use hsd_ir::ast::law::{DistrictPlan, EnvelopeWish, Zone};
use hsd_ir::ast::{Sheet, Value};

/// The least area of a lot, square metres.
const LEAST_AREA: f64 = 1.0;
/// The most corners of a lot: each is a rule against all others.
const MOST_CORNERS: usize = 120;

impl LotSite<'_> {
    /// Returns the feature as a zone; `None` if it is no area.
    pub fn zone_area(&self, terms: Zone) -> Option<ZoneArea> {
        let Shape::Area(ring, holes) = &self.lot().shape else {
            return None;
        };
        Some(ZoneArea {
            ring: ring.clone(),
            holes: holes.clone(),
            terms,
        })
    }

    /// Records a zone.
    pub(super) fn zone(&self, zone: &Zone) -> Result<Laid, Text> {
        if self.lot().shape.ring().is_none() {
            return Err(text!("a zone is an area", "規制の区域は面です"));
        }
        let terms = zone.terms();
        let mut parameters = vec![
            told("gradient", terms.gradient),
            told("distance", terms.distance),
        ];
        parameters.extend(terms.ratio.map(|ratio| told("ratio", ratio)));
        Ok(Laid::new(vec![], parameters))
    }

    /// Returns the outline of a lot and the holes in it.
    fn lot_area(&self) -> Result<(&[DVec2], &[Vec<DVec2>]), Text> {
        let (ring, holes) = match &self.lot().shape {
            Shape::Area(ring, holes) if area(ring, holes) >= LEAST_AREA => (ring, holes),
            _ => return Err(text!("a lot is an area", "敷地は面です")),
        };
        let corners = ring.len() + holes.iter().map(Vec::len).sum::<usize>();
        match corners > MOST_CORNERS {
            true => Err(text!([corners]
                "the lot has {corners} corners, more than 120",
                "敷地の頂点が {corners} 個あり、120 を超えます"
            )),
            false => Ok((ring, holes)),
        }
    }

    /// Finds the envelope of a lot.
    pub(super) fn envelope(&self, wish: &EnvelopeWish, span: Span) -> Result<Laid, Text> {
        let lot = self.lot();
        let (ring, holes) = self.lot_area()?;
        let roads = wish.roads.as_deref().unwrap_or_default();
        let layers = &self.plan.layers;
        if !roads.is_empty() && !layers.iter().any(|l| l.layer.name.value == roads) {
            return Err(
                text!([roads] "there is no layer `{roads}`", "`{roads}` というレイヤーはありません"),
            );
        }
        let zone = self.plan.laid.zones.at(lot.shape.centre());
        let given = zone.map_or(wish.own.clone(), |zone| wish.own.or(zone));
        let terms = given.terms();
        let pieces = self.plan.road_pieces(lot, roads);
        let fronts = fronts(ring, &pieces, self.neighbours());
        let made = envelope(ring, holes, &fronts, &terms);
        if made.cells.is_empty() {
            return Err(text!(
                "the set-back leaves nothing of the lot",
                "後退すると敷地が残りません"
            ));
        }
        let foot = self.height(lot.shape.centre());
        let faces = made.faces();
        let sheets = match wish.show {
            true => self.glass(&faces, foot),
            false => vec![],
        };
        let houses = match sheets.is_empty() {
            true => vec![],
            false => vec![self.open(span, "envelope", sheets, vec![])],
        };
        let row = self.row(wish, &made, &faces, foot);
        let mut parameters = vec![
            told("volume", row.volume),
            told("floor_area", row.floor_area()),
            told("height", row.height),
        ];
        if !wish.scenario.is_empty() {
            parameters.insert(
                0,
                ("scenario".to_owned(), Value::Text(wish.scenario.clone())),
            );
        }
        let rules = row.rules.iter().zip(&row.arithmetic);
        parameters.extend(rules.map(|((rule, _), arithmetic)| {
            let name = rule.replace(' ', "_");
            (name, Value::Text(arithmetic.clone()))
        }));
        Ok(Laid {
            houses,
            parameters,
            envelope: Some(row),
            no_guiding_height: terms.plan == DistrictPlan::Guided && given.limit.is_none(),
        })
    }

    fn row(&self, wish: &EnvelopeWish, made: &Envelope, faces: &[Facet], foot: f64) -> EnvelopeRow {
        // The house before it, or as much as the lot.
        let house = self.on_rectangles().first().map(Rectangle::corners);
        let outline = self.lot().shape.ring().unwrap_or_default();
        let ring = house.as_ref().map_or(outline, |corners| &corners[..]);
        let binding = made.binding();
        let face = |facet: &Facet| EnvelopeFace {
            rule: facet.ground.name(),
            ring: facet
                .ring
                .iter()
                .map(|p| (*p + DVec3::Z * foot).to_array())
                .collect(),
        };
        EnvelopeRow {
            key: self.lot().key.to_string(),
            layer: self.plan.layers[self.id.0].layer.name.value.clone(),
            block: self
                .plan
                .block(self.lot().shape.centre())
                .unwrap_or("")
                .to_owned(),
            scenario: wish.scenario.clone(),
            volume: made.volume(),
            floors: made.floors(),
            height: made.height(),
            rules: binding
                .iter()
                .map(|(n, area)| (made.rules[*n].name(), *area))
                .collect(),
            arithmetic: binding
                .iter()
                .map(|(n, _)| made.rules[*n].arithmetic())
                .collect(),
            lot_area: made.lot_area,
            roads: made.roads,
            road_width: made.road_width,
            ratio: made.ratio,
            built: wish.built,
            above: wish.built.map_or(0.0, |built| made.exceeded(ring, built)),
            faces: faces.iter().map(face).collect(),
        }
    }

    /// Returns the faces over the ground as sheets of glass, in the colours of their rules.
    fn glass(&self, faces: &[Facet], foot: f64) -> Vec<Sheet> {
        let base = self.base().extend(-foot);
        let finish = |ground: &Ground| match ground {
            Ground::Rule(Rule::Road { .. }) | Ground::End(Rule::Road { .. }) => "envelope_road",
            Ground::Rule(Rule::Side { .. }) | Ground::End(Rule::Side { .. }) => "envelope_side",
            _ => "envelope_level",
        };
        let shown = |name: &'static str| {
            let own = faces
                .iter()
                .filter(|f| f.ground != Ground::Lot && finish(&f.ground) == name);
            let ring = |facet: &Facet| facet.ring.iter().map(|p| *p - base).collect();
            let faces: Vec<Vec<DVec3>> = own.map(ring).collect();
            (!faces.is_empty()).then_some(Sheet {
                finish: name,
                least: 0,
                most: Sheet::MOST,
                on_ground: false,
                faces,
            })
        };
        ["envelope_road", "envelope_side", "envelope_level"]
            .into_iter()
            .filter_map(shown)
            .collect()
    }
}
