//! The files that a scene was read from: noted as they are read, and found again by what an output says of them.

use std::borrow::Cow;
use std::cell::RefCell;
use std::fmt::Write;
use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf, absolute};

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use sha2::{Digest, Sha256};

use super::FileResolver;
use crate::import::{Origin, ReadFailure, Resolver};
use crate::map::SourceFile;
use crate::message;
use crate::text::Message;

/// The longest file, in bytes, that outputs carry as a whole.
const CARRIED: usize = 64 << 10;
/// The most bytes of all files that an output carries.
const CARRIED_IN_ALL: usize = 256 << 10;

/// Notes which files are read, and what is in them.
pub(super) struct NotedFiles<'r> {
    files: &'r dyn Resolver,
    noted: RefCell<Vec<SourceFile>>,
}

impl<'r> NotedFiles<'r> {
    pub(super) fn new(files: &'r dyn Resolver) -> Self {
        Self { files, noted: RefCell::default() }
    }

    /// Notes a file that an earlier scene has read.
    pub(super) fn note(&self, file: SourceFile) {
        let mut noted = self.noted.borrow_mut();
        if !noted.iter().any(|known| known.is_same_content(&file)) {
            noted.push(file);
        }
    }

    /// The files in the order in which they were read, each once.
    pub(super) fn into_list(self) -> Vec<SourceFile> {
        self.noted.into_inner()
    }

    fn describe(&self, name: &str, content: &[u8]) -> SourceFile {
        let carried: usize = self.noted.borrow().iter().filter_map(|file| file.content.as_ref()).map(String::len).sum();
        let is_small = content.len() <= CARRIED && carried + content.len() <= CARRIED_IN_ALL;
        SourceFile {
            name: name.into(),
            path: self.files.full_name(name).display().to_string(),
            bytes: content.len() as u64,
            sha256: hexadecimal(&Sha256::digest(content)),
            content: is_small.then(|| STANDARD.encode(content)),
        }
    }
}

impl Resolver for NotedFiles<'_> {
    fn read(&self, name: &str) -> Result<Cow<'_, [u8]>, ReadFailure> {
        let content = self.files.read(name)?;
        self.note(self.describe(name, &content));
        Ok(content)
    }

    fn size(&self, name: &str) -> Option<u64> {
        self.files.size(name)
    }

    fn admit(&self, bytes: u64) -> Result<(), ReadFailure> {
        self.files.admit(bytes)
    }

    fn origin(&self) -> Origin {
        self.files.origin()
    }

    fn full_name(&self, name: &str) -> PathBuf {
        self.files.full_name(name)
    }
}

/// The files of a scene that was taken from an output: those that the output carries, and those that are still where they
/// were. A file of another content is never taken for one of them.
#[derive(Debug)]
pub struct CarriedFiles {
    directory: PathBuf,
    files: Vec<(SourceFile, Place)>,
}

/// Where the content of a file is.
#[derive(Debug)]
enum Place {
    Carried(Vec<u8>),
    At(PathBuf),
    /// Only files of other content, the first of which is this one, with its description.
    Changed(PathBuf, Message),
    Gone,
}

impl CarriedFiles {
    /// Looks for the files of an output: in the folder of the output, by the path that the output gives, from that folder,
    /// those around it, and the working directory.
    #[must_use]
    pub fn of_output(output: &Path, files: &[SourceFile]) -> Self {
        let folder = match output.parent() {
            Some(folder) if !folder.as_os_str().is_empty() => folder,
            _ => Path::new("."),
        };
        let place = |file: &SourceFile| {
            let carried = file.content.as_ref().and_then(|content| STANDARD.decode(content).ok());
            match carried.filter(|content| hexadecimal(&Sha256::digest(content)) == file.sha256) {
                Some(content) => Place::Carried(content),
                None => found(folder, file),
            }
        };
        let files: Vec<_> = files.iter().map(|file| (file.clone(), place(file))).collect();
        let starts = files.iter().filter_map(|(file, place)| match place {
            Place::At(path) => path.to_str()?.strip_suffix(&file.name).map(PathBuf::from),
            _ => None,
        });
        let directory = starts.into_iter().next().unwrap_or_else(|| folder.into());
        Self { directory, files }
    }
}

impl Resolver for CarriedFiles {
    fn read(&self, name: &str) -> Result<Cow<'_, [u8]>, ReadFailure> {
        match self.files.iter().find(|(file, _)| file.name == name) {
            // An output of a version that carried nothing of its files.
            None => FileResolver::new(&self.directory).read(name).map(|content| content.into_owned().into()),
            Some((_, Place::Carried(content))) => Ok(content.into()),
            Some((file, Place::At(path))) => match std::fs::read(path) {
                Ok(content) if hexadecimal(&Sha256::digest(&content)) == file.sha256 => Ok(content.into()),
                Ok(_) => {
                    Err(ReadFailure::Changed { was: file.describe(), at: path.clone(), is: message!("being written") })
                }
                Err(error) => Err(ReadFailure::Unreadable(error)),
            },
            Some((file, Place::Changed(at, is))) => {
                Err(ReadFailure::Changed { was: file.describe(), at: at.clone(), is: is.clone() })
            }
            Some((file, Place::Gone)) => Err(ReadFailure::Gone { was: file.describe() }),
        }
    }

    fn size(&self, name: &str) -> Option<u64> {
        match self.files.iter().find(|(file, _)| file.name == name) {
            None => FileResolver::new(&self.directory).size(name),
            Some((file, _)) => Some(file.bytes),
        }
    }

    fn origin(&self) -> Origin {
        Origin::Directory(self.directory.clone())
    }

    /// As the output says, so that an output made of this one says the same.
    fn full_name(&self, name: &str) -> PathBuf {
        let known = self.files.iter().find(|(file, _)| file.name == name);
        known.map_or_else(|| self.directory.join(name), |(file, _)| PathBuf::from(&file.path))
    }
}

fn found(folder: &Path, file: &SourceFile) -> Place {
    let around = absolute(folder).unwrap_or_else(|_| folder.into());
    let starts = around.ancestors().chain([Path::new("")]);
    let candidates = starts.flat_map(|start| [start.join(&file.name), start.join(&file.path)]);
    let mut other = None;
    for path in candidates.filter(|path| path.is_file()) {
        match description(&path) {
            Ok((bytes, sha256)) if (bytes, &sha256) == (file.bytes, &file.sha256) => return Place::At(path),
            Ok((bytes, sha256)) => {
                let is = SourceFile { bytes, sha256, ..file.clone() }.describe();
                other.get_or_insert((path, is));
            }
            Err(_) => {}
        }
    }
    other.map_or(Place::Gone, |(path, is)| Place::Changed(path, is))
}

/// The length of a file and its hash.
fn description(path: &Path) -> io::Result<(u64, String)> {
    let mut file = File::open(path)?;
    let mut hasher = Sha256::new();
    let mut buffer = vec![0; 1 << 16];
    let mut bytes = 0;
    loop {
        match file.read(&mut buffer)? {
            0 => return Ok((bytes, hexadecimal(&hasher.finalize()))),
            count => {
                hasher.update(&buffer[..count]);
                bytes += count as u64;
            }
        }
    }
}

fn hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().fold(String::new(), |mut text, byte| {
        // Writing to a string cannot fail.
        let _ = write!(text, "{byte:02x}");
        text
    })
}
