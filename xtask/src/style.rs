//! `style`: checks comments, messages and Markdown against the style guide.
//!
//! The rules are the rows of [`GLOSSARY`] ("Words not to use") that are marked as checkable, and a few rules for
//! sentences. Findings are counted by crate and rule; the numbers in [`COUNTS`] are committed and may only fall.

mod counts;
mod files;
mod glossary;
mod markdown;
mod passage;
mod rules;
mod rust;
mod sentences;

use counts::Counts;
use files::{Repository, area};
use glossary::WordTable;
use passage::{Block, Source};
use rules::{Finding, SENTENCE_RULES};
use std::collections::{BTreeMap, BTreeSet};
use std::io::{self, ErrorKind, Write};
use std::ops::Range;
use std::path::Path;
use std::process::ExitCode;

/// Page with the table of odd words, relative to the root.
const GLOSSARY: &str = "docs/glossary.md";

/// File of the committed counts, relative to the root.
const COUNTS: &str = "xtask/style.txt";

/// Maximum number of findings that the check prints for a crate and rule.
const PRINTED: usize = 20;

const USAGE: &str = "\
Usage: cargo run -p xtask -- style [--update | [--since COMMIT] PATH...]

Without arguments: compares the findings with the counts in xtask/style.txt.
If a count has risen, prints the new findings and returns exit code 1.

  PATH...         List every finding in these files and folders
  --since COMMIT  List only findings on lines changed since a commit
  --update        Write the counts; refused if the total of a rule rises

The total of a rule may rise when the rule itself is extended: delete its lines
in xtask/style.txt, then run with --update.

Rules besides the table \"Words not to use\" in docs/glossary.md:
";

/// Runs the task and prints its results to `out`.
///
/// # Errors
/// If an argument is unknown, a file cannot be read or written, or Git fails.
pub(crate) fn run(arguments: &[String], out: &mut dyn Write) -> io::Result<ExitCode> {
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    if let ["-h" | "--help"] = arguments[..] {
        out.write_all(USAGE.as_bytes())?;
        for (rule, meaning) in SENTENCE_RULES {
            writeln!(out, "  {rule:<13}  {meaning}")?;
        }
        return Ok(ExitCode::SUCCESS);
    }
    let here = std::env::current_dir()?;
    let linter = Linter::open(&here)?;
    match arguments[..] {
        [] => linter.check(out),
        ["--update"] => linter.update(out),
        ["--since", commit, ref paths @ ..] if !commit.starts_with('-') => {
            let changed = linter.repository.changed_since(commit)?;
            linter.list(&here, paths, Some(&changed), out)
        }
        ref paths if paths.iter().all(|path| !path.starts_with('-')) => {
            linter.list(&here, paths, None, out)
        }
        _ => Err(io::Error::other("unknown arguments; see `style --help`")),
    }
}

/// Changed lines by file.
type Changes = BTreeMap<String, Vec<Range<usize>>>;

struct Linter {
    repository: Repository,
    table: WordTable,
}

impl Linter {
    fn open(here: &Path) -> io::Result<Linter> {
        let repository = Repository::around(here)?;
        let page = std::fs::read_to_string(repository.root.join(GLOSSARY))?;
        let table =
            WordTable::read(&page).map_err(|why| io::Error::other(format!("{GLOSSARY}: {why}")))?;
        Ok(Linter { repository, table })
    }

    /// Returns the findings of each file, in the order of files and lines.
    fn findings(&self, files: BTreeSet<String>) -> io::Result<Vec<(String, Finding)>> {
        let mut all = Vec::new();
        for path in files {
            let text = std::fs::read_to_string(self.repository.root.join(&path));
            let text = text.map_err(|why| io::Error::other(format!("{path}: {why}")))?;
            all.extend(
                check_file(&path, &text, &self.table)
                    .into_iter()
                    .map(|finding| (path.clone(), finding)),
            );
        }
        Ok(all)
    }

    fn all_findings(&self) -> io::Result<(Vec<(String, Finding)>, Counts)> {
        let findings = self.findings(self.repository.files()?)?;
        let mut counts = Counts::default();
        for (path, finding) in &findings {
            counts.add(area(path), &finding.rule);
        }
        Ok((findings, counts))
    }

    /// Reads the committed counts; `None` if the file is missing.
    fn committed(&self) -> io::Result<Option<Counts>> {
        match std::fs::read_to_string(self.repository.root.join(COUNTS)) {
            Ok(text) => match Counts::read(&text) {
                Ok(counts) => Ok(Some(counts)),
                Err(why) => Err(io::Error::other(format!("{COUNTS}: {why}"))),
            },
            Err(why) if why.kind() == ErrorKind::NotFound => Ok(None),
            Err(why) => Err(why),
        }
    }

