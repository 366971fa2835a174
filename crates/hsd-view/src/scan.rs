//! The scans that a house was read from: `HOUSE.plan.json` beside `HOUSE.hsd`, as `hsd plan` writes it.

use super::fingerprint::fingerprint;
use hsd_base::diagnostic::{Language, Text};
use hsd_base::text;
use hsd_driver::plan_file::{PlanFile, PlanSheet, VERSION};
use hsd_export::images;
use serde::Serialize;
use std::fs::{self, File};
use std::hash::Hash;
use std::io::{BufReader, Read};
use std::path::{Component, Path, PathBuf};

/// The largest file, bytes, and number of sheets in it.
const LONGEST: u64 = 16 << 20;
const SHEETS: usize = 64;
/// The largest picture, bytes and pixels.
const HEAVIEST: u64 = 128 << 20;
const PIXELS: u64 = 100_000_000;

/// The scans of a house, for the page: `Scan` in `view/src/server/api.ts`.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Scan {
    /// The name of the file.
    file: String,
    /// Those that can be shown.
    sheets: Vec<ShownSheet>,
    /// Why others cannot, in words.
    faults: Vec<String>,
}

#[derive(Clone, Debug, Serialize)]
struct ShownSheet {
    storey: u32,
    /// Its number in the file, by which its picture is asked for.
    number: usize,
    /// Differs if the picture does.
    key: String,
    /// Width and height, pixels.
    size: [u32; 2],
    to_house: [f64; 6],
}

impl Scan {
    /// Returns the scans of a house; `None` if nothing lies beside it.
    pub(super) fn beside(house: &Path, language: Language) -> Option<Scan> {
        let path = path(house);
        fs::symlink_metadata(&path).ok()?;
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let mut scan = Scan {
            file: name.into_owned(),
            sheets: vec![],
            faults: vec![],
        };
        match read(&path) {
            Err(why) => scan.tell(&why, language),
            Ok(file) => {
                for (number, sheet) in file.sheets.iter().enumerate() {
                    match shown(&path, number, sheet) {
                        Ok(shown) => scan.sheets.push(shown),
                        Err(why) => scan.tell(&why, language),
                    }
                }
            }
        }
        Some(scan)
    }

    fn tell(&mut self, why: &Text, language: Language) {
        self.faults.push(why.in_language(language).into_owned());
    }
}

/// Reads the picture of a sheet; `None` if it cannot be shown.
pub(super) fn picture(house: &Path, number: usize) -> Option<Vec<u8>> {
    let path = path(house);
    let file = read(&path).ok()?;
    let sheet = file.sheets.get(number)?;
    shown(&path, number, sheet).ok()?;
    let (picture, _) = opened(&path, &sheet.picture, HEAVIEST)?;
    let mut bytes = vec![];
    picture.take(HEAVIEST).read_to_end(&mut bytes).ok()?;
    Some(bytes)
}

fn path(house: &Path) -> PathBuf {
    house.with_extension("plan.json")
}

fn read(path: &Path) -> Result<PlanFile, Text> {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let opened = opened(path, &name, LONGEST);
    let (file, _) = opened.ok_or(
        text!(
            "this cannot be read, is larger than 16 MiB, or is a link to elsewhere: let `hsd plan` write it again",
            "読めないか、16 MiB を超えるか、ほかの場所へのリンクです。hsd plan で書き直してください"
        ),
    )?;
    let mut text = String::new();
    let whole = file.take(LONGEST).read_to_string(&mut text);
    let parsed = serde_json::from_str::<PlanFile>(&text);
    match parsed {
        _ if whole.is_err() => Err(text!(
            "this is no UTF-8 text: let `hsd plan` write it again",
            "UTF-8 のテキストではありません。hsd plan で書き直してください"
        )),
        Err(error) => {
            let (line, column) = (error.line(), error.column());
            Err(text!([line, column]
                "line {line}, column {column} is not as `hsd plan` writes it: mend it there, or let `hsd plan` write it again",
                "{line} 行 {column} 桁が hsd plan の書く形と違います。そこを直すか、hsd plan で書き直してください"
            ))
        }
        Ok(PlanFile { plan, .. }) if plan != VERSION => Err(text!([plan]
            "this is version {plan}, and this program reads version 1: let this `hsd plan` write it again",
            "第 {plan} 版ですが、このプログラムが読むのは第 1 版です。この hsd plan で書き直してください"
        )),
        Ok(PlanFile { sheets, .. }) if sheets.len() > SHEETS => Err(text!(
            "this names more than 64 sheets: give each house a file of its own",
            "図面が 64 枚を超えています。家ごとにファイルを分けてください"
        )),
        Ok(file) => Ok(file),
    }
}

