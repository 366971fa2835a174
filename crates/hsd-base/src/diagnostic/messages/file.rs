//! Messages about the file as a whole (HSD00xx), and about too many of them (HSD09xx).

use crate::diagnostic::{Code, Diagnostic, Origin, Severity, Text};
use crate::source::Span;
use crate::text;

/// Nothing but blanks, comments and separators.
#[cold]
pub fn no_house(span: Span) -> Diagnostic {
    let message = text!(
        "there is no house in this file",
        "このファイルには家がありません"
    );
    Diagnostic::error(1, span, message).help(text!(
        "begin with a header line such as `0 0 180`, a line of storey heights, a blank line, and then the walls",
        "`0 0 180` のようなヘッダー行、階高の行、空行の順に書き、そのあとに壁を書いてください"
    ))
}

/// Advice on an encoding that was recognized.
fn leave_or_save() -> Text {
    text!(
        "nothing needs to be done; save it as UTF-8 if you like (positions count bytes of the file on disk)",
        "このままでかまいません。必要なら UTF-8 で保存してください (位置は元のファイルのバイト数で数えます)"
    )
}

/// The bytes are not UTF-8 but valid Shift_JIS.
#[cold]
pub fn shift_jis(span: Span) -> Diagnostic {
    let message = text!(
        "the file is read as Shift_JIS",
        "ファイルを Shift_JIS として読みました"
    );
    Diagnostic::note(2, span, message).help(leave_or_save())
}

/// A byte order mark or a declaration names another encoding, or no other fits the bytes.
#[cold]
pub fn other_encoding(span: Span, encoding: &str) -> Diagnostic {
    let message = text!([encoding]
        "the file is read as {encoding}",
        "ファイルを {encoding} として読みました"
    );
    Diagnostic::note(3, span, message).help(leave_or_save())
}

/// Bytes that are invalid in the encoding.
#[cold]
pub fn malformed(span: Span, encoding: &str, count: usize) -> Diagnostic {
    let more = count.saturating_sub(1);
    let message = match more {
        0 => text!([encoding]
            "these bytes are not valid {encoding}",
            "ここのバイト列は {encoding} の文字ではありません"
        ),
        _ => text!([more, encoding]
            "these bytes, and those in {more} more places, are not valid {encoding}",
            "ここと、ほか{more}か所のバイト列は {encoding} の文字ではありません"
        ),
    };
    Diagnostic::error(4, span, message).help(text!(
        "open the file in the encoding it was written in and save it as UTF-8",
        "書いたときの文字コードで開き、UTF-8 で保存し直してください"
    ))
}

/// Full of NUL characters.
#[cold]
pub fn not_a_text(span: Span) -> Diagnostic {
    let message = text!(
        "this is not a text file: it contains NUL characters",
        "テキストファイルではありません。NUL 文字が含まれています"
    );
    Diagnostic::error(5, span, message).help(text!(
        "name a house file, not an image or a model; save a UTF-16 file without a byte order mark as UTF-8",
        "画像やモデルではなく、家のファイルを指定してください。バイト順マークのない UTF-16 は UTF-8 で保存し直してください"
    ))
}

/// A character that controls a terminal.
#[cold]
pub fn control_character(span: Span, character: char) -> Diagnostic {
    let number = u32::from(character);
    let message = text!([number]
        "there is a control character, U+{number:04X}",
        "制御文字 U+{number:04X} があります"
    );
    Diagnostic::error(6, span, message)
        .help(text!(
            "delete it, or replace it by a blank",
            "削除するか、空白に置き換えてください"
        ))
        .fix(
            text!("Replace it by a blank", "空白に置き換える"),
            span,
            " ",
        )
}

/// Lines that end with a carriage return alone.
#[cold]
pub fn old_line_ends(span: Span) -> Diagnostic {
    let message = text!(
        "lines end with a carriage return alone, as on very old Macintoshes",
        "改行が CR だけです (ごく古い Macintosh の形式)"
    );
    Diagnostic::note(7, span, message).help(text!(
        "nothing needs to be done; save the file with line feeds so that line numbers agree with your editor",
        "このままでかまいません。改行を LF にして保存すると、行番号がエディターと一致します"
    ))
}

/// A file that does not exist or may not be read.
#[cold]
pub fn unreadable(span: Span, why: impl Into<Text>) -> Diagnostic {
    let why = why.into();
    let message = text!([why]
        "the file cannot be read: {why}",
        "ファイルを読めません: {why}"
    );
    Diagnostic::error(8, span, message).help(text!(
        "check that its name is spelled right, that it is a text file, and that you may read it",
        "名前が正しいか、テキストファイルか、読み取りが許可されているかを確かめてください"
    ))
}

/// The limit of diagnostics of one file is reached.
#[cold]
pub fn more_messages(span: Span, count: usize, worst: Severity) -> Diagnostic {
    let message = text!([count]
        "{count} more diagnostics of this file are not shown",
        "このファイルへの指摘がほかに{count}件ありますが、表示しません"
    );
    let mut found = Diagnostic::error(909, span, message).help(text!(
        "fix those above and check again; if there are very many, this may not be a house file",
        "上の指摘を直してから、もう一度調べてください。指摘があまりに多いときは、家のファイルではないかもしれません"
    ));
    found.severity = worst;
    found
}

/// The limit of diagnostics of one kind is reached, in a file or in a layer.
#[cold]
pub fn more_of_a_kind(origin: Origin, code: Code, count: usize, severity: Severity) -> Diagnostic {
    let (message, help) = match &origin {
        Origin::Source(_) => (
            text!([count, code]
                "{count} more of {code} in this file are not shown",
                "このファイルにはほかに {code} が{count}件ありますが、表示しません"
            ),
            text!(
                "fix those above and check again; one mistake often causes many of them",
                "上の指摘を直してから、もう一度調べてください。多くはひとつの誤りから生じます"
            ),
        ),
        Origin::Feature { layer, .. } => (
            text!([count, code, layer]
                "… and {count} more of {code} in the layer `{layer}`",
                "…レイヤー `{layer}` にはほかに {code} が{count}件あります"
            ),
            text!(
                "what is wrong with many features usually has one cause, in the data or in how it is read",
                "多くの地物に共通する指摘は、たいていデータか読み方に共通の原因があります"
            ),
        ),
    };
    let mut found = Diagnostic::error(909, origin, message).help(help);
    found.severity = severity;
    found
}
