//! Packed tiles of a town have the shapes of plain ones.

use super::{Array, Model, houses};
use glam::DVec3;
use hsd::backend::gltf::{FeatureRow, Ktx2, TileWriter, graphics_bytes};
use hsd::backend::images::Library;
use hsd::backend::{Images, NoImages};

/// A row of the table of features.
fn row() -> FeatureRow {
    FeatureRow {
        key: "a".into(),
        layer: "houses".into(),
        kind: "machiya".into(),
        year: String::new(),
        evidence: String::new(),
        parameters: String::new(),
        rule: 0,
        line: 1,
    }
}

/// A tile with two machiya.
fn tile(packed: bool) -> (TileContentBytes, Model) {
    let scene = houses([(0.0, 0.0, 180.0), (12.0, 3.0, 150.0)]);
    let mut writer = TileWriter::packed(scene.detail, DVec3::new(4.0, 2.0, 0.0), packed);
    writer.add(scene.whole(), 0, &NoImages);
    let made = writer.content((&scene.materials, &[]), &NoImages, &[row()], "textures");
    let made = made.expect("something is to be seen");
    let model = Model::new(&made.glb.to_vec());
    let kept = TileContentBytes {
        bytes: made.glb.len(),
        triangles: made.triangles,
        bounds: made.bounds,
    };
    (kept, model)
}

/// What is compared of the content of a tile besides its arrays.
struct TileContentBytes {
    bytes: usize,
    triangles: usize,
    bounds: [DVec3; 2],
}

#[test]
fn packed_tiles_have_the_shapes_of_plain_ones() {
    let ((plain, one), (small, two)) = (tile(false), tile(true));
    assert_eq!(plain.triangles, small.triangles);
    assert!(
        2 * small.bytes < plain.bytes,
        "{} of {}",
        small.bytes,
        plain.bytes
    );
    let primitives = |m: &Model| {
        m.root["meshes"][0]["primitives"]
            .as_array()
            .unwrap()
            .clone()
    };
    let pairs: Vec<_> = primitives(&one).into_iter().zip(primitives(&two)).collect();
    assert_eq!(primitives(&one).len(), pairs.len());
    for (a, b) in &pairs {
        let (ia, ib) = (one.array(&a["indices"]), two.array(&b["indices"]));
        assert_eq!((ia.count, ia.component), (ib.count, ib.component));
        let corner = |array: &Array, k: usize| match array.component {
            5123 => u32::from(u16::from_le_bytes([
                array.bytes[2 * k],
                array.bytes[2 * k + 1],
            ])),
            _ => u32::from_le_bytes(array.bytes[4 * k..4 * k + 4].try_into().unwrap()),
        };
        for t in (0..ia.count).step_by(3) {
            // The codec may begin a triangle at another corner.
            let of = |array: &Array| [0, 1, 2].map(|k| corner(array, t + k));
            let (p, q) = (of(&ia), of(&ib));
            let turned = [q, [q[1], q[2], q[0]], [q[2], q[0], q[1]]];
            assert!(turned.contains(&p), "{p:?} {q:?}");
        }
    }
    let all = |m: &Model, name: &str| {
        let array = m.array(&primitives(m)[0]["attributes"][name]);
        let fours = array.bytes.as_chunks::<4>().0.iter();
        fours.map(|b| f32::from_le_bytes(*b)).collect::<Vec<f32>>()
    };
    for (name, most) in [
        ("POSITION", 1.3e-4),
        ("TEXCOORD_0", 1e-4),
        ("_FEATURE_ID_0", 0.0),
    ] {
        let (a, b) = (all(&one, name), all(&two, name));
        assert_eq!(a.len(), b.len());
        let off = a.iter().zip(&b).map(|(x, y)| (x - y).abs());
        let off = off.fold(0.0, f32::max);
        assert!(off <= most, "{name}: {off}");
    }
    let [low, high] = small.bounds;
    for p in all(&two, "POSITION").as_chunks::<3>().0 {
        // y up, from the middle of the tile.
        let at = DVec3::new(p[0].into(), (-p[2]).into(), p[1].into()) + DVec3::new(4.0, 2.0, 0.0);
        assert!(low.cmple(at).all() && at.cmple(high).all(), "{at}");
    }
}

#[test]
fn images_of_packed_tiles_stay_packed_on_the_card() {
    let scene = houses([(0.0, 0.0, 180.0), (12.0, 3.0, 150.0)]);
    let library = Library::default();
    let images = |shown: &dyn Images| -> Vec<(String, Vec<u8>)> {
        let mut writer = TileWriter::packed(scene.detail, DVec3::new(4.0, 2.0, 0.0), true);
        writer.add(scene.whole(), 0, shown);
        let made = writer.content((&scene.materials, &[]), shown, &[row()], "../textures");
        let images = made.expect("something is to be seen").textures.into_iter();
        images
            .map(|image| (image.name, image.bytes.into_owned()))
            .collect()
    };
    let plain = images(&library);
    let small = images(&Ktx2::of_tile(&scene.materials, &library, true));
    assert_eq!(
        small,
        images(&Ktx2::of_tile(&scene.materials, &library, true)),
        "once more"
    );
    assert_eq!(plain.len(), small.len());
    let mut packed = 0;
    for ((plain_name, plain), (name, bytes)) in plain.iter().zip(&small) {
        if !name.ends_with(".ktx2") {
            // Relief keeps its form.
            assert!(name.ends_with("_normal.jpg"), "{name}");
            assert_eq!((plain_name, plain), (name, bytes));
            continue;
        }
        packed += 1;
        assert_eq!(plain_name.split('.').next(), name.split('.').next());
        // A byte a pixel instead of four, with smaller levels of a third of it, rounded down.
        let off = graphics_bytes(plain).abs_diff(4 * graphics_bytes(bytes));
        assert!(off < 4, "{name}: {off}");
        assert!(graphics_bytes(bytes) > 0, "{name}");
    }
    assert!(packed > 3, "{packed} of {}", small.len());
}
