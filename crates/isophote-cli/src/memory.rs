//! The memory that the program uses.

/// The most that it has used so far in bytes; 0 where the system does not tell.
pub fn peak() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let kibibytes = line.and_then(|line| line.trim().strip_suffix("kB")?.trim().parse::<u64>().ok());
    kibibytes.map_or(0, |kibibytes| kibibytes << 10)
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
