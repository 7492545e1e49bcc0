//! Scenes and the files they name in the file system: the only module here that opens files.

use crate::message;
use crate::text::Message;
use std::borrow::Cow;
use std::fs::File;
use std::io::{Error, ErrorKind, Read};
use std::path::{Path, PathBuf};

use super::{Scene, SceneError, Syntax, limits};
use crate::import::{Origin, ReadFailure, Resolver};

/// Files in the file system; relative names start in a directory.
#[derive(Clone, Debug, Default)]
pub struct FileResolver {
    directory: PathBuf,
}

impl FileResolver {
    /// Resolves relative names in this directory, or in the working directory if it is empty.
    #[must_use]
    pub fn new(directory: impl Into<PathBuf>) -> Self {
        Self { directory: directory.into() }
    }
}

impl Resolver for FileResolver {
    fn read(&self, name: &str) -> Result<Cow<'_, [u8]>, ReadFailure> {
        let path = self.full_name(name);
        if path.is_dir() {
            return Err(ReadFailure::Directory);
        }
        if path.metadata().is_ok_and(|metadata| !metadata.is_file()) {
            return Err(ReadFailure::NoFile);
        }
        let mut bytes = Vec::new();
        File::open(path).and_then(|mut file| file.read_to_end(&mut bytes)).map_err(ReadFailure::Unreadable)?;
        Ok(bytes.into())
    }

    fn size(&self, name: &str) -> Option<u64> {
        self.full_name(name).metadata().ok().filter(std::fs::Metadata::is_file).map(|metadata| metadata.len())
    }

    fn origin(&self) -> Origin {
        Origin::Directory(self.directory.clone())
    }

    fn full_name(&self, name: &str) -> PathBuf {
        self.directory.join(name)
    }
}

impl Scene {
    /// Reads a scene file: JSON if the name ends in `.json`, TOML otherwise. Relative paths in it start in its directory.
    ///
    /// # Errors
    /// Every problem of the file and of the scene in it, with its place.
    pub fn from_file(path: &Path) -> Result<Self, SceneError> {
        Self::from_file_with(&FileResolver::new(path.parent().unwrap_or(Path::new(""))), path)
    }

    /// Reads a scene file: JSON if the name ends in `.json`, TOML otherwise. The files it names are looked up in `files`.
    ///
    /// # Errors
    /// Every problem of the file and of the scene in it, with its place.
    pub fn from_file_with(files: &dyn Resolver, path: &Path) -> Result<Self, SceneError> {
        let name = path.display().to_string();
        let text = Self::read_text(&mut open(path, &name)?, &name)?;
        let is_json = path.extension().is_some_and(|suffix| suffix.eq_ignore_ascii_case("json"));
        let syntax = if is_json { Syntax::Json } else { Syntax::Toml };
        Self::from_text_with(files, None, &name, &text, syntax)
    }

    /// Reads a scene from text; `name` identifies it in error messages. Relative paths in it start in the working directory.
    ///
    /// # Errors
    /// Every problem of the text and of the scene in it, with its place.
    pub fn from_text(name: &str, text: &str, syntax: Syntax) -> Result<Self, SceneError> {
        Self::from_text_in(Path::new(""), name, text, syntax)
    }

    /// Reads a scene from text, with the directory in which relative paths start.
    ///
    /// # Errors
    /// As [`from_text`](Self::from_text).
    pub fn from_text_in(directory: &Path, name: &str, text: &str, syntax: Syntax) -> Result<Self, SceneError> {
        Self::from_text_with(&FileResolver::new(directory), None, name, text, syntax)
    }

    /// Reads the text of a scene from a source that may turn out to be endless or binary; `name` identifies it in error
    /// messages.
    ///
    /// # Errors
    /// More bytes than the [`limits`] allow, or bytes that are not text.
    pub fn read_text(input: &mut impl Read, name: &str) -> Result<String, SceneError> {
        let mut bytes = Vec::new();
        Read::take(input, limits::FILE_BYTES + 1)
            .read_to_end(&mut bytes)
            .map_err(|error| SceneError::unreadable(name, describe(&error), None))?;
        if bytes.len() as u64 > limits::FILE_BYTES {
            return Err(too_large(name, &message!("more than {most} bytes", most = limits::FILE_BYTES)));
        }
        String::from_utf8(bytes).map_err(|error| {
            let at = error.utf8_error().valid_up_to();
            let line = String::from_utf8_lossy(&error.as_bytes()[..at]).matches('\n').count() + 1;
            let byte = error.as_bytes()[at];
            let message = message!(
                "not a text in UTF-8: byte 0x{byte} at offset {at}, line {line}",
                byte = format!("{byte:02X}"),
                at,
                line
            );
            let help = message!("a scene is a TOML or JSON text; save it as UTF-8");
            SceneError::unreadable(name, message, Some(help))
        })
    }
}

/// Opens a file that may be missing, a directory, or huge.
fn open(path: &Path, name: &str) -> Result<File, SceneError> {
    let unreadable = |error: Error| SceneError::unreadable(name, describe(&error), None);
    let file = File::open(path).map_err(unreadable)?;
    let metadata = file.metadata().map_err(unreadable)?;
    if metadata.is_dir() {
        return Err(SceneError::unreadable(name, message!("this is a directory, not a scene file"), None));
    }
    if metadata.len() > limits::FILE_BYTES {
        return Err(too_large(name, &message!("{count} bytes", count = metadata.len())));
    }
    Ok(file)
}

fn too_large(name: &str, size: &Message) -> SceneError {
    let message = message!("the file has {size}; a scene file may have {most}", size, most = limits::FILE_BYTES);
    SceneError::unreadable(name, message, None)
}

fn describe(error: &Error) -> Message {
    match error.kind() {
        ErrorKind::NotFound => message!("there is no such file"),
        ErrorKind::PermissionDenied => message!("this file may not be read: permission denied"),
        _ => message!("this file cannot be read: {reason}", reason = error.to_string()),
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;
    use crate::import::{ImportError, read_mesh, read_spheres};

    #[test]
    fn what_is_wrong_with_a_file_is_said_with_its_name() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        let message = |error: ImportError| error.to_string().replace(&folder.path().display().to_string(), "…");
        fs::create_dir(path("folder.obj")).unwrap();
        fs::write(path("scene.blend"), "v 0 0 0\n").unwrap();
        fs::write(path("wrong.obj"), "v 0 0 zero\n").unwrap();
        fs::write(path("points.csv"), "x,y,z,radius\n0,0,0,-1\n").unwrap();
        let files = FileResolver::new(folder.path());
        let mesh = |name: &str| message(read_mesh(&files, name).unwrap_err());
        let spheres = |name: &str| message(read_spheres(&files, name).unwrap_err());
        assert_eq!(mesh("folder.obj"), "‘…/folder.obj’ is a directory; a file is needed");
        assert!(mesh("nothing.obj").starts_with("cannot read ‘…/nothing.obj’: "));
        let suffix = "its suffix names no format that can be read here; allowed are";
        assert_eq!(mesh("scene.blend"), format!("‘…/scene.blend’: {suffix} .obj, .ply, .stl and .glb"));
        assert_eq!(spheres("wrong.obj"), format!("‘…/wrong.obj’: {suffix} .csv, .npy and .ply"));
        assert_eq!(mesh("wrong.obj"), "‘…/wrong.obj’, line 1: z is ‘zero’; a number is needed");
        assert_eq!(spheres("points.csv"), "‘…/points.csv’, line 2: radius is -1; it must be greater than 0");
    }
}
