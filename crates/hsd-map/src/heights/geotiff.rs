//! GeoTIFF, also in blocks and as BigTIFF: one band of whole numbers or fractions. Only the blocks that meet the window are
//! unpacked, one at a time.

use super::cut::Raster;
use super::geokeys::GeoKeys;
use super::{Heights, Wish};
use crate::fault::{Fault, Kind, OtherGrid};
use crate::input::unreadable;
use glam::DVec2;
use hsd_base::budget::{Account, Resource};
use hsd_base::source::Stream;
use std::io::{BufReader, Read, Seek, SeekFrom};
use std::sync::Arc;
use tiff::decoder::{Decoder, DecodingResult, Limits};
use tiff::tags::Tag;
use tiff::{ColorType, TiffError};

/// The most bytes of a block.
const BLOCK: usize = 64 << 20;

/// A file that is unpacked block by block.
type TiffFile = Decoder<BufReader<Box<dyn Stream>>>;

/// Reads a grid.
pub(super) fn read(wish: &Wish<'_>) -> Result<Heights, Fault> {
    let (mut file, account) = open(wish)?;
    let (columns, rows) = file.dimensions().map_err(|error| fault(wish, error))?;
    let other = |what| wish.fault(Kind::OtherGrid { what });
    match file.colortype().map_err(|error| fault(wish, error))? {
        ColorType::Gray(bits) if bits >= 16 => {}
        ColorType::Gray(_) => return Err(other(OtherGrid::Bytes)),
        _ => return Err(other(OtherGrid::Colours)),
    }
    let keys = keys(&mut file);
    let metres = keys.vertical_unit().ok_or_else(|| other(OtherGrid::Unit))?;
    let raster = Raster {
        columns: columns.into(),
        rows: rows.into(),
        ..place(&mut file, keys.is_of_points()).map_err(other)?
    };
    let crs = match (&wish.options.crs, keys.crs()) {
        (Some(named), _) => Some(named.clone()),
        (None, Ok(own)) => own,
        (None, Err(name)) => return Err(wish.fault(Kind::UnknownCrs { name })),
    };
    let mut cut = raster.cut(crs.as_ref(), wish)?;
    let empty = file.get_tag_ascii_string(Tag::GdalNodata).ok();
    let empty: Option<f64> = empty.and_then(|text| text.trim_matches(['\0', ' ']).parse().ok());
    let (wide, high) = file.chunk_dimensions();
    if wide == 0 || high == 0 {
        let what = "its blocks have no size";
        return Err(wish.fault(Kind::Damaged { what }));
    }
    let across = columns.div_ceil(wide);
    for number in 0..across.saturating_mul(rows.div_ceil(high)) {
        let (x, y) = (
            u64::from(number % across * wide),
            u64::from(number / across) * u64::from(high),
        );
        if !cut.meets(&(x..x + u64::from(wide)), &(y..y + u64::from(high))) {
            continue;
        }
        let (own, lines) = file.chunk_data_dimensions(number);
        let cells = u64::from(own) * u64::from(lines);
        let charged = account.charge(Resource::Pixels, cells);
        charged.map_err(|exhausted| wish.fault(exhausted.into()))?;
        let block = file
            .read_chunk(number)
            .map_err(|error| fault(wish, error))?;
        let values = values(&block).ok_or_else(|| other(OtherGrid::Packing))?;
        let own = u64::from(own.max(1));
        for (at, value) in (0..).zip(values) {
            if Some(value) != empty {
                cut.set(x + at % own, y + at / own, value * metres);
            }
        }
    }
    Ok(Heights::of(crs, cut))
}

/// Opens a file, with bounds on what is unpacked at a time and in all.
fn open(wish: &Wish<'_>) -> Result<(TiffFile, Arc<Account>), Fault> {
    let unreadable = |error| unreadable(wish.file, &error);
    let mut stream = wish.world.open(wish.file).map_err(unreadable)?;
    let account = Account::new(wish.world.budget());
    account.read(length(&mut stream).map_err(unreadable)?);
    let mut limits = Limits::default();
    limits.decoding_buffer_size = BLOCK;
    limits.intermediate_buffer_size = BLOCK;
    let file = Decoder::new(BufReader::new(stream)).map(|file| file.with_limits(limits));
    Ok((file.map_err(|error| fault(wish, error))?, account))
}