/// Returns what the page needs to show a sheet, or why it cannot be shown.
fn shown(file: &Path, number: usize, sheet: &PlanSheet) -> Result<ShownSheet, Text> {
    let (name, nth) = (&*sheet.picture, number + 1);
    let [a, b, c, d, e, f] = sheet.to_house;
    let area = a * d - b * c;
    let far = [a, b, c, d, e, f].iter().any(|n| n.abs() > 1e6);
    if far || area.abs() <= 1e-12 {
        return Err(text!([nth]
            "`to_house` of sheet {nth} takes the picture to nowhere: it needs six numbers, of which the first four span an area",
            "{nth} 枚目の to_house では図面の位置が決まりません。六つの数が要り、初めの四つは面積を張ります"
        ));
    }
    let found = opened(file, name, HEAVIEST).ok_or_else(|| {
        text!([name]
            "`{name}` is not in the folder of this file, cannot be read, or is larger than 128 MiB: put it there, under its plain name",
            "「{name}」はこのファイルと同じフォルダーにないか、読めないか、128 MiB を超えています。フォルダー名なしの名前で、そこに置いてください"
        )
    })?;
    let (picture, key) = found;
    let size = images::size(BufReader::new(picture));
    let Some((width, height)) = size.filter(|(w, h)| *w > 0 && *h > 0) else {
        return Err(text!([name]
            "`{name}` is neither a PNG nor a JPEG: let `hsd plan` write it again",
            "「{name}」は PNG でも JPEG でもありません。hsd plan で書き直してください"
        ));
    };
    if u64::from(width) * u64::from(height) > PIXELS {
        return Err(text!([name]
            "`{name}` has more than 100 million pixels: make it smaller, and `to_house` with it",
            "「{name}」は一億画素を超えています。to_house とともに小さくしてください"
        ));
    }
    Ok(ShownSheet {
        storey: sheet.storey,
        number,
        key,
        size: [width, height],
        to_house: sheet.to_house,
    })
}

/// Opens a file in the folder of another one; returns also a key of its state. `None` if it lies elsewhere, is no file, or
/// is larger than that.
fn opened(beside: &Path, name: &str, most: u64) -> Option<(File, String)> {
    let mut parts = Path::new(name).components();
    let plain = matches!(
        (parts.next(), parts.next()),
        (Some(Component::Normal(_)), None)
    );
    if !plain || name.contains(['/', '\\', ':']) {
        return None;
    }
    let folder = beside.parent()?.canonicalize().ok()?;
    let path = folder.join(name).canonicalize().ok()?;
    // Does not open devices and pipes, which could block.
    if path.parent() != Some(&*folder) || !path.is_file() {
        return None;
    }
    let file = File::open(path).ok()?;
    let state = file.metadata().ok().filter(|s| s.len() <= most)?;
    let key = fingerprint(|p| (name, state.len(), state.modified().ok()).hash(p));
    Some((file, format!("{key:016x}")))
}

#[cfg(test)]
mod tests {
    use super::*;

    const GOOD: &str =
        r#"{"plan":1,"sheets":[{"storey":1,"picture":"a.png","to_house":[-0.01,0,0,-0.01,5,7]}]}"#;

    /// A PNG of one pixel.
    fn dot() -> Vec<u8> {
        let mut bytes = std::io::Cursor::new(vec![]);
        let dot = image::GrayImage::new(1, 1);
        dot.write_to(&mut bytes, image::ImageFormat::Png)
            .expect("can be done");
        bytes.into_inner()
    }

    fn beside(json: &str) -> (tempfile::TempDir, Scan) {
        let folder = tempfile::tempdir().expect("can be done");
        let inner = folder.path().join("inner");
        fs::create_dir(&inner).expect("can be done");
        fs::write(folder.path().join("out.png"), dot()).expect("can be done");
        fs::write(inner.join("a.png"), dot()).expect("can be done");
        fs::write(inner.join("b.txt"), "no picture").expect("can be done");
        fs::write(inner.join("house.plan.json"), json).expect("can be done");
        let scan = Scan::beside(&inner.join("house.hsd"), Language::English);
        (folder, scan.expect("lies there"))
    }

    #[test]
    fn sheets_are_shown_with_their_sizes() {
        let (folder, scan) = beside(GOOD);
        assert!(scan.faults.is_empty(), "{:?}", scan.faults);
        let sheet = &scan.sheets[0];
        assert_eq!((sheet.storey, sheet.number, sheet.size), (1, 0, [1, 1]));
        let house = folder.path().join("inner/house.hsd");
        assert_eq!(picture(&house, 0).expect("can be done"), dot());
        assert_eq!(picture(&house, 1), None);
        assert!(Scan::beside(&folder.path().join("inner/other.hsd"), Language::English).is_none());
    }

    #[test]
    fn what_is_wrong_is_told_and_the_rest_is_shown() {
        let bad = [
            ("{\"plan\":1,\n\"sheets\":5}", "line 2"),
            ("", "line 1"),
            (r#"{"plan":2,"sheets":[]}"#, "version 2"),
            (&GOOD.replace("a.png", "../out.png"), "not in the folder"),
            (&GOOD.replace("a.png", "/etc/hostname"), "not in the folder"),
            (&GOOD.replace("a.png", "gone.png"), "not in the folder"),
            (&GOOD.replace("a.png", ""), "not in the folder"),
            (&GOOD.replace("a.png", "b.txt"), "neither a PNG"),
            (&GOOD.replace("-0.01,0,0,-0.01", "1,2,2,4"), "nowhere"),
        ];
        for (json, why) in bad {
            let (folder, scan) = beside(json);
            assert!(scan.sheets.is_empty(), "{json}");
            assert!(scan.faults[0].contains(why), "{json}: {:?}", scan.faults);
            assert_eq!(
                picture(&folder.path().join("inner/house.hsd"), 0),
                None,
                "{json}"
            );
        }
        let (_folder, scan) = beside(&GOOD.replace(
            "]}]}",
            r#"]},{"storey":2,"picture":"b.txt","to_house":[1,0,0,1,0,0]}]}"#,
        ));
        assert_eq!((scan.sheets.len(), scan.faults.len()), (1, 1));
    }

    #[cfg(unix)]
    #[test]
    fn links_out_of_the_folder_are_not_followed() {
        let (folder, _) = beside(GOOD);
        let link = folder.path().join("inner/a.png");
        fs::remove_file(&link).expect("can be done");
        std::os::unix::fs::symlink(folder.path().join("out.png"), &link).expect("can be done");
        assert_eq!(picture(&folder.path().join("inner/house.hsd"), 0), None);
    }
}
