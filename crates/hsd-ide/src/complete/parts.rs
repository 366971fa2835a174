//! Parts by their codes and by their names in any script.

use super::cells::{Cell, padded};
use super::{Completion, CompletionKind, PartKey, Request};
use crate::{Analysis, vocabulary};
use hsd_base::diagnostic::Text;
use hsd_base::text;
use hsd_ir::catalog::{Catalog, PartDef, PartId, folded, narrow};
use std::collections::BTreeMap;
use std::ops::Range;

/// The position of codes in a house, as far as it makes some of them more likely.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Storey {
    /// True above the ground storey.
    pub(super) upper: bool,
    /// True for walls other than the front.
    pub(super) rear: bool,
}

/// Returns parts in a run of codes, each padded to its columns.
pub(super) fn in_run(request: &Request<'_>, cell: &Cell, storey: Storey) -> Vec<Completion> {
    let insert = |part: &PartDef| {
        let code = part.code();
        (code.chars().count() == 5)
            .then(|| format!("{}{}", " ".repeat(cell.pad), padded(visible(code))))
    };
    proposals(request, &cell.typed, &cell.range, storey, &insert)
}

/// Returns parts in a value.
pub(super) fn in_value(request: &Request<'_>, range: &Range<usize>) -> Vec<Completion> {
    let typed = &request.text[range.start..request.at.clamp(range.start, range.end)];
    let insert = |part: &PartDef| Some(visible(part.code()).trim_end().to_owned());
    proposals(request, typed, range, Storey::default(), &insert)
}

fn proposals(
    request: &Request<'_>,
    typed: &str,
    replace: &Range<usize>,
    storey: Storey,
    insert: &dyn Fn(&PartDef) -> Option<String>,
) -> Vec<Completion> {
    let catalog = request.a.catalog();
    let used = used(request.a);
    let wanted = Wanted::new(typed);
    let known = known(request.a, request.at).into_iter();
    known
        .filter_map(|id| {
            let part = catalog.part(id);
            let rank = wanted.rank(part)?;
            let insert = insert(part)?;
            let own = !catalog.is_builtin(id);
            let times = used.get(part.code().trim_end()).copied().unwrap_or(0);
            let fits = fit(part.class(), storey);
            Some(Completion {
                label: visible(part.code()).trim_end().to_owned(),
                kind: if own {
                    CompletionKind::OwnPart
                } else {
                    CompletionKind::Part
                },
                detail: detail(part),
                replace: replace.clone(),
                insert,
                snippet: None,
                filter: filter(typed, part),
                sort: format!(
                    "{}{rank}{:04}{fits}{:05}",
                    u8::from(!own),
                    9999 - times.min(9999),
                    id.0
                ),
                part: Some(PartKey {
                    code: part.code().to_owned(),
                }),
            })
        })
        .collect()
}

/// Returns the parts known at an offset.
pub(crate) fn known(a: &Analysis, at: usize) -> Vec<PartId> {
    let catalog = a.catalog();
    let mut found = catalog.known(catalog.known_in(0, house_at(a, at)));
    // A file without houses, or a malformed one, still has its parts.
    let own = |id: &PartId| !catalog.is_builtin(*id);
    if !found.iter().any(own) && !catalog.parts().is_empty() {
        let all = (0..catalog.parts().len()).map(|i| PartId(i as u16));
        let all: Vec<PartId> = all.filter(own).collect();
        let codes: Vec<&str> = all.iter().map(|id| catalog.part(*id).code()).collect();
        found.retain(|id| !codes.contains(&catalog.part(*id).code()));
        found.splice(0..0, all);
    }
    found
}

/// Returns the number of the house at an offset.
pub(crate) fn house_at(a: &Analysis, at: usize) -> usize {
    let houses = &a.checked.building.houses;
    let holds = |span| {
        let range = a.source.text_range(span);
        range.start <= at && at <= range.end
    };
    let found = houses
        .iter()
        .position(|b| b.house.span.file == a.source.id() && holds(b.house.span));
    found.unwrap_or(0)
}

/// Returns the part that a code means at an offset.
pub(crate) fn meant(a: &Analysis, at: usize, code: &str) -> Option<PartId> {
    let catalog: &Catalog = a.catalog();
    let spelled = code.trim_end();
    let blank = spelled.replace('_', " ");
    let known = known(a, at);
    let find = |code: &str| {
        let same = |id: &&PartId| {
            let own = catalog.part(**id).code();
            own.trim_end() == code || code.trim_matches('.').is_empty() && own.trim().is_empty()
        };
        known.iter().find(same).copied()
    };
    find(spelled).or_else(|| find(blank.trim_end()))
}

