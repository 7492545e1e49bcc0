//! A folder to run the program in, and readers of its files that the project did not write.

use std::io::Cursor;
use std::path::{Path, PathBuf};
use std::time::Duration;

use assert_cmd::Command;
use png::{BitDepth, ColorType};
use serde_json::Value;
use tempfile::TempDir;

pub const PROGRAM: &str = env!("CARGO_BIN_EXE_isophote");
pub const LAB: &str = include_str!("../../../../scenes/lab.toml");
pub const COURSE: &str = include_str!("../../../../scenes/course.toml");
pub const PHOTOMETRIC: &str = include_str!("../../../../scenes/photometric.toml");
pub const TWO_LIGHTS: &str = include_str!("../../../../scenes/two-lights.toml");

/// The lab's scene with one thing changed.
pub fn lab_with(from: &str, to: &str) -> String {
    assert!(LAB.contains(from), "the lab's scene has no {from:?}");
    LAB.replacen(from, to, 1)
}

/// The eye in a room with a light: the sphere is seen from inside. Four things in it deserve a warning.
pub const ROOM: &str = r#"
version = 1
title = "A room"
length = "m"

[camera]
eye = [0, 0, 0]
forward = [0, 0, -1]
screen = { distance = 1, x = [-1, 1], y = [-1, 1] }
resolution = [40, 20]

[material.plaster]
diffuse = 0.5
specular = 0.6
shininess = 8

[material.spare]
diffuse = 0.1

[[sphere]]
name = "room"
center = [0, 0, 0]
radius = 2
material = "plaster"

[[light]]
name = "bulb"
position = [0, 1, 0]
intensity = 10

[[light]]
name = "moon"
position = [0, 5, 0]
intensity = 10
"#;

/// An empty folder of a test.
pub struct Folder(TempDir);

impl Folder {
    pub fn new() -> Self {
        Self(TempDir::new().unwrap())
    }

