//! Draws stay what they are, whatever is computed elsewhere.

use super::{Texts, options};
use hsd::diagnostic::Diagnostics;
use hsd::program::{Content, Program};
use hsd::source::{FileId, Source};

fn program(text: &str, parameters: &[(&str, &str)]) -> Program {
    let source = Source::new(FileId(0), "test.hsd", text.as_bytes());
    let (world, options, mut out) = (Texts::default(), options(parameters), Diagnostics::new());
    let read = hsd::driver::documents(&[&source], &world, &options, &mut out);
    let documents = &read.documents;
    let program = hsd::driver::program(
        &[&source],
        documents,
        &read.catalog,
        &world,
        &options.expand,
        &mut out,
    );
    assert!(!out.has_errors(), "{out:#?}");
    program
}

/// What stands in a row of the ground floor of the first house.
fn drawn(program: &Program, storey: usize, row: usize) -> Vec<Content> {
    let line = &program.houses[0].storeys[storey].loops[0].lines[row];
    line.units.iter().map(|u| u.content.clone()).collect()
}

const ROW: &str = "<Row><repeat num='30'><random code='GSI, GIT, GKO, GSA'/></repeat></Row>";

#[test]
fn names_and_parameters_elsewhere_change_no_draw() {
    let plain = program(
        &format!("<House name='a'><Storey>{ROW}<Row>APW  APW</Row></Storey></House>"),
        &[],
    );
    let text = format!(
        "<House name='a'><Param name='depth' default='2'/><let name='x' value='{{depth * 3}}'/>\
         <define name='front'>{ROW}</define>\
         <Storey><use name='front'/><let name='y' value='1'/>\
         <Row><repeat num='{{depth}}'>APW</repeat></Row></Storey></House>"
    );
    let wanted = drawn(&plain, 0, 0);
    assert!(wanted.iter().any(|c| *c != wanted[0]), "nothing was drawn");
    for depth in ["2", "7"] {
        let other = program(&text, &[("depth", depth)]);
        assert_eq!(drawn(&other, 0, 0), wanted);
    }
}

#[test]
fn a_repetition_written_out_draws_as_before() {
    let storey = |height: &str| {
        let text = format!(
            "<House name='a'><Storey>{ROW}</Storey><repeat num='4'>\
             <Storey height='{height}'>{ROW}</Storey><random code='GSI, TOD' weights='1 2'/>\
             </repeat></House>"
        );
        let program = program(&text, &[]);
        (0..5).map(|s| drawn(&program, s, 0)).collect::<Vec<_>>()
    };
    let (kept, written_out) = (storey("8"), storey("{8 + k / 10}"));
    assert_ne!(kept[1], kept[2]);
    assert_eq!(kept, written_out);
}