/// Returns the length of a file.
fn length(stream: &mut Box<dyn Stream>) -> std::io::Result<u64> {
    let length = stream.seek(SeekFrom::End(0))?;
    stream.rewind()?;
    Ok(length)
}

fn keys<R: Read + Seek>(file: &mut Decoder<R>) -> GeoKeys {
    let numbers = file.get_tag_u16_vec(Tag::GeoKeyDirectoryTag);
    let texts = file.get_tag_ascii_string(Tag::GeoAsciiParamsTag);
    GeoKeys::new(numbers.unwrap_or_default(), texts.unwrap_or_default())
}

/// Returns the place of the first cell and the way to the next ones.
fn place<R: Read + Seek>(file: &mut Decoder<R>, of_points: bool) -> Result<Raster, OtherGrid> {
    let mut numbers = |tag| file.get_tag_f64_vec(tag).unwrap_or_default();
    let (at, step) = match (
        &*numbers(Tag::ModelTransformationTag),
        &*numbers(Tag::ModelPixelScaleTag),
    ) {
        ([a, b, _, x, d, e, _, y, ..], _) => {
            if *b != 0.0 || *d != 0.0 {
                return Err(OtherGrid::Turned);
            }
            (DVec2::new(*x, *y), DVec2::new(*a, *e))
        }
        (_, [dx, dy, ..]) => {
            let tie = numbers(Tag::ModelTiepointTag);
            let [i, j, _, x, y, ..] = tie[..] else {
                return Err(OtherGrid::NoPlace);
            };
            let step = DVec2::new(*dx, -dy);
            (DVec2::new(x, y) - DVec2::new(i, j) * step, step)
        }
        _ => return Err(OtherGrid::NoPlace),
    };
    if step.x <= 0.0 || step.y == 0.0 {
        return Err(OtherGrid::Turned);
    }
    Ok(Raster {
        first: if of_points { at } else { at + step / 2.0 },
        step,
        columns: 0,
        rows: 0,
    })
}

/// Returns the numbers of a block.
fn values(block: &DecodingResult) -> Option<Box<dyn Iterator<Item = f64> + '_>> {
    Some(match block {
        DecodingResult::U16(all) => Box::new(all.iter().map(|n| f64::from(*n))),
        DecodingResult::I16(all) => Box::new(all.iter().map(|n| f64::from(*n))),
        DecodingResult::U32(all) => Box::new(all.iter().map(|n| f64::from(*n))),
        DecodingResult::I32(all) => Box::new(all.iter().map(|n| f64::from(*n))),
        DecodingResult::F32(all) => Box::new(all.iter().map(|n| f64::from(*n))),
        DecodingResult::F64(all) => Box::new(all.iter().copied()),
        _ => return None,
    })
}

/// Returns what an error of the decoder means.
fn fault(wish: &Wish<'_>, error: TiffError) -> Fault {
    match error {
        TiffError::IoError(error) if error.kind() == std::io::ErrorKind::UnexpectedEof => {
            let what = "the file ends in the middle";
            wish.fault(Kind::Damaged { what })
        }
        TiffError::IoError(error) => unreadable(wish.file, &error),
        TiffError::UnsupportedError(_) => {
            let what = OtherGrid::Packing;
            wish.fault(Kind::OtherGrid { what })
        }
        TiffError::LimitsExceeded | TiffError::IntSizeError => {
            let (what, limit) = ("bytes in a block of a GeoTIFF", BLOCK as u64);
            wish.fault(Kind::TooLarge { what, limit })
        }
        _ => {
            let what = "this is no well-formed TIFF";
            wish.fault(Kind::Damaged { what })
        }
    }
}
