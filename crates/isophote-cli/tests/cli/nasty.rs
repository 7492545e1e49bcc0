//! Sixty nasty scene files: each is used or refused with words, and none makes the program panic.

use crate::common::{COURSE, Folder, LAB, ROOM};

/// The system grants 2 GiB to this one run: the map is refused with a sentence, not by the end of the program.
#[cfg(target_os = "linux")]
#[test]
fn a_map_that_the_system_has_no_memory_for_is_refused_with_a_sentence() {
    let folder = Folder::with("lab.toml", LAB);
    let render = "render lab.toml --size 16384x8192 --threads 1";
    let script = format!("ulimit -v 2097152; exec '{}' {render} -o map.npz", crate::common::PROGRAM);
    let output = std::process::Command::new("sh").args(["-c", &script]).current_dir(folder.path("")).output().unwrap();
    let said = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains("MiB of memory, which the system does not grant"), "{said}");
    assert_eq!(folder.names(), ["lab.toml"]);
}

/// A generator of numbers that are the same on every run (xorshift64).
struct Numbers(u64);

impl Numbers {
    fn below(&mut self, bound: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        usize::try_from(self.0 >> 33).unwrap() % bound
    }
}

/// Pieces that are put where they do not belong.
const PIECES: [&str; 16] = [
    "nan",
    "-inf",
    "1e308",
    "-0.0",
    "9223372036854775807",
    "[",
    "]]",
    "\"",
    "\n\n[[light]]\n",
    "= =",
    "\0",
    "\u{feff}",
    "1979-05-27",
    "é∞",
    "{ a = 1 }",
    "#",
];

fn mutated(seed: u64) -> Vec<u8> {
    let mut numbers = Numbers(0x9E37_79B9_7F4A_7C15 ^ (seed + 1));
    let mut bytes = [LAB, COURSE, ROOM][numbers.below(3)].as_bytes().to_vec();
    for _ in 0..=numbers.below(6) {
        let at = numbers.below(bytes.len());
        let end = (at + numbers.below(12)).min(bytes.len());
        let piece = PIECES[numbers.below(PIECES.len())].as_bytes();
        match numbers.below(4) {
            0 => bytes.truncate(at.max(1)),
            1 => bytes[at] = u8::try_from(numbers.below(256)).unwrap(),
            _ => drop(bytes.splice(at..end, piece.iter().copied())),
        }
    }
    bytes
}

#[test]
fn mutated_scenes_are_used_or_refused_and_never_make_the_program_panic() {
    let folder = Folder::new();
    let mut codes = Vec::new();
    for seed in 0..60 {
        folder.write("nasty.toml", mutated(seed));
        let outcome = folder.run("render nasty.toml --size 12x9 -o map.csv --figure map.svg");
        match outcome.code {
            Some(0) => assert_eq!(folder.csv("map.csv").rows.len(), 108, "input {seed}"),
            Some(3) => {
                assert!(outcome.stderr.contains("nothing was written"), "input {seed}: {}", outcome.stderr);
                assert_eq!(folder.names(), ["nasty.toml"], "input {seed}");
            }
            other => panic!("input {seed} ends with {other:?}: {}", outcome.stderr),
        }
        assert!(!outcome.stderr.contains("panicked"), "input {seed}: {}", outcome.stderr);
        for name in ["map.csv", "map.svg"] {
            let _ = std::fs::remove_file(folder.path(name));
        }
        codes.push(outcome.code.unwrap());
    }
    assert!(codes.contains(&0) && codes.contains(&3), "the inputs are of both kinds: {codes:?}");
}

#[test]
fn scenes_at_the_limits_of_their_numbers_give_finite_values() {
    for (scene, what) in [
        (LAB.replace("intensity = 100 ", "intensity = 1e30"), "the brightest light"),
        (LAB.replace("shininess = 20", "shininess = 1e5"), "the sharpest highlight"),
        (LAB.replace("position = [5, 5, -10]", "position = [1e15, 1e15, -1e15]"), "the farthest light"),
        (
            LAB.replace("length = \"m\"", "length = \"mm\"").replace("intensity = 100 ", "intensity = 1e-300"),
            "the faintest light",
        ),
    ] {
        let folder = Folder::with("scene.toml", &scene);
        folder.ok("render scene.toml --size 40x30 -o map.csv -o map.png -q");
        let json = folder.ok("render scene.toml --size 40x30 --json -q").json();
        assert!(json["max"]["value"].as_f64().is_some_and(|value| value >= 0.0 && value.is_finite()), "{what}: {json}");
        assert!(folder.csv("map.csv").rows.iter().flatten().all(|number| number.is_finite()), "{what}");
    }
}

/// It took 1.2 GB to keep a problem for each line.
#[cfg(target_os = "linux")]
#[test]
fn a_text_of_mistakes_takes_little_memory() {
    let folder = Folder::with("scene.toml", "=\n".repeat(2_000_000));
    let script = format!("ulimit -v 786432; exec '{}' check scene.toml", crate::common::PROGRAM);
    let output = std::process::Command::new("sh").args(["-c", &script]).current_dir(folder.path("")).output().unwrap();
    let told = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(3), "{told}");
    assert!(told.contains("not valid TOML") && told.contains("1 problem in scene.toml"), "{told}");
}
