//! Japanese help and usage errors.
//!
//! clap supports English only. Help texts are replaced by those of the table in [`help`], clap's own words ("Usage",
//! "default") by templates, and error messages by [`errors`].

mod errors;
mod help;

pub(crate) use errors::error_message;

use crate::files::terminal;
use clap::builder::PossibleValue;
use clap::{Arg, Command};
use help::draw::DRAW;
use help::facade::FACADE;
use help::plan::PLAN;
use help::render::RENDER;
use help::town::TOWN;
use help::{COMMANDS, COMMON, CommandHelp};

/// Where help is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Medium {
    /// At a terminal: lines are broken here.
    Terminal,
    /// On a manual page: `man` breaks lines, and begins one for each that begins with a blank.
    Page,
}

/// The width of help texts in columns.
const COLUMNS: usize = 76;

const TEMPLATE: &str = "{about-with-newline}\n使い方: {usage}\n\n{all-args}{after-help}";

/// The headings of manual pages.
const HEADINGS: [(&str, &str); 5] = [
    // Blanks between words are few in Japanese: a justified line would stretch them.
    (".SH NAME", ".ad l\n.SH 名前"),
    (".SH SYNOPSIS", ".SH 書式"),
    (".SH DESCRIPTION", ".SH 説明"),
    (".SH EXTRA", ".SH 補足"),
    (".SH VERSION", ".SH バージョン"),
];

/// Translates the help of a command and its subcommands.
pub(crate) fn command(mut english: Command) -> Command {
    english.build();
    translated(english, "", Medium::Terminal)
}

/// Translates what manual pages are made of.
pub(crate) fn for_pages(mut english: Command) -> Command {
    english.build();
    translated(english, "", Medium::Page)
}

/// Translates the headings of a manual page.
pub(crate) fn page(english: &str) -> String {
    let heading = |line: &str| {
        let known = HEADINGS.iter().find(|(heading, _)| *heading == line);
        known.map_or(line, |(_, japanese)| japanese).to_owned() + "\n"
    };
    english.lines().map(heading).collect()
}

fn translated(mut command: Command, path: &str, medium: Medium) -> Command {
    let usage = command.render_usage().to_string();
    let usage = usage.trim_start_matches("Usage: ");
    let usage = ["[OPTIONS]", "[COMMAND]", "<COMMAND>"]
        .iter()
        .zip(["[オプション]", "[コマンド]", "<コマンド>"])
        .fold(usage.to_owned(), |text, (en, ja)| text.replace(en, ja));
    // The subcommands of `hsd help` have the entries of the commands they describe.
    let entry = COMMANDS
        .iter()
        .chain(TOWN)
        .chain(DRAW)
        .chain(RENDER)
        .chain(PLAN)
        .chain(FACADE)
        .find(|w| w.path == path);
    let below = |name: &str| match path {
        "" | "help" => name.to_owned(),
        _ => format!("{path} {name}"),
    };
    let command = command
        .help_template(TEMPLATE)
        .override_usage(usage)
        .subcommand_help_heading("コマンド")
        .mut_args(|arg| argument(arg, entry, medium))
        .mut_subcommands(|sub| {
            let path = below(sub.get_name());
            translated(sub, &path, medium)
        });
    let Some(entry) = entry else { return command };
    let about = folded(entry.about, medium);
    let long = match entry.more {
        "" => about.clone(),
        more => format!("{about}\n\n{}", folded(more, medium)),
    };
    let command = command.about(about).long_about(long);
    match entry.examples {
        "" => command,
        examples => command.after_help(examples),
    }
}

/// Translates the help, values and default of an argument.
fn argument(arg: Arg, entry: Option<&CommandHelp>, medium: Medium) -> Arg {
    let heading = match arg.is_positional() {
        true => "引数",
        false => "オプション",
    };
    let arg = arg
        .help_heading(heading)
        .hide_default_value(true)
        .hide_possible_values(true);
    let specific = entry.map_or(&[][..], |e| e.arguments);
    let mut known = specific.iter().chain(COMMON);
    let Some((_, help, more)) = known.find(|(id, ..)| *id == arg.get_id().as_str()) else {
        return arg;
    };
    let takes_values = arg.get_action().takes_values();
    let values = match takes_values {
        true => arg.get_possible_values(),
        false => vec![],
    };
    let defaults = arg.get_default_values().iter().map(|v| v.to_string_lossy());
    let default = match defaults.collect::<Vec<_>>().join(" ") {
        text if text.is_empty() || !takes_values => String::new(),
        text => format!(" [既定値: {text}]"),
    };
    let names: Vec<&str> = values.iter().map(PossibleValue::get_name).collect();
    let choice = match names.is_empty() {
        true => String::new(),
        false => format!(" [値: {}]", names.join(", ")),
    };
    let mut long = folded(&format!("{help}{default}"), medium);
    if !more.is_empty() {
        long += &format!("\n\n{}", folded(more, medium));
    }
    if !values.is_empty() {
        long += "\n\n値:";
        let lines = values.iter().map(|value| listed(value, entry, medium));
        long.extend(lines);
    }
    arg.help(folded(&format!("{help}{choice}{default}"), medium))
        .long_help(long)
}

