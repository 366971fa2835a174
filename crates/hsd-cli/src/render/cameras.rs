//! The cameras of a file: pictures of their own, or a path between them for a film.

use super::shots::Shot;
use super::standing::Camera;
use crate::Failure;
use glam::DVec3;
use hsd_base::diagnostic::Text;
use hsd_base::text;
use hsd_ir::ast::ViewTime;
use serde::Deserialize;
use std::path::Path;

/// The greatest number of pictures of a file.
const MOST: usize = 3600;

/// A camera as it is written. Metres east, north and up; degrees.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    /// The end of the picture's name; without, its number.
    name: Option<String>,
    from: [f64; 3],
    to: [f64; 3],
    #[serde(default = "usual_angle")]
    fov: f64,
    date: Option<String>,
    hour: Option<f64>,
    /// The number of pictures from the camera before, this one included.
    #[serde(default = "one")]
    frames: usize,
}

fn usual_angle() -> f64 {
    45.0
}

fn one() -> usize {
    1
}

/// Reads the pictures that a file of cameras asks for.
///
/// # Errors
/// If it cannot be read, or a value cannot be meant; the message names the camera.
pub(super) fn read(path: &Path) -> Result<Vec<Shot>, Failure> {
    let text = std::fs::read_to_string(path).map_err(|e| Failure::at(path.display(), e))?;
    let shown = path.display();
    let wrong = |why: Text| Failure::Usage(text!([shown, why] "{shown}: {why}", "{shown}: {why}"));
    let list: Vec<Written> = serde_json::from_str(&text).map_err(|e| {
        let e = e.to_string();
        wrong(text!([e]
            "this is no list of cameras such as [{{\"from\": [2, -8, 1.6], \"to\": [2, 0, 3]}}]: {e}",
            "[{{\"from\": [2, -8, 1.6], \"to\": [2, 0, 3]}}] のようなカメラの一覧ではありません: {e}"
        ))
    })?;
    for (n, camera) in list.iter().enumerate() {
        check(n + 1, camera).map_err(wrong)?;
    }
    let count: usize = list.iter().map(|camera| camera.frames).sum();
    if !(1..=MOST).contains(&count) {
        return Err(wrong(text!([count]
            "{count} pictures are asked for; 1 to 3600 can be made at a time",
            "{count} 枚になります。一度に作れるのは 1 から 3600 枚です"
        )));
    }
    let is_path = list.iter().any(|camera| camera.frames > 1);
    let digits = count.to_string().len();
    let mut shots = vec![];
    for (n, camera) in list.iter().enumerate() {
        let frames = if n == 0 { 1 } else { camera.frames };
        for frame in 1..=frames {
            let number = format!("{:0digits$}", shots.len() + 1);
            let name = camera.name.clone().filter(|_| !is_path);
            shots.push(Shot {
                id: format!("camera-{number}"),
                name: name.unwrap_or(number),
                camera: Some(between(&list, n, frame as f64 / frames as f64)),
                time: time(camera),
            });
        }
    }
    Ok(shots)
}

fn time(camera: &Written) -> Option<ViewTime> {
    let date = camera.date.as_deref().and_then(ViewTime::date)?;
    let hour = camera.hour.unwrap_or(ViewTime::USUAL_HOUR);
    Some(ViewTime { date, hour })
}

/// Says what cannot be meant of a camera.
fn check(number: usize, camera: &Written) -> Result<(), Text> {
    let places = camera.from.iter().chain(&camera.to);
    let why = if !places.clone().all(|p| p.abs() <= 1e8) {
        text!("its places must be metres", "位置はメートルで書きます")
    } else if camera.from == camera.to {
        text!(
            "`from` and `to` are one place, so it looks nowhere",
            "`from` と `to` が同じ点で、向きがありません"
        )
    } else if !(1.0..=150.0).contains(&camera.fov) {
        text!(
            "`fov` must be degrees from 1 to 150",
            "`fov` は 1 から 150 度です"
        )
    } else if camera
        .date
        .as_deref()
        .is_some_and(|d| ViewTime::date(d).is_none())
    {
        text!(
            "`date` must be a date, as in 2026-12-21",
            "`date` は 2026-12-21 のように書きます"
        )
    } else if camera.hour.is_some_and(|hour| !(0.0..24.0).contains(&hour)) {
        text!(
            "`hour` must be an hour of the day, as in 9 or 16.5",
            "`hour` は 9 や 16.5 のような時刻です"
        )
    } else if camera.name.as_deref().is_some_and(|n| !is_file_name(n)) {
        text!(
            "its `name` must be letters, digits, `-` or `_`, since files are named by it",
            "`name` はファイル名になるので、文字、数字、`-`、`_` だけにしてください"
        )
    } else {
        return Ok(());
    };
    Err(text!([number, why] "camera {number}: {why}", "{number} 番目のカメラ: {why}"))
}

