//! Strokes of the drawing tool.

mod bench;
mod doubts;
mod ground;
mod odd;
mod parts;
mod fixtures;
mod rooms;
mod storeys;
mod walls;

use crate::ide::analysis;
use hsd::diagnostic::Language;
use hsd::ide::plan::Plan;
use hsd::ide::stroke::{Storeys, Stroke, UnitAt, WallAt};

#[test]
fn strokes_are_read_as_the_page_writes_them() {
    let read = |json: &str| serde_json::from_str::<Stroke>(json).unwrap();
    let wall = WallAt {
        house: 0,
        storey: 1,
        ring: 0,
        wall: 2,
    };
    assert_eq!(
        read(r#"{"do":"set-part","house":0,"storey":1,"ring":0,"wall":2,"unit":3,"part":"KSK"}"#),
        Stroke::SetPart {
            unit: UnitAt::Place { wall, unit: 3 },
            part: "KSK".into()
        }
    );
    assert_eq!(
        read(r#"{"do":"set-part","span":[120,125],"part":"看板"}"#),
        Stroke::SetPart {
            unit: UnitAt::Span { span: [120, 125] },
            part: "看板".into()
        }
    );
    assert_eq!(
        read(
            r#"{"do":"move-wall","house":0,"storey":1,"ring":0,"wall":2,"by":-1,"storeys":"all"}"#
        ),
        Stroke::MoveWall {
            wall,
            by: -1,
            storeys: Storeys::All
        }
    );
    assert_eq!(
        read(r#"{"do":"draw-house","outline":[[0,0],[6,0],[6,8],[0,8.5]]}"#),
        Stroke::DrawHouse {
            outline: vec![[0.0, 0.0], [6.0, 0.0], [6.0, 8.0], [0.0, 8.5]],
            height: None,
            house: None
        }
    );
    assert!(serde_json::from_str::<Stroke>(r#"{"do":"move-wall","house":0}"#).is_err());
}

#[test]
fn a_plan_is_written_as_the_page_reads_it() {
    let a = analysis("a.hsd", include_str!("../../examples/machiya.hsd"), &[]);
    let plan = serde_json::to_value(Plan::of(&a, Language::English)).unwrap();
    let house = &plan["houses"][0];
    assert_eq!(house["name"], "machiya");
    assert_eq!(house["storeys"][1]["height"], 5);
    let wall = &house["storeys"][0]["rings"][0]["walls"][0];
    assert_eq!(wall["to"], serde_json::json!([6, 0]));
    let door = &wall["units"][2];
    let span: [usize; 2] = serde_json::from_value(door["span"].clone()).unwrap();
    assert_eq!(&a.text()[span[0]..span[1]], "GDE 2");
    assert_eq!(
        (&door["code"], &door["part"]),
        (&"GDE 2".into(), &"lattice".into())
    );
    assert_eq!(door["from"], serde_json::json!([2, 0]));
    let roofs = house["roofs"].as_array().unwrap();
    let gable = roofs.iter().find(|r| r["shape"] == "KIR").unwrap();
    // G0.5: half a shaku beyond the gable walls.
    let ends = serde_json::json!([[6.166667, 4], [-0.166667, 4]]);
    assert_eq!(gable["ridge"], ends);
}
