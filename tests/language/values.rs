//! What expressions come to, where they may stand, and what is said of them.

use super::{Texts, clean, codes, faults_of, read, read_in, row_of, rows, storeys};
use crate::support::Words;

#[test]
fn every_attribute_takes_an_expression() {
    let document = clean(
        "<House unit='{3 + 0.25}' street='{2 > 1}' name='shop {1 + 1}'>\
         <let name='h' value='{9 * 2}'/><let name='code' value='KSK'/>\
         <Storey height='{h / 2}' start='{1} {h - 16}'>\
         <Row turn='{if_left}'/></Storey>\
         <Roofs kind='{k_}' pitch='{min(4.5, h)}' noshi='{3}'/></House>"
            .replace("'{if_left}'", "'L'")
            .replace("{k_}", "K")
            .as_str(),
    );
    let house = &document.houses[0];
    assert_eq!(house.settings.unit.as_ref().unwrap().value, 3.25);
    assert!(house.settings.street.as_ref().unwrap().value);
    assert_eq!(house.name.as_ref().unwrap().value, "shop 2");
    let storey = storeys(&document)[0];
    assert_eq!(storey.height.as_ref().unwrap().value, 9.0);
    assert_eq!(storey.start.as_ref().unwrap().value, (1.0, 2.0));
    assert_eq!(house.roofs.style.pitch.as_ref().unwrap().value, 4.5);
    assert_eq!(house.roofs.style.noshi.as_ref().unwrap().value, 3);
}

#[test]
fn a_value_among_codes_is_a_run_of_its_own() {
    let lets = "<let name='door' value='TOD'/><let name='w' value='GDE 2'/>";
    assert_eq!(row_of(lets, "GSI  {door}KSK"), ["GSI", "TOD", "KSK"]);
    assert_eq!(row_of(lets, "{w}{door}{w}"), ["GDE 2", "TOD", "GDE 2"]);
    assert_eq!(row_of(lets, "{w} {door}"), ["GDE 2", "TOD"]);
    assert_eq!(
        row_of(lets, "\n  {'GSI  GSI'}\n  KSK\n"),
        ["GSI", "GSI", "KSK"]
    );
    assert_eq!(row_of(lets, "&#123;door&#x7d;"), ["TOD"]);
    assert_eq!(row_of("", "<Part code='{\"GDE \" + \"2\"}'/>"), ["GDE 2"]);
}

#[test]
fn conditions_choose_and_give_names() {
    let choose = |n: u32| {
        let lets = format!(
            "<let name='n' value='{n}'/>\
             <if test='{{n = 1}}'><let name='code' value='KSK'/></if>\
             <else test='{{n = 2}}'><let name='code' value='GSI'/></else> <!-- or -->\
             <else><let name='code' value='TOD'/></else>"
        );
        row_of(&lets, "{code}<if test='{n > 1}'>AKI</if>")
    };
    assert_eq!(choose(1), ["KSK"]);
    assert_eq!(choose(2), ["GSI", "AKI"]);
    assert_eq!(choose(3), ["TOD", "AKI"]);
}

#[test]
fn pieces_take_parameters_and_know_their_own_place() {
    let bay = "<let name='code' value='KSK'/>\
        <define name='bay' n='2' last='{code}'><repeat num='{n}'>GSI</repeat>{last}</define>";
    assert_eq!(row_of(bay, "<use name='bay'/>"), ["GSI", "GSI", "KSK"]);
    let inner = "<let name='code' value='AKI'/><use name='bay' n='{1}'/>{code}";
    assert_eq!(row_of(bay, inner), ["GSI", "KSK", "AKI"]);
    let typed = "<define name='p'><Param name='n' default='1' min='1' max='3'/>\
        <repeat num='{n}'>KSK</repeat></define>";
    assert_eq!(row_of(typed, "<use name='p' n='3'/>").len(), 3);
    assert_eq!(
        faults_of(typed, "<use name='p' n='4'/>"),
        [(259, "4".into())]
    );
    // A piece may come before its definition, and hold storeys and houses.
    let document = clean(
        "<Houses><use name='type' w='2'/><use name='type' w='3'/>\
         <define name='type' w=''><House><Storey><Row><repeat num='{w}'>KSK</repeat></Row></Storey>\
         </House></define></Houses>",
    );
    assert_eq!(document.houses.len(), 2);
    assert_eq!(storeys(&document).len(), 1);
}