/// Counts the uses of each code in the file.
fn used(a: &Analysis) -> BTreeMap<&str, u32> {
    let outline = a.outline();
    let text = a.text();
    let catalog = a.catalog();
    let mut codes: Vec<&str> = catalog
        .parts()
        .iter()
        .map(|p| p.code().trim_end())
        .collect();
    codes.sort_unstable();
    codes.dedup();
    let mut times = vec![0; codes.len()];
    let lines = outline.lines.iter().flat_map(|l| &l.codes);
    let words = outline.elements.iter().flat_map(|e| &e.words);
    for range in lines.chain(words.flat_map(|w| &w.codes)) {
        let code = text.get(range.clone()).unwrap_or_default();
        if let Ok(index) = codes.binary_search(&code.trim_end()) {
            times[index] += 1;
        }
    }
    codes.into_iter().zip(times).collect()
}

/// The typed string, in the forms in which it is compared.
struct Wanted {
    code: String,
    lower: String,
    sound: String,
    ascii: bool,
    capitals: bool,
}

impl Wanted {
    fn new(typed: &str) -> Wanted {
        let typed = &*narrow(typed.trim());
        Wanted {
            code: typed.to_ascii_uppercase(),
            lower: typed.to_lowercase(),
            sound: folded(typed),
            ascii: typed.is_ascii(),
            capitals: !typed.is_empty()
                && typed
                    .bytes()
                    .all(|b| b.is_ascii_uppercase() || b == b' ' || b.is_ascii_digit()),
        }
    }

    /// Returns the quality of a part's match, best 0; `None` = no match.
    fn rank(&self, part: &PartDef) -> Option<u8> {
        if self.lower.is_empty() {
            return Some(4);
        }
        if part.code().to_ascii_uppercase().starts_with(&self.code) {
            return Some(if self.capitals { 0 } else { 2 });
        }
        if !self.ascii {
            let named = part.ja.contains(&*self.lower)
                || vocabulary::class(part.class()).ja.contains(&*self.lower);
            let reads =
                !self.sound.is_empty() && sounds(part).iter().any(|s| s.contains(&self.sound));
            let begins = part.ja.starts_with(&*self.lower)
                || sounds(part).iter().any(|s| s.starts_with(&self.sound));
            return match (begins && !self.sound.is_empty(), named || reads) {
                (true, _) => Some(0),
                (_, true) => Some(1),
                _ => None,
            };
        }
        if self.capitals {
            return None;
        }
        let english = part.en.to_lowercase();
        let begins = english
            .split(|c: char| !c.is_alphanumeric())
            .any(|w| w.starts_with(&self.lower));
        let class = vocabulary::class(part.class()).en.starts_with(&self.lower);
        let sounds = sounds(part);
        if sounds.iter().any(|s| s.starts_with(&self.sound)) || class {
            return Some(0);
        }
        if begins || sounds.iter().any(|s| s.contains(&self.sound)) {
            return Some(1);
        }
        (self.lower.len() > 2 && english.contains(&self.lower)).then_some(3)
    }
}

/// Returns the sounds of a part's name: as it is read, and with the first sound of each word unvoiced (`gōshi` as
/// `kōshi`).
fn sounds(part: &PartDef) -> [String; 2] {
    let alone: Vec<String> = part
        .romaji
        .split(['-', ' ', '('])
        .map(|word| {
            let hard = [("g", "k"), ("z", "s"), ("j", "sh"), ("d", "t"), ("b", "h")];
            let hit = hard.iter().find(|(soft, _)| word.starts_with(soft));
            hit.map_or(word.to_owned(), |(soft, hard)| {
                format!("{hard}{}", &word[soft.len()..])
            })
        })
        .collect();
    [folded(&part.romaji), folded(&alone.concat())]
}

/// Returns the string that a client compares with the typed one.
fn filter(typed: &str, part: &PartDef) -> String {
    let [sound, alone] = sounds(part);
    let code = visible(part.code()).trim_end();
    let all = format!("{code} {} {sound} {alone} {}", part.ja, part.en);
    match typed.trim() {
        "" => all,
        typed => format!("{typed} {all}"),
    }
}

fn detail(part: &PartDef) -> Text {
    let (ja, romaji, en) = (&part.ja, &part.romaji, &part.en);
    let width = part.width();
    text!([ja, romaji, en, width] "{ja} {romaji}: {en}, {width} U", "{ja} {romaji} {width} U")
}

/// Returns a visible form of a code: the void's is five blanks.
pub(crate) fn visible(code: &str) -> &str {
    match code.trim().is_empty() {
        true => ".....",
        false => code,
    }
}

/// Returns the likelihood of a class at a place, 0 first.
fn fit(class: char, storey: Storey) -> usize {
    let order = match (storey.upper, storey.rear) {
        (false, false) => "GTKMAHN ",
        (false, true) => "KATMGHN ",
        (true, false) => "MGKATHN ",
        (true, true) => "KMAGTHN ",
    };
    order.find(class).unwrap_or(8)
}
