//! Messages about named views (HSD0433 to HSD0436).

use hsd_base::diagnostic::Diagnostic;
use hsd_base::diagnostic::messages::words::quote;
use hsd_base::source::Span;
use hsd_base::text;

/// HSD0433: a name that another view of the file has (`first`), or a view that every house has.
#[cold]
pub fn name_taken(name: Span, text: &str, first: Option<Span>) -> Diagnostic {
    let text = quote(text);
    let Some(first) = first else {
        let message = text!([text]
            "`hsd render --view` has a view called {text} of its own, and takes that one",
            "`hsd render --view` には {text} という視点がもともとあり、そちらが使われます"
        );
        return Diagnostic::warning(433, name, message)
            .help(text!("choose another name", "別の名にしてください"));
    };
    let message = text!([text]
        "two views are called {text}; the second one is left out",
        "{text} という視点が二つあります。二つ目は使いません"
    );
    Diagnostic::warning(433, name, message)
        .label(first, text!("the first one", "一つ目"))
        .help(text!("choose another name", "別の名にしてください"))
}

/// HSD0434: a view in a file that becomes a legacy text.
#[cold]
pub fn not_in_legacy(view: Span) -> Diagnostic {
    let message = text!(
        "the legacy form has no views",
        "旧形式には視点(`View`)がありません"
    );
    Diagnostic::error(434, view, message).help(text!(
        "delete it, or keep the file in XML",
        "削除するか、XML のままにしてください"
    ))
}

/// HSD0435: a camera that looks at its own place.
#[cold]
pub fn looks_at_itself(to: Span) -> Diagnostic {
    let message = text!(
        "the camera looks at its own place: `from` and `to` are the same",
        "`from` と `to` が同じで、カメラの向きが決まりません"
    );
    Diagnostic::error(435, to, message).help(text!(
        "`to` is a place in the middle of the picture, such as a door: metres east, north and up",
        "`to` には写真の中心に来る場所(戸口など)を、東へ・北へ・高さのメートルで書いてください"
    ))
}

/// HSD0435: a place that has not three coordinates.
#[cold]
pub fn not_a_spot(span: Span, name: &str, count: usize) -> Diagnostic {
    let name = quote(name);
    let message = text!([name, count]
        "{name} needs three numbers and has {count}",
        "{name} には数が三つ要りますが、{count} 個あります"
    );
    Diagnostic::error(435, span, message).help(text!(
        "write metres east, north and up: `2 -5 1.6` is at eye height",
        "東へ・北へ・高さの順にメートルで書いてください。`2 -5 1.6` は目の高さです"
    ))
}

/// HSD0436: an hour without a date.
#[cold]
pub fn hour_of_no_day(hour: Span) -> Diagnostic {
    let message = text!(
        "`hour` needs a `date`: the sun stands elsewhere on every day",
        "`hour` には `date` が要ります。太陽の位置は日によって違います"
    );
    Diagnostic::error(436, hour, message).help(text!(
        "add one, such as `date=\"2026-12-21\"`, or leave out `hour` for the usual afternoon",
        "`date=\"2026-12-21\"` のように日付を加えるか、`hour` を消してください(いつもの午後になります)"
    ))
}

/// HSD0436: an hour that cannot be read.
#[cold]
pub fn no_hour(span: Span, text: &str) -> Diagnostic {
    let text = quote(text);
    let message = text!([text] "{text} is no hour of a day", "{text} は時刻として読めません");
    Diagnostic::error(436, span, message).help(text!(
        "write it as on a clock of 24 hours: `9`, `16:30`",
        "`9` や `16:30` のように 24 時間制で書いてください"
    ))
}

/// HSD0436: a date that cannot be read.
#[cold]
pub fn no_date(span: Span, text: &str) -> Diagnostic {
    let text = quote(text);
    let message = text!([text] "{text} is no date", "{text} は日付として読めません");
    Diagnostic::error(436, span, message).help(text!(
        "write year, month and day: `2026-12-21`",
        "`2026-12-21` のように年、月、日の順に書いてください"
    ))
}
