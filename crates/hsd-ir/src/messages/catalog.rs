//! Messages about custom parts (HSD0323 and on).

use super::xml::offer;
use hsd_base::diagnostic::messages::words::{all_of, any_of, quote, short};
use hsd_base::diagnostic::{Diagnostic, Noun};
use hsd_base::source::Span;
use hsd_base::text;

/// Links of a chain that a message marks.
const MARKED: usize = 6;

/// Words that are offered one by one.
const FEW: usize = 8;

/// A base that is not a part.
#[cold]
pub fn unknown_base(span: Span, code: &str, near: &[String]) -> Diagnostic {
    let code = quote(code);
    let message = text!([code]
        "there is no part {code} to be the base",
        "base の {code} という部材はありません"
    );
    let any = any_of(near);
    let found = Diagnostic::error(323, span, message).help(match near.is_empty() {
        true => text!(
            "name a part of the catalogue or of this file; `hsd parts` lists them",
            "既製の部材か、このファイルの部材を指定してください。一覧は `hsd parts` で見られます"
        ),
        false => text!([any] "did you mean {any}?", "{any} ではありませんか"),
    });
    offer(found, span, near.iter().map(|code| code.trim_end()))
}

/// Parts that are based on each other.
#[cold]
pub fn base_cycle(span: Span, chain: &[(String, Span)]) -> Diagnostic {
    let names = |between: &str| {
        let all: Vec<String> = chain.iter().map(|(code, _)| quote(code)).collect();
        all.join(between)
    };
    let (en, ja) = (names(" on "), names(" → "));
    let message = text!([en, ja]
        "a part would be based on itself: {en}",
        "部材が自分自身を base にしています: {ja}"
    );
    let found = Diagnostic::error(324, span, message).help(text!(
        "name another base for one of them, or none",
        "どれか一つの base を別の部材にするか、なくしてください"
    ));
    // The chain ends with its first link.
    let others = chain.iter().skip(1).filter(|(_, place)| *place != span);
    others.take(MARKED).fold(found, |found, (code, place)| {
        let code = quote(code);
        found.label(*place, text!([code] "the base of {code}", "{code} の base"))
    })
}

/// Parts on parts on parts without end.
#[cold]
pub fn bases_too_deep(span: Span, limit: usize) -> Diagnostic {
    let message = text!([limit]
        "more than {limit} parts are based on one another",
        "部材の base が {limit} 段より深く続いています"
    );
    Diagnostic::error(324, span, message).help(text!(
        "base the part on an earlier one of them",
        "もっと手前の部材を base にしてください"
    ))
}

/// Two parts of one code; `whole` = all of the second.
#[cold]
pub fn part_twice(span: Span, code: &str, first: Span, whole: Option<Span>) -> Diagnostic {
    let code = quote(code);
    let message = text!([code]
        "the part {code} is defined twice",
        "部材 {code} が二度定義されています"
    );
    let found = Diagnostic::error(325, span, message)
        .help(text!(
            "give one of them another code, or remove it; the first one counts",
            "片方のコードを変えるか、取り除いてください。最初のものを使います"
        ))
        .label(first, text!("the first one", "最初の定義"));
    let title = text!("Remove this one", "こちらを削除する");
    match whole {
        Some(whole) => found.fix(title, whole, ""),
        None => found,
    }
}

/// An attribute of a part or a body with a value that it cannot have; `offers` = words that it may be.
#[cold]
pub fn wrong_value(span: Span, name: &str, value: &str, form: Noun, offers: &[&str]) -> Diagnostic {
    let value = quote(value);
    let message = text!([value, name]
        "{value} cannot be the `{name}` of a part",
        "{value} は部材の `{name}` として読めません"
    );
    let found = Diagnostic::error(326, span, message).help(text!([form]
        "write {form}",
        "{form}を書いてください"
    ));
    offer(found, span, offers.iter().copied())
}

/// A code whose fifth column gives another width; `own` = where the width is written.
#[cold]
pub fn width_column(
    span: Span,
    code: &str,
    width: f64,
    column: f64,
    own: Option<Span>,
) -> Diagnostic {
    let (code, width, column) = (quote(code), short(width), short(column));
    let message = text!([code, width, column]
        "{code} is {width} U wide, but its fifth column means {column}",
        "{code} の幅は {width} U ですが、五桁目は {column} を表しています"
    );
    let found = Diagnostic::warning(327, span, message).help(text!([column]
        "end the code with the width: a blank for 1, `h` for a half, a digit for others; use a code of six letters or more, or write the width {column}",
        "コードの最後に幅を書いてください。1 は空白、半分は `h`、そのほかは数字です。六文字以上のコードを使うか、幅を {column} としてもかまいません"
    ));
    let title = text!([column] "Write the width {column}", "幅を {column} とする");
    match own {
        Some(own) => found.fix(title, own, column),
        None => found,
    }
}

/// A change of something that the base does not have; `other` = another word in its place is possible.
#[cold]
pub fn nothing_to_change(span: Span, word: &str, words: &[String], other: bool) -> Diagnostic {
    let word = quote(word);
    let message = text!([word]
        "the base has no element {word} here",
        "base のこの位置に {word} という要素はありません"
    );
    let all = all_of(words);
    let few = if other && words.len() <= FEW {
        words
    } else {
        &[]
    };
    let found = Diagnostic::error(328, span, message).help(match words.is_empty() {
        true => text!(
            "a part without a base, or with an empty one, has nothing to change: write its elements",
            "base のない部材や中身のない base には変えるものがありません。要素をそのまま書いてください"
        ),
        false => text!([all] "its elements are {all}", "要素は {all} です"),
    });
    offer(found, span, few.iter().map(String::as_str))
}

/// A part made of too many bodies.
#[cold]
pub fn too_fine(span: Span, code: &str, count: f64, limit: f64) -> Diagnostic {
    let code = quote(code);
    let message = text!([code, count, limit]
        "{code} would have {count} bodies, more than the limit of {limit}",
        "{code} は {count} 個の形からなり、上限の {limit} 個を超えます"
    );
    Diagnostic::error(329, span, message).help(text!(
        "lower the counts, or show the finest by a texture",
        "個数を減らすか、細かいものはテクスチャーで表してください"
    ))
}

/// A catalogue file without parts.
#[cold]
pub fn no_parts(span: Span) -> Diagnostic {
    let message = text!(
        "this file should define parts, but has none",
        "部材を定義するはずのファイルですが、部材がありません"
    );
    Diagnostic::warning(330, span, message).help(text!(
        "write `<Catalog><PartDef code=\"...\" base=\"...\"/></Catalog>`",
        "`<Catalog><PartDef code=\"...\" base=\"...\"/></Catalog>` と書いてください"
    ))
}

/// More parts than ids.
#[cold]
pub fn too_many_parts(span: Span, limit: usize) -> Diagnostic {
    let message = text!([limit]
        "more than {limit} parts are defined",
        "部材の定義が {limit} 個を超えています"
    );
    Diagnostic::error(331, span, message).help(text!(
        "leave out those that no house uses",
        "どの家も使わないものを取り除いてください"
    ))
}
