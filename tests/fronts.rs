//! `hsd facade`: walls out of photographs, judged by scenes that the tests draw themselves, and by photographs with measured truth
//! where they are there.

mod bars;
mod model;
pub mod scene;

use hsd::front::brush::{Stroke, painted};
use hsd::front::camera::Lens;
use hsd::front::{self, Front, Given, Lattice, Photo, exif};
use hsd::glam::{DVec2, dvec2};
use hsd::plan::flatten::{homography, project};
use hsd::plan::{Picture, Unreadable};
use image::RgbImage;
use scene::{Dice, Facade, Shot};
use std::io::Cursor;

/// The longer side of the photographs, pixels.
const LONGEST: u32 = 640;

fn photo(facade: &Facade, shot: &Shot) -> Photo {
    Photo {
        name: "scene.png".to_owned(),
        pixels: shot.draw(facade),
        focal: Some(shot.focal),
        mask: None,
        bend: None,
    }
}

fn corners(facade: &Facade, shot: &Shot) -> [DVec2; 4] {
    shot.corners(facade).map(|(x, y)| dvec2(x, y))
}

fn middle(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// A small scene, told by its corners and lattice.
fn told(facade: &Facade, shots: &[Shot]) -> Given {
    let inner = |lines: &[f64]| lines[1..lines.len() - 1].to_vec();
    Given {
        corners: shots.iter().map(|shot| corners(facade, shot)).collect(),
        size: Some(dvec2(facade.width, facade.height)),
        lattice: Lattice::Lines(inner(&facade.columns), inner(&facade.rows)),
        ..Given::default()
    }
}

#[test]
fn two_photographs_show_what_one_hides() {
    let facade = Facade::new(3);
    let shots = [11, 12].map(|seed| Shot::new(&facade, seed, LONGEST, 1));
    let photos = shots.each_ref().map(|shot| photo(&facade, shot));
    let hidden = |front: &Front| front.shown.iter().filter(|s| s.is_replaced).count();
    let one = front::read(&photos[..1], &told(&facade, &shots[..1])).expect("a wall");
    let both = front::read(&photos, &told(&facade, &shots)).expect("a wall");
    assert!(
        hidden(&one) > 0 && hidden(&both) < hidden(&one),
        "{} then {}",
        hidden(&one),
        hidden(&both)
    );
    assert_eq!(both.views.len(), 2);
}

/// A wall of four by three windows seen straight on, so many times as bright, and what is known of it.
pub fn plain(bright: f64) -> (RgbImage, Given) {
    let tone = |x: u32, y: u32| {
        let is_wall = (80..560).contains(&x) && (60..420).contains(&y);
        let (u, v) = ((x + 40) % 120, (y + 60) % 120);
        match (is_wall, (25..95).contains(&u) && (25..95).contains(&v)) {
            (false, _) => [240.0, 240.0, 240.0],
            (true, false) => [150.0, 140.0, 120.0],
            (true, true) => [60.0, 70.0, 80.0 + f64::from(v)],
        }
    };
    let picture = RgbImage::from_fn(640, 480, |x, y| {
        image::Rgb(tone(x, y).map(|t: f64| (t * bright) as u8))
    });
    let corners = [
        dvec2(80.0, 60.0),
        dvec2(560.0, 60.0),
        dvec2(560.0, 420.0),
        dvec2(80.0, 420.0),
    ];
    let given = Given {
        corners: vec![corners; 2],
        size: Some(dvec2(4.0, 3.0)),
        lattice: Lattice::Even(4, 3),
        ..Given::default()
    };
    (picture, given)
}

#[test]
fn what_a_mask_hides_comes_from_another_photograph() {
    let (clean, given) = plain(1.0);
    // The left of a window in one, its right in the other: neither shows it whole.
    let hidden = [(1.0, 240.0), (0.85, 280.0)].map(|(bright, x)| {
        let disc = |width: f64| Stroke {
            erases: false,
            width,
            points: vec![[x, 240.0]],
        };
        let (mut pixels, _) = plain(bright);
        let black = painted(pixels.dimensions(), &[disc(18.0)], 1.0);
        for (pixel, black) in pixels.pixels_mut().zip(black.pixels()) {
            pixel.0 = if black[0] > 0 { [0; 3] } else { pixel.0 };
        }
        Photo {
            name: "plain.png".to_owned(),
            mask: Some(painted(pixels.dimensions(), &[disc(22.0)], 1.0)),
            pixels,
            focal: None,
            bend: Some([0.0; 2]),
        }
    });
    let one = front::read(&hidden[..1], &given).expect("a wall");
    let both = front::read(&hidden, &given).expect("a wall");
    let cell = 5;
    assert!(!one.cells[cell].is_whole() && both.cells[cell].is_whole());
    let [left, top, right, bottom] = both.cells[cell].frame;
    let places = (top..bottom).flat_map(|y| (left..right).map(move |x| (x, y)));
    let off = places.flat_map(|(x, y)| {
        let (a, b) = (
            both.wall.get_pixel(x, y).0,
            clean.get_pixel(x + 80, y + 60).0,
        );
        [0, 1, 2].map(|c| a[c].abs_diff(b[c]))
    });
    assert!(off.max() <= Some(8));
}

#[test]
fn equal_parts_are_one_picture_and_light_is_even() {
    let facade = Facade::new(5);
    let shot = Shot::new(&facade, 5, LONGEST, 0);
    let front = front::read(&[photo(&facade, &shot)], &told(&facade, &[shot])).expect("a wall");
    // The mean brightness of each cell as the wall shows it once the light is taken away, beside that of its kind.
    let lit = front::parts::lit(&front.wall, &front.light);
    let mean = |k: usize| {
        let picture = front::parts::cut(&lit, &front.cells[k], 1.0);
        let sum: f64 = picture
            .pixels()
            .map(|p| f64::from(front::tone::linear(p.0)[1]))
            .sum();
        sum / f64::from(picture.width() * picture.height())
    };
    let off = (0..front.cells.len()).map(|k| (mean(k) / mean(front.shown[k].as_cell) - 1.0).abs());
    let off = middle(off.collect());
    assert!(off < 0.02, "equal cells differ by {off}");
    assert!(front.parts.len() <= 4, "{} parts", front.parts.len());
}

#[test]
fn lenses_go_there_and_back() {
    let lens = Lens {
        focal: 900.0,
        middle: dvec2(384.0, 512.0),
        bend: [-0.155, 0.047],
    };
    let mut dice = Dice::new(1);
    for _ in 0..200 {
        let at = dvec2(dice.range(0.0, 768.0), dice.range(0.0, 1024.0));
        let back = lens.bent(lens.straight(at));
        assert!(back.distance(at) < 1e-6, "{at} comes back as {back}");
    }
}

#[test]
fn cameras_tell_their_focal_length() {
    let mut block = b"II\x2a\0\x08\0\0\0\x01\0\x69\x87\x04\0\x01\0\0\0\x1a\0\0\0\0\0\0\0".to_vec();
    block.extend(b"\x01\0\x05\xa4\x03\0\x01\0\0\0\x1c\0\0\0\0\0\0\0");
    let focal = exif::focal(&block, (4000, 3000)).expect("28 mm on film");
    assert!((focal - 28.0 / 43.266_615 * 5000.0).abs() < 1e-6);
    for cut in 0..block.len() - 8 {
        assert_eq!(
            exif::focal(&block[..cut], (4000, 3000)),
            None,
            "{cut} bytes"
        );
    }
}

#[test]
fn pictures_without_a_wall_are_refused() {
    let mut dice = Dice::new(4);
    let noise = image::RgbImage::from_fn(300, 200, |_, _| {
        image::Rgb([0; 3].map(|_: u8| dice.below(256) as u8))
    });
    for pixels in [
        noise,
        image::RgbImage::new(300, 200),
        image::RgbImage::new(1, 1),
    ] {
        let photo = Photo {
            name: String::new(),
            pixels,
            focal: None,
            mask: None,
            bend: None,
        };
        let refused = front::read(&[photo], &Given::default());
        assert!(refused.is_err(), "{:?}", refused.map(|f| f.grid));
    }
}

#[test]
fn photographs_are_read_whole_or_refused() {
    let facade = Facade::new(1);
    let picture = Shot::new(&facade, 1, 200, 0).draw(&facade);
    let mut jpeg = Cursor::new(vec![]);
    picture
        .write_to(&mut jpeg, image::ImageFormat::Jpeg)
        .expect("a picture can be written");
    let jpeg = jpeg.into_inner();
    let (read, _) = Picture::whole(&jpeg).expect("a sound picture");
    assert_eq!((read.pixels.dimensions(), read.shrink), ((200, 150), 1.0));
    assert!(matches!(
        Picture::whole(&jpeg[..jpeg.len() / 2]),
        Err(Unreadable::Damaged(_))
    ));
    assert!(matches!(
        Picture::whole(b"no picture"),
        Err(Unreadable::Format)
    ));
    let deep = image::DynamicImage::from(picture).into_rgb16();
    let mut png = Cursor::new(vec![]);
    deep.write_to(&mut png, image::ImageFormat::Png)
        .expect("a picture can be written");
    assert!(Picture::whole(&png.into_inner()).is_ok());
}

/// The folder of photographs with measured truth.
const REAL: &str = concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/../shared/data/facade_curtain_wall"
);

