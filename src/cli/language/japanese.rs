//! Help and complaints of the command line in Japanese.
//!
//! clap has no words but English ones. Here a finished command gets others: its own from the table of [`words`], clap's
//! ("Usage", "default") by templates, and complaints by [`wrong`].

mod words;
mod wrong;

pub(in crate::cli) use wrong::complaint;

use crate::cli::files::terminal;
use clap::builder::PossibleValue;
use clap::{Arg, Command};
use words::{COMMANDS, COMMON, Words};

/// Columns of a line of help, beside the names of options.
const COLUMNS: usize = 76;

const TEMPLATE: &str = "{about-with-newline}\n使い方: {usage}\n\n{all-args}{after-help}";

/// The command with all its subcommands, in Japanese.
pub(in crate::cli) fn command(mut english: Command) -> Command {
    english.build();
    translated(english, "")
}

fn translated(mut command: Command, path: &str) -> Command {
    let usage = command.render_usage().to_string();
    let usage = usage.trim_start_matches("Usage: ");
    let usage = ["[OPTIONS]", "[COMMAND]", "<COMMAND>"]
        .iter()
        .zip(["[オプション]", "[コマンド]", "<コマンド>"])
        .fold(usage.to_owned(), |text, (en, ja)| text.replace(en, ja));
    // What `hsd help` knows of a subcommand is what stands in the table for the subcommand itself.
    let words = COMMANDS.iter().find(|w| w.path == path);
    let below = |name: &str| match path {
        "" | "help" => name.to_owned(),
        _ => format!("{path} {name}"),
    };
    let command = command
        .help_template(TEMPLATE)
        .override_usage(usage)
        .subcommand_help_heading("コマンド")
        .mut_args(|arg| argument(arg, words))
        .mut_subcommands(|sub| {
            let path = below(sub.get_name());
            translated(sub, &path)
        });
    let Some(words) = words else { return command };
    let about = folded(words.about);
    let long = match words.more {
        "" => about.clone(),
        more => format!("{about}\n\n{}", folded(more)),
    };
    let command = command.about(about).long_about(long);
    match words.examples {
        "" => command,
        examples => command.after_help(examples),
    }
}

/// An argument with its help, its values and what it is without being given.
fn argument(arg: Arg, words: Option<&Words>) -> Arg {
    let heading = match arg.is_positional() {
        true => "引数",
        false => "オプション",
    };
    let arg = arg
        .help_heading(heading)
        .hide_default_value(true)
        .hide_possible_values(true);
    let own = words.map_or(&[][..], |w| w.arguments);
    let mut known = own.iter().chain(COMMON);
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
    let mut long = folded(&format!("{help}{default}"));
    if !more.is_empty() {
        long += &format!("\n\n{}", folded(more));
    }
    if !values.is_empty() {
        long += "\n\n値:";
        long.extend(values.iter().map(|value| listed(value, words)));
    }
    arg.help(folded(&format!("{help}{choice}{default}")))
        .long_help(long)
}

/// A value with what it stands for, on a line.
fn listed(value: &PossibleValue, words: Option<&Words>) -> String {
    let name = value.get_name();
    let own = words.map_or(&[][..], |w| w.values);
    let mut known = own.iter().chain(words::VALUES);
    match known.find(|(known, _)| *known == name) {
        Some((_, meaning)) => format!("\n- {name}: {meaning}"),
        None => format!("\n- {name}"),
    }
}

/// A text in lines of [`COLUMNS`]. Japanese breaks anywhere but before what closes and behind what opens; other
/// words stay whole.
fn folded(text: &str) -> String {
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

/// The shortest pieces between which a line may break.
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
    use crate::cli::Cli;
    use crate::cli::language::japanese::*;
    use clap::CommandFactory;

    fn is_japanese(text: &str) -> bool {
        text.chars().any(|c| matches!(c, '\u{3041}'..='\u{9fff}'))
    }

    /// What a command says of itself and of its arguments and values, each with a name for complaints.
    fn said(command: &Command, path: &str, found: &mut Vec<(String, String)>) {
        let mut say = |what: &str, text: Option<String>| {
            found.push((format!("hsd{path}: {what}"), text.unwrap_or_default()));
        };
        let text = |t: Option<&clap::builder::StyledStr>| t.map(ToString::to_string);
        say("about", text(command.get_about()));
        say("long about", text(command.get_long_about()));
        if let Some(after) = command.get_after_help() {
            say("after help", Some(after.to_string()));
        }
        for arg in command.get_arguments() {
            say(arg.get_id().as_str(), text(arg.get_help()));
            let long = text(arg.get_long_help()).unwrap_or_default();
            // Only what has no help in English has none in Japanese.
            let values = arg.get_possible_values();
            let explained = values.iter().filter(|v| v.get_help().is_some());
            for value in explained {
                let start = format!("- {}: ", value.get_name());
                let line = long.lines().find(|l| l.starts_with(&start));
                let meaning = line.map(|l| l[start.len()..].to_owned());
                say(&format!("{} {}", arg.get_id(), value.get_name()), meaning);
            }
            say(arg.get_id().as_str(), Some(long));
        }
        for sub in command.get_subcommands() {
            said(sub, &format!("{path} {}", sub.get_name()), found);
        }
    }

    #[test]
    fn no_help_is_left_in_english() {
        let mut found = vec![];
        said(&command(Cli::command()), "", &mut found);
        assert!(found.len() > 50);
        let english = found.iter().filter(|(_, text)| !is_japanese(text));
        let english: Vec<_> = english
            .map(|(name, text)| format!("{name}: {text}"))
            .collect();
        assert!(english.is_empty(), "\n{}\n", english.join("\n"));
    }

    #[test]
    fn the_table_speaks_of_what_there_is() {
        let mut english = Cli::command();
        english.build();
        for words in COMMANDS {
            let mut command = &english;
            for name in words.path.split_whitespace() {
                let found = command.find_subcommand(name);
                command = found.unwrap_or_else(|| panic!("no command {}", words.path));
            }
            for (id, ..) in words.arguments {
                let there = command.get_arguments().any(|a| a.get_id().as_str() == *id);
                assert!(there, "{} has no {id}", words.path);
            }
            assert_eq!(
                command.get_after_help().is_some(),
                !words.examples.is_empty(),
                "{}: examples",
                words.path
            );
        }
    }

    #[test]
    fn lines_break_where_japanese_may() {
        let text = "あ".repeat(37) + "いう。え";
        assert_eq!(folded(&text), "あ".repeat(37) + "い\nう。え");
        let text = "あ".repeat(36) + " --format を付ける";
        assert_eq!(folded(&text), "あ".repeat(36) + "\n--format を付ける");
    }
}
