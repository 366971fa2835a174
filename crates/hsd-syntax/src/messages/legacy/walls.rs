//! Messages about the walls of the legacy form.

use hsd_base::diagnostic::messages::words::quote;
use hsd_base::diagnostic::{Diagnostic, Edit, Text};
use hsd_base::source::Span;
use hsd_base::text;

/// U+3000 in a wall line, and the blanks as which it was read.
#[cold]
pub fn wide_blank(span: Span, count: usize, read: &str) -> Diagnostic {
    let blanks = read.len();
    let word = if blanks == 1 { "blank" } else { "blanks" };
    let (message, help) = match count {
        1 => (
            text!(
                "there is a full-width blank among the codes",
                "部材コードの並びに全角空白があります"
            ),
            text!([blanks, word]
                "replace the full-width blank by {blanks} {word}",
                "全角空白を半角空白{blanks}個に置き換えてください"
            ),
        ),
        _ => (
            text!([count]
                "there are {count} full-width blanks among the codes",
                "部材コードの並びに全角空白が{count}個あります"
            ),
            text!([count, blanks, word]
                "replace the {count} full-width blanks by {blanks} {word}",
                "全角空白{count}個を半角空白{blanks}個に置き換えてください"
            ),
        ),
    };
    let fix = text!("Replace by half-width blanks", "半角空白に置き換える");
    Diagnostic::error(120, span, message)
        .help(help)
        .fix(fix, span, read)
}

/// A tab in a wall line, and the blanks as which it was read.
#[cold]
pub fn tab(span: Span, read: &str) -> Diagnostic {
    let message = text!(
        "there is a tab among the codes",
        "部材コードの並びにタブがあります"
    );
    Diagnostic::error(121, span, message)
        .help(text!(
            "replace the tab by the blanks that fill the code up to five columns",
            "タブを、部材コードが五桁になるだけの空白に置き換えてください"
        ))
        .fix(
            text!("Replace by half-width blanks", "半角空白に置き換える"),
            span,
            read,
        )
}

/// Full-width letters anywhere but in comments and names; `whole` are these with the wide blanks behind them, and
/// `read` what both were read as.
#[cold]
pub fn wide_letters(span: Span, text: &str, whole: Span, read: &str) -> Diagnostic {
    let narrow: String = text
        .chars()
        .filter_map(|c| char::from_u32(u32::from(c).wrapping_sub(0xfee0)))
        .collect();
    let (quoted, narrow) = (quote(text), quote(&narrow));
    let message = text!([quoted]
        "{quoted} is written in full-width letters",
        "{quoted} が全角文字で書かれています"
    );
    Diagnostic::error(122, span, message)
        .help(text!([narrow]
            "turn the input method off and write {narrow}",
            "日本語入力を切り、半角で {narrow} と書いてください"
        ))
        .fix(
            text!("Write it in half-width letters", "半角で書く"),
            whole,
            read,
        )
}

/// White space of another width, or none.
#[cold]
pub fn other_blank(span: Span, character: char, read: &str) -> Diagnostic {
    let number = u32::from(character);
    let fix = match read {
        "" => text!("Delete it", "削除する"),
        _ => text!("Replace by half-width blanks", "半角空白に置き換える"),
    };
    let message = text!([number]
        "there is an unusual blank, U+{number:04X}",
        "特殊な空白 U+{number:04X} があります"
    );
    Diagnostic::error(123, span, message)
        .help(text!(
            "replace it by a half-width blank if it is visible, otherwise delete it",
            "空白として見えるなら半角空白に置き換え、見えないなら削除してください"
        ))
        .fix(fix, span, read)
}

/// A character that cannot be in a code.
#[cold]
pub fn foreign(span: Span, text: &str) -> Diagnostic {
    let quoted = quote(text);
    let message = text!([quoted]
        "{quoted} cannot be used in a code",
        "{quoted} は部材コードに使えません"
    );
    Diagnostic::error(124, span, message).help(text!(
        "a code is five ASCII characters; the Japanese name of a part alone in its columns is read as its code (HSD0301)",
        "部材コードは ASCII 五文字です。部材の和名は、それだけを書けば部材コードとして読みます (HSD0301)"
    ))
}

