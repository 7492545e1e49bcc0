//! All channels as `NumPy` arrays in one file: an uncompressed ZIP archive of NPY files, as written by `numpy.savez`.

use std::io::{self, BufRead, Read, Seek, SeekFrom, Write};

use isophote::map::{Map, Values};
use isophote::text::Message;
use zip::{CompressionMethod, DateTime, ZipArchive, ZipWriter, result::ZipError, write::SimpleFileOptions};

use crate::error::ExportError;
use crate::format::Format;
use crate::limits::{LONGEST_JSON, read_exactly};
use crate::metadata::FileMetadata;
use crate::{names, npy};

/// Writes one member per channel, named [`Quantity::name`](isophote::map::Quantity::name) (slashes and control
/// characters in a light's name become `_`), plus `mask` (true where a surface is seen) and `metadata`: the JSON as a
/// 0-dimensional string array, `numpy.load(file)["metadata"].item()`. Members above 4 GiB are written in ZIP64. The
/// output must be seekable, because each member begins with its checksum, which is known only at the end.
///
/// # Errors
/// More members than an archive can hold; an error of `out`.
pub fn write(map: &Map, out: impl Write + Seek) -> Result<(), ExportError> {
    let size = map.region.size;
    // Programs that unpack the archive would take a slash for a folder, and `/../` would lead out of theirs.
    let names = names::unique(map.channels(), |character| !character.is_control() && !"/\\:".contains(character));
    let stored_as = names.iter().map(|name| vec![name.clone()]).collect();
    let mut archive = ZipWriter::new(SilentAfterError::new(out));
    start(&mut archive, "metadata", 0)?;
    write_text(&mut archive, &FileMetadata::of_stored(map, stored_as).to_json())?;
    start(&mut archive, "mask", size.count())?;
    archive.write_all(&npy::header("|b1", &format!("({}, {})", size.height, size.width)))?;
    let mut mask = vec![0; size.pixels()];
    for run in map.mask().runs() {
        mask[run.start..run.end].fill(1);
    }
    archive.write_all(&mask)?;
    for (channel, name) in map.channels().iter().zip(&names) {
        start(&mut archive, name, bytes(&channel.values))?;
        npy::write_array(&mut archive, size, &channel.values)?;
    }
    archive.finish().map_err(from_zip)?;
    Ok(())
}

/// A `ZipWriter` that is dropped after an error tries to complete the archive, prints to the terminal if that fails
/// too, and panics if the end lies before the member being written. After the first error, this wrapper passes nothing
/// on and behaves like a file that ends where the real one did, so that the attempt succeeds.
struct SilentAfterError<W> {
    out: W,
    failed: bool,
    position: u64,
    end: u64,
}

impl<W> SilentAfterError<W> {
    fn new(out: W) -> Self {
        Self { out, failed: false, position: 0, end: 0 }
    }

    fn move_to(&mut self, position: u64) -> u64 {
        self.position = position;
        self.end = self.end.max(position);
        position
    }

    fn fail<T>(&mut self, error: io::Error) -> io::Result<T> {
        self.failed = true;
        self.position = self.end;
        Err(error)
    }
}

impl<W: Write> Write for SilentAfterError<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match if self.failed { Ok(bytes.len()) } else { self.out.write(bytes) } {
            Ok(written) => {
                self.move_to(self.position + written as u64);
                Ok(written)
            }
            Err(again) if again.kind() == io::ErrorKind::Interrupted => Err(again),
            Err(error) => self.fail(error),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        if self.failed { Ok(()) } else { self.out.flush().or_else(|error| self.fail(error)) }
    }
}

impl<W: Seek> Seek for SilentAfterError<W> {
    fn seek(&mut self, target: SeekFrom) -> io::Result<u64> {
        let sought = match target {
            _ if !self.failed => self.out.seek(target),
            SeekFrom::Start(position) => Ok(position),
            SeekFrom::Current(step) => Ok(self.position.saturating_add_signed(step)),
            SeekFrom::End(step) => Ok(self.end.saturating_add_signed(step)),
        };
        sought.map(|position| self.move_to(position)).or_else(|error| self.fail(error))
    }
}

/// Starts a member; its fixed time and permissions make the same map give the same bytes.
fn start(archive: &mut ZipWriter<impl Write + Seek>, name: &str, bytes: u64) -> Result<(), ExportError> {
    let options = SimpleFileOptions::default()
        .compression_method(CompressionMethod::Stored)
        .last_modified_time(DateTime::default())
        .unix_permissions(0o644)
        .large_file(bytes > ALWAYS_BELOW_4_GIB);
    archive.start_file(format!("{name}.npy"), options).map_err(from_zip)
}

/// Leaves room for any NPY header.
const ALWAYS_BELOW_4_GIB: u64 = u32::MAX as u64 - 65_536;

fn bytes(values: &Values) -> u64 {
    match values {
        Values::Scalar(values) => 8 * values.len() as u64,
        Values::Single(values) => 4 * values.len() as u64,
        Values::Vector(values) => 24 * values.len() as u64,
        Values::Index(indices) => 4 * indices.len() as u64,
    }
}

/// `NumPy` strings have a fixed width and four bytes per character.
fn write_text(out: &mut impl Write, text: &str) -> io::Result<()> {
    let characters: Vec<char> = text.chars().collect();
    out.write_all(&npy::header(&format!("<U{}", characters.len()), "()"))?;
    npy::write_numbers(out, &characters, |character| u32::from(character).to_le_bytes())
}

fn from_zip(error: ZipError) -> ExportError {
    match error {
        ZipError::Io(reason) => ExportError::Write(reason),
        other => ExportError::Unsuitable { format: Format::Npz, reason: Message::verbatim(other.to_string()) },
    }
}

pub(crate) fn read_json(file: &mut (impl BufRead + Seek)) -> Result<Option<Vec<u8>>, String> {
    let mut archive = ZipArchive::new(file).map_err(|error| error.to_string())?;
    let mut member = match archive.by_name("metadata.npy") {
        Ok(member) => member,
        Err(ZipError::FileNotFound) => return Ok(None),
        Err(error) => return Err(error.to_string()),
    };
    let length = member.size();
    let bytes = read_exactly(&mut member, length, 4 * LONGEST_JSON)?;
    // The archive's checksum is verified only when the member has been read to its end.
    member.read(&mut [0]).map_err(|error| error.to_string())?;
    text_of(&bytes).map(Some).ok_or_else(|| "its metadata is no NumPy text".into())
}

fn text_of(array: &[u8]) -> Option<Vec<u8>> {
    let rest = array.strip_prefix(npy::MAGIC)?.strip_prefix(&[1, 0])?;
    let (length, rest) = rest.split_first_chunk()?;
    let (dictionary, characters) = rest.split_at_checked(u16::from_le_bytes(*length).into())?;
    str::from_utf8(dictionary).ok().filter(|text| text.contains("'<U"))?;
    let (characters, []) = characters.as_chunks::<4>() else { return None };
    let text: Option<String> = characters.iter().map(|bytes| char::from_u32(u32::from_le_bytes(*bytes))).collect();
    text.map(String::into_bytes)
}
