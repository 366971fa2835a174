//! The focal length that a camera wrote into its photograph.

/// The focal length as for a film of 36 by 24 mm, millimetres.
const ON_FILM: u16 = 0xa405;
/// The directory of what the camera wrote.
const CAMERA: u16 = 0x8769;
/// The diagonal of such a film, millimetres.
const FILM: f64 = 43.266_615;

/// The focal length in pixels of a photograph of this size, from its Exif block; `None` if that does not say it.
pub fn focal(exif: &[u8], (width, height): (u32, u32)) -> Option<f64> {
    let block = Block::of(exif)?;
    let first = block.long(4)? as usize;
    let camera = block.entry(first, CAMERA)?;
    let millimetres = f64::from(
        block
            .entry(block.long(camera + 8)? as usize, ON_FILM)
            .and_then(|at| block.short(at + 8))?,
    );
    let diagonal = f64::from(width).hypot(f64::from(height));
    (4.0..=2000.0)
        .contains(&millimetres)
        .then(|| millimetres / FILM * diagonal)
}

/// A block of directories, as in TIFF.
struct Block<'b> {
    bytes: &'b [u8],
    is_little: bool,
}

impl<'b> Block<'b> {
    fn of(bytes: &'b [u8]) -> Option<Block<'b>> {
        let is_little = match bytes.get(..4)? {
            b"II\x2a\0" => true,
            b"MM\0\x2a" => false,
            _ => return None,
        };
        Some(Block { bytes, is_little })
    }

    fn short(&self, at: usize) -> Option<u16> {
        let two = self.bytes.get(at..at.checked_add(2)?)?.try_into().ok()?;
        Some(if self.is_little {
            u16::from_le_bytes(two)
        } else {
            u16::from_be_bytes(two)
        })
    }

    fn long(&self, at: usize) -> Option<u32> {
        let four = self.bytes.get(at..at.checked_add(4)?)?.try_into().ok()?;
        Some(if self.is_little {
            u32::from_le_bytes(four)
        } else {
            u32::from_be_bytes(four)
        })
    }

    /// Where the entry of a tag begins in the directory at a place.
    fn entry(&self, directory: usize, tag: u16) -> Option<usize> {
        let count = usize::from(self.short(directory)?);
        let mut entries = (0..count).map(|k| directory + 2 + 12 * k);
        entries.find(|at| self.short(*at) == Some(tag))
    }
}
