//! The sources themselves: the order of the chain, headers, and sizes that a reader can hold in mind.

use std::fs;
use std::path::{Path, PathBuf};

mod circles;

/// The modules in reading order: each may use those before it, as far as [`Part`] lets it.
const ORDER: &[(&str, Part)] = &[
    ("source", Foundation),
    ("geometry", Foundation),
    ("lettering", Foundation),
    ("rng", Foundation),
    ("diagnostic", Foundation),
    ("map", Foundation),
    ("ast", Noun),
    ("material", Foundation),
    ("catalog", Foundation),
    ("program", Noun),
    ("building", Noun),
    ("scene", Noun),
    ("check", Foundation),
    ("texture", Foundation),
    ("templates", Foundation),
    ("parse", Verb),
    ("expand", Verb),
    ("lower", Verb),
    ("roof", Verb),
    ("fit", Verb),
    ("tessellate", Verb),
    ("render", Verb),
    ("print", Verb),
    ("backend", Verb),
    ("driver", Shell),
    ("town", Shell),
    ("survey", Shell),
    ("tiles", Shell),
    ("plan", Shell),
    ("front", Shell),
    ("plan_file", Shell),
    ("drawing", Shell),
    ("facade", Shell),
    ("ide", Shell),
    ("report", Shell),
    ("fs", Shell),
    ("view", Shell),
    ("lsp", Shell),
    ("cli", Shell),
    ("lib", Shell),
    ("main", Shell),
];

/// The part that a module plays in the chain.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Part {
    /// Used by all; uses foundations and plain types of nouns.
    Foundation,
    /// A tree between two passes: no verb.
    Noun,
    /// A pass: nouns and foundations, no other verb.
    Verb,
    /// Puts passes together.
    Shell,
}
use Part::{Foundation, Noun, Shell, Verb};

/// Uses that the order does not allow but a reason does: user, path, reason.
const ALLOWED: &[(&str, &str, &str)] = &[
    (
        "tessellate",
        "roof::solid",
        "details without joinery show roofs that meet as one solid, made once for all roofs that share a mesh",
    ),
    (
        "print",
        "parse",
        "legacy lines are laid out by the kinds that their reader finds, and a layout is checked by reading it again",
    ),
];

/// Files that may be longer, since they are tables.
const LONG_FILES: &[&str] = &[];

/// Functions that may be longer, since they are tables: file and name.
const LONG_FUNCTIONS: &[(&str, &str)] = &[];

/// Files directly in a folder below `src/`.
const FOLDER_FILES: usize = 16;
const FILE_LINES: usize = 500;
const FUNCTION_LINES: usize = 60;

struct File {
    /// Path below `src/`.
    name: String,
    text: String,
}

impl File {
    /// The top module: the first segment of the path without its ending.
    fn module(&self) -> &str {
        let end = self.name.find(['/', '.']).unwrap_or(self.name.len());
        &self.name[..end]
    }

    /// Whether it holds nothing but tests.
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

fn sources() -> Vec<File> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = vec![];
    let mut folders = vec![root.clone()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).expect("src/ can be listed") {
            let path: PathBuf = entry.expect("src/ can be listed").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|e| e == "rs") {
                let text = fs::read_to_string(&path).expect("sources are UTF-8");
                let below = path.strip_prefix(&root).expect("is below src/");
                let name = below.to_string_lossy().replace('\\', "/");
                files.push(File { name, text });
            }
        }
    }
    files.sort_by(|a, b| a.name.cmp(&b.name));
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

fn rank(module: &str) -> Option<usize> {
    ORDER.iter().position(|(name, _)| *name == module)
}

/// Whether a file of `module` may use `path`.
fn may_use(file: &str, module: &str, path: &str) -> bool {
    let used = path.split("::").next().unwrap_or_default();
    let Some(of_used) = rank(used) else {
        return true; // an item of lib.rs, such as a function at the crate's root
    };
    let Some(own) = rank(module) else {
        return false;
    };
    // Messages show what a pass found, so they name its plain types, never its functions.
    let a_type = path
        .rsplit("::")
        .next()
        .is_some_and(|last| last.starts_with(char::is_uppercase));
    let verb_of_verb = ORDER[own].1 == Verb && ORDER[of_used].1 == Verb && own != of_used;
    (of_used <= own && !verb_of_verb)
        || (file.starts_with("diagnostic/messages/") && a_type)
        || ALLOWED
            .iter()
            .any(|(user, what, _)| *user == module && path.starts_with(what))
}

#[test]
fn modules_use_only_what_stands_before_them() {
    let mut findings = vec![];
    for file in sources() {
        let module = file.module();
        if rank(module).is_none() {
            findings.push(format!("src/{}: has no place in ORDER", file.name));
            continue;
        }
        if file.is_test() || module == "lib" {
            continue;
        }
        let code: Vec<&str> = file.code().map(|(_, line)| line).collect();
        for path in crate_paths(&code.join("\n")) {
            if !may_use(&file.name, module, &path) {
                findings.push(format!(
                    "src/{}: `{module}` must not use `crate::{path}`",
                    file.name
                ));
            }
        }
    }
    assert_none(&findings);
}

#[test]
fn every_file_has_a_header() {
    let findings: Vec<String> = sources()
        .iter()
        .filter(|file| !file.text.starts_with("//!"))
        .map(|file| format!("src/{}: begins without a `//!` header", file.name))
        .collect();
    assert_none(&findings);
}

#[test]
fn files_are_short() {
    let findings: Vec<String> = sources()
        .iter()
        .filter(|file| !LONG_FILES.contains(&file.name.as_str()))
        .filter(|file| file.text.lines().count() > FILE_LINES)
        .map(|file| format!("src/{}: {} lines", file.name, file.text.lines().count()))
        .collect();
    assert_none(&findings);
}

#[test]
fn folders_are_small() {
    let mut files: std::collections::BTreeMap<String, usize> = Default::default();
    for file in sources() {
        if let Some((folder, _)) = file.name.rsplit_once('/') {
            *files.entry(folder.to_owned()).or_default() += 1;
        }
    }
    let large = files.iter().filter(|(_, count)| **count > FOLDER_FILES);
    let findings: Vec<String> = large
        .map(|(folder, count)| format!("src/{folder}: {count} files"))
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
                let a_table = LONG_FUNCTIONS.contains(&(file.name.as_str(), name));
                if closes && length > FUNCTION_LINES && !a_table {
                    findings.push(format!(
                        "src/{}:{start}: `{name}` has {length} lines",
                        file.name
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
    assert!(!may_use("scene.rs", "scene", "roof::cut"));
    assert!(may_use("building.rs", "building", "geometry::plan::Cell"));
    assert!(may_use(
        "diagnostic/messages/plan.rs",
        "diagnostic",
        "lower::Fix"
    ));
    assert!(!may_use("lower/walk.rs", "lower", "roof::roof"));
    assert!(!may_use("roof/house.rs", "roof", "lower::lower"));
}