#[test]
fn storeys_are_counted_over_repetitions_without_parapets() {
    let document = clean(
        "<House><Storey height='{10 + k}'><Row>KSK</Row></Storey>\
         <repeat num='2'><Storey><Row>KSK</Row></Storey></repeat>\
         <repeat num='3'><Storey height='{10 + k}'><Row>{'F' + 'L'}{k}</Row></Storey></repeat>\
         <Storey kind='parapet' height='{k}'><Row>KSK</Row></Storey></House>",
    );
    let heights = storeys(&document)
        .into_iter()
        .map(|s| s.height.map_or(0.0, |h| h.value));
    let heights: Vec<f64> = heights.collect();
    assert_eq!(heights, [11.0, 0.0, 0.0, 14.0, 15.0, 16.0, 6.0]);
    assert_eq!(codes(rows(storeys(&document)[4])[0]), ["FL", "5"]);
    // Without `k` a repetition stays one.
    assert_eq!(document.houses[0].storeys.len(), 6);
}

#[test]
fn floors_are_counted_facade_by_facade() {
    let document = clean(
        "<Structure><Facades><repeat num='2'><Facade>\
         <Floor id='{k}'/><repeat num='2'><Floor id='f{k}'/></repeat><Floor id='k'/>\
         </Facade></repeat></Facades></Structure>",
    );
    let facades = &document.houses[0].structures[0].facades;
    let hsd::ast::Item::Repeat(repeat) = &facades[0] else {
        panic!("no repetition")
    };
    let facade = super::ones(&repeat.body)[0];
    let ids = super::ones(&facade.floors).into_iter();
    let ids: Vec<&str> = ids.map(|f| &*f.id.as_ref().unwrap().value).collect();
    assert_eq!(ids, ["1", "f2", "f3", "k"]);
}

#[test]
fn faults_are_marked_inside_the_braces() {
    let lets = "<let name='depth' value='8'/>";
    let said = |row: &str| faults_of(lets, row);
    let one = |code: u16, marked: &str| vec![(code, marked.to_owned())];
    assert_eq!(
        said("<repeat num='{1 + dpeth}'>KSK</repeat>"),
        one(252, "dpeth")
    );
    assert_eq!(said("<repeat num='{1 +}'>KSK</repeat>"), one(229, "}"));
    assert_eq!(
        said("<repeat num='{depth * \"2\"}'>KSK</repeat>"),
        one(253, "\"2\"")
    );
    assert_eq!(
        said("<repeat num='{depth / (4 - 4)}'>KSK</repeat>"),
        one(254, "(4 - 4)")
    );
    assert_eq!(said("<repeat num='{}'>KSK</repeat>"), one(250, "{}"));
    assert_eq!(said("<repeat num='{depth'>KSK</repeat>"), one(251, "{"));
    assert_eq!(
        said("<repeat num='&#123;dept}'>KSK</repeat>"),
        one(252, "dept")
    );
    // Out of an attribute's range: the value computed is named.
    let done = read(&format!(
        "<House>{lets}<Storey><Row turn='{{depth * 100}}'>KSK</Row></Storey></House>"
    ));
    assert_eq!(done.faults(), one(226, "{depth * 100}"));
    assert!(
        done.list[0].message.en().contains("`800`"),
        "{:?}",
        done.list[0]
    );
    // What failed is said once, and nothing follows from it.
    assert_eq!(
        faults_of("<let name='a' value='{1 / 0}'/>", "{a}{a}").len(),
        1
    );
    assert_eq!(said("{k}{k + 'a'}").len(), 1);
}

#[test]
fn parameters_are_set_checked_and_listed() {
    let text = "<House><Param name='w' default='4' min='3' max='9' step='1' unit='units' doc='width'/>\
        <Param name='half' default='{w / 2}'/><Param name='door' default='TOD'/>\
        <Storey><Row><repeat num='{w}'>KSK</repeat>{door}</Row></Storey></House>";
    let none = Texts::default();
    let parts = |set: &[(&str, &str)]| {
        let done = read_in(&none, text, set);
        assert!(done.list.is_empty(), "{:#?}", done.list);
        codes(rows(storeys(&done.document)[0])[0]).len()
    };
    assert_eq!(parts(&[]), 5);
    assert_eq!(parts(&[("w", "4"), ("w", "6")]), 7);
    assert_eq!(parts(&[("door", "5")]), 5);
    let done = read_in(&none, text, &[("w", "6")]);
    let half = &done.document.parameters[1];
    assert_eq!(half.default, Some(hsd::ast::Value::Number(3.0)));
    for wrong in ["10", "4.5", "wide", "yes", ""] {
        let done = read_in(&none, text, &[("w", wrong)]);
        assert_eq!(done.list.len(), 1, "{wrong}: {:#?}", done.list);
        assert_eq!(done.list[0].code.0, 259);
        assert!(done.list[0].help.en().contains("from 3 to 9 in steps of 1"));
    }
    let done = read_in(&none, text, &[("wd", "10"), ("half", "1")]);
    let codes: Vec<u16> = done.list.iter().map(|d| d.code.0).collect();
    assert_eq!(codes, [260]);
    assert!(
        done.list[0].help.en().contains("`half`"),
        "{:#?}",
        done.list
    );
}
