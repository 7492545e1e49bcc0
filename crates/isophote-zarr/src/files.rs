//! The files of a store, each written whole or not at all.

use std::fs::{self, File, TryLockError};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use crate::error::StoreError;

/// The folder with what is ours alone; readers of Zarr leave it aside.
const OWN: &str = ".isophote";
/// In it, the files that are being written. On the same file system, so that renaming moves no data.
const UNFINISHED: &str = ".isophote/unfinished";
/// In it, an empty file that is locked by whoever writes.
const LOCK: &str = ".isophote/lock";

/// The folder of a store.
pub struct Files {
    root: PathBuf,
}

/// As long as it is held, nobody writes who may not.
pub struct Lock {
    _file: File,
}

/// Who may write at the same time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sharing {
    /// Nobody else.
    Alone,
    /// Other processes that share as well.
    Together,
}

impl Files {
    pub fn new(root: &Path) -> Self {
        Self { root: root.into() }
    }

    pub fn root(&self) -> &Path {
        &self.root
    }

    pub fn path(&self, key: &str) -> PathBuf {
        self.root.join(key)
    }

    /// Whether the folder holds nothing but what a process may leave that is killed before it says what the store is.
    pub fn is_unused(&self) -> Result<bool, StoreError> {
        let entries = match fs::read_dir(&self.root) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(true),
            entries => entries.map_err(|reason| self.read_error("", reason))?,
        };
        for entry in entries {
            if entry.map_err(|reason| self.read_error("", reason))?.file_name() != OWN {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Makes the folders, waits for nobody, and removes what killed processes have left half-written, provided that
    /// no living one is writing. File systems without locks are taken at their word: nothing is removed there.
    pub fn lock(&self, sharing: Sharing) -> Result<Lock, StoreError> {
        self.make_folder(&self.path(UNFINISHED))?;
        let path = self.path(LOCK);
        let open = File::options().create(true).truncate(false).write(true).open(&path);
        let file = open.map_err(|reason| StoreError::Write { path, reason })?;
        match file.try_lock() {
            Ok(()) => {
                self.remove_unfinished()?;
                if sharing == Sharing::Together {
                    let _ = file.unlock();
                    self.share(&file)?;
                }
            }
            Err(TryLockError::WouldBlock) if sharing == Sharing::Together => self.share(&file)?,
            Err(TryLockError::WouldBlock) => return Err(StoreError::Busy { path: self.root.clone() }),
            Err(TryLockError::Error(_)) => {}
        }
        Ok(Lock { _file: file })
    }

    /// Another process that shares may be looking for leftovers, which takes it a moment.
    fn share(&self, file: &File) -> Result<(), StoreError> {
        let since = Instant::now();
        while let Err(TryLockError::WouldBlock) = file.try_lock_shared() {
            if since.elapsed() > Duration::from_secs(5) {
                return Err(StoreError::Busy { path: self.root.clone() });
            }
            std::thread::sleep(Duration::from_millis(5));
        }
        Ok(())
    }

    fn remove_unfinished(&self) -> Result<(), StoreError> {
        let entries = fs::read_dir(self.path(UNFINISHED)).map_err(|reason| self.read_error(UNFINISHED, reason))?;
        for entry in entries.flatten() {
            let path = entry.path();
            fs::remove_file(&path).map_err(|reason| StoreError::Write { path, reason })?;
        }
        Ok(())
    }

    /// The content of a file; none if it is not there.
    pub fn get(&self, key: &str) -> Result<Option<Vec<u8>>, StoreError> {
        match fs::read(self.path(key)) {
            Ok(bytes) => Ok(Some(bytes)),
            Err(error) if is_absence(&error) => Ok(None),
            Err(reason) => Err(self.read_error(key, reason)),
        }
    }

    /// The length of a file; none if it is not there.
    pub fn length(&self, key: &str) -> Option<u64> {
        fs::metadata(self.path(key)).ok().filter(fs::Metadata::is_file).map(|metadata| metadata.len())
    }

    /// Puts the bytes under a name, in place of what is there.
    pub fn put(&self, key: &str, bytes: &[u8]) -> Result<(), StoreError> {
        let path = self.path(key);
        let put = self.prepared(&path, bytes).and_then(|file| file.persist(&path).map_err(|error| error.error));
        put.map(drop).map_err(|reason| StoreError::Write { path, reason })
    }

    /// Puts the bytes under a name unless there is a file already; says whether it did.
    pub fn put_new(&self, key: &str, bytes: &[u8]) -> Result<bool, StoreError> {
        let path = self.path(key);
        let put =
            self.prepared(&path, bytes).and_then(|file| file.persist_noclobber(&path).map_err(|error| error.error));
        match put {
            Ok(_) => Ok(true),
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => Ok(false),
            Err(reason) => Err(StoreError::Write { path, reason }),
        }
    }

    /// Puts the bytes under a name unless they are there already.
    pub fn put_changed(&self, key: &str, bytes: &[u8]) -> Result<(), StoreError> {
        if self.get(key)?.as_deref() == Some(bytes) { Ok(()) } else { self.put(key, bytes) }
    }

    /// Removes a file, if it is there.
    pub fn remove(&self, key: &str) -> Result<(), StoreError> {
        match fs::remove_file(self.path(key)) {
            Err(reason) if !is_absence(&reason) => Err(StoreError::Write { path: self.path(key), reason }),
            _ => Ok(()),
        }
    }

    /// A hidden file with this content, safe on the disk, to be renamed; it removes itself if it is not.
    fn prepared(&self, path: &Path, bytes: &[u8]) -> io::Result<tempfile::NamedTempFile> {
        if let Some(folder) = path.parent() {
            fs::create_dir_all(folder)?;
        }
        let mut builder = tempfile::Builder::new();
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            // Less the umask; the default of temporary files, 0600, would hide the result from everyone else.
            builder.permissions(fs::Permissions::from_mode(0o666));
        }
        let file = builder.tempfile_in(self.path(UNFINISHED))?;
        // Not through `file` itself, whose errors name the hidden file in place of the one that is wanted.
        file.as_file().write_all(bytes)?;
        // Or a power failure could leave the name and not the content.
        file.as_file().sync_data()?;
        Ok(file)
    }

    fn make_folder(&self, path: &Path) -> Result<(), StoreError> {
        fs::create_dir_all(path).map_err(|reason| StoreError::Write { path: self.root.clone(), reason })
    }

    fn read_error(&self, key: &str, reason: io::Error) -> StoreError {
        StoreError::Read { path: self.path(key), reason }
    }
}

/// A file in the way of a folder means as well that the file looked for is not there.
fn is_absence(error: &io::Error) -> bool {
    matches!(error.kind(), io::ErrorKind::NotFound | io::ErrorKind::NotADirectory)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn leftovers_are_removed_unless_somebody_is_writing() {
        let folder = tempfile::tempdir().unwrap();
        let files = Files::new(folder.path());
        let writer = files.lock(Sharing::Together).unwrap();
        let leftover = files.path(UNFINISHED).join("leftover");
        fs::write(&leftover, "half").unwrap();
        let other = files.lock(Sharing::Together).unwrap();
        assert!(leftover.exists());
        assert!(matches!(files.lock(Sharing::Alone), Err(StoreError::Busy { .. })));
        drop((writer, other));
        let alone = files.lock(Sharing::Alone).unwrap();
        assert!(!leftover.exists());
        drop(alone);
        assert!(files.is_unused().unwrap());
    }

    #[test]
    fn a_file_is_put_whole_and_nothing_else_stays() {
        let folder = tempfile::tempdir().unwrap();
        let files = Files::new(folder.path());
        let _lock = files.lock(Sharing::Alone).unwrap();
        assert!(files.put_new("a/b", b"one").unwrap());
        assert!(!files.put_new("a/b", b"two").unwrap());
        assert_eq!(files.get("a/b").unwrap().as_deref(), Some(&b"one"[..]));
        files.put("a/b", b"three").unwrap();
        assert_eq!((files.length("a/b"), files.length("a")), (Some(5), None));
        assert!(matches!(files.put("a/b/c", b""), Err(StoreError::Write { .. })));
        files.remove("a/b").unwrap();
        files.remove("a/b").unwrap();
        assert_eq!(files.get("a/b").unwrap(), None);
        assert_eq!(fs::read_dir(files.path(UNFINISHED)).unwrap().count(), 0);
    }
}
