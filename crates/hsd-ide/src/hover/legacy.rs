//! Lines of the legacy form.

use super::{Hover, Request, built};
use crate::card::short;
use crate::complete::legacy::before;
use crate::complete::parts;
use crate::complete::roofs::{Field, field};
use crate::vocabulary;
use hsd_base::diagnostic::{Text, noun};
use hsd_base::geometry::SHAKU;
use hsd_base::text;
use hsd_syntax::parse::syntax::LegacyLine;
use hsd_syntax::parse::syntax::LineKind;
use std::ops::Range;

/// Returns the hover text at the requested place.
pub(super) fn hover(request: &Request<'_>) -> Option<Hover> {
    let outline = request.a.outline();
    let line = &outline.lines[outline.line_at(request.at)?];
    match line.kind {
        LineKind::Wall => wall(request, line),
        LineKind::Header => header(request, line),
        LineKind::Roof => roof(request, line),
        LineKind::Separator => request.told(
            &line.range,
            [text!("another house begins", "次の建物が始まる")],
        ),
        LineKind::Blank | LineKind::Comment => None,
    }
}

/// Returns the card of a part on its code, the wall everywhere else.
fn wall(request: &Request<'_>, line: &LegacyLine) -> Option<Hover> {
    let text = request.a.text();
    let written = |range: &Range<usize>| range.start + text[range.clone()].trim_end().len();
    let code = line
        .codes
        .iter()
        .find(|c| c.start <= request.at && request.at < written(c));
    if let Some(code) = code {
        return request.part(code, &text[code.clone()]);
    }
    let end = line.range.start + text[line.range.clone()].trim_end().len();
    let reset = text[..end].ends_with('^').then(|| end - 1..end);
    let turn = line.turn.clone().or(reset);
    let turn = turn.filter(|t| super::holds(t, request.at));
    let walls = built::walls(request, &line.range);
    let letter = turn.clone().map(|t| &text[t]);
    let meaning = letter.and_then(|l| vocabulary::meaning(vocabulary::TURNS, l).map(|m| (l, m)));
    let meaning = meaning.map(|(l, m)| text!([l, m] "`{l}`: {m}", "`{l}`: {m}"));
    let range = turn.unwrap_or(line.range.clone());
    request.told(&range, meaning.into_iter().chain(walls))
}

/// Returns the words of a line with their places.
fn words_of(text: &str, line: &Range<usize>) -> Vec<Range<usize>> {
    let written = &text[line.clone()];
    let words = written.split_whitespace();
    words
        .map(|w| {
            let start = line.start + (w.as_ptr() as usize - written.as_ptr() as usize);
            start..start + w.len()
        })
        .collect()
}

fn header(request: &Request<'_>, line: &LegacyLine) -> Option<Hover> {
    let text = request.a.text();
    let words = words_of(text, &line.range);
    let index = words.iter().position(|w| super::holds(w, request.at))?;
    let (first, word) = (&text[words[0].clone()], &text[words[index].clone()]);
    if !first.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c)) {
        let key = first.to_ascii_lowercase();
        let about: Text = vocabulary::meaning(vocabulary::KEYS, &key)?.into();
        let about = text!([key, about] "`{key}`: {about}", "`{key}`: {about}");
        let value = vocabulary::meaning(vocabulary::table("", &key), word).filter(|_| index > 0);
        let value = value.map(|m| text!([word, m] "`{word}`: {m}", "`{word}`: {m}"));
        return request.told(&words[index], [about].into_iter().chain(value));
    }
    if before(request.a, line.range.start).numbers == 0 {
        const PLACE: [hsd_base::diagnostic::Noun; 3] = [
            noun("x: metres to the east", "x: 東へ(m)"),
            noun("y: metres to the north", "y: 北へ(m)"),
            noun(
                "compass direction that the front looks to, degrees: 0 north, 90 east, 180 south, 270 west",
                "正面の向く方位(度): 0 北、90 東、180 南、270 西",
            ),
        ];
        let about = PLACE.get(index)?;
        return request.told(&words[index], [(*about).into()]);
    }
    let number = index + 1;
    let height: f64 = word.parse().ok()?;
    let metres = short(height * SHAKU, 2);
    let about = text!([number, word, metres]
        "height of storey {number}: {word} shaku = {metres} m",
        "{number}階の高さ: {word} 尺 = {metres} m"
    );
    let house = request
        .a
        .checked
        .building
        .houses
        .get(parts::house_at(request.a, request.at));
    let top = house
        .and_then(|b| b.house.storeys.iter().find(|s| s.number as usize == number))
        .map(|s| {
            let (shaku, metres) = (short(s.z1 / SHAKU, 2), short(s.z1, 2));
            text!([shaku, metres]
                "its top is {shaku} shaku = {metres} m above the sill",
                "上端は土台から {shaku} 尺 = {metres} m"
            )
        });
    request.told(&words[index], [about].into_iter().chain(top))
}

fn roof(request: &Request<'_>, line: &LegacyLine) -> Option<Hover> {
    let text = request.a.text();
    let words = words_of(text, &line.range);
    let built = built::roofs(request, &line.range, false);
    let Some(index) = words.iter().position(|w| super::holds(w, request.at)) else {
        return request.told(&line.range, built);
    };
    let word = &text[words[index].clone()];
    let meaning = |table| vocabulary::meaning(table, word).map(Text::from);
    let about: Option<Text> = match field(index) {
        Field::Covering => meaning(vocabulary::COVERINGS),
        Field::Direction => meaning(vocabulary::DIRECTIONS),
        Field::Shape => meaning(vocabulary::ROOF_SHAPES),
        Field::Height if word == "*" => {
            Some(text!("the eaves are where the walls end", "軒は壁の上端"))
        }
        Field::Height => word.parse::<f64>().ok().map(|h| {
            let metres = short(h * SHAKU, 2);
            text!([word, metres]
                "height of the eaves above the sill: {word} shaku = {metres} m",
                "軒の高さ(土台から): {word} 尺 = {metres} m"
            )
        }),
        Field::Corner(number) => {
            let name = ["a0", "b0", "a1", "b1"][number];
            let way = match number % 2 {
                0 => text!(
                    "units to the left along the first line",
                    "最初の行に沿って左へ(ユニット)"
                ),
                _ => text!("units back into the plot", "奥へ(ユニット)"),
            };
            Some(text!([name, way] "`{name}`: {way}", "`{name}`: {way}"))
        }
        Field::Option => option(word),
    };
    let head = about.map(|m| text!([word, m] "`{word}`: {m}", "`{word}`: {m}"));
    request.told(&words[index], head.into_iter().chain(built))
}

/// Describes an option: its letter, and its number.
fn option(word: &str) -> Option<Text> {
    let (letter, number) = (word.get(..1)?, word.get(1..)?);
    let about = Text::from(vocabulary::meaning(vocabulary::OPTIONS, letter)?);
    let Ok(number) = number.parse::<f64>() else {
        return Some(about);
    };
    let (own, metres) = (short(number, 3), short(number * SHAKU, 2));
    Some(match letter {
        "P" => text!([own]
            "pitch of {own} sun: rises {own} in 10",
            "勾配 {own} 寸: 10 進んで {own} 上がる"
        ),
        "E" | "G" | "T" => {
            text!([about, own, metres] "{about}: {own} = {metres} m", "{about}: {own} = {metres} m")
        }
        _ => about,
    })
}
