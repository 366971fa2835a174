//! A file with two hundred mistakes shows two hundred messages: each mistake its own, at its own place, with help, and
//! nothing else. Files are put together of houses with one mistake each, `«` and `»` round it.

use crate::support::Words;
use crate::support::{assert_none, compile};
use std::collections::BTreeMap;

/// Mistakes in a file.
const MANY: usize = 200;

/// Three sound walls and the beginning of a storey.
const WALLS: &str = "<Row>KSK  KSK</Row><Row>KSK  KSK  KSK</Row><Row>KSK  KSK</Row></Storey>";

/// Houses of the XML form: code, text; `*` = the walls.
#[rustfmt::skip]
const XML: &[(u16, &str)] = &[
    (
        222,
        "<House «nmae»='a'><Storey><Row>KSK  KSK  TOD</Row>*</House>",
    ),
    (
        225,
        "<House unit='«three»'><Storey><Row>KSK  KSK  TOD</Row>*</House>",
    ),
    (
        225,
        "<House azimuth='«south»'><Storey><Row>KSK  KSK  TOD</Row>*</House>",
    ),
    (
        225,
        "<House unit='«京間»'><Storey><Row>KSK  KSK  TOD</Row>*</House>",
    ),
    (
        226,
        "<House unit='«1000»'><Storey><Row>KSK  KSK  TOD</Row>*</House>",
    ),
    (
        227,
        "<House street='«maybe»'><Storey><Row>KSK  KSK  TOD</Row>*</House>",
    ),
    (
        226,
        "<House><Storey height='«0»'><Row>KSK  KSK  TOD</Row>*</House>",
    ),
    (
        227,
        "<House><Storey kind='«paraped»'><Row>KSK  KSK  TOD</Row>*<Roofs mode='explicit'/></House>",
    ),
    (
        238,
        "<House><Storey start='«1»'><Row>KSK  KSK  TOD</Row>*</House>",
    ),
    (
        227,
        "<House><Storey><Row turn='«Q»'>KSK  KSK  TOD</Row>*</House>",
    ),
    (301, "<House><Storey><Row>KSK  KSK  «QZJ  »</Row>*</House>"),
    (
        221,
        "<House><Storey><Row>KSK  KSK  <«Paart» code='TOD'/></Row>*</House>",
    ),
    (
        224,
        "<House><Storey><Row>KSK  KSK  TOD<«Part»/></Row><Row>KSK  KSK</Row><Row>KSK  KSK  KSK  KSK</Row><Row>KSK  KSK</Row></Storey></House>",
    ),
    (
        225,
        "<House><Storey><Row><repeat num='«three»'>TOD</repeat>KSK  KSK</Row>*</House>",
    ),
    (
        226,
        "<House><Storey><Row>KSK  KSK  <random code='TOD' weights='«-1»'/></Row>*</House>",
    ),
    (
        224,
        "<House><Storey><Row>KSK  KSK  TOD<«replace» code='TOD'/></Row>*</House>",
    ),
    (
        216,
        "<House name='a«&nbsp;»b'><Storey><Row>KSK  KSK  TOD</Row>*</House>",
    ),
    (
        209,
        "<House>«here it is»<Storey><Row>KSK  KSK  TOD</Row>*</House>",
    ),
    (
        210,
        "<House x='1' «x»='2'><Storey><Row>KSK  KSK  TOD</Row>*</House>",
    ),
    (
        211,
        "<House x=«1»><Storey><Row>KSK  KSK  TOD</Row>*</House>",
    ),
    (
        223,
        "<House><«Row»>KSK</Row><Storey><Row>KSK  KSK  TOD</Row>*</House>",
    ),
    (
        227,
        "<House><Storey><Row>KSK  KSK  TOD</Row>*<Roofs kind='«Z»'/></House>",
    ),
    (
        225,
        "<House><Storey><Row>KSK  KSK  TOD</Row>*<Roofs pitch='«4,5»'/></House>",
    ),
    (
        226,
        "<House><Storey><Row>KSK  KSK  TOD</Row>*<Roofs sori='«99»'/></House>",
    ),
    (
        224,
        "<House><Storey><Row>KSK  KSK  TOD</Row>*<Roofs><«Roof» a0='0' b0='0' a1='3'/></Roofs></House>",
    ),
    (
        231,
        "<House><Storey><Row>KSK  KSK  TOD</Row>*<Roofs/><«Roofs»/></House>",
    ),
    (
        227,
        "<House><Platform stairs='«Q»'/><Storey><Row>KSK  KSK  TOD</Row>*</House>",
    ),
    (
        226,
        "<House><Posts size='«50»'/><Storey><Row>KSK  KSK  TOD</Row>*</House>",
    ),
    (
        227,
        "<House><Storey><Veranda rail='«glass»'/><Row>KSK  KSK  TOD</Row>*</House>",
    ),
    (
        230,
        "<House><Storey><Row>KSK  KSK  <«split»><upper>TOD</upper></split></Row>*</House>",
    ),
    (
        252,
        "<House><Storey height='{«tall»}'><Row>KSK  KSK  TOD</Row>*</House>",
    ),
    (
        229,
        "<House><Storey height='{1 +«}»'><Row>KSK  KSK  TOD</Row>*</House>",
    ),
    (
        254,
        "<House><Storey height='{1 / «0»}'><Row>KSK  KSK  TOD</Row>*</House>",
    ),
    (
        253,
        "<House><if test='«3»'></if><Storey><Row>KSK  KSK  TOD</Row>*</House>",
    ),
    (
        262,
        "<House><«else»></else><Storey><Row>KSK  KSK  TOD</Row>*</House>",
    ),
    (
        263,
        "<House><use name='«porch»'/><Storey><Row>KSK  KSK  TOD</Row>*</House>",
    ),
    (
        257,
        "<House><let name='«1st»' value='2'/><Storey><Row>KSK  KSK  TOD</Row>*</House>",
    ),
    (
        259,
        "<House><Param name='p' default='«9»' max='5'/><Storey><Row>KSK  KSK  TOD</Row>*</House>",
    ),
    (
        237,
        "<House «name=''»><Storey><Row>KSK  KSK  TOD</Row>*</House>",
    ),
];

