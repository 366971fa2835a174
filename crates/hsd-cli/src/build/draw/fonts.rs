//! A Japanese font of this machine, for images.

use std::path::PathBuf;

/// Where systems keep fonts.
const FOLDERS: [&str; 6] = [
    "/usr/share/fonts",
    "/usr/local/share/fonts",
    "/System/Library/Fonts",
    "/Library/Fonts",
    "C:\\Windows\\Fonts",
    "/run/current-system/sw/share/X11/fonts",
];

/// The names of Japanese fonts, those preferred first.
const NAMES: [&str; 10] = [
    "NotoSansCJK-Regular.ttc",
    "NotoSansCJKjp-Regular.otf",
    "NotoSansJP-Regular.otf",
    "NotoSansJP-Regular.ttf",
    "ipaexg.ttf",
    "ipag.ttf",
    "TakaoGothic.ttf",
    "ヒラギノ角ゴシック W3.ttc",
    "YuGothR.ttc",
    "meiryo.ttc",
];

/// How deep folders of fonts are looked through.
const DEPTH: usize = 4;

/// Returns the best known font that is installed, and its bytes.
pub(super) fn of_machine() -> Option<(PathBuf, Vec<u8>)> {
    let mut found: Vec<(usize, PathBuf)> = vec![];
    let mut folders: Vec<(PathBuf, usize)> = FOLDERS.iter().map(|f| (f.into(), 0)).collect();
    while let Some((folder, depth)) = folders.pop() {
        for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
            let path = entry.path();
            let name = entry.file_name();
            if let Some(rank) = NAMES.iter().position(|n| name.as_os_str() == *n) {
                found.push((rank, path));
            } else if depth < DEPTH && path.is_dir() {
                folders.push((path, depth + 1));
            }
        }
    }
    found.sort();
    let (_, path) = found.into_iter().next()?;
    let bytes = std::fs::read(&path).ok()?;
    Some((path, bytes))
}
