//! The graph of crates in `docs/architecture.md`, compared with the manifests.

use super::root;
use std::collections::BTreeMap;
use std::fs;

/// The line before the graph and the line after it.
const FENCES: [&str; 2] = ["```text crates\n", "```\n"];

/// Folders of the crates that are data, not code.
const DATA: [&str; 5] = ["examples", "grammar", "library", "textures", "view"];

/// Returns the crates of the workspace that a manifest names as dependencies: all, then those only for tests.
fn dependencies(manifest: &str) -> [Vec<String>; 2] {
    let mut found = [vec![], vec![]];
    let mut section = "";
    for line in manifest.lines() {
        if line.starts_with('[') {
            section = line;
        }
        let kind = match section {
            "[dependencies]" => 0,
            "[dev-dependencies]" => 1,
            _ => continue,
        };
        let name = line.split([' ', '.']).next().unwrap_or_default();
        if let Some(short) = name.strip_prefix("hsd-") {
            found[kind].push(short.to_owned());
        }
    }
    found
}

/// Returns the crates by their short names, with what they depend on.
fn graph() -> BTreeMap<String, [Vec<String>; 2]> {
    let mut graph = BTreeMap::new();
    let mut folders: Vec<_> = super::crates();
    folders.extend(DATA.map(str::to_owned));
    for folder in folders.iter().filter(|f| *f != "xtask") {
        let manifest = fs::read_to_string(root().join(folder).join("Cargo.toml"));
        let manifest = manifest.expect("a crate has a manifest");
        let package = manifest.split("[package]\nname = \"").nth(1);
        let name = package.and_then(|rest| rest.split('"').next());
        let name = name.expect("a package has a name");
        let short = name.strip_prefix("hsd-").unwrap_or(name).to_owned();
        graph.insert(short, dependencies(&manifest));
    }
    graph
}

/// Orders the crates so that each follows all that it depends on; what is left over is on a circle.
fn ordered(graph: &BTreeMap<String, [Vec<String>; 2]>) -> (Vec<&str>, Vec<&str>) {
    let mut done: Vec<&str> = vec![];
    let mut left: Vec<&str> = graph.keys().map(String::as_str).collect();
    loop {
        let is_ready = |name: &&str| {
            let [used, tested] = &graph[*name];
            let mut all = used.iter().chain(tested);
            all.all(|used| done.contains(&used.as_str()))
        };
        let (ready, rest): (Vec<&str>, Vec<&str>) = left.iter().copied().partition(is_ready);
        if ready.is_empty() {
            return (done, rest);
        }
        done.extend(ready);
        left = rest;
    }
}

#[test]
fn the_graph_of_the_page_is_that_of_the_manifests() {
    let graph = graph();
    let (done, circle) = ordered(&graph);
    assert!(circle.is_empty(), "on a circle: {circle:?}");
    let lines = done.iter().map(|name| match &graph[*name][0][..] {
        [] => format!("{name}\n"),
        used => format!("{name:<9} {}\n", used.join(" ")),
    });
    let wanted: String = lines.collect();
    let path = root().join("docs/architecture.md");
    let page = fs::read_to_string(&path).expect("the page exists");
    let (before, rest) = page.split_once(FENCES[0]).expect("the page has a graph");
    let (printed, after) = rest.split_once(FENCES[1]).expect("the graph ends");
    if std::env::var_os("HSD_UPDATE").is_some() {
        let text = [before, FENCES[0], &wanted, FENCES[1], after].concat();
        fs::write(path, text).expect("the page can be written");
    } else {
        assert_eq!(printed, wanted, "HSD_UPDATE=1 rewrites the graph");
    }
}
