//! OpenStreetMap XML.

use super::{Data, Tags, parts};
use crate::fault::{Fault, Kind};
use crate::input::Input;
use crate::xml::{Element, Token, Xml};
use hsd_base::budget::Exhausted;
use std::sync::Arc;

/// A thing whose content is being read.
#[derive(Default)]
struct Open {
    name: Box<str>,
    id: i64,
    place: Option<[i32; 2]>,
    /// Nodes of a way, ways of a relation.
    refs: Vec<i64>,
    tags: Tags,
    is_deleted: bool,
}

/// Reads a file.
///
/// # Errors
/// If it is damaged from somewhere on.
pub(super) fn read(
    input: Input,
    file: &Arc<str>,
    encoding: Option<&str>,
    data: &mut Data,
    remarks: &mut Vec<Fault>,
) -> Result<(), Fault> {
    let mut xml = Xml::open(input, file, encoding)?;
    let (mut depth, mut open) = (0, Open::default());
    loop {
        let at = xml.at();
        let Some(token) = xml.next()? else {
            let what = "the file ends in the middle";
            return match depth {
                0 => Ok(()),
                _ => Err(Fault::of_file(file, Kind::Damaged { what }).at(at)),
            };
        };
        match token {
            Token::Start(element) => {
                depth += 1;
                match depth {
                    2 => open = thing(&element),
                    3 => content(&mut open, &element),
                    _ => {}
                }
            }
            Token::End => {
                if depth == 2 {
                    let fault = |kind| Fault::of_file(file, kind).at(at);
                    let open = std::mem::take(&mut open);
                    if open.is_deleted {
                        remarks.push(fault(Kind::Deleted));
                        depth -= 1;
                        continue;
                    }
                    let closed = close(open, data);
                    if !closed.map_err(|exhausted| fault(exhausted.into()))? {
                        let what = "a node has no place".into();
                        remarks.push(fault(Kind::Malformed { what }));
                    }
                }
                depth -= 1;
            }
            Token::Text(_) => {}
        }
    }
}

fn thing(element: &Element) -> Open {
    let number = |name: &str| {
        element
            .attribute(name)
            .and_then(|v| v.trim().parse::<f64>().ok())
    };
    let place = match (number("lon").and_then(parts), number("lat").and_then(parts)) {
        (Some(lon), Some(lat)) => Some([lon, lat]),
        _ => None,
    };
    Open {
        name: element.name.clone(),
        id: reference(element, "id").unwrap_or_default(),
        place,
        is_deleted: element.attribute("action") == Some("delete"),
        ..Open::default()
    }
}

fn reference(element: &Element, name: &str) -> Option<i64> {
    element.attribute(name)?.trim().parse().ok()
}

fn content(open: &mut Open, element: &Element) {
    match &*element.name {
        "nd" => open.refs.extend(reference(element, "ref")),
        "member" if element.attribute("type") == Some("way") => {
            open.refs.extend(reference(element, "ref"));
        }
        "tag" => {
            if let (Some(k), Some(v)) = (element.attribute("k"), element.attribute("v")) {
                open.tags.push((k.into(), v.into()));
            }
        }
        _ => {}
    }
}

/// Takes a thing that is complete; returns false if it is a node without a place.
fn close(open: Open, data: &mut Data) -> Result<bool, Exhausted> {
    match &*open.name {
        "node" => match open.place {
            Some(place) => data.add_node(open.id, place, open.tags)?,
            None => return Ok(false),
        },
        "way" => data.add_way(open.id, open.refs, open.tags)?,
        "relation" => data.add_relation(open.id, open.refs, open.tags)?,
        _ => {}
    }
    Ok(true)
}
