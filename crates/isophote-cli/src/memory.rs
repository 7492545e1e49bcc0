//! The memory that the program uses.

use std::borrow::Cow;
use std::cell::Cell;
use std::path::PathBuf;

use isophote::scene::{Origin, ReadFailure, Resolver};

/// The most that it has used so far in bytes; 0 where the system does not tell.
pub fn peak() -> u64 {
    told("VmHWM:")
}

/// What it uses now in bytes; 0 where the system does not tell.
fn present() -> u64 {
    told("VmRSS:")
}

fn told(what: &str) -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix(what));
    let kibibytes = line.and_then(|line| line.trim().strip_suffix("kB")?.trim().parse::<u64>().ok());
    kibibytes.map_or(0, |kibibytes| kibibytes << 10)
}

/// The files of a scene, read within a limit of memory: a file is refused before it is read if it alone is too much beside
/// what the program uses by then, and before its triangles or spheres are laid out if they are.
pub struct WithinMemory<'r> {
    files: &'r dyn Resolver,
    limit: u64,
    is_exceeded: Cell<bool>,
}

impl<'r> WithinMemory<'r> {
    /// A limit in bytes; `None` for none.
    pub fn new(files: &'r dyn Resolver, limit: Option<u64>) -> Self {
        Self { files, limit: limit.unwrap_or(u64::MAX), is_exceeded: Cell::new(false) }
    }

    /// Whether a file was refused because of the limit.
    pub fn is_exceeded(&self) -> bool {
        self.is_exceeded.get()
    }
}

impl Resolver for WithinMemory<'_> {
    fn read(&self, name: &str) -> Result<Cow<'_, [u8]>, ReadFailure> {
        self.files.read(name)
    }

    fn size(&self, name: &str) -> Option<u64> {
        self.files.size(name)
    }

    fn admit(&self, bytes: u64) -> Result<(), ReadFailure> {
        let needed = present().saturating_add(bytes);
        if needed > self.limit {
            self.is_exceeded.set(true);
            return Err(ReadFailure::Memory { needed, limit: self.limit });
        }
        Ok(())
    }

    fn origin(&self) -> Origin {
        self.files.origin()
    }

    fn full_name(&self, name: &str) -> PathBuf {
        self.files.full_name(name)
    }
}

#[cfg(test)]
mod tests {
    #[cfg(target_os = "linux")]
    #[test]
    fn a_program_uses_some_memory() {
        let before = super::peak();
        assert!((1 << 20..1 << 40).contains(&before), "{before}");
        let filled = vec![1_u8; 64 << 20];
        assert!(super::peak() >= 64 << 20, "{}", filled.len());
    }
}
