//! What makes a house believable close by: gables of their walls' finish, passages that stay inside, boards
//! under what stands out, roofs over rings of facades that close with a small error.
use crate::support::{Run, assert_none, compile, flaws};
use hsd::scene::{Mesh, Node};

fn house(text: &str) -> Run {
    let run = compile("house.hsd", text.as_bytes());
    assert_none(&flaws(&run));
    run
}

fn node<'r>(run: &'r Run, name: &str) -> &'r Node {
    run.scene.nodes.iter().find(|n| n.name == name).unwrap()
}

fn mesh<'r>(run: &'r Run, name: &str) -> &'r Mesh {
    &run.scene.meshes[node(run, name).mesh.unwrap().0 as usize]
}

/// The materials of a mesh by name.
fn materials(run: &Run, name: &str) -> Vec<String> {
    let primitives = mesh(run, name).primitives.iter();
    primitives
        .map(|p| run.scene.materials[p.material.0 as usize].name.clone())
        .collect()
}

#[test]
fn gables_are_filled_with_what_the_wall_below_is_made_of() {
    // Ridge along the front: gables left (clay, an opening in it) and right (clapboards).
    let run = house(
        "0 0\n\nGSI  GSI  GSI  GSI  GSI  GSI\nKTU  KTU  MRE  KTU\nGSI  GSI  GSI  GSI  GSI  GSI\nKSM  KSM  KSM  KSM\n",
    );
    let shown = materials(&run, "roof 1");
    assert!(shown.iter().any(|m| m == "nakanuri"), "{shown:?}");
    assert!(shown.iter().any(|m| m == "clapboard"), "{shown:?}");
    assert!(!shown.iter().any(|m| m == "plaster"), "{shown:?}");
    // Nothing but openings below: what the storey is mostly made of.
    let run = house(
        "0 0\n\nKTU  KTU  KTU  KTU  KTU  KTU\nGSI  GSI  GSI  GSI\nKTU  KTU  KTU  KTU  KTU  KTU\nGSI  GSI  GSI  GSI\n",
    );
    let shown = materials(&run, "roof 1");
    assert!(shown.iter().any(|m| m == "nakanuri"), "{shown:?}");
}

/// How far a part reaches into the house, metres.
fn depth(run: &Run, name: &str) -> f32 {
    let points = mesh(run, name).primitives.iter().flat_map(|p| &p.positions);
    points.map(|p| p[1]).fold(f32::MIN, f32::max)
}

#[test]
fn a_passage_stays_inside_a_shallow_house() {
    let with = |sides: &str| {
        house(&format!(
            "0 0\n\nKTU  ATN  KTU  KTU  KTU  KTU\n{sides}\nKTU  KTU  KTU  KTU  KTU  KTU\n{sides}\n"
        ))
    };
    let shallow = with("KTU  KTU");
    let reach = depth(&shallow, "ATN 2");
    assert!(reach < 2.0 * 0.9091 - 0.04 && reach > 1.6, "{reach}");
    let deep = with("KTU  KTU  KTU  KTU  KTU");
    let reach = depth(&deep, "ATN 2");
    assert!((reach - 3.0).abs() < 0.1, "{reach}");
}

#[test]
fn a_storey_that_stands_out_shows_its_soffit() {
    let run = house(
        "0 0\n\nKTU  KTU  KTU  KTU\nKTU  KTU  KTU\nKTU  KTU  KTU  KTU\nKTU  KTU  KTU  ^\nL\n.....\nKTU  KTU  KTU  KTU\nKTU  KTU  KTU  KTU\nKTU  KTU  KTU  KTU\nKTU  KTU  KTU  KTU\n",
    );
    assert_eq!(run.building.houses[0].roofs.soffits.len(), 1);
    let shown = materials(&run, "soffit 1");
    assert!(shown.iter().any(|m| m == "soffit"), "{shown:?}");
    assert!(shown.iter().any(|m| m == "cedar"), "{shown:?}");
}

#[test]
fn a_ring_of_facades_that_closes_nearly_gets_a_sloped_roof() {
    let facade = |ratio: &str| {
        format!(
            "<Facade ratio=\"{ratio}\" angle=\"90\"><Floor id=\"1\"><repeat num=\"5\"><Part code=\"KTU\"/></repeat></Floor></Facade>"
        )
    };
    let facades: String = ["1", "0.6", "1.008", "0.597"].map(facade).concat();
    let text = format!("<Structure size=\"100\"><Facades>{facades}</Facades></Structure>")
        .replacen(" angle=\"90\"", "", 1);
    let run = house(&text);
    assert!(!run.has_errors(), "{}", run.short());
    let plan = &run.building.houses[0].roofs.plans[0];
    assert_eq!(plan.regions.len(), 1);
    assert_eq!(plan.regions[0].shape.letters(), "KIR");
    assert_eq!(plan.regions[0].ridge, Some("a"));
}

#[test]
fn every_storey_has_a_floor_and_a_ceiling() {
    let walls = |code: &str| format!("<Row>{}</Row>", code.repeat(4)).repeat(4);
    let rooms = |text: &str| {
        let run = house(text);
        let rooms = run.scene.nodes.iter().filter(|n| n.name == "room");
        let of = |node: &Node| {
            let mesh = &run.scene.meshes[node.mesh.unwrap().0 as usize];
            let shown = mesh.primitives.iter().map(|p| p.material.0 as usize);
            let mut names: Vec<String> =
                shown.map(|m| run.scene.materials[m].name.clone()).collect();
            names.sort_unstable();
            (node.storey, names)
        };
        rooms.map(of).collect::<Vec<_>>()
    };
    let storey = format!("<Storey>{}</Storey>", walls("KSK  "));
    let both = || vec!["boards".to_owned(), "soffit".to_owned()];
    let found = rooms(&format!("<House>{storey}{storey}</House>"));
    assert_eq!(found, [(Some(1), both()), (Some(2), both())]);
    // A wall round a yard has neither.
    let yard = format!("<House><Storey>{}</Storey></House>", walls("KDB  "));
    assert_eq!(rooms(&yard), []);
}