fn is_file_name(name: &str) -> bool {
    let fits = |c: char| c.is_alphanumeric() || matches!(c, '-' | '_');
    !name.is_empty() && name.chars().all(fits)
}

/// Returns the camera on the way to one of a list from the one before: a smooth curve through all of them (Catmull-Rom).
fn between(list: &[Written], n: usize, share: f64) -> Camera {
    let at = |k: isize| &list[k.clamp(0, list.len() as isize - 1).cast_unsigned()];
    let n = n.cast_signed();
    let four = [at(n - 2), at(n - 1), at(n), at(n + 1)];
    let curve = |of: fn(&Written) -> [f64; 3]| {
        let [p, q, r, s] = four.map(|camera| DVec3::from(of(camera)));
        let (t, t2, t3) = (share, share * share, share * share * share);
        let sum = 2.0 * q
            + (r - p) * t
            + (2.0 * p - 5.0 * q + 4.0 * r - s) * t2
            + (3.0 * q - p - 3.0 * r + s) * t3;
        (sum / 2.0).to_array()
    };
    Camera {
        from: curve(|camera| camera.from),
        to: curve(|camera| camera.to),
        fov: four[1].fov + (four[2].fov - four[1].fov) * share,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shots(text: &str) -> Result<Vec<Shot>, String> {
        let file = tempfile::NamedTempFile::new().expect("a file");
        std::fs::write(file.path(), text).expect("is written");
        read(file.path()).map_err(|failure| format!("{failure:?}"))
    }

    #[test]
    fn cameras_are_pictures_with_their_names() {
        let found = shots(
            r#"[{"name": "roji", "from": [0, 0, 1.6], "to": [0, 9, 2], "date": "2026-12-21"},
                {"from": [0, 0, 40], "to": [9, 9, 0], "fov": 30}]"#,
        );
        let found = found.expect("is a list");
        let names: Vec<&str> = found.iter().map(|s| &*s.name).collect();
        assert_eq!(names, ["roji", "2"]);
        assert_eq!(found[0].time.as_ref().map(|t| t.hour), Some(12.0));
        assert_eq!(found[1].camera.map(|c| c.fov), Some(30.0));
    }

    #[test]
    fn a_path_goes_through_its_cameras_evenly() {
        let text = r#"[{"from": [0, 0, 2], "to": [0, 9, 2]}, {"from": [4, 0, 2], "to": [4, 9, 2], "frames": 4},
            {"from": [8, 0, 2], "to": [8, 9, 2], "frames": 4}]"#;
        let found = shots(text).expect("is a path");
        assert_eq!(found.len(), 9);
        let east: Vec<f64> = found
            .iter()
            .filter_map(|s| Some(s.camera?.from[0]))
            .collect();
        assert_eq!((east[0], east[4], east[8]), (0.0, 4.0, 8.0));
        assert!(east.windows(2).all(|two| two[0] < two[1]), "{east:?}");
        assert_eq!(found[8].name, "9");
    }

    #[test]
    fn what_cannot_be_meant_is_told() {
        for (text, part) in [
            ("{}", "no list of cameras"),
            ("[]", "0 pictures"),
            (r#"[{"from": [0, 0, 0], "to": [0, 0, 0]}]"#, "looks nowhere"),
            (
                r#"[{"from": [0, 0, 0], "to": [0, 1, 0], "fov": 0}]"#,
                "1 to 150",
            ),
            (
                r#"[{"from": [0, 0, 0], "to": [0, 1, 0], "date": "yesterday"}]"#,
                "2026-12-21",
            ),
            (
                r#"[{"from": [0, 0, 0], "to": [0, 1, 0], "name": "../x"}]"#,
                "camera 1",
            ),
            (
                r#"[{"from": [0, 0, 0], "to": [0, 1, 0], "frames": 5000}]"#,
                "3600",
            ),
        ] {
            let why = shots(text).expect_err(text);
            assert!(why.contains(part), "{text}: {why}");
        }
    }
}
