//! The temporary folder in which the tiles of a town are built. Nothing in it is worth keeping, so nothing is synced; a file
//! has its name only when it is complete.

use super::tables::{DECISIONS, ENVELOPES};
use hsd_export::pieces::Pieces;
use hsd_town::tiles::run::TiledTown;
use hsd_town::tiles::{TileStore, envelopes};
use std::collections::BTreeSet;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

/// The folders of tiles.
const FOLDERS: [&str; 2] = ["tiles", "textures"];

/// How many editions of a town are kept: a page may ask for one that quick saves have followed.
const EDITIONS: usize = 8;

/// The folder of a town.
pub(super) struct Scratch {
    folder: PathBuf,
    /// Numbers unfinished files.
    next: AtomicU64,
    /// The number of the town that was published last.
    edition: u64,
    /// The files of that town, and of those before, which a page may still be loading.
    own: [BTreeSet<String>; EDITIONS],
    /// The files of an edition that is kept beside the others.
    kept: BTreeSet<String>,
    /// The name and the bytes of the root of that town.
    root: (String, Vec<u8>),
}

impl Scratch {
    /// Takes a folder for the tiles of a town.
    pub(super) fn new(folder: PathBuf) -> io::Result<Scratch> {
        for name in FOLDERS {
            fs::create_dir_all(folder.join(name))?;
        }
        Ok(Scratch {
            folder,
            next: AtomicU64::new(0),
            edition: 0,
            own: Default::default(),
            kept: BTreeSet::new(),
            root: Default::default(),
        })
    }

    pub(super) fn folder(&self) -> &Path {
        &self.folder
    }

    /// Returns the store of a build; it takes nothing more once the build is stopped.
    pub(super) fn store<'s>(&'s self, stops: &'s AtomicBool) -> ScratchStore<'s> {
        ScratchStore {
            scratch: self,
            stops,
        }
    }

    /// Writes the root, the table of decisions and the report of a town, and removes what neither it nor the last ones before have.
    /// Returns their names.
    pub(super) fn publish(&mut self, made: &TiledTown) -> io::Result<[String; 3]> {
        self.edition += 1;
        let edition = self.edition;
        let mut names = [
            format!("tileset-{edition}.json"),
            format!("decisions-{edition}.csv"),
            format!("report-{edition}.json"),
        ];
        let tree = made.local_tileset();
        for (name, bytes) in &tree.branches {
            if !self.folder.join(name).is_file() {
                self.write(name, bytes)?;
            }
        }
        let root = tree.root;
        // A page that shows the same tiles need not load them again.
        if root == self.root.1 {
            names[0].clone_from(&self.root.0);
        } else {
            self.write(&names[0], &root)?;
            self.root = (names[0].clone(), root);
        }
        self.write(&names[1], made.ledger.decisions.text().as_bytes())?;
        self.write(&names[2], &serde_json::to_vec(&made.ledger.report)?)?;
        let mut own = made.files();
        own.extend(names.clone());
        let rows = &made.ledger.envelopes;
        if !rows.is_empty() {
            let name = names[1].replace(DECISIONS, ENVELOPES);
            self.write(&name, envelopes::table(rows).as_bytes())?;
            own.insert(name);
        }
        own.extend(tree.branches.into_iter().map(|(name, _)| name));
        self.own.rotate_right(1);
        self.own[0] = own;
        self.sweep()?;
        Ok(names)
    }

    /// Keeps the files of an edition with these among them, in place of the edition kept before.
    pub(super) fn keep(&mut self, files: &[&str]) {
        let has = |own: &&BTreeSet<String>| files.iter().all(|name| own.contains(*name));
        self.kept = self.own.iter().find(has).cloned().unwrap_or_default();
    }

    /// Keeps no edition any more.
    pub(super) fn forget(&mut self) {
        self.kept.clear();
    }

    fn sweep(&self) -> io::Result<()> {
        for below in ["", FOLDERS[0], FOLDERS[1]] {
            for entry in fs::read_dir(self.folder.join(below))?.flatten() {
                let file = entry.file_name().to_string_lossy().into_owned();
                let name = match below {
                    "" => file,
                    below => format!("{below}/{file}"),
                };
                let is_file = entry.file_type().is_ok_and(|kind| kind.is_file());
                let mut editions = self.own.iter().chain([&self.kept]);
                if is_file && !editions.any(|own| own.contains(&name)) {
                    fs::remove_file(entry.path())?;
                }
            }
        }
        Ok(())
    }

    fn write(&self, name: &str, bytes: &[u8]) -> io::Result<()> {
        self.place(name, &bytes.to_vec().into())
    }

    fn place(&self, name: &str, bytes: &Pieces) -> io::Result<()> {
        let number = self.next.fetch_add(1, Ordering::Relaxed);
        let unfinished = self.folder.join(format!("unfinished-{number}"));
        bytes.write(&mut fs::File::create(&unfinished)?)?;
        fs::rename(&unfinished, self.folder.join(name))
    }
}

/// The store of one build.
pub(super) struct ScratchStore<'s> {
    scratch: &'s Scratch,
    stops: &'s AtomicBool,
}

impl TileStore for ScratchStore<'_> {
    fn read(&self, name: &str) -> Option<Vec<u8>> {
        fs::read(self.scratch.folder.join(name)).ok()
    }

    fn has(&self, name: &str) -> bool {
        self.scratch.folder.join(name).is_file()
    }

    fn commit(&self, name: &str, bytes: &Pieces) -> io::Result<()> {
        if self.stops.load(Ordering::Relaxed) {
            return Err(io::ErrorKind::Interrupted.into());
        }
        self.scratch.place(name, bytes)
    }
}