    fn check(&self, out: &mut dyn Write) -> io::Result<ExitCode> {
        let Some(old) = self.committed()? else {
            return Err(io::Error::other(format!(
                "{COUNTS} is missing; write it with `style --update`"
            )));
        };
        let (findings, new) = self.all_findings()?;
        let risen = new.risen(&old);
        if risen.is_empty() {
            writeln!(
                out,
                "style: {} findings, {} committed",
                new.sum(),
                old.sum()
            )?;
            if new.sum() < old.sum() {
                writeln!(
                    out,
                    "Run `cargo run -p xtask -- style --update` to commit the lower counts."
                )?;
            }
            return Ok(ExitCode::SUCCESS);
        }
        // Without a history, all findings of a rule are printed.
        let commit = self.repository.last_commit(COUNTS);
        let changes = self.repository.changed_since(&commit).unwrap_or_default();
        for (area_name, rule, before, now) in risen {
            writeln!(
                out,
                "{area_name}: {rule}: {now} findings, {before} committed"
            )?;
            let of_rule = |(path, finding): &&(String, Finding)| {
                area(path) == area_name && finding.rule == rule
            };
            let found: Vec<_> = findings.iter().filter(of_rule).collect();
            let new = found
                .iter()
                .copied()
                .filter(|(path, finding)| is_changed(&changes, path, finding));
            let mut printed: Vec<_> = new.collect();
            if printed.is_empty() {
                printed = found;
            }
            for (path, finding) in printed.iter().take(PRINTED) {
                write_finding(out, path, finding)?;
            }
            if let Some(rest) = printed.len().checked_sub(PRINTED + 1) {
                writeln!(out, "  and {} more", rest + 1)?;
            }
        }
        writeln!(
            out,
            "Fix the new findings. If they only moved between crates, run with --update."
        )?;
        Ok(ExitCode::FAILURE)
    }

    fn update(&self, out: &mut dyn Write) -> io::Result<ExitCode> {
        let old = self.committed()?.unwrap_or_default();
        let (_, new) = self.all_findings()?;
        let risen = new.risen_totals(&old);
        for (rule, before, now) in &risen {
            writeln!(
                out,
                "{rule}: {now} findings in all crates, {before} committed; run `style` to list them"
            )?;
        }
        if !risen.is_empty() {
            return Ok(ExitCode::FAILURE);
        }
        let words = self.table.rows.iter().map(|row| row.rule());
        let rules = SENTENCE_RULES.iter().map(|(rule, _)| *rule).chain(words);
        std::fs::write(self.repository.root.join(COUNTS), new.write(rules))?;
        writeln!(out, "style: {} findings written to {COUNTS}", new.sum())?;
        Ok(ExitCode::SUCCESS)
    }

    /// Prints the findings below some paths, or below the root if none is given.
    fn list(
        &self,
        here: &Path,
        paths: &[&str],
        changes: Option<&Changes>,
        out: &mut dyn Write,
    ) -> io::Result<ExitCode> {
        let mut wanted = Vec::new();
        for path in paths {
            let full = here.join(path).canonicalize();
            let full = full.map_err(|why| io::Error::other(format!("{path}: {why}")))?;
            wanted.push(full);
        }
        let root = self.repository.root.canonicalize()?;
        let mut files = self.repository.files()?;
        files.retain(|path| {
            wanted.is_empty()
                || wanted
                    .iter()
                    .any(|wanted| root.join(path).starts_with(wanted))
        });
        let findings = self.findings(files)?;
        let listed = |(path, finding): &&(String, Finding)| {
            changes.is_none_or(|c| is_changed(c, path, finding))
        };
        for (path, finding) in findings.iter().filter(listed) {
            write_finding(out, path, finding)?;
        }
        Ok(ExitCode::SUCCESS)
    }
}

fn is_changed(changes: &Changes, path: &str, finding: &Finding) -> bool {
    changes
        .get(path)
        .is_some_and(|ranges| ranges.iter().any(|range| range.contains(&finding.line)))
}

fn write_finding(out: &mut dyn Write, path: &str, finding: &Finding) -> io::Result<()> {
    let mut found: String = finding.found.chars().take(70).collect();
    if found.len() < finding.found.len() {
        found.push('…');
    }
    let Finding {
        rule, line, advice, ..
    } = finding;
    writeln!(out, "{path}:{line}: {rule}: \"{found}\"; {advice}")
}

/// Returns the findings of one file in the order of its lines.
fn check_file(path: &str, text: &str, table: &WordTable) -> Vec<Finding> {
    let blocks = if path.ends_with(".rs") {
        rust::blocks(text)
    } else {
        vec![markdown_block(path, text)]
    };
    let is_changelog = path.ends_with("CHANGELOG.md");
    let passages = blocks.iter().flat_map(markdown::passages);
    let mut findings: Vec<_> = passages
        .flat_map(|passage| rules::check(&passage, table, is_changelog))
        .collect();
    findings.sort_by_key(|finding| finding.line);
    findings
}

