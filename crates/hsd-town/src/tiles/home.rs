//! The folder of a town file, from which other files are named: so a tile is the same from wherever the program is started.

use std::path::{Component, Path, PathBuf};

/// The folder of a town file.
#[derive(Clone, Debug)]
pub(super) struct Home(PathBuf);

impl Home {
    /// Returns the folder of a file.
    pub(super) fn of(file: &str) -> Home {
        Home(Path::new(file).parent().unwrap_or(Path::new("")).to_owned())
    }

    /// Returns a path as it is seen from the folder, with `/`; the path itself where that cannot be told.
    pub(super) fn seen(&self, path: &str) -> String {
        let (own, other) = (plain(&self.0), plain(Path::new(path)));
        if self.0.is_absolute() != Path::new(path).is_absolute() {
            return path.to_owned();
        }
        let shared = own.iter().zip(&other).take_while(|(a, b)| a == b).count();
        let up = &own[shared..];
        if up.contains(&Component::ParentDir) {
            return path.to_owned();
        }
        let ups = up.iter().map(|_| "..".into());
        let down = other[shared..]
            .iter()
            .map(|c| c.as_os_str().to_string_lossy());
        let words: Vec<std::borrow::Cow<'_, str>> = ups.chain(down).collect();
        words.join("/")
    }

    /// Returns the path of what is seen from the folder.
    pub(super) fn path(&self, seen: &str) -> String {
        let mut path = self.0.clone();
        for part in Path::new(seen).components() {
            match part {
                Component::ParentDir if path.file_name().is_some() => {
                    path.pop();
                }
                part => path.push(part),
            }
        }
        path.to_string_lossy().into_owned()
    }
}

/// Returns the parts of a path without those that mean nothing.
fn plain(path: &Path) -> Vec<Component<'_>> {
    let parts = path.components();
    parts.filter(|part| *part != Component::CurDir).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_seen_from_the_town_alike_from_everywhere() {
        for (town, file, seen) in [
            ("towns/a.hsd", "towns/textures/x.png", "textures/x.png"),
            (
                "/w/towns/a.hsd",
                "/w/towns/textures/x.png",
                "textures/x.png",
            ),
            ("towns/a.hsd", "pictures/x.png", "../pictures/x.png"),
            ("/w/towns/a.hsd", "/w/pictures/x.png", "../pictures/x.png"),
            ("a.hsd", "./x.png", "x.png"),
            ("a.hsd", "textures/x.png", "textures/x.png"),
            ("../a.hsd", "x.png", "x.png"),
            ("a.hsd", "/w/x.png", "/w/x.png"),
        ] {
            let home = Home::of(town);
            assert_eq!(home.seen(file), seen, "{town}");
            if !file.starts_with('.') && !town.starts_with('.') {
                assert_eq!(home.path(seen), file, "{town}");
            }
        }
    }
}
