//! Rename: the edits, and a check that every name keeps its meaning.
//!
//! For the check, outlines of the files are made again with the edits, and each name in them must refer to the same
//! definition as before. So no name can be captured by another, nor clash with one.

use super::{Found, Symbol, SymbolKind, Target, target};
use crate::Analysis;
use hsd_base::diagnostic::Text;
use hsd_base::source::{FileId, Source};
use hsd_base::text;
use hsd_ir::ast::CodeText;
use hsd_syntax::parse;
use hsd_syntax::parse::names::codes::{CodeForm, CodeOccurrence, Codes, Site, key};
use hsd_syntax::parse::names::file::{File, word};
use hsd_syntax::parse::names::links::Links;
use hsd_syntax::parse::names::resolve;
use hsd_syntax::parse::names::table::{NameTable, Role};
use hsd_syntax::parse::syntax::{Outline, is_name};
use hsd_syntax::print;
use std::ops::Range;

/// The replacement of a range in a file.
pub type Change = (FileId, Range<usize>, String);

/// Returns the range that a rename at an offset would change, and the current name; `None` if nothing can be renamed.
pub fn prepare_rename(a: &Analysis, at: usize) -> Option<(Range<usize>, String)> {
    let files = a.files();
    let codes = a.codes(&files);
    let range = match a.found(&files, &codes, at)? {
        Found::Names(marks) => {
            let index = &a.names(&files).index;
            let [mark] = &marks[..] else { return None };
            let declared = index
                .of_symbol(mark.symbol)
                .any(|m| m.role == Role::Declares);
            let fixed = matches!(
                index.symbols[mark.symbol].kind,
                SymbolKind::File | SymbolKind::Facade
            );
            (declared && !fixed && mark.role != Role::Computed).then(|| mark.range.clone())?
        }
        Found::Code(spot) => {
            let site = codes.meaning(&spot)?;
            (site.form == CodeForm::Part).then(|| spot.range.clone())?
        }
    };
    let now = a.text()[range.clone()].trim_end();
    Some((range.start..range.start + now.len(), now.to_owned()))
}

/// Returns the edits that rename the symbol at an offset.
///
/// # Errors If the name is invalid, or means something else already.
pub fn rename(a: &Analysis, at: usize, new: &str) -> Result<Vec<Change>, Text> {
    let symbol = prepare_rename(a, at).and_then(|_| super::symbol_at(a, at));
    let Some(symbol) = symbol else {
        return Err(text!(
            "what stands here has no name that could be changed",
            "ここには変えられる名がありません"
        ));
    };
    rename_symbol(a, &symbol, new)
}

/// Returns the edits that rename a symbol that this file or another one defines.
///
/// # Errors If the name is invalid, or means something else already.
pub fn rename_symbol(a: &Analysis, symbol: &Symbol, new: &str) -> Result<Vec<Change>, Text> {
    let files = a.files();
    let codes = a.codes(&files);
    match target(a, &files, &codes, symbol) {
        // Nothing of it is in this file.
        None => Ok(vec![]),
        Some(Target::Name(number)) => name(a, &files, number, new.trim()),
        Some(Target::Code(site)) if site.form == CodeForm::Part => {
            code(a, &codes, &site, new.trim())
        }
        Some(Target::Code(_)) => Err(text!(
            "the name of a picture is that of its file",
            "画像の名はファイルの名によります"
        )),
        Some(Target::Builtin) => {
            let code = symbol.name.trim_end();
            Err(text!([code]
                "`{code}` comes with the program",
                "`{code}` は組み込みの部材です"
            ))
        }
    }
}

