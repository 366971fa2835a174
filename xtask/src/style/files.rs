//! Files of the repository and their changed lines, as Git reports them.

use std::collections::{BTreeMap, BTreeSet};
use std::io;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The work tree of the repository.
#[derive(Debug)]
pub(crate) struct Repository {
    /// Absolute path of the root.
    pub(crate) root: PathBuf,
}

impl Repository {
    /// Returns the repository around a folder: the nearest one above it that has the glossary.
    ///
    /// # Errors
    /// If there is none.
    pub(crate) fn around(folder: &Path) -> io::Result<Repository> {
        let mut folders = folder
            .ancestors()
            .filter(|f| f.join(super::GLOSSARY).is_file());
        let root = folders.next().map(Path::to_path_buf);
        let missing =
            || io::Error::other(format!("no folder from here up has {}", super::GLOSSARY));
        root.map(|root| Repository { root }).ok_or_else(missing)
    }

    /// Returns the Rust and English Markdown files, sorted: tracked ones and new ones that are not ignored.
    ///
    /// # Errors
    /// If Git fails.
    pub(crate) fn files(&self) -> io::Result<BTreeSet<String>> {
        let listed = self.git(&[
            "ls-files",
            "-z",
            "--cached",
            "--others",
            "--exclude-standard",
        ])?;
        let files = listed.split('\0').filter(|path| is_examined(path));
        let present = files.filter(|path| self.root.join(path).is_file());
        Ok(present.map(str::to_owned).collect())
    }

    /// Returns the commit that last changed a file, or `HEAD` if none did.
    pub(crate) fn last_commit(&self, path: &str) -> String {
        let commit = self
            .git(&["log", "-1", "--format=%H", "--", path])
            .unwrap_or_default();
        let commit = commit.trim();
        if commit.is_empty() { "HEAD" } else { commit }.to_owned()
    }

    /// Returns the lines that differ from a commit, by file. Files that Git does not track yet are changed as a whole.
    ///
    /// # Errors
    /// If Git fails, as for an unknown commit.
    pub(crate) fn changed_since(
        &self,
        commit: &str,
    ) -> io::Result<BTreeMap<String, Vec<Range<usize>>>> {
        let options = [
            "-c",
            "core.quotePath=false",
            "diff",
            "-U0",
            "-M",
            "--no-color",
            "--no-ext-diff",
        ];
        let diff = self.git(
            &[
                &options[..],
                &["--src-prefix=a/", "--dst-prefix=b/", commit, "--"],
            ]
            .concat(),
        )?;
        let mut changed = changed_lines(&diff);
        for path in self
            .git(&["ls-files", "-z", "--others", "--exclude-standard"])?
            .split('\0')
        {
            let whole = 0..usize::MAX;
            changed.entry(path.to_owned()).or_default().push(whole);
        }
        Ok(changed)
    }

    fn git(&self, arguments: &[&str]) -> io::Result<String> {
        let mut command = Command::new("git");
        command
            .arg("-C")
            .arg(&self.root)
            .args(arguments)
            .env("GIT_OPTIONAL_LOCKS", "0");
        let output = command.output()?;
        if !output.status.success() {
            let reason = String::from_utf8_lossy(&output.stderr);
            return Err(io::Error::other(format!(
                "git {}: {}",
                arguments.join(" "),
                reason.trim()
            )));
        }
        Ok(String::from_utf8_lossy(&output.stdout).into_owned())
    }
}

/// Reads the added lines of each file from a diff without context.
fn changed_lines(diff: &str) -> BTreeMap<String, Vec<Range<usize>>> {
    let mut changed: BTreeMap<String, Vec<Range<usize>>> = BTreeMap::new();
    let mut file = String::new();
    for line in diff.lines() {
        if let Some(path) = line.strip_prefix("+++ b/") {
            file = path.trim_end_matches('\t').to_owned();
        } else if let Some(hunk) = line.strip_prefix("@@ ").and_then(added) {
            changed.entry(file.clone()).or_default().push(hunk);
        }
    }
    changed
}

/// Reads the lines after the change from the head of a hunk: `-1,2 +3,4 @@`.
fn added(hunk: &str) -> Option<Range<usize>> {
    let (start, length) = {
        let after = hunk.split(' ').find_map(|part| part.strip_prefix('+'))?;
        after.split_once(',').unwrap_or((after, "1"))
    };
    let start: usize = start.parse().ok()?;
    let length: usize = length.parse().ok()?;
    Some(start..start + length)
}

/// Returns true for Rust files and English Markdown.
fn is_examined(path: &str) -> bool {
    let is_japanese = path.ends_with(".ja.md") || path.contains("/ja/");
    path.ends_with(".rs") || (path.ends_with(".md") && !is_japanese)
}

/// Returns the crate that counts a file: `crates/NAME`, the first folder, or `.` for files of the root.
pub(crate) fn area(path: &str) -> &str {
    let skipped = if path.starts_with("crates/") {
        "crates/".len()
    } else {
        0
    };
    path[skipped..]
        .find('/')
        .map_or(".", |end| &path[..skipped + end])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_counted_by_crate() {
        let paths = [
            "README.md",
            "src/a/b.rs",
            "crates/hsd-roof/src/a.rs",
            "crates/README.md",
            "grammar/a.md",
        ];
        assert_eq!(
            paths.map(area),
            [".", "src", "crates/hsd-roof", ".", "grammar"]
        );
    }

    #[test]
    fn japanese_pages_and_other_files_are_skipped() {
        let skipped = [
            "README.ja.md",
            "grammar/diagnostics/ja/HSD0001.md",
            "a.toml",
            "",
        ];
        assert!(skipped.iter().all(|path| !is_examined(path)));
        assert!(["a.rs", "b/c.md"].iter().all(|path| is_examined(path)));
    }

    #[test]
    fn added_lines_are_read_from_a_diff() {
        let diff = "--- a/x.rs\n+++ b/y z.rs\t\n@@ -1 +1,2 @@ fn f\n+a\n+b\n@@ -9,2 +10,0 @@\n-c\n@@ -20 +20 @@\n";
        let changed = changed_lines(diff);
        assert_eq!(changed["y z.rs"], [1..3, 10..10, 20..21]);
    }
}
