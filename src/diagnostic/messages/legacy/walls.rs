//! Messages about the walls of the legacy text.

use crate::diagnostic::Diagnostic;
use crate::diagnostic::messages::words::quote;
use crate::source::Span;
use crate::text;

/// U+3000 in a wall line.
#[cold]
pub fn wide_blank(span: Span, count: usize) -> Diagnostic {
    let twice = count.saturating_mul(2);
    let (message, help) = match count {
        1 => (
            text!(
                "there is a full-width blank among the codes",
                "部材コードの並びに全角空白があります"
            ),
            text!(
                "replace the full-width blank by two blanks",
                "全角空白を半角空白二つに置き換えてください"
            ),
        ),
        _ => (
            text!(
                "there are {count} full-width blanks among the codes",
                "部材コードの並びに全角空白が{count}個あります"
            ),
            text!(
                "replace the {count} full-width blanks by {twice} blanks",
                "全角空白{count}個を半角空白{twice}個に置き換えてください"
            ),
        ),
    };
    let mend = text!("Replace by plain blanks", "半角空白に置き換える");
    Diagnostic::error(120, span, message)
        .help(help)
        .mend(mend, span, " ".repeat(twice.min(4096)))
}

/// A tab in a wall line.
#[cold]
pub fn tab(span: Span) -> Diagnostic {
    let message = text!(
        "there is a tab among the codes",
        "部材コードの並びにタブがあります"
    );
    Diagnostic::error(121, span, message).help(text!(
        "replace the tab by the blanks that fill the code up to five columns",
        "タブを、部材コードが五桁になるだけの空白に置き換えてください"
    ))
}

/// Full-width letters anywhere but in comments and names.
#[cold]
pub fn wide_letters(span: Span, text: &str) -> Diagnostic {
    let narrow: String = text
        .chars()
        .filter_map(|c| char::from_u32(u32::from(c).wrapping_sub(0xfee0)))
        .collect();
    let (quoted, narrow) = (quote(text), quote(&narrow));
    let message = text!(
        "{quoted} is written in full-width letters",
        "{quoted} が全角文字で書かれています"
    );
    Diagnostic::error(122, span, message).help(text!(
        "switch the input method off and write {narrow}",
        "日本語入力を切り、半角で {narrow} と書いてください"
    ))
}

/// White space of another width, or none.
#[cold]
pub fn other_blank(span: Span, character: char) -> Diagnostic {
    let number = u32::from(character);
    let message = text!(
        "there is an unusual blank, U+{number:04X}",
        "特殊な空白 U+{number:04X} があります"
    );
    Diagnostic::error(123, span, message).help(text!(
        "replace it by a plain blank if one can be seen, else delete it",
        "空白として見えるなら半角空白に置き換え、見えないなら削除してください"
    ))
}

/// A character that no code has.
#[cold]
pub fn foreign(span: Span, text: &str) -> Diagnostic {
    let quoted = quote(text);
    let message = text!(
        "{quoted} cannot stand in a code",
        "{quoted} は部材コードに使えません"
    );
    Diagnostic::error(124, span, message).help(text!(
        "a code is five characters of plain ASCII; names of parts in other letters belong in comments or in the XML form",
        "部材コードは ASCII 五文字です。部材の和名は注釈か XML 形式に書いてください"
    ))
}

/// Codes after the blank line that ends the walls.
#[cold]
pub fn blank_in_walls(blank: Span, next: Span) -> Diagnostic {
    let message = text!(
        "a blank line ends the walls, but more codes follow it",
        "空行で壁が終わりますが、その後にも部材コードがあります"
    );
    Diagnostic::error(125, blank, message)
        .help(text!(
            "delete the blank line; a storey ends with `^`, a turn without parts is a line with `R` or `L` alone",
            "空行を削除してください。階は `^` で終わり、部材のない曲がりは `R` か `L` だけの行で書きます"
        ))
        .label(next, text!("read as the next wall", "次の壁として読みます"))
}

/// One column more than the codes take.
#[cold]
pub fn one_over(span: Span, text: &str) -> Diagnostic {
    let quoted = quote(text);
    let message = text!("{quoted} is one column over", "{quoted} が一桁余っています");
    Diagnostic::error(126, span, message).help(text!(
        "delete it or complete its five columns; only the letters `L`, `R` and `^` may follow the last code",
        "削除するか、五桁になるように書いてください。最後の部材コードの後に置けるのは `L`、`R`、`^` だけです"
    ))
}

/// A turn letter that does not stand right after the last column of a code: `before` columns stand before
/// it, and `codes` without the blanks at their end.
#[cold]
pub fn misplaced_control(span: Span, letter: &str, before: usize, codes: usize) -> Diagnostic {
    let (missing, surplus) = (before.next_multiple_of(5) - before, before % 5);
    let blanks = |n: usize| if n == 1 { "blank" } else { "blanks" };
    let column = before + 1;
    let message = text!(
        "the `{letter}` stands in column {column} and so inside a code",
        "`{letter}` が{column}桁目、つまり部材コードの途中にあります"
    );
    // Blanks can be deleted only as far as there are any after the codes.
    let help = if surplus < missing && before - surplus >= codes {
        let blanks = blanks(surplus);
        text!(
            "delete {surplus} {blanks} before the `{letter}`: it stands right after the five columns of the last code",
            "`{letter}` の前の空白を{surplus}個削除してください。曲がりは最後の部材コードの五桁のすぐ後に書きます"
        )
    } else {
        let blanks = blanks(missing);
        text!(
            "write {missing} more {blanks} before the `{letter}`, so that the last code has five columns",
            "最後の部材コードが五桁になるよう、`{letter}` の前に空白を{missing}個足してください"
        )
    };
    Diagnostic::error(127, span, message).help(help)
}