    /// A folder with a scene in it.
    pub fn with(name: &str, content: impl AsRef<[u8]>) -> Self {
        let folder = Self::new();
        folder.write(name, content);
        folder
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub fn write(&self, name: &str, content: impl AsRef<[u8]>) {
        std::fs::write(self.path(name), content).unwrap();
    }

    pub fn read(&self, name: &str) -> Vec<u8> {
        std::fs::read(self.path(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    pub fn text(&self, name: &str) -> String {
        String::from_utf8(self.read(name)).unwrap()
    }

    pub fn csv(&self, name: &str) -> Csv {
        Csv::parse(&self.text(name))
    }

    pub fn picture(&self, name: &str) -> Picture {
        Picture::read(&self.read(name))
    }

    /// Everything in the folder, hidden files too.
    pub fn names(&self) -> Vec<String> {
        names_in(self.0.path())
    }

    /// Runs the program here, with its arguments separated by spaces.
    pub fn run(&self, arguments: &str) -> Outcome {
        self.run_with(arguments, b"")
    }

    pub fn run_with(&self, arguments: &str, stdin: &[u8]) -> Outcome {
        let mut command = Command::new(PROGRAM);
        command.current_dir(self.0.path()).args(arguments.split_whitespace()).write_stdin(stdin);
        let output = command.timeout(Duration::from_secs(100)).output().unwrap();
        Outcome {
            command: arguments.into(),
            code: output.status.code(),
            stdout: String::from_utf8(output.stdout).unwrap(),
            stderr: String::from_utf8(output.stderr).unwrap(),
        }
    }

    /// Runs the program here; it must succeed.
    pub fn ok(&self, arguments: &str) -> Outcome {
        self.run(arguments).succeeded()
    }
}

pub fn names_in(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    let mut names: Vec<String> = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

/// What a run gave.
pub struct Outcome {
    pub command: String,
    pub code: Option<i32>,
    pub stdout: String,
    pub stderr: String,
}

impl Outcome {
    #[track_caller]
    pub fn succeeded(self) -> Self {
        assert_eq!(self.code, Some(0), "isophote {}\n{}", self.command, self.stderr);
        self
    }

    /// The run failed with this code, printed no result, and these words were said about it.
    #[track_caller]
    pub fn failed(self, code: i32, words: &[&str]) -> Self {
        assert_eq!(self.code, Some(code), "isophote {}\n{}", self.command, self.stderr);
        assert_eq!(self.stdout, "", "isophote {}", self.command);
        for word in words {
            assert!(self.stderr.contains(word), "isophote {}: no {word:?} in\n{}", self.command, self.stderr);
        }
        self
    }

    #[track_caller]
    pub fn json(&self) -> Value {
        serde_json::from_str(&self.stdout).unwrap_or_else(|error| panic!("{error} in {}", self.stdout))
    }

    /// The line of a table that begins with this word, as words.
    #[track_caller]
    pub fn row(&self, first: &str) -> Vec<&str> {
        let mut rows = self.stdout.lines().map(|line| line.split_whitespace().collect::<Vec<_>>());
        rows.find(|row| row.first() == Some(&first)).unwrap_or_else(|| panic!("no {first:?} in\n{}", self.stdout))
    }
}

/// A table of numbers, by splitting at commas.
#[derive(Debug, PartialEq)]
pub struct Csv {
    pub names: Vec<String>,
    pub rows: Vec<Vec<f64>>,
}

impl Csv {
    pub fn parse(text: &str) -> Self {
        let mut lines = text.lines().filter(|line| !line.starts_with('#'));
        let names: Vec<String> = lines.next().unwrap().split(',').map(str::to_owned).collect();
        // An empty cell means that nothing is seen there.
        let number = |cell: &str| if cell.is_empty() { f64::NAN } else { cell.parse().unwrap() };
        let rows: Vec<Vec<f64>> = lines.map(|line| line.split(',').map(number).collect()).collect();
        assert!(rows.iter().all(|row| row.len() == names.len()), "a row is as long as the header");
        Self { names, rows }
    }

    #[track_caller]
    pub fn column_at(&self, name: &str, row: usize) -> f64 {
        let index = self.names.iter().position(|known| known == name).unwrap();
        self.rows[row][index]
    }

    #[track_caller]
    pub fn column(&self, name: &str) -> Vec<f64> {
        let index = self.names.iter().position(|known| known == name);
        let index = index.unwrap_or_else(|| panic!("no column {name} among {:?}", self.names));
        self.rows.iter().map(|row| row[index]).collect()
    }
}

/// What a PNG file holds, with nothing converted.
pub struct Picture {
    pub width: u32,
    pub height: u32,
    pub color: ColorType,
    pub depth: BitDepth,
    bytes: Vec<u8>,
}

impl Picture {
    pub fn read(file: &[u8]) -> Self {
        let mut reader = png::Decoder::new(Cursor::new(file)).read_info().unwrap();
        let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut bytes).unwrap();
        reader.finish().unwrap();
        Self { width: info.width, height: info.height, color: info.color_type, depth: info.bit_depth, bytes }
    }

    /// The levels of a grey picture.
    #[track_caller]
    pub fn levels(&self, depth: BitDepth) -> Vec<f64> {
        assert_eq!((self.color, self.depth), (ColorType::Grayscale, depth));
        match depth {
            BitDepth::Eight => self.bytes.iter().map(|level| f64::from(*level)).collect(),
            BitDepth::Sixteen => {
                self.bytes.as_chunks().0.iter().map(|pair| f64::from(u16::from_be_bytes(*pair))).collect()
            }
            other => panic!("depth {other:?}"),
        }
    }

    /// The pixels of a picture of this kind with eight bits a sample.
    #[track_caller]
    pub fn pixels<const SAMPLES: usize>(&self, color: ColorType) -> &[[u8; SAMPLES]] {
        assert_eq!((self.color, self.depth), (color, BitDepth::Eight));
        assert_eq!(color.samples(), SAMPLES);
        self.bytes.as_chunks().0
    }
}

/// A `NumPy` array: its kind, its shape and its 64-bit numbers (or 32-bit indices), read by the format's description.
pub fn npy(bytes: &[u8]) -> (String, Vec<usize>, Vec<f64>) {
    assert_eq!(&bytes[..8], b"\x93NUMPY\x01\x00");
    let length = usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
    assert_eq!((10 + length) % 64, 0, "the numbers are aligned");
    let header = std::str::from_utf8(&bytes[10..10 + length]).unwrap();
    let after = |key: &str| header.split_once(key).unwrap().1;
    assert!(after("'fortran_order': ").starts_with("False"));
    let kind = after("'descr': '").split('\'').next().unwrap().to_owned();
    let shape = after("'shape': (").split(')').next().unwrap().split(',');
    let shape: Vec<usize> =
        shape.filter(|side| !side.trim().is_empty()).map(|side| side.trim().parse().unwrap()).collect();
    let count = shape.iter().product();
    let data = &bytes[10 + length..];
    let numbers = match kind.as_str() {
        "<f8" => data.chunks_exact(8).map(|eight| f64::from_le_bytes(eight.try_into().unwrap())).take(count).collect(),
        "<i4" => data
            .chunks_exact(4)
            .map(|four| f64::from(i32::from_le_bytes(four.try_into().unwrap())))
            .take(count)
            .collect(),
        "|b1" => data.iter().map(|&byte| f64::from(byte)).take(count).collect::<Vec<_>>(),
        other => panic!("kind {other}"),
    };
    assert_eq!(numbers.len(), count, "all numbers are there");
    (kind, shape, numbers)
}

/// Bits, so that equal means the same to the last one.
pub fn bits(numbers: &[f64]) -> Vec<u64> {
    numbers.iter().map(|number| number.to_bits()).collect()
}

#[track_caller]
pub fn assert_close(value: f64, expected: f64, relative: f64) {
    assert!((value - expected).abs() <= relative * expected.abs(), "{value:e} is not {expected:e} to {relative:e}");
}