/// Codes after the blank line that ends the walls; `apart`: there are more, with comments between.
#[cold]
pub fn blank_in_walls(blank: Span, next: Span, apart: bool) -> Diagnostic {
    let message = text!(
        "a blank line ends the walls, but more codes follow it",
        "空行で壁が終わりますが、その後にも部材コードがあります"
    );
    let found = Diagnostic::error(125, blank, message)
        .help(text!(
            "delete the blank line; a storey ends with `^`, a turn without parts is a line with `R` or `L` alone",
            "空行を削除してください。階は `^` で終わり、部材のない曲がりは `R` か `L` だけの行で書きます"
        ))
        .label(next, text!("read as the next wall", "次の壁として読みます"));
    if apart {
        return found;
    }
    found.fix(text!("Delete the blank line", "空行を削除する"), blank, "")
}

/// One column more than the codes take.
#[cold]
pub fn one_over(span: Span, text: &str) -> Diagnostic {
    let quoted = quote(text);
    let message = text!([quoted]
        "{quoted} is one column too many",
        "{quoted} が一桁余っています"
    );
    Diagnostic::error(126, span, message).help(text!(
        "delete it or complete its five columns; only the letters `L`, `R` and `^` may follow the last code",
        "削除するか、五桁になるように書いてください。最後の部材コードの後に置けるのは `L`、`R`、`^` だけです"
    ))
    .fix(text!([quoted] "Delete {quoted}", "{quoted} を削除する"), span, "")
}

/// A turn letter that is not right after the last column of a code; `columns` are counted before it, with and without
/// the blanks at their end; `surplus_blanks` are those after the last whole code.
#[cold]
pub fn misplaced_control(
    span: Span,
    letter: &str,
    columns: (usize, usize),
    surplus_blanks: Span,
) -> Diagnostic {
    let (before, codes) = columns;
    let (missing, surplus) = (before.next_multiple_of(5) - before, before % 5);
    let blanks = |n: usize| if n == 1 { "blank" } else { "blanks" };
    // Blanks can be deleted only as far as there are any after the codes.
    let (help, title, place, filling) = if surplus < missing && before - surplus >= codes {
        let blanks = blanks(surplus);
        let help = text!([surplus, blanks, letter]
            "delete {surplus} {blanks} before the `{letter}`, which belongs right after the five columns of the last code",
            "`{letter}` の前の空白を{surplus}個削除してください。曲がりは最後の部材コードの五桁のすぐ後に書きます"
        );
        let title = text!([surplus, blanks, letter]
            "Delete {surplus} {blanks} before the `{letter}`",
            "`{letter}` の前の空白を{surplus}個削除する"
        );
        (help, title, surplus_blanks, String::new())
    } else {
        let blanks = blanks(missing);
        let help = text!([missing, blanks, letter]
            "write {missing} more {blanks} before the `{letter}`, so that the last code has five columns",
            "最後の部材コードが五桁になるよう、`{letter}` の前に空白を{missing}個足してください"
        );
        let title = text!([missing, blanks, letter]
            "Insert {missing} {blanks} before the `{letter}`",
            "`{letter}` の前に空白を{missing}個足す"
        );
        (help, title, surplus_blanks.after(), " ".repeat(missing))
    };
    Diagnostic::error(127, span, inside_a_code(letter, before + 1))
        .help(help)
        .fix(title, place, filling)
}

fn inside_a_code(letter: &str, column: usize) -> Text {
    text!([letter, column]
        "the `{letter}` is in column {column}, inside a code",
        "`{letter}` が{column}桁目、つまり部材コードの途中にあります"
    )
}

