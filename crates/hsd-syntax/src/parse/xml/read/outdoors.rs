//! What a rule of a town makes beside houses: `Road`, `Rail`, `Tree`, `Fence`, `Water` and their kin, `Zone`, `Envelope`.

use crate::parse::schema::{Schema, Tag};
use crate::parse::xml::read::{Attributes, Reader};
use crate::parse::xml::tree::Element;
use hsd_base::text;
use hsd_ir::ast::land::{Bank, Crop, Farmland, Water};
use hsd_ir::ast::law::{DistrictPlan, EnvelopeWish, Zone};
use hsd_ir::ast::street::{Arcade, Board, Lone, PoleMade, Poles, Sign, Signal, WireLine, Wires};
use hsd_ir::ast::{CodeText, Fence, Outdoor, Railway, Road, Species, Surface, TreeWish};
use hsd_ir::messages::xml as say;

impl<'t> Reader<'t, '_> {
    /// Reads what an element wants.
    pub(in crate::parse::xml) fn outdoor(
        &mut self,
        schema: &'static Schema,
        element: &'t Element<'t>,
    ) -> Outdoor {
        let of = self.attributes(schema, element);
        self.no_children(element);
        match schema.tag {
            Tag::Road => Outdoor::Road(self.road(&of)),
            Tag::Rail => Outdoor::Rail(Railway {
                gauge: self.usual(&of, "gauge"),
            }),
            Tag::Tree => Outdoor::Tree(TreeWish {
                species: self
                    .choice(&of, "species", &Species::WORDS)
                    .map(|s| s.value),
                height: self.number(&of, "height").map(|h| h.value),
                width: self.number(&of, "width").map(|w| w.value),
                spacing: self.usual(&of, "spacing"),
                offset: self.usual(&of, "offset"),
            }),
            Tag::Zone => Outdoor::Zone(Box::new(self.zone(&of))),
            Tag::Envelope => Outdoor::Envelope(Box::new(EnvelopeWish {
                own: self.zone(&of),
                scenario: self
                    .text(&of, "scenario")
                    .map_or_else(String::new, |s| s.value),
                built: self.number(&of, "built").map(|h| h.value),
                roads: self.text(&of, "roads").map(|r| r.value),
                show: self.yes_no(&of, "show").is_none_or(|s| s.value),
            })),
            Tag::Fence | Tag::Hedge | Tag::Wall => {
                let word = match schema.tag {
                    Tag::Hedge => "hedge",
                    Tag::Wall => "wall",
                    _ => "fence",
                };
                Outdoor::Fence(self.fence(word, schema, &of))
            }
            Tag::Water => Outdoor::Water(Water {
                width: self.usual(&of, "width"),
                bank: self
                    .choice(&of, "bank", &Bank::WORDS)
                    .map_or_else(Bank::default, |b| b.value),
                bank_width: self.usual(&of, "bank_width"),
            }),
            Tag::Farmland => Outdoor::Farmland(Farmland {
                crop: self
                    .choice(&of, "crop", &Crop::WORDS)
                    .map_or_else(Crop::default, |c| c.value),
                width: self.usual(&of, "width"),
                depth: self.usual(&of, "depth"),
                azimuth: self.usual(&of, "azimuth"),
                ridge: self.usual(&of, "ridge"),
                way: self.usual(&of, "way"),
            }),
            _ => self.in_street(schema, &of),
        }
    }

    /// Reads what stands in streets.
    fn in_street(&mut self, schema: &'static Schema, of: &Attributes<'t>) -> Outdoor {
        match schema.tag {
            Tag::Pole | Tag::Network => Outdoor::Poles(Poles {
                height: self.usual(of, "height"),
                spacing: self.usual(of, "spacing"),
                wires: self.wires(of),
                made: self
                    .choice(of, "made", &PoleMade::WORDS)
                    .map_or_else(PoleMade::default, |m| m.value),
                reach: (schema.tag == Tag::Network).then(|| self.usual(of, "reach")),
            }),
            Tag::Wire => Outdoor::Wire(WireLine {
                height: self.usual(of, "height"),
                wires: self.wires(of),
            }),
            Tag::Signal => Outdoor::Signal(Signal {
                facing: self.number(of, "azimuth").map(|a| a.value),
                height: self.usual(of, "height"),
            }),
            Tag::Sign => Outdoor::Sign(Box::new(Sign {
                text: self.text(of, "text").map_or_else(String::new, |t| t.value),
                facing: self.number(of, "azimuth").map(|a| a.value),
                size: self.usual(of, "size"),
                height: self.usual(of, "height"),
                board: self
                    .choice(of, "board", &Board::WORDS)
                    .map_or_else(Board::default, |b| b.value),
            })),
            Tag::Arcade => Outdoor::Arcade(Arcade {
                depth: self.usual(of, "depth"),
                height: self.usual(of, "height"),
                bay: self.usual(of, "bay"),
            }),
            tag => {
                debug_assert!(matches!(tag, Tag::Torii | Tag::Lantern), "{tag:?}");
                let word = if tag == Tag::Torii {
                    "torii"
                } else {
                    "lantern"
                };
                Outdoor::Lone(self.lone(word, schema, of))
            }
        }
    }

    /// Reads a ratio of floor area; a percentage is reported.
    fn ratio(&mut self, of: &Attributes<'t>) -> Option<f64> {
        const PERCENT: std::ops::RangeInclusive<f64> = 30.0..=2000.0;
        let written = of.get("ratio")?;
        let text = written.value.as_str().trim();
        let number = text
            .trim_end_matches(['%', '％'])
            .trim()
            .parse::<f64>()
            .ok();
        let Some(percent) = number.filter(|n| PERCENT.contains(n)) else {
            return self.number(of, "ratio").map(|n| n.value);
        };
        let (span, ratio) = (self.value_span(written), percent / 100.0);
        self.reporter.push(|| {
            let bounds = text!(
                "a ratio from 0.1 to 20: 400 % is 4",
                "0.1 から 20 までの比。400 % は 4"
            );
            say::out_of_range(span, "ratio", text, bounds, Some(&ratio.to_string()))
        });
        Some(ratio)
    }

    fn zone(&mut self, of: &Attributes<'t>) -> Zone {
        let ratio = self.ratio(of);
        let mut number = |name| self.number(of, name).map(|n| n.value);
        Zone {
            gradient: number("gradient"),
            distance: number("distance"),
            ratio,
            factor: number("factor"),
            limit: number("limit"),
            setback: number("setback"),
            side_height: number("side_height"),
            side_gradient: number("side_gradient"),
            storey: number("storey"),
            coverage: number("coverage"),
            plan: self
                .choice(of, "plan", &DistrictPlan::WORDS)
                .map(|p| p.value),
            by_ratio: self.yes_no(of, "by_ratio").map(|b| b.value),
        }
    }

    fn lone(&mut self, word: &'static str, schema: &'static Schema, of: &Attributes<'t>) -> Lone {
        let code = self.text(of, "code");
        let usual = schema.attribute("code").map_or("", |code| code.default);
        Lone {
            word,
            span: code.as_ref().map_or(self.start(of.element), |c| c.span),
            code: CodeText::new(code.as_ref().map_or(usual, |code| &code.value)),
            height: self.number(of, "height").map(|h| h.value),
        }
    }

    fn wires(&mut self, of: &Attributes<'t>) -> Wires {
        let count = self
            .whole_number(of, "wires")
            .map(|count| count.value as u32);
        Wires {
            count: count.unwrap_or_else(|| of.usual("wires") as u32),
            sag: self.usual(of, "sag"),
        }
    }

    fn road(&mut self, of: &Attributes<'t>) -> Road {
        let surface = self.choice(of, "surface", &Surface::WORDS);
        let surface = surface.map_or_else(Surface::default, |s| s.value);
        let marks = self.yes_no(of, "marks").map(|marks| marks.value);
        Road {
            width: self.number(of, "width").map(|w| w.value),
            surface,
            pavement: self.usual(of, "pavement"),
            drain: self.usual(of, "drain"),
            marks: marks.unwrap_or(surface == Surface::Asphalt),
        }
    }

    fn fence(&mut self, word: &'static str, schema: &'static Schema, of: &Attributes<'t>) -> Fence {
        let code = self.text(of, "code");
        let usual = schema.attribute("code").map_or("", |code| code.default);
        let part =
            |text: Option<hsd_base::source::Spanned<String>>| text.map(|t| CodeText::new(&t.value));
        Fence {
            word,
            span: code.as_ref().map_or(self.start(of.element), |c| c.span),
            code: part(code).unwrap_or_else(|| CodeText::new(usual)),
            first: part(self.text(of, "first")),
            last: part(self.text(of, "last")),
            height: self.number(of, "height").map(|h| h.value),
            gate: self.usual(of, "gate"),
        }
    }
}