/// Houses of the legacy form.
#[rustfmt::skip]
const LEGACY: &[(u16, &str)] = &[
    (102, "0«»\n9\n\nKSM  KSM\nKSM  KSM\nKSM  KSM\nKSM  KSM\n"),
    (103, "0 0 «north»\n9\n\nKSM  KSM\nKSM  KSM\nKSM  KSM\nKSM  KSM\n"),
    (103, "0 0 180\n«9,5»\n\nKSM  KSM\nKSM  KSM\nKSM  KSM\nKSM  KSM\n"),
    (104, "0 0 180\n«9000»\n\nKSM  KSM\nKSM  KSM\nKSM  KSM\nKSM  KSM\n"),
    (103, "0 0 180\n«9尺»\n\nKSM  KSM\nKSM  KSM\nKSM  KSM\nKSM  KSM\n"),
    (105, "0 0 180\n9\n«stret» yes\n\nKSM  KSM\nKSM  KSM\nKSM  KSM\nKSM  KSM\n"),
    (106, "0 0 180\n9\nstreet «maybe»\n\nKSM  KSM\nKSM  KSM\nKSM  KSM\nKSM  KSM\n"),
    (106, "0 0 180\n9\nmethod «cut»\n\nKSM  KSM\nKSM  KSM\nKSM  KSM\nKSM  KSM\n"),
    (106, "0 0 180\n9\nroofs «none»\n\nKSM  KSM\nKSM  KSM\nKSM  KSM\nKSM  KSM\n"),
    (117, "0 0 180\n9\n«unit»\n\nKSM  KSM\nKSM  KSM\nKSM  KSM\nKSM  KSM\n"),
    (118, "0 0 180\n9\nseed «-7»\n\nKSM  KSM\nKSM  KSM\nKSM  KSM\nKSM  KSM\n"),
    (103, "0 0 180\n9\nunit «kyoma»\n\nKSM  KSM\nKSM  KSM\nKSM  KSM\nKSM  KSM\n"),
    (103, "0 0 «南»\n9\n\nKSM  KSM\nKSM  KSM\nKSM  KSM\nKSM  KSM\n"),
    (132, "0 0 180\n9\n\nKSM  KSM\nKSM  KSM\nKSM «KSM» R\nKSM  KSM\n"),
    (103, "0 0 180\n9\nunit «three»\n\nKSM  KSM\nKSM  KSM\nKSM  KSM\nKSM  KSM\n"),
    (111, "0 0 180\n9\n«5.0»\n\nKSM  KSM\nKSM  KSM\nKSM  KSM\nKSM  KSM\n"),
    (107, "0 0 180 «9.0»\n9\n\nKSM  KSM\nKSM  KSM\nKSM  KSM\nKSM  KSM\n"),
    (112, "0 0 180\n9 «5.0»\n\nKSM  KSM\nKSM  KSM\nKSM  KSM\nKSM  KSM\n"),
    (113, "0 0 180\n9\n\nKSM  KSM  «# the front»\nKSM  KSM\nKSM  KSM\nKSM  KSM\n"),
    (120, "0 0 180\n9\n\nKSM«　»KSM\nKSM  KSM\nKSM  KSM\nKSM  KSM\n"),
    (121, "0 0 180\n9\n\nKSM«\t»KSM\nKSM  KSM\nKSM  KSM\nKSM  KSM\n"),
    (122, "0 0 180\n9\n\nKSM  «Ｋ»SM\nKSM  KSM\nKSM  KSM\nKSM  KSM\n"),
    (123, "0 0 180\n9\n\nKSM«\u{a0}» KSM\nKSM  KSM\nKSM  KSM\nKSM  KSM\n"),
    (124, "0 0 180\n9\n\nKSM«町» KSM\nKSM  KSM\nKSM  KSM\nKSM  KSM\n"),
    (126, "0 0 180\n9\n\nKSM  KSM  «X»\nKSM  KSM\nKSM  KSM\nKSM  KSM\n"),
    (128, "0 0 180\n9\n\nKSM  KSM  «r»\nKSM  KSM\nKSM  KSM\nKSM  KSM\n"),
    (129, "0 0 180\n9\n\nKSM  KSM  R«   »\nKSM  KSM\nKSM  KSM\nKSM  KSM\n"),
    (131, "0 0 180\n9\n\n«  »KSM  KSM\nKSM  KSM\nKSM  KSM\nKSM  KSM\n"),
    (301, "0 0 180\n9\n\nKSM  «QZJ  »\nKSM  KSM\nKSM  KSM\nKSM  KSM\n"),
    (140, "0 0 180\n9\n\nKSM  KSM\nKSM  KSM\nKSM  KSM\nKSM  KSM\n\n«Z» X  9.0 KIR 0 0 2 2\n"),
    (141, "0 0 180\n9\n\nKSM  KSM\nKSM  KSM\nKSM  KSM\nKSM  KSM\n\nK «N»  9.0 KIR 0 0 2 2\n"),
    (142, "0 0 180\n9\n\nKSM  KSM\nKSM  KSM\nKSM  KSM\nKSM  KSM\n\nK X  9.0 «KRI» 0 0 2 2\n"),
    (143, "0 0 180\n9\n\nKSM  KSM\nKSM  KSM\nKSM  KSM\nKSM  KSM\n\nK X  9.0 KIR 0 0 2 2 «Q3»\n"),
    (144, "0 0 180\n9\n\nKSM  KSM\nKSM  KSM\nKSM  KSM\nKSM  KSM\n\nK «F»  9.0 KIR 0 0 2 2\n"),
    (145, "0 0 180\n9\n\nKSM  KSM\nKSM  KSM\nKSM  KSM\nKSM  KSM\n\nK X  «»KIR 0 0 2 2\n"),
    (146, "0 0 180\n9\n\nKSM  KSM\nKSM  KSM\nKSM  KSM\nKSM  KSM\n\nK X  9.0 KIR 0 0 2«»\n"),
    (147, "0 0 180\n9\n\nKSM  KSM\nKSM  KSM\nKSM  KSM\nKSM  KSM\n\nK X  9.0 KIR 0 0 «0» 2\n"),
    (148, "0 0 180\n9\n\nKSM  KSM\nKSM  KSM\nKSM  KSM\nKSM  KSM\n\n«KX»  9.0 KIR 0 0 2 2\n"),
    (149, "0 0 180\n9\n\nKSM  KSM\nKSM  KSM\nKSM  KSM\nKSM  KSM\n\n«k x  9.0 kir» 0 0 2 2\n"),
    (150, "0 0 180\n9\n\nKSM  KSM\nKSM  KSM\nKSM  KSM\nKSM  KSM\n\nK X  9.0 KIR 0 0 2 2 «P» 4.0\n"),
    (151, "0 0 180\n9\n\nKSM  KSM\nKSM  KSM\nKSM  KSM\nKSM  KSM\n\nK X  9.0 KIR 0 0 2 2 «M2.5»\n"),
    (109, "0 0 180\n9\n\nKSM  KSM\nKSM  KSM\nKSM  KSM\nKSM  KSM\n\n«roofs» auto\n"),
];

