//! Circles between modules: below every folder, the modules that stand side by side use each other one way only.

use super::{File, assert_none, crates, paths_at, sources};
use std::collections::{BTreeMap, BTreeSet};

type Graph = BTreeMap<String, BTreeSet<String>>;

/// `roof/plan/level.rs` as `roof::plan::level`.
fn module_of(file: &File) -> String {
    file.name.trim_end_matches(".rs").replace('/', "::")
}

/// The parent of a module, empty for one at the root.
fn parent(module: &str) -> &str {
    module.rsplit_once("::").map_or("", |(parent, _)| parent)
}

fn joined(parent: &str, rest: &str) -> String {
    match parent {
        "" => rest.to_owned(),
        _ => format!("{parent}::{rest}"),
    }
}

/// The paths that a file names by `crate::` and `super::`, from the root.
fn used(module: &str, code: &str) -> Vec<String> {
    let mut found = vec![];
    for (at, word) in code.match_indices("crate::") {
        found.extend(paths_at(&code[at + word.len()..]));
    }
    for (at, word) in code.match_indices("super::") {
        if code[..at].ends_with("super::") {
            continue;
        }
        let (mut base, mut rest) = (parent(module), &code[at + word.len()..]);
        while let Some(after) = rest.strip_prefix(word) {
            (base, rest) = (parent(base), after);
        }
        found.extend(paths_at(rest).iter().map(|path| joined(base, path)));
    }
    found
}

/// The longest beginning of a path that is a module.
fn module_in<'a>(path: &'a str, modules: &BTreeSet<String>) -> Option<&'a str> {
    let mut path = path;
    while !modules.contains(path) {
        path = path.rsplit_once("::")?.0;
    }
    Some(path)
}

/// The child of `folder` that holds the module, if it lies below the folder.
fn child<'a>(folder: &str, module: &'a str) -> Option<&'a str> {
    let below = match folder {
        "" => module,
        _ => module.strip_prefix(folder)?.strip_prefix("::")?,
    };
    below.split("::").next()
}

/// Who uses whom, module by module.
fn uses(files: &[&File]) -> Graph {
    let modules: BTreeSet<String> = files.iter().map(|file| module_of(file)).collect();
    let mut graph = Graph::new();
    for file in files.iter().filter(|f| !f.is_test()) {
        let module = module_of(file);
        if ["lib", "main"].contains(&&*module) {
            continue; // the parents of all, not siblings
        }
        let code: Vec<&str> = file.code().map(|(_, line)| line).collect();
        let paths = used(&module, &code.join("\n"));
        let found = paths.iter().filter_map(|path| module_in(path, &modules));
        let own = graph.entry(module.clone()).or_default();
        own.extend(found.filter(|m| *m != module).map(str::to_owned));
    }
    graph
}

/// The same between the children of a folder.
fn siblings(folder: &str, uses: &Graph) -> Graph {
    let mut graph = Graph::new();
    for (user, used) in uses {
        let Some(a) = child(folder, user) else {
            continue;
        };
        let others = used.iter().filter_map(|m| child(folder, m));
        let others = others.filter(|b| *b != a).map(str::to_owned);
        graph.entry(a.to_owned()).or_default().extend(others);
    }
    graph
}

/// The modules that can be reached from one.
fn reached(graph: &Graph, from: &str) -> BTreeSet<String> {
    let (mut seen, mut open) = (BTreeSet::new(), vec![from.to_owned()]);
    while let Some(next) = open.pop() {
        for used in graph.get(&next).into_iter().flatten() {
            if seen.insert(used.clone()) {
                open.push(used.clone());
            }
        }
    }
    seen
}

/// The members of circles.
fn circle(graph: &Graph) -> Vec<&str> {
    let on_one = |module: &&String| reached(graph, module).contains(*module);
    graph.keys().filter(on_one).map(|m| &**m).collect()
}

#[test]
fn modules_side_by_side_use_each_other_one_way() {
    let files = sources();
    let mut findings = vec![];
    for crate_folder in crates() {
        let own: Vec<&File> = files.iter().filter(|f| f.folder == crate_folder).collect();
        let uses = uses(&own);
        let mut folders: BTreeSet<String> = uses.keys().map(|m| parent(m).to_owned()).collect();
        folders.insert(String::new());
        for folder in &folders {
            let graph = siblings(folder, &uses);
            let found = circle(&graph);
            if !found.is_empty() {
                findings.push(format!(
                    "{crate_folder}/src/{folder}: the circle is {found:?}"
                ));
            }
        }
    }
    assert_none(&findings);
}

#[test]
fn circles_are_found() {
    let graph: Graph = [
        ("a", vec!["b"]),
        ("b", vec!["c"]),
        ("c", vec!["b"]),
        ("d", vec![]),
    ]
    .into_iter()
    .map(|(m, used)| (m.to_owned(), used.into_iter().map(str::to_owned).collect()))
    .collect();
    assert_eq!(circle(&graph), ["b", "c"]);
    assert_eq!(
        used(
            "roof::plan::level",
            "use super::super::solid::sheet; use super::{a, b::c}; crate::x::y()"
        ),
        [
            "x::y",
            "roof::solid::sheet",
            "roof::plan::a",
            "roof::plan::b::c"
        ]
    );
}