/// A turn letter with codes after it; `leads` tells that it begins its line.
#[cold]
pub fn inner_turn(span: Span, letter: &str, leads: bool) -> Diagnostic {
    let help = if leads {
        text!(
            "put the `{letter}` at the end of the line before, right after the five columns of its last code",
            "`{letter}` を前の行の末尾、最後の部材コードの五桁のすぐ後に移してください"
        )
    } else {
        text!(
            "begin a new line after the `{letter}`",
            "`{letter}` の後で改行してください"
        )
    };
    let message = text!(
        "the turn `{letter}` stands before codes, but a turn ends its line",
        "曲がり `{letter}` の後に部材コードがあります。曲がりは行の最後に書くものです"
    );
    Diagnostic::error(138, span, message).help(help)
}

/// `l` or `r` for `L` or `R`.
#[cold]
pub fn lower_control(span: Span, letter: &str) -> Diagnostic {
    let capital = letter.to_ascii_uppercase();
    let message = text!(
        "the turn letter `{letter}` must be a capital",
        "曲がりの `{letter}` は大文字で書かなければなりません"
    );
    Diagnostic::error(128, span, message)
        .help(text!("write `{capital}`", "`{capital}` と書いてください"))
}

/// Blanks that hide the end of the line.
#[cold]
pub fn blanks_after(span: Span, letter: &str) -> Diagnostic {
    let message = text!(
        "there are blanks after the final `{letter}`",
        "行末の `{letter}` の後に空白があります"
    );
    Diagnostic::warning(129, span, message).help(text!(
        "delete them; the letter must be the last character of the line",
        "削除してください。この文字は行の最後になければなりません"
    ))
}

/// Codes after `^` on the same line.
#[cold]
pub fn after_reset(span: Span) -> Diagnostic {
    let message = text!(
        "nothing may follow `^` on its line",
        "`^` と同じ行には、その後に何も書けません"
    );
    Diagnostic::error(130, span, message).help(text!(
        "begin the next storey on a new line",
        "次の階は新しい行から始めてください"
    ))
}

/// Blanks before the first code.
#[cold]
pub fn shifted(span: Span, blanks: usize, voids: usize) -> Diagnostic {
    let help = match voids {
        0 => text!(
            "delete the blanks: the first code begins in the first column",
            "空白を削除してください。最初の部材コードは一桁目から始まります"
        ),
        _ => text!(
            "write {voids} blanks, five for each void, or `.....` for each",
            "空きひとつにつき空白五つ、あわせて{voids}個書くか、それぞれ `.....` と書いてください"
        ),
    };
    let message = text!(
        "the line begins with {blanks} blanks, which shift every code after them",
        "行頭に空白が{blanks}個あり、後の部材コードがすべてずれます"
    );
    Diagnostic::error(131, span, message).help(help)
}

/// Words that look like codes but do not stand in their columns.
#[cold]
pub fn out_of_step(span: Span, column: usize, meant: &str) -> Diagnostic {
    let mut line: String = meant.chars().take(80).collect();
    if line.len() < meant.len() {
        line.push('…');
    }
    let message = text!(
        "from column {column} on the codes are out of step: each takes exactly five columns",
        "{column}桁目から部材コードがずれています。部材コードはちょうど五桁ずつです"
    );
    Diagnostic::error(132, span, message).help(text!("write `{line}`", "`{line}` と書いてください"))
}

/// Five blanks at a line end.
#[cold]
pub fn trailing_void(span: Span, count: usize) -> Diagnostic {
    let (message, help) = match count {
        1 => (
            text!(
                "the line ends with a void of five blanks",
                "行が空白五つの空きで終わっています"
            ),
            text!(
                "write `.....`: an editor that trims lines would change the house",
                "`.....` と書いてください。行末の空白を消すエディターでは家が変わってしまいます"
            ),
        ),
        _ => (
            text!(
                "the line ends with {count} voids of blanks",
                "行が空白の空き{count}個で終わっています"
            ),
            text!(
                "write {count} times `.....`: an editor that trims lines would change the house",
                "`.....` を{count}個書いてください。行末の空白を消すエディターでは家が変わってしまいます"
            ),
        ),
    };
    Diagnostic::warning(133, span, message).help(help)
}

/// Points that are not five.
#[cold]
pub fn few_points(span: Span, text: &str) -> Diagnostic {
    let quoted = quote(text);
    let message = text!("{quoted} is no void", "{quoted} は空きになりません");
    Diagnostic::error(134, span, message).help(text!(
        "write exactly five points, `.....`",
        "点をちょうど五つ、`.....` と書いてください"
    ))
}

/// `^` after the last storey.
#[cold]
pub fn last_reset(span: Span) -> Diagnostic {
    let message = text!(
        "no storey follows this `^`",
        "この `^` の後に階がありません"
    );
    Diagnostic::warning(135, span, message).help(text!(
        "delete it; the last storey ends with the walls",
        "削除してください。最後の階は壁の終わりで終わります"
    ))
}

/// `^` after `^`.
#[cold]
pub fn empty_storey(span: Span, storey: usize) -> Diagnostic {
    let message = text!(
        "storey {storey} has no walls before its `^`",
        "`^` の前に{storey}階の壁がありません"
    );
    Diagnostic::error(136, span, message).help(text!(
        "delete the `^`, or write the walls of the storey before it",
        "`^` を削除するか、その前にこの階の壁を書いてください"
    ))
}