/// A photograph of it, its truth: corners of a panel clockwise from the upper left as seen, straightened, and the lens.
fn real(name: &str) -> (Photo, [DVec2; 4], [DVec2; 4], Lens) {
    let text =
        std::fs::read_to_string(format!("{REAL}/ground_truth.json")).expect("the truth is there");
    let truth: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let number = |key: &str| truth["camera"][key].as_f64().expect("a number");
    let points = |key: &str| {
        let list = truth["images"][name][key]
            .as_array()
            .expect("points")
            .clone();
        // The file goes round the other way.
        [0, 3, 2, 1].map(|k| {
            dvec2(
                list[k][0].as_f64().expect("x"),
                list[k][1].as_f64().expect("y"),
            )
        })
    };
    let lens = Lens {
        focal: (number("fx") + number("fy")) / 4.0,
        middle: dvec2(number("cx"), number("cy")) / 2.0,
        bend: [number("k1"), number("k2")],
    };
    let bytes = std::fs::read(format!("{REAL}/{name}")).expect("the photograph is there");
    let (picture, _) = Picture::whole(&bytes).expect("a sound photograph");
    let photo = Photo {
        name: name.to_owned(),
        pixels: picture.pixels,
        focal: None,
        mask: None,
        bend: None,
    };
    (
        photo,
        points("panel_corners_px_distorted"),
        points("panel_corners_px_undistorted"),
        lens,
    )
}