/// A file of houses, and the places of the mistakes in it with their codes.
fn file(houses: &[(u16, &str)], between: &str) -> (String, Vec<(u16, usize, usize)>) {
    let (mut text, mut places) = (String::new(), vec![]);
    for round in 0..MANY {
        let (code, house) = houses[round % houses.len()];
        if round > 0 {
            text.push_str(between);
        }
        let house = house.replace('*', WALLS);
        let (before, rest) = house.split_once('«').expect("the mistake is marked");
        let (mistake, after) = rest.split_once('»').expect("to its end");
        text.push_str(before);
        places.push((code, text.len(), text.len() + mistake.len()));
        text.push_str(mistake);
        text.push_str(after);
    }
    (text, places)
}

/// Compares what is said of a file with what should be.
fn findings(name: &str, text: &str, places: &[(u16, usize, usize)]) -> Vec<String> {
    let run = compile(name, text.as_bytes());
    let quote = |start: usize, end: usize| {
        let line = text[..start].rfind('\n').map_or(0, |i| i + 1);
        let end_of_line = text[start..].find('\n').map_or(text.len(), |i| start + i);
        format!("{:?} in {:?}", &text[start..end], &text[line..end_of_line])
    };
    let mut left: BTreeMap<(u16, usize, usize), usize> = BTreeMap::new();
    for place in places {
        *left.entry(*place).or_default() += 1;
    }
    let mut wrong = vec![];
    // All the houses stand in one place.
    for d in run.diagnostics.iter().filter(|d| d.code.0 != 420) {
        let (start, end) = (
            d.span().unwrap().start as usize,
            d.span().unwrap().end as usize,
        );
        match left.get_mut(&(d.code.0, start, end)).filter(|n| **n > 0) {
            Some(count) => *count -= 1,
            None => wrong.push(format!(
                "more: {} {} at {}",
                d.code,
                d.message.en(),
                quote(start, end)
            )),
        }
        if d.help.is_empty() {
            wrong.push(format!("without help: {} {}", d.code, d.message.en()));
        }
    }
    let missing = left.iter().filter(|(_, n)| **n > 0);
    wrong.extend(
        missing
            .map(|((code, start, end), _)| format!("missing: {code} at {}", quote(*start, *end))),
    );
    wrong.truncate(60);
    wrong
}

#[test]
fn two_hundred_mistakes_in_xml_show_two_hundred_messages() {
    let (houses, mut places) = file(XML, "\n");
    let head = "<Houses>\n";
    for place in &mut places {
        *place = (place.0, place.1 + head.len(), place.2 + head.len());
    }
    let text = format!("{head}{houses}\n</Houses>\n");
    assert_none(&findings("mistakes.hsd", &text, &places));
}

#[test]
fn two_hundred_mistakes_in_legacy_text_show_two_hundred_messages() {
    let (text, places) = file(LEGACY, "%\n");
    assert_none(&findings("mistakes.hsd", &text, &places));
}