/// A turn letter after another one; `gap` reaches from that to this.
#[cold]
pub fn second_control(
    span: Span,
    letter: &str,
    before: usize,
    turn: &str,
    gap: Span,
) -> Diagnostic {
    let title = text!([turn] "Delete the `{turn}`", "`{turn}` を削除する");
    Diagnostic::error(127, span, inside_a_code(letter, before + 1))
        .help(text!([turn, letter]
            "delete the `{turn}` before the `{letter}`: a line ends with one of the two",
            "`{letter}` の前の `{turn}` を削除してください。行の最後に書けるのはどちらかひとつです"
        ))
        .fix(title, gap, "")
}

/// A turn letter with codes after it; `leads`: it begins its line. `fix` moves it where it belongs.
#[cold]
pub fn inner_turn(span: Span, letter: &str, leads: bool, fix: Vec<Edit>) -> Diagnostic {
    let (title, help) = if leads {
        let title = text!([letter]
            "Move the `{letter}` to the end of the previous line",
            "`{letter}` を前の行の末尾へ移す"
        );
        let help = text!([letter]
            "move the `{letter}` to the end of the previous line, right after the five columns of its last code",
            "`{letter}` を前の行の末尾、最後の部材コードの五桁のすぐ後に移してください"
        );
        (title, help)
    } else {
        let title = text!([letter]
            "Begin a new line after the `{letter}`",
            "`{letter}` の後で改行する"
        );
        let help = text!([letter]
            "begin a new line after the `{letter}`",
            "`{letter}` の後で改行してください"
        );
        (title, help)
    };
    let message = text!([letter]
        "there are codes after the turn `{letter}`, but a turn ends its line",
        "曲がり `{letter}` の後に部材コードがあります。曲がりは行の最後に書くものです"
    );
    let found = Diagnostic::error(138, span, message).help(help);
    match fix.is_empty() {
        true => found,
        false => found.fix_all(title, fix),
    }
}

/// `l` or `r` for `L` or `R`.
#[cold]
pub fn lower_control(span: Span, letter: &str) -> Diagnostic {
    let capital = letter.to_ascii_uppercase();
    let message = text!([letter]
        "the turn letter `{letter}` must be a capital",
        "曲がりの `{letter}` は大文字で書かなければなりません"
    );
    Diagnostic::error(128, span, message)
        .help(text!([capital] "write `{capital}`", "`{capital}` と書いてください"))
        .fix(
            text!([capital] "Write `{capital}`", "`{capital}` と書く"),
            span,
            &*capital,
        )
}

/// Blanks that hide the end of the line.
#[cold]
pub fn blanks_after(span: Span, letter: &str) -> Diagnostic {
    let message = text!([letter]
        "there are blanks after the final `{letter}`",
        "行末の `{letter}` の後に空白があります"
    );
    Diagnostic::warning(129, span, message)
        .help(text!(
            "delete them; the letter must be the last character of the line",
            "削除してください。この文字は行の最後になければなりません"
        ))
        .fix(text!("Delete the blanks", "空白を削除する"), span, "")
}

/// Codes after `^` on the same line, and the blanks between.
#[cold]
pub fn after_reset(span: Span, gap: Span, line_end: &str) -> Diagnostic {
    let message = text!(
        "nothing may follow `^` on its line",
        "`^` と同じ行には、その後に何も書けません"
    );
    Diagnostic::error(130, span, message)
        .help(text!(
            "begin the next storey on a new line",
            "次の階は新しい行から始めてください"
        ))
        .fix(text!("Begin a new line", "改行する"), gap, line_end)
}

