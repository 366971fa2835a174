//! Options of formats: printed models, merged houses.

use super::{code, folder, hsd, stderr};
use std::fs;

#[test]
fn thin_bodies_are_told_at_the_scale_of_the_print() {
    let folder = folder();
    let folder = folder.path();
    let house = "0 0\n9\n\n".to_owned() + &"GIT  KSK  \n".repeat(4);
    fs::write(folder.join("lattice.hsd"), house).unwrap();
    let build = |more: &[&str]| {
        let all = [&["build", "lattice.hsd", "-o", "a.stl", "-q"][..], more].concat();
        let output = hsd(folder, &all);
        (code(&output), stderr(&output))
    };
    assert_eq!(build(&[]), (0, String::new()));
    let (done, told) = build(&["--scale", "1:100"]);
    assert!(done == 0 && told.contains("HSD0606"), "{told}");
    assert!(told.contains("thinner than 0.4 mm"), "{told}");
    assert_eq!(build(&["--scale", "1/100", "-D", "warnings"]).0, 1);
    assert_eq!(
        build(&["--scale", "1:100", "--min-wall", "0"]),
        (0, String::new())
    );
    let (_, told) = build(&["--scale", "1:100", "--variants", "2"]);
    assert!(told.contains("HSD0606"), "{told}");
    assert!(build(&["--scale", "100"]).1.contains("1:100 or 1/100"));
}

#[test]
fn options_belong_to_their_formats() {
    let folder = folder();
    for (output, option) in [
        ("a.glb", &["--scale", "1:100"][..]),
        ("a.obj", &["--min-wall", "1"]),
        ("a.stl", &["--merge", "material"]),
        ("a.obj", &["--no-tangents"]),
        ("a.stl", &["--quantize"]),
    ] {
        let all = [&["build", "sound.hsd", "-o", output][..], option].concat();
        let output = hsd(folder.path(), &all);
        assert_eq!(code(&output), 2, "{option:?}");
    }
    for output in ["a.glb", "a.gltf"] {
        let all = [
            "build",
            "sound.hsd",
            "-o",
            output,
            "--merge",
            "material",
            "--no-tangents",
        ];
        assert_eq!(code(&hsd(folder.path(), &all)), 0);
    }
}

#[test]
fn quantized_models_have_directions_as_bytes() {
    let folder = folder();
    let build = |name: &str, more: &[&str]| {
        let all = [&["build", "sound.hsd", "-o", name, "-q"][..], more].concat();
        assert_eq!(code(&hsd(folder.path(), &all)), 0);
        fs::read(folder.path().join(name)).unwrap()
    };
    let json = |glb: &[u8]| -> serde_json::Value {
        let length = u32::from_le_bytes(glb[12..16].try_into().unwrap()) as usize;
        serde_json::from_slice(&glb[20..20 + length]).unwrap()
    };
    let (plain, small) = (build("a.glb", &[]), build("b.glb", &["--quantize"]));
    assert!(small.len() < plain.len());
    let (plain, small) = (json(&plain), json(&small));
    assert_eq!(
        small["extensionsRequired"],
        serde_json::json!(["KHR_mesh_quantization"])
    );
    assert!(plain["extensionsRequired"].is_null());
    for mesh in small["meshes"].as_array().unwrap() {
        for primitive in mesh["primitives"].as_array().unwrap() {
            for (name, number) in primitive["attributes"].as_object().unwrap() {
                let accessor = &small["accessors"][number.as_u64().unwrap() as usize];
                let bytes = matches!(&**name, "NORMAL" | "TANGENT");
                let kind = if bytes { 5120 } else { 5126 };
                assert_eq!(accessor["componentType"], kind, "{name}");
                assert_eq!(accessor["normalized"] == true, bytes, "{name}");
            }
        }
    }
}
