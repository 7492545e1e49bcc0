//! The files of a store, each written whole or not at all.

use std::fs::{self, File, TryLockError};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use crate::error::StoreError;

/// The folder for Isophote's own files, which Zarr readers ignore.
const OWN: &str = ".isophote";
/// The folder inside it for files being written. It is on the same file system, so that renaming moves no data.
const UNFINISHED: &str = ".isophote/unfinished";
/// An empty file inside it that writers lock.
const LOCK: &str = ".isophote/lock";

/// The folder of a store.
pub struct Files {
    root: PathBuf,
}

/// While this is held, no conflicting process writes.
pub struct Lock {
    _file: File,
    /// False where the file system has no locks.
    pub is_held: bool,
}

/// Who may write at the same time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sharing {
    /// No other process.
    Alone,
    /// Other processes that also share.
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

    /// Whether the folder holds nothing but what a process leaves behind if it is killed before it has described the
    /// store.
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

    /// Creates the folders, takes the lock or fails, and removes half-written files left by killed processes, provided
    /// that no running process is writing. On file systems without locks it goes on without one, and removes nothing.
    pub fn lock(&self, sharing: Sharing) -> Result<Lock, StoreError> {
        self.make_folder(&self.path(UNFINISHED))?;
        let path = self.path(LOCK);
        let open = File::options().create(true).truncate(false).write(true).open(&path);
        let file = open.map_err(|reason| StoreError::Write { path, reason })?;
        let mut is_held = true;
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
            Err(TryLockError::Error(_)) => is_held = false,
        }
        Ok(Lock { _file: file, is_held })
    }

    /// Waits briefly, because another sharing process may be looking for leftovers.
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

    /// The content of a file; none if it does not exist.
    pub fn get(&self, key: &str) -> Result<Option<Vec<u8>>, StoreError> {
        match fs::read(self.path(key)) {
            Ok(bytes) => Ok(Some(bytes)),
            Err(error) if is_absence(&error) => Ok(None),
            Err(reason) => Err(self.read_error(key, reason)),
        }
    }

    /// The length of a file; none if it does not exist.
    pub fn length(&self, key: &str) -> Option<u64> {
        fs::metadata(self.path(key)).ok().filter(fs::Metadata::is_file).map(|metadata| metadata.len())
    }

    /// Writes the bytes to a file, replacing its content.
    pub fn put(&self, key: &str, bytes: &[u8]) -> Result<(), StoreError> {
        let path = self.path(key);
        let put = self.prepared(&path, bytes).and_then(|file| {
            file.persist(&path).map_err(|error| error.error)?;
            sync_folder(path.parent())
        });
        put.map_err(|reason| StoreError::Write { path, reason })
    }

    /// Writes the bytes to a file unless it already exists; returns whether it did.
    pub fn put_new(&self, key: &str, bytes: &[u8]) -> Result<bool, StoreError> {
        let path = self.path(key);
        let put = self.prepared(&path, bytes).and_then(|file| {
            file.persist_noclobber(&path).map_err(|error| error.error)?;
            sync_folder(path.parent())
        });
        match put {
            Ok(()) => Ok(true),
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => Ok(false),
            Err(reason) => Err(StoreError::Write { path, reason }),
        }
    }

    /// Writes the bytes to a file unless it already holds them.
    pub fn put_changed(&self, key: &str, bytes: &[u8]) -> Result<(), StoreError> {
        if self.get(key)?.as_deref() == Some(bytes) { Ok(()) } else { self.put(key, bytes) }
    }

    /// Removes a file if it exists.
    pub fn remove(&self, key: &str) -> Result<(), StoreError> {
        match fs::remove_file(self.path(key)) {
            Err(reason) if !is_absence(&reason) => Err(StoreError::Write { path: self.path(key), reason }),
            _ => Ok(()),
        }
    }

    /// A hidden file with this content, synced to disk and ready to be renamed; if it is not, it deletes itself.
    fn prepared(&self, path: &Path, bytes: &[u8]) -> io::Result<tempfile::NamedTempFile> {
        if let Some(folder) = path.parent() {
            make_folders(folder)?;
        }
        let mut builder = tempfile::Builder::new();
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            // The umask still applies. The default for temporary files, 0600, would hide the result from everyone else.
            builder.permissions(fs::Permissions::from_mode(0o666));
        }
        let file = builder.tempfile_in(self.path(UNFINISHED))?;
        // Not through `file` itself, whose errors name the hidden file instead of the target.
        file.as_file().write_all(bytes)?;
        // Otherwise a power failure could leave the name without the content.
        file.as_file().sync_data()?;
        Ok(file)
    }

    fn make_folder(&self, path: &Path) -> Result<(), StoreError> {
        make_folders(path).map_err(|reason| StoreError::Write { path: self.root.clone(), reason })
    }

    fn read_error(&self, key: &str, reason: io::Error) -> StoreError {
        StoreError::Read { path: self.path(key), reason }
    }
}

/// Makes a folder and those above it that are missing, and syncs the folders in which they appear.
fn make_folders(folder: &Path) -> io::Result<()> {
    let missing = folder.ancestors().take_while(|folder| !folder.as_os_str().is_empty() && !folder.is_dir()).count();
    fs::create_dir_all(folder)?;
    folder.ancestors().take(missing).try_for_each(|made| sync_folder(made.parent()))
}

/// Makes sure that a power failure does not take away the names in a folder. Without this a record could outlive the shard
/// that it speaks of, since file systems may write the two names in any order.
#[cfg(unix)]
fn sync_folder(folder: Option<&Path>) -> io::Result<()> {
    let folder = folder.filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    match File::open(folder).and_then(|folder| folder.sync_all()) {
        // Some network file systems cannot sync a folder, and write names at once.
        Err(error) if matches!(error.kind(), io::ErrorKind::InvalidInput | io::ErrorKind::Unsupported) => Ok(()),
        synced => synced,
    }
}

/// Elsewhere folders cannot be opened; the file system writes names in order.
#[cfg(not(unix))]
fn sync_folder(_: Option<&Path>) -> io::Result<()> {
    Ok(())
}

/// If a parent of the path is a file rather than a folder, the path does not exist either.
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
