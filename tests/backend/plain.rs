//! OBJ and STL.

use super::*;

#[test]
fn obj_has_the_axes_of_the_paper() {
    let (scene, images) = (scene(), Pictures::new());
    let files = obj::obj(&scene, &images, "my house");
    let text = |name: &str| {
        let file = files.iter().find(|f| f.name == name).unwrap();
        String::from_utf8(file.bytes.to_vec()).unwrap()
    };
    let obj = text("my_house.obj");
    assert!(obj.contains("\nmtllib my_house.mtl\n"));
    assert!(obj.contains("\no 町家/storey_1/facade_1/GDE_2\n"));
    // The second door's lower left corner: 4 m along the house's x, which the quarter turn makes north.
    assert!(obj.contains("\nv 100 3.5 -204\n"), "{obj}");
    assert!(obj.contains("\nvt 1 2\n"), "v upwards, repeats of 2 m");
    assert!(
        obj.contains("\nusemtl cedar\nf 1/1/1 2/2/1 3/3/1\nf 1/1/1 3/3/1 4/4/1\n"),
        "{obj}"
    );
    assert!(
        obj.contains("\nusemtl glass\nf 1//1 5//1 6//1\n"),
        "shared corner, no coordinates: {obj}"
    );
    let mtl = text("my_house.mtl");
    assert!(mtl.contains(
        "newmtl cedar\nKa 0.625 0.625 0.625\nKd 1 1 1\nKs 0.5 0.5 0.5\nNs 1\nd 1\nPr 1\n"
    ));
    assert!(mtl.contains("map_Kd my_house_textures/cedar_color.jpg\n"));
    assert!(mtl.contains("map_Kd my_house_textures/看板_1.png\n"));
    assert!(mtl.contains("newmtl glass") && mtl.contains("d 0.25\n") && !mtl.contains("unused"));
    assert!(
        files
            .iter()
            .any(|f| f.name == "my_house_textures/看板_1.png")
    );
}

/// Most programs ignore a factor beside an image, so a tint is multiplied into it, in linear light.
#[test]
fn obj_tints_are_in_the_images() {
    let (mut scene, images) = (scene(), Pictures::new());
    // 0.25 in linear light is 137 of 255 on a screen; the sign's image is (128, 128, 255).
    scene.materials[2].tint = [0.25, 1.0, 0.25, 1.0];
    scene.materials[0].roughness = 0.5;
    let files = obj::obj(&scene, &images, "a");
    let bytes = |name: &str| {
        let file = files.iter().find(|f| f.name == name);
        &file.unwrap_or_else(|| panic!("{name}")).bytes
    };
    let tinted = image::load_from_memory(bytes("a_textures/看板_1_89ff89.png")).unwrap();
    let [r, g, b] = tinted.into_rgb8().get_pixel(0, 0).0;
    let near = |x: u8, expected: u8| x.abs_diff(expected) <= 1;
    assert!(near(r, 66) && g == 128 && near(b, 137), "{r} {g} {b}");
    let rough = image::load_from_memory(bytes("a_textures/cedar_orm_roughness_50.png")).unwrap();
    assert_eq!(rough.into_luma8().get_pixel(0, 0).0, [64]);
    let mtl = String::from_utf8(bytes("a.mtl").to_vec()).unwrap();
    let sign = &mtl[mtl.find("newmtl sign").unwrap()..];
    assert!(
        sign.contains("\nKd 1 1 1\n") && sign.contains("map_Kd a_textures/看板_1_89ff89.png\n")
    );
    assert!(
        mtl.contains("norm a_textures/cedar_normal.jpg\n") && mtl.contains("map_Pr a_textures/")
    );
    assert!(
        !mtl.contains("map_Pm"),
        "blue is full, but the factor is 0: {mtl}"
    );
    let obj = String::from_utf8(bytes("a.obj").to_vec()).unwrap();
    let mut names: Vec<&str> = obj.lines().filter(|l| l.starts_with("o ")).collect();
    let all = names.len();
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), all, "two doors of one name: {names:?}");
}

#[test]
fn stl_is_in_millimetres() {
    let stl = stl::stl(&scene(), stl::Print::default());
    assert_eq!(&stl[..4], b"hsd ");
    let count = u32::from_le_bytes(stl[80..84].try_into().unwrap()) as usize;
    // Six panes of two triangles get a back, and edges of two triangles on each of four sides.
    assert_eq!((count, stl.len()), (6 * 12, 84 + 6 * 12 * 50));
    let float = |at: usize| f32::from_le_bytes(stl[at..at + 4].try_into().unwrap());
    let triangle: Vec<f32> = (0..12).map(|k| float(84 + 4 * k)).collect();
    // The front faces east after the quarter turn, 60 mm before its back; the first door begins 1 m along it, 0.5 m up.
    assert_eq!(triangle[..6], [1.0, 0.0, 0.0, 60.0, 1000.0, 500.0]);
}
