//! The bytes of a map as a stream: unpacked if they are compressed, counted, and turned to UTF-8 where a format is text.

use super::{Fault, Kind};
use encoding_rs::{Decoder, Encoding};
use flate2::bufread::MultiGzDecoder;
use hsd_base::budget::{Account, Exhausted, Resource};
use hsd_base::source::World;
use std::io::{self, BufRead, BufReader, Read};
use std::sync::Arc;

/// Bytes that are looked at to find the format and the encoding.
const HEAD: usize = 64 << 10;

/// A file as a stream of bytes.
pub(super) struct Input {
    inner: Box<dyn BufRead + Send>,
    /// The number of bytes that were taken.
    at: u64,
    account: Arc<Account>,
}

impl Input {
    /// Opens a file; gzip is unpacked.
    pub(super) fn open(world: &dyn World, file: &Arc<str>) -> Result<Input, Fault> {
        let failed = |e: io::Error| unreadable(file, &e);
        let stream = world.open(file).map_err(failed)?;
        let account = Account::new(world.budget());
        let counted = Counted {
            inner: stream,
            account: account.clone(),
        };
        let mut inner = BufReader::with_capacity(HEAD, counted);
        let packed = inner.fill_buf().map_err(failed)?.starts_with(&[0x1f, 0x8b]);
        let inner: Box<dyn BufRead + Send> = match packed {
            true => {
                let unpacked = Unpacked {
                    inner: MultiGzDecoder::new(inner),
                    account: account.clone(),
                };
                Box::new(BufReader::with_capacity(HEAD, unpacked))
            }
            false => Box::new(inner),
        };
        Ok(Input {
            inner,
            at: 0,
            account,
        })
    }

    /// Returns the account of the file with the budget of the run.
    pub(super) fn account(&self) -> Arc<Account> {
        self.account.clone()
    }

    /// Returns the first bytes, which are not taken.
    pub(super) fn head(&mut self, file: &Arc<str>) -> Result<&[u8], Fault> {
        self.inner.fill_buf().map_err(|e| unreadable(file, &e))
    }

    /// Returns the number of bytes that were taken.
    pub(super) fn at(&self) -> u64 {
        self.at
    }

    /// Turns the texts of a file to UTF-8. The encoding is the one that is named; else what a byte order mark says; else
    /// UTF-8 if the head of the file is, otherwise one of Japan's.
    ///
    /// # Errors
    /// If the named encoding is not known.
    pub(super) fn into_text(
        mut self,
        file: &Arc<str>,
        named: Option<&str>,
    ) -> Result<(Input, &'static Encoding), Fault> {
        let failed = |e: io::Error| unreadable(file, &e);
        let head = self.inner.fill_buf().map_err(failed)?;
        let (encoding, bom) = match Encoding::for_bom(head) {
            Some((encoding, bom)) => (encoding, bom),
            None => (
                encoding_of(head, named)
                    .map_err(|name| Fault::of_file(file, Kind::UnknownEncoding { name }))?,
                0,
            ),
        };
        self.consume(bom);
        if encoding == encoding_rs::UTF_8 {
            return Ok((self, encoding));
        }
        let account = self.account.clone();
        let decoded = Decoded {
            inner: self,
            decoder: encoding.new_decoder_without_bom_handling(),
            is_over: false,
        };
        let inner = Box::new(BufReader::with_capacity(HEAD, decoded));
        let at = 0;
        Ok((Input { inner, at, account }, encoding))
    }
}

/// Returns the fault of a file that cannot be read.
pub(super) fn unreadable(file: &Arc<str>, error: &io::Error) -> Fault {
    let exhausted = error.get_ref().and_then(|e| e.downcast_ref::<Exhausted>());
    let kind = match exhausted {
        Some(exhausted) => Kind::Exhausted(*exhausted),
        None => Kind::Unreadable {
            why: error.to_string().into(),
        },
    };
    Fault::of_file(file, kind)
}

/// Returns the encoding of a name, where `cp932` and `sjis` are names too.
pub(super) fn encoding_named(name: &str) -> Option<&'static Encoding> {
    let name = name.trim();
    match name.to_ascii_lowercase().as_str() {
        "cp932" | "932" | "ms932" | "sjis" | "shift-jis" => Some(encoding_rs::SHIFT_JIS),
        "65001" | "utf8" => Some(encoding_rs::UTF_8),
        "936" | "cp936" => Some(encoding_rs::GBK),
        "949" | "cp949" => Some(encoding_rs::EUC_KR),
        "950" | "cp950" => Some(encoding_rs::BIG5),
        "88591" => Some(encoding_rs::WINDOWS_1252),
        page if page.len() == 4 && page.starts_with("125") => {
            Encoding::for_label(format!("windows-{page}").as_bytes())
        }
        _ => Encoding::for_label(name.as_bytes()),
    }
}

/// Returns the encoding of a file that begins with these bytes.
fn encoding_of(head: &[u8], named: Option<&str>) -> Result<&'static Encoding, Box<str>> {
    if let Some(name) = named {
        return encoding_named(name).ok_or_else(|| name.into());
    }
    // A character of two bytes may be cut at the end of the head; no second byte is as small as this.
    let end = head.iter().rposition(|b| *b < 0x30).unwrap_or(head.len());
    let is_utf8 = match std::str::from_utf8(head) {
        Ok(_) => true,
        Err(error) => error.error_len().is_none(), // the head ends within a character
    };
    Ok(match is_utf8 {
        true => encoding_rs::UTF_8,
        false => hsd_base::source::japanese(&head[..end]).unwrap_or(encoding_rs::UTF_8),
    })
}

impl Read for Input {
    fn read(&mut self, out: &mut [u8]) -> io::Result<usize> {
        let count = self.inner.read(out)?;
        self.at += count as u64;
        Ok(count)
    }
}

impl BufRead for Input {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        self.inner.fill_buf()
    }

    fn consume(&mut self, count: usize) {
        self.at += count as u64;
        self.inner.consume(count);
    }
}

/// Counts what is read of a file.
struct Counted<R> {
    inner: R,
    account: Arc<Account>,
}

impl<R: Read> Read for Counted<R> {
    fn read(&mut self, out: &mut [u8]) -> io::Result<usize> {
        let count = self.inner.read(out)?;
        self.account.read(count as u64);
        Ok(count)
    }
}

/// Unpacks gzip, and stops where it unpacks to absurdly much.
struct Unpacked<R> {
    inner: MultiGzDecoder<R>,
    account: Arc<Account>,
}

impl<R: BufRead> Read for Unpacked<R> {
    fn read(&mut self, out: &mut [u8]) -> io::Result<usize> {
        let count = self.inner.read(out)?;
        let charged = self.account.charge(Resource::InflatedBytes, count as u64);
        charged.map_err(io::Error::other)?;
        Ok(count)
    }
}

/// Turns bytes of an encoding to UTF-8; bytes that are none of it become U+FFFD.
struct Decoded {
    inner: Input,
    decoder: Decoder,
    is_over: bool,
}

impl Read for Decoded {
    fn read(&mut self, out: &mut [u8]) -> io::Result<usize> {
        while !self.is_over {
            let bytes = self.inner.fill_buf()?;
            self.is_over = bytes.is_empty();
            let (_, read, written, _) = self.decoder.decode_to_utf8(bytes, out, self.is_over);
            self.inner.consume(read);
            if written > 0 {
                return Ok(written);
            }
        }
        Ok(0)
    }
}
