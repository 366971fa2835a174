//! The pictures that a run takes: presets of the page, and cameras of the author or of the command line.

use super::standing::{self, Camera};
use crate::Failure;
use clap::builder::{PossibleValue, TypedValueParser};
use clap::error::{Error, ErrorKind};
use hsd_base::text;
use hsd_ir::ast::{NamedView, ViewTime};
use hsd_ir::building::Built;
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};
use std::ffi::OsStr;

/// The views of the presets, in the order of [`NamedView::PRESETS`].
const ABOUT: [&str; NamedView::PRESETS.len()] = [
    "From the left of the street",
    "Like front, from the height of the eaves",
    "From above, front right",
    "From above, behind the house",
    "The left side",
    "The right side",
    "From straight above",
    "The front in parallel projection",
    "The back in parallel projection",
    "The left side in parallel projection",
    "The right side in parallel projection",
    "The roofs in parallel projection, the front at the bottom",
    "In the courtyard of the house; `court-2` is its second one",
    "Before its first line, at eye height; `side-2` is before its second wall",
];

/// The parser of a view: a preset, or the name of a `View` in the file, which is known only later.
#[derive(Clone)]
pub(super) struct ViewParser;

impl TypedValueParser for ViewParser {
    type Value = String;

    fn parse_ref(
        &self,
        command: &clap::Command,
        _: Option<&clap::Arg>,
        value: &OsStr,
    ) -> Result<String, Error> {
        let text = value.to_str().map(str::trim).filter(|t| !t.is_empty());
        let text = text.map(str::to_owned);
        text.ok_or_else(|| Error::new(ErrorKind::InvalidValue).with_cmd(command))
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        let all = NamedView::PRESETS.iter().zip(ABOUT);
        Some(Box::new(
            all.map(|(name, about)| PossibleValue::new(*name).help(about)),
        ))
    }
}

/// One picture.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Shot {
    /// The name by which the page knows it.
    pub(super) id: String,
    /// The end of its file's name.
    pub(super) name: String,
    /// The camera, if it is no preset of the page.
    pub(super) camera: Option<Camera>,
    /// Its own time of day.
    pub(super) time: Option<ViewTime>,
}

impl Shot {
    /// Creates the picture of a camera given on the command line.
    pub(super) fn free(camera: Camera) -> Shot {
        Shot {
            id: "camera".into(),
            name: "camera".into(),
            camera: Some(camera),
            time: None,
        }
    }
}

/// What a file offers to the camera; nothing but presets for a model.
pub(super) struct Scenery<'a> {
    pub(super) houses: &'a [Built],
    pub(super) views: &'a [NamedView],
    /// The house that is asked for.
    pub(super) house: Option<&'a str>,
    /// True for a model, whose houses are not known.
    pub(super) model: bool,
}