/// Renames a value, a parameter, a definition or a floor.
fn name(a: &Analysis, files: &[File<'_>], number: usize, new: &str) -> Result<Vec<Change>, Text> {
    let index = &a.names(files).index;
    let named = &index.symbols[number];
    let old = &*named.name;
    let marks = || index.of_symbol(number);
    valid(named.kind, new)?;
    if marks().any(|m| m.role == Role::Computed) {
        return Err(text!([old]
            "the name `{old}` is put together in some places, which no other name would fit",
            "`{old}` は、組み立てた名で使われている所があるため、変えられません"
        ));
    }
    if named.kind == SymbolKind::Floor && numbered(files, old, new) {
        return Err(text!(
            "floors without an id go by their number, or `k` stands for it",
            "id の無い階は番号で、`k` は番号の代わりに読まれるため、変えられません"
        ));
    }
    if old == new {
        return Ok(vec![]);
    }
    let edits: Vec<Change> = marks()
        .map(|m| (m.file, m.range.clone(), new.to_owned()))
        .collect();
    let after = tried(a, files, &edits);
    if after != meanings(index, &edits) {
        return Err(text!([new, old]
            "`{new}` means something else already where `{old}` is used",
            "`{old}` を使う所で `{new}` は別のものを指します"
        ));
    }
    Ok(edits)
}

/// Checks that a name is valid for this kind of symbol.
fn valid(kind: SymbolKind, new: &str) -> Result<(), Text> {
    let marks = |c: char| "{}<>&\"',".contains(c) || c.is_control();
    let sound = match kind {
        SymbolKind::Value => is_name(new),
        SymbolKind::Parameter => is_name(new) && new != "name" && new != "xmlns",
        SymbolKind::Piece | SymbolKind::Floor => !new.is_empty() && !new.contains(marks),
        SymbolKind::File | SymbolKind::Facade | SymbolKind::Part | SymbolKind::Picture => false,
    };
    if sound {
        return Ok(());
    }
    Err(match kind {
        SymbolKind::Value | SymbolKind::Parameter => text!([new]
            "`{new}` cannot be a name: letters, digits and `_`, a letter first, and no word of the language",
            "`{new}` は名にできません。文字、数字、`_` を使い、文字で始め、言語の語は避けてください"
        ),
        SymbolKind::Piece | SymbolKind::Floor => text!([new]
            "`{new}` cannot be a name: it is empty or has signs in it that mean something in XML",
            "`{new}` は名にできません。空か、XML で意味を持つ記号を含みます"
        ),
        _ => text!(
            "files, facades and pictures cannot be renamed here",
            "ファイル、壁面、画像の名はここでは変えられません"
        ),
    })
}

/// Returns true if floors may be addressed by number, so that ids are more than names.
fn numbered(files: &[File<'_>], old: &str, new: &str) -> bool {
    let mut elements = files.iter().flat_map(|f| &f.outline.elements);
    let nameless = elements.any(|e| word(e) == "Floor" && e.attribute("id").is_none());
    let number = |id: &str| id.chars().all(|c| c.is_ascii_digit());
    let special = |id: &str| id.contains('k') || id == "t" || id == "top";
    special(old) || special(new) || (nameless && (number(old) || number(new)))
}

/// The meaning of every name: its place after some edits, its role, and the first name that means the same.
type Meanings = Vec<(FileId, usize, Role, usize)>;

fn meanings(index: &NameTable, edits: &[Change]) -> Meanings {
    let mut first: Vec<Option<usize>> = vec![None; index.symbols.len()];
    let marks = index.marks.iter().enumerate();
    marks
        .map(|(number, mark)| {
            let first = *first[mark.symbol].get_or_insert(number);
            (
                mark.file,
                moved(mark.file, mark.range.start, edits),
                mark.role,
                first,
            )
        })
        .collect()
}

/// Returns the position of an offset after some edits of one length each.
fn moved(file: FileId, at: usize, edits: &[Change]) -> usize {
    let before = edits.iter().filter(|(f, r, _)| *f == file && r.start < at);
    let (gone, come) = before.fold((0, 0), |(gone, come), (_, range, new)| {
        (gone + range.len(), come + new.len())
    });
    at + come - gone
}

/// Returns the meaning of every name after some edits.
fn tried(a: &Analysis, files: &[File<'_>], edits: &[Change]) -> Meanings {
    let limits = &a.options.expand.limits;
    let all = std::iter::once(&a.source).chain(&a.checked.included);
    let changed: Vec<(Source, Outline)> = all
        .map(|source| {
            let text = applied(source.id(), source.text(), edits);
            let bytes = print::encode(&text, source);
            let after = Source::new(source.id(), source.name(), &bytes);
            let outline = parse::outline::of(&after, limits);
            (after, outline)
        })
        .collect();
    let after: Vec<File<'_>> = files
        .iter()
        .zip(&changed)
        .map(|(file, (source, outline))| File {
            text: source.text(),
            outline,
            ..*file
        })
        .collect();
    meanings(&resolve(&after, &Links::of(&after)), &[])
}

/// Applies the edits of one file to its text.
fn applied(file: FileId, text: &str, edits: &[Change]) -> String {
    let mut own: Vec<&Change> = edits.iter().filter(|(f, ..)| *f == file).collect();
    own.sort_by_key(|(_, range, _)| range.start);
    let (mut made, mut at) = (String::with_capacity(text.len()), 0);
    for (_, range, new) in own {
        made.push_str(&text[at..range.start]);
        made.push_str(new);
        at = range.end;
    }
    made.push_str(&text[at..]);
    made
}

/// Renames a custom part.
fn code(a: &Analysis, codes: &Codes<'_>, site: &Site, new: &str) -> Result<Vec<Change>, Text> {
    let old = codes.text(site).trim();
    if old == new {
        return Ok(vec![]);
    }
    let marks = |c: char| "{}<>&\"',".contains(c) || c.is_control();
    let five = new.len() <= 5 && new.is_ascii();
    if new.is_empty() || new.contains(marks) || (!five && new.contains(char::is_whitespace)) {
        return Err(text!([new]
            "`{new}` cannot be a code: five columns of ASCII, or a longer name without blanks",
            "`{new}` はコードにできません。ASCII の五桁か、空白の無い長い名にしてください"
        ));
    }
    let taken =
        |spot: &CodeOccurrence| key(codes.text(spot)) == new && spot.form != CodeForm::Perhaps;
    let mut used = parse::builtin().find(&CodeText::new(new)).is_some();
    for file in 0..codes.files.len() {
        codes.each(file, &mut |spot| used |= taken(&spot));
    }
    if used {
        return Err(text!([new]
            "the code `{new}` means something else already",
            "コード `{new}` はすでに別のものを指します"
        ));
    }
    keeps_its_measures(a, codes, site, new)?;
    let spots = codes.alike(old, Some(site));
    if !five && spots.iter().any(|s| s.form == CodeForm::Columns) {
        return Err(text!([new]
            "codes in wall lines have five columns, and `{new}` has more",
            "壁の行のコードは五桁です。`{new}` は長すぎます"
        ));
    }
    let edit = |spot: &CodeOccurrence| {
        // A code keeps its columns; if its last blanks were left out, it may go on without them.
        let width = match spot.form {
            CodeForm::Columns => spot.range.len().min(5),
            _ => 0,
        };
        (
            codes.files[spot.file].id,
            spot.range.clone(),
            format!("{new:<width$}"),
        )
    };
    Ok(spots.iter().map(edit).collect())
}

/// Checks that a part keeps its width and class, which its code determines unless an attribute does.
fn keeps_its_measures(a: &Analysis, codes: &Codes<'_>, site: &Site, new: &str) -> Result<(), Text> {
    let old = codes.text(site).trim();
    let element = site
        .element
        .map(|e| &codes.files[site.file].outline.elements[e]);
    let says = |name: &str| element.is_some_and(|e| e.attribute(name).is_some());
    let column = |code: &str| match CodeText::new(code) {
        CodeText::Five(five) => Some(five[4]),
        CodeText::Name(_) => None,
    };
    let known = a.catalog().parts().iter().rev();
    let width = known
        .clone()
        .find(|p| p.code().trim() == old)
        .map(|p| p.width());
    let told = column(new).and_then(|c| match c {
        b' ' => Some(1.0),
        b'h' => Some(0.5),
        digit @ b'0'..=b'9' => Some(f64::from(digit - b'0')),
        _ => None,
    });
    let same_column = column(new) == column(old);
    let fits = match told {
        Some(told) => width.is_none_or(|w| w == told),
        None => says("width") || says("base"),
    };
    if !same_column && !fits {
        return Err(text!([new]
            "the fifth column of a code says how wide the part is, and that of `{new}` says otherwise",
            "コードの五桁目は幅を表します。`{new}` では幅が変わります"
        ));
    }
    if !says("base") && old.chars().next() != new.chars().next() {
        return Err(text!([new, old]
            "the first letter of a code says what kind of part it is: `{new}` has to begin like `{old}`",
            "コードの一文字目は部材の種類を表します。`{new}` を `{old}` と同じ文字で始めてください"
        ));
    }
    Ok(())
}
