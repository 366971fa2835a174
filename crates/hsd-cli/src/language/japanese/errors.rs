//! Usage errors in Japanese.

use clap::Error;
use clap::error::{ContextKind, ContextValue, ErrorKind};

/// Returns the Japanese message of a clap error.
pub(crate) fn error_message(error: &Error) -> String {
    let context = |kind| error.get(kind).map(shown).unwrap_or_default();
    let argument = context(ContextKind::InvalidArg);
    let value = context(ContextKind::InvalidValue);
    let mut text = match error.kind() {
        ErrorKind::InvalidValue if value.is_empty() => format!("{argument} の値がありません"),
        ErrorKind::InvalidValue | ErrorKind::ValueValidation => {
            format!("{argument} に '{value}' は指定できません")
        }
        ErrorKind::UnknownArgument => format!("'{argument}' という引数はありません"),
        ErrorKind::InvalidSubcommand => {
            let name = context(ContextKind::InvalidSubcommand);
            format!("'{name}' というコマンドはありません")
        }
        ErrorKind::ArgumentConflict => match context(ContextKind::PriorArg) {
            other if other == argument => format!("{argument} は一度しか指定できません"),
            other => format!("{argument} は {other} と同時に指定できません"),
        },
        ErrorKind::MissingRequiredArgument => format!("引数が足りません: {argument}"),
        ErrorKind::MissingSubcommand => "コマンドがありません".into(),
        ErrorKind::TooManyValues => format!("{argument} の値 '{value}' は余分です"),
        ErrorKind::TooFewValues | ErrorKind::WrongNumberOfValues => {
            format!("{argument} の値の数が合いません")
        }
        ErrorKind::NoEquals => format!("{argument} には '=' で値を続けてください"),
        ErrorKind::InvalidUtf8 => "UTF-8 でない引数があります".into(),
        _ => error.kind().to_string(),
    };
    let valid = context(ContextKind::ValidValue);
    if !valid.is_empty() {
        text += &format!("\n  [値: {valid}]");
    }
    let suggestions = [
        ContextKind::SuggestedArg,
        ContextKind::SuggestedSubcommand,
        ContextKind::SuggestedValue,
    ];
    for near in suggestions.map(context) {
        if !near.is_empty() {
            text += &format!("\n\n  '{near}' のことですか");
        }
    }
    let usage = context(ContextKind::Usage);
    let usage = usage.trim_start_matches("Usage: ").trim();
    if !usage.is_empty() {
        text += &format!("\n\n使い方: {usage}");
    }
    format!("エラー: {text}\n\n詳しくは '--help' を付けて実行してください\n")
}

fn shown(value: &ContextValue) -> String {
    match value {
        ContextValue::String(text) => text.clone(),
        ContextValue::Strings(texts) => texts.join(", "),
        ContextValue::StyledStr(text) => text.to_string(),
        ContextValue::StyledStrs(texts) => {
            let texts: Vec<String> = texts.iter().map(ToString::to_string).collect();
            texts.join(", ")
        }
        ContextValue::Number(number) => number.to_string(),
        _ => String::new(),
    }
}
