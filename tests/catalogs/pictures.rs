//! Textures of own parts, and variants of pictures.

use crate::catalogs::*;

#[test]
fn a_texture_shows_on_the_part() {
    let head = "<PartDef code='board' base='KSK' from='6' to='8' texture='SIGN' depth='120'/>";
    let files = Files::default()
        .with("a.hsd", &xml(head, "board"))
        .pictured(&["SIGN"]);
    let made = clean(&files, &["a.hsd"], &[]);
    assert_eq!(units(&made, 0)[0].picture, Some(PictureId(0)));
    assert_eq!(made.scene.pictures, ["SIGN"]);
    let mesh = made
        .scene
        .meshes
        .iter()
        .find(|m| m.name == "board")
        .unwrap();
    let shown = mesh.primitives.iter().find(|p| {
        made.scene.materials[p.material.0 as usize].image == hsd::scene::Image::Picture(0)
    });
    let shown = shown.unwrap();
    // 120 mm before the wall's centre line, six to eight shaku above the floor, between the posts.
    assert!(
        shown.positions.iter().all(|p| (p[1] + 0.120).abs() < 1e-6),
        "{:?}",
        shown.positions
    );
    let z: Vec<f32> = shown.positions.iter().map(|p| p[2]).collect();
    assert!(
        (z[0] - 1.818).abs() < 1e-3 && (z[2] - 2.424).abs() < 1e-3,
        "{z:?}"
    );
    let (_, list) = run(
        &Files::default().with("a.hsd", &xml(head, "board")),
        &["a.hsd"],
        &[],
    );
    assert_eq!(list[0].code.0, 604);
}

/// Which variant each picture of a house shows, by the names of their files.
fn variants(files: &Files, text: &str) -> Vec<String> {
    let files = Files {
        texts: BTreeMap::from([("a.hsd".to_owned(), text.to_owned())]),
        pictures: files.pictures.clone(),
    };
    let made = clean(&files, &["a.hsd"], &[]);
    let building = &made.building;
    let walls = building.houses[0]
        .house
        .storeys
        .iter()
        .flat_map(|s| &s.rings)
        .flat_map(|r| &r.walls);
    let shown = walls
        .flat_map(|w| &w.units)
        .filter_map(|u| match u.content {
            Content::Picture(id) => Some(id),
            _ => u.picture,
        });
    shown
        .map(|id| building.images[id.0 as usize].path.clone())
        .collect()
}

fn pictured_house(seed: u32, back: &str, upper: &str) -> String {
    let row = |text: &str| format!("<Row>{text}</Row>");
    let wall = "KSK  ".repeat(12);
    format!(
        "<House name='h' seed='{seed}'><Storey>{}{}{}{}</Storey><Storey>{}{}{}{}</Storey></House>",
        row("<repeat num='12'><Part code='BRICK'/></repeat>"),
        row(&wall),
        row(back),
        row(&wall),
        row(upper),
        row(&wall),
        row(&wall),
        row(&wall),
    )
}

#[test]
fn variants_are_drawn_for_each_place_and_survive_edits() {
    let wall = "KSK  ".repeat(12);
    let files = Files::default().pictured(&["BRICK", "BRICK.1", "BRICK.2"]);
    let plain = variants(&files, &pictured_house(1, &wall, &wall));
    assert_eq!(plain.len(), 12);
    let kinds: BTreeSet<&String> = plain.iter().collect();
    assert_eq!(kinds.len(), 3, "{plain:?}");
    // Edits of other walls, of other storeys, and of a part in the same row change nothing.
    let other = format!("<Part code='BRICK'/>{}", "GSI  ".repeat(11));
    let edited = variants(&files, &pictured_house(1, &other, &other));
    assert_eq!(edited[..12], plain[..]);
    let text = pictured_house(1, &wall, &wall);
    let text = text.replacen(
        "num='12'><Part code='BRICK'/>",
        "num='5'><Part code='BRICK'/>",
        1,
    );
    let text = text.replacen(
        "</repeat>",
        "</repeat>KSK  <repeat num='6'><Part code='BRICK'/></repeat>",
        1,
    );
    let edited = variants(&files, &text);
    assert_eq!(edited[..5], plain[..5]);
    assert_eq!(edited[5..], plain[6..]);
    // Another seed is another house.
    assert_ne!(variants(&files, &pictured_house(2, &wall, &wall)), plain);
    // A variant more takes places from the others, and changes no other place.
    let more = Files::default().pictured(&["BRICK", "BRICK.1", "BRICK.2", "BRICK.3"]);
    let drawn = variants(&more, &pictured_house(1, &wall, &wall));
    let moved = drawn.iter().zip(&plain).filter(|(a, b)| a != b);
    assert!(
        moved.clone().count() > 0 && moved.clone().all(|(a, _)| a == "BRICK.3"),
        "{drawn:?}"
    );
}

#[test]
fn variants_need_no_bare_name_and_end_at_a_gap() {
    let wall = "KSK  ".repeat(12);
    let files = Files::default().pictured(&["BRICK.1", "BRICK.2", "BRICK.4"]);
    let drawn: BTreeSet<String> = variants(&files, &pictured_house(1, &wall, &wall))
        .into_iter()
        .collect();
    assert_eq!(
        drawn,
        BTreeSet::from(["BRICK.1".to_owned(), "BRICK.2".to_owned()])
    );
}

#[test]
fn own_parts_draw_variants_too() {
    let wall = "KSK  ".repeat(12);
    let files = Files::default().pictured(&["CLOTH.1", "CLOTH.2"]);
    let text = pictured_house(1, &wall, &wall).replace(
        "<Storey>",
        "<PartDef code='BRICK' base='KSK' texture='CLOTH'/><Storey>",
    );
    let text = text.replacen(
        "</Storey><PartDef code='BRICK' base='KSK' texture='CLOTH'/>",
        "</Storey>",
        1,
    );
    let drawn = variants(&files, &text);
    assert_eq!(drawn.len(), 12);
    assert!(drawn.contains(&"CLOTH.1".to_owned()) && drawn.contains(&"CLOTH.2".to_owned()));
}

#[test]
fn a_texture_may_name_its_file() {
    let head = "<Texture texturecode='stone, KTU' src='photos/stone.png'/>";
    let text = xml(head, "stone").replacen("<Row>KSK  KSK</Row>", "<Row>KTU  KSK</Row>", 1);
    // `photos/stone.1.png` is another picture: a file is named as it is.
    let files = Files::default()
        .with("f/a.hsd", &text)
        .pictured(&["f/photos/stone.png", "f/photos/stone.1.png"]);
    let made = clean(&files, &["f/a.hsd"], &[]);
    assert_eq!(made.scene.pictures, ["f/photos/stone.png"]);
    // It wins over a part of the catalogue, and counts in its house only.
    let pictures = units(&made, 0)
        .into_iter()
        .filter(|u| matches!(u.content, Content::Picture(_)));
    assert_eq!(pictures.count(), 2);
    let other = xml("", "KTU").replacen("<House", "<House x='30'", 1);
    let both = format!("<Houses>{text}{other}</Houses>");
    let files = files.with("f/a.hsd", &both);
    let made = clean(&files, &["f/a.hsd"], &[]);
    assert!(matches!(units(&made, 1)[0].content, Content::Part(_)));
    let (_, list) = run(&Files::default().with("f/a.hsd", &text), &["f/a.hsd"], &[]);
    assert!(list.iter().any(|d| d.code.0 == 243), "{list:?}");
}
