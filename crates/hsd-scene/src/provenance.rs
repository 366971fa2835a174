//! What a model was made from, and where in it each thing is written: for people who look at it in other programs.

use hsd_base::source::Source;
use std::num::NonZeroU32;

/// A place in a source file as people name it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place {
    /// The line, from 1.
    pub line: NonZeroU32,
    /// The column in characters, from 1.
    pub column: u32,
}

/// The names of a part.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PartNames {
    /// The Japanese name.
    pub ja: Box<str>,
    /// The English name.
    pub en: Box<str>,
}

/// What a model was made from.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Provenance {
    /// The names of the source files by their numbers, as seen from the folder of the first.
    pub files: Vec<String>,
    /// The random seed, if one was given.
    pub seed: Option<u64>,
    /// The parameters that were given, and their values.
    pub parameters: Vec<(String, String)>,
}

impl Provenance {
    /// Names these files. A name does not tell where on a machine the files lie.
    #[must_use]
    pub fn with_files<'s>(mut self, sources: impl Iterator<Item = &'s Source>) -> Provenance {
        for source in sources {
            let at = source.id().0 as usize;
            if self.files.len() <= at {
                self.files.resize(at + 1, String::new());
            }
            self.files[at] = source.name().replace('\\', "/");
        }
        let home = self.files.first().and_then(|first| first.rsplit_once('/'));
        let home = home.map_or(String::new(), |(folder, _)| format!("{folder}/"));
        for file in &mut self.files {
            let below = file.strip_prefix(&home);
            let name = below.filter(|name| !name.starts_with(['/', '.']) && !name.contains(':'));
            let name = name.or_else(|| file.rsplit('/').next());
            *file = name.unwrap_or_default().to_owned();
        }
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use hsd_base::source::FileId;

    #[test]
    fn files_are_named_from_the_folder_of_the_first() {
        let names = |all: &[&str]| {
            let sources: Vec<Source> = (0..)
                .zip(all)
                .map(|(id, name)| Source::new(FileId(id), *name, b""))
                .collect();
            Provenance::default().with_files(sources.iter()).files
        };
        assert_eq!(
            names(&["shop.hsd", "parts/door.hsd"]),
            ["shop.hsd", "parts/door.hsd"]
        );
        assert_eq!(
            names(&[
                "/maps/town/shop.hsd",
                "/maps/town/in/door.hsd",
                "/etc/x.hsd"
            ]),
            ["shop.hsd", "in/door.hsd", "x.hsd"]
        );
        assert_eq!(names(&["/x.hsd", "C:\\a\\b.hsd"]), ["x.hsd", "b.hsd"]);
    }
}