/// Returns a line for an argument value and its description.
fn listed(value: &PossibleValue, entry: Option<&CommandHelp>, medium: Medium) -> String {
    let name = value.get_name();
    let indent = match medium {
        Medium::Terminal => "",
        Medium::Page => "  ",
    };
    let specific = entry.map_or(&[][..], |e| e.values);
    let mut known = specific.iter().chain(help::VALUES);
    match known.find(|(known, _)| *known == name) {
        Some((_, meaning)) => format!("\n{indent}- {name}: {meaning}"),
        None => format!("\n{indent}- {name}"),
    }
}

/// Wraps a string at [`COLUMNS`]. Japanese breaks anywhere except before closing and after opening punctuation; other
/// words stay whole. On a page nothing is wrapped.
fn folded(text: &str, medium: Medium) -> String {
    if medium == Medium::Page {
        return text.to_owned();
    }
    let mut out = String::new();
    let mut line = String::new();
    for piece in pieces(text) {
        if terminal::width(&line) + terminal::width(piece.trim_end()) > COLUMNS {
            out.push_str(line.trim_end());
            out.push('\n');
            line.clear();
        }
        line.push_str(piece);
    }
    out + &line
}

/// Splits a string at all permitted line breaks.
fn pieces(text: &str) -> Vec<&str> {
    let mut pieces = vec![];
    let mut start = 0;
    let mut characters = text.char_indices().peekable();
    while let Some((at, c)) = characters.next() {
        let end = at + c.len_utf8();
        let breaks = characters.peek().is_none_or(|(_, next)| {
            let closes = "、。)）」』ー…々ぁぃぅぇぉっゃゅょァィゥェォッャュョ]:`".contains(*next);
            let wide = !c.is_ascii() || !next.is_ascii();
            c == ' ' || (wide && !closes && *next != ' ' && !"(（「『[`".contains(c))
        });
        if breaks {
            pieces.push(&text[start..end]);
            start = end;
        }
    }
    pieces
}

#[cfg(test)]
mod tests {
    use crate::Cli;
    use crate::language::japanese::*;
    use clap::CommandFactory;

    fn is_japanese(text: &str) -> bool {
        text.chars().any(|c| matches!(c, '\u{3041}'..='\u{9fff}'))
    }

    /// Collects the help texts of a command, its arguments and values, each with a name for failures.
    fn help_texts(command: &Command, path: &str, found: &mut Vec<(String, String)>) {
        let mut add = |what: &str, text: Option<String>| {
            found.push((format!("hsd{path}: {what}"), text.unwrap_or_default()));
        };
        let text = |t: Option<&clap::builder::StyledStr>| t.map(ToString::to_string);
        add("about", text(command.get_about()));
        add("long about", text(command.get_long_about()));
        if let Some(after) = command.get_after_help() {
            add("after help", Some(after.to_string()));
        }
        for arg in command.get_arguments() {
            add(arg.get_id().as_str(), text(arg.get_help()));
            let long = text(arg.get_long_help()).unwrap_or_default();
            // Values without English help need no Japanese help.
            let values = arg.get_possible_values();
            let explained = values.iter().filter(|v| v.get_help().is_some());
            for value in explained {
                let start = format!("- {}: ", value.get_name());
                let line = long.lines().find(|l| l.starts_with(&start));
                let meaning = line.map(|l| l[start.len()..].to_owned());
                add(&format!("{} {}", arg.get_id(), value.get_name()), meaning);
            }
            add(arg.get_id().as_str(), Some(long));
        }
        for sub in command.get_subcommands() {
            help_texts(sub, &format!("{path} {}", sub.get_name()), found);
        }
    }

    #[test]
    fn no_help_is_left_in_english() {
        let mut found = vec![];
        help_texts(&command(Cli::command()), "", &mut found);
        assert!(found.len() > 50);
        let english = found.iter().filter(|(_, text)| !is_japanese(text));
        let english: Vec<_> = english
            .map(|(name, text)| format!("{name}: {text}"))
            .collect();
        assert!(english.is_empty(), "\n{}\n", english.join("\n"));
    }

    #[test]
    fn every_entry_of_the_table_has_a_command() {
        let mut english = Cli::command();
        english.build();
        for entry in COMMANDS
            .iter()
            .chain(TOWN)
            .chain(DRAW)
            .chain(PLAN)
            .chain(RENDER)
        {
            let mut command = &english;
            for name in entry.path.split_whitespace() {
                let found = command.find_subcommand(name);
                command = found.unwrap_or_else(|| panic!("no command {}", entry.path));
            }
            for (id, ..) in entry.arguments {
                let there = command.get_arguments().any(|a| a.get_id().as_str() == *id);
                assert!(there, "{} has no {id}", entry.path);
            }
            assert_eq!(
                command.get_after_help().is_some(),
                !entry.examples.is_empty(),
                "{}: examples",
                entry.path
            );
        }
    }

    #[test]
    fn lines_break_where_japanese_may() {
        let text = "あ".repeat(37) + "いう。え";
        assert_eq!(
            folded(&text, Medium::Terminal),
            "あ".repeat(37) + "い\nう。え"
        );
        let text = "あ".repeat(36) + " --format を付ける";
        assert_eq!(
            folded(&text, Medium::Terminal),
            "あ".repeat(36) + "\n--format を付ける"
        );
    }
}
