//! The parametric machiya builds over its whole range.

use super::{Texts, options};
use crate::support::{Run, assert_none, flaws, on_all_processors, root};
use hsd::diagnostic::{Diagnostics, Severity};
use hsd::source::{FileId, Source};

fn build(text: &str, parameters: &[(&str, &str)]) -> Run {
    let source = Source::new(FileId(0), "param-machiya.hsd", text.as_bytes());
    let mut out = Diagnostics::new();
    let options = hsd::Options {
        detail: hsd::scene::Detail::ALL[0],
        ..options(parameters)
    };
    let made = hsd::compile(&[&source], &Texts::default(), &options, &mut out);
    Run {
        source,
        included: made.included,
        diagnostics: out.into_sorted(),
        catalog: made.catalog,
        building: made.building,
        scene: made.scene,
    }
}

#[test]
fn every_front_and_depth_builds() {
    let text = std::fs::read_to_string(root().join("examples/param-machiya.hsd")).unwrap();
    let fronts = ["dwelling", "yarn", "rice", "shop"];
    let findings = on_all_processors(10 * 12, |index| {
        let (frontage, depth) = (3 + index % 10, 5 + index / 10);
        // The other parameters go round, so that each of their values is met.
        let step =
            |from: f64, by: f64, count: usize| (from + by * (index % count) as f64).to_string();
        let set = [
            ("frontage", frontage.to_string()),
            ("depth", depth.to_string()),
            ("ground", step(8.5, 0.5, 5)),
            ("upper", step(4.5, 0.5, 6)),
            ("pitch", step(3.5, 0.25, 7)),
            ("front", fronts[(index / 3) % 4].to_owned()),
            ("udatsu", ["no", "yes"][index % 2].to_owned()),
        ];
        let set: Vec<(&str, &str)> = set.iter().map(|(n, v)| (*n, &**v)).collect();
        let run = build(&text, &set);
        let mut findings = flaws(&run);
        // Notes on long spans are what a carpenter would say of a deep and narrow house.
        if run.diagnostics.iter().any(|d| d.severity > Severity::Note) {
            findings.push(run.short());
        }
        let plan = &run.building.houses[0].roofs.plans[0].outlines[0];
        let width = plan.iter().map(|p| p.x).fold(0.0, f64::max);
        if width != frontage as f64 || run.building.houses[0].roofs.roofs.len() != 2 {
            findings.push(format!("{width} units wide"));
        }
        findings
            .into_iter()
            .map(|f| format!("{set:?}: {f}"))
            .collect()
    });
    assert_none(&findings);
}
