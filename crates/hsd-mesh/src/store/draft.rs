//! Meshes before the scene numbers its meshes and materials: they can be made on any thread, in any order, since a draft
//! depends on its own content alone. Equal drafts have equal digests, by which the scene keeps one mesh of them.

use crate::bake::Picture;
use crate::mesh::Soup;
use crate::mesh::panel::Rect;
use crate::store::look::Look;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use twox_hash::XxHash3_128;

/// A hash of some content. 128 bits: no two contents of a run have the same.
pub(crate) type Digest = u128;

/// A mesh with looks in place of materials.
#[derive(Clone, Debug)]
pub(crate) struct MeshDraft {
    pub(crate) name: String,
    /// The triangles of each look.
    pub(crate) soups: Vec<(Look, Soup)>,
    /// Upright rectangles that show baked images.
    pub(crate) images: Vec<ImageQuad>,
    digest: OnceLock<Digest>,
}

/// An upright rectangle that shows a baked image.
#[derive(Clone, Debug)]
pub(crate) struct ImageQuad {
    pub(crate) image: Arc<BakedImage>,
    pub(crate) rect: Rect,
    /// Its distance outside the centre line, metres.
    pub(crate) front: f64,
    /// The shade in which it is shown.
    pub(crate) shade: usize,
}

/// A baked image. Its pixels are there until the atlas takes them, so that a run does not keep them all; those of a town are
/// small and few, and stay for the atlases of all tiles.
#[derive(Debug)]
pub(crate) struct BakedImage {
    pixels: Mutex<Option<Arc<Picture>>>,
    stays: bool,
    pub(crate) digest: Digest,
}

impl MeshDraft {
    pub(crate) fn new(name: String, soups: Vec<(Look, Soup)>, images: Vec<ImageQuad>) -> MeshDraft {
        let draft = MeshDraft {
            name,
            soups,
            images,
            digest: OnceLock::new(),
        };
        // Here, since drafts are made on all threads and looked up on one.
        draft.digest();
        draft
    }

    /// A mesh that becomes a part of another: most such are never looked up by themselves.
    pub(crate) fn part(name: String, soups: Vec<(Look, Soup)>) -> MeshDraft {
        MeshDraft {
            name,
            soups,
            images: vec![],
            digest: OnceLock::new(),
        }
    }

    pub(crate) fn digest(&self) -> Digest {
        let make = || digest(&self.name, &self.soups, &self.images);
        *self.digest.get_or_init(make)
    }

    /// Returns true if it shows nothing.
    pub(crate) fn is_empty(&self) -> bool {
        self.soups.is_empty() && self.images.is_empty()
    }

    /// Returns the number of its triangles.
    pub(crate) fn triangles(&self) -> usize {
        let of = |(_, soup): &(Look, Soup)| soup.indices.len() / 3 + soup.left_out;
        self.soups.iter().map(of).sum::<usize>() + 2 * self.images.len()
    }

    /// Returns true if triangles were left out.
    pub(crate) fn is_cut(&self) -> bool {
        self.soups.iter().any(|(_, soup)| soup.left_out > 0)
    }

    /// Returns the size of its arrays, bytes.
    pub(crate) fn size(&self) -> usize {
        let size = |(_, s): &(Look, Soup)| 32 * s.positions.len() + 4 * s.indices.len();
        self.soups.iter().map(size).sum()
    }
}

impl BakedImage {
    pub(super) fn new(picture: Picture, stays: bool) -> BakedImage {
        let mut hasher = XxHash3_128::new();
        hasher.write(&picture.color.width().to_le_bytes());
        hasher.write(picture.color.as_raw());
        hasher.write(picture.normal.as_raw());
        hasher.write(picture.orm.as_raw());
        BakedImage {
            pixels: Mutex::new(Some(Arc::new(picture))),
            stays,
            digest: hasher.finish_128(),
        }
    }

    /// Returns its pixels, the first time or always.
    pub(crate) fn take(&self) -> Option<Arc<Picture>> {
        let mut pixels = self.pixels.lock().unwrap_or_else(PoisonError::into_inner);
        match self.stays {
            true => pixels.clone(),
            false => pixels.take(),
        }
    }
}

fn digest(name: &str, soups: &[(Look, Soup)], images: &[ImageQuad]) -> Digest {
    let mut hasher = XxHash3_128::new();
    let lengths = [name.len(), soups.len(), images.len()];
    write_lengths(&mut hasher, &lengths);
    hasher.write(name.as_bytes());
    for (look, soup) in soups {
        hasher.write(bytemuck::cast_slice(&look.numbers()));
        write_lengths(&mut hasher, &[soup.positions.len(), soup.indices.len()]);
        hasher.write(bytemuck::cast_slice(&soup.positions));
        hasher.write(bytemuck::cast_slice(&soup.normals));
        hasher.write(bytemuck::cast_slice(&soup.uvs));
        hasher.write(bytemuck::cast_slice(&soup.indices));
    }
    for quad in images {
        hasher.write(&quad.image.digest.to_le_bytes());
        write_lengths(&mut hasher, &[quad.shade]);
        let Rect { x0, x1, z0, z1 } = quad.rect;
        hasher.write(bytemuck::cast_slice(&[x0, x1, z0, z1, quad.front]));
    }
    hasher.finish_128()
}

fn write_lengths(hasher: &mut XxHash3_128, lengths: &[usize]) {
    for length in lengths {
        hasher.write(&(*length as u64).to_le_bytes());
    }
}
