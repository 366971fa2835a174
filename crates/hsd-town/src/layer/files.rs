//! The files of a layer: one, several in a list, or those whose names fit a pattern. They are read in the order of the
//! list, those of a pattern in the order of their names.

use hsd_base::diagnostic::Text;
use hsd_base::source::{IncludeError, Span, Spanned, World};
use hsd_base::text;
use std::collections::BTreeSet;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// The most files of a layer.
const MOST: usize = 20_000;

/// Endings of files that are read with the map beside them, and are none themselves.
const BESIDE: [&str; 8] = ["shx", "dbf", "prj", "cpg", "qpj", "sbn", "sbx", "qmd"];

/// A file of a layer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MapFile {
    /// The path that the world has found.
    pub path: String,
    /// The path from the town file.
    pub src: String,
    /// Where the town file names it, or a pattern that it fits.
    pub span: Span,
    /// What stands before the keys of its features, if the layer has several files: its name without folder and ending.
    pub lead: Option<Box<str>>,
}

/// Why a layer has no files.
#[derive(Debug)]
pub struct NoFiles {
    /// The file or the pattern.
    pub src: String,
    /// Its place.
    pub span: Span,
    /// The reason.
    pub why: Text,
}

/// Returns the path of a map and those that its side files would have.
pub fn with_side_files(map: &Path) -> impl Iterator<Item = PathBuf> {
    let beside = BESIDE.iter().map(|ending| map.with_extension(ending));
    std::iter::once(map.to_owned()).chain(beside)
}

/// Returns the files that a town file called `from` names as `src`. A name with a comma or a star is that of a file if it
/// is there.
///
/// # Errors
/// If one of them is not there, or a pattern fits none.
pub fn files(
    world: &dyn World,
    from: &str,
    src: &Spanned<String>,
) -> Result<Vec<MapFile>, NoFiles> {
    let one = |src: &str, span, path| MapFile {
        path,
        src: src.to_owned(),
        span,
        lead: None,
    };
    if let Ok(path) = world.text(from, &src.value) {
        return Ok(vec![one(&src.value, src.span, path)]);
    }
    let names = listed(&src.value);
    let is_one = names.len() == 1 && !is_pattern(&src.value[names[0].clone()]);
    let (mut found, mut known) = (vec![], BTreeSet::new());
    for range in names {
        let (name, span) = (
            &src.value[range.clone()],
            part(src.span, &src.value, range.clone()),
        );
        let none = |why| NoFiles {
            src: name.to_owned(),
            span,
            why,
        };
        let all = match is_pattern(name) {
            true => fitting(world, from, name).map_err(none)?,
            false => vec![name.to_owned()],
        };
        for own in all {
            let path = world.text(from, &own).map_err(|e| none(missing(e)))?;
            if known.insert(path.clone()) {
                found.push(one(&own, span, path));
            }
        }
        if found.len() > MOST {
            let most = MOST;
            return Err(none(text!([most]
                "a layer has at most {most} files",
                "一つのレイヤーのファイルは {most} 個までです"
            )));
        }
    }
    if !is_one {
        for file in &mut found {
            file.lead = Some(stem(&file.src).into());
        }
    }
    Ok(found)
}

/// Returns the names in a list, one at least.
fn listed(list: &str) -> Vec<Range<usize>> {
    let mut at = 0;
    let mut names = vec![];
    for piece in list.split(',') {
        let name = piece.trim();
        let start = at + (piece.len() - piece.trim_start().len());
        if !name.is_empty() {
            names.push(start..start + name.len());
        }
        at += piece.len() + 1;
    }
    if names.is_empty() {
        names.push(0..list.len());
    }
    names
}

fn is_pattern(name: &str) -> bool {
    name.contains(['*', '?'])
}

/// Returns the names that fit a pattern, with their folder, in their order.
fn fitting(world: &dyn World, from: &str, pattern: &str) -> Result<Vec<String>, Text> {
    let end = pattern.rfind('/').map_or(0, |slash| slash + 1);
    let (folder, of) = pattern.split_at(end);
    if is_pattern(folder) {
        return Err(text!(
            "`*` and `?` may stand in the name of a file, not in that of a folder",
            "`*` と `?` を書けるのはファイルの名で、フォルダーの名には書けません"
        ));
    }
    let mut names = world.names(from, folder).map_err(missing)?;
    let is_beside = |name: &str| BESIDE.iter().any(|e| hsd_map::has_extension(name, e));
    names.retain(|name| fits(of, name) && (is_beside(of) || !is_beside(name)));
    names.sort();
    match names.is_empty() {
        true => Err(text!(
            "no file there fits the pattern",
            "この型に合うファイルがありません"
        )),
        false => Ok(names
            .into_iter()
            .map(|name| format!("{folder}{name}"))
            .collect()),
    }
}

/// Returns true if a name fits a pattern, in which `?` is any character and `*` any number of them.
fn fits(pattern: &str, name: &str) -> bool {
    let (pattern, name): (Vec<char>, Vec<char>) =
        (pattern.chars().collect(), name.chars().collect());
    let (mut p, mut n) = (0, 0);
    // The last star, and the first character of the name behind what it stands for.
    let mut star: Option<(usize, usize)> = None;
    while n < name.len() {
        match (pattern.get(p), star) {
            (Some('*'), _) => {
                star = Some((p, n));
                p += 1;
            }
            (Some(c), _) if *c == '?' || *c == name[n] => {
                p += 1;
                n += 1;
            }
            (_, Some((at, from))) => {
                star = Some((at, from + 1));
                (p, n) = (at + 1, from + 1);
            }
            (_, None) => return false,
        }
    }
    pattern[p..].iter().all(|c| *c == '*')
}

/// Returns why the world has not found a file.
fn missing(why: IncludeError) -> Text {
    match why {
        IncludeError::Missing => text!(
            "there is no such file below the folder of the town",
            "町のファイルのフォルダーより下に、そのファイルがありません"
        ),
        IncludeError::Outside => text!(
            "it lies outside the folder of the town, and a town reads only what lies below it",
            "町のフォルダーの外にあります。町が読むのはそのフォルダーより下だけです"
        ),
    }
}

fn stem(src: &str) -> &str {
    let name = src.rsplit(['/', '\\']).next().unwrap_or(src);
    name.rsplit_once('.').map_or(name, |(stem, _)| stem)
}

/// Returns the place of some bytes of an attribute; the whole of it where it is written with entities.
pub(crate) fn part(span: Span, value: &str, range: Range<usize>) -> Span {
    let exact = (span.end - span.start) as usize == value.len() && !range.is_empty();
    match exact {
        true => Span {
            start: span.start + range.start as u32,
            end: span.start + range.end as u32,
            ..span
        },
        false => span,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_fit_patterns() {
        for (pattern, name, does) in [
            ("*.xml", "a.xml", true),
            ("*.xml", "a.xml.gz", false),
            ("1?-*.xml", "12-0400.xml", true),
            ("1?-*.xml", "123-0400.xml", false),
            ("*a*b*", "xxaybz", true),
            ("*a*b*", "xxbya", false),
            ("地図*", "地図1.gml", true),
            ("a", "a", true),
            ("", "a", false),
        ] {
            assert_eq!(fits(pattern, name), does, "{pattern} {name}");
        }
    }

    #[test]
    fn lists_have_places() {
        let list = " a.xml ,, b c.xml,";
        let names: Vec<&str> = listed(list).into_iter().map(|r| &list[r]).collect();
        assert_eq!(names, ["a.xml", "b c.xml"]);
        assert_eq!(listed(",").first(), Some(&(0..1)));
    }
}
