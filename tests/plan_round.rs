//! What `hsd draw` has drawn comes back: the drawing of the house that was read from a plan is the drawing that was read.

use crate::support::{
    Run, assert_none, compile_changed, compile_file, on_all_processors, stem, texts, texts_in_turn,
};
use glam::{DVec2, dvec2};
use hsd::Language;
use hsd::drawing::subject::Subject;
use hsd::drawing::{self, Settings, Wanted};
use hsd::plan::vector::own;
use std::collections::BTreeMap;
use std::path::Path;

/// How far a bay may lie from where it was, millimetres of the house: what the micrometres of the paper leave open.
const OFF: f64 = 2.0;

/// Parts of an author's own are not in a drawing.
const OWN_PARTS: [&str; 4] = ["mon", "shoro", "tahoto", "tea-shop"];

fn drawing_of(run: &Run, wanted: &[Wanted], scale: u32) -> Option<String> {
    let subject = Subject::new(&run.building, |_| true, &run.scene, &run.catalog);
    let ken = subject.houses.first()?.house.unit * 2.0;
    let settings = Settings {
        scale,
        sections: vec![],
        language: Language::English,
        title: String::new(),
        source: String::new(),
        ken,
    };
    let sheet = drawing::on_paper(
        &drawing::views(&subject, wanted, &settings),
        None,
        &settings,
    )?;
    Some(drawing::svg::write(&sheet))
}

/// The bays of each plan, millimetres of the house from the first one: codes and ends.
fn bays(svg: &str) -> BTreeMap<String, Vec<(String, [DVec2; 2])>> {
    let scale: f64 = attribute(svg, "data-scale")
        .and_then(|s| s.parse().ok())
        .expect("a sheet has a scale");
    let (mut view, mut is_axis) = (String::new(), false);
    let mut found: BTreeMap<String, Vec<(String, [DVec2; 2])>> = BTreeMap::new();
    for line in svg.lines() {
        if let Some(name) = attribute(line, "data-view") {
            view = name.to_owned();
        }
        if let Some(role) = attribute(line, "data-role") {
            is_axis = role == "axis";
        }
        if !is_axis || !line.starts_with("<path") {
            continue;
        }
        let d = attribute(line, "d").expect("a path has places");
        let place = |text: &str| {
            let (x, y) = text.split_once(' ').expect("a place has two numbers");
            dvec2(x.parse().expect("a number"), y.parse().expect("a number")) * scale
        };
        let (from, to) = d
            .trim_start_matches('M')
            .split_once('L')
            .expect("a bay is a line");
        let code = attribute(line, "data-code").unwrap_or_default().to_owned();
        found
            .entry(view.clone())
            .or_default()
            .push((code, [place(from), place(to)]));
    }
    for list in found.values_mut() {
        let first = list[0].1[0];
        list.iter_mut()
            .for_each(|(_, ends)| *ends = ends.map(|p| p - first));
    }
    found
}

fn attribute<'t>(text: &'t str, name: &str) -> Option<&'t str> {
    let (_, rest) = text.split_once(&format!(" {name}=\""))?;
    rest.split_once('"').map(|(value, _)| value)
}

/// Draws a file, reads the drawing, draws what was read; what differs.
fn round(path: &Path, wanted: &[Wanted], scale: u32) -> Vec<String> {
    let name = stem(path);
    let Some(first) = drawing_of(&compile_file(path), wanted, scale) else {
        return vec![];
    };
    let text = match own::read(&first) {
        Ok(Some(text)) => text,
        other => return vec![format!("{name}: {other:?}")],
    };
    // In the place of the file, so that pictures of parts are found.
    let file = path
        .file_name()
        .expect("a file has a name")
        .to_string_lossy()
        .into_owned();
    let run = compile_changed(path, BTreeMap::from([(file, text.into_bytes())]));
    if run.has_errors() {
        return vec![format!("{name}: {}", run.short())];
    }
    let Some(second) = drawing_of(&run, wanted, scale) else {
        return vec![format!("{name}: nothing is drawn")];
    };
    let (first, second) = (bays(&first), bays(&second));
    if first.keys().ne(second.keys()) {
        return vec![format!(
            "{name}: {:?} came back as {:?}",
            first.keys(),
            second.keys()
        )];
    }
    let mut wrong = vec![];
    for (view, list) in &first {
        let other = &second[view];
        if list.len() != other.len() {
            wrong.push(format!(
                "{name} {view}: {} bays came back as {}",
                list.len(),
                other.len()
            ));
        }
        for ((code, ends), (code_after, after)) in list.iter().zip(other) {
            let off = (0..2)
                .map(|k| ends[k].distance(after[k]))
                .fold(0.0, f64::max);
            if code != code_after || off > OFF {
                wrong.push(format!(
                    "{name} {view}: {code:?} came back as {code_after:?}, {off:.1} mm off"
                ));
            }
        }
    }
    wrong
}

#[test]
#[ignore = "takes long; `.ci/nightly tests` runs it"]
fn plans_come_back_as_they_went_out() {
    let paths: Vec<_> = ["examples", "library"]
        .into_iter()
        .flat_map(|folder| texts_in_turn(folder, 1))
        .filter(|p| !OWN_PARTS.contains(&stem(p).as_str()))
        .collect();
    let wrong = on_all_processors(paths.len(), |k| round(&paths[k], &[Wanted::Plans], 100));
    assert_none(&wrong);
}

#[test]
fn they_come_back_from_a_sheet_with_all_views() {
    let paths: Vec<_> = texts("examples")
        .into_iter()
        .filter(|p| ["machiya", "rooms", "court-house"].contains(&stem(p).as_str()))
        .collect();
    assert_eq!(paths.len(), 3);
    let wrong = on_all_processors(paths.len(), |k| round(&paths[k], &Wanted::ALL, 200));
    assert_none(&wrong);
}

#[test]
fn what_was_changed_by_hand_is_refused_in_words() {
    let run = compile_file(
        &texts("examples")
            .into_iter()
            .find(|p| stem(p) == "hiraya")
            .expect("the example is there"),
    );
    let svg = drawing_of(&run, &[Wanted::Plans], 100).expect("it is drawn");
    let turned = svg.replace("<g data-view=", "<g transform=\"rotate(3)\" data-view=");
    assert!(own::read(&turned).is_err());
    assert!(own::read(&svg[..svg.len() / 2]).is_err());
    assert_eq!(own::read("<svg><path d=\"M0 0L1 1\"/></svg>"), Ok(None));
}