/// Corners by hand, 0.7 px of noise: the worst point of the panel, in parts of its diagonal, in the middle of 60 trials.
///
/// The lens comes from long edges, but where half of the panel lies beyond the photograph (img015): nothing says how it bends there.
#[test]
#[cfg_attr(not(shared_data), ignore = "reads ../shared/data, which is not here")]
fn corners_by_hand_are_good_to_three_thousandths() {
    let size = dvec2(103.2, 153.2);
    let flat = [DVec2::ZERO, dvec2(size.x, 0.0), size, dvec2(0.0, size.y)];
    for name in ["img015.jpg", "img052.jpg", "img095.jpg", "img121.jpg"] {
        let (photo, seen, straight, lens) = real(name);
        let truth = homography(flat, straight);
        let mut dice = Dice::new(7);
        let bend = (name == "img015.jpg").then_some(lens.bend);
        let given = Given {
            size: Some(size),
            focal: Some(lens.focal),
            bend,
            ..Given::default()
        };
        let own = front::view(&photo, Some(seen), &given)
            .expect("corners are given")
            .lens;
        let worst = (0..60).map(|_| {
            let by_hand = seen.map(|p| p + dvec2(dice.bell(), dice.bell()) * 0.7);
            let back = homography(by_hand.map(|p| own.straight(p)), flat);
            let places =
                (0..121).map(|k| size * dvec2(f64::from(k % 11), f64::from(k / 11)) / 10.0);
            let off = places
                .map(|p| project(back, own.straight(lens.bent(project(truth, p)))).distance(p));
            off.fold(0.0, f64::max) / size.length()
        });
        let worst = middle(worst.collect());
        assert!(worst < 0.0035, "{name}: {worst}");
    }
}

/// Without corners: the proportions of a panel, and its opposite edges, by what edges of the wall meet.
#[test]
#[cfg_attr(not(shared_data), ignore = "reads ../shared/data, which is not here")]
fn walls_that_are_found_have_true_proportions() {
    let mut right = 0;
    let mut said = String::new();
    for name in ["img015.jpg", "img052.jpg", "img095.jpg", "img121.jpg"] {
        let (photo, seen, _, lens) = real(name);
        let given = Given {
            focal: Some(lens.focal),
            ..Given::default()
        };
        let Ok(view) = front::view(&photo, None, &given) else {
            said += &format!("{name} lost; ");
            continue;
        };
        let back = view.map.inverse();
        let [a, b, c, d] =
            seen.map(|p| project(back, view.lens.straight(p)) * dvec2(view.aspect, 1.0));
        let (upper, lower, left, right_side) =
            (a.distance(b), d.distance(c), a.distance(d), b.distance(c));
        let aspect = (upper + lower) / (left + right_side) / (103.2 / 153.2) - 1.0;
        let opposite = (upper / lower - 1.0)
            .abs()
            .max((left / right_side - 1.0).abs());
        said += &format!("{name} {aspect:.4} {opposite:.4}; ");
        right += usize::from(aspect.abs() < 0.02 && opposite < 0.02);
    }
    assert!(right >= 3, "{said}");
}
