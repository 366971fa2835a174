//! Messages about the limits of a run (HSD0901, HSD0904, HSD0907, HSD0908, HSD0911).

use crate::diagnostic::{Diagnostic, Text};
use crate::source::Span;
use crate::text;

/// More bytes than the limit.
#[cold]
pub fn too_large(span: Span, size: usize, limit: usize) -> Diagnostic {
    let message = text!([size, limit]
        "the file has {size} bytes, more than the limit of {limit}",
        "ファイルが {size} バイトあり、上限の {limit} バイトを超えています"
    );
    Diagnostic::error(901, span, message).help(text!(
        "split it into several files, or raise the limit with `--max-bytes`",
        "いくつかのファイルに分けるか、`--max-bytes` で上限を上げてください"
    ))
}

/// As [`too_large`], for a file that would be read in pieces if it were not for this.
#[cold]
pub fn too_large_whole(span: Span, size: usize, limit: usize, reason: &Text) -> Diagnostic {
    let diagnostic = too_large(span, size, limit);
    diagnostic.help(text!([reason]
        "it cannot be read in pieces of whole houses: {reason}; mend that, split it into several files, or raise the limit with `--max-bytes`",
        "家ごとに分けて読むことができません ({reason})。そこを直すか、いくつかのファイルに分けるか、`--max-bytes` で上限を上げてください"
    ))
}

/// More variants than the limit.
#[cold]
pub fn too_many_variants(span: Span, asked: u32, most: u32) -> Diagnostic {
    let message = text!([asked, most]
        "{asked} variants are more than the limit of {most} for sources of this size; the rest is left out",
        "変種 {asked} 件は、この大きさのファイルの上限 {most} 件を超えます。残りは作りません"
    );
    Diagnostic::error(908, span, message).help(text!(
        "build them in several runs with `--seed`, or raise the limit with `--max-variants`",
        "`--seed` を変えて何回かに分けて作るか、`--max-variants` で上限を上げてください"
    ))
}

/// Too many parts, or too much work on them.
#[cold]
pub fn too_many_parts(span: Span, limit: u64) -> Diagnostic {
    let message = text!([limit]
        "this house would exceed the limit of {limit} parts, or of operations on them",
        "この家は部材数か処理量の上限 ({limit}) を超えます"
    );
    Diagnostic::error(904, span, message).help(text!(
        "repeat less often, split it into several houses, or raise the limit with `--max-parts`",
        "繰り返しを減らすか、何軒かに分けるか、`--max-parts` で上限を上げてください"
    ))
}

/// Too many parts, or too much work on them, by the repetitions of all houses together.
#[cold]
pub fn too_many_repeated(span: Span, limit: u64) -> Diagnostic {
    let message = text!([limit]
        "repetitions would add more than {limit} parts to the houses of this run, or operations on them; this house is left out",
        "この家で、繰り返しが加える部材数か処理量が全体の上限 ({limit}) を超えます。この家は作りません"
    );
    Diagnostic::error(907, span, message).help(text!(
        "repeat less often, build the houses in several runs, or raise the limit with `--max-repeated-parts`",
        "繰り返しを減らすか、何回かに分けて作るか、`--max-repeated-parts` で上限を上げてください"
    ))
}

/// A house with too many triangles.
#[cold]
pub fn too_many_triangles(span: Span, limit: usize) -> Diagnostic {
    let message = text!([limit]
        "this house would have more than {limit} triangles; it is left out",
        "この家の三角形は上限 ({limit}) を超えます。この家は作りません"
    );
    Diagnostic::error(911, span, message).help(text!(
        "build it with less `--detail`, split it into several houses, or raise the limit with `--max-triangles`",
        "`--detail` を下げるか、何軒かに分けるか、`--max-triangles` で上限を上げてください"
    ))
}

/// A house of a town with too many triangles at a level of detail, which is shown at another.
#[cold]
pub fn shown_plainer(span: Span, limit: usize, (detail, shown): (usize, usize)) -> Diagnostic {
    let message = text!([limit, detail, shown]
        "this house would have more than {limit} triangles at detail {detail}; it is shown at detail {shown}",
        "この家の三角形は詳細度 {detail} で上限 ({limit}) を超えます。詳細度 {shown} で示します"
    );
    Diagnostic::warning(911, span, message).help(text!(
        "split its outline into several houses, or raise the limit with `--max-triangles`",
        "外形を何軒かに分けるか、`--max-triangles` で上限を上げてください"
    ))
}

/// Too many storeys of monuments.
#[cold]
pub fn too_many_storeys(span: Span, limit: u64) -> Diagnostic {
    let message = text!([limit]
        "the monuments have more than {limit} storeys in total; this one and those after it are left out",
        "モニュメントの階が合わせて {limit} を超えます。これ以降の建物は作りません"
    );
    Diagnostic::error(904, span, message).help(text!(
        "split the file, or raise the limit with `--max-parts`: a storey counts as 1250 parts",
        "ファイルを分けるか、`--max-parts` で上限を上げてください。一階につき部材 1250 個分です"
    ))
}