/// Returns the lines of a Markdown file, of the glossary without its list of odd words.
fn markdown_block(path: &str, text: &str) -> Block {
    let mut in_list = false;
    let mut lines = Vec::new();
    for (number, line) in (1..).zip(text.lines()) {
        if line.starts_with("## ") {
            in_list = path == GLOSSARY && line == glossary::SECTION;
        }
        if !in_list {
            lines.push((number, line.to_owned()));
        }
    }
    let source = Source::Markdown;
    Block { source, lines }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PAGE: &str = "## Words not to use\n\n| not | but | reason | checked |\n|---|---|---|---|\n\
        | of its own, of their own | separate | | yes |\n| as it is | unchanged | | yes |\n\
        | gray, color | grey, colour | | yes |\n| goes on | continues | | yes |\n";

    /// Returns rule and line of each finding.
    fn found(path: &str, text: &str) -> Vec<(String, usize)> {
        let table = WordTable::read(PAGE).unwrap();
        check_file(path, text, &table)
            .into_iter()
            .map(|f| (f.rule, f.line))
            .collect()
    }

    fn assert_found(path: &str, text: &str, expected: &[(&str, usize)]) {
        let expected: Vec<_> = expected
            .iter()
            .map(|(rule, line)| ((*rule).to_owned(), *line))
            .collect();
        assert_eq!(found(path, text), expected, "{text}");
    }

    #[test]
    fn openings_of_doc_comments() {
        assert_found(
            "a.rs",
            "/// What it is.\n\n//! Where it is.\n\n/// The same, again.",
            &[("opening", 1), ("opening", 3), ("opening", 5)],
        );
        assert_found(
            "a.rs",
            "/// Returns it.\n/// What for.\n\n// How it works.\n\n/// Howard. The sameness.\n/// `What`",
            &[],
        );
        assert_found("a.md", "What it is.", &[]);
    }

    #[test]
    fn long_sentences() {
        let words = |count: usize| vec!["word"; count].join(" ");
        assert_found(
            "a.md",
            &format!("A short one. Then {}.", words(25)),
            &[("long-sentence", 1)],
        );
        assert_found(
            "a.md",
            &format!("{}.\nThen `{}` {}.", words(25), words(9), words(22)),
            &[],
        );
        assert_found(
            "a.rs",
            &format!("/// One.\n/// Two\n/// {}.", words(25)),
            &[("long-sentence", 2)],
        );
        assert_found("a.md", &format!("| {}; {} |", words(20), words(20)), &[]);
        assert_found(
            "a.rs",
            &format!("text!(\n\"{}\", \"\")", words(26)),
            &[("long-sentence", 2)],
        );
    }

    #[test]
    fn examples_in_help_are_not_sentences() {
        let words = vec!["word"; 20].join(" ");
        let help = format!(
            "#[command(after_help = \"\\\nHelp:\n  {words} {words}\n\n{words}\n{words}\")]"
        );
        assert_found("a.rs", &help, &[("long-sentence", 5)]);
    }

    #[test]
    fn semicolons() {
        assert_found("a.rs", "// a; b; c", &[("semicolons", 1)]);
        assert_found("a.rs", "// a; b. C; `d; e`;", &[]);
        assert_found("a.md", "| a; b; c | d |", &[]);
    }

    #[test]
    fn is_no() {
        for text in [
            "It is no square.",
            "Those that are none.",
            "If it is none, stop.",
            "What is no area has none.",
        ] {
            assert_found("a.md", text, &[("is-no", 1)]);
        }
        for text in [
            "There is no wall.",
            "there usually is no wall",
            "It is no longer there.",
            "It is no wider than that.",
            "It is none of them.",
            "The default is no.",
            "If there are none.",
            "The answer is no, or",
        ] {
            assert_found("a.md", text, &[]);
        }
    }

    #[test]
    fn long_bullets_of_changelogs() {
        let long = format!("- {}", vec!["word"; 31].join(" "));
        assert_found("CHANGELOG.md", &long, &[("long-bullet", 1)]);
        assert_found("a.md", &long, &[("long-sentence", 1)]);
        assert_found("CHANGELOG.md", &long[..long.len() - 5], &[]);
    }

    #[test]
    fn odd_words() {
        assert_found(
            "a.rs",
            "// A gray wall; Color.",
            &[("gray", 1), ("gray", 1)],
        );
        assert_found(
            "a.rs",
            "// a `gray` wall, color_of, colors, grayish, grey",
            &[],
        );
        assert_found(
            "a.rs",
            "let gray = \"gray\"; noun(\"gray\", \"gray\")",
            &[("gray", 1)],
        );
        assert_found("a.md", "It goes\non.", &[("goes on", 1)]);
        assert_found("a.md", "it goes: on", &[]);
    }

    #[test]
    fn phrases_at_the_end_of_a_clause() {
        for text in [
            "a file of its own",
            "a file of its own, too",
            "as it is in the file",
            "of their own and",
        ] {
            assert_eq!(found("a.md", text).len(), 1, "{text}");
        }
        for text in [
            "a file of its own feature",
            "as it is written",
            "as long as it is wide",
        ] {
            assert_found("a.md", text, &[]);
        }
    }

    #[test]
    fn the_list_of_odd_words_is_not_examined() {
        let page = format!("gray\n\n{PAGE}\n## Next\n\ngray\n");
        assert_found("docs/glossary.md", &page, &[("gray", 1), ("gray", 14)]);
    }
}