/// Blanks before the first code.
#[cold]
pub fn shifted(span: Span, blanks: usize, voids: usize) -> Diagnostic {
    let help = match voids {
        0 => text!(
            "delete the blanks: the first code begins in the first column",
            "空白を削除してください。最初の部材コードは一桁目から始まります"
        ),
        _ => text!([voids]
            "write {voids} blanks, five for each void, or `.....` for each",
            "空きひとつにつき空白五つ、あわせて{voids}個書くか、それぞれ `.....` と書いてください"
        ),
    };
    let message = text!([blanks]
        "the line begins with {blanks} blanks, which shift all its codes",
        "行頭に空白が{blanks}個あり、後の部材コードがすべてずれます"
    );
    let title = match voids {
        0 => text!("Delete the blanks", "空白を削除する"),
        _ => text!("Write the voids as dots", "空きを点で書く"),
    };
    Diagnostic::error(131, span, message)
        .help(help)
        .fix(title, span, ".".repeat(voids))
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
                "write `.....`: an editor that trims trailing blanks would change the house",
                "`.....` と書いてください。行末の空白を消すエディターでは家が変わってしまいます"
            ),
        ),
        _ => (
            text!([count]
                "the line ends with {count} voids of blanks",
                "行が空白の空き{count}個で終わっています"
            ),
            text!([count]
                "write `.....` {count} times: an editor that trims trailing blanks would change the house",
                "`.....` を{count}個書いてください。行末の空白を消すエディターでは家が変わってしまいます"
            ),
        ),
    };
    let title = text!("Write the voids as dots", "空きを点で書く");
    Diagnostic::warning(133, span, message)
        .help(help)
        .fix(title, span, ".....".repeat(count))
}

/// Dots that are not five.
#[cold]
pub fn few_points(span: Span, text: &str) -> Diagnostic {
    let quoted = quote(text);
    let message = text!([quoted] "{quoted} is not a void", "{quoted} は空きになりません");
    Diagnostic::error(134, span, message)
        .help(text!(
            "write exactly five dots, `.....`",
            "点をちょうど五つ、`.....` と書いてください"
        ))
        .fix(text!("Write `.....`", "`.....` と書く"), span, ".....")
}

/// `^` after the last storey.
#[cold]
pub fn last_reset(span: Span) -> Diagnostic {
    let message = text!(
        "no storey follows this `^`",
        "この `^` の後に階がありません"
    );
    Diagnostic::warning(135, span, message)
        .help(text!(
            "delete it; the last storey ends where the walls end",
            "削除してください。最後の階は壁の終わりで終わります"
        ))
        .fix(text!("Delete the `^`", "`^` を削除する"), span, "")
}

/// `^` after `^`.
#[cold]
pub fn empty_storey(span: Span, line: Span, storey: usize) -> Diagnostic {
    let message = text!([storey]
        "storey {storey} has no walls before its `^`",
        "`^` の前に{storey}階の壁がありません"
    );
    Diagnostic::error(136, span, message)
        .help(text!(
            "delete the `^`, or write the walls of the storey before it",
            "`^` を削除するか、その前にこの階の壁を書いてください"
        ))
        .fix(text!("Delete the `^`", "`^` を削除する"), line, "")
}

/// A courtyard: the legacy form has none.
#[cold]
pub fn no_courts(line: Span) -> Diagnostic {
    let message = text!(
        "the legacy form has no courtyards; the walls up to the next blank line are left out",
        "旧形式では中庭を書けません。次の空行までの壁は読みません"
    );
    Diagnostic::error(153, line, message).help(text!(
        "convert the file with `hsd fmt --to xml`, and write the courtyard as a `Loop hole=\"yes\" start=\"a b\"` in its storey",
        "`hsd fmt --to xml` で XML に直し、階の中に `Loop hole=\"yes\" start=\"a b\"` として書いてください"
    ))
}

/// A width of a part's own: the legacy form has none.
#[cold]
pub fn no_widths(span: Span, number: &str, code: &str) -> Diagnostic {
    let code = if code.is_empty() { "KSK" } else { code };
    let message = text!([number]
        "{number} is no code: parts of the legacy form have the widths of the catalogue",
        "{number} はコードではありません。旧形式の部材の幅は部材表で決まっています"
    );
    Diagnostic::error(154, span, message).help(text!([code, number]
        "choose parts that add up to the length, or convert the file with `hsd fmt --to xml` and write `<Part code=\"{code}\" width=\"{number}\"/>` there",
        "合わせて長さになる部材を選ぶか、`hsd fmt --to xml` で XML に直して `<Part code=\"{code}\" width=\"{number}\"/>` と書いてください"
    ))
}
