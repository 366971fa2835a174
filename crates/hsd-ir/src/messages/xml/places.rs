//! Messages about houses that are written elsewhere.

use super::fixes::{offer, removing};
use super::language::{known, write};
use super::pieces::{marked, names, path_end, replaced_with_content};
use hsd_base::diagnostic::messages::words::quote;
use hsd_base::diagnostic::{Diagnostic, Edit};
use hsd_base::source::Span;
use hsd_base::text;

/// A `Place` with content.
#[cold]
pub fn place_with_content(span: Span, fix: Option<Vec<Edit>>) -> Diagnostic {
    let message = text!(
        "`Place` can hold only an `Outline`, for the one house that `type` names, and in a town nothing",
        "`Place` の中に書けるのは、`type` の一棟の建物の `Outline` だけです。町では何も書けません"
    );
    replaced_with_content(span, message, fix)
}

/// A house type that does not exist; `types` are the definitions and the types of the library.
#[cold]
pub fn unknown_type(span: Span, name: &str, near: Option<&str>, types: &[String]) -> Diagnostic {
    let name = quote(name);
    let message = text!([name]
        "there is no house type, `define` or file {name}",
        "{name} という建物の型、`define`、ファイルはありません"
    );
    let found = Diagnostic::error(277, span, message).help(match near {
        Some(near) => write(near),
        None => {
            let all = known(types);
            text!([all]
                "known here: {all}; the name of a file ends with `.hsd`",
                "使えるもの: {all}。ファイル名は `.hsd` で終わります"
            )
        }
    });
    offer(found, span, near)
}

/// A source without a house that a `Place` could put anywhere.
#[cold]
pub fn place_without_house(span: Span, name: &str) -> Diagnostic {
    let name = quote(name);
    let message = text!([name]
        "there is no house in {name} that could stand here",
        "{name} の中に、ここに置ける建物がありません"
    );
    Diagnostic::error(278, span, message).help(text!(
        "a type is a `House`, or `Houses` with one or several",
        "型は `House` か、それをいくつか含む `Houses` です"
    ))
}

/// A centre of several houses.
#[cold]
pub fn anchor_of_several(span: Span, count: usize, whole: Span) -> Diagnostic {
    let message = text!([count]
        "`at` is for one house, and this type has {count}",
        "`at` は建物が一つのときのものですが、この型には {count} 棟あります"
    );
    Diagnostic::error(279, span, message).help(text!(
        "remove `at`: several houses keep their places to each other, and their common origin comes to `x` and `y`",
        "`at` を消してください。複数の建物は互いの位置を保ち、共通の原点が `x` と `y` に来ます"
    ))
    .fix(removing("at"), whole, "")
}

/// A file that places itself.
#[cold]
pub fn place_in_itself(span: Span, chain: &[(String, Span)]) -> Diagnostic {
    let paths: Vec<_> = chain.iter().map(|(n, s)| (path_end(n), *s)).collect();
    let (en, ja) = (names(&paths, ", which places "), names(&paths, " → "));
    let message = text!([en, ja]
        "a file places itself: {en}",
        "ファイルが自分自身を置いています: {ja}"
    );
    let found = Diagnostic::error(269, span, message).help(text!(
        "write the house in a file of its own, and place that one",
        "建物を別のファイルに書き、それを置いてください"
    ));
    marked(found, &chain[..chain.len().saturating_sub(1)])
}