impl Scenery<'_> {
    /// Returns the pictures of some views. Fails for a view that the file does not have.
    pub(super) fn shots(&self, names: &[String], file: &str) -> Result<Vec<Shot>, Failure> {
        let mut used = BTreeSet::new();
        let mut shots = vec![];
        for (n, name) in names.iter().enumerate() {
            let mut shot = self.shot(n, name, file)?;
            let plain = file_name(name);
            let numbered = (2..).map(|k| format!("{plain}-{k}"));
            let mut all = std::iter::once(plain.clone()).chain(numbered);
            shot.name = all
                .find(|name| used.insert(name.to_lowercase()))
                .unwrap_or(plain);
            shots.push(shot);
        }
        Ok(shots)
    }

    fn shot(&self, n: usize, name: &str, file: &str) -> Result<Shot, Failure> {
        let own = |camera: Option<Camera>| Shot {
            id: format!("view-{n}"),
            name: String::new(),
            camera,
            time: None,
        };
        if self.model && (numbered(name).is_some() || !NamedView::is_preset(name)) {
            return Err(Failure::Usage(text!([file, name]
                "{file}: a model has no view {name}: courts, sides and the views of an author are those of source files",
                "{file}: モデルには {name} という視点がありません。中庭や壁面、名の付いた視点はテキストから写します"
            )));
        }
        if NamedView::is_preset(name) {
            return match numbered(name) {
                Some(("court", k)) => Ok(own(Some(self.court(k, file)?))),
                Some((_, k)) => Ok(own(Some(self.side(k, file)?))),
                None => Ok(Shot {
                    id: name.to_owned(),
                    ..own(None)
                }),
            };
        }
        let view = self.views.iter().find(|v| v.name.value == name);
        let view = view.ok_or_else(|| self.no_view(name, file))?;
        let camera = Camera {
            from: view.from,
            to: view.to,
            fov: view.fov,
        };
        Ok(Shot {
            time: view.time.clone(),
            ..own(Some(camera))
        })
    }

    /// Returns the camera in a court: of the house asked for, or of the first one that has so many.
    fn court(&self, k: usize, file: &str) -> Result<Camera, Failure> {
        let mut houses = self.asked();
        let found = houses.find_map(|n| standing::in_court(&self.houses[n].house, k));
        found.ok_or_else(|| {
            let most = self.asked().map(|n| standing::courts(&self.houses[n].house));
            let most = most.max().unwrap_or(0);
            let number = k + 1;
            Failure::Usage(match most {
                0 => text!([file]
                    "{file}: no house there has a courtyard (a `Loop hole=\"yes\"`, or a `Hole` in its outline)",
                    "{file}: 中庭(`Loop hole=\"yes\"` か輪郭の `Hole`)のある建物がありません"
                ),
                _ => text!([file, number, most]
                    "{file}: there is no courtyard {number}; no house has more than {most}",
                    "{file}: 中庭 {number} はありません。中庭は多くて {most} つです"
                ),
            })
        })
    }

    /// Returns the camera before a side of the house asked for, or of the first one.
    fn side(&self, k: usize, file: &str) -> Result<Camera, Failure> {
        let house = self.asked().next();
        let found = house.and_then(|n| standing::before_side(self.houses, n, k));
        found.ok_or_else(|| {
            let most = house.map_or(0, |n| standing::sides(&self.houses[n].house));
            let number = k + 1;
            Failure::Usage(text!([file, number, most]
                "{file}: there is no side {number}: the ground storey has {most} walls",
                "{file}: 壁 {number} はありません。1階の壁は {most} 面です"
            ))
        })
    }

    /// Returns the houses asked for, by their numbers.
    fn asked(&self) -> impl Iterator<Item = usize> {
        let is = |b: &Built| self.house.is_none_or(|name| b.house.name == name);
        let all = self.houses.iter().enumerate();
        all.filter(move |(_, b)| is(b)).map(|(n, _)| n)
    }

    #[cold]
    fn no_view(&self, name: &str, file: &str) -> Failure {
        let presets = NamedView::PRESETS.join(", ");
        let own: Vec<&str> = self.views.iter().map(|v| &*v.name.value).collect();
        Failure::Usage(match own.is_empty() {
            true => text!([file, name, presets]
                "{file}: no view is called {name}; there are {presets}, and the file could have a `View name=\"{name}\"`",
                "{file}: {name} という視点はありません。{presets} があります。ファイルに `View name=\"{name}\"` を書けば加わります"
            ),
            false => {
                let own = own.join(", ");
                text!([file, name, own, presets]
                    "{file}: no view is called {name}; the file has {own}, and there are {presets}",
                    "{file}: {name} という視点はありません。ファイルには {own}、ほかに {presets} があります"
                )
            }
        })
    }
}

/// Returns the kind and number, from 0, of a view of a court or a side.
fn numbered(name: &str) -> Option<(&str, usize)> {
    match name {
        "court" => return Some((name, 0)),
        "street" => return Some(("side", 0)),
        _ => {}
    }
    let (kind, number) = name.rsplit_once('-')?;
    let number = number.parse::<usize>().ok()?;
    matches!(kind, "court" | "side").then_some((kind, number.checked_sub(1).unwrap_or(usize::MAX)))
}

/// Returns a name without what file names cannot have.
fn file_name(name: &str) -> String {
    let plain = |c: char| match c {
        '/' | '\\' | ':' | '*' | '?' | '"' | '<' | '>' | '|' | ' ' | '\u{3000}' => '-',
        c if c.is_control() => '-',
        c => c,
    };
    name.chars().map(plain).collect()
}

/// A camera as the page reads it.
#[derive(Serialize)]
struct PageCamera {
    from: [f64; 3],
    to: [f64; 3],
    fov: f64,
}

/// Returns the cameras of some pictures for the page, as JSON by their ids.
pub(super) fn cameras(shots: &[Shot]) -> String {
    let camera = |shot: &Shot| {
        let Camera { from, to, fov } = shot.camera?;
        Some((shot.id.clone(), PageCamera { from, to, fov }))
    };
    let all: BTreeMap<String, PageCamera> = shots.iter().filter_map(camera).collect();
    serde_json::to_string(&all).unwrap_or_default()
}
