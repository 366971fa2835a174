//! Messages about part pictures and shapes that no text alone can trigger: they need a file that is broken.

use crate::support::png;
use hsd::Options;
use hsd::diagnostic::Diagnostics;
use hsd::driver::{self, Compiled};
use hsd::source::{FileId, Limits, PictureFile, Source, World};

/// A world where every name is a picture with the same content, and none has variants.
struct Everywhere(Option<Vec<u8>>);

impl World for Everywhere {
    fn picture(&self, name: &str) -> Option<PictureFile> {
        let path = format!("{name}.png");
        let size = (2, 2);
        (!name.contains('.')).then_some(PictureFile { path, size })
    }

    fn picture_bytes(&self, path: &str) -> std::io::Result<Vec<u8>> {
        let lost = || std::io::Error::new(std::io::ErrorKind::NotFound, path);
        self.0.clone().ok_or_else(lost)
    }
}

const HOUSE: &[u8] =
    b"<House><Storey><Row><Part code=\"shop front\"/></Row><Row><Part code=\"shop front\"/></Row>\
    <Row><Part code=\"shop front\"/></Row><Row><Part code=\"shop front\"/></Row></Storey></House>";

/// The text that a message about the pictures of a house points at, with its code.
fn told(content: Option<Vec<u8>>, pixels: u64) -> Vec<(u16, String)> {
    let (world, mut out) = (Everywhere(content), Diagnostics::new());
    let source = Source::new(FileId(0), "shop.hsd", HOUSE);
    let made = hsd::compile(&[&source], &world, &Options::default(), &mut out);
    let limits = Limits {
        pixels,
        ..Limits::default()
    };
    let building = &made.building;
    driver::pictures(&made.scene.pictures, building, &world, &limits, &mut out);
    let place = |span| source.text()[source.text_range(span)].to_owned();
    let said = out.iter();
    said.map(|d| (d.code.0, place(d.span().unwrap()))).collect()
}

#[test]
fn a_sound_picture_is_taken_in_silence() {
    assert_eq!(told(Some(png(2, 2)), 4), []);
}

#[test]
fn broken_pictures_are_told_where_they_are_called_for() {
    let at = |code| vec![(code, "shop front".to_owned())];
    assert_eq!(told(None, 4), at(601));
    assert_eq!(told(Some(b"GIF89a".to_vec()), 4), at(602));
    assert_eq!(told(Some(png(3, 2)), 5), at(905));
}

#[test]
fn a_broken_shape_is_told_and_left_out() {
    let mut out = Diagnostics::new();
    let house = b"0 0\n9\n\nKSK  \nKSK  \nKSK  \nKSK  \n";
    let source = Source::new(FileId(0), "house.hsd", house);
    let mut made: Compiled =
        hsd::compile(&[&source], &Everywhere(None), &Options::default(), &mut out);
    driver::flaws(&made, &mut out);
    assert_eq!(out.iter().count(), 0);
    made.scene.meshes[0].primitives[0].positions[0][0] = f32::NAN;
    driver::flaws(&made, &mut out);
    // Once for each place that shows it.
    assert!(out.iter().count() > 0 && out.iter().all(|d| d.code.0 == 603));
}
