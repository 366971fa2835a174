//! What Cargo does not enforce: headers, sizes that a reader can hold in mind, modules and passes that use each other one
//! way, and the graph of crates in `docs/architecture.md`.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

mod circles;
mod graph;

const FILE_LINES: usize = 500;
const FUNCTION_LINES: usize = 60;

/// Passes that share a crate. None uses another, so that each can be read alone.
const PASSES: [&str; 3] = ["expand", "lower", "fit"];

struct File {
    /// Folder of the crate, such as `crates/hsd-roof`; `.` for the package `hsd`.
    folder: String,
    /// Path below the crate's `src/`.
    name: String,
    text: String,
}

impl File {
    /// Path from the root of the repository.
    fn path(&self) -> String {
        format!("{}/src/{}", self.folder, self.name)
    }

    /// Returns true if the file contains only tests.
    fn is_test(&self) -> bool {
        self.name.ends_with("tests.rs") || self.name.contains("/tests/")
    }

    /// The lines before the tests, without comments, numbered from 1.
    fn code(&self) -> impl Iterator<Item = (usize, &str)> {
        self.text
            .lines()
            .take_while(|line| !line.starts_with("#[cfg(test)]"))
            .zip(1..)
            .map(|(line, number)| (number, line.split("//").next().unwrap_or_default()))
    }
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Returns the folders of the crates with a `src/`, sorted.
fn crates() -> Vec<String> {
    let listed = fs::read_dir(root().join("crates")).expect("crates/ can be listed");
    let names = listed.map(|entry| entry.expect("crates/ can be listed").file_name());
    let mut folders: Vec<String> = names
        .map(|name| format!("crates/{}", name.to_string_lossy()))
        .collect();
    folders.extend([".".to_owned(), "xtask".to_owned()]);
    folders.sort();
    folders
}

/// Returns the sources of all crates, sorted by path.
fn sources() -> Vec<File> {
    let mut files = vec![];
    for crate_folder in crates() {
        let src = root().join(&crate_folder).join("src");
        let mut folders = vec![src.clone()];
        while let Some(folder) = folders.pop() {
            for entry in fs::read_dir(&folder).expect("src/ can be listed") {
                let path: PathBuf = entry.expect("src/ can be listed").path();
                if path.is_dir() {
                    folders.push(path);
                } else if path.extension().is_some_and(|e| e == "rs") {
                    let text = fs::read_to_string(&path).expect("sources are UTF-8");
                    let below = path.strip_prefix(&src).expect("is below src/");
                    let name = below.to_string_lossy().replace('\\', "/");
                    let folder = crate_folder.clone();
                    files.push(File { folder, name, text });
                }
            }
        }
    }
    files.sort_by_key(File::path);
    files
}

/// Fails with all findings at once.
fn assert_none(findings: &[String]) {
    assert!(findings.is_empty(), "\n{}\n", findings.join("\n"));
}

/// The paths after each `crate::` of a text: `lower::Fix`, and each member of a group in braces.
fn crate_paths(text: &str) -> Vec<String> {
    let uses = text.match_indices("crate::");
    uses.flat_map(|(at, word)| paths_at(&text[at + word.len()..]))
        .collect()
}

/// The paths that begin here: one, or those of a group.
fn paths_at(text: &str) -> Vec<String> {
    let head = path_at(text);
    let Some(group) = text[head.len()..].strip_prefix('{') else {
        return vec![head.to_owned()];
    };
    let inner = group_members(group).into_iter().flat_map(paths_at);
    inner.map(|member| format!("{head}{member}")).collect()
}

fn path_at(text: &str) -> &str {
    let end = text
        .find(|c: char| !(c.is_alphanumeric() || c == '_' || c == ':'))
        .unwrap_or(text.len());
    &text[..end]
}

/// What stands between the commas of a group, up to its closing brace.
fn group_members(group: &str) -> Vec<&str> {
    let (mut depth, mut start, mut members) = (1, 0, vec![]);
    for (at, c) in group.char_indices() {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            _ => {}
        }
        if depth == 0 || (depth == 1 && c == ',') {
            members.push(group[start..at].trim());
            start = at + 1;
        }
        if depth == 0 {
            break;
        }
    }
    members.retain(|member| !member.is_empty());
    members
}

#[test]
fn passes_do_not_use_each_other() {
    let mut findings = vec![];
    let mut seen: BTreeMap<&str, usize> = BTreeMap::new();
    for file in sources() {
        let module = &file.name[..file.name.find(['/', '.']).unwrap_or(file.name.len())];
        let Some(own) = PASSES.iter().find(|pass| **pass == module) else {
            continue;
        };
        if file.folder != "crates/hsd-passes" || file.is_test() {
            continue;
        }
        *seen.entry(own).or_default() += 1;
        let code: Vec<&str> = file.code().map(|(_, line)| line).collect();
        for path in crate_paths(&code.join("\n")) {
            let used = path.split("::").next().unwrap_or_default();
            if used != *own && PASSES.contains(&used) {
                findings.push(format!("{}: `{own}` must not use `{path}`", file.path()));
            }
        }
    }
    assert_eq!(seen.len(), PASSES.len(), "all passes are in the crate");
    assert_none(&findings);
}

#[test]
fn every_file_has_a_header() {
    let findings: Vec<String> = sources()
        .iter()
        .filter(|file| !file.text.starts_with("//!"))
        .map(|file| format!("{}: begins without a `//!` header", file.path()))
        .collect();
    assert_none(&findings);
}

#[test]
fn files_are_short() {
    let findings: Vec<String> = sources()
        .iter()
        .filter(|file| file.text.lines().count() > FILE_LINES)
        .map(|file| format!("{}: {} lines", file.path(), file.text.lines().count()))
        .collect();
    assert_none(&findings);
}

/// The name of a function that begins on this line.
fn function_name(line: &str) -> Option<&str> {
    let mut rest = line.trim_start();
    if let Some(after) = rest.strip_prefix("pub") {
        rest = match after.strip_prefix('(') {
            Some(scope) => scope.split_once(')')?.1,
            None => after,
        }
        .trim_start();
    }
    for word in ["const ", "async ", "unsafe "] {
        rest = rest.strip_prefix(word).unwrap_or(rest);
    }
    rest.strip_prefix("fn ").map(path_at)
}

fn indent(line: &str) -> usize {
    line.len() - line.trim_start().len()
}

#[test]
fn functions_are_short() {
    let mut findings = vec![];
    for file in sources() {
        let mut open: Vec<(usize, usize, &str)> = vec![];
        for (number, line) in file.code() {
            if let Some(name) = function_name(line)
                && !line.trim_end().ends_with([';', '}'])
            {
                open.push((number, indent(line), name));
            }
            let Some(&(start, depth, name)) = open.last() else {
                continue;
            };
            let closes = indent(line) == depth && line.trim_start().starts_with('}');
            let declares = indent(line) == depth && line.trim_end().ends_with(';'); // of a trait
            if closes || declares {
                open.pop();
                let length = number - start + 1;
                if closes && length > FUNCTION_LINES {
                    findings.push(format!(
                        "{}:{start}: `{name}` has {length} lines",
                        file.path()
                    ));
                }
            }
        }
    }
    assert_none(&findings);
}

#[test]
fn the_reader_of_paths_understands_groups() {
    assert_eq!(
        crate_paths("use crate::{ast::{House, Row}, source::Span};\nlet x = crate::roof::cut(1);"),
        ["ast::House", "ast::Row", "source::Span", "roof::cut"]
    );
}
